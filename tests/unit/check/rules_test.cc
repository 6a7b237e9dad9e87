// Each rule: programs that it must flag and programs that it must not.
#include "check/rules.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "dialects/registry.h"
#include "frontend/reader.h"

namespace ncport::check {
namespace {

/// What the rules find in one file, "CODE line" each.
std::string Findings(std::string_view profile_name, std::string_view file_name, std::string_view text) {
  const dialects::Profile profile = dialects::BuiltIn(profile_name);
  SourceFiles files;
  ir::Module module;
  diag::Sink sink;
  const FileId file = files.Add(std::string(file_name), std::string(text));
  const Status read = frontend::ReadFile(files, file, profile, {}, module, sink);
  frontend::ResolveNames(files, module, profile, sink);
  CHECK(read.Ok());
  CheckPrograms(Subject(module, profile, {}), sink);
  sink.SortByPlace();
  std::string found;
  for (const diag::Diagnostic& finding : sink.All()) {
    if (!found.empty()) found += ", ";
    found += std::string(diag::InfoOf(finding.code).number) + " " + std::to_string(finding.at.line);
  }
  return found;
}
std::string Mill(std::string_view text) { return Findings("sinumerik-840d-mill", "main.mpf", text); }
std::string Lathe(std::string_view text) { return Findings("sinumerik-840d-lathe", "main.mpf", text); }
std::string Sub(std::string_view text) { return Findings("sinumerik-840d-mill", "sub.spf", text); }
std::string Macro(std::string_view text) { return Findings("fanuc-mill", "o1.nc", text); }

}  // namespace

TEST_CASE("jumps that find nothing") {
  CHECK(Mill("GOTOF AB\nM30\n") == "NC4001 1");
  CHECK(Mill("AB: G0 X1\nIF R1>1 GOTOF AB\nM30\n") == "NC4001 2");
  CHECK(Macro("O1\nIF [#101 GT 1] GOTO 20\nN10 M30\n") == "NC4001 2");
  CHECK(Mill("GOTOC AB\nM30\n").empty());
  CHECK(Mill("AB: G0 X1\nIF R1>1 GOTOB AB\nM30\n").empty());
  CHECK(Macro("O1\nN10 IF [#101 GT 1] GOTO 10\nM30\n").empty());
}

TEST_CASE("names that are too long") {
  const std::string label(33, 'A');
  const std::string program = "PROC " + std::string(25, 'P') + "\n";
  CHECK(Mill(label + ": G0 X1\nIF R1>1 GOTOB " + label + "\nM30\n") == "NC2006 1");
  CHECK(Mill("N10 " + label + ": G0 X1\nIF R1>1 GOTOB " + label + "\nM30\n") == "NC2006 1");
  CHECK(Sub(program + "G0 X1\nM17\n") == "NC2006 1");
  const std::string fits(32, 'A');
  CHECK(Mill(fits + ": G0 X1\nIF R1>1 GOTOB " + fits + "\nM30\n").empty());
  CHECK(Sub("PROC " + std::string(24, 'P') + "\nG0 X1\nM17\n").empty());
  CHECK(Findings("sinumerik-802s-mill", "main.mpf", "LABEL_123: G0 X1\nIF R1>1 GOTOB LABEL_123\nM2\n").empty());
  CHECK(Findings("sinumerik-840d-mill", "a_file_with_a_name_of_many_characters.mpf", "G0 X1\nM30\n").empty());
}

TEST_CASE("jumps to labels that stand twice") {
  CHECK(Mill("IF R1>1 GOTOF AB\nAB: G0 X1\nAB: G0 X2\nM30\n") == "NC2003 1");
  CHECK(Mill("N10 G0 X1\nN10 G0 X2\nIF R1>1 GOTOB N10\nM30\n") == "NC2003 3");
  CHECK(Macro("O1\nIF [#101 EQ 1] GOTO 10\nN10 G0 X1.\nN10 G0 X2.\nM30\n") == "NC2003 2");
  // One before and one behind: each jump has its own.
  CHECK(Mill("AB: G0 X1\nIF R1>1 GOTOB AB\nIF R1<1 GOTOF AB\nAB: G0 X2\nM30\n").empty());
  CHECK(Mill("N10 G0 X1\nN10 G0 X2\nM30\n").empty());
  CHECK(Macro("O1\nN10 G0 X1.\nN10 G0 X2.\nM30\n").empty());
}

TEST_CASE("labels that nothing names") {
  CHECK(Mill("AB: G0 X1\nM30\n") == "NC2007 1");
  CHECK(Mill("AB: G0 X1\nCD: G0 X2\nIF R1>1 GOTOB AB\nM30\n") == "NC2007 2");
  CHECK(Sub("AB: G0 X1\nCD: G0 X2\nREPEAT AB P=2\nM17\n") == "NC2007 2");
  CHECK(Mill("AB: G0 X1\nCD: G0 X2\nIF R1>1 GOTOB \"A\"<<\"B\"\nM30\n").empty());
  CHECK(Mill("AB: G0 X1\nCD: G0 X2\nREPEAT AB CD P=2\nM30\n").empty());
  CHECK(Mill("AB: G0 X1\nENDLABEL:\nG0 X2\nREPEAT AB P=2\nM30\n").empty());
}

TEST_CASE("variables and parameters that nothing uses") {
  CHECK(Mill("DEF INT AB\nM30\n") == "NC2007 1");
  CHECK(Mill("DEF INT AB, CD=1\nAB=CD\nM30\n") == "NC2007 1");
  CHECK(Sub("PROC SUB1(REAL LENGTH, REAL FEED)\nG1 X=LENGTH F100\nM17\n") == "NC2007 1");
  CHECK(Mill("DEF INT AB=1\nG0 X=AB\nM30\n").empty());
  CHECK(Sub("PROC SUB1(VAR REAL RESULT)\nRESULT=1\nM17\n").empty());
  CHECK(Sub("PROC SUB1(INT COUNT)\nDEF REAL AB[3]\nG0 X=AB[COUNT]\nM17\n").empty());
}

TEST_CASE("declarations of called programs") {
  const std::string sub = "M30\n%_N_SUB1_SPF\nPROC SUB1(REAL AB, INT CD)\nG0 X=AB Y=CD\nM17\n";
  CHECK(Mill("EXTERN SUB1(REAL)\nSUB1(1,2)\n" + sub) == "NC2011 1");
  CHECK(Mill("EXTERN SUB1(REAL,REAL)\nSUB1(1,2)\n" + sub) == "NC2004 1");
  CHECK(Mill("EXTERN SUB1(REAL,VAR INT)\nSUB1(1,2)\n" + sub) == "NC2004 1");
  CHECK(Mill("EXTERN SUB1(REAL,INT)\nSUB1(1,2)\n" + sub).empty());
  CHECK(Mill("SUB1\n" + sub).empty());
  CHECK(Mill("SUB2\nM30\n%_N_SUB2_SPF\nG0 X1\nM17\n").empty());
}

TEST_CASE("jumps into structures") {
  CHECK(Mill("GOTOF N20\nIF R1>1\nN20 G0 X1\nENDIF\nM30\n") == "NC4004 1");
  CHECK(Mill("IF R1>1\nN10 GOTOF N20\nELSE\nN20 G0 X1\nENDIF\nM30\n") == "NC4004 2");
  CHECK(Macro("O1\nGOTO 20\nWHILE [#1 LT 5] DO1\n#1=#1+1\nN20 G0 X1.\nEND1\nM30\n") == "NC4004 2");
  CHECK(Mill("IF R1>1\nGOTOF N20\nENDIF\nG0 X1\nN20 M30\n").empty());
  CHECK(Mill("WHILE R1<5\nR1=R1+1\nIF R1==3\nGOTOF N20\nENDIF\nG0 X=R1\nN20 G0 Y1\nENDWHILE\nM30\n").empty());
  CHECK(Macro("O1\nWHILE [#1 LT 5] DO1\n#1=#1+1\nIF [#1 EQ 3] GOTO 20\nG0 X1.\nN20 G0 X2.\nEND1\nM30\n").empty());
}

TEST_CASE("programs without an end") {
  CHECK(Mill("G0 X1\n") == "NC4005 1");
  CHECK(Sub("PROC SUB1\nG0 X1\nG0 X2\n") == "NC4005 3");
  CHECK(Mill("IF R1>1 GOTOF AB\nM30\nAB: G0 X1\n") == "NC4005 3");
  CHECK(Mill("G0 X1\nM2\n").empty());
  CHECK(Sub("PROC SUB1\nG0 X1\nRET\n").empty());
  CHECK(Mill("AB: G0 X1\nM0\nGOTOB AB\n").empty());
}

TEST_CASE("programs that call themselves for ever") {
  CHECK(Sub("PROC SUB1\nG0 X1\nSUB1\nM17\n") == "NC4006 3");
  CHECK(Sub("PROC SUB1\nIF R1>1\nSUB1\nELSE\nSUB1\nENDIF\nM17\n") == "NC4006 3");
  CHECK(Macro("O1\nG0 X1.\nM98 P1\nM99\n") == "NC4006 3");
  CHECK(Sub("PROC SUB1\nR1=R1-1\nIF R1<0 GOTOF READY\nSUB1\nREADY: M17\n").empty());
  CHECK(Sub("PROC SUB1\nIF R1>1\nSUB1\nENDIF\nM17\n").empty());
  CHECK(Sub("PROC SUB1\nSUB2\nM17\n%_N_SUB2_SPF\nG0 X1\nM17\n").empty());
}

TEST_CASE("cycles that go from hole to hole without a modal call") {
  const std::string holes = "HOLES2(0,0,20,0,60,6)\n";
  CHECK(Mill("G0 X0 Y0 Z5\nCYCLE81(10,0,2,-5)\n" + holes + "M30\n").find("NC4013 3") != std::string::npos);
  CHECK(Mill("G0 X0 Y0 Z5\nHOLES1(0,0,0,5,10,3)\nM30\n") == "NC4013 2");
  CHECK(Mill("G0 X0 Y0 Z5\nMCALL CYCLE81(10,0,2,-5)\n" + holes + "MCALL\n" + holes + "M30\n") == "NC4013 5");
  CHECK(Mill("G0 X0 Y0 Z5\nMCALL CYCLE81(10,0,2,-5)\n" + holes + "MCALL\nM30\n").empty());
  CHECK(Mill("G0 X0 Y0 Z5\nIF R1>0\nMCALL CYCLE81(10,0,2,-5)\nENDIF\n" + holes + "MCALL\nM30\n").empty());
  CHECK(Sub("PROC SUB\n" + holes + "M17\n").empty());
}

TEST_CASE("words that do not describe an arc") {
  CHECK(Mill("G17 F100\nG2 X20 Y20\nM30\n") == "NC5005 2");
  CHECK(Lathe("G18 F0.1\nG3 X20 Z-5\nM30\n") == "NC5005 2");
  CHECK(Macro("O1\nG17 G90 F100.\nG2 X20. Y5.\nM30\n") == "NC5005 3");
  CHECK(Mill("G17 F100\nG2 X20 I10 K0\nM30\n") == "NC1002 2");
  CHECK(Lathe("G18 F0.1\nG2 Z-10 J5\nM30\n") == "NC1002 2");
  CHECK(Macro("O1\nG18 G90 F100.\nG2 X20. J5.\nM30\n") == "NC1002 3");
  CHECK(Mill("G17 F100\nG1 X20 CR=5\nM30\n") == "NC1002 2");
  CHECK(Mill("G17 F100\nG0 X20 Y5 CR=5\nM30\n") == "NC1002 2");
  CHECK(Lathe("G18 F0.1\nG1 Z-20 CR=5\nM30\n") == "NC1002 2");
  CHECK(Mill("G17 F100\nG1 X10 AP=30 RP=5\nM30\n") == "NC1013 2");
  CHECK(Mill("G17\nG0 AP=30 Y5\nM30\n") == "NC1013 2");
  CHECK(Lathe("G18\nG0 AP=30 RP=5 X10\nM30\n") == "NC1013 2");
  CHECK(Mill("G17 F100\nG2 X20 Y0 I10\nG3 I=AC(0) J=AC(0)\nG2 X1 Y1 AR=90\nG2 AP=90 RP=20 Z1\nCIP X1 I1=3 J1=4\nM30\n")
            .empty());
  CHECK(Mill("G17 F100\nG2 X20 Y0 I10\nTRANS X10 Y5\nG1 Z-5 AP=3 RP=4\nG110 X1 Y1\nM30\n").empty());
  CHECK(Lathe("G18 F0.1\nG33 Z-20 K2\nG2 X20 Z-3 I0 K-3\nM30\n").empty());
  // Which plane is in force is not known here.
  CHECK(Sub("PROC SUB1\nG2 X20 Z-20 K10 F100\nM17\n").empty());
}

TEST_CASE("loops whose end changes inside") {
  CHECK(Mill("FOR R1=1 TO R2\nR2=R2-1\nENDFOR\nM30\n") == "NC4011 1");
  CHECK(Mill("DEF INT AB, CD=5\nFOR AB=1 TO CD*2\nIF AB>2\nCD=3\nENDIF\nENDFOR\nM30\n") == "NC4011 2");
  CHECK(Mill("FOR R1=1 TO R2\nFOR R2=1 TO 3\nG0 X=R2\nENDFOR\nENDFOR\nM30\n") == "NC4011 1, NC3011 1");
  CHECK(Mill("FOR R1=1 TO R2\nR3=R2\nENDFOR\nR2=1\nM30\n").empty());
  CHECK(Mill("FOR R1=1 TO 5\nR1=R1+1\nENDFOR\nM30\n").empty());
  CHECK(Mill("FOR R1=1 TO R2\nR[R1]=3\nENDFOR\nM30\n").empty());
}

TEST_CASE("counters that are read behind their loop") {
  CHECK(Mill("FOR R1=1 TO 5\nG0 X=R1\nENDFOR\nG0 Y=R1\nM30\n") == "NC3011 4");
  CHECK(Mill("DEF INT AB\nFOR AB=1 TO 5\nENDFOR\nIF AB>5\nG0 X1\nENDIF\nM30\n") == "NC3011 4");
  CHECK(Mill("FOR R1=1 TO 5\nENDFOR\nR2=R1 R1=0\nM30\n") == "NC3011 3");
  CHECK(Mill("FOR R1=1 TO 5\nENDFOR\nR1=0\nG0 X=R1\nM30\n").empty());
  // Left by a jump, the counter is what it was.
  CHECK(Mill("FOR R1=1 TO 5\nIF R[R1]>3 GOTOF AB\nENDFOR\nM30\nAB: G0 X=R1\nM30\n").empty());
  CHECK(Mill("LOOP\nFOR R1=1 TO 5\nG0 X=R1\nENDFOR\nENDLOOP\n").empty());
  CHECK(Mill("FOR R1=1 TO 5\nENDFOR\nSUB1\nG0 X=R1\nM30\n%_N_SUB1_SPF\nR1=0\nM17\n").empty());
}

TEST_CASE("comparisons with a fraction where the control compares exactly") {
  CHECK(Macro("O1\nIF[#101EQ0.1]GOTO10\nN10 M30\n") == "NC3010 2");
  CHECK(Macro("O1\nWHILE[#1NE-0.3]DO1\n#1=#1-0.1\nEND1\nM30\n") == "NC3010 2");
  CHECK(Macro("O1\nIF[[#101+#102]EQ0.7]THEN #3=1\nM30\n") == "NC3010 2");
  CHECK(Macro("O1\nIF[#101EQ0.5]GOTO10\nN10 M30\n").empty());
  CHECK(Macro("O1\nIF[#101GE0.1]GOTO10\nN10 M30\n").empty());
  CHECK(Macro("O1\nIF[#101EQ3]GOTO10\nN10 M30\n").empty());
  // Here equality has a tolerance.
  CHECK(Mill("IF R1==0.1 GOTOF AB\nAB: M30\n").empty());
}

TEST_CASE("one name for a variable and something else") {
  CHECK(Mill("DEF REAL AB=1\nAB: G0 X=AB\nIF R1>1 GOTOB AB\nM30\n") == "NC2014 1");
  CHECK(Mill("DEF REAL SUB1=1\nG0 X=SUB1\nM30\n%_N_SUB1_SPF\nG0 X1\nM17\n") == "NC2014 1");
  CHECK(Sub("PROC SUB1(REAL ab)\nAB: G0 X=ab\nIF R1>1 GOTOB AB\nM17\n") == "NC2014 1");
  CHECK(Mill("DEF REAL AB=1\nCD: G0 X=AB\nIF R1>1 GOTOB CD\nM30\n").empty());
  // The label of another program.
  CHECK(Mill("DEF REAL AB=1\nG0 X=AB\nSUB1\nM30\n%_N_SUB1_SPF\nAB: G0 X1\nIF R1>1 GOTOB AB\nM17\n").empty());
}

TEST_CASE("calls with arguments of programs that only EXTERN makes known") {
  const std::string plain = "M30\n%_N_SUB1_SPF\n;$PATH=/_N_SPF_DIR\nPROC SUB1(REAL AB)\nG0 X=AB\nM17\n";
  const std::string work = "M30\n%_N_SUB1_SPF\n;$PATH=/_N_WKS_DIR/_N_AB_WPD\nPROC SUB1(REAL AB)\nG0 X=AB\nM17\n";
  const std::string cycle = "M30\n%_N_SUB1_SPF\n;$PATH=/_N_CUS_DIR\nPROC SUB1(REAL AB)\nG0 X=AB\nM17\n";
  CHECK(Mill("SUB1(1)\nSUB1(2)\n" + plain) == "NC4012 1");
  CHECK(Mill("SUB1(1)\n" + work) == "NC4012 1");
  CHECK(Mill("MCALL SUB1(1)\nG0 X1\nMCALL\n" + plain) == "NC4012 1");
  CHECK(Mill("EXTERN SUB1(REAL)\nSUB1(1)\n" + plain).empty());
  CHECK(Mill("SUB1\n" + plain).empty());
  CHECK(Mill("SUB1(1)\n" + cycle).empty());
}

TEST_CASE("feed moves of a spindle that was not started, or has no speed") {
  CHECK(Mill("S1000\nG1 X5 F100\nX9\nM30\n") == "NC5003 2");
  CHECK(Mill("S1000 M3\nG1 X5 F100\nM5\nS2000\nG1 X9\nM30\n") == "NC5003 5");
  CHECK(Mill("M3\nG0 X1\nG1 X5 F100\nM30\n") == "NC5003 1");
  CHECK(Lathe("G96 LIMS=2000 M4\nG0 X50\nG1 Z5 F0.2\nM30\n") == "NC5003 1");
  CHECK(Lathe("G96 S200 LIMS=2000\nG1 Z5 F0.2\nM30\n") == "NC5003 2");
  CHECK(Mill("S1000 M3\nG1 X5 F100\nM30\n").empty());
  CHECK(Mill("M3\nS1000\nG1 X5 F100\nM30\n").empty());
  CHECK(Mill("G1 X5 F100 S1000 M3\nM30\n").empty());
  CHECK(Mill("S=R1 M3\nG1 X5 F100 M5\nM30\n").empty());
  // Retracts and probes stand still on purpose, and nothing says otherwise.
  CHECK(Mill("G1 X5 F100\nM30\n").empty());
  CHECK(Mill("S1000 M3\nG1 X5 F100\nM5\nG1 X9\nM3\nG1 X5\nM30\n").empty());
  // The builder's word, a subprogram, a second spindle may do it.
  CHECK(Mill("S1000 M13\nG1 X5 F100\nM30\n").empty());
  CHECK(Sub("S1000\nG1 X5 F100\nM17\n").empty());
  CHECK(Lathe("S2=1000\nG1 X5 F0.1\nM30\n").empty());
  CHECK(Mill("M3\nIF R1>0\nS500\nENDIF\nG1 X5 F100\nM30\n").empty());
}

TEST_CASE("cutter compensation that begins or ends in an arc") {
  const std::string tool = "G17 G90 S900 M3 F200\nT1 M6\nD1\nG0 X0 Y0\n";
  CHECK(Mill(tool + "G41 G2 X9 Y9 CR=9\nG40 G1 X20\nM30\n") == "NC5009 5");
  CHECK(Mill(tool + "G42\nG2 I9\nG40 G1 X20\nM30\n") == "NC5009 6");
  CHECK(Mill(tool + "G2 X9 Y9 CR=9\nG41 X0 Y0 CR=9\nG40 G1 X20\nM30\n") == "NC5009 6");
  CHECK(Mill(tool + "G41\nG0 Z-5\nG2 X9 Y9 CR=9\nG40 G1 X20\nM30\n") == "NC5009 7");
  CHECK(Mill(tool + "G41 X5\nG40 G2 X9 Y9 CR=9\nG1 X20\nM30\n") == "NC5009 6");
  CHECK(Mill(tool + "IF R1>0\nG41\nELSE\nG42\nENDIF\nG2 X9 Y9 CR=9\nG40 G1 X20\nM30\n") == "NC5009 10");
  CHECK(Mill(tool + "G41 X5\nG2 X9 Y9 CR=9\nG42 X0 Y0 CR=9\nG40 G1 X20\nM30\n").empty());
  CHECK(Mill(tool + "G40 G2 X9 Y9 CR=9\nG41\nG40\nG2 X0 Y0 CR=9\nM30\n").empty());
  // Some way begins it, or what does is not known.
  CHECK(Mill(tool + "G41\nIF R1>0\nG1 X5\nENDIF\nG2 X9 Y9 CR=9\nG40 G1 X20\nM30\n").empty());
  CHECK(Mill(tool + "G41\nM99=1\nG74 X0\nG2 X9 Y9 CR=9\nG40 G1 X20\nM30\n").find("NC5009") == std::string::npos);
  CHECK(Sub("G17 G90 F200\nG41 G2 X9 Y9 CR=9\nG40 G1 X20\nM17\n").empty());
  CHECK(Mill("%_N_MA_MPF\n" + tool + "G41\nUPA\nG40 G1 X30\nM30\n%_N_UPA_SPF\nG2 X9 Y9 CR=9\nM17\n") == "NC5009 11");
}

TEST_CASE("cutter compensation without a tool") {
  CHECK(Mill("G17 G90 S900 M3\nG41 G1 X5 F100\nG40 X9\nM30\n") == "NC5010 2");
  CHECK(Mill("G17 G90 S900 M3\nG41\nG0 Z5\nG1 X5 F100\nG40 X9\nM30\n") == "NC5010 2");
  CHECK(Mill("T1 M6\nD0\nG17 G90 S900 M3\nG41 G1 X5 F100\nG40 X9\nM30\n") == "NC5010 4");
  CHECK(Macro("O1\nG17 G90 G40 G49\nS900 M3\nG41 G1 X5. F100.\nG40 X9.\nM30\n") == "NC5010 4");
  // Registers of the radius have their own word.
  const std::string register_of = "O1\nG17 G90 G40\nT1 M6\nG43 H1 Z50.\nS900 M3\n";
  CHECK(Macro(register_of + "G41 G1 X5. F100.\nG40 X9.\nM30\n") == "NC5010 6");
  CHECK(Macro(register_of + "G41 D1 G1 X5. F100.\nG40 X9.\nT2 M6\nS900 M3\nG41 X5.\nG40 X9.\nM30\n").empty());
  CHECK(Findings("haas-mill", "o1.nc", register_of + "G41 G1 X5. F100.\nG40 X9.\nM30\n").empty());
  CHECK(Mill("T1 M6\nD0\nT2 M6\nG17 G90 S900 M3\nG41 G1 X5 F100\nG40 X9\nM30\n").empty());
  CHECK(Mill("G17 G90 S900 M3\nG41 D1 G1 X5 F100\nG40 X9\nM30\n").empty());
  CHECK(Mill("G17 G90 S900 M3\nIF R1>0\nT5 M6\nENDIF\nG41 G1 X5 F100\nG40 X9\nM30\n").empty());
  CHECK(Mill("G17 G90 S900 M3\n$TC_DP6[1,1]=5\nG41 G1 X5 F100\nG40 X9\nM30\n").empty());
  CHECK(Mill("G17 G90 S900 M3\nMY_TOOL_CHANGE\nG41 G1 X5 F100\nG40 X9\nM30\n").find("NC5010") == std::string::npos);
  CHECK(Mill("G17 G90 S900 M3 M110\nG41 G1 X5 F100\nG40 X9\nM30\n").empty());
  CHECK(Sub("G17 G90\nG41 G1 X5 F100\nG40 X9\nM17\n").empty());
  CHECK(Macro("O1\nG17 G90\nS900 M3\nG41 D#1 G1 X5. F100.\nG40 X9.\nM30\n").find("NC5010") == std::string::npos);
}

TEST_CASE("cutter compensation that is still on") {
  const std::string on = "T1 M6\nD1\nG17 G90 S900 M3\nG41 G1 X5 F100\n";
  CHECK(Mill(on + "M30\n") == "NC5011 5");
  CHECK(Mill(on + "T2 M6\nD1\nG40 X9\nM30\n") == "NC5011 5");
  CHECK(Lathe("T1 D1\nG18 G90 G95 S900 M3\nG42 G1 X5 F0.1\nT2 D1\nG40 X9\nM30\n") == "NC5011 4");
  CHECK(Mill(on + "G18\nG40 X9\nM30\n") == "NC5011 5");
  CHECK(Mill(on + "T2\nG40 X9\nM6\nM30\n").empty());
  CHECK(Mill(on + "IF R1>0\nG40 X9\nENDIF\nM30\n").empty());
  CHECK(Mill(on + "G40 G18 X9\nM30\n").empty());
  CHECK(Mill("T1 M6\nD1\nG17 G90 S900 M3\nG41\nG18\nG1 X5 F100\nG40 X9\nM30\n").empty());
  CHECK(Sub("G17 G90\nG41 D1 G1 X5 F100\nM17\n").empty());
}

TEST_CASE("arcs under different scale factors") {
  const std::string start = "G17 G90 S900 M3 F100\nG0 X0 Y0\n";
  CHECK(Mill(start + "SCALE X2 Y3\nG2 X9 Y9 CR=9\nSCALE\nM30\n") == "NC5012 4");
  CHECK(Mill(start + "SCALE X2 Y2\nAROT Z30\nASCALE X2\nG2 X9 Y9 CR=9\nSCALE\nM30\n") == "NC5012 6");
  CHECK(Mill(start + "SCALE X2 Z2\nIF R1>0\nATRANS X=R1\nENDIF\nG2 X9 Y9 CR=9\nSCALE\nM30\n") == "NC5012 7");
  // Under the frame of the caller, and behind a program that puts it back.
  CHECK(Mill("%_N_MA_MPF\n" + start + "SCALE X2\nUPA\nSCALE\nM30\n%_N_UPA_SPF\nG2 X9 Y9 CR=9\nM17\n") == "NC5012 9");
  CHECK(Mill("%_N_MA_MPF\n" + start + "UPA\nG2 X9 Y9 CR=9\nM30\n%_N_UPA_SPF\nPROC UPA SAVE\nSCALE X2\nM17\n").empty());
  CHECK(Mill("%_N_MA_MPF\n" + start + "UPA\nG2 X9 Y9 CR=9\nM30\n%_N_UPA_SPF\nPROC UPA\nSCALE X2\nM17\n") == "NC5012 5");
  CHECK(Mill(start + "SCALE X2 Y2 Z3\nG2 X9 Y9 CR=9\nSCALE\nM30\n").empty());
  CHECK(Mill(start + "SCALE X-2 Y2\nG2 X9 Y9 CR=9\nSCALE\nM30\n").empty());
  CHECK(Mill(start + "ROT X30\nASCALE X2 Y2\nG2 X9 Y9 CR=9\nROT\nM30\n").empty());
  CHECK(Mill(start + "SCALE X2 Y=R2\nG2 X9 Y9 CR=9\nSCALE\nM30\n").empty());
  CHECK(Mill(start + "IF R1>0\nSCALE X2\nENDIF\nG2 X9 Y9 CR=9\nSCALE\nM30\n").empty());
  // A scale about a point: its arcs by the radius take the larger factor.
  const std::string scaled = "O1\nG17 G90 G21\nS900 M3\nG0 X0. Y0.\n";
  const std::string by_centre = "G2 X9. Y9. I4.5 J4.5 F100.\n";
  CHECK(Macro(scaled + "G51 X0 Y0 I2000 J3.\n" + by_centre + "G50\nM30\n") == "NC5012 6");
  CHECK(Macro(scaled + "G51 X0 Y0 P2000 J3.\n" + by_centre + "G50\nM30\n") == "NC5012 6");
  CHECK(Macro(scaled + "G51 X0 Y0 I2. J-2000\n" + by_centre + "G50\nM30\n").empty());
  CHECK(Macro(scaled + "G51 X0 Y0 I2. J3.\nG2 X9. Y9. R9. F100.\nG50\nM30\n").empty());
  CHECK(Macro(scaled + "G51 X0 Y0 I2. J3.\nG50\n" + by_centre + "M30\n").empty());
  CHECK(Macro(scaled + "G51 X0 Y0 I2. J#101\n" + by_centre + "G50\nM30\n").find("NC5012") == std::string::npos);
  // What a program does that is not here.
  CHECK(Mill(start + "SCALE X2\nUPB\nG2 X9 Y9 CR=9\nSCALE\nM30\n").find("NC5012") == std::string::npos);
}

TEST_CASE("modal calls that are still in force") {
  const std::string call = "S1000 M3 F100\nG0 X0 Y0 Z20\nMCALL CYCLE81(10,0,2,-5)\nX10 Y10\n";
  CHECK(Mill(call + "G0 Z50\nM30\n") == "NC4014 3");
  CHECK(Mill(call + "T5 M6\nM30\n") == "NC4014 3");
  CHECK(Mill(call + "G0 SUPA Z0\nM30\n") == "NC4014 3");
  CHECK(Mill(call + "MCALL\nG0 Z50\nT5 M6\nM30\n").empty());
  CHECK(Mill(call + "X30\nZ12 X40\nM30\n").empty());
  CHECK(Mill(call + "IF R1>0\nMCALL\nENDIF\nG0 Z50\nM30\n").empty());
  CHECK(Mill(call + "M30\n").empty());
  // What a program of the user does behind such a move is its own.
  const std::string own = "%_N_MA_MPF\nMCALL UPA\nX10\n";
  const std::string upa = "M30\n%_N_UPA_SPF\nG91 G1 Z-1 F50\nG90\nM17\n";
  CHECK(Mill(own + "Z5\nMCALL\n" + upa).empty());
  CHECK(Mill(own + "T5 M6\n" + upa) == "NC4014 2");
}

}  // namespace ncport::check
