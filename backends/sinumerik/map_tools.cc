#include "backends/sinumerik/map_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/sinumerik/tool_rows.h"
#include "ir/analysis/forward_flow.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

constexpr std::uint8_t kZ = 2;
constexpr std::uint32_t kMostNumber = 100'000'000;  // of a T, H or D word

/// A number that is the same on all ways to a place.
constexpr std::uint32_t kOpen = 0xFFFFFFFEU;   // it is not
constexpr std::uint32_t kStale = 0xFFFFFFFDU;  // of the tool before: nothing may rely on it

/// What is selected on arrival at a block.
struct Selection {
  std::uint32_t ready = kOpen;   // T word
  std::uint32_t tool = kOpen;    // in the spindle
  std::uint32_t length = kOpen;  // register in force, 0 = off
  std::uint32_t radius = kOpen;  // D word
  bool operator==(const Selection&) const = default;
};

bool IsToolWord(WordOp op) {
  return op == WordOp::kTool || op == WordOp::kToolChange || op == WordOp::kToolOffset || op == WordOp::kLengthOffset ||
         op == WordOp::kRadiusOffset;
}

class Pass {
 public:
  // The data flow.
  using State = Selection;
  [[nodiscard]] State Entry(ir::ProgramId program) const {
    State start;
    if (module_.programs[program].kind == ir::ProgramKind::kMain) start.length = start.radius = 0;
    return start;
  }
  [[nodiscard]] State Unknown(ir::ProgramId) const { return {}; }
  bool Join(BlockId, State& into, const State& from) const {
    const State before = into;
    const auto join = [](std::uint32_t& a, std::uint32_t b) { a = a == b ? a : kOpen; };
    // What is stale on one way stays so.
    const auto join_register = [](std::uint32_t& a, std::uint32_t b) {
      if (a != b) a = a == kStale || b == kStale ? kStale : kOpen;
    };
    join(into.ready, from.ready);
    join(into.tool, from.tool);
    join_register(into.length, from.length);
    join_register(into.radius, from.radius);
    return into != before;
  }
  void Transfer(ir::ProgramId, BlockId block, State& state) const { Through(module_.blocks[block], state); }
  /// A program without tool words leaves each caller its own selection.
  [[nodiscard]] State Back(const ir::analysis::CallSite& site, const State& at, const State& exit) const {
    const std::uint32_t callee = site.callee.value;
    const bool selects = !site.callee.Valid() || with_tools_.contains(callee) || with_tools_below_.contains(callee);
    return selects ? exit : at;
  }

  Pass(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input),
        out_(out),
        module_(out.module),
        sink_(sink),
        make_(out.module),
        analyses_(input.Analyse(out.module)),
        flow_(analyses_.Modal()),
        selections_(analyses_.Sources(), *this),
        rows_(input, out, sink) {}

  bool Run() {
    for (const ir::ProgramId program : module_.programs.Ids()) {
      if (HasToolWords(program)) with_tools_.insert(program.value);
    }
    for (bool again = true; again;) {
      again = false;
      for (const auto& site : analyses_.Calls().AllSites()) {
        // Who knows what a program that is not found selects?
        if (!site.callee.Valid() || with_tools_.contains(site.callee.value))
          again = with_tools_below_.insert(site.caller.value).second || again;
        if (site.callee.Valid() && with_tools_below_.contains(site.callee.value))
          again = with_tools_below_.insert(site.caller.value).second || again;
      }
    }
    if (with_tools_.empty()) {
      AssumeNoOffset();
      return true;
    }
    selections_.Run();
    if (input_.source_profile->IsLathe()) {
      for (const BlockId id : module_.blocks.Ids()) {
        if (selections_.Before(id) != nullptr) MapTurret(id);
      }
    }
    for (const ir::ProgramId program : module_.programs.Ids()) Map(program);
    return ok_ && rows_.Ok();
  }

