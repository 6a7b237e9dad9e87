// Motions of the flat writer: straight, arcs, threads.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "backends/iso/flat_numbers.h"
#include "backends/iso/flat_writer.h"
#include "ir/axis_names.h"
#include "ir/plane_axes.h"

namespace ncport::backends::iso {
namespace {

constexpr int kRevolutionDecimals = 4;    // of a feed per revolution
constexpr double kFeedTolerance = 0.001;  // error of a rounded feed, of its value

}  // namespace

/// The coordinate as whole increments of the word. Beyond what a word can hold: a finding, and 0.
std::int64_t FlatWriter::Grid(std::uint8_t axis, double value) {
  const double shown = ir::IsRotary(axis) ? value : Length(value);
  if (!(std::fabs(shown * scale_[axis]) < kMaxIncrements)) {
    Refuse(diag::Code::kOutOfRange, fmt::format("{} {}", ir::kAxisLetters[axis], shown), "what a word can hold");
    return 0;
  }
  return RoundToIncrements(shown, scale_[axis]);
}

bool FlatWriter::AxesExist(std::uint16_t axes) {
  const auto missing = static_cast<std::uint16_t>(axes & ~axes_);
  if (missing == 0) return true;
  const auto axis = static_cast<std::uint8_t>(std::countr_zero(missing));
  Refuse(diag::Code::kNotExpressible, fmt::format("axis {}", ir::AxisName(module_, axis)));
  return false;
}

void FlatWriter::AppendAxis(std::uint8_t axis, std::int64_t value) {
  at_[axis] = value;
  AppendNumber(ir::kAxisLetters[axis], value);
}

void FlatWriter::AppendNumber(char letter, std::int64_t increments) {
  if (out_.size() != line_begin_) out_.Append(' ');
  AppendWord(out_, letter, increments, decimals_);
}

void FlatWriter::AppendMotion(ir::Motion motion) {
  if (motion == motion_) return;
  motion_ = motion;
  switch (motion) {
    case ir::Motion::kRapid:
      return Put("G0");
    case ir::Motion::kLinear:
      return Put("G1");
    case ir::Motion::kArcCw:
      return Put("G2");
    case ir::Motion::kArcCcw:
      return Put("G3");
    default:
      NCPORT_BUG("flat blocks have no word for motion {}", static_cast<int>(motion));
  }
}

/// Plane and kind of feed where they differ from what is in force.
void FlatWriter::AppendModes(const exec::Event& event, bool feed_move) {
  if (event.plane != plane_ && event.plane != ir::Plane::kUnknown) {
    plane_ = event.plane;
    Put(plane_ == ir::Plane::kXY ? "G17" : plane_ == ir::Plane::kZX ? "G18" : "G19");
  }
  if (!feed_move || event.feed_mode == feed_mode_) return;
  const dialects::WriterWords& words = target_.words;
  const dialects::Setting<std::string>* form = nullptr;
  std::string_view usual;
  const char* what = "feed as inverse time";
  switch (event.feed_mode) {
    case ir::FeedMode::kPerMinute:
      form = &words.feed_per_minute;
      usual = "G94";
      what = "feed per minute";
      break;
    case ir::FeedMode::kPerRevolution:
      form = &words.feed_per_revolution;
      usual = lathe_ ? "G95" : "";  // the card gives G95 to lathes only
      what = "feed per revolution";
      break;
    case ir::FeedMode::kInverseTime:
      form = &words.feed_inverse_time;
      break;
    case ir::FeedMode::kUnknown:
      break;
  }
  const std::string_view word = form == nullptr ? std::string_view{} : form->Known() ? std::string_view(**form) : usual;
  if (word.empty()) {
    Refuse(diag::Code::kNotExpressible, what);
    return;
  }
  feed_mode_ = event.feed_mode;
  feed_ = kNotWritten;
  // The profile's form may be the G word alone or carry the value.
  Put(word.substr(0, word.find(' ')));
}

void FlatWriter::AppendFeed(const exec::Event& event) {
  // As inverse time it is no length, and each block needs its own.
  const bool inverse = event.feed_mode == ir::FeedMode::kInverseTime;
  const double shown = inverse ? event.feed : Length(event.feed);
  // A feed per revolution has 0.0001 mm where lengths have less (fanuc-2.2).
  const int decimals =
      event.feed_mode == ir::FeedMode::kPerRevolution ? std::max(decimals_, kRevolutionDecimals) : decimals_;
  const double scale = ScaleOf(decimals);
  if (!(std::fabs(shown * scale) < kMaxIncrements)) {
    Refuse(diag::Code::kOutOfRange, fmt::format("feed {}", shown), "what a word can hold");
    return;
  }
  const std::int64_t feed = RoundToIncrements(shown, scale);
  if (feed == feed_ && !inverse) return;
  if (feed <= 0 || std::fabs(static_cast<double>(feed) / scale - shown) > kFeedTolerance * shown)
    Refuse(diag::Code::kWordTooCoarse, fmt::format("feed {}", event.feed), fmt::format("{}", decimals));
  feed_ = feed;
  if (out_.size() != line_begin_) out_.Append(' ');
  AppendWord(out_, 'F', feed, decimals);
}

void FlatWriter::Straight(const exec::Event& event, ir::Motion motion) {
  if ((event.known_axes & ~axes_) != 0 && !AxesExist(event.known_axes)) return;
  BeginLine();
  AppendModes(event, motion == ir::Motion::kLinear);
  AppendMotion(motion);
  std::uint16_t moving = 0;
  for (std::uint32_t rest = event.known_axes; rest != 0; rest &= rest - 1) {
    const auto axis = static_cast<std::uint8_t>(std::countr_zero(rest));
    const std::int64_t value = Grid(axis, event.position[axis]);
    if (value == at_[axis] && (event.moved_axes >> axis & 1U) == 0) continue;
    if (value != at_[axis]) moving = static_cast<std::uint16_t>(moving | (1U << axis));
    AppendAxis(axis, value);
  }
  if (motion == ir::Motion::kLinear) AppendFeed(event);
  EndLine();
  if (options_.list_rapids && motion == ir::Motion::kRapid && (moving & (moving - 1U)) != 0) ListRapid(moving);
}

void FlatWriter::Arc(const exec::Event& event) {
  const ir::PlaneAxes axes = ir::AxesOf(event.plane);
  const std::uint8_t pair[2] = {axes.first, axes.second};
  const auto plane_bits = static_cast<std::uint16_t>(1U << axes.first | 1U << axes.second);
  if (!AxesExist(event.known_axes | plane_bits)) return;
  ExactArc arc;
  double end[ir::kMaxAxes];
  for (int axis = 0; axis < ir::kMaxAxes; ++axis) end[axis] = event.position[axis];
  for (int i = 0; i < 2; ++i) {
    // Only `--start` or a rapid can have brought the tool here: both are known positions.
    if (at_[pair[i]] == kNotWritten) at_[pair[i]] = Grid(pair[i], event.from[pair[i]]);
    arc.from[i] = Length(event.from[pair[i]]);
    arc.to[i] = Length(event.position[pair[i]]);
    arc.center[i] = Length(event.center[i]);
  }
  arc.clockwise = event.clockwise;
  arc.full_circle = event.full_circle;

  // Additional turns: full circles first, the other axes evenly over the whole angle (sinumerik card, 8.3).
  const std::uint32_t turns = event.turns;
  if (turns != 0) {
    ExactArc circle = arc;
    circle.full_circle = true;
    circle.to[0] = arc.from[0];
    circle.to[1] = arc.from[1];
    const double turns_in_all = static_cast<double>(turns) + SweepOf(arc) / SweepOf(circle);
    double way[ir::kMaxAxes];
    for (int axis = 0; axis < ir::kMaxAxes; ++axis) way[axis] = event.position[axis] - event.from[axis];
    for (std::uint32_t turn = 1; turn <= turns && !failed_; ++turn) {
      double point[ir::kMaxAxes];
      for (int axis = 0; axis < ir::kMaxAxes; ++axis) {
        const bool in_plane = axis == pair[0] || axis == pair[1];
        point[axis] = event.from[axis] + (in_plane ? 0.0 : way[axis] * static_cast<double>(turn) / turns_in_all);
      }
      ArcPiece(event, circle, point);
      if (!FlushIfFull()) return;
    }
  }
  ArcPiece(event, arc, end);
}

/// One flat block. `end`: all axes at its end, mm and degrees.
void FlatWriter::ArcPiece(const exec::Event& event, const ExactArc& arc, const double* end) {
  const ir::PlaneAxes axes = ir::AxesOf(event.plane);
  const std::uint8_t pair[2] = {axes.first, axes.second};
  ArcGrid grid;
  grid.increment = 1 / ScaleOf(decimals_);
  std::int64_t from[2];
  std::int64_t to[2];
  for (int i = 0; i < 2; ++i) {
    grid.unit[i] = 1 / scale_[pair[i]];
    from[i] = at_[pair[i]];
    to[i] = arc.full_circle ? from[i] : Grid(pair[i], end[pair[i]]);
  }
  const GridArc fit = FitArc(arc, from, to, grid, circle_tolerance_);
  if (fit.kind == GridArc::Kind::kBroken) {
    Refuse(diag::Code::kArcRadius, fmt::format("{:.6g}", fit.start_radius), fmt::format("{:.6g}", fit.end_radius));
    return;
  }
  const bool is_arc = fit.kind == GridArc::Kind::kArc;
  BeginLine();
  AppendModes(event, true);
  AppendMotion(!is_arc ? ir::Motion::kLinear : arc.clockwise ? ir::Motion::kArcCw : ir::Motion::kArcCcw);
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    const bool in_plane = axis == pair[0] || axis == pair[1];
    if (!in_plane && (event.known_axes >> axis & 1U) == 0) continue;
    const std::int64_t value = in_plane ? to[axis == pair[0] ? 0 : 1] : Grid(axis, end[axis]);
    // The end point in the plane is always written: controls differ in what a missing word means there.
    if (!in_plane && value == at_[axis] && (event.moved_axes >> axis & 1U) == 0) continue;
    AppendAxis(axis, value);
  }
  if (is_arc) {
    // I, J, K in this order, whatever the plane's.
    const int order[2] = {pair[0] < pair[1] ? 0 : 1, pair[0] < pair[1] ? 1 : 0};
    for (const int i : order) {
      AppendNumber(static_cast<char>('I' + pair[i]), fit.center[i]);
    }
  }
  AppendFeed(event);
  EndLine();
}

