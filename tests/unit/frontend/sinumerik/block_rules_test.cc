// What words of one block do to each other: blocks that are refused and blocks that are not.
#include <doctest/doctest.h>

#include <string>

#include "read_helper.h"

namespace ncport::frontend::sinumerik {

namespace {

std::string Findings(std::string_view text) {
  ReadResult result;
  ReadInto(result, text);
  return result.Findings();
}

}  // namespace

TEST_CASE("frame words stand without motion words") {
  CHECK(Findings("G0 TRANS X10\n") == "NC1022 1:4 TRANS must stand alone in its block\n");
  CHECK(Findings("AROT Z5 G1\n") == "NC1022 1:1 AROT must stand alone in its block\n");
  CHECK(Findings("MIRROR X0 G2\n") == "NC1022 1:1 MIRROR must stand alone in its block\n");
  CHECK(Findings("TRANS X10\n").empty());
  CHECK(Findings("N10 ATRANS X10 Y=R1 ; shift\n").empty());
  CHECK(Findings("TRANS\nG0 X1\n").empty());
}

TEST_CASE("polar words stand beside the third axis only") {
  CHECK(Findings("G0 X5 Y2 AP=30 RP=10\n") == "NC1013 1:7 RP=10 and Y2 exclude each other in one block\n");
  CHECK(Findings("G0 AP=30 X5 Z2\n") == "NC1013 1:13 AP=30 and Z2 exclude each other in one block\n");
  CHECK(Findings("G1 RP=30 Y5 Z2\n") == "NC1013 1:13 RP=30 and Z2 exclude each other in one block\n");
  CHECK(Findings("G0 AP=30 RP=10\n").empty());
  CHECK(Findings("G0 AP=30 RP=10 Z5\n").empty());
  CHECK(Findings("G18\nG0 AP=30 RP=10 Y5\n").empty());
}

TEST_CASE("values of words have a range") {
  CHECK(Findings("G2 I5 AR=400\n") == "NC2005 1:10 400 is outside 0 to 360\n");
  CHECK(Findings("G1 X5 RND=-2\n") == "NC2005 1:11 -2 is outside 0 and above\n");
  CHECK(Findings("G1 X5 CHF=(-2)\n") == "NC2005 1:11 -2 is outside 0 and above\n");
  CHECK(Findings("G1 AP=5 RP=-1\n") == "NC2005 1:12 -1 is outside 0 and above\n");
  CHECK(Findings("G2 I5 AR=360\n").empty());
  CHECK(Findings("G1 X5 RND=0\n").empty());
  CHECK(Findings("G1 X5 RND=R1-2\n").empty());
}

TEST_CASE("a target that names its way lies within one turn") {
  CHECK(Findings("SPOS=ACN(-90)\n") == "NC2005 1:10 -90 is outside 0 to 359.999\n");
  CHECK(Findings("SPOS=DC(450)\n") == "NC2005 1:9 450 is outside 0 to 359.999\n");
  CHECK(Findings("SPOS=ACP(361)\n") == "NC2005 1:10 361 is outside 0 to 359.999\n");
  CHECK(Findings("SPOS=ACN(270)\nSPOS=ACP(0)\nSPOS=DC(359.99)\nSPOS=ACN(R1)\nSPOS=-90\nSPOS=IC(-90)\n").empty());
}

TEST_CASE("one spindle takes one spindle word") {
  CHECK(Findings("S500 M3 M4\n") == "NC1013 1:9 M3 and M4 exclude each other in one block\n");
  CHECK(Findings("M5 S500 M3\n") == "NC1013 1:9 M5 and M3 exclude each other in one block\n");
  CHECK(Findings("S500 M3 M2=4\n").empty());
  CHECK(Findings("S500 M3 M8\nM5 M9\n").empty());
}

TEST_CASE("passes are 1 to 9999") {
  const std::string sub = "M30\n%_N_L77_SPF\nG0 X1\nM17\n";
  CHECK(Findings("%_N_A_MPF\nL77 P0\n" + sub) == "NC2005 2:5 0 is outside 1 to 9999 passes\n");
  CHECK(Findings("%_N_A_MPF\nL77 P10000\n" + sub) == "NC2005 2:5 10000 is outside 1 to 9999 passes\n");
  CHECK(Findings("%_N_A_MPF\nL77 P=0\n" + sub) == "NC2005 2:7 0 is outside 1 to 9999 passes\n");
  CHECK(Findings("%_N_A_MPF\nL77 P1\n" + sub).empty());
  CHECK(Findings("%_N_A_MPF\nL77 P9999\n" + sub).empty());
  CHECK(Findings("%_N_A_MPF\nL77 P=R1\n" + sub).empty());
}

TEST_CASE("no label and no skip mark in front of a structure") {
  CHECK(Findings("AB: IF R1>1\nENDIF\n") == "NC1022 1:5 IF must stand alone in its block\n");
  CHECK(Findings("/ LOOP\nENDLOOP\n") == "NC1022 1:3 LOOP must stand alone in its block\n");
  CHECK(Findings("IF R1>1\nAB: ENDIF\n") == "NC1022 2:5 ENDIF must stand alone in its block\n");
  CHECK(Findings("AB:\nIF R1>1\nENDIF\n").empty());
  CHECK(Findings("N10 IF R1>1\nENDIF\n").empty());
  CHECK(Findings("AB: IF R1>1 GOTOB AB\n").empty());
}

TEST_CASE("system variables that are not listed or lack an index") {
  CHECK(Findings("R1=$P_TOLNO\n") == "NC2001 1:4 $P_TOLNO is not declared\n");
  CHECK(Findings("R1=$AA_IWX[X]\nR2=$AA_IWX[X]\n").find("NC2001 2:") == std::string::npos);
  CHECK(Findings("R1=$P_EP\n") == "NC2011 1:4 $P_EP takes 1 arguments, 0 are given\n");
  CHECK(Findings("R1=$P_TOOLNO[1]\n") == "NC2011 1:4 $P_TOOLNO takes 0 arguments, 1 are given\n");
  CHECK(Findings("R1=$P_EP[X]\n").empty());
  CHECK(Findings("R1=$MC_BUILDERS_OWN\n").empty());
  CHECK(Findings("R1=$AC_MARKER[2]\n").empty());
}

TEST_CASE("an arc has a centre or a radius") {
  CHECK(Findings("G2 X10 I5 CR=5\n") == "NC1013 1:11 I5 and CR=5 exclude each other in one block\n");
  CHECK(Findings("G3 X10 CR=6 J5\n") == "NC1013 1:8 J5 and CR=6 exclude each other in one block\n");
  CHECK(Findings("G2 X10 K1 CR=R1\n") == "NC1013 1:11 K1 and CR=R1 exclude each other in one block\n");
  CHECK(Findings("G2 X10 I5\n").empty());
  CHECK(Findings("G2 X10 CR=5\n").empty());
  CHECK(Findings("G2 X10 I5 AR=90\n").empty());
}

}  // namespace ncport::frontend::sinumerik
