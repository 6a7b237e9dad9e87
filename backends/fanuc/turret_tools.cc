#include "backends/fanuc/turret_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "backends/fanuc/text_word.h"
#include "backends/fanuc/tool_flow.h"
#include "backends/fanuc/tool_words.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using LengthWord = dialects::FanucSettings::LengthWord;
using ir::Block;
using ir::BlockId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

/// "shop/integrex.toml" -> "integrex", as ncport.toml names machines.
std::string_view ShortName(std::string_view profile) {
  if (const std::size_t slash = profile.rfind('/'); slash != std::string_view::npos) profile.remove_prefix(slash + 1);
  if (profile.ends_with(".toml")) profile.remove_suffix(5);
  return profile;
}

/// Digits of the station in the T word of a turret: "T0303" without its offset. Empty: no such word.
std::string_view StationOf(const RaiseInput& input, std::string_view words) {
  const std::size_t at = words.find('T');
  const std::size_t end = std::min(words.find_first_not_of("0123456789", at + 1), words.size());
  const std::size_t offset = input.profile->OffsetDigits();
  return at == std::string_view::npos || end - at - 1 <= offset ? std::string_view()
                                                                : words.substr(at + 1, end - at - 1 - offset);
}

/// The tool that is in, by its word: `T3`, `T="ROUGH"`.
void TakeTool(std::string_view word, ToolUse& use) {
  if (word.starts_with("T=\"")) {
    use.source_name = word.substr(3, word.size() - 4);
  } else {
    use.source_tool = NumberBehind(word, 'T');
  }
}

/// All rows of the tool name one station: its D words change offsets and turn no turret.
bool StaysIn(const RaiseInput& input, std::string_view tool, const dialects::WordMapping& mapping) {
  const std::string_view station = StationOf(input, mapping.target);
  return !station.empty() && std::ranges::all_of(input.config->tools, [&](const dialects::WordMapping& row) {
    const bool same_tool = row.source == tool || row.source.starts_with(std::string(tool) + " ");
    return !same_tool || StationOf(input, row.target) == station;
  });
}

/// Words that could stand for the tool: with its own number where the source gives one, else with letters for digits
/// that only the machine knows.
std::string ExampleRow(const ToolUse& use, bool changes_by_m6, bool no_offset) {
  const std::string station = use.source_tool == 0 ? "ss" : fmt::format("{:02}", use.source_tool);
  const std::string where = use.source_tool == 0 ? "ss: its station" : "";
  if (changes_by_m6) {
    const std::string suffix = use.source_edge > 1 ? "tt" : "01";
    return fmt::format("\"T{}.{} M6\"{}{}", station, suffix, where.empty() ? "" : "  (" + where + ")",
                       use.source_edge > 1 ? fmt::format("  (tt: what stands for D{})", use.source_edge) : "");
  }
  if (no_offset) return fmt::format("\"T{}00\"  (the station of the tool, its offset off)", station);
  const bool open = use.source_tool == 0 || use.source_edge > 1;
  if (!open) return fmt::format("\"T{0}{0}\"", station);
  return fmt::format("\"T{}tt\"  ({}{}tt: the offset that stands for D{})", station, where, where.empty() ? "" : ", ",
                     std::max<std::uint32_t>(use.source_edge, 1));
}

}  // namespace

