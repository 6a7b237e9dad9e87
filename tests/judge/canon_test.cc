// What rs274 prints is read right, and differences to a trace are seen. Lines as rs274 2.9 printed them.
#include "tests/judge/canon.h"

#include <doctest/doctest.h>

namespace ncport::tests {
namespace {

Trace Canon(std::string_view text) {
  const ParsedTrace parsed = ParseCanon(text);
  REQUIRE_MESSAGE(parsed.error.empty(), parsed.error);
  return parsed.trace;
}

bool Agree(std::string_view trace, std::string_view canon) {
  const ParsedTrace ours = ParseTrace(trace);
  REQUIRE_MESSAGE(ours.error.empty(), ours.error);
  return !CompareWithCanon(ours.trace, Canon(canon)).has_value();
}

constexpr std::string_view kCanon =
    "    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
    "    2 N..... SET_FEED_MODE(0, 0)\n"
    "    3 N..... STRAIGHT_TRAVERSE(1.0000, 2.0000, 3.0000, 0.0000, 0.0000, 0.0000)\n"
    "    4 N..... SET_SPINDLE_SPEED(0, 800.0000)\n"
    "    5 N..... START_SPINDLE_CLOCKWISE(0)\n"
    "    6 N..... FLOOD_ON()\n"
    "    7 N..... SET_FEED_RATE(100.0000)\n"
    "    8 N..... SELECT_PLANE(CANON_PLANE_XZ)\n"
    "    9 N..... ARC_FEED(-5.0000, 4.0000, -5.0000, 3.0000, -1, 2.0000, 0.0000, 0.0000, 0.0000)\n"
    "   10 N..... DWELL(0.5000)\n"
    "   11 N..... STRAIGHT_FEED(4.0000, 2.0000, -5.0000, 0.0000, 0.0000, 0.0000)\n"
    "   12 N..... MIST_OFF()\n"
    "   13 N..... FLOOD_OFF()\n"
    "   14 N..... START_SPEED_FEED_SYNC(1.500000,0)\n"
    "   15 N..... STRAIGHT_FEED(4.0000, 2.0000, -20.0000, 0.0000, 0.0000, 0.0000)\n"
    "   16 N..... STOP_SPEED_FEED_SYNCH()\n"
    "   17 N..... STOP_SPINDLE_TURNING(0)\n"
    "   18 N..... PROGRAM_END()\n";

constexpr std::string_view kTrace =
    "RAPID X1 Y2 Z3\nSPINDLE RPM 800\nSPINDLE CW\nM8\nARC CW ZX X4 Y2 Z-5 center (-5,3) F100\nDWELL 0.5\nM9\n"
    "THREAD X4 Y2 Z-20 pitch 1.5\nEND\n";

std::string With(std::string_view from, std::string_view to) {
  std::string text(kTrace);
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("a trace agrees with the calls of the same motions; a move to where the tool stands is none") {
  CHECK(Agree(kTrace, kCanon));
  CHECK(Agree(With("DWELL 0.5\n", "DWELL 0.5\nLINE X4 Y2 Z-5 F100\n"), kCanon));
}

TEST_CASE("each kind of difference is seen") {
  const std::pair<std::string_view, std::string_view> changes[] = {
      {"X1", "X1.001"},
      {"RAPID X1 Y2 Z3", "RAPID Y2 Z3"},
      {"CW ZX", "CCW ZX"},
      {"(-5,3)", "(-5,3.01)"},
      {"F100", "F101"},
      {"F100", "F100/r"},
      {"DWELL 0.5", "DWELL 0.6"},
      {"DWELL 0.5\n", ""},
      {"pitch 1.5", "pitch 2"},
      {"SPINDLE CW", "SPINDLE CCW"},
      {"RPM 800", "RPM 900"},
      {"M8\n", ""},
      {"M9\n", ""},
      {"END\n", ""},
      {"END\n", "STOP\nEND\n"},
      {"RAPID", "LINE"},
      {"Z-5 center", "Z-5.1 center"},
      {"(-5,3)", "(-5,3) turns 1"},
  };
  for (const auto& change : changes) {  // not a structured binding: clang 14 cannot capture one in the macro's lambda
    CHECK_MESSAGE(!Agree(With(change.first, change.second), kCanon), change.first << " -> " << change.second);
  }
}

TEST_CASE("full circles and turns are counted, and a tool change does not stop our spindle") {
  CHECK(Agree("ARC CCW XY X0 Y0 center (2,0) turns 2 F0\nEND\n",
              "1 N..... ARC_FEED(0.0000, 0.0000, 2.0000, 0.0000, 3, 0.0000, 0.0000, 0.0000, 0.0000)\n2 N..... "
              "PROGRAM_END()\n"));
  // Two and a quarter turns: 2 mm each.
  CHECK(Agree("RAPID X1 Y0 Z0\nARC CCW XY X0 Y1 Z-4.5 center (0,0) turns 2 F0\nEND\n",
              "1 N..... STRAIGHT_TRAVERSE(1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
              "2 N..... ARC_FEED(1.0000, 0.0000, 0.0000, 0.0000, 1, -2.0000, 0.0000, 0.0000, 0.0000)\n"
              "3 N..... ARC_FEED(1.0000, 0.0000, 0.0000, 0.0000, 1, -4.0000, 0.0000, 0.0000, 0.0000)\n"
              "4 N..... ARC_FEED(0.0000, 1.0000, 0.0000, 0.0000, 1, -4.5000, 0.0000, 0.0000, 0.0000)\n"
              "5 N..... PROGRAM_END()\n"));
  CHECK(Agree("SPINDLE CW\nTOOL 5\nLINE X1 F0\nEND\n",
              "1 N..... START_SPINDLE_CLOCKWISE(0)\n2 N..... STOP_SPINDLE_TURNING(0)\n3 N..... CHANGE_TOOL(5)\n"
              "4 N..... STRAIGHT_FEED(1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n5 N..... PROGRAM_END()\n"));
  CHECK_FALSE(
      Agree("SPINDLE CW\nLINE X1 F0\nEND\n",
            "1 N..... START_SPINDLE_CLOCKWISE(0)\n2 N..... STOP_SPINDLE_TURNING(0)\n"
            "4 N..... STRAIGHT_FEED(1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n5 N..... PROGRAM_END()\n"));
}

TEST_CASE("full circles and a rest are one arc of several turns, if the third axis runs evenly") {
  const std::string_view trace = "ARC CCW XY X0 Y10 Z-6 center (0,0) turns 2 F100\n";
  const auto canon = [](std::string_view middle) {
    return "1 N..... SET_FEED_RATE(100.0000)\n2 N..... STRAIGHT_TRAVERSE(10.0000, 0.0000, 0.0000, 0.0000, 0.0000, "
           "0.0000)\n"
           "3 N..... ARC_FEED(10.0000, 0.0000, 0.0000, 0.0000, 1, -2.6667, 0.0000, 0.0000, 0.0000)\n" +
           std::string(middle) +
           "5 N..... ARC_FEED(0.0000, 10.0000, 0.0000, 0.0000, 1, -6.0000, 0.0000, 0.0000, 0.0000)\n";
  };
  const std::string ours = "RAPID X10 Y0 Z0\n" + std::string(trace);
  CHECK(Agree(ours, canon("4 N..... ARC_FEED(10.0000, 0.0000, 0.0000, 0.0000, 1, -5.3333, 0.0000, 0.0000, 0.0000)\n")));
  CHECK_FALSE(
      Agree(ours, canon("4 N..... ARC_FEED(10.0000, 0.0000, 0.0000, 0.0000, 1, -5.0000, 0.0000, 0.0000, 0.0000)\n")));
  CHECK_FALSE(
      Agree(ours, canon("4 N..... ARC_FEED(10.0000, 0.0000, 0.0000, 0.0000, -1, -5.3333, 0.0000, 0.0000, 0.0000)\n")));
  CHECK_FALSE(Agree(ours, canon("")));
}

TEST_CASE("a call that is not known is an error, and so are inches") {
  CHECK_FALSE(ParseCanon("1 N..... RIGID_TAP(0, 1, 2)\n").error.empty());
  CHECK_FALSE(ParseCanon("1 N..... USE_LENGTH_UNITS(CANON_UNITS_INCHES)\n").error.empty());
}

}  // namespace
}  // namespace ncport::tests
