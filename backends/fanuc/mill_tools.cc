#include "backends/fanuc/mill_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/fanuc/text_word.h"
#include "backends/fanuc/tool_words.h"
#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/motions.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

constexpr std::uint8_t kZ = 2;
constexpr std::uint32_t kMostTool = 1'000'000;

/// What is selected on arrival at a block. Each part is one value on every way, or kMixed.
struct Selection {
  static constexpr int kMixed = -1;
  static constexpr int kNone = 0;  // nothing selected since the program started
  static constexpr int kYes = 1, kNo = 2;

  int tool = kMixed;      // 1 + index of the tool's words
  int prepared = kMixed;  // by a T word that waits for its M6
  int edge = kMixed;      // 1 + number
  int told = kMixed;      // kYes: the length register of the target is the right one; kNo: the next Z word names it
  bool operator==(const Selection&) const = default;
};

int JoinPart(int a, int b) { return a == b ? a : Selection::kMixed; }

class Mapper {
 public:
  // The data flow.
  using State = Selection;
  [[nodiscard]] State Entry(ProgramId) const {
    return {Selection::kNone, Selection::kNone, Selection::kNone, Selection::kYes};
  }
  [[nodiscard]] State Unknown(ProgramId) const { return {}; }
  bool Join(BlockId, State& into, const State& from) const;
  void Transfer(ProgramId, BlockId block, State& state) const;
  [[nodiscard]] State Back(const ir::analysis::CallSite& site, const State& at, const State& exit) const;

  Mapper(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input),
        out_(out),
        sink_(sink),
        module_(out.module),
        analyses_(input.Analyse(out.module)),
        flow_(analyses_.Modal()),
        selections_(analyses_.Sources(), *this) {}

  bool Run();

 private:
  /// The words of a block that matter here.
  struct Words {
    const Word* tool = nullptr;
    const Word* edge = nullptr;
    bool change = false;
    bool moves_z = false;
    bool moves = false;
    bool machine = false;                // moves in machine coordinates
    const Word* compensation = nullptr;  // left or right
  };
  [[nodiscard]] Words Look(const Block& block) const;

  void NameTools();
  void FindEffects();
  /// With the block's own tool words, before its motion.
  [[nodiscard]] Selection Select(const Words& words, Selection state) const;
  void Rewrite(ProgramId program);

  [[nodiscard]] int ToolOf(const Word* word) const;
  [[nodiscard]] int EdgeOf(const Word* word) const;
  [[nodiscard]] std::string SourceWords(int tool, int edge) const {
    std::string words = names_[static_cast<std::size_t>(tool - 1)];
    if (edge > 0) words += fmt::format(" D{}", edge - 1);
    return words;
  }
  /// The target's words of a tool with an edge; none after a finding.
  const MillToolWords* Target(int tool, int edge, const SourceRange& at);
  void Refuse(const SourceRange& at, std::string_view what, std::string_view help) {
    ok_ = false;
    auto& finding = sink_.Report(diag::Code::kNotExpressible, at, what, input_.profile->name);
    if (!help.empty()) finding.help = help;
  }

  const RaiseInput& input_;
  Translation& out_;
  diag::Sink& sink_;
  Module& module_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;

  std::vector<std::string> names_;  // "T1", `T="DRILL"`
  std::vector<std::pair<std::string, std::uint32_t>> source_tools_;
  std::map<std::string, std::optional<MillToolWords>> targets_;  // by source words; none: reported
  std::vector<bool> selects_;                                    // per program: T, M6 or D in it or below
  ir::analysis::ForwardFlow<Mapper> selections_;
  // The machine's setting; and where no program has an M6: there a tool that only stood ready would never come in.
  bool tool_word_changes_ = false;
  bool ok_ = true;
};

Mapper::Words Mapper::Look(const Block& block) const {
  Words words;
  bool elsewhere = false;
  for (const WordId id : block.words) {
    const Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kTool:
        words.tool = &word;
        break;
      case WordOp::kEdge:
        words.edge = &word;
        break;
      case WordOp::kToolChange:
        words.change = true;
        break;
      case WordOp::kAxis:
        words.moves = true;
        words.moves_z = words.moves_z || word.index == kZ;
        break;
      case WordOp::kPolarAngle:
      case WordOp::kPolarRadius:
        words.moves = true;  // in the plane: not along Z, but for planes that are refused below
        break;
      case WordOp::kAxisComputed:
        words.moves = words.moves_z = true;
        break;
      case WordOp::kCutterComp:
        if (word.index == static_cast<std::uint8_t>(ir::CutterComp::kLeft) ||
            word.index == static_cast<std::uint8_t>(ir::CutterComp::kRight))
          words.compensation = &word;
        break;
      case WordOp::kFrame:
      case WordOp::kReference:
      case WordOp::kPole:
      case WordOp::kPresetPosition:
        elsewhere = true;
        break;
      case WordOp::kMachineCoords:
        elsewhere = words.machine = true;
        break;
      default:
        break;
    }
  }
  words.machine = words.machine && words.moves;
  if (elsewhere) words.moves = words.moves_z = false;
  return words;
}

