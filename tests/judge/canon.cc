#include "tests/judge/canon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace ncport::tests {
namespace {

// rs274 prints four decimals; the flat program that it reads has five.
constexpr double kTolerance = 0.0001;
constexpr std::size_t kCanonAxes = 6;  // X Y Z A B C

std::vector<std::string> Arguments(const std::string& inside) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (at <= inside.size()) {
    const std::size_t end = std::min(inside.find(',', at), inside.size());
    const std::size_t first = std::min(inside.find_first_not_of(' ', at), end);
    parts.push_back(inside.substr(first, end - first));
    at = end + 1;
  }
  return parts;
}

/// Calls that say nothing about what the machine does, or only prepare a call that does.
constexpr std::string_view kSilent[] = {"COMMENT",
                                        "MESSAGE",
                                        "USE_LENGTH_UNITS",
                                        "SET_G5X_OFFSET",
                                        "SET_G92_OFFSET",
                                        "SET_XY_ROTATION",
                                        "SET_FEED_REFERENCE",
                                        "ON_RESET",
                                        "SELECT_TOOL",
                                        "START_CHANGE",
                                        "USE_TOOL_LENGTH_OFFSET",
                                        "SET_SPINDLE_MODE",
                                        "PALLET_SHUTTLE",
                                        "SET_MOTION_CONTROL_MODE",
                                        "SET_NAIVECAM_TOLERANCE"};

std::string Text(double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.4f", value);
  return buffer;
}

class Reader {
 public:
  /// False: a call that is not known.
  bool Take(const std::string& name, const std::string& inside) {
    const std::vector<std::string> a = Arguments(inside);
    const auto number = [&](std::size_t i) { return i < a.size() ? std::strtod(a[i].c_str(), nullptr) : 0.0; };
    if (name != "CHANGE_TOOL") FlushSpindleStop();
    if (name == "USE_LENGTH_UNITS") return inside == "CANON_UNITS_MM";
    if (name == "COMMENT") {
      if (inside.find("feed mode set to inverse time") != std::string::npos) inverse_ = true;
      if (inside.find("feed mode set to units") != std::string::npos) inverse_ = false;
      return true;
    }
    if (std::find(std::begin(kSilent), std::end(kSilent), name) != std::end(kSilent)) return true;
    if (name == "SELECT_PLANE") {
      plane_ = inside == "CANON_PLANE_XY" ? "XY" : inside == "CANON_PLANE_XZ" ? "ZX" : "YZ";
    } else if (name == "SET_FEED_MODE") {
      per_revolution_ = number(1) != 0;
    } else if (name == "SET_FEED_RATE") {
      feed_ = number(0);
    } else if (name == "STRAIGHT_TRAVERSE" || name == "STRAIGHT_FEED") {
      for (std::size_t i = 0; i < kCanonAxes; ++i) at_[i] = number(i);
      TraceEvent event = Move(name == "STRAIGHT_TRAVERSE" ? "RAPID" : lead_ != 0 ? "THREAD" : "LINE");
      event.pitch = lead_;
      Add(std::move(event), inside);
    } else if (name == "ARC_FEED") {
      static constexpr std::size_t axes[3][3] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
      const auto& order = axes[plane_ == "XY" ? 0 : plane_ == "ZX" ? 1 : 2];
      at_[order[0]] = number(0);
      at_[order[1]] = number(1);
      at_[order[2]] = number(5);
      for (std::size_t i = 3; i < kCanonAxes; ++i) at_[i] = number(i + 3);
      TraceEvent event = Move("ARC");
      const int rotation = static_cast<int>(number(4));
      event.clockwise = rotation < 0;
      event.turns = std::abs(rotation) - 1;
      event.plane = plane_;
      event.center[0] = number(2);
      event.center[1] = number(3);
      Add(std::move(event), inside);
    } else if (name == "START_SPEED_FEED_SYNC" || name == "START_SPEED_FEED_SYNCH") {
      lead_ = number(0);
    } else if (name == "STOP_SPEED_FEED_SYNCH") {
      lead_ = 0;
    } else if (name == "DWELL") {
      Add({.kind = "DWELL"}, Text(number(0)));
    } else if (name == "CHANGE_TOOL") {
      spindle_stops_ = false;  // rs274 stops the spindle for a tool change by itself
      Add({.kind = "TOOL"}, a[0]);
    } else if (name == "STOP_SPINDLE_TURNING") {
      spindle_stops_ = true;
    } else if (name == "START_SPINDLE_CLOCKWISE") {
      Add({.kind = "SPINDLE"}, "CW");
    } else if (name == "START_SPINDLE_COUNTERCLOCKWISE") {
      Add({.kind = "SPINDLE"}, "CCW");
    } else if (name == "SET_SPINDLE_SPEED") {
      Add({.kind = "SPINDLE"}, "RPM " + a.back());
    } else if (name == "FLOOD_ON") {
      Add({.kind = "M8"}, "");
    } else if (name == "MIST_ON") {
      Add({.kind = "M7"}, "");
    } else if (name == "FLOOD_OFF" || name == "MIST_OFF") {
      Add({.kind = name}, "");
    } else if (name == "PROGRAM_STOP") {
      Add({.kind = "STOP"}, "");
    } else if (name == "OPTIONAL_PROGRAM_STOP") {
      Add({.kind = "OPTSTOP"}, "");
    } else if (name == "PROGRAM_END") {
      Add({.kind = "END"}, "");
    } else {
      return false;
    }
    return true;
  }

