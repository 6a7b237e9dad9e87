#include "ir/transform/absolute_dimensions.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/modal_state.h"
#include "ir/builder.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::ir::transform {

namespace {

constexpr double kInch = 25.4;
constexpr double kFoot = 0.3048;  // ft/min in m/min
constexpr std::string_view kAxisNames = "XYZABCUVW";

/// Where an axis stands on arrival at a block.
struct Position {
  enum class Kind : std::uint8_t { kNoWay, kUnknown, kKnown };
  Kind kind = Kind::kNoWay;
  LinearForm form;  // in the target's terms: diameter or radius, mm
};
using Positions = std::array<Position, kMaxAxes>;

/// What a block does to one axis.
enum class Step : std::uint8_t { kNone, kAbsolute, kIncremental, kLost };

/// What the programs below a call move and write.
struct Effects {
  std::uint16_t axes = 0;
  bool writes_shared = false;  // cells or variables that its caller sees
};

class Pass {
 public:
  Pass(Module& module, const Machine& source, const AbsoluteDimensionsConfig& config, diag::Sink& sink)
      : module_(module),
        source_(source),
        config_(config),
        sink_(sink),
        make_(module),
        graphs_(module),
        calls_(module),
        flow_(module, source, graphs_, calls_, {source.start, config.sub_entry}) {}

  bool Run();

 private:
  void FindEffects();
  bool RunProgram(ProgramId program);

  // Analysis of one program.
  [[nodiscard]] Step StepOf(BlockId block, std::uint8_t axis) const;
  [[nodiscard]] bool UsesPosition(BlockId block, std::uint8_t axis) const;
  void FindLive();
  void FindCarryLive();
  void Flow();
  /// Positions behind a block that is reached with `in`.
  void Through(BlockId block, Positions& positions, bool emit);
  /// The block moves and a modal call may be active: its program runs behind the block.
  [[nodiscard]] bool TriggersModal(ProgramId program, BlockId block) const;
  bool Join(BlockId block, Positions& at, const Positions& from);

  // Values.
  struct Scale {
    double factor = 1;  // source number -> target number
    bool incremental = false;
    bool known = true;
  };
  Scale ScaleOf(const Word& word, std::uint8_t axis, const ModalState& state, BlockId block, bool report);
  double UnitFactor(const ModalState& state) const {
    return state.units == Units::kInch || state.units == Units::kInchGeometry ? kInch : 1;
  }
  ExprId Scaled(ExprId value, double factor);
  [[nodiscard]] LinearForm ScaledForm(ExprId value, double factor) const {
    return Sum(module_, {}, FormOf(module_, value), factor);
  }
  ExprId Held(std::uint8_t axis);
  void Save(BlockId block, std::uint8_t axis, Position& position, bool before, bool emit);
  void RewriteWords(BlockId block, const Positions& in);
  void RewriteCenters(BlockId block, const Positions& in);
  void RewriteMachineWords(BlockId block);
  void DropModeWords();
  void Unknown(BlockId block, const Word& word, std::uint8_t axis);
  [[nodiscard]] bool ReadsPlace(const LinearForm& form, ExprId place) const;
  [[nodiscard]] bool ReadsShared(const LinearForm& form) const;
  [[nodiscard]] const Word* WordFor(BlockId block, std::uint8_t axis) const;
  [[nodiscard]] bool Conditional(const Block& block) const;
  [[nodiscard]] std::uint32_t IndexOf(BlockId block) const { return block.value - blocks_.begin; }

  Module& module_;
  const Machine& source_;
  const AbsoluteDimensionsConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowGraphs graphs_;
  analysis::CallGraph calls_;
  analysis::ModalFlow flow_;
  std::vector<Effects> effects_;  // per program
  Effects modal_;                 // of the programs that modal calls run

