// Trace text (contracts section 5) as data, and the two comparisons that the tests need: of a vector with its expected
// lines (section 6, "A vector"), and of a program with its flat form read back (section 6, "Two programs").
// Written apart from the product's own comparison, so that one can judge the other.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ncport::tests {

inline constexpr std::string_view kTraceAxes = "XYZABCUVW";

/// One event line. `line` is the text as printed; the other fields are filled for RAPID, LINE, ARC, THREAD and TAP.
struct TraceEvent {
  std::string line;
  std::string kind;                           // first word; "RAPID MCS" for moves in machine coordinates
  std::array<std::optional<double>, 9> axes;  // by kTraceAxes; the transverse axis is a radius
  bool diameter = false;                      // printed as Xr
  bool clockwise = false;                     // ARC
  std::string plane;                          // ARC: "XY", "ZX", "YZ"
  double center[2] = {};                      // ARC: in the plane's axis order
  int turns = 0;                              // ARC: additional full turns
  std::string feed;                           // behind F, with its unit: "100", "0.2/r"; empty: none
  double pitch = 0, start = 0, change = 0;    // THREAD, TAP

  [[nodiscard]] bool IsMove() const {
    return kind == "RAPID" || kind == "LINE" || kind == "ARC" || kind == "THREAD" || kind == "TAP";
  }
};

struct Trace {
  std::vector<TraceEvent> events;
  std::vector<std::pair<std::string, std::string>> sets;  // SET name, value, in the order printed
};

/// Reads trace text. Lines that begin with `#` are left out. A line that is no event of section 5 comes back in
/// `error`.
struct ParsedTrace {
  Trace trace;
  std::string error;  // empty: all lines were understood
};
ParsedTrace ParseTrace(std::string_view text);

/// Drops the RAPID and LINE moves to the place where the tool already stands. Kept are the first move of an axis, full
/// circles, and the move after a change of tool, offset, work offset or compensation.
void DropStandingMoves(Trace& trace);

/// What is different, in words with both lines; none = they agree. `actual` and `expected` are whole traces.
std::optional<std::string> CompareVector(Trace actual, Trace expected);

/// Allowances of the comparison of a program with its flat form.
struct FlatAllowance {
  double increment = 0.001;     // of the flat side's axis words, mm or degrees
  bool diameter_words = false;  // the flat side writes X as a diameter: its error is halved
  double feed_increment = 0.001;
  /// Event lines of the source and what they become: tool and offset maps ("TOOL \"ROUGH\"" -> "TOOL 1").
  std::vector<std::pair<std::string, std::string>> maps;
};
/// Compares over all kinds but MSG, PRINT and PATH, which the flat form lists as lost; SPINDLE lines as the state in
/// force at each cutting move and at the end.
std::optional<std::string> CompareWithFlat(Trace source, Trace flat, const FlatAllowance& allowance);

}  // namespace ncport::tests