  Trace trace;

 private:
  TraceEvent Move(const char* kind) const {
    TraceEvent event;
    event.kind = kind;
    for (std::size_t i = 0; i < kCanonAxes; ++i) event.axes[i] = at_[i];
    if (event.kind != "RAPID" && event.kind != "THREAD")
      event.feed = Text(feed_) + (inverse_ ? "/t" : per_revolution_ ? "/r" : "");
    return event;
  }
  void Add(TraceEvent event, const std::string& rest) {
    event.line = event.kind + (rest.empty() ? "" : " " + rest);
    trace.events.push_back(std::move(event));
  }
  void FlushSpindleStop() {
    if (!spindle_stops_) return;
    spindle_stops_ = false;
    Add({.kind = "SPINDLE"}, "STOP");
  }

  std::array<double, kCanonAxes> at_{};
  std::string plane_ = "XY";
  double feed_ = 0;
  double lead_ = 0;
  bool per_revolution_ = false;
  bool inverse_ = false;
  bool spindle_stops_ = false;
};

/// A trace reduced to what both sides know: full positions from 0 on, no standing moves, spindle and coolant as state
/// of each cut: rs274 stops both at its end and the spindle at tool changes by itself.
struct Step {
  std::string text;  // the line, for messages
  std::string kind;
  std::array<double, 9> at{};
  TraceEvent event;
  std::string state;  // of spindle and coolant at cuts: "CW 1000 M8"
};

/// Flat blocks have no word for additional turns: they write them as full circles in front of the arc, with the way
/// across spread evenly over the whole angle. Here the same is done to an arc with turns.
Trace WithoutTurns(const Trace& trace) {
  static constexpr std::size_t axes[3][2] = {{0, 1}, {2, 0}, {1, 2}};
  Trace result;
  std::array<double, 9> at{};
  for (const TraceEvent& event : trace.events) {
    const std::array<double, 9> from = at;
    if (event.IsMove()) {
      for (std::size_t i = 0; i < at.size(); ++i) at[i] = event.axes[i].value_or(at[i]);
    }
    if (event.turns != 0) {
      const auto& plane = axes[event.plane == "XY" ? 0 : event.plane == "ZX" ? 1 : 2];
      const auto angle = [&](const std::array<double, 9>& point) {
        return std::atan2(point[plane[1]] - event.center[1], point[plane[0]] - event.center[0]) /
               (2 * std::numbers::pi);
      };
      double rest = angle(at) - angle(from);
      if (event.clockwise) rest = -rest;
      if (rest <= 1e-9) rest += 1;
      TraceEvent circle = event;
      circle.turns = 0;
      for (int turn = 1; turn <= event.turns; ++turn) {
        for (std::size_t i = 0; i < at.size(); ++i) {
          if (!event.axes[i]) continue;
          circle.axes[i] =
              i == plane[0] || i == plane[1] ? from[i] : from[i] + (at[i] - from[i]) * turn / (event.turns + rest);
        }
        result.events.push_back(circle);
      }
    }
    result.events.push_back(event);
    result.events.back().turns = 0;
  }
  return result;
}