  // Of the program at hand.
  ProgramId program_;
  IdRange<BlockId> blocks_;
  std::vector<std::uint16_t> live_;        // per block: bit per axis whose position on arrival is used
  std::vector<std::uint16_t> carry_live_;  // bit per axis whose held position is used behind the block
  std::vector<std::uint16_t> carried_;     // bit per axis that arrives in its local
  std::vector<Positions> in_;
  std::array<VariableId, kMaxAxes> held_{};
  std::optional<ProgramEditor> editor_;
  std::vector<std::pair<WordId, Word>> rewritten_;  // axis words, changed when all blocks were looked at
  bool ok_ = true;
};

/// Words that make the axis words of their block something else than a move.
bool AxisWordsAreMoves(const Module& module, const Block& block) {
  for (const WordId id : block.words) {
    switch (module.words[id].op) {
      case WordOp::kFrame:
      case WordOp::kReference:
      case WordOp::kPole:
      case WordOp::kPresetPosition:
      case WordOp::kMachineCoords:
        return false;
      default:
        break;
    }
  }
  return true;
}

bool Has(const Module& module, const Block& block, WordOp op) {
  for (const WordId id : block.words) {
    if (module.words[id].op == op) return true;
  }
  return false;
}

const Word* Pass::WordFor(BlockId block, std::uint8_t axis) const {
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op == WordOp::kAxis && word.index == axis) return &word;
  }
  return nullptr;
}

bool Pass::Conditional(const Block& block) const {
  return block.skip_level != Block::kNoSkip || Has(module_, block, WordOp::kWhen) ||
         Has(module_, block, WordOp::kSkipRest);
}

void Pass::Unknown(BlockId block, const Word& word, std::uint8_t axis) {
  ok_ = false;
  sink_
      .Report(diag::Code::kUnknownPosition, module_.RangeOf(module_.blocks[block], word),
              std::string(1, kAxisNames[axis]))
      .help = "program the axis once with an absolute word before the increment, on every way that leads here";
}

bool Pass::TriggersModal(ProgramId program, BlockId id) const {
  if (!flow_.ModalCallPossible(program, id)) return false;
  for (const WordId word : module_.blocks[id].words) {
    if (DefaultPhaseOf(module_.words[word].op) == Phase::kMotion) return true;
  }
  return false;
}

void Pass::FindEffects() {
  effects_.assign(module_.programs.Size(), {});
  bool changed = true;
  while (changed) {
    changed = false;
    for (const Word& word : module_.words.All()) {
      if (word.op != WordOp::kModalCall || !word.Extra<CallId>().Valid()) continue;
      const ProgramId runs = module_.calls[word.Extra<CallId>()].program;
      const Effects below = runs.Valid() ? effects_[runs.value] : Effects{0xFFFF, true};
      modal_.axes = static_cast<std::uint16_t>(modal_.axes | below.axes);
      modal_.writes_shared = modal_.writes_shared || below.writes_shared;
    }
    for (const ProgramId program : module_.programs.Ids()) {
      Effects now = effects_[program.value];
      for (const BlockId block : module_.programs[program].blocks) {
        if (TriggersModal(program, block)) {
          now.axes = static_cast<std::uint16_t>(now.axes | modal_.axes);
          now.writes_shared = now.writes_shared || modal_.writes_shared;
        }
        for (const WordId id : module_.blocks[block].words) {
          const Word& word = module_.words[id];
          if (word.op == WordOp::kAxis) now.axes = static_cast<std::uint16_t>(now.axes | (1U << word.index));
          if (word.op == WordOp::kAxisComputed || word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius)
            now.axes = 0xFFFF;
          if (word.op == WordOp::kAssign) {
            const Expr& place = module_.exprs[word.Extra<ExprId>()];
            const bool own = (place.op == ExprOp::kVariable || place.op == ExprOp::kElement) &&
                             module_.variables[VariableId{place.a}].owner == program &&
                             !module_.variables[VariableId{place.a}].by_reference;
            now.writes_shared = now.writes_shared || !own;
          }
          if (word.op == WordOp::kCall || word.op == WordOp::kModalCall) {
            const auto call = word.Extra<CallId>();
            if (!call.Valid()) continue;
            const ProgramId callee = module_.calls[call].program;
            const Effects below = callee.Valid() ? effects_[callee.value] : Effects{0xFFFF, true};
            now.axes = static_cast<std::uint16_t>(now.axes | below.axes);
            now.writes_shared = now.writes_shared || below.writes_shared;
          }
        }
      }
      Effects& known = effects_[program.value];
      if (now.axes != known.axes || now.writes_shared != known.writes_shared) {
        known = now;
        changed = true;
      }
    }
  }
}

