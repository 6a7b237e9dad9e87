#include "exec/auxiliary.h"

#include <cmath>
#include <string>

#include "ir/length_units.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::WordOp;

namespace {

/// Decimals of a tool number as hundredths: which of the tools with this number (mazak-lathe-4.1).
std::uint32_t SuffixOf(double number) {
  constexpr std::uint32_t kHundred = 100;
  return static_cast<std::uint32_t>(std::lround((number - std::floor(number)) * kHundred)) % kHundred;
}

}  // namespace

/// A number as INT addresses take it: rounded, not negative.
std::uint32_t Auxiliary::Whole(const Value& value) {
  const double number = ir::ops::Round(evaluator_.ToNumber(value));
  if (number >= 0 && number <= 4294967295.0) return static_cast<std::uint32_t>(number);
  session_.Alarm(ir::AlarmClass::kRange, "number of a function is negative or too large");
  return 0;
}

Channel::Spindle* Auxiliary::SpindleOf(std::uint8_t index) {
  if (index < kSpindles) return &channel_.spindles[index];
  session_.Refuse(diag::Code::kCannotRun, fmt::format("spindle {}", index));
  return nullptr;
}

void Auxiliary::Act(const ir::Word& word, const Value& value, bool edge_follows) {
  const std::uint8_t number = Channel::SpindleByNumber(word.index);
  switch (word.op) {
    case WordOp::kSpeed: {
      const double speed = evaluator_.ToNumber(value);
      return Speed(word, (word.flags & ir::Word::kRoundsValue) != 0 ? ir::ops::Round(speed) : speed);
    }
    case WordOp::kSpeedLimit: {
      Channel::Spindle* const spindle = SpindleOf(number);
      if (spindle == nullptr) return;
      spindle->limit_known = true;
      spindle->limit = evaluator_.ToNumber(value);
      Event& event = emitter_.Begin(EventKind::kSpindleLimit);
      event.spindle = number;
      event.value = spindle->limit;
      return emitter_.Send(event);
    }
    case WordOp::kSpindle: {
      Channel::Spindle* const spindle = SpindleOf(number);
      if (spindle == nullptr) return;
      spindle->state = static_cast<ir::SpindleState>(word.extra);
      Event& event = emitter_.Begin(EventKind::kSpindle);
      event.spindle = number;
      event.spindle_state = spindle->state;
      return emitter_.Send(event);
    }
    case WordOp::kSpindlePosition: {
      Channel::Spindle* const spindle = SpindleOf(number);
      if (spindle == nullptr) return;
      spindle->state = ir::SpindleState::kPositioned;
      spindle->position = evaluator_.ToNumber(value);
      Event& event = emitter_.Begin(EventKind::kSpindlePosition);
      event.spindle = number;
      event.value = spindle->position;
      return emitter_.Send(event);
    }
    case WordOp::kTool:
      return Tool(value, edge_follows);
    case WordOp::kToolChange: {
      Event& event = emitter_.Begin(EventKind::kAux);
      event.number = 6;
      event.tool_change = true;
      emitter_.Send(event);
      if (!session_.linked.ToolWordChanges()) TakeTool(edge_follows);
      return;
    }
    case WordOp::kEdge:
      return Edge(Whole(value));
    case WordOp::kToolOffset:
      return Offset(OffsetKind::kNumber, Whole(value));
    case WordOp::kRadiusOffset:
      return Offset(OffsetKind::kRadius, Whole(value));
    case WordOp::kLengthOffset:
      if (word.value.Valid()) {
        if (!value.IsVacant()) Offset(OffsetKind::kLength, Whole(value));
      } else if (word.index == 0) {
        Offset(OffsetKind::kNone, 0);  // the word that switches it off
      }
      return;
    case WordOp::kAux:
    case WordOp::kAuxH: {
      Event& event = emitter_.Begin(EventKind::kAux);
      event.number = Whole(value);
      event.extension = word.index;
      if (word.op == WordOp::kAuxH) event.text = "H";
      return emitter_.Send(event);
    }
    case WordOp::kStop:
      return emitter_.Send(emitter_.Begin(EventKind::kStop));
    case WordOp::kOptionalStop:
      return emitter_.Send(emitter_.Begin(EventKind::kOptionalStop));
    default:
      return;
  }
}

