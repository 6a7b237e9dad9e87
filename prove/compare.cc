#include "prove/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace ncport::prove {

namespace {

using exec::Event;
using exec::EventKind;
using exec::OffsetKind;

constexpr double kRelative = 1e-6;

constexpr std::string_view kAxisNames = "XYZABCUVW";

std::string AxisName(std::uint8_t axis) {
  return axis < kAxisNames.size() ? std::string(1, kAxisNames[axis]) : fmt::format("axis {}", axis);
}

double WordErrorOf(const Precision& precision) {
  switch (precision.word_error) {
    case ir::WordError::kNone:
      return 0;
    case ir::WordError::kRound:
      return precision.increment / 2;
    case ir::WordError::kTruncate:
      return precision.increment;
  }
  return 0;
}

/// Speed words in force on one side.
struct SpindleNow {
  ir::SpindleState sense = ir::SpindleState::kUnknown;
  bool surface = false;
  double speed = -1;  // < 0: not programmed
  double limit = -1;
  bool operator==(const SpindleNow&) const = default;
};
using Spindles = std::array<SpindleNow, exec::kSpindles>;

/// What was selected on one side so far; each change is an event, a repetition is none.
struct Selected {
  // Tool of the last tool word, and the one that is in.
  std::uint32_t called = 0;
  std::string_view called_name;
  bool called_known = false;
  bool tool_known = false;
  std::uint32_t tool = 0;
  std::string_view tool_name;
  std::uint32_t loaded = 0;  // the tool that the last change word brought in; 0 = none yet
  bool offset_known = false;
  OffsetKind offset_kind = OffsetKind::kNone;
  std::uint32_t offset = 0;
  std::uint32_t length = 0, radius = 0;  // registers by kind
  bool wcs_known = false;
  std::uint32_t wcs = 0, wcs_extension = 0;
  ir::CutterComp comp = ir::CutterComp::kUnknown;
  ir::PathMode path = ir::PathMode::kUnknown;

  void TakeTool() {
    tool_known = called_known;
    tool = called;
    tool_name = called_name;
  }
};

/// One side as it is walked through.
class Walk {
 public:
  Walk(const std::vector<Event>& events, const Maps& maps, bool source, const ir::WorkOffset& start)
      : events_(events), maps_(maps), source_(source) {
    now_.wcs_known = start.known;
    now_.wcs = start.number;
    now_.wcs_extension = start.extension;
    for (const Event& event : events_) {
      motions_left_ += IsMotion(event.kind) && !event.added ? 1U : 0U;
      if (IsMotion(event.kind) || event.kind == EventKind::kTool) last_ = &event;
    }
  }

  /// Next event that takes part in the comparison, after all states before it were taken in; none at the end.
  const Event* Next();
  void Advance() { ++index_; }

  [[nodiscard]] const Spindles& SpindlesNow() const { return spindles_; }
  [[nodiscard]] const Spindles& SpindlesWithoutAdded() const { return own_spindles_; }
  [[nodiscard]] const Selected& Now() const { return now_; }
  [[nodiscard]] const Selected& WithoutAdded() const { return own_; }
  [[nodiscard]] std::uint16_t Dirty() const { return dirty_; }
  [[nodiscard]] const std::optional<std::string>& Complaint() const { return complaint_; }
  void MotionDone(const Event& event) {
    --motions_left_;
    ++motions_done_;
    tool_since_motion_ = false;
    dirty_ = static_cast<std::uint16_t>(dirty_ & ~event.moved_axes);
  }
  [[nodiscard]] std::size_t MotionsDone() const { return motions_done_; }

 private:
  static void TakeSpindle(const Event& event, Spindles& spindles);
  bool TakeState(const Event& event);
  void TakeAdded(const Event& event);
  [[nodiscard]] bool ToolAhead() const;

