#include "tests/tools/trace_compare.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>

namespace ncport::tests {
namespace {

constexpr double kVectorTolerance = 0.0001;
constexpr double kRelativeTolerance = 1e-6;

std::vector<std::string> Words(std::string_view line) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    if (end > at) words.emplace_back(line.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

std::optional<double> Number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

bool IsAuxiliary(const std::string& kind) {
  return kind.size() > 1 && kind[0] == 'M' &&
         std::all_of(kind.begin() + 1, kind.end(), [](unsigned char c) { return std::isdigit(c); });
}

bool IsSpindle(const std::string& kind) { return kind.rfind("SPINDLE", 0) == 0; }

constexpr std::string_view kOtherKinds[] = {"RAPID MCS", "REFPOINT", "PROBE",   "DWELL", "TOOL",
                                            "OFFSET",    "COMP",     "WCS",     "PATH",  "MSG",
                                            "PRINT",     "STOP",     "OPTSTOP", "ALARM", "END"};

/// Fills the fields of a move from its words; false: a word that has no place in this kind of line.
bool FillMove(TraceEvent& event, const std::vector<std::string>& words) {
  std::size_t i = 1;
  if (event.kind == "ARC") {
    if (words.size() < 3 || (words[1] != "CW" && words[1] != "CCW")) return false;
    event.clockwise = words[1] == "CW";
    event.plane = words[2];
    if (event.plane != "XY" && event.plane != "ZX" && event.plane != "YZ") return false;
    i = 3;
  }
  bool has_center = false;
  for (; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto named = [&](double& target) {
      if (++i >= words.size()) return false;
      const auto value = Number(words[i]);
      target = value.value_or(0);
      return value.has_value();
    };
    if (word == "center") {
      if (++i >= words.size()) return false;
      const std::string& pair = words[i];
      const std::size_t comma = pair.find(',');
      if (pair.size() < 5 || pair.front() != '(' || pair.back() != ')' || comma == std::string::npos) return false;
      const auto first = Number(std::string_view(pair).substr(1, comma - 1));
      const auto second = Number(std::string_view(pair).substr(comma + 1, pair.size() - comma - 2));
      if (!first || !second) return false;
      event.center[0] = *first;
      event.center[1] = *second;
      has_center = true;
    } else if (word == "turns") {
      double turns = 0;
      if (!named(turns)) return false;
      event.turns = static_cast<int>(turns);
    } else if (word == "pitch") {
      if (!named(event.pitch)) return false;
    } else if (word == "start") {
      if (!named(event.start)) return false;
    } else if (word == "change") {
      if (!named(event.change)) return false;
    } else if (word[0] == 'F') {
      event.feed = word.substr(1);
    } else {
      const std::size_t axis = kTraceAxes.find(word[0]);
      const bool diameter = word.size() > 1 && word[1] == 'r';
      const auto value = Number(std::string_view(word).substr(diameter ? 2 : 1));
      if (axis == std::string_view::npos || !value || event.axes[axis]) return false;
      event.axes[axis] = *value;
      event.diameter |= diameter;
    }
  }
  return event.kind != "ARC" || has_center;
}

bool IsKnownKind(const TraceEvent& event) {
  return event.IsMove() || IsAuxiliary(event.kind) || IsSpindle(event.kind) ||
         std::find(std::begin(kOtherKinds), std::end(kOtherKinds), event.kind) != std::end(kOtherKinds);
}

/// Splits a word into numbers and the text between them: "F0.2/r" -> "F", 0.2, "/r".
struct Piece {
  std::string text;
  std::optional<double> number;
};
std::vector<Piece> Pieces(std::string_view text) {
  std::vector<Piece> pieces;
  std::size_t at = 0;
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  const auto starts = [&](std::size_t i) {
    return digit(i) || (i < text.size() && text[i] == '.' && digit(i + 1)) ||
           (i < text.size() && text[i] == '-' &&
            (digit(i + 1) || (i + 1 < text.size() && text[i + 1] == '.' && digit(i + 2))));
  };
  while (at < text.size()) {
    std::size_t end = at;
    if (starts(at)) {
      ++end;
      while (digit(end) || (end < text.size() && text[end] == '.')) ++end;
      pieces.push_back({std::string(text.substr(at, end - at)), Number(text.substr(at, end - at))});
    } else {
      while (end < text.size() && !starts(end)) ++end;
      pieces.push_back({std::string(text.substr(at, end - at)), std::nullopt});
    }
    at = end;
  }
  return pieces;
}

bool Near(double a, double b, double tolerance) {
  return std::abs(a - b) <= std::max(tolerance, kRelativeTolerance * std::max(std::abs(a), std::abs(b)));
}

/// Texts that agree but for small differences of the numbers in them.
bool SameText(std::string_view a, std::string_view b, double tolerance) {
  const std::vector<Piece> left = Pieces(a), right = Pieces(b);
  return std::equal(left.begin(), left.end(), right.begin(), right.end(), [&](const Piece& x, const Piece& y) {
    if (x.number && y.number) return Near(*x.number, *y.number, tolerance);
    return x.text == y.text;
  });
}

std::string WithoutDiameterMark(std::string line) {
  const std::size_t at = line.find(" Xr");
  if (at != std::string::npos) line.erase(at + 2, 1);
  return line;
}

bool SameVectorEvent(const TraceEvent& a, const TraceEvent& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == "MSG" || a.kind == "PRINT") return a.line == b.line;
  if (a.kind == "ALARM") {
    const auto left = Words(a.line), right = Words(b.line);
    return left.size() > 1 && right.size() > 1 && left[1] == right[1];
  }
  return SameText(WithoutDiameterMark(a.line), WithoutDiameterMark(b.line), kVectorTolerance);
}

bool IsVectorKind(const TraceEvent& event) {
  static constexpr std::string_view kinds[] = {"DWELL", "MSG", "PRINT", "STOP", "OPTSTOP", "ALARM", "END"};
  return event.IsMove() || event.kind == "RAPID MCS" || IsSpindle(event.kind) || IsAuxiliary(event.kind) ||
         std::find(std::begin(kinds), std::end(kinds), event.kind) != std::end(kinds);
}

std::string Difference(std::size_t number, const TraceEvent* expected, const TraceEvent* actual) {
  return "event " + std::to_string(number) + "\n  expected: " + (expected != nullptr ? expected->line : "(nothing)") +
         "\n  actual:   " + (actual != nullptr ? actual->line : "(nothing)");
}

template <class Same>
std::optional<std::string> CompareLists(const std::vector<TraceEvent>& actual, const std::vector<TraceEvent>& expected,
                                        Same same) {
  for (std::size_t i = 0; i < std::max(actual.size(), expected.size()); ++i) {
    const TraceEvent* a = i < actual.size() ? &actual[i] : nullptr;
    const TraceEvent* e = i < expected.size() ? &expected[i] : nullptr;
    if (a == nullptr || e == nullptr || !same(*a, *e)) return Difference(i + 1, e, a);
  }
  return std::nullopt;
}

std::string UpperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// What the spindle does, for comparisons by state: last sense or position, speed mode with value, limit.
struct SpindleStates {
  struct One {
    std::string sense = "?", speed = "?", limit = "?";
    bool operator==(const One&) const = default;
  };
  std::map<std::string, One> by_name;
  void Take(const TraceEvent& event) {
    const std::vector<std::string> words = Words(event.line);
    One& one = by_name[event.kind];
    const std::string value = words.size() > 2 ? words[2] : "";
    if (words.size() < 2) return;
    if (words[1] == "RPM" || words[1] == "CSS") {
      one.speed = words[1] + " " + value;
    } else if (words[1] == "LIMIT") {
      one.limit = value;
    } else {
      one.sense = words[1] + " " + value;
    }
  }
};

bool SameSpindles(const SpindleStates& a, const SpindleStates& b) {
  return std::equal(
      a.by_name.begin(), a.by_name.end(), b.by_name.begin(), b.by_name.end(), [](const auto& x, const auto& y) {
        return x.first == y.first && SameText(x.second.sense, y.second.sense, 0.0005) &&
               SameText(x.second.speed, y.second.speed, 0.0005) && SameText(x.second.limit, y.second.limit, 0.0005);
      });
}

bool Cuts(const TraceEvent& event) {
  return event.kind == "LINE" || event.kind == "ARC" || event.kind == "THREAD" || event.kind == "TAP";
}

bool SameFlatMove(const TraceEvent& source, const TraceEvent& flat, const FlatAllowance& allowance) {
  if (source.clockwise != flat.clockwise || source.plane != flat.plane || source.turns != flat.turns) return false;
  const auto word_error = [&](std::size_t axis) {
    return allowance.increment / 2 * (axis == 0 && allowance.diameter_words ? 0.5 : 1.0);
  };
  for (std::size_t i = 0; i < kTraceAxes.size(); ++i) {
    if (source.axes[i].has_value() != flat.axes[i].has_value()) return false;
    if (source.axes[i] && !Near(*source.axes[i], *flat.axes[i], kVectorTolerance + word_error(i))) return false;
  }
  if (source.kind == "ARC") {
    for (int i = 0; i < 2; ++i) {
      if (!Near(source.center[i], flat.center[i], kVectorTolerance + allowance.increment)) return false;
    }
  }
  return Near(source.pitch, flat.pitch, allowance.feed_increment) &&
         Near(source.start, flat.start, allowance.feed_increment) &&
         Near(source.change, flat.change, allowance.feed_increment) &&
         SameText(source.feed, flat.feed, allowance.feed_increment);
}

}  // namespace

ParsedTrace ParseTrace(std::string_view text) {
  ParsedTrace result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line(text.substr(at, end - at));
    at = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> words = Words(line);
    if (words[0] == "SET") {
      const std::size_t value = words.size() < 2 ? std::string::npos : line.find(' ', 4);
      if (value == std::string::npos) {
        result.error = "a SET line without a value: " + line;
        return result;
      }
      result.trace.sets.emplace_back(line.substr(4, value - 4), line.substr(value + 1));
      continue;
    }
    TraceEvent event;
    event.line = line;
    event.kind = words[0];
    if (event.kind == "RAPID" && words.size() > 1 && words[1] == "MCS") event.kind = "RAPID MCS";
    if (!IsKnownKind(event) || (event.IsMove() && !FillMove(event, words))) {
      result.error = "not a line of a trace: " + line;
      return result;
    }
    result.trace.events.push_back(std::move(event));
  }
  return result;
}

