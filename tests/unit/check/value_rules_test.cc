// Rules that rest on values: programs that they must flag and programs that they must not. "CODE line severity" each.
#include "check/value_rules.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "check/structure_rules.h"
#include "check/subject.h"
#include "dialects/registry.h"
#include "frontend/reader.h"

namespace ncport::check {
namespace {

struct File {
  std::string_view name, text;
};

struct Result {
  std::string found;
  std::string notes;
  std::uint64_t steps = 0;
};

Result Check(std::string_view profile_name, const std::vector<File>& texts,
             std::vector<ir::analysis::DeclaredRange> (*declare)(const ir::Module&) = nullptr) {
  const dialects::Profile profile = dialects::BuiltIn(profile_name);
  SourceFiles files;
  ir::Module module;
  diag::Sink sink;
  for (const File& text : texts) {
    const FileId file = files.Add(std::string(text.name), std::string(text.text));
    (void)frontend::ReadFile(files, file, profile, {}, module, sink);
  }
  frontend::ResolveNames(files, module, profile, sink);
  for (const diag::Diagnostic& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
  const Subject subject(module, profile, {});
  ValueRuleOptions options;
  options.files = &files;
  options.control = "CONTROL alarm";
  if (declare != nullptr) options.declared = declare(module);
  Result result;
  result.steps =
      CheckValues(module, subject.machine, subject.graphs, subject.calls, subject.modal, options, sink).steps;
  for (const ir::ProgramId program : module.programs.Ids()) {
    CheckUnreachable(module, program, subject.graphs, sink);
    CheckComparisons(module, program, sink);
    CheckExactLoopEnds(module, program, subject.graphs, sink);
  }
  sink.SortByPlace();
  for (const diag::Diagnostic& finding : sink.All()) {
    if (!result.found.empty()) result.found += ", ";
    result.found += std::string(diag::InfoOf(finding.code).number) + " " + std::to_string(finding.at.line) +
                    (finding.severity == diag::Severity::kError ? " error" : "");
    for (const diag::Note& note : finding.notes) result.notes += note.text + "\n";
  }
  return result;
}

std::string Mill(std::string_view text) { return Check("sinumerik-840d-mill", {{"main.mpf", text}}).found; }
std::string Sub(std::string_view text) { return Check("sinumerik-840d-mill", {{"sub.spf", text}}).found; }
std::string Lathe(std::string_view text) { return Check("sinumerik-840d-lathe", {{"main.mpf", text}}).found; }
std::string Macro(std::string_view text) { return Check("fanuc-mill", {{"o1.nc", text}}).found; }
std::string Set(std::string_view main, std::string_view sub) {
  return Check("sinumerik-840d-mill", {{"main.mpf", main}, {"sub.spf", sub}}).found;
}

constexpr std::string_view kLayers = "PROC SUB(REAL DEPTH, REAL RALL)\nDEF INT LAYERS\nLAYERS=DEPTH DIV RALL\nM17\n";
constexpr std::string_view kTested =
    "PROC SUB(REAL DEPTH, REAL RALL)\nDEF INT LAYERS\nIF RALL<=0\nSETAL(65000)\nENDIF\nLAYERS=DEPTH DIV RALL\nM17\n";

}  // namespace

TEST_CASE("value rules: division by zero, certain") {
  CHECK(Mill("R1=0\nR2=5/R1\nM30\n") == "NC3001 2 error");
  CHECK(Mill("DEF INT CNT\nR2=5 DIV CNT\nM30\n") == "NC3001 2 error");
  CHECK(Mill("R2=5 MOD (3-3)\nM30\n") == "NC3001 1 error");
  CHECK(Macro("O1\n#1=0\n#2=5/#1\nM30\n") == "NC3001 3 error");
  CHECK(Macro("O1\n#2=5/#1\nM30\n") == "NC3001 2 error");  // empty counts as 0
  CHECK(Mill("R1=1\nR2=5/R1\nM30\n").empty());
  CHECK(Mill("R2=5/R1\nM30\n").empty());  // an input of the operator
  CHECK(Mill("R1=0\nIF R1<>0\nR2=5/R1\nENDIF\nM30\n").empty());
}

TEST_CASE("value rules: a divisor is reported once, further ones for the same 0 are not") {
  CHECK(Mill("R1=0\nR2=5/R1\nR3=6/R1\nM30\n") == "NC3001 2 error");
}

TEST_CASE("value rules: division by a parameter") {
  CHECK(Sub(kLayers) == "NC3001 3");
  CHECK(Sub(kTested).empty());
  CHECK(Set("SUB(10, 2.5)\nM30\n", kLayers).empty());
  CHECK(Set("SUB(10, 2.5)\nSUB(10, -2.5)\nM30\n", kLayers).empty());
  CHECK(Set("SUB(10, 0)\nM30\n", kTested).empty());
  CHECK(Set("SUB(10, 2.5)\nSUB(10, 0)\nM30\n", kLayers) == "NC3001 3 error");
  CHECK(Set("SUB(10)\nM30\n", kLayers) == "NC3001 3 error");
  CHECK(Set("SUB(10, R1)\nM30\n", kLayers).empty());
}

TEST_CASE("value rules: the finding names the call") {
  const Result zero = Check("sinumerik-840d-mill", {{"main.mpf", "R1=1\nSUB(10, 0)\nM30\n"}, {"sub.spf", kLayers}});
  CHECK(zero.notes == "RALL is parameter 2 of SUB; the call in main.mpf:2 passes 0\n");
  const Result missing = Check("sinumerik-840d-mill", {{"main.mpf", "SUB(10)\nM30\n"}, {"sub.spf", kLayers}});
  CHECK(missing.notes == "RALL is parameter 2 of SUB; the call in main.mpf:1 leaves it out, so it is 0\n");
  const Result alone = Check("sinumerik-840d-mill", {{"sub.spf", kLayers}});
  CHECK(alone.notes == "RALL is parameter 2 of SUB; its callers are not known here\n");
}

TEST_CASE("value rules: tests in all forms narrow") {
  CHECK(Sub("PROC SUB(REAL PA)\nIF (PA>0) AND (PA<5)\nR1=1/PA\nENDIF\nM17\n").empty());
  CHECK(Sub("PROC SUB(REAL PA)\nIF (PA<=0) OR (PA>5) GOTOF LEAVE\nR1=1/PA\nLEAVE: M17\n").empty());
  CHECK(Sub("PROC SUB(REAL PA)\nIF NOT (PA==0)\nR1=1/PA\nENDIF\nM17\n").empty());
  CHECK(Sub("PROC SUB(REAL PA)\nIF ABS(PA)<0.001 GOTOF LEAVE\nR1=1/PA\nLEAVE: M17\n").empty());
  CHECK(Sub("PROC SUB(REAL PA)\nWHILE PA>0\nR1=1/PA\nPA=PA-1\nENDWHILE\nM17\n").empty());
  CHECK(Sub("PROC SUB(REAL PA)\nIF PA\nR1=1/PA\nENDIF\nM17\n").empty());
  CHECK(Sub("PROC SUB(REAL PA)\nIF PA>=0\nR1=1/PA\nENDIF\nM17\n") == "NC3001 3");
  CHECK(Sub("PROC SUB(REAL PA)\nIF (PA>0) OR (PA<5)\nR1=1/PA\nENDIF\nM17\n") == "NC3001 3");
  CHECK(Sub("PROC SUB(REAL PA)\nIF PA<0\nPA=0\nENDIF\nR1=1/(PA+1)\nM17\n").empty());
}

TEST_CASE("value rules: values through loops") {
  CHECK(Mill("DEF INT CNT\nFOR CNT=0 TO 5\nR1=1/CNT\nENDFOR\nM30\n") == "NC3001 3");
  CHECK(Mill("DEF INT CNT\nFOR CNT=1 TO 5\nR1=1/CNT\nENDFOR\nM30\n").empty());
  CHECK(Mill("DEF INT CNT=5\nWHILE CNT>0\nR1=1/CNT\nCNT=CNT-1\nENDWHILE\nM30\n").empty());
  CHECK(Mill("DEF INT CNT=5\nWHILE CNT>0\nCNT=CNT-1\nR1=1/CNT\nENDWHILE\nM30\n") == "NC3001 4");
  CHECK(Mill("R1=3\nAGAIN: R1=R1-1\nR2=1/(R1+5)\nIF R1>0 GOTOB AGAIN\nM30\n").empty());
  CHECK(Macro("O1\n#1=3\nWHILE [#1 GT 0] DO1\n#2=1/#1\n#1=#1-1\nEND1\nM30\n").empty());
}

TEST_CASE("value rules: a promise of what arguments may be") {
  const auto declare = [](const ir::Module& module) {
    return std::vector<ir::analysis::DeclaredRange>{
        {module.programs[ir::ProgramId{std::size_t{0}}].parameters[0], 1, 5}};
  };
  const std::vector<File> text = {{"sub.spf", "PROC SUB(REAL PA)\nR1=1/(PA+1)\nR2=SQRT(PA-9)\nM17\n"}};
  CHECK(Check("sinumerik-840d-mill", text, declare).found == "NC3002 3 error");
  CHECK(Check("sinumerik-840d-mill", text).found.empty());
}

TEST_CASE("value rules: domains of functions") {
  CHECK(Mill("R1=SQRT(-4)\nM30\n") == "NC3002 1 error");
  CHECK(Mill("R1=0\nR2=LN(R1)\nM30\n") == "NC3002 2 error");
  CHECK(Mill("R1=ACOS(1.5)\nM30\n") == "NC3002 1 error");
  CHECK(Mill("R1=TAN(90)\nM30\n") == "NC3002 1 error");
  CHECK(Mill("DEF INT CNT\nFOR CNT=-1 TO 5\nR1=SQRT(CNT)\nENDFOR\nM30\n") == "NC3002 3");
  CHECK(Mill("R1=SQRT(R2)\nM30\n").empty());
  CHECK(Mill("DEF INT CNT\nFOR CNT=0 TO 5\nR1=SQRT(CNT)\nENDFOR\nM30\n").empty());
  CHECK(Mill("R1=TAN(45)+ASIN(1)+LN(2)\nM30\n").empty());
}

TEST_CASE("value rules: results that are too large") {
  CHECK(Mill("DEF INT CNT=2147483647\nCNT=CNT+1\nM30\n") == "NC3003 2 error");
  CHECK(Mill("R1=EXP(1000)\nM30\n") == "NC3003 1 error");
  CHECK(Mill("DEF INT CNT\nFOR CNT=1 TO 50000\nR1=CNT*CNT\nENDFOR\nM30\n") == "NC3003 3");
  CHECK(Mill("DEF INT CNT\nFOR CNT=1 TO 500\nR1=CNT*CNT\nENDFOR\nM30\n").empty());
  CHECK(Mill("R1=1EX10*1EX10\nM30\n").empty());
  CHECK(Mill("DEF INT CNT\nAGAIN: CNT=CNT+1\nIF R1>CNT GOTOB AGAIN\nM30\n").empty());
}

TEST_CASE("value rules: values that do not fit their type") {
  CHECK(Mill("DEF INT CNT\nCNT=3EX9\nM30\n") == "NC2005 2 error");
  CHECK(Mill("DEF CHAR CH\nCH=300\nM30\n") == "NC2005 2 error");
  CHECK(Mill("DEF INT CNT\nCNT=7/2\nM30\n") == "NC3008 2");
  CHECK(Mill("DEF INT CNT\nCNT=7 DIV 2\nM30\n").empty());
  CHECK(Mill("DEF INT CNT\nCNT=R1/2\nM30\n").empty());
  CHECK(Mill("DEF CHAR CH\nCH=65\nM30\n").empty());
}

TEST_CASE("value rules: indices of arrays") {
  CHECK(Mill("DEF REAL FIELD[4]\nFIELD[4]=1\nM30\n") == "NC2010 2 error");
  CHECK(Mill("DEF REAL FIELD[4]\nDEF INT CNT\nFOR CNT=0 TO 4\nFIELD[CNT]=1\nENDFOR\nM30\n") == "NC2010 4");
  CHECK(Mill("DEF REAL FIELD[4]\nR1=-1\nR2=FIELD[R1]\nM30\n") == "NC2010 3 error");
  CHECK(Mill("DEF REAL FIELD[4]\nDEF INT CNT\nFOR CNT=0 TO 3\nFIELD[CNT]=1\nENDFOR\nM30\n").empty());
  CHECK(Mill("DEF REAL FIELD[4]\nFIELD[R1]=1\nM30\n").empty());
  CHECK(Mill("DEF REAL FIELD[2,3]=(1,2,3,4,5,6)\nFIELD[1,2]=1\nM30\n").empty());
}

TEST_CASE("value rules: loops that never run or never end") {
  CHECK(Mill("DEF INT CNT\nFOR CNT=5 TO 3\nG4 F1\nENDFOR\nM30\n") == "NC4009 2");
  CHECK(Mill("R1=0\nWHILE R1>5\nG4 F1\nENDWHILE\nM30\n") == "NC4009 2");
  CHECK(Mill("WHILE R1>0\nG4 F1\nENDWHILE\nM30\n") == "NC4007 1");
  CHECK(Mill("LOOP\nG4 F1\nENDLOOP\nM30\n") == "NC4007 1");
  CHECK(Mill("REPEAT\nG4 F1\nUNTIL R1==0\nM30\n") == "NC4007 3");
  CHECK(Mill("WHILE R1>0\nR1=R1-1\nENDWHILE\nM30\n").empty());
  CHECK(Mill("LOOP\nR1=R1+1\nIF R1>5 GOTOF DONE\nENDLOOP\nDONE: M30\n").empty());
  CHECK(Mill("WHILE $A_IN[1]==0\nG4 F1\nENDWHILE\nM30\n").empty());
  CHECK(Mill("DEF INT CNT\nFOR CNT=3 TO R1\nG4 F1\nENDFOR\nM30\n").empty());
}

TEST_CASE("value rules: loops that end at one value only") {
  CHECK(Mill("R1=0\nREPEAT\nR1=R1+0.1\nUNTIL R1==5\nM30\n") == "NC3009 4");
  CHECK(Mill("R1=0\nWHILE R1<>5\nR1=R1+0.1\nENDWHILE\nM30\n") == "NC3009 2");
  CHECK(Mill("FOR R1=0.5 TO 5\nG4 F1\nENDFOR\nM30\n") == "NC3008 1");
  CHECK(Mill("R1=0\nREPEAT\nR1=R1+0.1\nUNTIL R1>=5\nM30\n").empty());
  CHECK(Mill("R1=0\nREPEAT\nR1=R1+1\nUNTIL R1==5\nM30\n").empty());
  CHECK(Mill("FOR R1=1 TO 5\nG4 F1\nENDFOR\nM30\n").empty());
}

TEST_CASE("value rules: a counter that steps over the value that ends its loop") {
  CHECK(Mill("R4=10\nREPEAT\nR4=R4-3\nUNTIL R4==0\nM30\n") == "NC4007 4");
  CHECK(Mill("R3=3\nR4=10\nG0 X1\nWHILE R4<>0\nR4=R4-R3\nENDWHILE\nM30\n") == "NC4007 4");
  CHECK(Mill("DEF INT CNT=1\nWHILE 8<>CNT\nCNT=CNT+2\nENDWHILE\nM30\n") == "NC4007 2");
  CHECK(Mill("R1=2\nWHILE R1<>1\nR1=1+R1\nENDWHILE\nM30\n") == "NC4007 2");
  CHECK(Macro("O1\n#1=10\nWHILE [#1 NE 0] DO1\n#1=#1-3\nEND1\nM30\n") == "NC4007 3");
  // It meets the value, or may.
  CHECK(Mill("R4=9\nREPEAT\nR4=R4-3\nUNTIL R4==0\nM30\n").empty());
  CHECK(Mill("R4=10\nREPEAT\nR4=R4-3\nUNTIL R4<=0\nM30\n").empty());
  CHECK(Mill("R4=10\nWHILE R4<>0\nR4=R4-2.5\nENDWHILE\nM30\n").empty());
  CHECK(Mill("R3=3\nR4=10\nREPEAT\nR4=R4-R3\nR3=1\nUNTIL R4==0\nM30\n").empty());
  CHECK(Mill("R4=10\nREPEAT\nR4=R4-3\nIF R4<0\nR4=0\nENDIF\nUNTIL R4==0\nM30\n").empty());
  CHECK(Mill("R4=10\nREPEAT\nR4=R4-3\nIF R4<0 GOTOF AB\nUNTIL R4==0\nAB: M30\n").empty());
  CHECK(Mill("R4=10\nIF R1>0\nR4=9\nENDIF\nREPEAT\nR4=R4-3\nUNTIL R4==0\nM30\n").empty());
  CHECK(Mill("R4=10\nAB:\nREPEAT\nR4=R4-3\nUNTIL R4==0\nIF R5>0\nR4=9\nGOTOB AB\nENDIF\nM30\n").empty());
  // An INT rounds 0.4 away and stays 0; 0.6 makes 1.
  CHECK(Mill("DEF INT CNT=0\nWHILE CNT<>2\nCNT=CNT+0.4\nENDWHILE\nM30\n").find("NC4007") != std::string::npos);
  CHECK(Mill("DEF INT CNT=0\nWHILE CNT<>2\nCNT=CNT+0.6\nENDWHILE\nM30\n").find("NC4007") == std::string::npos);
  CHECK(Check("sinumerik-840d-mill", {{"a.mpf", "R4=10\nREPEAT\nR4=R4-3\nUNTIL R4==0\nM30\n"}})
            .notes.find("it counts 10, 7, 4 and so on, never exactly 0") != std::string::npos);
}

TEST_CASE("value rules: comparisons beside logic without brackets") {
  CHECK(Mill("IF R1==1 AND R2==1 GOTOF AB\nAB: M30\n") == "NC4010 1");
  CHECK(Mill("IF NOT R1==5 GOTOF AB\nAB: M30\n") == "NC4010 1");
  // R1 < (5 OR R2) < 5 compares 0 or 1 with 5: it always holds.
  CHECK(Mill("WHILE R1<5 OR R2<5\nR1=R1+1\nR2=R2+1\nENDWHILE\nM30\n") == "NC4007 1, NC4010 1");
  CHECK(Mill("IF (R1==1) AND (R2==1) GOTOF AB\nAB: M30\n").empty());
  CHECK(Mill("IF NOT (R1==5) GOTOF AB\nAB: M30\n").empty());
  CHECK(Macro("O1\nIF [[#1 EQ 1] AND [#2 EQ 1]] GOTO 10\nN10 M30\n").empty());
}

TEST_CASE("value rules: blocks that no way leads to") {
  CHECK(Mill("GOTOF AB\nR1=5\nAB: M30\n") == "NC4003 2");
  CHECK(Mill("R1=1\nM30\nR2=5\n") == "NC4003 3");
  CHECK(Macro("O1\nGOTO 10\n#1=5\nN10 M30\n") == "NC4003 3");
  CHECK(Mill("GOTOF AB\nAB: M30\n").empty());
  CHECK(Mill("AB: R1=R1+1\nGOTOB AB\nM30\n").empty());  // an end word behind an endless program
  CHECK(Mill("GOTOF \"A\"<<R1\nR1=5\nA1: M30\n") == "NC4003 2");
}

TEST_CASE("value rules: calls that take values with them and bring them back") {
  CHECK(Set("R1=0\nSUB(1, 2)\nR2=1/R1\nM30\n", "PROC SUB(REAL PA, REAL PB)\nR1=PA\nM17\n").empty());
  CHECK(Set("R1=1\nSUB(1, 2)\nR2=1/R1\nM30\n", "PROC SUB(REAL PA, REAL PB)\nR1=0\nM17\n") == "NC3001 3 error");
  CHECK(Set("DEF REAL VAL=0\nSUB(VAL)\nR2=1/VAL\nM30\n", "PROC SUB(VAR REAL PA)\nPA=3\nM17\n").empty());
  CHECK(Set("DEF REAL VAL=3\nSUB(VAL)\nR2=1/VAL\nM30\n", "PROC SUB(VAR REAL PA)\nPA=0\nM17\n") == "NC3001 3 error");
  // Two names for one variable.
  CHECK(Set("DEF REAL VAL=3\nSUB(VAL,VAL)\nM30\n", "PROC SUB(VAR REAL PA, VAR REAL PB)\nPA=0\nPB=1\nR1=1/PA\nM17\n")
            .empty());
  // A subprogram after each motion may change what all see.
  CHECK(Set("R1=0\nMCALL SUB(1)\nG0 X1\nR2=1/R1\nMCALL\nM30\n", "PROC SUB(REAL PA)\nR1=PA\nM17\n").empty());
  CHECK(Set("SUB(3)\nM30\n", "PROC SUB(INT PA)\nR1=1/PA\nIF PA>1\nSUB(PA-1)\nENDIF\nM17\n").empty());
}

TEST_CASE("value rules: a call of a cycle that ends in an alarm because of what it passes") {
  constexpr std::string_view kStart = "G17 G0 X0 Y0 Z20 F100\n";
  const auto mill = [&](std::string_view text) { return Mill(std::string(kStart) + std::string(text) + "M30\n"); };
  CHECK(mill("CYCLE81(10,0,2,-5)\nCYCLE81(10,0,2,5)\n") == "NC4013 3 error");
  CHECK(mill("CYCLE81(10,0,2,,5)\nCYCLE81(10,10,2,,5)\n") == "NC4013 3 error");
  CHECK(mill("CYCLE81(-10,0,2,5)\n").empty());  // upwards
  // Modal: taken once, at the block that makes it modal.
  CHECK(mill("MCALL CYCLE81(10,0,2,5)\nX1\nMCALL\n") == "NC4013 2 error");
  CHECK(mill("MCALL CYCLE81(10,0,2,-5)\nX1\nX2\nMCALL\n").empty());
  // Values that may be right.
  CHECK(mill("CYCLE81(10,0,2,R1)\n").empty());
  CHECK(mill("IF R1>0\nR2=5\nELSE\nR2=-5\nENDIF\nCYCLE81(10,0,2,R2)\n").empty());
  // The call that gives the value, not the one that hands it on; one that is always wrong is to blame itself.
  constexpr std::string_view kMain = "G17 G0 X0 Y0 Z20 F100\nDRILL(-5)\nDRILL(5)\nM30\n";
  CHECK(Set(kMain, "%_N_DRILL_SPF\nPROC DRILL(REAL DEEP)\nCYCLE81(10,0,2,DEEP)\nM17\n") == "NC4013 3 error");
  CHECK(Set(kMain, "%_N_DRILL_SPF\nPROC DRILL(REAL DEEP)\nCYCLE81(10,0,2,DEEP+90)\nM17\n") == "NC4013 3 error");
  // A guard of the user does what it is there for.
  CHECK(Set("SUB(0)\nM30\n", "PROC SUB(REAL PA)\nIF PA<=0\nSETAL(65001)\nENDIF\nR1=PA\nM17\n").empty());
}

TEST_CASE("value rules: steps grow in line with the program") {
  const auto steps = [](int loops, int calls) {
    std::string text = "DEF INT CNT\n";
    for (int i = 0; i < loops; ++i)
      text += "FOR CNT=0 TO 9\nR" + std::to_string(i % 50) + "=CNT*2\nIF R1>5\nR2=R2+1\nENDIF\nENDFOR\n";
    for (int i = 0; i < calls; ++i) text += "SUB(" + std::to_string(i) + ")\n";
    text += "M30\n";
    return Check("sinumerik-840d-mill", {{"main.mpf", text}, {"sub.spf", "PROC SUB(REAL PA)\nR3=PA+1\nM17\n"}}).steps;
  };
  const std::uint64_t one = steps(50, 50);
  const std::uint64_t two = steps(100, 100);
  const std::uint64_t four = steps(200, 200);
  CHECK(two < 2.2 * static_cast<double>(one));
  CHECK(four < 2.2 * static_cast<double>(two));
}

TEST_CASE("value rules: arcs by their radius that end where they start") {
  CHECK(Mill("G0 X4 Y5\nG1 Z-1 F100\nG2 X4 Y5 CR=8\nM30\n") == "NC1013 3 error");
  CHECK(Mill("G0 X4 Y5 F100\nG3 X=AC(4) CR=8\nM30\n") == "NC1013 2 error");
  CHECK(Lathe("G18 DIAMON\nG0 X20 Z0 F0.1\nG2 X20 Z0 CR=3\nM30\n") == "NC1013 3 error");
  CHECK(Macro("O1\nG90 G0 G54 X3. Y0.\nG2 X3. Y0. R4. F100.\nM30\n") == "NC1013 3");  // no motion, no alarm
  CHECK(Mill("DEF REAL XMID=50, RAD=22\nG0 X=XMID+RAD Y0 F100\nG3 X=XMID+RAD Y0 CR=RAD\nM30\n") == "NC1013 3 error");
  CHECK(Mill("DEF REAL XMID=50\nG0 X=XMID Y0 F100\nXMID=R1\nG3 X=XMID Y0 CR=5\nM30\n").empty());
  CHECK(Mill("G0 X4 Y5 F100\nG2 X4 Y5 I-3 J0\nM30\n").empty());
  CHECK(Mill("G0 X4 Y5 F100\nG2 X4 Y6 CR=8\nM30\n").empty());
  CHECK(Mill("G0 X4 Y5 F100\nTRANS X1\nG2 X4 Y5 CR=8\nM30\n").empty());
  CHECK(Mill("G0 X4 Y5 F100\nG91 G2 X4 Y5 CR=8\nM30\n").empty());
}

TEST_CASE("value rules: arcs behind words that leave their points") {
  // A centre that does not count from the start, and one on the start.
  CHECK(Mill("G0 X0 Y0 F90\nG2 X30 Y0 I=AC(8) J=AC(0)\nM30\n") == "NC5004 2 error");
  CHECK(Mill("G0 X0 Y0 F90\nG2 X30 Y0 I=AC(15) J=AC(0)\nM30\n").empty());
  CHECK(Mill("G0 X3 Y4 F90\nG3 I0 J0\nM30\n") == "NC5004 2 error");
  CHECK(Lathe("G18 DIAMON\nG0 X20 Z0 F0.1\nG2 X40 Z-10 I=AC(40) K=AC(0)\nM30\n").empty());
  // Rounding, dwell, length and radius registers.
  CHECK(Mill("G0 X0 Y0 F90\nG1 X30 RND=3\nY30\nG2 X70 Y30 CR=6\nM30\n") == "NC2005 4 error");
  CHECK(Macro("O1\nG90 G54 G0 X8. Y4.\nG43 H2 Z1.\nG1 Z-1. F50\nG2 X12. Y4. I.3\nM30\n") == "NC5004 5 error");
  CHECK(Macro("O1\nG90 G54 G0 X8. Y4. F50\nG41 D3 X9.\nG2 X12. Y4. I.3\nM30\n") == "NC5004 4 error");
  // The length acts along the tool, which in that plane is an axis of the arc.
  CHECK(Macro("O1\nG90 G54 G18 G0 X8. Z4. F50\nG43 H2\nG2 X12. Z4. I.3\nM30\n").empty());
  // What a tool's data move nobody knows here; the run alarms.
  CHECK(Mill("G0 X0 Y0 F90\nT3 D1\nG2 X40 Y0 CR=6\nM30\n") == "NC2005 3");
  // Numbers that count increments, and inches.
  CHECK(Macro("O1\nG90 G54 G21 G0 X1000 Y5. F50\nG2 X15. Y5. I2.5\nM30\n") == "NC5004 3 error");
  CHECK(Macro("O1\nG90 G54 G21 G0 X5000 Y5. F50\nG2 X10. Y5. I2500\nM30\n").empty());
  CHECK(Macro("O1\nG90 G54 G20 G0 X0. Y0. F5.\nG2 X1. Y0. R.4\nM30\n") == "NC2005 3 error");
  CHECK(Macro("O1\nG90 G54 G0 X0. Y0. F5.\nG31 X9. Y9.\nG2 X19. Y9. R1.\nM30\n").empty());
}

TEST_CASE("value rules: arcs of called programs and by their angle") {
  constexpr std::string_view kArc = "PROC SUB(REAL XEND,REAL RAD)\nG2 X=XEND Y0 CR=RAD\nM17\n";
  CHECK(Set("G17 F90\nG0 X0 Y0\nSUB(30,5)\nM30\n", kArc) == "NC2005 2 error");
  CHECK(Set("G17 F90\nG0 X0 Y0\nSUB(30,15)\nM30\n", kArc).empty());
  CHECK(Set("G17 F90\nG0 X0 Y0\nTRANS X5\nSUB(30,5)\nM30\n", kArc).empty());
  // Behind a call the position is what the program leaves.
  CHECK(Set("G17 F90\nG0 X0 Y0\nSUB(30,15)\nG2 X30 Y0 CR=9\nM30\n", kArc).empty());
  CHECK(Mill("G0 X0 Y0 F90\nR1=370\nG2 X10 Y0 AR=R1\nM30\n") == "NC2005 3 error");
  CHECK(Mill("G0 X0 Y0 F90\nG2 X0 Y0 AR=90\nM30\n") == "NC1013 2 error");
  CHECK(Mill("G0 X0 Y0 F90\nG2 X10 Y0 AR=90\nG2 X10 Y20 CR=10\nM30\n").empty());
  CHECK(Mill("G0 X0 Y0 F90\nG2 I10 J0 AR=90\nG2 X0 Y0 CR=3\nM30\n").empty());
  CHECK(Mill("MCALL SUB2\nG0 X0 Y0 F90\nG2 X30 Y0 CR=3\nMCALL\nM30\n%_N_SUB2_SPF\nG0 X30 Y0\nM17\n").empty());
}

TEST_CASE("value rules: arcs whose ends lie on no circle") {
  CHECK(Mill("G0 X0 Y0\nG2 X10 Y0 I4 J0 F100\nM30\n") == "NC5004 2 error");
  CHECK(Mill("G0 X0 Y0 F100\nG91 G3 X10 Y0 J5\nM30\n") == "NC5004 2 error");
  CHECK(Lathe("G18 DIAMON\nG0 X20 Z0 F0.1\nG2 X40 Z-12 I10 K0\nM30\n") == "NC5004 3 error");
  CHECK(Mill("G0 X0 Y0\nG2 X10 Y0 I5 J0 F100\nG2 I-5\nM30\n").empty());
  CHECK(Lathe("G18 DIAMON\nG0 X20 Z0 F0.1\nG2 X40 Z-10 I10 K0\nM30\n").empty());
  CHECK(Mill("G0 X0 Y0\nTRANS X1\nG2 X10 Y0 I4 J0 F100\nM30\n").empty());
  CHECK(Macro("O1\nG90 G0 G54 X0. Y0.\nG2 X10. Y0. I4. J0. F100.\nM30\n") == "NC5004 3 error");
  CHECK(Mill("R5=10 R6=4\nG0 X0 Y0\nG2 X=R5 Y0 I=R6 J0 F100\nM30\n") == "NC5004 3 error");
  CHECK(Mill("R5=10 R6=4\nG0 X0 Y0\nR6=5 G2 X=R5 Y0 I=R6 J0 F100\nM30\n").empty());
  CHECK(Macro("O1\n#1=4.\nG90 G0 G54 X0. Y0.\nG2 X10. Y0. I#1 J0. F100.\nM30\n") == "NC5004 4 error");
  // One of the calls gives such points.
  constexpr std::string_view kHalf = "PROC SUB(REAL RAD)\nG0 X=RAD Y0\nG3 X=-RAD Y0 I-20 J0 F100\nM17\n";
  CHECK(Set("G17\nSUB(20)\nSUB(19)\nM30\n", kHalf) == "NC5004 3 error");
  CHECK(Set("G17\nSUB(20)\nSUB(20.001)\nM30\n", kHalf).empty());
  CHECK(Sub(kHalf).empty());
  CHECK(Mill("G0 X=R1 Y0\nG2 X10 Y0 I4 J0 F100\nM30\n").empty());
}

TEST_CASE("value rules: radii that do not reach the end point") {
  CHECK(Mill("G0 X0 Y0 F100\nG2 X40 Y0 CR=19\nM30\n") == "NC2005 2 error");
  CHECK(Mill("G0 X0 Y0 F100\nG3 X0 Y40 CR=-19\nM30\n") == "NC2005 2 error");
  CHECK(Lathe("G18 DIAMON\nG0 X20 Z0 F0.1\nG2 X40 Z0 CR=4\nM30\n") == "NC2005 3 error");
  CHECK(Macro("O1\nG17 G90 G0 G54 X0. Y0.\nG2 X40. R19. F100.\nM30\n") == "NC2005 3 error");
  CHECK(Mill("G0 X0 Y0 F100\nG2 X40 Y0 CR=20\nM30\n").empty());
  CHECK(Lathe("G18 DIAMON\nG0 X20 Z0 F0.1\nG2 X40 Z0 CR=5\nM30\n").empty());
  CHECK(Mill("R2=19\nG0 X0 Y0 F100\nG2 X40 Y0 CR=R2\nM30\n") == "NC2005 3 error");
  CHECK(Mill("R2=20\nIF R1>1\nR2=19\nENDIF\nG0 X0 Y0 F100\nG2 X40 Y0 CR=R2\nM30\n").empty());
  CHECK(Mill("G0 X=R1 Y0 F100\nG2 X40 Y0 CR=1\nM30\n").empty());
}

TEST_CASE("value rules: values that words cannot take") {
  CHECK(Mill("R1=-1\nG17 G90\nG1 X10 CHF=R1 F100\nY10\nM30\n") == "NC2005 3 error");
  CHECK(Mill("R1=-2\nG17\nG111 X0 Y0\nG0 AP=10 RP=R1\nM30\n") == "NC2005 4 error");
  CHECK(Mill("R1=0\nSCALE X=R1\nM30\n") == "NC2005 2 error");
  CHECK(Mill("R1=-1\nG4 F=R1\nM30\n") == "NC2005 2 error");
  CHECK(Mill("R1=-1\nT=R1\nM30\n") == "NC2005 2 error");
  CHECK(Mill("R1=-1\nAB: G0 X1\nREPEAT AB P=R1\nM30\n") == "NC2005 3 error");
  CHECK(Set("R1=0\nSUB P=R1\nM30\n", "G0 X1\nM17\n") == "NC2005 2 error");
  CHECK(Macro("O1\n#1=-1.\nG04 X#1\nM30\n") == "NC2005 3 error");
  CHECK(Macro("O1\n#1=0\nG51 X0 Y0 Z0 P#1\nG50\nM30\n") == "NC2005 3 error");
  // A rule that looks at a value teaches the analysis nothing about it.
  CHECK(Mill("FOR R1=-2 TO 2\nG4 F=4+SQRT(R1)\nENDFOR\nM30\n") == "NC3002 2");
  // Nothing alarms before the next move, or the card does not say it.
  CHECK(Mill("R1=0\nG1 X1 F=R1\nM30\n") == "NC2005 2");
  CHECK(Mill("S-500 M3\nM30\n") == "NC2005 1");
  CHECK(Mill("G1 X5 F=-100\nM30\n") == "NC2005 1");
  CHECK(Mill("D-1\nM30\n") == "NC2005 1");
  CHECK(Mill("G4 F-1\nM30\n") == "NC2005 1");
  CHECK(Mill("S=R1 F=-R2 D0 T0\nG1 X-5 Z=-3\nG4 F0\nM30\n").empty());
  CHECK(Macro("O1\nF-100.\nM30\n") == "NC2005 2");
  // The program lets such values through.
  CHECK(Mill("FOR R1=0 TO 3\nF=R1*100\nENDFOR\nM30\n") == "NC2005 2");
  CHECK(Set("SUB(0.1)\nSUB(0)\nM30\n", "PROC SUB(REAL FEED)\nG1 X1 F=FEED\nM17\n") == "NC2005 2");
  CHECK(Mill("FOR R1=1 TO 3\nF=R1*100\nG4 F=R1-1\nENDFOR\nM30\n").empty());
  CHECK(Set("SUB(0.1)\nSUB(0)\nM30\n", "PROC SUB(REAL FEED)\nIF FEED>0\nF=FEED\nENDIF\nM17\n").empty());
  CHECK(Mill("R1=2 G4 F=R1-3\nM30\n") == "NC2005 1 error");
  CHECK(Mill("R1=-1\nR1=2 G4 F=R1\nG0 X=R1 Y-5\nM30\n").empty());
  CHECK(Mill("G1 X1 F=R1\nG4 F=R2\nT=R3\nSCALE X=R4\nM30\n").empty());
  CHECK(Macro("O1\n#1=#0\nH#1\nM30\n").empty());
}

TEST_CASE("value rules: feed moves without a feed") {
  CHECK(Mill("G0 X1\nG1 X2\nG1 X3\nM30\n") == "NC5002 2 error");
  CHECK(Mill("X1\nM30\n") == "NC5002 1 error");
  CHECK(Mill("G17 G90\nG0 X0 Y0\nIF R1>1 GOTOF AB\nG1 X1 F100\nM30\nAB: G3 X5 Y0 CR=3\nM30\n") == "NC5002 6 error");
  CHECK(Macro("O1\nG0 X1.\nG1 X2.\nM30\n") == "NC5002 3 error");
  CHECK(Mill("G0 X1 F100\nG1 X2\nM30\n").empty());
  CHECK(Mill("G0 X1\nIF R1>1\nF100\nENDIF\nG1 X2\nM30\n") == "NC5002 5");
  CHECK(Macro("O1\nG90 G1\nG53 Z0.\nG91 G28 Z0.\nM30\n").empty());
  // Callers may have set it.
  CHECK(Sub("PROC SUB1\nG1 X2\nM17\n").empty());
  CHECK(Mill("G93\nG1 X1 F1\nTRANS X5\nG4 F2\nM30\n").empty());
}

TEST_CASE("value rules: a feed of 0 is none") {
  CHECK(Mill("G1 X1 F0\nM30\n") == "NC5002 1 error");
  CHECK(Mill("F100\nG1 X1\nF0\nG1 X2\nM30\n") == "NC5002 4 error");
  CHECK(Macro("O1\nF0\nG1 X2.\nM30\n") == "NC5002 3 error");
  CHECK(Mill("F0\nG0 X1\nG1 X2 F100\nM30\n").empty());
  CHECK(Mill("G1 X1 F100\nIF R1>1\nF0\nENDIF\nG1 X2\nM30\n") == "NC5002 5");
  CHECK(Mill("G1 X1 F=R1\nG4 F0\nX2\nM30\n").empty());
}

TEST_CASE("value rules: a change of the kind of feed needs a new feed") {
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nG95\nG1 X9\nM30\n") == "NC5002 4 error");
  CHECK(Lathe("G95 G0 X0\nG1 X5 F0.2\nG94\nG0 X9\nG1 X2\nX3\nM30\n") == "NC5002 5 error");
  CHECK(Lathe("G94 G0 X0 S500 M4\nG1 X5 F200\nG96 S100 M4\nG1 X2\nM30\n") == "NC5002 4 error");
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nIF R1>0\nG95\nELSE\nG95\nENDIF\nG1 X9\nM30\n") == "NC5002 8 error");
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nG95 F0.1\nG1 X9\nM30\n").empty());
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nG95\nG1 X9 F0.1\nM30\n").empty());
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nG95\nG0 X9\nM30\n").empty());
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nG95\nG94\nG1 X9\nM30\n") == "NC5002 5 error");
  // Some way lacks it, or a caller may have set it.
  CHECK(Mill("G94 G0 X0\nG1 X5 F100\nG95\nIF R1>0\nF0.1\nENDIF\nG1 X9\nM30\n") == "NC5002 7");
  CHECK(Sub("G95\nG1 X9\nM17\n").empty());
  // There the number goes over.
  CHECK(Check("fanuc-lathe-a", {{"o1.nc", "O1\nG98 G1 X5. F100.\nG99\nG1 X9.\nM30\n"}}).found.empty());
}

TEST_CASE("value rules: cycles and threads without a feed") {
  CHECK(Mill("G0 X0 Y0 Z9\nCYCLE81(10,0,2,-5)\nM30\n") == "NC5002 2 error");
  CHECK(Mill("G0 Z9\nMCALL CYCLE81(10,0,2,-5)\nX4\nX8\nMCALL\nM30\n") == "NC5002 3 error");
  CHECK(Mill("G0 Z9 F50\nMCALL CYCLE81(10,0,2,-5)\nX4\nMCALL\nM30\n").empty());
  CHECK(Macro("O1\nG0 X0. Z9.\nG81 Z-5. R2.\nX4.\nG80\nM30\n") == "NC5002 3 error");
  CHECK(Macro("O1\nG0 X0. Z9.\nIF[#500EQ1]GOTO5\nG81 Z-5. R2. F50.\nN5 X4.\nG80\nM30\n") == "NC5002 5");
  CHECK(Macro("O1\nG0 X0. Z9.\nG81 Z-5. R2. K0\nG80\nM30\n").empty());
  CHECK(Check("fanuc-lathe-a", {{"o1.nc", "O1\nG0 X9. Z2.\nG32 Z-5.\nM30\n"}}).found == "NC5002 3 error");
  CHECK(Lathe("G0 X9 Z2\nG33 Z-5 K1\nM30\n").empty());
}

TEST_CASE("value rules: ways without a feed that no run takes") {
  CHECK(Mill("G0 X1\nFOR R1=1 TO 3\nG1 X=R1 F100\nENDFOR\nG1 X9\nM30\n").empty());
  CHECK(Mill("G0 X1\nFOR R1=1 TO 3\nG1 X=R1\nF100\nENDFOR\nM30\n") == "NC5002 3");
  CHECK(Mill("G0 X1\nFOR R1=3 TO 1\nF100\nENDFOR\nG1 X9\nM30\n").find("NC5002 5") != std::string::npos);
  // A loop with a test, and one whose end an operator sets, are thought to run.
  CHECK(Mill("G0 X1\nR1=0\nWHILE R1<3\nF100\nR1=R1+1\nENDWHILE\nG1 X9\nM30\n").empty());
  CHECK(Mill("G0 X1\nFOR R1=1 TO R2\nF100\nENDFOR\nG1 X9\nM30\n").empty());
  CHECK(Mill("R1=5\nG0 X1\nIF R1==5\nF100\nENDIF\nG1 X9\nM30\n").empty());
  CHECK(Macro("O1\n#1=2\nG0 X1.\nIF[#1EQ3]GOTO5\nF100.\nN5 G1 X9.\nM30\n").empty());
}

}  // namespace ncport::check
