#include "dialects/modal_names.h"

#include <fmt/format.h>

#include <string>

namespace ncport::dialects {
namespace {

using ir::ModalState;

constexpr std::string_view kMotion[] = {
    "unknown",           "none",    "rapid",       "linear",       "arc-cw",
    "arc-ccw",           "arc-via", "arc-tangent", "thread",       "thread-increasing",
    "thread-decreasing", "tap-in",  "tap-out",     "tap-floating", "probe"};
constexpr std::string_view kPlane[] = {"unknown", "xy", "zx", "yz"};
constexpr std::string_view kDistance[] = {"unknown", "absolute", "incremental"};
constexpr std::string_view kUnits[] = {"unknown", "mm", "inch", "mm-geometry", "inch-geometry"};
constexpr std::string_view kFeed[] = {"unknown", "per-minute", "per-revolution", "inverse-time"};
constexpr std::string_view kSpeed[] = {"unknown", "rpm", "constant-surface"};
constexpr std::string_view kComp[] = {"unknown", "off", "left", "right"};
constexpr std::string_view kDiameter[] = {"unknown", "radius", "diameter", "diameter-absolute"};
constexpr std::string_view kPath[] = {"unknown", "exact", "continuous"};
constexpr std::string_view kReturn[] = {"unknown", "initial", "r-plane"};

constexpr ModalGroup kGroups[] = {
    {"motion", kMotion, "how a bare axis word moves",
     [](ModalState& s, std::uint8_t v) { s.motion = static_cast<ir::Motion>(v); }},
    {"plane", kPlane, "plane of arcs and compensation",
     [](ModalState& s, std::uint8_t v) { s.plane = static_cast<ir::Plane>(v); }},
    {"distance", kDistance, "absolute or incremental words",
     [](ModalState& s, std::uint8_t v) { s.distance = static_cast<ir::Distance>(v); }},
    {"units", kUnits, "unit of lengths; -geometry: the feed stays in the basic unit",
     [](ModalState& s, std::uint8_t v) { s.units = static_cast<ir::Units>(v); }},
    {"feed", kFeed, "unit of F", [](ModalState& s, std::uint8_t v) { s.feed_mode = static_cast<ir::FeedMode>(v); }},
    {"speed", kSpeed, "unit of S", [](ModalState& s, std::uint8_t v) { s.speed_mode = static_cast<ir::SpeedMode>(v); }},
    {"comp", kComp, "cutter compensation",
     [](ModalState& s, std::uint8_t v) { s.comp = static_cast<ir::CutterComp>(v); }},
    {"diameter", kDiameter, "words of the transverse axis",
     [](ModalState& s, std::uint8_t v) { s.diameter = static_cast<ir::Diameter>(v); }},
    {"path", kPath, "exact stop or continuous path",
     [](ModalState& s, std::uint8_t v) { s.path = static_cast<ir::PathMode>(v); }},
    {"return", kReturn, "level to which drilling cycles return",
     [](ModalState& s, std::uint8_t v) { s.return_level = static_cast<ir::ReturnLevel>(v); }},
    {"work-offset", {}, "number of the work offset as the language writes it (54); 0 = none", nullptr},
};
static_assert(std::size(kMotion) == static_cast<std::size_t>(ir::Motion::kProbe) + 1);
static_assert(std::size(kPlane) == static_cast<std::size_t>(ir::Plane::kYZ) + 1);
static_assert(std::size(kUnits) == static_cast<std::size_t>(ir::Units::kInchGeometry) + 1);
static_assert(std::size(kFeed) == static_cast<std::size_t>(ir::FeedMode::kInverseTime) + 1);
static_assert(std::size(kDiameter) == static_cast<std::size_t>(ir::Diameter::kDiameterAbsolute) + 1);

}  // namespace

std::span<const ModalGroup> ModalGroups() { return kGroups; }

std::string ValuesOf(const ModalGroup& group) {
  if (group.set == nullptr) return "unknown | 0 .. 599";
  return fmt::format("{}", fmt::join(group.names, " | "));
}

bool SetModalGroup(const ModalGroup& group, std::string_view path, const TomlNode& value, ModalState& state,
                   diag::Sink& sink) {
  if (group.set == nullptr) {
    if (value.IsText("unknown")) {
      state.work_offset = {};
      return true;
    }
    if (value.kind == TomlKind::kInteger && value.integer >= 0 && value.integer <= 599) {
      state.work_offset = {true, static_cast<std::uint16_t>(value.integer), 0};
      return true;
    }
  } else if (value.kind == TomlKind::kText) {
    for (std::size_t i = 0; i < group.names.size(); ++i) {
      if (group.names[i] == value.text) {
        group.set(state, static_cast<std::uint8_t>(i));
        return true;
      }
    }
  }
  sink.Report(diag::Code::kWrongKeyValue, value.at, path, value.Describe(), "one of " + ValuesOf(group));
  return false;
}

}  // namespace ncport::dialects
