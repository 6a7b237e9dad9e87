#include "prove/compare.h"

#include <algorithm>
#include <cmath>

#include "prove/comparer.h"

namespace ncport::prove {

void LeaveToOperator(ir::ModalState& start) {
  start.work_offset = {};
  start.path = ir::PathMode::kUnknown;
}

using exec::Event;
using exec::EventKind;

namespace {

std::string_view KindName(EventKind kind) {
  switch (kind) {
    case EventKind::kRapid:
      return "a rapid move";
    case EventKind::kLine:
      return "a straight feed move";
    case EventKind::kArc:
      return "an arc";
    case EventKind::kThread:
      return "a thread";
    case EventKind::kTap:
      return "tapping";
    case EventKind::kRapidMachine:
      return "a move in machine coordinates";
    case EventKind::kReference:
      return "a reference point approach";
    case EventKind::kProbe:
      return "probing";
    case EventKind::kDwell:
      return "a dwell";
    case EventKind::kSpindle:
      return "a spindle start or stop";
    case EventKind::kSpindleSpeed:
      return "a spindle speed";
    case EventKind::kSpindleSurface:
      return "a surface speed";
    case EventKind::kSpindleLimit:
      return "a speed limit";
    case EventKind::kSpindlePosition:
      return "a spindle position";
    case EventKind::kTool:
      return "a tool";
    case EventKind::kOffset:
      return "a tool offset";
    case EventKind::kComp:
      return "cutter compensation";
    case EventKind::kWorkOffset:
      return "a work offset";
    case EventKind::kPath:
      return "a path mode";
    case EventKind::kAux:
      return "an M function";
    case EventKind::kMessage:
      return "a message";
    case EventKind::kPrint:
      return "a printed line";
    case EventKind::kStop:
    case EventKind::kOptionalStop:
      return "a stop";
    case EventKind::kAlarm:
      return "an alarm";
    case EventKind::kEnd:
      return "its end";
    case EventKind::kSetVariable:
      return "a final value";
    case EventKind::kData:
      return "data for the machine";
  }
  return "an event";
}

}  // namespace

void Comparer::CompareEnds(const Event& a, const Event& b) {
  if (a.kind == EventKind::kAlarm) {
    result_.source_alarmed_before_motion = source_.MotionsDone() == 0;
    if (b.added && source_.MotionsDone() == 0) return;  // a guard that the report lists
    // Alarms without a number are known by their class alone.
    const bool by_class = options_.maps.cross_language || a.code.empty() || b.code.empty();
    const bool agree = by_class ? a.alarm == b.alarm : a.code == b.code;
    if (!agree) Fail(&a, &b, fmt::format("alarm {} became alarm {}", a.code, b.code));
  }
}

void Comparer::ComparePair(const Event& a, const Event& b) {
  if (a.kind != b.kind) {
    return Fail(&a, &b, fmt::format("the source has {} here, the target {}", KindName(a.kind), KindName(b.kind)));
  }
  switch (a.kind) {
    case EventKind::kRapid:
    case EventKind::kLine:
    case EventKind::kArc:
    case EventKind::kThread:
    case EventKind::kTap:
    case EventKind::kRapidMachine:
    case EventKind::kProbe:
    case EventKind::kReference:
      if (a.kind != EventKind::kReference) ComparePositions(a, b);
      if (!Failed()) CompareMotionDetails(a, b);
      if (!Failed()) CompareCompensation(a, b);
      if (!Failed() && IsCutting(a.kind)) CompareSpindles(a, b, source_.SpindlesNow(), target_.SpindlesNow());
      if (!Failed() && (IsCutting(a.kind) || ((options_.maps.separate_registers || options_.maps.source_registers) &&
                                              a.kind == EventKind::kRapid)))
        CompareToolState(a, b);
      if (!Failed()) CompareWorkOffset(a, b);
      if (!Failed()) ComparePath(a, b);
      if (!Failed() && a.kind == EventKind::kRapid && source_.SpindlesNow() != target_.SpindlesNow())
        ++result_.spindle_moved_across_rapid;
      source_.MotionDone(a);
      target_.MotionDone(b);
      break;
    case EventKind::kDwell:
      if (a.per_revolution != b.per_revolution) return Fail(&a, &b, "seconds and revolutions differ in a dwell");
      CompareNumber(a, b, a.value, b.value, "the dwell");
      if (!Failed()) CompareSpindlesNow(a, b);
      break;
    case EventKind::kStop:
    case EventKind::kOptionalStop:
      CompareSpindlesNow(a, b);
      break;
    case EventKind::kTool:
      CompareTool(a, b);
      if (!Failed() && !a.tool_waits) CompareSpindlesAtChange(a, b);
      break;
    case EventKind::kOffset:
      if (a.offset != b.offset || a.number != b.number || a.length_minus != b.length_minus)
        Fail(&a, &b, "another offset is selected");
      break;
    case EventKind::kComp:
      if (a.comp != b.comp) Fail(&a, &b, "cutter compensation differs");
      break;
    case EventKind::kAux: {
      const auto pair = std::find_if(options_.maps.aux.begin(), options_.maps.aux.end(),
                                     [&](const AuxPair& aux) { return aux.source == a.number; });
      const std::uint32_t expected = pair == options_.maps.aux.end() ? a.number : pair->target.value_or(a.number);
      if (expected != b.number) Fail(&a, &b, fmt::format("M{} became M{}", a.number, b.number));
      if (!Failed() && a.tool_change) CompareSpindlesAtChange(a, b);
      break;
    }
    case EventKind::kSpindlePosition:
      CompareNumber(a, b, a.value, b.value, "the spindle position");
      break;
    case EventKind::kMessage:
    case EventKind::kPrint:
      if (a.text != b.text) Fail(&a, &b, fmt::format("the text \"{}\" became \"{}\"", a.text, b.text));
      break;
    case EventKind::kData:
      if (a.text != b.text) Fail(&a, &b, fmt::format("the data {} became {}", a.text, b.text));
      break;
    case EventKind::kAlarm:
      CompareEnds(a, b);
      break;
    case EventKind::kEnd:
      CompareSpindles(a, b, source_.SpindlesWithoutAdded(), target_.SpindlesWithoutAdded());
      if (!Failed()) CompareWorkOffset(a, b);
      if (!Failed()) ComparePath(a, b);
      break;
    default:
      break;
  }
}

/// A rapid that the report lists as split: the target's pieces are walked until the position is reached.
bool Comparer::SkipSplitRapid(const Event& a) {
  if (a.kind != EventKind::kRapid || options_.maps.split_rapids.empty()) return false;
  if (std::find(options_.maps.split_rapids.begin(), options_.maps.split_rapids.end(), a.block.value) ==
      options_.maps.split_rapids.end()) {
    return false;
  }
  const Event* piece = target_.Next();
  while (piece != nullptr && piece->kind == EventKind::kRapid) {
    bool there = (a.known_axes & ~piece->known_axes) == 0;  // an axis that is still unknown comes with a later piece
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      if ((a.known_axes & piece->known_axes) >> axis & 1U) {
        there = there && std::fabs(a.position[axis] - piece->position[axis]) <= Allowed(a, *piece, axis);
      }
    }
    if (there) return false;  // the last piece is compared as the rapid itself
    target_.MotionDone(*piece);
    target_.Advance();
    piece = target_.Next();
  }
  Fail(&a, piece, "the pieces of a split rapid do not end where it does");
  return true;
}