void FlatWriter::Thread(const exec::Event& event) {
  if (!AxesExist(event.known_axes)) return;
  if (event.change != 0) {
    Refuse(diag::Code::kNotExpressible, "a thread with a variable lead");
    return;
  }
  if (event.start_angle != 0) {
    Refuse(diag::Code::kNotExpressible, "a thread with a start angle");
    return;
  }
  // The lead goes under the letter of the axis with the longer way.
  std::uint8_t along = 2;
  double longest = -1;
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    if ((event.known_axes >> axis & 1U) == 0) continue;
    const double way = std::fabs(event.position[axis] - event.from[axis]);
    if (way > longest) {
      longest = way;
      along = axis;
    }
  }
  const double lead = Length(event.value);
  if (!(std::fabs(lead * feed_scale_) < kMaxIncrements) || !(lead > 0)) {
    Refuse(diag::Code::kOutOfRange, fmt::format("lead {}", lead), "what a word can hold");
    return;
  }
  const std::int64_t rounded = RoundToIncrements(lead, feed_scale_);
  // The error of the lead grows with each revolution: it may make up half an increment over the whole thread.
  const double error = std::fabs(static_cast<double>(rounded) / feed_scale_ - lead);
  if (rounded == 0 || error * Length(longest) / lead > 0.5 / feed_scale_ + 1e-12) {
    Refuse(diag::Code::kWordTooCoarse, fmt::format("lead {}", event.value), fmt::format("{}", decimals_));
    return;
  }
  BeginLine();
  AppendModes(event, false);
  Put("G33");
  motion_ = ir::Motion::kThread;
  for (std::uint32_t rest = event.known_axes; rest != 0; rest &= rest - 1) {
    const auto axis = static_cast<std::uint8_t>(std::countr_zero(rest));
    const std::int64_t value = Grid(axis, event.position[axis]);
    if (value == at_[axis] && (event.moved_axes >> axis & 1U) == 0) continue;
    AppendAxis(axis, value);
  }
  AppendNumber(static_cast<char>('I' + along), rounded);
  EndLine();
}

}  // namespace ncport::backends::iso
