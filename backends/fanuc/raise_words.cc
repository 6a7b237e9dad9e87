#include "backends/fanuc/raise_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "backends/fanuc/message_text.h"
#include "backends/fanuc/text_word.h"
#include "backends/fanuc/tool_flow.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using LengthWord = dialects::FanucSettings::LengthWord;
using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

/// Takes words out of a block and gives it a comment instead.
class CommentMaker {
 public:
  CommentMaker(Module& module, ir::ProgramId program)
      : module_(module), editor_(module, program, "texts_to_comments") {}

  void Replace(BlockId id, const std::vector<Word>& kept, const std::string& text) {
    Block& block = module_.blocks[id];
    editor_.SetWords(block, kept);
    IdRange<ir::CommentId> comments{static_cast<std::uint32_t>(module_.comments.Size()), block.comments.count + 1};
    ir::Comment comment;
    comment.text = module_.strings.Intern(text);
    comment.place = kept.empty() ? ir::CommentPlace::kOwnLine : ir::CommentPlace::kEndOfBlock;
    module_.comments.Add(comment);
    for (const ir::CommentId old : block.comments) {
      const ir::Comment copy = module_.comments[old];
      module_.comments.Add(copy);
    }
    block.comments = comments;
  }
  void Remove(BlockId id) { editor_.Remove(id); }
  void Apply() { editor_.Apply(); }

 private:
  Module& module_;
  ProgramEditor editor_;
};

/// "0101" behind the T of `words`; digits only.
std::uint32_t NumberBehind(std::string_view words, char letter, std::size_t* digits = nullptr) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != letter || (i > 0 && words[i - 1] != ' ')) continue;
    std::uint32_t number = 0;
    const char* first = words.data() + i + 1;
    const auto [last, error] = std::from_chars(first, words.data() + words.size(), number);
    if (error != std::errc{}) continue;
    if (digits != nullptr) *digits = static_cast<std::size_t>(last - first);
    return number;
  }
  return 0;
}

/// The decimals of the first T word as hundredths: 2 of "T01.02 M6"; 0: none.
std::uint32_t ToolSuffix(std::string_view words) {
  std::size_t at = words.find('T');
  if (at == std::string_view::npos) return 0;
  at = words.find_first_not_of("0123456789", at + 1);
  if (at == std::string_view::npos || words[at] != '.') return 0;
  std::uint32_t suffix = 0;
  std::uint32_t unit = 10;
  for (++at; at < words.size() && words[at] >= '0' && words[at] <= '9'; ++at, unit /= 10)
    suffix += unit * static_cast<std::uint32_t>(words[at] - '0');
  return suffix;
}

bool HasWord(std::string_view words, std::string_view word) {
  for (std::size_t at = words.find(word); at != std::string_view::npos; at = words.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || words[at - 1] == ' ') && (end == words.size() || words[end] == ' ')) return true;
  }
  return false;
}

/// "shop/integrex.toml" -> "integrex", as ncport.toml names machines.
std::string_view ShortName(std::string_view profile) {
  if (const std::size_t slash = profile.rfind('/'); slash != std::string_view::npos) profile.remove_prefix(slash + 1);
  if (profile.ends_with(".toml")) profile.remove_suffix(5);
  return profile;
}

}  // namespace

void TextsToComments(const RaiseInput&, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  for (const ir::ProgramId program : module.programs.Ids()) {
    CommentMaker maker(module, program);
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::vector<Word> kept;
      std::string text;
      for (const WordId word_id : block.words) {
        const Word word = module.words[word_id];
        std::string made;
        switch (word.op) {
          case WordOp::kMessage:
          case WordOp::kPrint:
            if (!word.value.Valid()) {
              made = "MSG";
              break;
            }
            made = "MSG ";
            AppendMessage(module, word.value, made);
            break;
          case WordOp::kWorkpiece: {
            made = "WORKPIECE";
            for (const ir::ArgId arg : module.calls[word.Extra<ir::CallId>()].args) {
              made += arg.value == module.calls[word.Extra<ir::CallId>()].args.begin ? " " : ",";
              AppendMessage(module, module.args[arg].value, made);
            }
            break;
          }
          case WordOp::kPreprocessStop:
            made = "STOPRE";
            break;
          case WordOp::kHeader:
          case WordOp::kExtern:
          case WordOp::kFileMark:
            continue;
          default:
            kept.push_back(word);
            continue;
        }
        out.messages_lost = out.messages_lost || word.op == WordOp::kMessage || word.op == WordOp::kPrint;
        sink.Report(diag::Code::kListedLoss, module.RangeOf(block, word), made, "this target");
        out.losses.push_back({module.RangeOf(block, word), made});
        text += (text.empty() ? "" : " ") + made;
      }
      if (!text.empty()) {
        maker.Replace(id, kept, text);
      } else if (kept.size() != block.words.count) {
        if (kept.empty() && block.comments.Empty()) {
          maker.Remove(id);
        } else {
          ir::SetWords(module, module.blocks[id], kept);
        }
      }
    }
    maker.Apply();
  }
}