int Mapper::ToolOf(const Word* word) const {
  const ir::Expr& value = module_.exprs[word->value];
  std::string name;
  if (value.op == ExprOp::kText) {
    name = fmt::format("T=\"{}\"", module_.View(StringId{value.a}));
  } else if (const auto number = ir::WholeNumber(module_, word->value, kMostTool)) {
    name = fmt::format("T{}", *number);
  }
  const auto known = std::find(names_.begin(), names_.end(), name);
  return known == names_.end() ? Selection::kMixed : static_cast<int>(known - names_.begin()) + 1;
}

int Mapper::EdgeOf(const Word* word) const {
  const auto number = ir::WholeNumber(module_, word->value, kMostTool);
  return number ? static_cast<int>(*number) + 1 : Selection::kMixed;
}

void Mapper::NameTools() {
  bool changes = false, tools = false;
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId id : module_.programs[program].blocks) {
      const Block& block = module_.blocks[id];
      const Words words = Look(block);
      changes = changes || words.change;
      tools = tools || words.tool != nullptr;
      if (words.edge != nullptr && !ir::WholeNumber(module_, words.edge->value, kMostTool))
        Refuse(module_.RangeOf(block, *words.edge), "a computed edge", "");
      if (words.tool == nullptr || ToolOf(words.tool) != Selection::kMixed) continue;
      const ir::Expr& value = module_.exprs[words.tool->value];
      if (value.op == ExprOp::kText) {
        const std::string text(module_.View(StringId{value.a}));
        names_.push_back(fmt::format("T=\"{}\"", text));
        source_tools_.emplace_back(text, 0);
      } else if (const auto number = ir::WholeNumber(module_, words.tool->value, kMostTool)) {
        names_.push_back(fmt::format("T{}", *number));
        source_tools_.emplace_back(std::string(), *number);
      } else {
        Refuse(module_.RangeOf(block, *words.tool), "a computed tool", "");
      }
    }
  }
  tool_word_changes_ = input_.source_machine->tool_word_changes || !changes;
  if (tools && !changes && !input_.source_machine->tool_word_changes) {
    out_.assumptions.emplace_back(
        "the T word of the source changes the tool by itself, since no program has an M6 (sinumerik-8.8, MD22550=0)");
  }
}

void Mapper::FindEffects() {
  selects_.assign(module_.programs.Size(), false);
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId id : module_.programs[program].blocks) {
      const Words words = Look(module_.blocks[id]);
      if (words.tool != nullptr || words.edge != nullptr || words.change) selects_[program.value] = true;
    }
  }
  for (const ProgramId program : analyses_.Calls().BottomUp()) {
    for (const ir::analysis::CallSite& site : analyses_.Calls().SitesOf(program)) {
      // Programs that call each other in a circle count as selecting, and those that are not known.
      if (!site.callee.Valid() || selects_[site.callee.value] || analyses_.Calls().Recursive(site.callee))
        selects_[program.value] = true;
    }
  }
}

Selection Mapper::Select(const Words& words, Selection state) const {
  bool changes = false;
  if (words.tool != nullptr) {
    state.prepared = ToolOf(words.tool);
    changes = tool_word_changes_ || words.change;
  } else {
    changes = words.change && !tool_word_changes_;
  }
  if (changes) {
    state.tool = state.prepared;
    state.edge = input_.source_machine->tool_activates_edge ? 2 : Selection::kMixed;
    state.told = Selection::kNo;
  }
  if (words.edge != nullptr) {
    const int edge = EdgeOf(words.edge);
    if (edge != state.edge) state.told = Selection::kNo;
    state.edge = edge;
  }
  return state;
}

bool Mapper::Join(BlockId, State& into, const State& from) const {
  const State before = into;
  into = {JoinPart(into.tool, from.tool), JoinPart(into.prepared, from.prepared), JoinPart(into.edge, from.edge),
          JoinPart(into.told, from.told)};
  return into != before;
}

void Mapper::Transfer(ProgramId, BlockId block, State& state) const {
  const Words words = Look(module_.blocks[block]);
  state = Select(words, state);
  if (words.moves_z) state.told = Selection::kYes;
  // G53 cancels the compensation of the length (fanuc-8.1): the next Z names it again.
  if (words.machine && state.tool > 0 && state.edge > 1) state.told = Selection::kNo;
}

