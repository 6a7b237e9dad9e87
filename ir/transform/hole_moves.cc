#include "ir/transform/hole_moves.h"

#include <cmath>
#include <optional>

#include "ir/length_units.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/transform/new_local.h"

namespace ncport::ir::transform {

namespace {

constexpr double kAlarmNumber = 65000;  // the first of those that users have and that stop the program

std::optional<double> LiteralOf(const Module& module, ExprId id) {
  return id.Valid() ? LiteralValue(module, id) : std::nullopt;
}

}  // namespace

void HoleMoves::Rapid(const Hole& hole, ExprId target, const Put& put) {
  Word axis = MakeWord(WordOp::kAxis, hole.normal, target);
  axis.mode = hole.incremental ? ValueMode::kAbsolute : ValueMode::kModal;
  put({MakeWord(WordOp::kMotion, Motion::kRapid), axis});
}

void HoleMoves::Feed(const Hole& hole, ExprId target, const Put& put, Motion motion) {
  Word axis = MakeWord(WordOp::kAxis, hole.normal, target);
  axis.mode = hole.incremental ? ValueMode::kAbsolute : ValueMode::kModal;
  put({MakeWord(WordOp::kMotion, motion), axis});
}

ExprId HoleMoves::Compare(ExprOp op, ExprId left, ExprId right) {
  Expr made = module_.exprs[make_.Binary(op, left, right)];
  made.flags |= Expr::kTolerance;
  return module_.AddExpr(made);
}

/// A dwell of 0 is none.
std::string_view HoleMoves::Pause(const Hole& hole, const Put& put) {
  if (!hole.dwell.Valid()) return {};
  const auto seconds = LiteralOf(module_, hole.dwell);
  if (seconds && *seconds <= 0) return {};
  if (!seconds && hole.skipped) return "a computed dwell of a cycle in a skipped block";
  if (!seconds) put({MakeWord(WordOp::kIf, 0, Compare(ExprOp::kGreater, hole.dwell, make_.Number("0")))});
  put({MakeWord(WordOp::kDwellSeconds, 0, hole.dwell)});
  if (!seconds) put({MakeWord(WordOp::kEndIf)});
  return {};
}

std::string_view HoleMoves::Make(ProgramId program, const Hole& hole, const Put& put) {
  const auto spindle = [&](SpindleState sense) {
    put({MakeWord(WordOp::kSpindle, 0, {}, static_cast<std::uint32_t>(sense))});
  };
  const auto feed = [&](ExprId target) { Feed(hole, target, put); };
  std::string_view wrong;
  Rapid(hole, hole.level, put);
  switch (hole.cycle) {
    case Cycle::kDrill:
      feed(hole.depth);
      break;
    case Cycle::kDrillDwell:
      feed(hole.depth);
      wrong = Pause(hole, put);
      break;
    case Cycle::kPeck:
    case Cycle::kPeckChip:
      wrong = Pecks(program, hole, put);
      break;
    case Cycle::kTap:
    case Cycle::kTapLeft: {
      const auto step = LiteralOf(module_, hole.step);
      if (hole.step.Valid() && (!step || *step != 0)) return "tapping with pecks";
      if (hole.spindle == SpindleState::kStop || hole.spindle == SpindleState::kPositioned)
        return "tapping with a spindle that stands still";
      const bool left = hole.cycle == Cycle::kTapLeft;
      // No plain feed move: the override of the feed, or a stop, would break the tap in the hole.
      Feed(hole, hole.depth, put, Motion::kTapFloating);
      wrong = Pause(hole, put);
      spindle(left ? SpindleState::kCw : SpindleState::kCcw);
      Feed(hole, hole.level, put, Motion::kTapFloating);
      spindle(left ? SpindleState::kCcw : SpindleState::kCw);
      break;
    }
    case Cycle::kBoreFeed:
      feed(hole.depth);
      feed(hole.level);
      break;
    case Cycle::kBoreDwell:
      feed(hole.depth);
      wrong = Pause(hole, put);
      feed(hole.level);
      break;
    case Cycle::kBoreStop: {
      if (hole.spindle == SpindleState::kUnknown)
        return "a bore behind which the spindle turns in a direction not known here";
      feed(hole.depth);
      spindle(SpindleState::kStop);
      Rapid(hole, hole.back, put);
      if (hole.spindle == SpindleState::kCw || hole.spindle == SpindleState::kCcw) spindle(hole.spindle);
      return {};
    }
    case Cycle::kRigidTap:
    case Cycle::kRigidTapLeft:
      return "rigid tapping";
    default:
      return "this drilling cycle, whose way the text does not tell,";
  }
  if (wrong.empty()) Rapid(hole, hole.back, put);
  return wrong;
}

/// The machine's clearances are mm, words are what the units in force say.
double HoleMoves::Clearance(const Hole& hole) const {
  return (hole.cycle == Cycle::kPeck ? source_.peck_clearance : source_.chip_back_off) / MmPerLengthUnit(hole.units);
}

std::string_view HoleMoves::Pecks(ProgramId program, const Hole& hole, const Put& put) {
  const auto level = LiteralOf(module_, hole.level), depth = LiteralOf(module_, hole.depth),
             step = LiteralOf(module_, hole.step);
  if (!hole.step.Valid() || step == 0.0) return "peck drilling without a depth of cut";  // an alarm there
  if (level && depth && step && std::fabs(*depth - *level) / std::fabs(*step) <= most_pecks_) {
    WrittenPecks(hole, *level, *depth, std::fabs(*step), put);
    return {};
  }
  return CountedPecks(program, hole, put);
}

void HoleMoves::WrittenPecks(const Hole& hole, double level, double depth, double step, const Put& put) {
  const double down = depth < level ? -1 : 1;
  double reached = level;
  for (int turn = 1;; ++turn) {
    double next = level + down * step * turn;
    const bool last = (next - depth) * down >= -1e-9;
    if (last) next = depth;
    if (turn > 1) {
      if (hole.cycle == Cycle::kPeck) Rapid(hole, hole.level, put);
      Rapid(hole, make_.Literal(reached - down * Clearance(hole)), put);
    }
    Feed(hole, last ? hole.depth : make_.Literal(next), put);
    reached = next;
    if (last) return;
  }
}

/// The pecks as a loop: their number is known when it runs.
std::string_view HoleMoves::CountedPecks(ProgramId program, const Hole& hole, const Put& put) {
  if (hole.skipped) return "peck drilling with computed data in a skipped block";
  Locals& locals = locals_[program.value];
  const auto local = [&](ExprId& id, std::string_view name) {
    if (!id.Valid()) id = make_.Variable(NewLocal(module_, program, name, Type::kReal));
    return id;
  };
  const ExprId side = local(locals.side, "U_SIDE"), next = local(locals.next, "U_NEXT"),
               count = local(locals.count, "U_COUNT");
  const auto mark = [&](WordOp op, ExprId condition = {}) { put({MakeWord(op, 0, condition)}); };
  const auto binary = [&](ExprOp op, ExprId a, ExprId b) { return make_.Binary(op, a, b); };
  const auto set = [&](ExprId place, ExprId value) { put({MakeAssignment(place, value)}); };
  // 1 upwards, -1 downwards
  set(side, make_.Number("1"));
  mark(WordOp::kIf, Compare(ExprOp::kLess, hole.depth, hole.level));
  set(side, make_.Number("-1"));
  mark(WordOp::kEndIf);
  const auto given = LiteralOf(module_, hole.step);
  if (!given) {
    // The control stops there, this loop would not end.
    mark(WordOp::kIf, Compare(ExprOp::kEqual, hole.step, make_.Number("0")));
    put({MakeWord(WordOp::kAlarm, AlarmKind::kStops, make_.Literal(kAlarmNumber, Type::kInt),
                  make_.Text("Q OF PECK DRILLING IS 0").value)});
    mark(WordOp::kEndIf);
  }
  const auto advance = [&] {
    const ExprId size = given ? make_.Literal(std::fabs(*given)) : make_.Function(ir::Function::kAbs, {hole.step});
    set(next,
        binary(ExprOp::kAdd, hole.level, binary(ExprOp::kMultiply, binary(ExprOp::kMultiply, side, size), count)));
    const ExprId behind = binary(ExprOp::kMultiply, side, Group(binary(ExprOp::kSubtract, next, hole.depth)));
    mark(WordOp::kIf, Compare(ExprOp::kGreater, behind, make_.Number("-0.000000001")));
    set(next, hole.depth);
    mark(WordOp::kEndIf);
    Feed(hole, next, put);
  };
  set(count, make_.Number("1"));
  advance();
  mark(WordOp::kWhile, Compare(ExprOp::kNotEqual, next, hole.depth));
  if (hole.cycle == Cycle::kPeck) Rapid(hole, hole.level, put);
  Rapid(hole, binary(ExprOp::kSubtract, next, binary(ExprOp::kMultiply, side, make_.Literal(Clearance(hole)))), put);
  set(count, binary(ExprOp::kAdd, count, make_.Number("1")));
  advance();
  mark(WordOp::kEndWhile);
  return {};
}

}  // namespace ncport::ir::transform