namespace {

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

}  // namespace

bool MapTools(const RaiseInput& input, Translation& out, diag::Sink& sink) {
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
  for (const Word& word : module.words.All()) selects = selects || word.op == WordOp::kWorkOffset;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "map_tools");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::string last_tool(tools.Before(id));  // the T word in force, as written
      std::vector<Word> kept;
      const Word* tool = nullptr;
      const Word* edge = nullptr;
      bool change = false;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        if (word.op == WordOp::kTool) {
          tool = &word;
        } else if (word.op == WordOp::kEdge) {
          edge = &word;
        } else if (word.op == WordOp::kToolChange) {
          change = true;
        } else {
          kept.push_back(word);
        }
      }
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
        const bool off = lathe && !changes_by_m6 && edge != nullptr && use.source_edge == 0;
        finding.help = fmt::format(
            "add to ncport.toml, with the words of your machine:  [tools]  {0}{1}{0} = \"{2}\"{3}", quote,
            use.source_words, off ? fmt::format("T{:02}00", use.source_tool == 0 ? 1 : use.source_tool) : example,
            off ? "  (the station of the tool, its offset off)" : "");
        ok = false;
        continue;
      }
      use.target_words = mapping->target;
      if (changes_by_m6 && !HasWord(use.target_words, "M6")) {
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
      // T stands alone in its block (mazak-lathe-4.4); what stood beside it follows.
      Block made = editor.MakeBlock(id);
      made.number = block.number;
      made.number_digits = block.number_digits;
      made.label = block.label;
      made.skip_level = block.skip_level;
      made.comments = block.comments;
      Word text = TextWord(module, use.target_words);
      if (keeps_tool) text.flags |= Word::kKeepsTool;
      editor.SetWords(made, {text});
      module.blocks[id].comments = {};
      module.blocks[id].label = {};
      module.blocks[id].number = Block::kNoNumber;
      editor.InsertBefore(id, made);
      if (lathe && selects && !work_offset.known && tool != nullptr && flow.Reached(program, id)) {
        // The tool word may drop the offset, and behind it the one in force is written again.
        sink.Report(diag::Code::kUnknownModalState, range, "the work offset", "it is written again behind a tool call")
            .help = "write the work offset (G54) behind the tool call";
        ok = false;
      }
      if (lathe && work_offset.known && work_offset.number != 0 && tool != nullptr) {
        Block again = editor.MakeBlock(id);
        again.flags = Block::kAdded;
        editor.SetWords(again, {ir::MakeWord(WordOp::kWorkOffset, 0, {}, work_offset.number)});
        editor.InsertBefore(id, again);
      }
      if (kept.empty()) {
        editor.Remove(id);
      } else {
        Block rest = module.blocks[id];
        editor.SetWords(rest, kept);
        module.blocks[id].words = rest.words;
      }
    }
    editor.Apply();
  }
  return ok;
}

