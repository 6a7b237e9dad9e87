#include "ir/transform/expand_cycles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/transform/drilling_flow.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

class Pass {
 public:
  Pass(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink)
      : module_(module),
        source_(source),
        config_(config),
        sink_(sink),
        make_(module),
        analyses_(module, source, {source.start, config.sub_entry}),
        flow_(analyses_.Modal()),
        drilling_(module, analyses_) {}

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

  void Expand(ProgramId program) {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    for (const BlockId id : blocks) {
      if (called_.contains(program.value) && LeavesUnderCycle(program, id))
        Refuse(module_.blocks[id], "a return while a drilling cycle is in force");
    }
    program_ = program;
    ProgramEditor editor(module_, program, "expand_cycles");
    for (const BlockId id : blocks) {
      if (const Drilling* before = drilling_.Before(id)) MapBlock(id, *before, editor);
    }
    // A refusal may have come in the middle of a block's moves.
    if (ok_) editor.Apply();
  }

  [[nodiscard]] bool LeavesUnderCycle(ProgramId program, BlockId id) {
    const Drilling* before = drilling_.Before(id);
    if (before == nullptr) return false;
    Drilling state = *before;
    drilling_.Transfer(program, id, state);
    if (analysis::WaysOf(module_, module_.blocks[id]).conditional) drilling_.Join({}, state, *before);
    if (state.cycle == Drilling::kNoCycle || state.cycle == Drilling::kCallers) return false;
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

  void MapBlock(BlockId id, const Drilling& before, ProgramEditor& editor) {
    const Block block = module_.blocks[id];
    const ModalState at = flow_.At(program_, id);
    const std::uint8_t normal = AxesOf(at.plane).normal;
    const bool open = before.cycle == Drilling::kOpen || before.cycle == Drilling::kCallers;
    const DrillingWords parts = drilling_.WordsOf(id, normal, IsHole(before.cycle));
    bool moves = false, says = false;
    const bool ends = parts.motion || parts.cycle == Drilling::kNoCycle;
    const bool under = (IsHole(before.cycle) || before.cycle == Drilling::kOpen) && !ends;
    if (under && flow_.Before(program_, id).units != at.units)
      return Refuse(block, "a change of the unit while a drilling cycle is in force");
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if ((under || IsHole(parts.cycle)) && word.op == WordOp::kWorkOffset && at.return_level != ReturnLevel::kRPlane &&
          flow_.Before(program_, id).work_offset != at.work_offset)
        return Refuse(block, "a change of the work offset in a cycle that goes back to its start level");
      moves = moves || word.op == WordOp::kAxis;
      says = says || IsHoleWord(word);
      const bool call = word.op == WordOp::kCall || word.op == WordOp::kModalCall;
      const bool elsewhere =
          word.op == WordOp::kReference || word.op == WordOp::kMachineCoords || word.op == WordOp::kFrame;
      if ((call && parts.cycle != Drilling::kUnset && IsHole(parts.cycle)) ||
          ((call || elsewhere) && IsHole(before.cycle)))
        return Refuse(block, "a call, shift or reference move while a drilling cycle is in force");
    }
    // A subprogram that begins with moves relies on its callers to have no cycle in force; so does this one.
    if (open && parts.cycle == Drilling::kUnset && !parts.motion && moves)
      return Refuse(block, "a move under a cycle of the caller");
    Drilling state = before;
    std::vector<std::pair<ExprId, ExprId>> assigns;
    drilling_.Store(program_, parts, at.distance == Distance::kIncremental, state, &assigns);
    if (!IsHole(state.cycle)) {
      if (!says) return;
      return EndCycle(id, block, before, at, editor);
    }
    Holes(id, block, parts, state, assigns, at, normal, editor);
  }

