// Events as JSON objects.
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "exec/trace_text.h"
#include "ir/axis_names.h"

namespace ncport::exec {
namespace {

constexpr int kDecimals = 9;

constexpr std::array<std::string_view, 28> kKinds = {
    "rapid", "line",   "arc",     "thread",      "tap",         "rapid-mcs",     "refpoint",
    "probe", "dwell",  "spindle", "spindle-rpm", "spindle-css", "spindle-limit", "spindle-pos",
    "tool",  "offset", "comp",    "wcs",         "path",        "aux",           "msg",
    "print", "stop",   "optstop", "alarm",       "end",         "set",           ""};
static_assert(kKinds[static_cast<std::size_t>(EventKind::kSetVariable)] == "set");

class Object {
 public:
  explicit Object(TextBuffer& buffer) : buffer_(buffer) { buffer_.Append('{'); }
  void Close() { buffer_.Append('}'); }

  void Key(std::string_view key) {
    if (!first_) buffer_.Append(", ");
    first_ = false;
    Quote(key);
    buffer_.Append(": ");
  }
  void Text(std::string_view key, std::string_view text) {
    Key(key);
    Quote(text);
  }
  void Number(std::string_view key, double value) {
    Key(key);
    AppendTrimmed(buffer_, value, kDecimals);
  }
  void Flag(std::string_view key) {
    Key(key);
    buffer_.Append("true");
  }
  TextBuffer& Buffer() { return buffer_; }

  void Quote(std::string_view text) {
    buffer_.Append('"');
    for (const char c : text) {
      const auto code = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        buffer_.Append('\\');
        buffer_.Append(c);
      } else if (code < 0x20U) {
        constexpr std::string_view kHex = "0123456789abcdef";
        buffer_.Append("\\u00");
        buffer_.Append(kHex[code >> 4U]);
        buffer_.Append(kHex[code & 15U]);
      } else {
        buffer_.Append(c);
      }
    }
    buffer_.Append('"');
  }

 private:
  TextBuffer& buffer_;
  bool first_ = true;
};

void Motion(Object& object, const Event& event, const ir::Module& module) {
  object.Key("to");
  Object to(object.Buffer());
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((event.known_axes >> axis & 1U) == 0) continue;
    const std::string_view name = ir::AxisName(module, axis);
    to.Number(name.empty() ? "?" : name, event.position[axis]);
  }
  to.Close();
  if (event.diameter_active) object.Flag("diameter");
}

void Feed(Object& object, const Event& event) {
  object.Number("feed", event.feed);
  object.Text("feedMode", event.feed_mode == ir::FeedMode::kPerRevolution ? "per-revolution"
                          : event.feed_mode == ir::FeedMode::kInverseTime ? "inverse-time"
                                                                          : "per-minute");
}

void Details(Object& object, const Event& event, const ir::Module& module) {
  switch (event.kind) {
    case EventKind::kRapid:
    case EventKind::kRapidMachine:
      return Motion(object, event, module);
    case EventKind::kLine:
    case EventKind::kProbe:
      Motion(object, event, module);
      return Feed(object, event);
    case EventKind::kArc:
      Motion(object, event, module);
      object.Text("plane", event.plane == ir::Plane::kZX ? "ZX" : event.plane == ir::Plane::kYZ ? "YZ" : "XY");
      object.Text("sense", event.clockwise ? "CW" : "CCW");
      object.Key("center");
      object.Buffer().Append('[');
      AppendTrimmed(object.Buffer(), event.center[0], kDecimals);
      object.Buffer().Append(", ");
      AppendTrimmed(object.Buffer(), event.center[1], kDecimals);
      object.Buffer().Append(']');
      if (event.turns != 0) object.Number("turns", event.turns);
      if (event.full_circle) object.Flag("fullCircle");
      return Feed(object, event);
    case EventKind::kThread:
    case EventKind::kTap:
      Motion(object, event, module);
      object.Number("pitch", event.value);
      if (event.start_angle != 0) object.Number("start", event.start_angle);
      if (event.change != 0) object.Number("change", event.change);
      return;
    case EventKind::kReference: {
      TextBuffer line;
      AppendTraceLine(line, event, module);
      const std::string_view view = line.View();
      return object.Text("axes", view.size() > 10 ? view.substr(9, view.size() - 10) : "");
    }
    case EventKind::kDwell:
      object.Number("value", event.value);
      if (event.per_revolution) object.Flag("revolutions");
      return;
    case EventKind::kSpindle:
      object.Number("spindle", event.spindle);
      return object.Text("state", event.spindle_state == ir::SpindleState::kCw    ? "CW"
                                  : event.spindle_state == ir::SpindleState::kCcw ? "CCW"
                                                                                  : "STOP");
    case EventKind::kSpindleSpeed:
    case EventKind::kSpindleSurface:
    case EventKind::kSpindleLimit:
    case EventKind::kSpindlePosition:
      object.Number("spindle", event.spindle);
      return object.Number("value", event.value);
    case EventKind::kTool:
      if (!event.text.empty()) return object.Text("name", event.text);
      if (event.extension != 0) object.Number("suffix", event.extension);
      return object.Number("number", event.number);
    case EventKind::kOffset:
      object.Text("register", event.offset == OffsetKind::kEdge     ? "edge"
                              : event.offset == OffsetKind::kLength ? "length"
                              : event.offset == OffsetKind::kRadius ? "radius"
                              : event.offset == OffsetKind::kNumber ? "number"
                                                                    : "none");
      if (event.length_minus) object.Text("sign", "minus");
      return object.Number("number", event.number);
    case EventKind::kComp:
      return object.Text("side", event.comp == ir::CutterComp::kLeft    ? "LEFT"
                                 : event.comp == ir::CutterComp::kRight ? "RIGHT"
                                                                        : "OFF");
    case EventKind::kWorkOffset:
      object.Number("number", event.number);
      if (event.extension != 0) object.Number("extension", event.extension);
      return;
    case EventKind::kPath:
      return object.Text("mode", event.path == ir::PathMode::kContinuous ? "CONTINUOUS"
                                 : event.path == ir::PathMode::kExact    ? "EXACT"
                                                                         : "UNKNOWN");
    case EventKind::kAux:
      object.Text("address", event.text.empty() ? "M" : event.text);
      object.Number("number", event.number);
      if (event.extension != 0) object.Number("extension", event.extension);
      return;
    case EventKind::kMessage:
    case EventKind::kPrint:
      return object.Text("text", event.text);
    case EventKind::kAlarm:
      object.Text("code", event.code);
      return object.Text("text", event.text);
    case EventKind::kSetVariable:
      object.Text("name", event.text);
      return object.Text("value", event.code);
    case EventKind::kStop:
    case EventKind::kOptionalStop:
    case EventKind::kEnd:
    case EventKind::kData:
      return;
  }
}

}  // namespace

void AppendTraceJson(TextBuffer& buffer, const Event& event, const ir::Module& module) {
  Object object(buffer);
  object.Text("kind", kKinds[static_cast<std::size_t>(event.kind)]);
  Details(object, event, module);
  if (event.block.Valid()) {
    const SourceRange place = module.RangeOf(module.blocks[event.block]);
    if (place.Valid() && place.file.Valid() && place.file.value < module.file_names.size()) {
      object.Text("file", module.View(module.file_names[place.file.value]));
    }
    if (place.Valid()) object.Number("line", place.line);
  }
  object.Close();
}

}  // namespace ncport::exec