  const std::vector<Event>& events_;
  const Maps& maps_;
  bool source_;
  std::size_t index_ = 0;
  std::size_t motions_left_ = 0, motions_done_ = 0;
  bool tool_since_motion_ = false;
  const Event* last_ = nullptr;
  Spindles spindles_, own_spindles_;
  Selected now_, own_;
  std::uint16_t dirty_ = 0;  // axes that added blocks moved and the program has not named since
  std::optional<std::string> complaint_;
};

void Walk::TakeSpindle(const Event& event, Spindles& spindles) {
  SpindleNow& state = spindles[event.spindle];
  switch (event.kind) {
    case EventKind::kSpindle:
      state.sense = event.spindle_state;
      break;
    case EventKind::kSpindleSpeed:
      state.surface = false;
      state.speed = event.value;
      break;
    case EventKind::kSpindleSurface:
      state.surface = true;
      state.speed = event.value;
      break;
    case EventKind::kSpindleLimit:
      state.limit = event.value;
      break;
    default:
      break;
  }
}

/// Takes a selecting event into `now_`; true when it changes what the program itself selected.
bool Walk::TakeState(const Event& event) {
  const auto apply = [&](Selected& state) {
    const Selected before = state;
    switch (event.kind) {
      case EventKind::kTool:
        state.called_known = true;
        state.called = event.number;
        state.called_name = event.text;
        if (!event.tool_waits) state.TakeTool();
        return true;  // the same tool called twice is two calls
      case EventKind::kAux:
        if (event.tool_change) state.TakeTool();
        return true;
      case EventKind::kOffset:
        state.offset_known = true;
        state.offset_kind = event.offset;
        state.offset = event.offset == OffsetKind::kNone ? 0 : event.number;
        if (event.offset != OffsetKind::kRadius) state.length = state.offset;
        if (event.offset != OffsetKind::kLength) state.radius = state.offset;
        // Where none was selected, none more changes nothing.
        if (!before.offset_known) return state.offset_kind != OffsetKind::kNone;
        return before.offset_kind != state.offset_kind || before.offset != state.offset;
      case EventKind::kWorkOffset:
        state.wcs_known = true;
        state.wcs = event.number;
        state.wcs_extension = event.extension;
        return !before.wcs_known || before.wcs != state.wcs || before.wcs_extension != state.wcs_extension;
      case EventKind::kComp:
        state.comp = event.comp;
        return before.comp != state.comp &&
               !(before.comp == ir::CutterComp::kUnknown && state.comp == ir::CutterComp::kOff);
      case EventKind::kPath:
        state.path = event.path;
        return before.path != state.path;
      default:
        return true;
    }
  };
  apply(now_);
  return event.added ? false : apply(own_);
}

bool Walk::ToolAhead() const {
  for (std::size_t i = index_; i < events_.size(); ++i) {
    if (events_[i].kind == EventKind::kTool) return true;
    if (IsMotion(events_[i].kind) && !events_[i].added) return false;
  }
  return false;
}

void Walk::TakeAdded(const Event& event) {
  if (!IsMotion(event.kind)) return;
  dirty_ = static_cast<std::uint16_t>(dirty_ | event.moved_axes);
  if (motions_done_ == 0 || motions_left_ == 0 || tool_since_motion_ || ToolAhead()) return;
  if (!complaint_) complaint_ = "an added block moves between two motions of the program, away from any tool change";
}

const Event* Walk::Next() {
  for (; index_ < events_.size(); ++index_) {
    const Event& event = events_[index_];
    switch (event.kind) {
      case EventKind::kSpindle:
      case EventKind::kSpindleSpeed:
      case EventKind::kSpindleSurface:
      case EventKind::kSpindleLimit:
        if (event.kind == EventKind::kSpindleSurface && spindles_[event.spindle].limit < 0 && !event.added) {
          // A limit later in the same block is in force with it.
          bool follows = false;
          for (std::size_t i = index_ + 1; i < events_.size() && events_[i].block == event.block; ++i) {
            follows = follows || events_[i].kind == EventKind::kSpindleLimit;
          }
          const bool later = std::any_of(events_.begin() + static_cast<std::ptrdiff_t>(index_), events_.end(),
                                         [](const Event& e) { return e.kind == EventKind::kSpindleLimit; });
          if (!follows && later && !complaint_)
            complaint_ = "constant surface speed starts before its speed limit is set";
        }
        TakeSpindle(event, spindles_);
        if (!event.added) TakeSpindle(event, own_spindles_);
        continue;
      case EventKind::kTool:
        // The offset of the tool that is in: a turret says it by its tool word, the other side by a word of its own.
        if (maps_.offset_words && !event.tool_waits && now_.tool_known && now_.tool == event.number &&
            now_.tool_name == event.text)
          continue;
        tool_since_motion_ = true;
        if (TakeState(event)) return &event;
        continue;
      case EventKind::kOffset:
        if (TakeState(event) && !maps_.tools_mapped) return &event;  // mapped offsets are compared as state at motions
        continue;
      case EventKind::kWorkOffset:
        TakeState(event);  // compared as state at motions and at the end
        continue;
      case EventKind::kComp:
        if (TakeState(event)) return &event;
        continue;
      case EventKind::kPath:
        TakeState(event);  // compared as state at motions and at the end
        continue;
      case EventKind::kMessage:
      case EventKind::kPrint:
        if (maps_.messages_lost || event.added) continue;
        return &event;
      case EventKind::kSetVariable:
        continue;
      case EventKind::kAux:
        if (event.tool_change) TakeState(event);
        if (event.number == 6 && event.text.empty()) now_.loaded = now_.tool;
        if (event.added) continue;
        if (!source_ && maps_.tool_change_added && event.number == 6) continue;
        if (source_) {
          const auto pair = std::find_if(maps_.aux.begin(), maps_.aux.end(),
                                         [&](const AuxPair& aux) { return aux.source == event.number; });
          if (pair != maps_.aux.end() && !pair->target.has_value()) continue;
        }
        return &event;
      default:
        if (event.added && event.kind != EventKind::kAlarm && event.kind != EventKind::kEnd) {
          TakeAdded(event);
          continue;
        }
        return &event;
    }
  }
  return nullptr;
}

class Comparer {
 public:
  Comparer(const RecordedTrace& source, const RecordedTrace& target, const CompareOptions& options,
           const ir::WorkOffset& target_start)
      : options_(options),
        source_events_(source.Events()),
        target_events_(target.Events()),
        source_(source_events_, options.maps, true, {}),
        target_(target_events_, options.maps, false, target_start) {}