Pass::Scale Pass::ScaleOf(const Word& word, std::uint8_t axis, const ModalState& state, BlockId block, bool report) {
  Scale scale;
  // Where no way leads, nothing runs under any mode.
  const bool reached = flow_.Reached(program_, block);
  const auto unknown = [&](std::string_view group) {
    scale.known = false;
    if (!report || !reached) return;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[block], word), group,
                 "the programs that lead here leave it open");
  };
  bool diameter = false;  // the number is a diameter
  const bool transverse = axis == source_.transverse_axis;
  switch (word.mode) {
    case ValueMode::kModal:
      if (state.distance == Distance::kUnknown) unknown("the distance mode (absolute or incremental)");
      scale.incremental = state.distance == Distance::kIncremental;
      break;
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      scale.incremental = true;
      break;
    default:
      break;
  }
  switch (word.mode) {
    case ValueMode::kAbsoluteDiameter:
    case ValueMode::kIncrementalDiameter:
      diameter = true;
      break;
    case ValueMode::kAbsoluteRadius:
    case ValueMode::kIncrementalRadius:
      break;
    default:
      if (!transverse) break;
      if (state.diameter == Diameter::kUnknown) unknown("the diameter mode");
      diameter = state.diameter == Diameter::kDiameter ||
                 (state.diameter == Diameter::kDiameterAbsolute && !scale.incremental);
      break;
  }
  const bool wants_diameter = axis == config_.diameter_axis;
  scale.factor = wants_diameter == diameter ? 1 : wants_diameter ? 2 : 0.5;
  if (!IsRotary(axis)) scale.factor *= UnitFactor(state);
  return scale;
}

Step Pass::StepOf(BlockId id, std::uint8_t axis) const {
  const Block& block = module_.blocks[id];
  const Word* word = WordFor(id, axis);
  const auto plane_axes = [&] {
    return Has(module_, block, WordOp::kPolarAngle) || Has(module_, block, WordOp::kPolarRadius) ||
           Has(module_, block, WordOp::kOpeningAngle) || Has(module_, block, WordOp::kContourAngle);
  };
  for (const WordId word_id : block.words) {
    const Word& call = module_.words[word_id];
    if ((call.op != WordOp::kCall && call.op != WordOp::kModalCall) || !call.Extra<CallId>().Valid()) continue;
    const ProgramId callee = module_.calls[call.Extra<CallId>()].program;
    const std::uint16_t axes = callee.Valid() ? effects_[callee.value].axes : 0xFFFF;
    if (axes >> axis & 1U) return Step::kLost;
  }
  if (Has(module_, block, WordOp::kAxisComputed) || plane_axes())
    return word != nullptr && !plane_axes() ? Step::kAbsolute : Step::kLost;
  if (Has(module_, block, WordOp::kFrame) || Has(module_, block, WordOp::kWorkOffset) ||
      Has(module_, block, WordOp::kPresetPosition)) {
    // The zero point moves: what the axis stands at is another number now.
    if (word == nullptr || !AxisWordsAreMoves(module_, block)) return Step::kLost;
  }
  if (word == nullptr) return Step::kNone;
  if (!AxisWordsAreMoves(module_, block)) return Step::kLost;
  switch (word->mode) {
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      return Step::kIncremental;
    case ValueMode::kModal:
      return flow_.At(program_, id).distance == Distance::kIncremental ? Step::kIncremental : Step::kAbsolute;
    default:
      return Step::kAbsolute;
  }
}

bool Pass::UsesPosition(BlockId id, std::uint8_t axis) const {
  if (StepOf(id, axis) == Step::kIncremental) return true;
  for (const WordId word : module_.blocks[id].words) {
    const Word& center = module_.words[word];
    if (center.op == WordOp::kCenter && center.index == axis && center.mode == ValueMode::kAbsolute) return true;
  }
  return false;
}