std::vector<Step> Steps(const Trace& whole) {
  const Trace trace = WithoutTurns(whole);
  std::vector<Step> steps;
  std::array<double, 9> at{};
  std::string sense = "STOP", speed = "0.0000";
  bool flood = false, mist = false;
  for (const TraceEvent& event : trace.events) {
    Step step{event.line, event.kind, at, event, {}};
    if (event.kind.rfind("SPINDLE", 0) == 0) {
      const std::string rest = event.line.substr(event.kind.size() + 1);
      (rest.rfind("RPM", 0) == 0 ? speed : sense) =
          rest.rfind("RPM", 0) == 0 ? Text(std::strtod(rest.c_str() + 4, nullptr)) : rest;
      continue;
    }
    flood = event.kind == "M8" || (flood && event.kind != "M9" && event.kind != "FLOOD_OFF");
    mist = event.kind == "M7" || (mist && event.kind != "M9" && event.kind != "MIST_OFF");
    static constexpr std::string_view compared[] = {"RAPID", "LINE", "ARC",     "THREAD", "DWELL",
                                                    "TOOL",  "STOP", "OPTSTOP", "END"};
    if (std::find(std::begin(compared), std::end(compared), event.kind) == std::end(compared)) continue;
    if (event.IsMove()) {
      bool moves = event.kind != "RAPID" && event.kind != "LINE";
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (!event.axes[i]) continue;
        moves |= std::abs(*event.axes[i] - at[i]) > kTolerance;
        at[i] = *event.axes[i];
      }
      if (!moves) continue;
      step.at = at;
      if (event.kind != "RAPID") step.state = sense + " " + speed + (flood ? " M8" : "") + (mist ? " M7" : "");
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

bool Near(double a, double b) {
  return std::abs(a - b) <= std::max(kTolerance, 1e-6 * std::max(std::abs(a), std::abs(b)));
}

bool SameFeed(const std::string& a, const std::string& b) {
  char* a_end = nullptr;
  char* b_end = nullptr;
  const double x = std::strtod(a.c_str(), &a_end), y = std::strtod(b.c_str(), &b_end);
  return Near(x, y) && std::string_view(a_end) == std::string_view(b_end);
}

/// An arc of several turns is written as that many full circles and the rest (flat blocks have no word for turns).
/// Joins them behind `first` when sense, plane and centre are the same, each piece but the last is a full circle, and
/// the third axis runs evenly over the whole angle. `turns`: how many full circles. False: these steps are not such an
/// arc.
bool JoinTurns(std::vector<Step>& steps, std::size_t first, int turns, const std::array<double, 9>& from) {
  if (first + static_cast<std::size_t>(turns) >= steps.size()) return false;
  const TraceEvent& head = steps[first].event;
  const std::size_t a = head.plane == "XY" ? 0 : head.plane == "ZX" ? 2 : 1;
  const std::size_t b = (a + 1) % 3, normal = (a + 2) % 3;
  Step& last = steps[first + static_cast<std::size_t>(turns)];
  const auto angle_of = [&](const std::array<double, 9>& at) {
    return std::atan2(at[b] - head.center[1], at[a] - head.center[0]);
  };
  constexpr double kTurn = 6.283185307179586;
  double rest = (angle_of(last.at) - angle_of(from)) * (head.clockwise ? -1 : 1);
  while (rest <= 1e-9) rest += kTurn;
  const double slope = (last.at[normal] - from[normal]) / (kTurn * turns + rest);
  for (int i = 0; i <= turns; ++i) {
    const Step& piece = steps[first + static_cast<std::size_t>(i)];
    const TraceEvent& event = piece.event;
    if (piece.kind != "ARC" || event.turns != 0 || event.clockwise != head.clockwise || event.plane != head.plane)
      return false;
    if (!Near(event.center[0], head.center[0]) || !Near(event.center[1], head.center[1])) return false;
    if (i == turns) break;
    if (!Near(piece.at[a], from[a]) || !Near(piece.at[b], from[b])) return false;
    if (!Near(piece.at[normal], from[normal] + slope * kTurn * (i + 1))) return false;
  }
  last.event.turns = turns;
  steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(first),
              steps.begin() + static_cast<std::ptrdiff_t>(first) + turns);
  return true;
}

bool Same(const Step& ours, const Step& judge) {
  if (ours.kind != judge.kind) return false;
  for (std::size_t i = 0; i < ours.at.size(); ++i) {
    if (!Near(ours.at[i], judge.at[i])) return false;
  }
  const TraceEvent &a = ours.event, &b = judge.event;
  if (ours.kind == "DWELL" || ours.kind == "TOOL") {
    return Near(std::strtod(a.line.c_str() + a.kind.size(), nullptr),
                std::strtod(b.line.c_str() + b.kind.size(), nullptr));
  }
  if (ours.kind == "ARC") {
    if (a.clockwise != b.clockwise || a.plane != b.plane || a.turns != b.turns) return false;
    if (!Near(a.center[0], b.center[0]) || !Near(a.center[1], b.center[1])) return false;
  }
  if (ours.kind == "THREAD")
    return Near(a.pitch, b.pitch) && a.start == 0 && a.change == 0 && ours.state == judge.state;
  if (ours.kind == "LINE" || ours.kind == "ARC") return SameFeed(a.feed, b.feed) && ours.state == judge.state;
  return true;
}

}  // namespace