bool MapWorkOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        if (word.op != WordOp::kWorkOffset) continue;
        OffsetUse use{word.extra, 0, word.extra, 0};
        const std::string name = fmt::format("G{}", word.extra);
        const dialects::WordMapping* mapping = input.config == nullptr ? nullptr : input.config->FindOffset(name);
        if (mapping != nullptr) {
          use.target = NumberBehind(mapping->target, 'G');
          use.target_extension = NumberBehind(mapping->target, 'P');
          module.words[word_id] = TextWord(module, mapping->target);
        } else if (word.extra < 54 || word.extra > 59) {
          auto& finding = sink.Report(diag::Code::kUnmappedOffset, module.RangeOf(block, word),
                                      word.extra == 0 ? std::string("none (G500)") : name);
          finding.help = fmt::format("add to ncport.toml:  [offsets]  \"{}\" = \"G54.1 P1\"", name);
          ok = false;
          continue;
        }
        const auto known = std::find_if(out.offsets.begin(), out.offsets.end(),
                                        [&](const OffsetUse& other) { return other.source == use.source; });
        if (known == out.offsets.end()) out.offsets.push_back(use);
      }
    }
  }
  return ok;
}

bool MapAuxiliaries(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  bool ok = true;
  const auto rule_for = [&](std::string_view name) -> const dialects::MCodeRule* {
    const auto find = [&](const std::vector<dialects::MCodeRule>& rules) {
      const auto rule =
          std::find_if(rules.begin(), rules.end(), [&](const dialects::MCodeRule& r) { return r.source == name; });
      return rule == rules.end() ? nullptr : &*rule;
    };
    if (input.config != nullptr) {
      if (const auto* rule = find(input.config->mcodes)) return rule;
    }
    return find(input.profile->mcodes);
  };
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      Block block = module.blocks[id];
      std::vector<Word> kept;
      bool changed = false;
      for (const WordId word_id : block.words) {
        const Word word = module.words[word_id];
        if (word.op != WordOp::kAux) {
          kept.push_back(word);
          continue;
        }
        const auto number = ir::WholeNumber(module, word.value);
        const bool common = number && (*number == 7 || *number == 8 || *number == 9);
        const std::string name = number ? fmt::format("M{}", *number) : std::string("a computed M function");
        const dialects::MCodeRule* rule = number ? rule_for(name) : nullptr;
        if (rule == nullptr && !common) {
          sink.Report(diag::Code::kUnmappedCode, module.RangeOf(block, word), name).help =
              fmt::format("add to ncport.toml:  [mcodes]  \"{0}\" = \"{0}\"  (pass), another word, or \"drop\"", name);
          ok = false;
          continue;
        }
        AuxUse use{*number, *number};
        if (rule == nullptr) {
          kept.push_back(word);
        } else if (rule->target == "drop") {
          use.target.reset();
          changed = true;
          out.losses.push_back({module.RangeOf(block, word), name + " left out, as [mcodes] says", true});
        } else {
          use.target = NumberBehind(rule->target, 'M');
          Word text = TextWord(module, rule->target);
          text.phase = word.phase;  // before or after the motion, as in the source
          kept.push_back(text);
          changed = true;
        }
        out.aux.push_back(use);
      }
      if (!changed) continue;
      ir::SetWords(module, block, kept);
      module.blocks[id].words = block.words;
    }
  }
  return ok;
}