Selection Mapper::Back(const ir::analysis::CallSite& site, const State& at, const State& exit) const {
  if (!site.callee.Valid() || selects_[site.callee.value]) return exit;
  // It leaves each caller its own tool, and may have moved Z.
  State behind = at;
  if (at.told != Selection::kYes)
    behind.told = exit.told == Selection::kYes ? Selection::kYes : JoinPart(at.told, exit.told);
  return behind;
}

const MillToolWords* Mapper::Target(int tool, int edge, const SourceRange& at) {
  const std::string words = SourceWords(tool, edge);
  const auto known = targets_.find(words);
  if (known != targets_.end()) return known->second ? &*known->second : nullptr;
  std::optional<MillToolWords>& target = targets_[words];
  const dialects::WordMapping* mapping = input_.config == nullptr ? nullptr : input_.config->FindTool(words);
  const std::string quote = words.find('"') == std::string::npos ? "\"" : "'";
  const std::uint32_t number = source_tools_[static_cast<std::size_t>(tool - 1)].second;
  const std::uint32_t wish = number == 0 ? 1 : number;
  const std::string line = fmt::format("[tools]  {0}{1}{0} = \"T{2} M6 H{2} D{2}\"", quote, words, wish);
  if (mapping == nullptr) {
    sink_.Report(diag::Code::kUnmappedTool, at, words).help =
        fmt::format("add to ncport.toml, with the words of your machine:  {}", line);
    ok_ = false;
    return nullptr;
  }
  target = ParseMillTool(mapping->target);
  if (!target) {
    Refuse(at, fmt::format("{} as \"{}\" (no tool number)", words, mapping->target),
           fmt::format("write it like this in ncport.toml:  {}", line));
    return nullptr;
  }
  ToolUse use;
  use.source_words = words;
  use.target_words = mapping->target;
  use.source_name = source_tools_[static_cast<std::size_t>(tool - 1)].first;
  use.source_tool = number;
  use.source_edge = edge > 0 ? static_cast<std::uint32_t>(edge - 1) : 0;
  use.target_tool = target->tool;
  use.target_offset = target->length.value_or(0);
  use.target_radius = target->radius.value_or(0);
  out_.tools.push_back(use);
  return &*target;
}