ParsedTrace ParseCanon(std::string_view text) {
  Reader reader;
  ParsedTrace result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line(text.substr(at, end - at));
    at = end + 1;
    // "   24 N..... STRAIGHT_TRAVERSE(1.0000, ...)"
    const std::size_t mark = line.find(" N");
    const std::size_t open = line.find('(');
    const std::size_t close = line.rfind(')');
    if (mark == std::string::npos || open == std::string::npos || close == std::string::npos || close < open) continue;
    const std::size_t name = line.find_last_of(' ', open) + 1;
    if (!reader.Take(line.substr(name, open - name), line.substr(open + 1, close - open - 1))) {
      result.error = "a canonical call that the judge does not know: " + line;
      return result;
    }
  }
  result.trace = std::move(reader.trace);
  return result;
}

std::string ReasonNotToAsk(const Trace& trace) {
  bool speed = false;  // a spindle speed was programmed
  for (const TraceEvent& event : trace.events) {
    speed = speed || event.line.starts_with("SPINDLE RPM");
    if (!speed && event.line.ends_with("/r") && (event.kind == "LINE" || event.kind == "ARC"))
      return "feed per revolution while the program leaves the spindle alone: rs274 wants a speed";
    if (event.kind == "ALARM") return "ends in an alarm, so there is no flat program";
    if (event.kind == "TAP") return "TAP: rs274 has no tapping of this kind";
    if (event.kind == "PROBE") return "PROBE: needs a probe";
    if (event.kind == "RAPID MCS" || event.kind == "REFPOINT")
      return event.kind + ": machine positions are unknown to ncport and 0 to rs274";
    if (event.kind == "DWELL" && event.line.ends_with("/r")) return "DWELL in revolutions: rs274 knows seconds";
    if (event.kind == "THREAD" && (event.start != 0 || event.change != 0))
      return "THREAD with start angle or variable pitch: not in rs274";
    for (const char* word : {"SPINDLE POS", "SPINDLE CSS", "SPINDLE LIMIT", "SPINDLE2"}) {
      if (event.line.rfind(word, 0) == 0) return std::string(word) + ": not compared with rs274";
    }
    for (std::size_t i = kCanonAxes; i < event.axes.size(); ++i) {
      if (event.axes[i]) return "axis U, V or W: not compared with rs274";
    }
  }
  return {};
}

std::optional<std::string> CompareWithCanon(const Trace& trace, const Trace& canon) {
  const std::vector<Step> ours = Steps(trace);
  std::vector<Step> judge = Steps(canon);
  for (std::size_t i = 0; i < std::max(ours.size(), judge.size()); ++i) {
    if (i < ours.size() && ours[i].event.turns > 0 && i < judge.size() && judge[i].event.turns == 0) {
      JoinTurns(judge, i, ours[i].event.turns, i == 0 ? std::array<double, 9>{} : ours[i - 1].at);
    }
    if (i < ours.size() && i < judge.size() && Same(ours[i], judge[i])) continue;
    std::string text = "step " + std::to_string(i + 1);
    text += "\n  ncport: " +
            (i < ours.size() ? ours[i].text + (ours[i].state.empty() ? "" : "  [" + ours[i].state + "]") : "(nothing)");
    text += "\n  rs274:  ";
    if (i < judge.size()) {
      text += judge[i].text + (judge[i].event.feed.empty() ? "" : " F" + judge[i].event.feed) +
              (judge[i].state.empty() ? "" : "  [" + judge[i].state + "]");
    } else {
      text += "(nothing)";
    }
    return text;
  }
  return std::nullopt;
}

}  // namespace ncport::tests
