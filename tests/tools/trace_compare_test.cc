// The comparison must find each kind of difference, and must not see one where the contract allows it.
#include "tests/tools/trace_compare.h"

#include <doctest/doctest.h>

namespace ncport::tests {
namespace {

Trace Read(std::string_view text) {
  const ParsedTrace parsed = ParseTrace(text);
  REQUIRE_MESSAGE(parsed.error.empty(), parsed.error);
  return parsed.trace;
}

bool Agree(std::string_view actual, std::string_view expected) {
  return !CompareVector(Read(actual), Read(expected)).has_value();
}

bool FlatAgree(std::string_view source, std::string_view flat) {
  FlatAllowance allowance;
  allowance.maps = {{"TOOL \"ROUGH\"", "TOOL 1"}, {"OFFSET EDGE 1", ""}};
  return !CompareWithFlat(Read(source), Read(flat), allowance).has_value();
}

TEST_CASE("lines are read into fields, and what is no event is an error") {
  const Trace trace = Read(
      "# note\nARC CW ZX Xr1.5 Z-2 center (0,2) turns 3 F0.2/r\nTAP Z-20 pitch 1.25\nRAPID MCS X0\nM8\nSET R1 5\nSET T "
      "\"a b\"\n");
  REQUIRE(trace.events.size() == 4);
  CHECK(trace.events[0].clockwise);
  CHECK(trace.events[0].plane == "ZX");
  CHECK(*trace.events[0].axes[0] == 1.5);
  CHECK(*trace.events[0].axes[2] == -2);
  CHECK_FALSE(trace.events[0].axes[1].has_value());
  CHECK(trace.events[0].center[1] == 2);
  CHECK(trace.events[0].turns == 3);
  CHECK(trace.events[0].feed == "0.2/r");
  CHECK(trace.events[1].pitch == 1.25);
  CHECK(trace.events[2].kind == "RAPID MCS");
  REQUIRE(trace.sets.size() == 2);
  CHECK(trace.sets[1].second == "\"a b\"");
  for (const char* bad : {"FOO 1\n", "LINE X\n", "LINE X1 X2\n", "ARC CW XY X1 Y1 F100\n",
                          "ARC UP XY X1 Y1 center (0,0)\n", "SET R1\n", "LINE X1 Q2\n"}) {
    CHECK_MESSAGE(!ParseTrace(bad).error.empty(), bad);
  }
}

TEST_CASE("a vector agrees only with the same events in the same order") {
  const char* expected = "RAPID X1 Y2\nLINE X5 Y2 F100\nDWELL 2\nEND\nSET R1 5\n";
  CHECK(Agree(expected, expected));
  CHECK(Agree("RAPID X1.00009 Y2\nPATH EXACT\nLINE X5 Y2 F100\nTOOL 3\nDWELL 2\nEND\nSET R1 5.00005\nSET R2 1\n",
              expected));
  CHECK_FALSE(Agree("RAPID X1.0002 Y2\nLINE X5 Y2 F100\nDWELL 2\nEND\nSET R1 5\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 Y2 F101\nDWELL 2\nEND\nSET R1 5\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 Y2 F100/r\nDWELL 2\nEND\nSET R1 5\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 F100\nDWELL 2\nEND\nSET R1 5\n", expected));
  CHECK_FALSE(Agree("LINE X5 Y2 F100\nRAPID X1 Y2\nDWELL 2\nEND\nSET R1 5\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 Y2 F100\nDWELL 2\nEND\nSET R1 6\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 Y2 F100\nDWELL 2\nEND\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 Y2 F100\nDWELL 2\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nLINE X5 Y2 F100\nDWELL 2\nM8\nEND\nSET R1 5\n", expected));
  CHECK_FALSE(Agree("RAPID X1 Y2\nRAPID X5 Y2\nDWELL 2\nEND\nSET R1 5\n", expected));
}

TEST_CASE("a vacant variable, a text and a zero are three things") {
  CHECK(Agree("END\nSET #1 vacant\n", "END\nSET #1 vacant\n"));
  CHECK_FALSE(Agree("END\nSET #1 0\n", "END\nSET #1 vacant\n"));
  CHECK_FALSE(Agree("END\nSET T 1\n", "END\nSET T \"1\"\n"));
  CHECK_FALSE(Agree("END\nSET T \"1.00001\"\n", "END\nSET T \"1\"\n"));
}

TEST_CASE("the sense, plane, centre and turns of an arc count") {
  const char* expected = "RAPID X0 Y0\nARC CW XY X4 Y0 center (2,0) F100\nEND\n";
  CHECK(Agree(expected, expected));
  CHECK_FALSE(Agree("RAPID X0 Y0\nARC CCW XY X4 Y0 center (2,0) F100\nEND\n", expected));
  CHECK_FALSE(Agree("RAPID X0 Y0\nARC CW ZX X4 Y0 center (2,0) F100\nEND\n", expected));
  CHECK_FALSE(Agree("RAPID X0 Y0\nARC CW XY X4 Y0 center (2,0.001) F100\nEND\n", expected));
  CHECK_FALSE(Agree("RAPID X0 Y0\nARC CW XY X4 Y0 center (2,0) turns 1 F100\nEND\n", expected));
}

TEST_CASE("Xr and X are one axis, an alarm is its first word, a message its text") {
  CHECK(Agree("RAPID Xr5\nALARM 14051 other words\n", "RAPID X5\nALARM 14051 division by zero\n"));
  CHECK_FALSE(Agree("RAPID X5\nALARM 14052\n", "RAPID X5\nALARM 14051\n"));
  CHECK_FALSE(Agree("MSG v:2\nEND\n", "MSG v:2.00001\nEND\n"));
}

TEST_CASE("a move to where the tool stands is dropped, but not behind a change of tool or offset") {
  CHECK(Agree("RAPID X1 Y1\nRAPID X1 Y1\nEND\n", "RAPID X1 Y1\nEND\n"));
  CHECK(Agree("RAPID X1 Y1\nEND\n", "RAPID X1 Y1\nLINE X1 Y1 F100\nEND\n"));
  CHECK_FALSE(Agree("RAPID X1\nRAPID X1 Y0\nEND\n", "RAPID X1\nEND\n"));
  CHECK_FALSE(Agree("RAPID X1\nTOOL 2\nRAPID X1\nEND\n", "RAPID X1\nEND\n"));
  CHECK_FALSE(Agree("RAPID X1\nWCS 55\nRAPID X1\nEND\n", "RAPID X1\nEND\n"));
  CHECK_FALSE(Agree("RAPID X1 Y0\nARC CW XY X1 Y0 center (0,0) F1\nEND\n", "RAPID X1 Y0\nEND\n"));
  CHECK_FALSE(Agree("RAPID X1\nREFPOINT X\nRAPID X1\nEND\n", "RAPID X1\nREFPOINT X\nEND\n"));
}

TEST_CASE("a flat program may differ by the rounding of its words and by lost messages, and by nothing that grows") {
  const char* source =
      "TOOL \"ROUGH\"\nOFFSET EDGE 1\nSPINDLE RPM 800\nSPINDLE CW\nPATH CONTINUOUS\nMSG hello\nRAPID X1.00033 Y2\nLINE "
      "X5 Y2 F100\nEND\n";
  CHECK(FlatAgree(source, "TOOL 1\nSPINDLE CW\nSPINDLE RPM 800\nRAPID X1 Y2\nLINE X5 Y2 F100\nEND\n"));
  CHECK_FALSE(FlatAgree(source, "TOOL 2\nSPINDLE CW\nSPINDLE RPM 800\nRAPID X1 Y2\nLINE X5 Y2 F100\nEND\n"));
  CHECK_FALSE(FlatAgree(source, "TOOL 1\nSPINDLE CW\nSPINDLE RPM 800\nRAPID X1.001 Y2\nLINE X5 Y2 F100\nEND\n"));
  CHECK_FALSE(FlatAgree(source, "TOOL 1\nSPINDLE CCW\nSPINDLE RPM 800\nRAPID X1 Y2\nLINE X5 Y2 F100\nEND\n"));
  CHECK_FALSE(FlatAgree(source, "TOOL 1\nSPINDLE CW\nSPINDLE CSS 800\nRAPID X1 Y2\nLINE X5 Y2 F100\nEND\n"));
  CHECK_FALSE(FlatAgree(source, "TOOL 1\nSPINDLE CW\nSPINDLE RPM 800\nRAPID X1 Y2\nLINE X5 Y2 F100/r\nEND\n"));
  CHECK_FALSE(FlatAgree(source, "TOOL 1\nSPINDLE CW\nSPINDLE RPM 800\nRAPID X1 Y2\nLINE X5 Y2 F100\n"));
}

}  // namespace
}  // namespace ncport::tests