/// Backward: is the position on arrival used before an absolute word sets the axis again?
void Pass::FindLive() {
  live_.assign(blocks_.count, 0);
  std::vector<std::uint16_t> uses(blocks_.count, 0), sets(blocks_.count, 0);
  for (std::uint32_t i = 0; i < blocks_.count; ++i) {
    for (std::uint8_t axis = 0; axis < kMaxAxes; ++axis) {
      if (UsesPosition(blocks_[i], axis)) uses[i] = static_cast<std::uint16_t>(uses[i] | (1U << axis));
      const Step step = StepOf(blocks_[i], axis);
      const bool always = !Conditional(module_.blocks[blocks_[i]]);
      if ((step == Step::kAbsolute || step == Step::kLost) && always)
        sets[i] = static_cast<std::uint16_t>(sets[i] | (1U << axis));
    }
  }
  const analysis::Cfg& graph = graphs_.Of(program_);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = blocks_.count; i-- > 0;) {
      std::uint16_t behind = 0;
      for (const analysis::Edge& edge : graph.Successors(blocks_[i])) {
        if (edge.to.Valid()) behind = static_cast<std::uint16_t>(behind | live_[IndexOf(edge.to)]);
        if (edge.kind == analysis::EdgeKind::kComputed) behind = 0xFFFF;
      }
      const auto now = static_cast<std::uint16_t>(uses[i] | (behind & ~sets[i]));
      changed = changed || now != live_[i];
      live_[i] = now;
    }
  }
}

/// Backward: does a block that takes the position from its local follow before the axis is named again?
void Pass::FindCarryLive() {
  std::vector<std::uint16_t> arrives(blocks_.count, 0);
  carry_live_.assign(blocks_.count, 0);
  const analysis::Cfg& graph = graphs_.Of(program_);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = blocks_.count; i-- > 0;) {
      std::uint16_t behind = 0;
      for (const analysis::Edge& edge : graph.Successors(blocks_[i])) {
        if (edge.to.Valid()) behind = static_cast<std::uint16_t>(behind | arrives[IndexOf(edge.to)]);
      }
      std::uint16_t named = 0;
      for (std::uint8_t axis = 0; axis < kMaxAxes; ++axis) {
        if (StepOf(blocks_[i], axis) != Step::kNone) named = static_cast<std::uint16_t>(named | (1U << axis));
      }
      const auto now = static_cast<std::uint16_t>(carried_[i] | (behind & ~named));
      changed = changed || now != arrives[i] || behind != carry_live_[i];
      arrives[i] = now;
      carry_live_[i] = behind;
    }
  }
}

ExprId Pass::Held(std::uint8_t axis) {
  if (!held_[axis].Valid())
    held_[axis] = NewLocal(module_, program_, fmt::format("POS_{}", kAxisNames[axis]), Type::kReal);
  return make_.Variable(held_[axis]);
}

bool Pass::ReadsPlace(const LinearForm& form, ExprId place) const {
  const Expr& target = module_.exprs[place];
  const bool target_cell = target.op == ExprOp::kCell || target.op == ExprOp::kCellAt;
  bool reads = false;
  for (const LinearForm::Term& term : form.terms) {
    VisitReads(module_, term.atom, [&](ExprId id) {
      const Expr& read = module_.exprs[id];
      const bool read_cell = read.op == ExprOp::kCell || read.op == ExprOp::kCellAt;
      if (read_cell != target_cell) return;
      if (!read_cell) {
        reads = reads || read.a == target.a;
        return;
      }
      const bool both_fixed = read.op == ExprOp::kCell && target.op == ExprOp::kCell;
      reads = reads || !both_fixed || (read.a == target.a && read.b == target.b);
    });
  }
  return reads;
}

bool Pass::ReadsShared(const LinearForm& form) const {
  bool shared = false;
  for (const LinearForm::Term& term : form.terms) {
    VisitReads(module_, term.atom, [&](ExprId id) {
      const Expr& read = module_.exprs[id];
      const bool own = (read.op == ExprOp::kVariable || read.op == ExprOp::kElement) &&
                       module_.variables[VariableId{read.a}].owner == program_ &&
                       !module_.variables[VariableId{read.a}].by_reference;
      shared = shared || !own;
    });
  }
  return shared;
}