  Comparison Run();

 private:
  void Fail(const Event* a, const Event* b, std::string what) {
    if (result_.difference) return;
    Difference difference{std::move(what), {}, {}};
    if (a != nullptr) difference.source_block = a->block;
    if (b != nullptr) difference.target_block = b->block;
    result_.difference = std::move(difference);
  }
  [[nodiscard]] bool Failed() const { return result_.difference.has_value(); }

  void ComparePair(const Event& a, const Event& b);
  void CompareEnds(const Event& a, const Event& b);
  void ComparePositions(const Event& a, const Event& b);
  void CompareMotionDetails(const Event& a, const Event& b);
  void CompareSpindles(const Event& a, const Event& b, const Spindles& source, const Spindles& target);
  void CompareSpindle(const Event& a, const Event& b, const SpindleNow& sa, const SpindleNow& sb);
  void CompareTool(const Event& a, const Event& b);
  void CompareToolState(const Event& a, const Event& b);
  void CompareCompensation(const Event& a, const Event& b);
  void CompareWorkOffset(const Event& a, const Event& b);
  void ComparePath(const Event& a, const Event& b);
  bool SkipSplitRapid(const Event& a);
  void NoteLonely(const Event& event, std::uint16_t axes, std::array<std::optional<double>, ir::kMaxAxes>& seen,
                  std::uint16_t& moving);
  [[nodiscard]] double Allowed(const Event& a, const Event& b, std::uint8_t axis) const;
  void CompareNumber(const Event& a, const Event& b, double x, double y, std::string_view what);
  void CompareSpeed(const Event& a, const Event& b, double x, double y, std::string_view what);