bool MapTurretTools(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const bool lathe = input.profile->IsLathe();
  // Series M: T makes ready, M6 changes (mazak-lathe-4.2). `T0101` would be tool 101, and never come in.
  const bool changes_by_m6 = lathe && input.profile->series.Is(dialects::Series::kM);
  const bool own_offset = changes_by_m6 && input.profile->fanuc.length_word.Is(LengthWord::kG43P1);
  const std::string_view example = changes_by_m6 ? "T01.01 M6" : lathe ? "T0101" : "T1 M6 H1 D1";
  bool ok = true;
  // Of the module as it came: what is written below changes none of it.
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  const ToolFlow tools(analyses.Sources());
  bool selects = false;  // some program selects a work offset
  bool tools_in = false;
  for (const Word& word : module.words.All()) {
    selects = selects || word.op == WordOp::kWorkOffset;
    tools_in = tools_in || word.op == WordOp::kTool;
  }
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "map_tools");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::string last_tool(tools.Before(id));  // the T word in force, as written
      std::vector<Word> kept;
      const Word* tool = nullptr;
      const Word* edge = nullptr;
      bool change = false;
      bool machine = false;  // moves in machine coordinates, which leave the offset out on both sides
      bool moves = false;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        if (word.op == WordOp::kTool) {
          tool = &word;
        } else if (word.op == WordOp::kEdge) {
          edge = &word;
        } else if (word.op == WordOp::kToolChange) {
          change = true;
        } else {
          moves = moves || word.op == WordOp::kAxis;
          machine = machine || word.op == WordOp::kMachineCoords;
          kept.push_back(word);
        }
      }
      if (machine && moves && tools_in && edge == nullptr) TellKeptOffset(input, out);
      if (tool == nullptr && edge == nullptr && !change) continue;
      const ir::WorkOffset work_offset = flow.At(program, id).work_offset;
      ToolUse use;
      const Word& at = tool != nullptr ? *tool : edge != nullptr ? *edge : module.words[block.words[0]];
      const SourceRange range = module.RangeOf(block, at);
      if (tool != nullptr) {
        const ir::Expr& value = module.exprs[tool->value];
        if (value.op == ExprOp::kText) {
          use.source_name = module.View(StringId{value.a});
          last_tool = fmt::format("T=\"{}\"", use.source_name);
        } else if (const auto number = ir::WholeNumber(module, tool->value)) {
          use.source_tool = *number;
          last_tool = fmt::format("T{}", *number);
        } else {
          sink.Report(diag::Code::kNotExpressible, range, "a computed tool", input.profile->name);
          ok = false;
          continue;
        }
      } else if (last_tool.empty()) {
        sink.Report(diag::Code::kNotExpressible, range, "an edge whose tool is not one on every way here",
                    input.profile->name)
            .help = "an edge is a set of offsets of its tool: write T and D together";
        ok = false;
        continue;
      }
      if (tool == nullptr) TakeTool(last_tool, use);
      use.source_words = last_tool;
      if (edge != nullptr) {
        const auto number = ir::WholeNumber(module, edge->value);
        if (!number) {
          sink.Report(diag::Code::kNotExpressible, range, "a computed edge", input.profile->name);
          ok = false;
          continue;
        }
        use.source_edge = *number;
        use.source_words += fmt::format(" D{}", *number);
      } else if (tool != nullptr && input.source_machine->tool_activates_edge) {
        use.source_edge = 1;
      }
      const dialects::WordMapping* mapping =
          input.config == nullptr ? nullptr : input.config->FindTool(use.source_words);
      if (mapping == nullptr) {
        auto& finding = sink.Report(diag::Code::kUnmappedTool, range, use.source_words);
        const std::string quote = use.source_words.find('"') == std::string::npos ? "\"" : "'";
        const bool no_offset = lathe && !changes_by_m6 && edge != nullptr && use.source_edge == 0;
        finding.help = fmt::format("add to ncport.toml, with the words of your machine:  [tools]  {0}{1}{0} = {2}",
                                   quote, use.source_words, ExampleRow(use, changes_by_m6, no_offset));
        ok = false;
        continue;
      }
      use.target_words = mapping->target;
      if (changes_by_m6 && !HoldsWord(use.target_words, "M6")) {
        sink.Report(
                diag::Code::kNotExpressible, range,
                fmt::format("{} as \"{}\", words without M6 that change no tool,", use.source_words, use.target_words),
                input.profile->name)
            .help = fmt::format(
            "write the words of this machine in [tools] of ncport.toml, for example \"{}\"; a "
            "folder with several targets names each by its profile: {{ {} = \"{}\" }}",
            example, ShortName(input.profile->name), example);
        ok = false;
        continue;
      }
      out.tool_change_added = out.tool_change_added || (changes_by_m6 && !change);
      std::size_t digits = 0;
      const std::uint32_t number = NumberBehind(use.target_words, 'T', &digits);
      if (lathe && use.target_words.find('.') == std::string::npos && digits >= 3) {
        use.target_tool = digits > 4 ? number / 1000 : number / 100;
        use.target_offset = digits > 4 ? number % 1000 : number % 100;
      } else {
        use.target_tool = number;
        use.target_offset = own_offset ? number : NumberBehind(use.target_words, 'H');
      }
      const bool keeps_tool =
          lathe && !changes_by_m6 && tool == nullptr && !change && StaysIn(input, last_tool, *mapping);
      use.offset_only = keeps_tool;
      if (input.profile->IsMazakLathe()) use.target_suffix = ToolSuffix(use.target_words);
      const auto known = std::find_if(out.tools.begin(), out.tools.end(),
                                      [&](const ToolUse& other) { return other.source_words == use.source_words; });
      if (known == out.tools.end()) {
        out.tools.push_back(use);
      } else {
        known->offset_only = known->offset_only || keeps_tool;
      }
      // A T word alone moves the axes by the difference of the offsets (fanuc-8.4), with offset 0 by all of it, which
      // in the cut is a move of its own.
      const ir::Motion motion = flow.At(program, id).motion;
      const bool off = keeps_tool && use.source_edge == 0 && flow.Reached(program, id);
      if (off && motion != ir::Motion::kRapid && motion != ir::Motion::kUnknown) {
        sink.Report(diag::Code::kNotExpressible, range, "an offset that ends while G0 is not in force",
                    input.profile->name)
            .help = "its T word moves the axes at once by all of the offset: write G0 in this block or before";
        ok = false;
        continue;
      }
      const bool rapid_before = flow.Before(program, id).motion == ir::Motion::kRapid;
      if (off && (machine || (moves && !rapid_before))) {
        Word text = TextWord(module, use.target_words, TextKind::kToolCall);
        text.flags |= Word::kKeepsTool;
        const auto alone = [&](const Word& word) {
          Block made = editor.MakeBlock(id);
          made.skip_level = block.skip_level;
          editor.SetWords(made, {word});
          return made;
        };
        // There T stands in no block with a move (mazak-lathe-4.4).
        const bool apart = input.profile->IsMazakLathe();
        if (!apart) kept.push_back(text);
        editor.SetWords(id, kept);
        if (apart && machine) {
          editor.InsertAfter(id, alone(text));
        } else if (apart) {
          Block first = alone(ir::MakeWord(WordOp::kMotion, ir::Motion::kRapid));
          editor.TakeHead(first, id);
          editor.InsertBefore(id, first);
          editor.InsertBefore(id, alone(text));
        }
        continue;
      }
      // T stands alone in its block (mazak-lathe-4.4); what stood beside it follows.
      Word text = TextWord(module, use.target_words, TextKind::kToolCall);
      if (keeps_tool) text.flags |= Word::kKeepsTool;
      editor.PutInFront(id, {text}, {.comments = true});
      if (lathe && selects && !work_offset.known && tool != nullptr && flow.Reached(program, id)) {
        // The tool word may drop the offset, and behind it the one in force is written again.
        sink.Report(diag::Code::kUnknownModalState, range, "the work offset", "it is written again behind a tool call")
            .help = "write the work offset (G54) behind the tool call";
        ok = false;
      }
      if (lathe && work_offset.known && work_offset.number != 0 && tool != nullptr) {
        Block again = editor.MakeBlock(id);
        again.flags = Block::kAdded;
        again.skip_level = block.skip_level;
        editor.SetWords(again, {ir::MakeWord(WordOp::kWorkOffset, 0, {}, work_offset.number)});
        editor.InsertBefore(id, again);
      }
      if (kept.empty()) {
        editor.Remove(id);
      } else {
        editor.SetWords(id, kept);
      }
    }
    editor.Apply();
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