  /// G80: the motion mode is again what it was before the cycle, whatever the expanded moves left.
  void EndCycle(BlockId id, const Block& block, const Drilling& before, const ModalState& at, ProgramEditor& editor) {
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
      } else if (!motion && before.cycle != Drilling::kNoCycle) {
        if (at.motion == Motion::kUnknown) return Refuse(block, "the end of a cycle behind an unknown motion mode");
        words.push_back(MotionWord(at.motion));
      }
    }
    editor.SetWords(id, words);
    if (words.empty()) editor.Remove(id);
  }

  static Word MotionWord(Motion motion) { return MakeWord(WordOp::kMotion, motion); }

  void Holes(BlockId id, const Block& block, const DrillingWords& parts, const Drilling& state,
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
      start = false;
      editor.PutInFront(id, words, {.comments = true});
    };
    const auto finish = [&] {
      if (!last.empty()) put(last);
      if (start) put({});
      editor.Remove(id);
    };
    // The level at which the cycle begins is read in the unit of the block.
    const bool settles = std::ranges::any_of(first, [](const Word& word) { return word.op == WordOp::kUnits; });
    if (settles && !assigns.empty()) {
      put(first);
      first.clear();
    }
    for (const auto& [local, value] : assigns) {
      const ExprId now = value.Valid() ? value : make_.System(config_.position, {make_.AxisName(normal)});
      put({MakeAssignment(local, now)});
    }
    if (!parts.geometry && parts.values[Drilling::kLevel] == nullptr) {
      if (!parts.place.empty()) {
        first.push_back(MotionWord(Motion::kRapid));
        first.insert(first.end(), parts.place.begin(), parts.place.end());
      }
      if (!first.empty()) put(first);
      return finish();
    }
    double repeats = 1;
    if (parts.repeats != nullptr) {
      const auto count = drilling_.LiteralOf(parts.repeats->value);
      if (!count || *count < 0 || *count > 9999) return Refuse(block, "a computed number of repetitions");
      repeats = std::round(*count);
    }
    if (state.fields[Drilling::kLevel] >= Drilling::kOpen || state.fields[Drilling::kDepth] >= Drilling::kOpen)
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
  bool Hole(const Block& block, const DrillingWords& parts, const Drilling& state, const ModalState& at,
            std::uint8_t normal, std::vector<Word> first, const Put& put) {
    const ExprId level{state.fields[Drilling::kLevel]}, depth{state.fields[Drilling::kDepth]};
    const auto axis = [&](ExprId value) {
      Word word = MakeWord(WordOp::kAxis, normal, value);
      word.mode = at.distance == Distance::kIncremental ? ValueMode::kAbsolute : ValueMode::kModal;
      return word;
    };
    const auto rapid = [&](ExprId value) { put(std::vector<Word>{MotionWord(Motion::kRapid), axis(value)}); };
    const auto feed = [&](ExprId value) { put(std::vector<Word>{MotionWord(Motion::kLinear), axis(value)}); };
    const auto back = [&] { rapid(at.return_level == ReturnLevel::kInitial ? drilling_.Initial(program_) : level); };
    const auto spindle = [&](SpindleState sense) {
      put(std::vector<Word>{MakeWord(WordOp::kSpindle, 0, {}, static_cast<std::uint32_t>(sense))});
    };
    const auto pause = [&]() -> bool {
      if (state.fields[Drilling::kDwell] == Drilling::kUnset) return true;
      const auto seconds = drilling_.LiteralOf(ExprId{state.fields[Drilling::kDwell]});
      if (!seconds) {
        Refuse(block, "a computed dwell of a cycle");
        return false;
      }
      if (*seconds > 0)
        put(std::vector<Word>{MakeWord(WordOp::kDwellSeconds, 0, ExprId{state.fields[Drilling::kDwell]})});
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
        if (state.fields[Drilling::kStep] != Drilling::kUnset) {
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
  bool Pecks(const Block& block, const Drilling& state, double unit, const Move& rapid, const auto& feed) {
    const ExprId level_expr{state.fields[Drilling::kLevel]};
    const auto level = drilling_.LiteralOf(level_expr),
               depth = drilling_.LiteralOf(ExprId{state.fields[Drilling::kDepth]});
    const double size = std::fabs(drilling_.LiteralOf(ExprId{state.fields[Drilling::kStep]}).value_or(0));
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
      feed(last ? ExprId{state.fields[Drilling::kDepth]} : make_.Literal(next));
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
  DrillingFlow drilling_;
  std::set<std::uint32_t> called_;  // programs
  ProgramId program_;
  bool ok_ = true;
  std::set<std::uint32_t> refused_;  // origins of blocks
};

}  // namespace

bool ExpandCycles(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink) {
  return Pass(module, source, config, sink).Run();
}

}  // namespace ncport::ir::transform