 private:
  [[nodiscard]] bool HasToolWords(ir::ProgramId program) const {
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId id : module_.blocks[block].words) {
        const Word& word = module_.words[id];
        // A word that only switches off what was never on asks for nothing.
        const bool off = word.op == WordOp::kLengthOffset && word.index == 0 && !word.value.Valid();
        if (IsToolWord(word.op) && !off) return true;
      }
    }
    return false;
  }

  /// G53 leaves the tool's offset out; SUPA does not.
  void AssumeNoOffset() {
    for (const Block& block : module_.blocks.All()) {
      for (const WordId id : block.words) {
        if (module_.words[id].op != WordOp::kMachineCoords) continue;
        out_.assumptions.emplace_back(
            "SUPA stands for G53: no tool offset is in force there (sinumerik-12, row 30); test: D0, then the same "
            "move");
        return;
      }
    }
  }

  void Refuse(const Block& block, const Word& word, std::string_view what, std::string_view help = {}) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block, word), what, input_.profile->name).help = help;
  }

  // --- the flow

  void Through(const Block& block, State& state) const {
    const bool lathe = input_.source_profile->IsLathe();
    bool change = false, length = false, radius = false;
    for (const WordId id : block.words) {
      const Word& word = module_.words[id];
      const auto number = word.value.Valid() ? ir::WholeNumber(module_, word.value, kMostNumber) : std::nullopt;
      switch (word.op) {
        case WordOp::kTool:
          state.ready = number.value_or(kOpen);
          if (lathe) state.tool = state.ready;
          break;
        case WordOp::kToolChange:
          change = true;
          break;
        case WordOp::kToolOffset:
        case WordOp::kLengthOffset:
          if (word.value.Valid()) {
            state.length = number.value_or(kOpen);
            length = true;
          } else if (word.index == 0) {
            state.length = 0;
            length = true;
          }
          break;
        case WordOp::kRadiusOffset:
          state.radius = number.value_or(kOpen);
          radius = true;
          break;
        default:
          break;
      }
    }
    if (change) {
      state.tool = state.ready;
      if (!length && state.length != 0) state.length = kStale;
      if (!radius && state.radius != 0) state.radius = kStale;
    }
  }

  // --- the text

  /// The tool by itself; the word's own value after a finding.
  ExprId ToolValue(const Block& block, const Word& word, std::uint32_t tool) {
    const std::optional<TargetTool> target = rows_.Alone(module_.RangeOf(block, word), tool);
    return target ? ValueOf(*target) : word.value;
  }
  ExprId ValueOf(const TargetTool& target) {
    return target.name.empty() ? make_.Literal(target.tool, ir::Type::kInt) : make_.Text(target.name);
  }

  /// Edge that stands for the registers in force; none after a finding.
  std::optional<std::uint32_t> EdgeOf(const Block& block, const Word& word, const State& state) {
    if (state.length == 0 || state.length == kStale) return 0;
    if (state.length == kOpen || state.tool == kOpen || state.radius == kOpen) {
      Refuse(block, word, "an offset whose tool or number is not one on all ways here",
             "write T M6, G43 H and D in one straight run of blocks");
      return std::nullopt;
    }
    const std::uint32_t radius = state.radius == kStale ? 0 : state.radius;
    const TargetTool* target = rows_.Find(module_.RangeOf(block, word), state.tool, state.length, radius);
    if (target == nullptr) return std::nullopt;
    return target->edge;
  }

  Word EdgeWord(std::uint32_t edge) { return ir::MakeWord(WordOp::kEdge, 0, make_.Literal(edge, ir::Type::kInt)); }

  void Map(ir::ProgramId program) {
    ProgramEditor editor(module_, program, "map_tools");
    for (const BlockId id : module_.programs[program].blocks) {
      const State* before = selections_.Before(id);
      if (before == nullptr) continue;  // no run gets here
      if (input_.source_profile->IsLathe()) {
        OffsetOffInMachineMove(id, *before, editor);
      } else {
        MapBlock(program, id, *before, editor);
      }
    }
    editor.Apply();
  }

  void MapBlock(ir::ProgramId program, BlockId id, const State& before, ProgramEditor& editor) {
    Block block = module_.blocks[id];
    State after = before;
    Through(block, after);
    std::vector<Word> words;
    const Word* selects = nullptr;
    const Word* along = nullptr;
    const Word* machine = nullptr;
    for (const WordId word_id : block.words) {
      Word word = module_.words[word_id];
      switch (word.op) {
        case WordOp::kTool: {
          const auto number = ir::WholeNumber(module_, word.value, kMostNumber);
          if (!number) {
            Refuse(block, module_.words[word_id], "a computed tool");
            break;
          }
          word.value = ToolValue(block, word, *number);
          break;
        }
        case WordOp::kToolChange:
          selects = &module_.words[word_id];
          break;
        case WordOp::kLengthOffset:
          if (word.index == 2) Refuse(block, word, "a length offset that counts downward");
          [[fallthrough]];
        case WordOp::kRadiusOffset:
          selects = &module_.words[word_id];
          continue;
        case WordOp::kAxis:
          if (word.index == kZ) along = &module_.words[word_id];
          break;
        case WordOp::kMachineCoords:
          machine = &module_.words[word_id];
          break;
        case WordOp::kCutterComp:
          if (word.index == static_cast<std::uint8_t>(ir::CutterComp::kOff)) break;
          if (after.length == 0 || after.length == kStale) {
            Refuse(block, word, "cutter compensation without a length offset, where an edge is both,");
          } else if (after.radius == 0 || after.radius == kStale) {
            Refuse(block, word, "cutter compensation without a register of this tool");
          }
          break;
        case WordOp::kPlane:
          // The length of an edge lies along the third axis of the plane, the register's along Z (sinumerik-8.8).
          if (word.index != static_cast<std::uint8_t>(ir::Plane::kXY) && after.length != 0 && after.length != kStale)
            Refuse(block, word, "another plane than G17 while a length offset may be in force");
          break;
        case WordOp::kCall:
          if (before.length == kStale) Refuse(block, word, "a call between a tool change and its length offset");
          break;
        default:
          break;
      }
      words.push_back(word);
    }
    const bool mine = with_tools_.contains(program.value);
    if (along != nullptr && machine == nullptr && (after.length == kStale || (mine && after.length == kOpen)))
      Refuse(block, *along, "a move along Z between a tool change and its length offset");
    if (selects != nullptr && after.length != 0 && after.length != kStale &&
        flow_.At(program, id).plane != ir::Plane::kXY)
      Refuse(block, *selects, "a length offset in another plane than G17");
    const auto edge = selects != nullptr ? EdgeOf(block, *selects, after) : std::nullopt;
    if (selects != nullptr && !edge) return;
    if (edge) words.push_back(EdgeWord(*edge));
    if (machine != nullptr && along != nullptr && (mine || after.length != kOpen)) {
      // G53 leaves the tool's offset out, SUPA does not: off for this block (sinumerik-12, row 30).
      const auto active = EdgeOf(block, *machine, after);
      if (!active) return;
      if (*active != 0) {
        words.push_back(EdgeWord(0));
        editor.PutBehind(id, {EdgeWord(*active)});
      }
    }
    editor.SetWords(id, words);
  }

  /// T0101: the change and the offset at once; a row of [tools] each.
  void MapTurret(BlockId id) {
    Block block = module_.blocks[id];
    std::vector<Word> words;
    const Word* tool = nullptr;
    const Word* offset = nullptr;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kTool) {
        tool = &word;
      } else if (word.op == WordOp::kToolOffset) {
        offset = &word;
      } else {
        words.push_back(word);
      }
    }
    if (tool == nullptr && offset == nullptr) return;
    const Word at = tool != nullptr ? *tool : *offset;
    const auto station =
        tool != nullptr ? ir::WholeNumber(module_, tool->value, kMostNumber) : std::optional<std::uint32_t>(0);
    const auto number = offset != nullptr ? ir::WholeNumber(module_, offset->value, kMostNumber) : std::nullopt;
    if (!station || !number || *station == 0) {
      if (number && *number == 0) {
        words.insert(words.begin(), EdgeWord(0));  // T0000, T00: the offset is off
      } else {
        return Refuse(block, at, "an offset without its tool");
      }
    } else {
      const auto digits = static_cast<int>(input_.source_profile->OffsetDigits());
      const int all = std::max<int>(at.digits, digits + 1);
      const auto text_of = [&](std::uint32_t register_number) {
        return fmt::format("T{:0{}}{:0{}}", *station, all - digits, register_number, digits);
      };
      const dialects::WordMapping* mapping =
          input_.config == nullptr ? nullptr : input_.config->FindTool(text_of(*number));
      // T0100 is the tool without its offset: any row of the tool names it.
      for (std::uint32_t i = 1; *number == 0 && mapping == nullptr && input_.config != nullptr && i < 100; ++i)
        mapping = input_.config->FindTool(text_of(i));
      const TargetTool* target =
          rows_.Take(module_.RangeOf(block, at), mapping, text_of(*number), {*station, *number, 0});
      if (target == nullptr) return;
      Word change = at;
      change.op = WordOp::kTool;
      change.value = ValueOf(*target);
      words.insert(words.begin(), {change, EdgeWord(*number == 0 ? 0 : target->edge)});
    }
    ir::SetWords(module_, module_.blocks[id], words);
  }

  /// On a lathe an offset has parts in X and Z: off for the whole block of SUPA (sinumerik-12, row 30).
  void OffsetOffInMachineMove(BlockId id, const State& before, ProgramEditor& editor) {
    Block block = module_.blocks[id];
    const Word* machine = nullptr;
    bool moves = false, selects = false;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kMachineCoords) machine = &module_.words[word_id];
      moves = moves || word.op == WordOp::kAxis;
      selects = selects || word.op == WordOp::kTool || word.op == WordOp::kEdge;
    }
    if (machine == nullptr || !moves) return;
    // The T word of the block itself is an edge by now.
    if (selects) return Refuse(block, *machine, "a tool word beside a move in machine coordinates");
    if (before.length == 0 || !rows_.Ok()) return;  // behind a finding no row is known
    if (before.length == kOpen || before.length == kStale || before.tool == kOpen)
      return Refuse(block, *machine, "machine coordinates with an offset that is not one on all ways here",
                    "write the T word of the tool in front of it");
    const TargetTool* target = rows_.Find(module_.RangeOf(block, *machine), before.tool, before.length, 0);
    if (target == nullptr || target->edge == 0) return;
    std::vector<Word> words;
    for (const WordId word_id : block.words) words.push_back(module_.words[word_id]);
    words.push_back(EdgeWord(0));
    editor.SetWords(block, words);
    module_.blocks[id].words = block.words;
    Block again = editor.MakeBlock(id);
    again.skip_level = block.skip_level;
    editor.SetWords(again, {EdgeWord(target->edge)});
    editor.InsertAfter(id, again);
  }

  const RaiseInput& input_;
  Translation& out_;
  Module& module_;
  diag::Sink& sink_;
  ir::ExprBuilder make_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  std::set<std::uint32_t> with_tools_, with_tools_below_;
  ir::analysis::ForwardFlow<Pass> selections_;
  ToolRows rows_;
  bool ok_ = true;
};

}  // namespace

bool MapTools(const RaiseInput& input, Translation& out, diag::Sink& sink) { return Pass(input, out, sink).Run(); }

}  // namespace ncport::backends::sinumerik