/// The position goes to its local, before or behind the block; from there on it is what the local holds.
void Pass::Save(BlockId id, std::uint8_t axis, Position& position, bool before, bool emit) {
  const ExprId held = Held(axis);
  const LinearForm there = FormOf(module_, held);
  if (emit && !SameForm(module_, position.form, there)) {
    Word word;
    word.op = WordOp::kAssign;
    word.phase = DefaultPhaseOf(WordOp::kAssign);
    word.extra = held.value;
    word.value = ExprOf(module_, position.form);
    Block made = editor_->MakeBlock(id);
    editor_->SetWords(made, {word});
    if (before) {
      // The new block takes the place that jumps go to.
      Block& block = module_.blocks[id];
      made.label = std::exchange(block.label, StringId{});
      made.number = std::exchange(block.number, Block::kNoNumber);
      made.number_digits = block.number_digits;
      editor_->InsertBefore(id, made);
    } else {
      editor_->InsertAfter(id, made);
    }
  }
  position.form = there;
}

void Pass::Through(BlockId id, Positions& positions, bool emit) {
  const std::uint32_t index = IndexOf(id);
  const Block block = module_.blocks[id];
  // What the block writes may stand in a sum that is used later.
  bool calls_shared = false;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<CallId>().Valid()) {
      const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
      calls_shared = calls_shared || !callee.Valid() || effects_[callee.value].writes_shared;
    }
  }
  std::uint16_t live_behind = 0;
  for (const analysis::Edge& edge : graphs_.Of(program_).Successors(id)) {
    if (edge.to.Valid()) live_behind = static_cast<std::uint16_t>(live_behind | live_[IndexOf(edge.to)]);
  }
  for (std::uint8_t axis = 0; axis < kMaxAxes; ++axis) {
    Position& position = positions[axis];
    if (position.kind != Position::Kind::kKnown || ((live_[index] | live_behind) >> axis & 1U) == 0) continue;
    bool changes = calls_shared && ReadsShared(position.form);
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kAssign) changes = changes || ReadsPlace(position.form, word.Extra<ExprId>());
      if (word.op == WordOp::kFor)
        changes = changes || ReadsPlace(position.form, module_.fors[word.Extra<ForId>()].variable);
    }
    // The counter of FOR changes at its ENDFOR too.
    if (Has(module_, block, WordOp::kEndFor) && block.link.Valid()) {
      for (const WordId word_id : module_.blocks[block.link].words) {
        const Word& word = module_.words[word_id];
        if (word.op == WordOp::kFor)
          changes = changes || ReadsPlace(position.form, module_.fors[word.Extra<ForId>()].variable);
      }
    }
    if (changes) Save(id, axis, position, true, emit);
  }
  if (emit) RewriteWords(id, positions);
  const ModalState state = flow_.At(program_, id);
  for (std::uint8_t axis = 0; axis < kMaxAxes; ++axis) {
    Position& position = positions[axis];
    const Step step = StepOf(id, axis);
    if (step == Step::kNone) continue;
    const Position before = position;
    if (step == Step::kLost) {
      position = {Position::Kind::kUnknown, {}};
      continue;
    }
    const Word& word = *WordFor(id, axis);
    const Scale scale = ScaleOf(word, axis, state, id, false);
    if (!scale.known || (step == Step::kIncremental && position.kind != Position::Kind::kKnown)) {
      position = {Position::Kind::kUnknown, {}};
      continue;
    }
    const LinearForm value = ScaledForm(word.value, scale.factor);
    position.form = step == Step::kIncremental ? Sum(module_, position.form, value) : value;
    position.kind = Position::Kind::kKnown;
    if (Conditional(block) &&
        !(before.kind == Position::Kind::kKnown && SameForm(module_, before.form, position.form))) {
      position = {Position::Kind::kUnknown, {}};  // the block may be skipped
      continue;
    }
    if (carry_live_[index] >> axis & 1U) Save(id, axis, position, false, emit);
  }
  if (!TriggersModal(program_, id)) return;
  // The program of the modal call moves on from there, and may change what a sum reads.
  for (std::uint8_t axis = 0; axis < kMaxAxes; ++axis) {
    Position& position = positions[axis];
    const bool moved = (modal_.axes >> axis & 1U) != 0;
    const bool changed = modal_.writes_shared && position.kind == Position::Kind::kKnown && ReadsShared(position.form);
    if (position.kind != Position::Kind::kNoWay && (moved || changed)) position = {Position::Kind::kUnknown, {}};
  }
}