void DropStandingMoves(Trace& trace) {
  std::array<std::optional<double>, 9> at{};
  bool fresh = false;  // a tool, offset, work offset or compensation changed since the last move
  std::vector<TraceEvent> kept;
  for (TraceEvent& event : trace.events) {
    bool drop = false;
    if (event.IsMove()) {
      drop = !fresh && (event.kind == "RAPID" || event.kind == "LINE");
      for (std::size_t i = 0; i < at.size() && drop; ++i) {
        if (event.axes[i].has_value() != at[i].has_value()) drop = false;
        if (event.axes[i] && at[i] && std::abs(*event.axes[i] - *at[i]) > 1e-9) drop = false;
      }
      at = event.axes;
      fresh = false;
    } else if (event.kind == "RAPID MCS" || event.kind == "REFPOINT" || event.kind == "PROBE") {
      at = {};
    } else if (event.kind == "TOOL" || event.kind == "OFFSET" || event.kind == "WCS" || event.kind == "COMP") {
      fresh = true;
    }
    if (!drop) kept.push_back(std::move(event));
  }
  trace.events = std::move(kept);
}

std::optional<std::string> CompareVector(Trace actual, Trace expected) {
  for (Trace* trace : {&actual, &expected}) {
    DropStandingMoves(*trace);
    std::erase_if(trace->events, [](const TraceEvent& event) { return !IsVectorKind(event); });
  }
  if (auto difference = CompareLists(actual.events, expected.events, SameVectorEvent)) return difference;
  for (const auto& [name, value] : expected.sets) {
    const std::string* found = nullptr;
    for (const auto& [other, other_value] : actual.sets) {
      if (UpperCase(other) == UpperCase(name)) found = &other_value;
    }
    if (found == nullptr)
      return "final value of " + name + "\n  expected: " + value + "\n  actual:   (not in the trace)";
    const bool text = value.starts_with('"') || found->starts_with('"');
    if (text ? *found != value : !SameText(*found, value, kVectorTolerance)) {
      return "final value of " + name + "\n  expected: " + value + "\n  actual:   " + *found;
    }
  }
  return std::nullopt;
}