/// 1/min or, under constant surface speed, m/min; from inch sources feet per minute.
void Auxiliary::Speed(const ir::Word& word, double value) {
  const std::uint8_t number = Channel::SpindleByNumber(word.index);
  Channel::Spindle* const spindle = SpindleOf(number);
  if (spindle == nullptr) return;
  if (channel_.modal.speed_mode == ir::SpeedMode::kUnknown) {
    return session_.Refuse(diag::Code::kUnknownModalState, "the meaning of the speed", "nothing in the run has set it");
  }
  // The surface speed belongs to the master spindle.
  const bool surface = channel_.modal.speed_mode == ir::SpeedMode::kConstantSurface && number == 0;
  if (surface && channel_.modal.units == ir::Units::kInch) value *= ir::kMetersPerFoot;
  spindle->speed_known = true;
  spindle->speed = value;
  if (surface) {
    spindle->surface_known = true;
    spindle->surface = value;
  }
  Event& event = emitter_.Begin(surface ? EventKind::kSpindleSurface : EventKind::kSpindleSpeed);
  event.spindle = number;
  event.value = value;
  emitter_.Send(event);
}

void Auxiliary::Tool(const Value& value, bool edge_follows) {
  const bool changes = session_.linked.ToolWordChanges();
  channel_.prepared_known = true;
  Event& event = emitter_.Begin(EventKind::kTool);
  event.tool_waits = !changes;
  if (value.IsText()) {
    channel_.prepared_name = evaluator_.TextOf(value);
    event.text = channel_.prepared_name;
  } else {
    channel_.prepared_name.clear();
    channel_.prepared_number = Whole(value);
    event.number = static_cast<std::uint32_t>(channel_.prepared_number);
    if (session_.machine.tool_suffix) event.extension = SuffixOf(evaluator_.ToNumber(value));
  }
  emitter_.Send(event);
  if (changes) TakeTool(edge_follows);
}

/// The tool that stands ready comes into the spindle. Its first edge becomes active where the machine says so
/// (sinumerik-8.8: MD20270), unless the block names another.
void Auxiliary::TakeTool(bool edge_follows) {
  channel_.tool_known = channel_.prepared_known;
  channel_.tool_number = channel_.prepared_number;
  channel_.tool_name = channel_.prepared_name;
  channel_.edge_known = false;
  if (session_.machine.tool_activates_edge && !edge_follows) Edge(1);
}

void Auxiliary::Edge(double number) {
  channel_.edge_known = true;
  channel_.edge = number;
  Offset(OffsetKind::kEdge, number);
}

void Auxiliary::TakeLengthSign(const ir::Word& word) {
  constexpr std::uint8_t kMinus = 2;
  if (!word.value.Valid() && word.index != 0) channel_.length_minus = word.index == kMinus;
}

/// Register 0 is no register: the offset is cancelled. A radius register of its own says nothing of the length.
void Auxiliary::Offset(OffsetKind kind, double number) {
  Event& event = emitter_.Begin(EventKind::kOffset);
  event.offset = number == 0 && kind != OffsetKind::kRadius ? OffsetKind::kNone : kind;
  event.length_minus = event.offset == OffsetKind::kLength && channel_.length_minus;
  event.number = static_cast<std::uint32_t>(number);
  emitter_.Send(event);
}

void Auxiliary::Message(const ir::Word& word, const Value& value) {
  if (word.op == WordOp::kAlarm) return Alarm(word, value);
  TextBuffer text;
  evaluator_.AppendText(text, value);
  Event& event = emitter_.Begin(word.op == WordOp::kPrint ? EventKind::kPrint : EventKind::kMessage);
  event.text = text.View();
  emitter_.Send(event);
}

/// Alarms of the program. Those that only show are messages; their text, or without one their number (contracts 5).
void Auxiliary::Alarm(const ir::Word& word, const Value& value) {
  const std::uint32_t number = Whole(value);
  TextBuffer text;
  if (word.extra != ir::ExprId::kNone) evaluator_.AppendText(text, evaluator_.Eval(word.Extra<ir::ExprId>()));
  if (session_.halted) return;
  bool shows = word.index == static_cast<std::uint8_t>(ir::AlarmKind::kShows);
  if (word.index == static_cast<std::uint8_t>(ir::AlarmKind::kByNumber)) {
    for (const ir::AlarmRange& range : session_.machine.shown_alarms)
      shows = shows || (number >= range.first && number <= range.last);
  }
  if (!shows) {
    session_.Alarm(ir::AlarmClass::kUser, text.View());
    session_.alarm_code = std::to_string(session_.ShownAlarm(number));
    return;
  }
  if (text.Empty()) text.Append(std::to_string(number));
  Event& event = emitter_.Begin(EventKind::kMessage);
  event.text = text.View();
  emitter_.Send(event);
}

}  // namespace ncport::exec
