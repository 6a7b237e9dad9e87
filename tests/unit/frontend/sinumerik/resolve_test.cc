// Scopes, calls, types (card 3.3 to 3.7, 7).
#include "frontend/sinumerik/resolve.h"

#include <doctest/doctest.h>

#include "read_helper.h"

namespace ncport::frontend::sinumerik {

using ir::ExprOp;
using ir::Type;

TEST_CASE("names are found whatever their case") {
  ReadResult result;
  ReadInto(result, "DEF REAL Deep=1\nR1=DEEP+deep\n");
  CHECK(result.Findings().empty());
  const ir::Expr& sum = result.ExprOf(result.WordAt(2).value);
  CHECK(result.ExprOf(ir::ExprId{std::size_t{sum.a}}).op == ExprOp::kVariable);
  CHECK(sum.type == Type::kReal);
}

TEST_CASE("an unknown name is one finding with a near name") {
  ReadResult result;
  ReadInto(result, "DEF REAL DEPTH_1\nR1=DEPHT_1+DEPHT_1\nX=R1\n");
  CHECK(result.Findings() == "NC2001 2:4 DEPHT_1 is not declared\n");
  CHECK(result.sink.All().front().help == "did you mean DEPTH_1?");
  CHECK(result.module.View(StringId{std::size_t{result.WordAt(2).extra}}) == "R1=DEPHT_1+DEPHT_1");
  CHECK(result.WordAt(3).op == ir::WordOp::kAxis);
}

TEST_CASE("variables of the main program are not visible in subprograms") {
  ReadResult result;
  ReadInto(result, "%_N_A_MPF\nDEF REAL MAIN_V\nSUB_B\nM30\n%_N_SUB_B_SPF\nR1=MAIN_V\nM17\n");
  CHECK(result.Findings() == "NC2001 6:4 MAIN_V is not declared\n");
  CHECK(result.sink.All().front().notes.size() == 1);
}

TEST_CASE("a REAL into an INT is converted, a text is not") {
  ReadResult result;
  ReadInto(result, "DEF INT II_I=7/2\nDEF STRING[5] SS_S\nII_I=R1/15\nSS_S=R1\nR1=\"x\"\nII_I=3\nT=R1\n");
  CHECK(result.Findings() ==
        "NC2004 4:6 a number where a text is needed\n"
        "NC2004 5:4 a text where a number is needed\n");
  const ir::Expr& convert = result.ExprOf(result.WordAt(3).value);
  CHECK(convert.op == ExprOp::kConvert);
  CHECK(convert.type == Type::kInt);
  CHECK((convert.flags & ir::Expr::kImplicit) != 0);
  CHECK(result.ExprOf(result.WordAt(6).value).op == ExprOp::kLiteral);
  CHECK(result.ExprOf(result.WordAt(7).value).op == ExprOp::kConvert);
}

TEST_CASE("operands that do not fit their operator") {
  ReadResult result;
  ReadInto(result, "R1=\"a\"+1\nR1=R2 B_AND 3\nIF R1==\"a\" GOTOF E_1\nE_1: R1=(X+1)\nX=\"a\"\n");
  CHECK(result.Findings() ==
        "NC2004 1:4 a text where a number is needed\n"
        "NC2004 2:4 a REAL value where an INT or CHAR value is needed\n"
        "NC2004 3:8 a text where a number is needed\n"
        "NC2004 4:10 an axis where a number is needed\n"
        "NC2004 5:3 a text where a number is needed\n");
}

TEST_CASE("characters of a text, elements of an array") {
  ReadResult result;
  ReadInto(result,
           "DEF STRING[9] SS_S[2]\nDEF REAL "
           "AA_A[3]\nSS_S[1,0]=\"N\"\nSS_S[1]=\"text\"\nR1=AA_A[2]\nR1=AA_A\nR1=AA_A[1,2]\n");
  CHECK(result.Findings() ==
        "NC2004 6:4 a whole array where one of its elements is needed\n"
        "NC2004 7:4 this number of indices where one for each dimension is needed\n");
  CHECK(result.ExprOf(ir::ExprId{std::size_t{result.WordAt(3).extra}}).type == Type::kChar);
  CHECK(result.ExprOf(ir::ExprId{std::size_t{result.WordAt(4).extra}}).type == Type::kString);
}

TEST_CASE("arguments: count, references, conversion") {
  ReadResult result;
  ReadInto(result,
           "%_N_M_MPF\nDEF REAL AA_A[3], BB_B\nDEF INT CC_C\n"
           "UP_1(R1,BB_B,AA_A)\nUP_1(1.5,CC_C,AA_A)\nUP_1(1,2,AA_A)\nUP_1(1,BB_B,BB_B)\nUP_1(1,,AA_A)\nUP_1(1,BB_B,AA_"
           "A,4)\nUP_1(,AA_A[1],AA_A)\nM30\n"
           "%_N_UP_1_SPF\nPROC UP_1(INT PA, VAR REAL PB, VAR REAL PC[3])\nM17\n");
  CHECK(result.Findings() ==
        "NC2004 5:10 INT where a variable of type REAL is needed\n"
        "NC2004 6:8 a value where a variable of type REAL is needed\n"
        "NC2004 7:13 one value where an array with as many dimensions is needed\n"
        "NC2012 8:1 UP_1 needs a variable for PB\n"
        "NC2011 9:1 UP_1 takes 3 arguments, 4 are given\n");
  const ir::Call& call = result.module.calls[result.WordAt(4).Extra<ir::CallId>()];
  CHECK(result.ExprOf(result.module.args[call.args[0]].value).op == ExprOp::kConvert);
}

TEST_CASE("programs are found by prefix, suffix and path; leading zeros of L names count") {
  ReadResult result;
  ReadInto(
      result,
      "%_N_M_MPF\n_N_SUB_1_SPF\nsub_1\nPCALL /_N_SPF_DIR/_N_SUB_1_SPF\nCALL \"/_N_CUS_DIR/_N_SUB_1_SPF\"\nL01\nM30\n"
      "%_N_SUB_1_SPF\nM17\n%_N_L1_SPF\nM17\n");
  CHECK(result.Findings() == "NC4002 6:1 program L01 was not found\n");
  for (const std::uint32_t line : {2U, 3U, 4U, 5U}) {
    CHECK(result.module.calls[result.WordAt(line).Extra<ir::CallId>()].program == ir::ProgramId{1U});
  }
  CHECK(ProgramIndex(result.module).Find("/x/_N_SUB_1_SPF").value == 1);
}

TEST_CASE("standard cycles come from the library, with the arguments they cover") {
  ReadResult result;
  ReadInto(
      result,
      "MCALL "
      "CYCLE81(10,0,2,-15)\nX1\nMCALL\nCYCLE83(10,0,5,,20,,4,100,0,0.5,100,1,0,1.2,1.4,0,1.6,0,1,11211111)\nM30\n");
  CHECK(result.sink.All().size() == 1);
  CHECK(diag::InfoOf(result.sink.All().front().code).number == "NC2013");
  const ir::ProgramId cycle = result.module.calls[result.WordAt(1).Extra<ir::CallId>()].program;
  REQUIRE(cycle.Valid());
  CHECK(result.module.programs[cycle].library);
  CHECK(result.module.View(result.module.file_names[result.module.programs[cycle].file.value]) == "<cycle81>");
}

TEST_CASE("arguments of cycles that are not run: number, types and values of the card") {
  const auto findings = [](std::string_view call) {
    ReadResult result;
    ReadInto(result, std::string(call) + "\n");
    std::string found = result.Findings();
    // That the cycle is not translated.
    for (std::size_t at = found.find("NC1019"); at != std::string::npos; at = found.find("NC1019"))
      found.erase(at, found.find('\n', at) + 1 - at);
    return found;
  };
  CHECK(findings("CYCLE97(1.5,,0,-28,24,24,4,3,0.92,0.05,30,0,0,5,1,3,1,1)") ==
        "NC2011 1:1 CYCLE97 takes 17 arguments, 18 are given\n");
  CHECK(findings("CYCLE97(1.5,,0,-28,24,24,4,3,0.92,0.05,30,0,5,1,3,1,1)").empty());
  // Newer versions append to this one.
  CHECK(findings("POCKET3(10,0,2,-5,40,20,5,0,0,0,2,0,0,300,100,0,1,10,0,0,0,0,0,0,1,2,0,0,1)").empty());
  CHECK(findings("CYCLE93(40,-20,6,4,0,0,0,1,1,0,0,0.1,0.1,2,0.5,9)") ==
        "NC2005 1:48 9 is outside 1 to 8 or 11 to 18\n");
  CHECK(findings("CYCLE93(40,-20,6,4,0,0,0,1,1,0,0,0.1,0.1,2,0.5,15)").empty());
  CHECK(findings("CYCLE93(40,-20,6,4,0,0,0,1,1,0,0,0.1,0.1,2,0.5,R1)").empty());
  CHECK(findings("CYCLE95(7,2,0,0,,0.3,0.2,0.1,9)") == "NC2004 1:9 a number where a text is needed\n");
  CHECK(findings("CYCLE95(\"A:E\",\"2\",0,0,,0.3,0.2,0.1,9)") == "NC2004 1:15 a text where a number is needed\n");
  CHECK(findings("CYCLE95(\"A:E\",2,0,0,,0.3,0.2,0.1,9)").empty());
  CHECK(findings("CYCLE84(10,0,2,-15,,0,5,1.25,,0,300,400)") == "NC2005 1:25 1.25 is outside 3 to 48\n");
  CHECK(findings("CYCLE84(10,0,2,-15,,0,5,-8,,0,300,400)").empty());
  CHECK(findings("CYCLE84(10,0,2,-15,,0,5,,1.25,0,300,400)").empty());
  CHECK(findings("CYCLE84(10,0,2,-15,,0,7,,1.25,0,300,400)") == "NC2005 1:23 7 is outside 3 to 5\n");
  // A program of the user of that name is another thing.
  CHECK(findings("CYCLE93(9)\nM30\n%_N_CYCLE93_SPF\nPROC CYCLE93(REAL AA)\nM17").empty());
}

TEST_CASE("axis names that the machine lists, axes as arguments") {
  ReadResult result;
  ReadInto(result,
           "DEF AXIS AX_1\nAX_1=Z\nAX[AX_1]=5 AX[X]=R1\nR1=$AA_IM[AX_1]+$P_EP[X]\nIF AX_1==X GOTOF E_1\nE_1: M30\n");
  CHECK(result.Findings().empty());
  CHECK(result.WordAt(3).op == ir::WordOp::kAxisComputed);
}

TEST_CASE("system variables: known, by pattern, read only, unknown") {
  ReadResult result;
  ReadInto(result, "R1=$P_F+$MN_ANYTHING[2]\n$P_F=3\n$AC_MARKER[1]=2\nR1=$XY_NOTHING\n");
  CHECK(result.Findings() == "NC2001 4:4 $XY_NOTHING is not declared\nNC2009 2:1 $P_F cannot be written\n");
}

TEST_CASE("a name declared twice") {
  ReadResult result;
  ReadInto(result, "DEF INT AA_A, BB_B\nDEF REAL aa_a\nR1=AA_A\n");
  CHECK(result.Findings() == "NC2002 2:10 aa_a is declared twice\n");
}

TEST_CASE("functions of texts want a text, the others a number") {
  ReadResult result;
  ReadInto(result, "R1=STRLEN(55)\nR1=SIN(\"30\")\nR1=NUMBER(R2)\nR1=STRLEN(\"AB\")+INDEX(\"AB\",\"B\")\nR1=ABS(-1)\n");
  CHECK(result.Findings() ==
        "NC2004 1:11 a whole number where a text is needed\n"
        "NC2004 2:8 a text where a number is needed\n"
        "NC2004 3:11 a number where a text is needed\n");
}

TEST_CASE("more start values than elements are doubtful") {
  ReadResult result;
  ReadInto(result,
           "DEF REAL A_1[2]=(1,2,3)\nDEF INT B_1[2,2]=SET(1,2,3,4,5)\nDEF INT C_1[2]=(1,2)\nDEF INT D_1[3]=(1,2)\n"
           "DEF INT E_1[2]=REP(4)\n");
  CHECK(result.Findings() ==
        "NC2010 1:22 index 2 of A_1 is outside 0 to 1\n"
        "NC2010 2:30 index 4 of B_1 is outside 0 to 3\n");
  CHECK_FALSE(result.sink.HasErrors());
}

TEST_CASE("what a refused definition would have declared has no further finding") {
  ReadResult result;
  ReadInto(result, "DEFINE ON_1 M3 M8\nON_1\nSUB_B(1,2)\nM30\n%_N_SUB_B_SPF\nPROC SUB_B(REAL AA, BB)\nR1=AA+BB\nM17\n");
  CHECK(result.Findings() ==
        "NC1003 1:13 expected AS, found M3\n"
        "NC1003 6:21 expected a type, found BB\n");
}

TEST_CASE("a misspelled end of a structure is its end") {
  ReadResult result;
  ReadInto(result,
           "LOOP\nIF R1>5 GOTOF AB\nENDLOP\nAB: G0 X1\nWHILE R1<5\nR1=R1+1\nWEND\nREPEAT\nR1=R1-1\nENDREPEAT\n");
  CHECK(result.Findings() ==
        "NC1014 10:1 unknown word ENDREPEAT\n"
        "NC1014 7:1 unknown word WEND\n"
        "NC1014 3:1 unknown word ENDLOP\n");
}

TEST_CASE("a program of the name of a misspelled end is called where the structure has its end") {
  ReadResult result;
  ReadInto(result, "LOOP\nENDLOP\nENDLOOP\nM30\n%_N_ENDLOP_SPF\nM17\n");
  CHECK(result.Findings().empty());
}

}  // namespace ncport::frontend::sinumerik