  const CompareOptions& options_;
  const std::vector<Event>& source_events_;
  const std::vector<Event>& target_events_;
  Walk source_, target_;
  Comparison result_;
  // Axes that only one side programs: allowed while they stand at one value.
  std::array<std::optional<double>, ir::kMaxAxes> lonely_source_, lonely_target_;
  std::uint16_t lonely_source_moving_ = 0, lonely_target_moving_ = 0;
  std::uint16_t common_axes_ = 0;
};

double Comparer::Allowed(const Event& a, const Event& b, std::uint8_t axis) const {
  const auto side = [axis](const Precision& precision, const Event& event) {
    const double error = WordErrorOf(precision);
    return precision.diameter_axis == axis && event.diameter_active ? error / 2 : error;
  };
  return options_.tolerance + side(options_.source, a) + side(options_.target, b);
}

void Comparer::CompareNumber(const Event& a, const Event& b, double x, double y, std::string_view what) {
  const double allowed = kRelative * std::max({1.0, std::fabs(x), std::fabs(y)}) + WordErrorOf(options_.source) +
                         WordErrorOf(options_.target);
  if (!(std::fabs(x - y) <= allowed)) Fail(&a, &b, fmt::format("{} {:.10g} became {:.10g}", what, x, y));
}

void Comparer::CompareSpeed(const Event& a, const Event& b, double x, double y, std::string_view what) {
  const double words = options_.source.speed_error + options_.target.speed_error;
  if (std::fabs(x - y) > words) CompareNumber(a, b, x, y, what);
}

void Comparer::NoteLonely(const Event& event, std::uint16_t axes, std::array<std::optional<double>, ir::kMaxAxes>& seen,
                          std::uint16_t& moving) {
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if ((axes >> axis & 1U) == 0) continue;
    if (!seen[axis]) {
      seen[axis] = event.position[axis];
    } else if (std::fabs(*seen[axis] - event.position[axis]) > options_.tolerance) {
      moving = static_cast<std::uint16_t>(moving | (1U << axis));
    }
  }
}

void Comparer::ComparePositions(const Event& a, const Event& b) {
  const std::uint16_t both = a.known_axes & b.known_axes;
  common_axes_ = static_cast<std::uint16_t>(common_axes_ | both);
  // An axis that an added block moved stands elsewhere until the program names it: allowed for rapids only.
  const std::uint16_t away =
      a.kind == EventKind::kRapid
          ? static_cast<std::uint16_t>((target_.Dirty() & ~b.moved_axes) | (source_.Dirty() & ~a.moved_axes))
          : std::uint16_t{0};
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    if (((both & ~away) >> axis & 1U) == 0) continue;
    if (!(std::fabs(a.position[axis] - b.position[axis]) <= Allowed(a, b, axis))) {
      Fail(&a, &b,
           fmt::format("{} is {:.6f} in the source and {:.6f} in the target", AxisName(axis), a.position[axis],
                       b.position[axis]));
      return;
    }
  }
  NoteLonely(a, static_cast<std::uint16_t>(a.known_axes & ~b.known_axes), lonely_source_, lonely_source_moving_);
  NoteLonely(b, static_cast<std::uint16_t>(b.known_axes & ~a.known_axes), lonely_target_, lonely_target_moving_);
}

void Comparer::CompareMotionDetails(const Event& a, const Event& b) {
  switch (a.kind) {
    case EventKind::kArc: {
      if (a.plane != b.plane) return Fail(&a, &b, "the arc lies in another plane");
      if (a.clockwise != b.clockwise) return Fail(&a, &b, "the arc turns the other way");
      if (a.turns != b.turns) return Fail(&a, &b, fmt::format("{} full turns became {}", a.turns, b.turns));
      if (a.full_circle != b.full_circle) return Fail(&a, &b, "a full circle on one side only");
      const double allowed = options_.tolerance + 2 * (WordErrorOf(options_.source) + WordErrorOf(options_.target));
      for (int i = 0; i < 2; ++i) {
        if (!(std::fabs(a.center[i] - b.center[i]) <= allowed)) {
          return Fail(&a, &b,
                      fmt::format("the centre ({:.6f},{:.6f}) became ({:.6f},{:.6f})", a.center[0], a.center[1],
                                  b.center[0], b.center[1]));
        }
      }
      break;
    }
    case EventKind::kThread:
    case EventKind::kTap:
      CompareNumber(a, b, a.value, b.value, "the pitch");
      if (!Failed()) CompareNumber(a, b, a.start_angle, b.start_angle, "the start angle");
      if (!Failed()) CompareNumber(a, b, a.change, b.change, "the change of pitch");
      break;
    case EventKind::kReference:
      if (a.moved_axes != b.moved_axes) return Fail(&a, &b, "other axes go to the reference point");
      break;
    default:
      break;
  }
  if (Failed() || !(a.kind == EventKind::kLine || a.kind == EventKind::kArc || a.kind == EventKind::kProbe)) return;
  if (a.feed_mode != b.feed_mode)
    return Fail(&a, &b, "the feed has another unit (per minute, per revolution, inverse time)");
  CompareNumber(a, b, a.feed, b.feed, "the feed");
}