Comparison Comparer::Run() {
  while (!Failed()) {
    const Event* a = source_.Next();
    if (a != nullptr && SkipSplitRapid(*a)) break;
    const Event* b = target_.Next();
    if (source_.Complaint()) Fail(a, b, *source_.Complaint() + " (source)");
    if (target_.Complaint()) Fail(a, b, *target_.Complaint() + " (target)");
    if (Failed() || (a == nullptr && b == nullptr)) break;
    if (a == nullptr) {
      Fail(nullptr, b, "the target does more than the source");
      break;
    }
    if (a->kind == EventKind::kAlarm && source_.MotionsDone() == 0) result_.source_alarmed_before_motion = true;
    if (b == nullptr) {
      Fail(a, nullptr, "the target ends before the source");
      break;
    }
    ComparePair(*a, *b);
    ++result_.events_compared;
    source_.Advance();
    target_.Advance();
  }
  const std::uint16_t moving = static_cast<std::uint16_t>(lonely_source_moving_ | lonely_target_moving_);
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes && !Failed(); ++axis) {
    if (moving >> axis & 1U) Fail(nullptr, nullptr, fmt::format("{} moves on one side only", AxisName(axis)));
  }
  return result_;
}

Comparison Compare(const RecordedTrace& source, const RecordedTrace& target, const CompareOptions& options,
                   const ir::WorkOffset& target_start, const ir::WorkOffset& source_start) {
  return Comparer(source, target, options, target_start, source_start).Run();
}

}  // namespace ncport::prove