void Mapper::Rewrite(ProgramId program) {
  ProgramEditor editor(module_, program, "map_mill_tools");
  ir::ExprBuilder make(module_);
  const auto made_word = [&](WordOp op, std::uint8_t index, std::optional<std::uint32_t> value) {
    Word word = ir::MakeWord(op, index);
    if (value) word.value = make.Literal(*value, ir::Type::kInt);
    return word;
  };
  for (const BlockId id : module_.programs[program].blocks) {
    const Block block = module_.blocks[id];
    const Words words = Look(block);
    const Selection* arrival = selections_.Before(id);
    // Where no way leads no register has to be named.
    const Selection before = arrival != nullptr
                                 ? *arrival
                                 : Selection{Selection::kMixed, Selection::kMixed, Selection::kMixed, Selection::kYes};
    const Selection now = Select(words, before);
    if (words.tool != nullptr && words.edge != nullptr && !tool_word_changes_ && !words.change)
      Refuse(module_.RangeOf(block, *words.edge), "an edge named before the M6 that brings its tool in",
             "write D in the block of M6 or behind it: whether it counts from T or from M6 on is a setting of the "
             "machine");
    std::string call;  // words of a tool call
    if (words.tool != nullptr || words.change) {
      const SourceRange at = words.tool != nullptr ? module_.RangeOf(block, *words.tool) : module_.RangeOf(block);
      const bool changes = now.told == Selection::kNo && (tool_word_changes_ || words.change);
      if (changes && now.tool <= 0) {
        if (words.tool == nullptr)
          Refuse(at, "M6 without one tool that stands ready on every way here", "write T and M6 in one block");
        else
          ok_ = false;  // a computed tool, reported above
      } else if (changes) {
        if (const MillToolWords* target = Target(now.tool, now.edge, at)) {
          const bool ready = words.tool == nullptr;  // called by its T word already
          if (!ready && words.change && !HasChange(target->call)) {
            Refuse(at,
                   fmt::format("{} as \"{}\", words without M6 that change no tool,", SourceWords(now.tool, now.edge),
                               target->call),
                   "write the change into the row of [tools]:  T1 M6 H1 D1");
          }
          call = ready ? "M6" : target->call;
        }
      } else if (words.tool != nullptr && now.prepared > 0) {
        if (const MillToolWords* target = Target(now.prepared, input_.source_machine->tool_activates_edge ? 2 : 0, at))
          call = fmt::format("T{}", target->tool);
      }
    }
    // Only a change that the source's tool word makes by itself adds an M6.
    if (words.tool != nullptr && !words.change && HasChange(call)) out_.tool_change_added = true;

    if (words.machine && now.edge != 1 && now.tool != Selection::kNone) TellKeptOffset(input_, out_);
    std::vector<Word> kept;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kTool || word.op == WordOp::kEdge || word.op == WordOp::kToolChange) continue;
      if (word.op == WordOp::kAxis && words.moves_z && now.told != Selection::kYes &&
          std::none_of(kept.begin(), kept.end(), [](const Word& w) { return w.op == WordOp::kLengthOffset; })) {
        const SourceRange at = module_.RangeOf(block, word);
        const ir::Motion motion = flow_.At(program, id).motion;
        if (now.tool <= 0 || now.edge <= 0) {
          if (ok_)
            Refuse(at, "the length of a tool that is not one on every way here",
                   "move Z behind each tool change before the ways meet");
        } else if (ir::IsArc(motion)) {
          Refuse(at, "a tool length that comes into force in an arc", "move Z in a straight line before");
        } else if (now.edge == 1) {
          kept.push_back(made_word(WordOp::kLengthOffset, 0, std::nullopt));
        } else if (const MillToolWords* target = Target(now.tool, now.edge, at)) {
          if (target->length) {
            kept.push_back(made_word(WordOp::kLengthOffset, 1, std::nullopt));
            kept.push_back(made_word(WordOp::kLengthOffset, 0, target->length));
          } else {
            Refuse(at, fmt::format("{} without a length register", SourceWords(now.tool, now.edge)),
                   "name it in the [tools] line of ncport.toml, for example H1");
          }
        }
      }
      kept.push_back(word);
      if (word.op != WordOp::kCutterComp || words.compensation == nullptr) continue;
      const SourceRange at = module_.RangeOf(block, word);
      if (now.tool <= 0 || now.edge <= 0) {
        if (ok_ || now.tool == Selection::kNone)
          Refuse(at,
                 now.tool == Selection::kNone
                     ? "cutter compensation without a tool: the register of its radius is not known"
                     : "cutter compensation with a tool that is not one on every way here",
                 "write T and D before, or give each tool a program of its own");
        continue;
      }
      if (now.edge == 1) {
        kept.push_back(made_word(WordOp::kRadiusOffset, 0, 0));
      } else if (const MillToolWords* target = Target(now.tool, now.edge, at)) {
        if (target->radius) {
          kept.push_back(made_word(WordOp::kRadiusOffset, 0, target->radius));
        } else {
          Refuse(at, fmt::format("{} without a radius register", SourceWords(now.tool, now.edge)),
                 "name it in the [tools] line of ncport.toml, for example D1");
        }
      }
    }
    if (words.edge != nullptr && now.edge != before.edge && words.tool == nullptr) {
      const SourceRange at = module_.RangeOf(block, *words.edge);
      const ir::CutterComp comp = flow_.Before(program, id).comp;
      if (now.tool <= 0) {
        Refuse(at, "an edge whose tool is not one on every way here",
               "an edge is a set of offsets of its tool: write T and D together");
      } else if (comp == ir::CutterComp::kLeft || comp == ir::CutterComp::kRight) {
        Refuse(at, "another edge while cutter compensation is on", "cancel it with G40 before");
      } else if (now.edge > 1) {
        Target(now.tool, now.edge, at);
      }
    }
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op != WordOp::kModalCall || !word.Extra<ir::CallId>().Valid()) continue;
      const ProgramId callee = module_.calls[word.Extra<ir::CallId>()].program;
      if (callee.Valid() && selects_[callee.value])
        Refuse(module_.RangeOf(block, word), "a modal call of a program that changes tools", "");
    }
    // The source's length lies along the axis normal to the plane, the target's along Z.
    const ir::Plane plane = flow_.At(program, id).plane;
    if (words.moves && now.tool != Selection::kNone && now.edge != 1 && arrival != nullptr &&
        (plane == ir::Plane::kZX || plane == ir::Plane::kYZ)) {
      Refuse(module_.RangeOf(block), "a tool length along Y or X (a plane other than G17 with a tool)", "");
    }

    const bool same = kept.size() == block.words.count && words.edge == nullptr;
    if (call.empty() && same) continue;
    if (!call.empty()) editor.PutInFront(id, {TextWord(module_, call)}, {.comments = true});
    if (kept.empty()) {
      editor.Remove(id);
    } else {
      editor.SetWords(id, kept);
    }
  }
  editor.Apply();
}

bool Mapper::Run() {
  NameTools();
  FindEffects();
  selections_.Run();
  for (const ProgramId program : module_.programs.Ids()) Rewrite(program);
  return ok_;
}

}  // namespace

bool MapMillTools(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  return Mapper(input, out, sink).Run();
}

}  // namespace ncport::backends::fanuc