void Comparer::CompareSpindles(const Event& a, const Event& b, const Spindles& source, const Spindles& target) {
  for (std::size_t i = 0; i < source.size() && !Failed(); ++i) CompareSpindle(a, b, source[i], target[i]);
}

void Comparer::CompareSpindle(const Event& a, const Event& b, const SpindleNow& sa, const SpindleNow& sb) {
  if (sa.sense != sb.sense) {
    // Before either side switched the spindle there is nothing to compare.
    const bool idle_a = sa.sense == ir::SpindleState::kUnknown || sa.sense == ir::SpindleState::kStop;
    const bool idle_b = sb.sense == ir::SpindleState::kUnknown || sb.sense == ir::SpindleState::kStop;
    if (!(idle_a && idle_b)) return Fail(&a, &b, "the spindle turns in another sense");
  }
  if (sa.speed < 0 && sb.speed < 0) return;
  if (sa.speed < 0 || sb.speed < 0) return Fail(&a, &b, "a spindle speed on one side only");
  if (sa.surface != sb.surface) return Fail(&a, &b, "constant surface speed on one side only");
  CompareSpeed(a, b, sa.speed, sb.speed, sa.surface ? "the surface speed" : "the spindle speed");
  if (Failed() || !sa.surface) return;
  if ((sa.limit < 0) != (sb.limit < 0)) return Fail(&a, &b, "a spindle speed limit on one side only");
  if (sa.limit >= 0) CompareSpeed(a, b, sa.limit, sb.limit, "the spindle speed limit");
}

void Comparer::CompareTool(const Event& a, const Event& b) {
  if (!options_.maps.tools_mapped) {
    if (a.number != b.number || a.text != b.text) Fail(&a, &b, "another tool is called");
    return;
  }
  for (const ToolPair& pair : options_.maps.tools) {
    const bool source =
        pair.source_name.empty() ? a.text.empty() && pair.source_tool == a.number : pair.source_name == a.text;
    const bool target =
        pair.target_name.empty() ? b.text.empty() && pair.target_tool == b.number : pair.target_name == b.text;
    if (source && target) return;
  }
  Fail(&a, &b, "the tool of the target is not the one that the tool map gives");
}

void Comparer::CompareToolState(const Event& a, const Event& b) {
  if (!options_.maps.tools_mapped) return;
  const Selected& sa = source_.Now();
  const Selected& sb = target_.Now();
  if (!sa.tool_known || !sb.tool_known) return;
  constexpr std::uint16_t kZ = 1U << 2U;
  const bool compensated = sa.comp == ir::CutterComp::kLeft || sa.comp == ir::CutterComp::kRight;
  if (options_.maps.source_registers) {
    if (sa.loaded == 0) return;
    // A length counts when Z moves, a radius under compensation; one edge stands for both.
    const bool lengthwise = (b.moved_axes & kZ) != 0;
    const std::uint32_t edge = sb.offset_kind == OffsetKind::kNone ? 0 : sb.offset;
    bool agree = (!lengthwise || (sa.length == 0 && edge == 0)) && !compensated;
    for (const ToolPair& pair : options_.maps.tools) {
      if (pair.source_tool != sa.loaded || pair.target_offset != edge || pair.source_edge == 0) continue;
      agree = agree ||
              ((!lengthwise || pair.source_edge == sa.length) && (!compensated || pair.source_radius == sa.radius));
    }
    if (!agree) Fail(&a, &b, "the edge in force is not the one that the tool map gives");
    return;
  }
  for (const ToolPair& pair : options_.maps.tools) {
    const bool tool = pair.source_name.empty() ? sa.tool_name.empty() && pair.source_tool == sa.tool
                                               : pair.source_name == sa.tool_name;
    if (!tool) continue;
    if (options_.maps.separate_registers) {
      // An edge is a length, which counts when Z moves, and a radius, which counts under compensation.
      const bool off = sa.offset_known && sa.offset_kind == OffsetKind::kNone;
      if (!off && (!sa.offset_known || sa.offset != pair.source_edge)) continue;
      const bool length = (b.moved_axes & kZ) == 0 || sb.length == (off ? 0 : pair.target_offset);
      const bool radius = !compensated || sb.radius == (off ? 0 : pair.target_radius);
      if (length && radius) return;
      continue;
    }
    const bool edge = pair.source_edge == 0 || (sa.offset_known && sa.offset == pair.source_edge);
    const bool none = sa.offset_known && sa.offset_kind == OffsetKind::kNone && sb.offset_kind == OffsetKind::kNone;
    if (none || (edge && (pair.target_offset == 0 || sb.offset == pair.target_offset))) return;
  }
  Fail(&a, &b, "the tool offset in force is not the one that the tool map gives");
}