/// Takes the positions of one way into those of the block; true if they changed.
bool Pass::Join(BlockId block, Positions& at, const Positions& from) {
  bool changed = false;
  const std::uint32_t index = IndexOf(block);
  for (std::uint8_t axis = 0; axis < kMaxAxes; ++axis) {
    Position& position = at[axis];
    const Position& other = from[axis];
    if (other.kind == Position::Kind::kNoWay) continue;
    if ((carried_[index] >> axis & 1U) && other.kind == Position::Kind::kKnown &&
        position.kind != Position::Kind::kUnknown) {
      if (position.kind == Position::Kind::kNoWay) {
        position = {Position::Kind::kKnown, FormOf(module_, Held(axis))};
        changed = true;
      }
      continue;
    }
    if (position.kind == Position::Kind::kNoWay) {
      position = other;
      changed = true;
    } else if (position.kind == Position::Kind::kKnown && other.kind == Position::Kind::kUnknown) {
      position = other;
      changed = true;
    } else if (position.kind == Position::Kind::kKnown && !SameForm(module_, position.form, other.form)) {
      if (live_[index] >> axis & 1U) {
        carried_[index] = static_cast<std::uint16_t>(carried_[index] | (1U << axis));
        position.form = FormOf(module_, Held(axis));
      } else {
        position = {Position::Kind::kUnknown, {}};
      }
      changed = true;
    }
  }
  return changed;
}

void Pass::Flow() {
  const analysis::Cfg& graph = graphs_.Of(program_);
  std::vector<std::uint16_t> carried_before;
  do {
    carried_before = carried_;
    FindCarryLive();
    in_.assign(blocks_.count, Positions{});
    if (blocks_.count == 0) return;
    for (Position& position : in_[0]) position.kind = Position::Kind::kUnknown;
    std::set<std::uint32_t> work{0};
    // As soon as a place is found where a local must hold the position, all is followed anew: sums found on the way
    // there were those of one way only.
    while (!work.empty() && carried_ == carried_before) {
      const std::uint32_t index = *work.begin();
      work.erase(work.begin());
      Positions positions = in_[index];
      Through(blocks_[index], positions, false);
      for (const analysis::Edge& edge : graph.Successors(blocks_[index])) {
        if (edge.to.Valid()) {
          if (Join(edge.to, in_[IndexOf(edge.to)], positions)) work.insert(IndexOf(edge.to));
          continue;
        }
        if (edge.kind != analysis::EdgeKind::kComputed) continue;
        Positions nowhere;
        for (Position& position : nowhere) position.kind = Position::Kind::kUnknown;
        for (const BlockId target : graph.ComputedTargets()) {
          if (Join(target, in_[IndexOf(target)], nowhere)) work.insert(IndexOf(target));
        }
      }
    }
  } while (carried_ != carried_before);
}

ExprId Pass::Scaled(ExprId value, double factor) {
  return factor == 1 ? value : ExprOf(module_, ScaledForm(value, factor));
}

void Pass::RewriteCenters(BlockId id, const Positions& in) {
  const ModalState state = flow_.At(program_, id);
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op == WordOp::kRadius || word.op == WordOp::kChamfer ||
        (word.op == WordOp::kCenter && word.mode != ValueMode::kAbsolute)) {
      word.value = Scaled(word.value, UnitFactor(state));
    } else if (word.op == WordOp::kFeed && state.units == Units::kInch && state.feed_mode != FeedMode::kInverseTime) {
      word.value = Scaled(word.value, kInch);
    } else if (word.op == WordOp::kSpeed && state.units == Units::kInch &&
               state.speed_mode == SpeedMode::kConstantSurface) {
      // A number is checked where it is printed; a computed one would be rounded to whole m/min unseen.
      if (!FormOf(module_, word.value).IsConstant()) {
        ok_ = false;
        sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[id], word),
                     "a computed surface speed in ft/min", "whole m/min");
      }
      word.value = Scaled(word.value, kFoot);
    } else if (word.op == WordOp::kCenter) {
      // From the start point; a target's centre words are radius values on every axis.
      const std::uint8_t axis = word.index;
      if (in[axis].kind != Position::Kind::kKnown) {
        Unknown(id, word, axis);
        continue;
      }
      const bool diameter = axis == source_.transverse_axis && source_.centers_are_diameter_when_absolute &&
                            (state.diameter == Diameter::kDiameter || state.diameter == Diameter::kDiameterAbsolute);
      const LinearForm center = ScaledForm(word.value, (diameter ? 0.5 : 1) * UnitFactor(state));
      word.value = ExprOf(module_, Sum(module_, center, in[axis].form, axis == config_.diameter_axis ? -0.5 : -1));
      word.mode = ValueMode::kStep;
    } else {
      continue;
    }
    module_.words[word_id] = word;
  }
}

