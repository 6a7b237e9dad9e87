#include "exec/trace_text.h"

#include "base/number_text.h"
#include "ir/axis_names.h"

namespace ncport::exec {
namespace {

constexpr int kDecimals = 6;
constexpr std::size_t kFlushAt = 1U << 16U;

void Number(TextBuffer& buffer, double value) { AppendTrimmed(buffer, value, kDecimals); }

void Word(TextBuffer& buffer, std::string_view name, double value) {
  buffer.Append(name);
  Number(buffer, value);
}

std::string_view AxisName(std::uint8_t axis, const ir::Module& module) {
  const std::string_view name = ir::AxisName(module, axis);
  return name.empty() ? "?" : name;
}

void Axes(TextBuffer& buffer, const Event& event, const ir::Module& module) {
  for (std::uint16_t rest = event.known_axes; rest != 0; rest &= static_cast<std::uint16_t>(rest - 1)) {
    const auto axis = static_cast<std::uint8_t>(__builtin_ctz(rest));
    buffer.Append(' ');
    buffer.Append(AxisName(axis, module));
    // X is always a radius; the `r` reminds of it while the program writes diameters.
    if (event.diameter_active && axis == event.transverse_axis) buffer.Append('r');
    if (axis >= ir::kFirstNamedAxis) buffer.Append('=');
    Number(buffer, event.position[axis]);
  }
}

void Feed(TextBuffer& buffer, const Event& event) {
  Word(buffer, " F", event.feed);
  if (event.feed_mode == ir::FeedMode::kPerRevolution) buffer.Append("/r");
  if (event.feed_mode == ir::FeedMode::kInverseTime) buffer.Append("/t");
}

std::string_view PlaneName(ir::Plane plane) {
  return plane == ir::Plane::kZX ? "ZX" : plane == ir::Plane::kYZ ? "YZ" : "XY";
}

void Arc(TextBuffer& buffer, const Event& event, const ir::Module& module) {
  buffer.Append(event.clockwise ? "ARC CW " : "ARC CCW ");
  buffer.Append(PlaneName(event.plane));
  Axes(buffer, event, module);
  buffer.Append(" center (");
  Number(buffer, event.center[0]);
  buffer.Append(',');
  Number(buffer, event.center[1]);
  buffer.Append(')');
  if (event.turns != 0) {
    buffer.Append(" turns ");
    AppendInteger(buffer, event.turns);
  }
  Feed(buffer, event);
}

void Thread(TextBuffer& buffer, const Event& event, const ir::Module& module) {
  buffer.Append(event.kind == EventKind::kTap ? "TAP" : "THREAD");
  Axes(buffer, event, module);
  Word(buffer, " pitch ", event.value);
  if (event.start_angle != 0) Word(buffer, " start ", event.start_angle);
  if (event.change != 0) Word(buffer, " change ", event.change);
}

void Spindle(TextBuffer& buffer, const Event& event) {
  buffer.Append("SPINDLE");
  if (event.spindle != 0) AppendInteger(buffer, event.spindle);
  switch (event.kind) {
    case EventKind::kSpindleSpeed:
      Word(buffer, " RPM ", event.value);
      break;
    case EventKind::kSpindleSurface:
      Word(buffer, " CSS ", event.value);
      break;
    case EventKind::kSpindleLimit:
      Word(buffer, " LIMIT ", event.value);
      break;
    case EventKind::kSpindlePosition:
      Word(buffer, " POS ", event.value);
      break;
    default:
      buffer.Append(event.spindle_state == ir::SpindleState::kCw    ? " CW"
                    : event.spindle_state == ir::SpindleState::kCcw ? " CCW"
                                                                    : " STOP");
      break;
  }
}

void Offset(TextBuffer& buffer, const Event& event) {
  buffer.Append("OFFSET");
  switch (event.offset) {
    case OffsetKind::kNone:
      buffer.Append(" NONE");
      return;
    case OffsetKind::kNumber:
      buffer.Append(' ');
      break;
    case OffsetKind::kEdge:
      buffer.Append(" EDGE ");
      break;
    case OffsetKind::kLength:
      buffer.Append(" LENGTH ");
      break;
    case OffsetKind::kRadius:
      buffer.Append(" RADIUS ");
      break;
  }
  AppendInteger(buffer, event.number);
  if (event.length_minus) buffer.Append(" MINUS");
}

void WorkOffset(TextBuffer& buffer, const Event& event) {
  buffer.Append("WCS ");
  if (event.number == 0) {
    buffer.Append("NONE");
    return;
  }
  AppendInteger(buffer, event.number);
  if (event.extension == 0) return;
  buffer.Append(".1P");
  AppendInteger(buffer, event.extension);
}

/// A line of text stays one line.
void Text(TextBuffer& buffer, std::string_view text) {
  if (text.empty()) return;
  buffer.Append(' ');
  for (const char c : text) buffer.Append(c == '\n' || c == '\r' ? ' ' : c);
}

void Aux(TextBuffer& buffer, const Event& event) {
  buffer.Append(event.text.empty() ? std::string_view{"M"} : event.text);
  if (event.extension != 0) {
    AppendInteger(buffer, event.extension);
    buffer.Append('=');
  }
  AppendInteger(buffer, event.number);
}

void Line(TextBuffer& buffer, const Event& event, const ir::Module& module) {
  switch (event.kind) {
    case EventKind::kRapid:
      buffer.Append("RAPID");
      return Axes(buffer, event, module);
    case EventKind::kLine:
    case EventKind::kProbe:
      buffer.Append(event.kind == EventKind::kLine ? "LINE" : "PROBE");
      Axes(buffer, event, module);
      return Feed(buffer, event);
    case EventKind::kArc:
      return Arc(buffer, event, module);
    case EventKind::kThread:
    case EventKind::kTap:
      return Thread(buffer, event, module);
    case EventKind::kRapidMachine:
      buffer.Append("RAPID MCS");
      return Axes(buffer, event, module);
    case EventKind::kReference:
      buffer.Append("REFPOINT");
      for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
        if ((event.moved_axes >> axis & 1U) == 0) continue;
        buffer.Append(' ');
        buffer.Append(AxisName(axis, module));
      }
      return;
    case EventKind::kDwell:
      Word(buffer, "DWELL ", event.value);
      if (event.per_revolution) buffer.Append("/r");
      return;
    case EventKind::kSpindle:
    case EventKind::kSpindleSpeed:
    case EventKind::kSpindleSurface:
    case EventKind::kSpindleLimit:
    case EventKind::kSpindlePosition:
      return Spindle(buffer, event);
    case EventKind::kTool:
      buffer.Append("TOOL ");
      if (event.text.empty()) {
        AppendInteger(buffer, event.number);
        if (event.extension == 0) return;
        buffer.Append('.');
        if (event.extension < 10) buffer.Append('0');
        return AppendInteger(buffer, event.extension);
      }
      buffer.Append('"');
      buffer.Append(event.text);
      return buffer.Append('"');
    case EventKind::kOffset:
      return Offset(buffer, event);
    case EventKind::kComp:
      return buffer.Append(event.comp == ir::CutterComp::kLeft    ? "COMP LEFT"
                           : event.comp == ir::CutterComp::kRight ? "COMP RIGHT"
                                                                  : "COMP OFF");
    case EventKind::kWorkOffset:
      return WorkOffset(buffer, event);
    case EventKind::kPath:
      return buffer.Append(event.path == ir::PathMode::kContinuous ? "PATH CONTINUOUS"
                           : event.path == ir::PathMode::kExact    ? "PATH EXACT"
                                                                   : "PATH UNKNOWN");
    case EventKind::kAux:
      return Aux(buffer, event);
    case EventKind::kMessage:
      buffer.Append("MSG");
      return Text(buffer, event.text);
    case EventKind::kPrint:
      buffer.Append("PRINT");
      return Text(buffer, event.text);
    case EventKind::kStop:
      return buffer.Append("STOP");
    case EventKind::kOptionalStop:
      return buffer.Append("OPTSTOP");
    case EventKind::kAlarm:
      buffer.Append("ALARM");
      Text(buffer, event.code.empty() ? std::string_view{"?"} : event.code);
      return Text(buffer, event.text);
    case EventKind::kEnd:
      return buffer.Append("END");
    case EventKind::kSetVariable:
      buffer.Append("SET");
      Text(buffer, event.text);
      return Text(buffer, event.code);
    case EventKind::kData:
      return;
  }
}

}  // namespace

void AppendTraceLine(TextBuffer& buffer, const Event& event, const ir::Module& module) {
  Line(buffer, event, module);
  buffer.Append('\n');
}

TraceWriter::TraceWriter(OutputSink& output, const ir::Module& module, TraceFormat format)
    : output_(output), module_(module), format_(format) {
  if (format_ == TraceFormat::kJson) buffer_.Append("{\"version\": 1, \"events\": [\n");
}

bool TraceWriter::OnEvent(const Event& event) {
  if (event.kind == EventKind::kPath && event.path == ir::PathMode::kUnknown) return true;
  if (event.kind == EventKind::kData) return true;
  if (format_ == TraceFormat::kText) {
    AppendTraceLine(buffer_, event, module_);
  } else {
    if (!first_) buffer_.Append(",\n");
    first_ = false;
    AppendTraceJson(buffer_, event, module_);
  }
  return buffer_.size() < kFlushAt || output_.Flush(buffer_).Ok();
}

Status TraceWriter::Finish() {
  if (format_ == TraceFormat::kJson) buffer_.Append("\n]}\n");
  return output_.Flush(buffer_);
}

}  // namespace ncport::exec