bool ArrangeSpindle(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "arrange_spindle");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      std::vector<Word> limit, spindle, rest;
      bool has_mode = false, has_speed = false, has_feed_mode = false, surface = false;
      for (const WordId word_id : block.words) {
        const Word word = module.words[word_id];
        switch (word.op) {
          case WordOp::kSpeedLimit:
            limit.push_back(word);
            break;
          case WordOp::kSpeedMode:
            has_mode = true;
            surface = word.index == static_cast<std::uint8_t>(ir::SpeedMode::kConstantSurface);
            spindle.insert(spindle.begin(), word);
            break;
          case WordOp::kSpeed:
          case WordOp::kSpindle:
            if (word.index != 0 && word.index != 1) {
              sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), "a second spindle", profile.name);
              ok = false;
            }
            has_speed = has_speed || word.op == WordOp::kSpeed;
            spindle.push_back(word);
            break;
          case WordOp::kFeedMode:
            has_feed_mode = true;
            rest.push_back(word);
            break;
          default:
            rest.push_back(word);
        }
      }
      if (limit.empty() && spindle.empty()) continue;
      const ir::ModalState state = flow.At(program, id);
      if (profile.IsLathe() && has_speed && !has_mode) {
        // On a lathe S means 1/min or m/min by the mode in force: it is named with each S (mazak-lathe-5.2).
        if (state.speed_mode == ir::SpeedMode::kUnknown) {
          sink.Report(diag::Code::kUnknownModalState, module.RangeOf(block), "the speed mode (1/min or surface speed)",
                      "the programs that lead here leave it open");
          ok = false;
        } else {
          spindle.insert(spindle.begin(), ir::MakeWord(WordOp::kSpeedMode, state.speed_mode));
        }
      }
      if (surface && input.source_machine->surface_speed_per_revolution && !has_feed_mode) {
        rest.insert(rest.begin(), ir::MakeWord(WordOp::kFeedMode, ir::FeedMode::kPerRevolution));
      }
      const std::string r_word = profile.spindle.r_word.Or("");
      const bool r_everywhere = profile.machine_class.Is(dialects::MachineClass::kQuickTurn);
      if (!r_word.empty() && r_everywhere && has_speed) spindle.push_back(TextWord(module, r_word));
      const auto insert = [&](const std::vector<Word>& words) {
        Block made = editor.MakeBlock(id);
        made.skip_level = block.skip_level;
        // Jumps to the block lead to what is put in front of it.
        made.label = std::exchange(module.blocks[id].label, StringId{});
        made.number = std::exchange(module.blocks[id].number, Block::kNoNumber);
        made.number_digits = block.number_digits;
        editor.SetWords(made, words);
        editor.InsertBefore(id, made);
      };
      // The limit first: without it the spindle would run up as the tool nears the axis (hazards#5).
      if (!limit.empty()) insert(limit);
      // Words before the motion stand in front of it, M5 behind (sinumerik-8.10), and with it all that comes after the
      // motion, in its order: M5 behind M30 would never run.
      const auto acts_behind = [](const Word& word) { return word.phase >= ir::Phase::kAfter; };
      std::vector<Word> behind;
      if (std::any_of(spindle.begin(), spindle.end(), acts_behind)) {
        for (const WordId word_id : block.words) {
          if (acts_behind(module.words[word_id])) behind.push_back(module.words[word_id]);
        }
        std::erase_if(spindle, acts_behind);
        std::erase_if(rest, acts_behind);
      }
      if (rest.empty()) {  // what is left stands in one block
        spindle.insert(spindle.end(), behind.begin(), behind.end());
        rest = std::exchange(spindle, {});
        behind.clear();
      }
      Block changed = module.blocks[id];
      editor.SetWords(changed, rest);
      module.blocks[id].words = changed.words;
      if (rest.empty()) editor.Remove(id);
      if (!spindle.empty()) insert(spindle);
      if (!behind.empty()) {
        Block made = editor.MakeBlock(id);
        made.skip_level = block.skip_level;
        editor.SetWords(made, behind);
        editor.InsertAfter(id, made);
      }
    }
    editor.Apply();
  }
  return ok;
}

void NameMotions(const RaiseInput& input, Translation& out) {
  Module& module = out.module;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  for (const ir::ProgramId program : module.programs.Ids()) {
    ir::Motion running = ir::Motion::kUnknown;  // of the block before on the straight way down
    for (const BlockId id : module.programs[program].blocks) {
      Block& block = module.blocks[id];
      bool moves = false, named = false, leaves = false, shift = false;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius ||
                word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius;
        named = named || word.op == WordOp::kMotion;
        leaves = leaves || ir::DefaultPhaseOf(word.op) == ir::Phase::kFlow || word.op == WordOp::kInert;
        shift = shift || word.op == WordOp::kFrame || word.op == WordOp::kPole || word.op == WordOp::kReference;
      }
      if (shift) continue;  // its axis words are no move under the motion mode
      if (block.label.Valid() || block.number != Block::kNoNumber || leaves || block.skip_level != Block::kNoSkip)
        running = ir::Motion::kUnknown;
      const ir::Motion motion = flow.At(program, id).motion;
      if (moves && !named && motion != running && motion != ir::Motion::kUnknown) {
        std::vector<Word> words{ir::MakeWord(WordOp::kMotion, motion)};
        for (const WordId word_id : block.words) words.push_back(module.words[word_id]);
        ir::SetWords(module, block, words);
      }
      if (moves || named) running = motion;
      if (leaves || block.skip_level != Block::kNoSkip) running = ir::Motion::kUnknown;
    }
  }
}

}  // namespace ncport::backends::fanuc
