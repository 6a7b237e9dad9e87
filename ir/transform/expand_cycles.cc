#include "ir/transform/expand_cycles.h"

#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

constexpr std::uint32_t kUnset = 0xFFFFFFFFU, kOpen = 0xFFFFFFFEU;
constexpr auto kNoCycle = static_cast<std::uint32_t>(Cycle::kNone);
constexpr std::uint32_t kCallers = 0xFFFFFFFDU;  // none, or one of a caller that is not known

enum Field : std::uint8_t { kLevel, kDepth, kStep, kDwell, kFields };

/// What holds at a place: the cycle, and an expression for each of its data (a literal, or a local).
struct Drilling {
  std::uint32_t cycle = kNoCycle;
  std::uint32_t fields[kFields] = {kUnset, kUnset, kUnset, kUnset};
  bool initial = false;  // the local holds the level at which the cycle began
  bool operator==(const Drilling&) const = default;
};

bool IsHole(std::uint32_t cycle) {
  return cycle >= static_cast<std::uint32_t>(Cycle::kDrill) && cycle <= static_cast<std::uint32_t>(Cycle::kBoreManual);
}

class Pass {
 public:
  // The data flow.
  using State = Drilling;
  [[nodiscard]] State Entry(ProgramId program) const {
    return {.cycle = module_.programs[program].kind == ProgramKind::kMain ? kNoCycle : kCallers};
  }
  [[nodiscard]] State Unknown(ProgramId) const { return {.cycle = kOpen}; }
  bool Join(BlockId, State& into, const State& from) const {
    const State before = into;
    const auto untouched = [](std::uint32_t cycle) { return cycle == kNoCycle || cycle == kCallers; };
    const auto join = [](std::uint32_t& a, std::uint32_t b) { a = a == b ? a : kOpen; };
    const bool callers = into.cycle != from.cycle && untouched(into.cycle) && untouched(from.cycle);
    join(into.cycle, from.cycle);
    if (callers) into.cycle = kCallers;
    for (std::uint8_t i = 0; i < kFields; ++i) join(into.fields[i], from.fields[i]);
    into.initial = into.initial && from.initial;
    return into != before;
  }
  void Transfer(ProgramId program, BlockId id, State& state) {
    program_ = program;
    const ModalState at = flow_.At(program, id);
    Store(PartsOf(id, AxesOf(at.plane).normal, IsHole(state.cycle)), at.distance == Distance::kIncremental, state,
          nullptr);
  }
  /// Locals do not travel, nor do cycles: a call under one is refused where it stands. A modal call may run under one;
  /// then moves of its program are.
  [[nodiscard]] std::optional<State> Into(const analysis::CallSite&, analysis::CallMoment moment,
                                          const State& at) const {
    if (moment == analysis::CallMoment::kModalStart) return std::nullopt;
    if (!IsHole(at.cycle)) return State{.cycle = at.cycle};
    return moment == analysis::CallMoment::kModalRun ? Unknown({}) : State{};
  }
  [[nodiscard]] State Back(const analysis::CallSite&, const State& at, const State& exit) const {
    if (exit.cycle == kCallers) return at;
    return {.cycle = exit.cycle == kNoCycle ? kNoCycle : kOpen};
  }

  Pass(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink)
      : module_(module),
        source_(source),
        config_(config),
        sink_(sink),
        make_(module),
        analyses_(module, source, {source.start, config.sub_entry}),
        flow_(analyses_.Modal()),
        drilling_(analyses_.Sources(), *this),
        locals_(module.programs.Size()) {}

  bool Run() {
    bool any = false;
    for (const ProgramId program : module_.programs.Ids()) any = UsesHoles(program) || any;
    if (!any) return true;
    for (const analysis::CallSite& site : analyses_.Calls().AllSites()) {
      if (site.callee.Valid()) called_.insert(site.callee.value);
    }
    drilling_.Run();
    for (const ProgramId program : module_.programs.Ids()) Expand(program);
    return ok_;
  }