/// The side that the cutter is kept on, as it is in force: a block that the translation added may have selected it.
void Comparer::CompareCompensation(const Event& a, const Event& b) {
  const auto side = [](ir::CutterComp comp) { return comp == ir::CutterComp::kUnknown ? ir::CutterComp::kOff : comp; };
  if (side(source_.Now().comp) != side(target_.Now().comp))
    Fail(&a, &b, "cutter compensation is in force on one side only, or the other way");
}

/// The work offset in force. A source that selects none works with the one that is in force, whichever it is.
void Comparer::CompareWorkOffset(const Event& a, const Event& b) {
  const Selected& sa = source_.Now();
  const Selected& sb = target_.Now();
  if (!sa.wcs_known) {
    if (target_.WithoutAdded().wcs_known) Fail(&a, &b, "a work offset is selected in the target only");
    return;
  }
  if (!sb.wcs_known) return Fail(&a, &b, "a work offset is selected in the source only");
  for (const NumberPair& pair : options_.maps.work_offsets) {
    if (pair.source == sa.wcs && pair.source_extension == sa.wcs_extension) {
      if (pair.target == sb.wcs && pair.target_extension == sb.wcs_extension) return;
      return Fail(&a, &b, "the work offset of the target is not the one that the map gives");
    }
  }
  if (sa.wcs != sb.wcs || sa.wcs_extension != sb.wcs_extension)
    Fail(&a, &b, fmt::format("work offset {} became {}", sa.wcs, sb.wcs));
}

/// The path mode in force. A source that selects none works with the one that is in force, whichever it is.
void Comparer::ComparePath(const Event& a, const Event& b) {
  if (options_.maps.path_lost) return;
  const ir::PathMode path = source_.Now().path;
  const ir::PathMode other = path == ir::PathMode::kUnknown ? target_.WithoutAdded().path : target_.Now().path;
  if (path != other) Fail(&a, &b, "exact stop and path control differ");
}

void Comparer::CompareEnds(const Event& a, const Event& b) {
  if (a.kind == EventKind::kAlarm) {
    result_.source_alarmed_before_motion = source_.MotionsDone() == 0;
    if (b.added && source_.MotionsDone() == 0) return;  // a guard that the report lists
    const bool agree = options_.maps.cross_language ? a.alarm == b.alarm : a.code == b.code;
    if (!agree) Fail(&a, &b, fmt::format("alarm {} became alarm {}", a.code, b.code));
  }
}

static std::string_view KindName(EventKind kind) {
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
  }
  return "an event";
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
      break;
    case EventKind::kTool:
      CompareTool(a, b);
      break;
    case EventKind::kOffset:
      if (a.offset != b.offset || a.number != b.number) Fail(&a, &b, "another offset is selected");
      break;
    case EventKind::kComp:
      if (a.comp != b.comp) Fail(&a, &b, "cutter compensation differs");
      break;
    case EventKind::kAux: {
      const auto pair = std::find_if(options_.maps.aux.begin(), options_.maps.aux.end(),
                                     [&](const AuxPair& aux) { return aux.source == a.number; });
      const std::uint32_t expected = pair == options_.maps.aux.end() ? a.number : pair->target.value_or(a.number);
      if (expected != b.number) Fail(&a, &b, fmt::format("M{} became M{}", a.number, b.number));
      break;
    }
    case EventKind::kSpindlePosition:
      CompareNumber(a, b, a.value, b.value, "the spindle position");
      break;
    case EventKind::kMessage:
    case EventKind::kPrint:
      if (a.text != b.text) Fail(&a, &b, fmt::format("the text \"{}\" became \"{}\"", a.text, b.text));
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

}  // namespace

Comparison Compare(const RecordedTrace& source, const RecordedTrace& target, const CompareOptions& options,
                   const ir::WorkOffset& target_start) {
  return Comparer(source, target, options, target_start).Run();
}

}  // namespace ncport::prove