/// Machine coordinates are absolute whatever the distance mode; their unit and diameters are those of the block.
void Pass::RewriteMachineWords(BlockId id) {
  const ModalState state = flow_.At(program_, id);
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op != WordOp::kAxis) continue;
    const Scale scale = ScaleOf(word, word.index, state, id, true);
    if (!scale.known) continue;
    if (scale.incremental) {
      Unknown(id, word, word.index);
      continue;
    }
    word.value = Scaled(word.value, scale.factor);
    rewritten_.emplace_back(word_id, word);
  }
}

void Pass::RewriteWords(BlockId id, const Positions& in) {
  if (Has(module_, module_.blocks[id], WordOp::kMachineCoords)) return RewriteMachineWords(id);
  if (!AxisWordsAreMoves(module_, module_.blocks[id])) return;
  RewriteCenters(id, in);
  const ModalState state = flow_.At(program_, id);
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op != WordOp::kAxis) continue;
    const Scale scale = ScaleOf(word, word.index, state, id, true);
    if (!scale.known) continue;
    if (!scale.incremental) {
      word.value = Scaled(word.value, scale.factor);
    } else if (in[word.index].kind == Position::Kind::kKnown) {
      word.value = ExprOf(module_, Sum(module_, in[word.index].form, ScaledForm(word.value, scale.factor)));
    } else {
      Unknown(id, word, word.index);
      continue;
    }
    rewritten_.emplace_back(word_id, word);
  }
}

void Pass::DropModeWords() {
  ProgramEditor editor(module_, program_, "absolute_dimensions");
  for (const BlockId id : module_.programs[program_].blocks) {
    Block& block = module_.blocks[id];
    std::vector<Word> kept;
    bool dropped = false;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kDistance || word.op == WordOp::kDiameter || word.op == WordOp::kUnits) {
        dropped = true;
      } else {
        kept.push_back(word);
      }
    }
    if (!dropped) continue;
    Block changed = block;
    editor.SetWords(changed, kept);
    module_.blocks[id].words = changed.words;
    if (kept.empty() && !block.label.Valid() && block.number == Block::kNoNumber && block.comments.Empty())
      editor.Remove(id);
  }
  editor.Apply();
}

bool Pass::RunProgram(ProgramId program) {
  program_ = program;
  blocks_ = module_.programs[program].blocks;
  held_ = {};
  carried_.assign(blocks_.count, 0);
  FindLive();
  Flow();
  editor_.emplace(module_, program, "absolute_dimensions");
  rewritten_.clear();
  for (std::uint32_t i = 0; i < blocks_.count; ++i) {
    if (in_[i][0].kind == Position::Kind::kNoWay) {
      // No way leads here: the increments are those of dead text. They are taken from the modes as they stand.
      Positions positions = in_[i];
      RewriteWords(blocks_[i], positions);
      continue;
    }
    Positions positions = in_[i];
    Through(blocks_[i], positions, true);
  }
  for (const auto& [id, word] : rewritten_) {
    module_.words[id] = word;
    module_.words[id].mode = ValueMode::kAbsolute;
  }
  editor_->Apply();
  return ok_;
}

bool Pass::Run() {
  FindEffects();
  for (const ProgramId program : module_.programs.Ids()) RunProgram(program);
  if (!ok_) return false;
  for (const ProgramId program : module_.programs.Ids()) {
    program_ = program;
    DropModeWords();
  }
  return true;
}

}  // namespace

bool AbsoluteDimensions(Module& module, const Machine& source, const AbsoluteDimensionsConfig& config,
                        diag::Sink& sink) {
  return Pass(module, source, config, sink).Run();
}

}  // namespace ncport::ir::transform