 private:
  [[nodiscard]] bool UsesHoles(ProgramId program) const {
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId id : module_.blocks[block].words) {
        if (module_.words[id].op == WordOp::kCycle && IsHole(module_.words[id].index)) return true;
      }
    }
    return false;
  }

  void Refuse(const Block& block, std::string_view what) {
    ok_ = false;
    // Passes before this one may have made several blocks of one: one finding for it.
    if (block.origin.Valid() && !refused_.insert(block.origin.value).second) return;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, "a language without drilling modes");
  }

  /// What a block says about holes.
  struct Parts {
    std::uint32_t cycle = kUnset;
    bool motion = false, level = false;
    const Word* values[kFields] = {};  // as written
    const Word* repeats = nullptr;
    std::vector<Word> place;  // axis words but the depth
    bool geometry = false;    // a place or a depth
  };

  [[nodiscard]] Parts PartsOf(BlockId id, std::uint8_t normal, bool in_cycle) const {
    Parts parts;
    const Block& block = module_.blocks[id];
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kCycle) parts.cycle = word.index;
      if (word.op == WordOp::kMotion) parts.motion = true;
    }
    const bool holes = parts.cycle != kUnset ? IsHole(parts.cycle) : in_cycle && !parts.motion;
    if (!holes) return parts;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      switch (word.op) {
        case WordOp::kAxis:
          if (word.index == normal) {
            parts.values[kDepth] = &module_.words[word_id];
          } else {
            parts.place.push_back(word);
          }
          parts.geometry = parts.geometry || word.index < 3;
          break;
        case WordOp::kRadius:
          parts.values[kLevel] = &module_.words[word_id];
          break;
        case WordOp::kCenter:
          if (word.index == 2) parts.repeats = &module_.words[word_id];
          break;
        case WordOp::kCycleValue:
          switch (static_cast<CycleField>(word.index)) {
            case CycleField::kLevel:
              parts.values[kLevel] = &module_.words[word_id];
              break;
            case CycleField::kStep:
              parts.values[kStep] = &module_.words[word_id];
              break;
            case CycleField::kDwell:
              parts.values[kDwell] = &module_.words[word_id];
              break;
            case CycleField::kRepeats:
              parts.repeats = &module_.words[word_id];
              break;
            default:
              break;
          }
          break;
        default:
          break;
      }
    }
    return parts;
  }

  ExprId Local(std::uint8_t field) {
    static constexpr std::string_view kNames[] = {"U_LEVEL", "U_DEPTH", "U_PECK", "U_DWELL"};
    ExprId& local = locals_[program_.value].fields[field];
    if (!local.Valid()) local = make_.Variable(NewLocal(module_, program_, kNames[field], Type::kReal));
    return local;
  }
  ExprId Initial() {
    ExprId& local = locals_[program_.value].initial;
    if (!local.Valid()) local = make_.Variable(NewLocal(module_, program_, "U_INITIAL", Type::kReal));
    return local;
  }

  /// A field of the state as a number; none: it has to be worked out, or is not there.
  [[nodiscard]] std::optional<double> LiteralOf(ExprId id) const {
    return id.value == kUnset || id.value == kOpen ? std::nullopt : LiteralValue(module_, id);
  }

  /// Data of the block as expressions; `assigns`: what must be computed in front of it.
  void Store(const Parts& parts, bool incremental, State& state, std::vector<std::pair<ExprId, ExprId>>* assigns) {
    if (parts.cycle != kUnset) {
      if (!IsHole(parts.cycle) || !IsHole(state.cycle)) state = {};
      state.cycle = parts.cycle;
    } else if (parts.motion) {
      state = {};
    }
    if (!IsHole(state.cycle)) return;
    // A place, a depth or a level begins the first hole: there the initial level is taken.
    bool begins = parts.geometry;
    for (const Word* value : parts.values) begins = begins || value != nullptr;
    if (begins && !state.initial) {
      state.initial = true;
      if (assigns != nullptr) {
        assigns->emplace_back(Initial(), ExprId{});
      } else {
        static_cast<void>(Initial());
      }
    }
    for (std::uint8_t field = 0; field < kFields; ++field) {
      const Word* word = parts.values[field];
      if (word == nullptr) continue;
      const bool step = field == kDepth && word->mode == ValueMode::kIncremental;
      const bool adds = (incremental && (field == kLevel || field == kDepth)) || step;
      if (LiteralOf(word->value) && !adds) {
        state.fields[field] = word->value.value;
        continue;
      }
      state.fields[field] = Local(field).value;
      if (assigns == nullptr) continue;
      const ExprId base = field == kLevel ? Initial() : ExprId{state.fields[kLevel]};
      assigns->emplace_back(Local(field), adds ? make_.Binary(ExprOp::kAdd, base, word->value) : word->value);
    }
  }

  void Expand(ProgramId program) {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    for (const BlockId id : blocks) {
      if (called_.contains(program.value) && LeavesUnderCycle(program, id))
        Refuse(module_.blocks[id], "a return while a drilling cycle is in force");
    }
    program_ = program;
    ProgramEditor editor(module_, program, "expand_cycles");
    for (const BlockId id : blocks) {
      if (const State* before = drilling_.Before(id)) MapBlock(id, *before, editor);
    }
    editor.Apply();
  }

  [[nodiscard]] bool LeavesUnderCycle(ProgramId program, BlockId id) {
    const State* before = drilling_.Before(id);
    if (before == nullptr) return false;
    State state = *before;
    Transfer(program, id, state);
    if (analysis::WaysOf(module_, module_.blocks[id]).conditional) Join({}, state, *before);
    if (state.cycle == kNoCycle || state.cycle == kCallers) return false;
    for (const analysis::Edge& edge : analyses_.Graphs().Of(program).Successors(id)) {
      if (edge.kind == analysis::EdgeKind::kReturn || edge.kind == analysis::EdgeKind::kReturnToTarget ||
          edge.kind == analysis::EdgeKind::kTextEnd)
        return true;
    }
    return false;
  }

  static bool IsHoleWord(const Word& word) {
    return word.op == WordOp::kCycle || word.op == WordOp::kCycleValue || word.op == WordOp::kReturnLevel;
  }

  void MapBlock(BlockId id, const State& before, ProgramEditor& editor) {
    const Block block = module_.blocks[id];
    const ModalState at = flow_.At(program_, id);
    const std::uint8_t normal = AxesOf(at.plane).normal;
    const bool open = before.cycle == kOpen || before.cycle == kCallers;
    const Parts parts = PartsOf(id, normal, IsHole(before.cycle));
    bool moves = false, says = false;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      moves = moves || word.op == WordOp::kAxis;
      says = says || IsHoleWord(word);
      const bool call = word.op == WordOp::kCall || word.op == WordOp::kModalCall;
      const bool elsewhere =
          word.op == WordOp::kReference || word.op == WordOp::kMachineCoords || word.op == WordOp::kFrame;
      if ((call && parts.cycle != kUnset && IsHole(parts.cycle)) || ((call || elsewhere) && IsHole(before.cycle)))
        return Refuse(block, "a call, shift or reference move while a drilling cycle is in force");
    }
    // A subprogram that begins with moves relies on its callers to have no cycle in force; so does this one.
    if (open && parts.cycle == kUnset && !parts.motion && moves)
      return Refuse(block, "a move under a cycle of the caller");
    State state = before;
    std::vector<std::pair<ExprId, ExprId>> assigns;
    Store(parts, at.distance == Distance::kIncremental, state, &assigns);
    if (!IsHole(state.cycle)) {
      if (!says) return;
      return EndCycle(id, block, before, at, editor);
    }
    Holes(id, block, parts, state, assigns, at, normal, editor);
  }

  /// G80: the motion mode is again what it was before the cycle, whatever the expanded moves left.
  void EndCycle(BlockId id, const Block& block, const State& before, const ModalState& at, ProgramEditor& editor) {
    std::vector<Word> words;
    bool motion = false;
    for (const WordId word_id : block.words) motion = motion || module_.words[word_id].op == WordOp::kMotion;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (!IsHoleWord(word)) {
        words.push_back(word);
        continue;
      }
      if (word.op != WordOp::kCycle) continue;
      if (word.index != static_cast<std::uint8_t>(Cycle::kNone)) {
        words.push_back(word);  // no hole: another pass, or refused
      } else if (!motion && before.cycle != kNoCycle) {
        if (at.motion == Motion::kUnknown) return Refuse(block, "the end of a cycle behind an unknown motion mode");
        words.push_back(MotionWord(at.motion));
      }
    }
    Block changed = block;
    editor.SetWords(changed, words);
    module_.blocks[id].words = changed.words;
    if (words.empty()) editor.Remove(id);
  }

  static Word MotionWord(Motion motion) { return MakeWord(WordOp::kMotion, motion); }

  void Holes(BlockId id, const Block& block, const Parts& parts, const State& state,
             const std::vector<std::pair<ExprId, ExprId>>& assigns, const ModalState& at, std::uint8_t normal,
             ProgramEditor& editor) {
    if (at.plane == Plane::kUnknown || at.distance == Distance::kUnknown)
      return Refuse(block, "a drilling cycle whose plane or distance mode is not one here");
    std::vector<Word> first, last;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      const bool of_hole = IsHoleWord(word) || word.op == WordOp::kAxis || word.op == WordOp::kRadius ||
                           (word.op == WordOp::kCenter && word.index == 2);
      if (of_hole) continue;
      if (word.op == WordOp::kCenter) return Refuse(block, "centre words in a cycle");
      if (word.op == WordOp::kDwellSeconds) return Refuse(block, "a dwell beside a cycle");
      const bool behind = word.phase == Phase::kAfter || word.phase == Phase::kLast;
      (behind ? last : first).push_back(word);
    }
    bool start = true;
    const auto put = [&](const std::vector<Word>& words) {
      Block made = editor.MakeBlock(id);
      made.skip_level = block.skip_level;
      if (start) {
        made.number = block.number;
        made.number_digits = block.number_digits;
        made.label = block.label;
        made.comments = block.comments;
      }
      start = false;
      editor.SetWords(made, words);
      editor.InsertBefore(id, made);
    };
    const auto finish = [&] {
      if (!last.empty()) put(last);
      if (start) put({});
      module_.blocks[id].comments = {};
      module_.blocks[id].label = {};
      module_.blocks[id].number = Block::kNoNumber;
      editor.Remove(id);
    };
    for (const auto& [local, value] : assigns) {
      const ExprId now = value.Valid() ? value : make_.System(config_.position, {make_.AxisName(normal)});
      put({MakeAssignment(local, now)});
    }
    if (!parts.geometry && parts.values[kLevel] == nullptr) {
      if (!parts.place.empty()) {
        first.push_back(MotionWord(Motion::kRapid));
        first.insert(first.end(), parts.place.begin(), parts.place.end());
      }
      if (!first.empty()) put(first);
      return finish();
    }
    double repeats = 1;
    if (parts.repeats != nullptr) {
      const auto count = LiteralOf(parts.repeats->value);
      if (!count || *count < 0 || *count > 9999) return Refuse(block, "a computed number of repetitions");
      repeats = std::round(*count);
    }
    if (state.fields[kLevel] >= kOpen || state.fields[kDepth] >= kOpen)
      return Refuse(block, "a drilling cycle whose level or depth is not one on all ways here");
    if (at.return_level == ReturnLevel::kUnknown)
      return Refuse(block, "a drilling cycle whose return level is not known");
    if (repeats == 0) {
      if (!first.empty()) put(first);
      return finish();
    }
    if (repeats > 1) {
      if (block.skip_level != Block::kNoSkip) return Refuse(block, "repetitions of a cycle in a skipped block");
      if (!first.empty()) put(first);
      first.clear();
      const ExprId turn = make_.Variable(NewLocal(module_, program_, "U_TURN", Type::kReal));
      put({MakeAssignment(turn, make_.Number("0"))});
      Expr less = module_.exprs[make_.Binary(ExprOp::kLess, turn, make_.Literal(repeats, Type::kInt))];
      less.flags |= Expr::kTolerance;  // whole numbers
      put({MakeWord(WordOp::kWhile, 0, module_.AddExpr(less))});
      if (!Hole(block, parts, state, at, normal, first, put)) return;
      put({MakeAssignment(turn, make_.Binary(ExprOp::kAdd, turn, make_.Number("1")))});
      put({MakeWord(WordOp::kEndWhile)});
    } else if (!Hole(block, parts, state, at, normal, first, put)) {
      return;
    }
    finish();
  }

  /// One hole, as exec::Kinematics::DrillHole makes it.
  template <class Put>
  bool Hole(const Block& block, const Parts& parts, const State& state, const ModalState& at, std::uint8_t normal,
            std::vector<Word> first, const Put& put) {
    const ExprId level{state.fields[kLevel]}, depth{state.fields[kDepth]};
    const auto axis = [&](ExprId value) {
      Word word = MakeWord(WordOp::kAxis, normal, value);
      word.mode = at.distance == Distance::kIncremental ? ValueMode::kAbsolute : ValueMode::kModal;
      return word;
    };
    const auto rapid = [&](ExprId value) { put(std::vector<Word>{MotionWord(Motion::kRapid), axis(value)}); };
    const auto feed = [&](ExprId value) { put(std::vector<Word>{MotionWord(Motion::kLinear), axis(value)}); };
    const auto back = [&] { rapid(at.return_level == ReturnLevel::kInitial ? Initial() : level); };
    const auto spindle = [&](SpindleState sense) {
      put(std::vector<Word>{MakeWord(WordOp::kSpindle, 0, {}, static_cast<std::uint32_t>(sense))});
    };
    const auto pause = [&]() -> bool {
      if (state.fields[kDwell] == kUnset) return true;
      const auto seconds = LiteralOf(ExprId{state.fields[kDwell]});
      if (!seconds) {
        Refuse(block, "a computed dwell of a cycle");
        return false;
      }
      if (*seconds > 0) put(std::vector<Word>{MakeWord(WordOp::kDwellSeconds, 0, ExprId{state.fields[kDwell]})});
      return true;
    };
    if (at.units == Units::kUnknown) {
      Refuse(block, "a drilling cycle whose unit of lengths is not known");
      return false;
    }
    if (!parts.place.empty()) {
      first.push_back(MotionWord(Motion::kRapid));
      first.insert(first.end(), parts.place.begin(), parts.place.end());
    }
    if (!first.empty()) put(first);
    rapid(level);
    switch (static_cast<Cycle>(state.cycle)) {
      case Cycle::kDrill:
        feed(depth);
        break;
      case Cycle::kDrillDwell:
        feed(depth);
        if (!pause()) return false;
        break;
      case Cycle::kPeck:
      case Cycle::kPeckChip:
        if (!Pecks(block, state, MmPerLengthUnit(at.units), rapid, feed)) return false;
        break;
      case Cycle::kTap:
      case Cycle::kTapLeft: {
        if (state.fields[kStep] != kUnset) {
          Refuse(block, "tapping with pecks");
          return false;
        }
        const bool left = state.cycle == static_cast<std::uint32_t>(Cycle::kTapLeft);
        feed(depth);
        if (!pause()) return false;
        spindle(left ? SpindleState::kCw : SpindleState::kCcw);
        feed(level);
        spindle(left ? SpindleState::kCcw : SpindleState::kCw);
        break;
      }
      case Cycle::kBoreFeed:
        feed(depth);
        feed(level);
        break;
      case Cycle::kBoreDwell:
        feed(depth);
        if (!pause()) return false;
        feed(level);
        break;
      default:
        Refuse(block, "this drilling cycle, whose way the text does not tell,");
        return false;
    }
    back();
    return true;
  }

  template <class Move>
  bool Pecks(const Block& block, const State& state, double unit, const Move& rapid, const auto& feed) {
    const ExprId level_expr{state.fields[kLevel]};
    const auto level = LiteralOf(level_expr), depth = LiteralOf(ExprId{state.fields[kDepth]});
    const double size = std::fabs(LiteralOf(ExprId{state.fields[kStep]}).value_or(0));
    if (!level || !depth || size == 0 || std::fabs(*depth - *level) / size > config_.most_pecks) {
      Refuse(block, "peck drilling with computed data, or in more steps than are written out,");
      return false;
    }
    const bool full = state.cycle == static_cast<std::uint32_t>(Cycle::kPeck);
    const double down = *depth < *level ? -1 : 1;
    // The machine's clearances are mm, words are what the units in force say.
    const double clearance = (full ? source_.peck_clearance : source_.chip_back_off) / unit;
    double reached = *level;
    for (int turn = 1;; ++turn) {
      double next = *level + down * size * turn;
      const bool last = (next - *depth) * down >= -1e-9;
      if (last) next = *depth;
      if (turn > 1) {
        if (full) rapid(level_expr);
        rapid(make_.Literal(reached - down * clearance));
      }
      feed(last ? ExprId{state.fields[kDepth]} : make_.Literal(next));
      reached = next;
      if (last) return true;
    }
  }

  Module& module_;
  const Machine& source_;
  const ExpandCyclesConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& flow_;
  analysis::ForwardFlow<Pass> drilling_;
  std::set<std::uint32_t> called_;  // programs
  ProgramId program_;
  struct Locals {
    ExprId fields[kFields], initial;
  };
  std::vector<Locals> locals_;  // per program
  bool ok_ = true;
  std::set<std::uint32_t> refused_;  // origins of blocks
};

}  // namespace

bool ExpandCycles(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink) {
  return Pass(module, source, config, sink).Run();
}

}  // namespace ncport::ir::transform