std::optional<std::string> CompareWithFlat(Trace source, Trace flat, const FlatAllowance& allowance) {
  for (TraceEvent& event : source.events) {
    for (const auto& [from, to] : allowance.maps) {
      if (event.line == from) {
        event.line = to;
        event.kind = Words(to).empty() ? std::string() : Words(to)[0];
      }
    }
  }
  for (Trace* trace : {&source, &flat}) {
    DropStandingMoves(*trace);
    std::erase_if(trace->events, [](const TraceEvent& event) {
      return event.kind.empty() || event.kind == "MSG" || event.kind == "PRINT" || event.kind == "PATH";
    });
  }
  // Spindle words: a state before each cutting move instead of events.
  std::vector<SpindleStates> states[2];
  int side = 0;
  for (Trace* trace : {&source, &flat}) {
    SpindleStates now;
    for (const TraceEvent& event : trace->events) {
      if (IsSpindle(event.kind)) now.Take(event);
      if (Cuts(event) || event.kind == "END") states[side].push_back(now);
    }
    std::erase_if(trace->events, [](const TraceEvent& event) { return IsSpindle(event.kind); });
    ++side;
  }
  const auto difference = CompareLists(flat.events, source.events, [&](const TraceEvent& a, const TraceEvent& e) {
    if (a.kind != e.kind) return false;
    if (e.IsMove()) return SameFlatMove(e, a, allowance);
    return SameVectorEvent(a, e);
  });
  if (difference) return difference;
  for (std::size_t i = 0; i < std::min(states[0].size(), states[1].size()); ++i) {
    if (!SameSpindles(states[0][i], states[1][i])) {
      std::string text = "spindle state at cutting move " + std::to_string(i + 1) + "\n";
      for (int which = 0; which < 2; ++which) {
        text += which == 0 ? "  source:" : "  flat:";
        for (const auto& [name, one] : states[which][i].by_name)
          text += " " + name + ": " + one.sense + ", " + one.speed + ", limit " + one.limit + ";";
        text += "\n";
      }
      return text;
    }
  }
  return std::nullopt;
}

}  // namespace ncport::tests
