#include "app/envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/letter_case.h"
#include "ir/axis_names.h"

namespace ncport::app {
namespace {

double WithinTurn(double angle) {
  const double turn = 2 * std::numbers::pi;
  const double rest = std::fmod(angle, turn);
  return rest < 0 ? rest + turn : rest;
}

}  // namespace

void Envelopes::Select(const std::string& name) {
  const auto known = std::find_if(tools_.begin(), tools_.end(), [&](const Tool& tool) { return tool.name == name; });
  now_ = static_cast<std::size_t>(known - tools_.begin());
  if (known == tools_.end()) tools_.emplace_back().name = name;
  rapid_ = true;
}

void Envelopes::Take(Tool& tool, std::uint8_t axis, double value) const {
  const auto bit = static_cast<std::uint16_t>(1U << axis);
  const bool known = (tool.known & bit) != 0;
  tool.low[axis] = known ? std::min(tool.low[axis], value) : value;
  tool.high[axis] = known ? std::max(tool.high[axis], value) : value;
  tool.known |= bit;
}

/// The points of the arc where one axis of the plane turns back.
void Envelopes::Bulge(Tool& tool, const exec::Event& event) const {
  const std::uint8_t first = event.plane == ir::Plane::kZX ? 2 : event.plane == ir::Plane::kYZ ? 1 : 0;
  const std::uint8_t second = event.plane == ir::Plane::kZX ? 0 : event.plane == ir::Plane::kYZ ? 2 : 1;
  const double from = std::atan2(event.from[second] - event.center[1], event.from[first] - event.center[0]);
  const double to = std::atan2(event.position[second] - event.center[1], event.position[first] - event.center[0]);
  const bool whole = event.full_circle || event.turns != 0;
  const double sweep = WithinTurn(event.clockwise ? from - to : to - from);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double angle = quarter * std::numbers::pi / 2;
    if (!whole && WithinTurn(event.clockwise ? from - angle : angle - from) > sweep) continue;
    const std::uint8_t axis = quarter % 2 == 0 ? first : second;
    Take(tool, axis, event.center[quarter % 2] + (quarter < 2 ? event.radius : -event.radius));
  }
}

void Envelopes::Move(const exec::Event& event) {
  using exec::EventKind;
  Tool& tool = tools_[now_];
  const bool feed = event.kind != EventKind::kRapid;
  if (feed && rapid_ && at_.known != 0) {
    at_.block = event.block;
    if (!tool.approached) tool.first = at_;
    tool.last = at_;
    tool.approached = true;
  }
  rapid_ = !feed;
  at_.known = event.known_axes;
  std::copy(std::begin(event.position), std::end(event.position), std::begin(at_.position));
  for (std::uint32_t rest = event.known_axes; rest != 0; rest &= rest - 1) {
    const auto axis = static_cast<std::uint8_t>(std::countr_zero(rest));
    Take(tool, axis, event.position[axis]);
  }
  if (event.kind == EventKind::kArc) Bulge(tool, event);
  if (event.kind != EventKind::kLine && event.kind != EventKind::kArc && event.kind != EventKind::kProbe) return;
  if (event.feed_mode == ir::FeedMode::kPerMinute) tool.feed = std::max(tool.feed, event.feed);
  if (event.feed_mode == ir::FeedMode::kPerRevolution)
    tool.feed_per_revolution = std::max(tool.feed_per_revolution, event.feed);
}

bool Envelopes::OnEvent(const exec::Event& event) {
  using exec::EventKind;
  transverse_axis_ = event.transverse_axis;
  switch (event.kind) {
    case EventKind::kRapid:
    case EventKind::kLine:
    case EventKind::kArc:
    case EventKind::kThread:
    case EventKind::kTap:
    case EventKind::kProbe:
      Move(event);
      break;
    case EventKind::kRapidMachine:
    case EventKind::kReference:
      rapid_ = true;
      at_.known = static_cast<std::uint16_t>(at_.known & ~event.moved_axes);
      break;
    case EventKind::kTool:
      called_ = event.text.empty() ? fmt::format("T{}", event.number) : fmt::format("T=\"{}\"", event.text);
      if (!event.tool_waits) Select(called_);
      break;
    case EventKind::kAux:
      if (event.tool_change) Select(called_);
      break;
    case EventKind::kSpindleSpeed:
      tools_[now_].speed = std::max(tools_[now_].speed, event.value);
      break;
    case EventKind::kSpindleSurface:
      tools_[now_].surface_speed = std::max(tools_[now_].surface_speed, event.value);
      break;
    default:
      break;
  }
  return next_ == nullptr || next_->OnEvent(event);
}

std::vector<ReportEnvelope> Envelopes::Result(const SourceFiles& files, const dialects::Config* config) const {
  const auto point_of = [&](const Point& point) {
    ReportPoint shown;
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      if ((point.known >> axis & 1U) != 0) shown.axes.emplace_back(ir::AxisName(module_, axis), point.position[axis]);
    }
    if (point.block.Valid()) shown.source = PlaceForReport(module_.RangeOf(module_.blocks[point.block]), files);
    return shown;
  };
  const auto limit_of = [&](std::string_view name) -> const dialects::Limit* {
    if (config == nullptr) return nullptr;
    for (const dialects::Limit& limit : config->limits) {
      if (limit.name == name) return &limit;
    }
    return nullptr;
  };
  const auto positive = [](double value) { return value < 0 ? std::optional<double>() : value; };
  std::vector<ReportEnvelope> result;
  for (const Tool& tool : tools_) {
    const bool idle = tool.known == 0 && tool.speed < 0 && tool.surface_speed < 0;
    if (idle && tool.name.empty()) continue;
    ReportEnvelope& envelope = result.emplace_back();
    envelope.tool = tool.name;
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      if ((tool.known >> axis & 1U) == 0) continue;
      ReportAxis& shown = envelope.axes.emplace_back();
      shown.name = ir::AxisName(module_, axis);
      shown.low = tool.low[axis];
      shown.high = tool.high[axis];
      // Whether a limit of the transverse axis is a radius or a diameter is not said anywhere: it is not compared.
      if (axis == transverse_axis_) continue;
      if (const dialects::Limit* limit = limit_of(LowerOf(shown.name))) {
        shown.low_limit = limit->least;
        shown.high_limit = limit->most;
      }
    }
    if (const dialects::Limit* limit = limit_of("spindle")) envelope.speed_limit = limit->most;
    if (const dialects::Limit* limit = limit_of("feed")) envelope.feed_limit = limit->most;
    if (tool.approached) {
      envelope.first_approach = point_of(tool.first);
      envelope.last_approach = point_of(tool.last);
    }
    envelope.speed = positive(tool.speed);
    envelope.surface_speed = positive(tool.surface_speed);
    envelope.feed = positive(tool.feed);
    envelope.feed_per_revolution = positive(tool.feed_per_revolution);
  }
  return result;
}

}  // namespace ncport::app
