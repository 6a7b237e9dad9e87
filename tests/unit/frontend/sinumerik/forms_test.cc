// One test a form: what a block becomes in the IR.
#include <doctest/doctest.h>

#include "ir/modes.h"
#include "read_helper.h"

namespace ncport::frontend::sinumerik {

namespace {

using ir::ExprOp;
using ir::WordOp;

std::string_view TextOf(const ReadResult& result, const ir::Word& word) {
  return result.module.View(result.module.spellings[word.spelling].text);
}

}  // namespace

TEST_CASE("codes carry group meaning, spelling and rule") {
  ReadResult result;
  ReadInto(result, "N005 G01 G641 BRISK\n");
  CHECK(result.Findings().empty());
  CHECK(result.BlockAt(1).number == 5);
  CHECK(result.BlockAt(1).number_digits == 3);
  CHECK(result.WordAt(1, 0).op == WordOp::kMotion);
  CHECK(result.WordAt(1, 0).digits == 2);
  CHECK(result.WordAt(1, 1).op == WordOp::kPathMode);
  CHECK(TextOf(result, result.WordAt(1, 1)) == "G641");
  CHECK(result.WordAt(1, 2).op == WordOp::kInert);
  CHECK(result.module.View(result.module.spellings[result.WordAt(1, 0).spelling].rule) == "sinumerik-8.2");
}

TEST_CASE("two words of one group, an address twice") {
  ReadResult result;
  ReadInto(result, "G0 G1 X1\nX1 X2\nF1 F=2\nG1 M3 M8\n");
  CHECK(result.Findings() ==
        "NC1013 1:4 G0 and G1 exclude each other in one block\n"
        "NC1012 2:4 address X2 stands twice in one block\n"
        "NC1012 3:4 address F stands twice in one block\n");
  CHECK((result.BlockAt(1).flags & ir::Block::kRefused) != 0);
  CHECK(result.WordAt(1).op == WordOp::kVerbatim);
  CHECK(result.module.View(StringId{std::size_t{result.WordAt(1).extra}}) == "G0 G1 X1");
  CHECK((result.BlockAt(4).flags & ir::Block::kRefused) == 0);
}

TEST_CASE("centre words are steps unless AC says otherwise") {
  ReadResult result;
  ReadInto(result, "G2 X1 Y1 I-5 J=AC(3)\nG2 I=IC(2)\n");
  CHECK(result.WordAt(1, 3).mode == ir::ValueMode::kStep);
  CHECK(result.WordAt(1, 4).mode == ir::ValueMode::kAbsolute);
  CHECK(result.WordAt(2, 1).mode == ir::ValueMode::kIncremental);
}

TEST_CASE("value modes stand where their address takes them") {
  ReadResult result;
  ReadInto(result, "A=DC(90) X=IC(-1) Y=DAC(3)\nRP=IC(3)\nS=AC(3)\nM=QU(5)\n");
  CHECK(result.WordAt(1, 0).mode == ir::ValueMode::kShortest);
  CHECK(result.WordAt(1, 2).mode == ir::ValueMode::kAbsoluteDiameter);
  CHECK(result.Findings() == "NC1002 2:4 unexpected IC\nNC1002 3:3 unexpected AC\n");
  CHECK(result.WordAt(4).op == WordOp::kComputedM);
  CHECK(result.WordAt(4).mode == ir::ValueMode::kQuick);
}

TEST_CASE("G4 turns F and S into a dwell") {
  ReadResult result;
  ReadInto(result, "G4 F2.5\nG4 S3\nG4 X1\nG4\n");
  CHECK(result.WordAt(1, 1).op == WordOp::kDwellSeconds);
  CHECK(result.WordAt(2, 1).op == WordOp::kDwellRevolutions);
  CHECK(result.Findings() == "NC1022 3:1 G4 must stand alone in its block\nNC1017 4:1 G4 has no value\n");
}

TEST_CASE("M words by number, by spindle, by value") {
  ReadResult result;
  ReadInto(result, "M3 M2=4 M41 M08\nM=R1\nM5=DIR_V\n", {.resolve = false});
  CHECK(result.WordAt(1, 0).op == WordOp::kSpindle);
  CHECK(result.WordAt(1, 1).op == WordOp::kSpindle);
  CHECK(result.WordAt(1, 1).index == 2);
  CHECK(result.WordAt(1, 1).extra == static_cast<std::uint32_t>(ir::SpindleState::kCcw));
  CHECK(result.WordAt(1, 2).op == WordOp::kAux);
  CHECK(result.ExprOf(result.WordAt(1, 2).value).number == 41);
  CHECK(result.ExprOf(result.WordAt(1, 3).value).number == 8);
  CHECK(result.WordAt(2).op == WordOp::kComputedM);
  CHECK(result.WordAt(3).index == 5);
  CHECK(result.Findings().empty());
}

TEST_CASE("comparisons bind weakest, NOT binds tightest") {
  ReadResult result;
  ReadInto(result, "R1=R2==1 AND R3==1\nR1=NOT R1==5\nR1=-R2*3\n");
  const ir::Expr& compare = result.ExprOf(result.WordAt(1).value);
  CHECK(compare.op == ExprOp::kEqual);  // ((R2==(1 AND R3))==1)
  CHECK(result.ExprOf(ir::ExprId{std::size_t{compare.a}}).op == ExprOp::kEqual);
  CHECK((compare.flags & ir::Expr::kTolerance) != 0);
  const ir::Expr& negated = result.ExprOf(result.WordAt(2).value);
  CHECK(negated.op == ExprOp::kEqual);  // (NOT R1)==5
  CHECK(result.ExprOf(ir::ExprId{std::size_t{negated.a}}).op == ExprOp::kNot);
  const ir::Expr& product = result.ExprOf(result.WordAt(3).value);
  CHECK(product.op == ExprOp::kMultiply);  // (-R2)*3
}

TEST_CASE("unary << makes a text") {
  ReadResult result;
  ReadInto(result, "DEF STRING[20] TX_T\nTX_T=<<(R1+1)\nTX_T=<<R1<<\"x\"\n");
  CHECK(result.Findings().empty());
  CHECK(result.ExprOf(result.WordAt(2).value).op == ExprOp::kFunction);
  CHECK(result.ExprOf(result.WordAt(3).value).op == ExprOp::kConcat);
}

TEST_CASE("digits are kept as written") {
  ReadResult result;
  ReadInto(result, "X-010.50 Y+3 Z1.5EX-3 A'H1F'\nR1='H1F'\n", {.resolve = false});
  CHECK(result.Findings() == "NC1003 1:24 expected =, found 'H1F'\n");
  ReadResult good;
  ReadInto(good, "X-010.50 Y+3 Z1.5EX-3\n");
  const ir::Expr& x = good.ExprOf(good.WordAt(1, 0).value);
  CHECK(x.format.int_digits == 3);
  CHECK(x.format.decimals == 2);
  CHECK((good.ExprOf(good.WordAt(1, 1).value).format.flags & ir::NumberFormat::kPlusSign) != 0);
  const ir::Expr& z = good.ExprOf(good.WordAt(1, 2).value);
  CHECK(good.module.View(good.module.literal_texts[z.count]) == "1.5EX-3");
}

TEST_CASE("jumps: one or several, to labels, numbers, texts") {
  ReadResult result;
  ReadInto(result, "MARK1: IF R1==0 GOTOF MARK1 IF R1==1 GOTOB N20\nN20 GOTOC \"LB\"<<R1\nGOTO :30\nR1=1 GOTOS\n");
  CHECK(result.Findings().empty());
  CHECK(result.module.View(result.BlockAt(1).label) == "MARK1");
  CHECK(result.BlockAt(1).words.count == 2);
  const ir::Jump& second = result.module.jumps[result.WordAt(1, 1).Extra<ir::JumpId>()];
  CHECK(second.target.kind == ir::TargetKind::kNumber);
  CHECK(second.search == ir::Search::kBackward);
  const ir::Jump& third = result.module.jumps[result.WordAt(2).Extra<ir::JumpId>()];
  CHECK(third.quiet);
  CHECK(third.target.kind == ir::TargetKind::kExpression);
  CHECK(result.module.jumps[result.WordAt(3).Extra<ir::JumpId>()].target.kind == ir::TargetKind::kMainNumber);
  CHECK(result.module.jumps[result.WordAt(4, 1).Extra<ir::JumpId>()].target.kind == ir::TargetKind::kProgramStart);
}

TEST_CASE("a text variable as jump target") {
  ReadResult result;
  ReadInto(result, "DEF STRING[10] WHERE_TO=\"MARK1\"\nGOTOF WHERE_TO\nMARK1: M30\n");
  CHECK(result.module.jumps[result.WordAt(2).Extra<ir::JumpId>()].target.kind == ir::TargetKind::kExpression);
}

TEST_CASE("CASE with negative and hexadecimal constants") {
  ReadResult result;
  ReadInto(result, "CASE R1 OF-1 GOTO LBL1-2 GOTO LBL2 'HA' GOTOF LBL1 DEFAULT GOTOB LBL2\nLBL1:\nLBL2:\n");
  CHECK(result.Findings().empty());
  const ir::Switch& record = result.module.switches[result.WordAt(1).Extra<ir::SwitchId>()];
  CHECK(record.arm_count == 4);
  CHECK_FALSE(result.module.switch_arms[record.first_arm + 3].value.Valid());
}

TEST_CASE("structure marks are linked") {
  ReadResult result;
  ReadInto(result, "IF(R1==1)\nR2=1\nELSE\nLOOP\nENDLOOP\nENDIF\nFOR R1=1 TO 3\nENDFOR\nREPEAT\nUNTIL R1>3\n");
  CHECK(result.Findings().empty());
  CHECK(result.BlockAt(1).link.Valid());
  CHECK(result.WordAt(7).op == WordOp::kFor);
}

TEST_CASE("a refused mark keeps its place in the structure") {
  ReadResult result;
  ReadInto(result, "IF ?\nR1=1\nENDIF\nM30\n");
  CHECK(result.Findings() == "NC1004 1:4 character ? has no meaning here\n");
  CHECK(result.WordAt(1).index == static_cast<std::uint8_t>(WordOp::kIf));
}

TEST_CASE("calls in all forms") {
  ReadResult result;
  ReadInto(result,
           "SUB_A\nSUB_A(1,,\"x\",) P=R1\nL010 P3\nMCALL SUB_A(1)\nMCALL\nCALL \"SUB_A\"\nCALL \"L\"<<R1\n"
           "CALL BLOCK \"N10\" TO MARK2\nPCALL /_N_WKS_DIR/_N_W_WPD/SUB_A(1,2)\nEXTCALL(\"SUB_A\")\n"
           "REPEAT MARK1 MARK2 P=2\nREPEATB MARK1\n",
           {.resolve = false});
  CHECK(result.Findings().empty());
  const auto call = [&](std::uint32_t line) { return result.module.calls[result.WordAt(line).Extra<ir::CallId>()]; };
  CHECK_FALSE(call(1).has_brackets);
  CHECK(call(2).args.count == 4);
  CHECK_FALSE(result.module.args[call(2).args[1]].value.Valid());
  CHECK(call(2).passes.Valid());
  CHECK(result.module.View(call(3).name) == "L010");
  CHECK(result.WordAt(4).op == WordOp::kModalCall);
  CHECK(result.WordAt(5).extra == ir::CallId::kNone);
  CHECK(call(7).form == ir::CallForm::kText);
  CHECK(call(8).form == ir::CallForm::kBlockRange);
  CHECK(call(8).to.kind == ir::TargetKind::kLabel);
  CHECK(result.module.View(call(9).name) == "/_N_WKS_DIR/_N_W_WPD/SUB_A");
  CHECK(call(10).form == ir::CallForm::kExternal);
  CHECK(result.module.parts[result.WordAt(11).Extra<ir::PartId>()].has_last);
  CHECK(result.module.parts[result.WordAt(12).Extra<ir::PartId>()].single);
}

TEST_CASE("a call stands alone") {
  ReadResult result;
  ReadInto(result, "G0 X1 SUB_A\n");
  CHECK(result.Findings() == "NC1022 1:7 SUB_A must stand alone in its block\n");
}

TEST_CASE("RET to the caller, M17, program end") {
  ReadResult result;
  ReadInto(result, "RET\nRET(\"LABEL\")\nM17\nM30\nRET(\"A\",1)\n");
  CHECK(result.WordAt(1).index == static_cast<std::uint8_t>(ir::ReturnKind::kPlain));
  CHECK(result.WordAt(2).index == static_cast<std::uint8_t>(ir::ReturnKind::kToCaller));
  CHECK(result.WordAt(3).index == static_cast<std::uint8_t>(ir::ReturnKind::kAuxiliary));
  CHECK(result.WordAt(4).extra == 30);
  CHECK(result.Findings() == "NC1019 5:1 RET is a word of the control that ncport does not translate\n");
}

TEST_CASE("alarms by number range") {
  ReadResult result;
  ReadInto(result, "SETAL(65000)\nSETAL(62100,\"x\")\nSETAL(67001)\nSETAL(61001)\nSETAL(R1)\n");
  for (const std::uint32_t line : {1U, 4U, 5U}) CHECK(result.WordAt(line).index == 0);
  for (const std::uint32_t line : {2U, 3U}) CHECK(result.WordAt(line).index == 1);
}

TEST_CASE("definitions in the full form") {
  ReadResult result;
  ReadInto(result,
           "DEF NCK SYNRW INIPO PHU 5 LLI -100 ULI +100 REAL GL_A=3, GL_B[2,3]=SET(1,,3)\n"
           "DEF CHAN STRING[20] GL_S[4]\n"
           "DEF AXIS GL_X=(X)\n"
           "DEF INT GL_I[4]=REP(7,2), GL_J[2]=(1,2)\n",
           {.name = "_N_MGUD_DEF.DEF"});
  CHECK(result.Findings().empty());
  const auto& variables = result.module.variables;
  REQUIRE(variables.Size() == 6);
  CHECK(variables[ir::VariableId{0U}].scope == ir::Scope::kGlobal);
  CHECK(variables[ir::VariableId{0U}].lower_limit.Valid());
  CHECK(variables[ir::VariableId{1U}].dimensions[1] == 3);
  CHECK(variables[ir::VariableId{1U}].definition == 1);
  CHECK(variables[ir::VariableId{2U}].scope == ir::Scope::kChannel);
  CHECK(variables[ir::VariableId{2U}].string_length == 20);
  CHECK(variables[ir::VariableId{3U}].type == ir::Type::kAxis);
  CHECK(TextOf(result, result.WordAt(1)) == "SYNRW INIPO PHU 5");
}

TEST_CASE("PROC with attributes, references, arrays, defaults") {
  ReadResult result;
  ReadInto(result,
           "; head\nN10 PROC RING_1(REAL AA_A=5, VAR INT BB_B[3], STRING[10] CC_C, AXIS DD_D) SAVE DISPLOF ; c\nRET\n",
           {.name = "OTHER.SPF"});
  CHECK(result.Findings().empty());
  const ir::Program& program = result.module.programs[ir::ProgramId{0U}];
  CHECK(result.module.View(program.name) == "RING_1");
  CHECK(program.saves_modal_state);
  CHECK(program.parameters.count == 4);
  CHECK(result.module.variables[program.parameters[1]].by_reference);
  CHECK(result.module.variables[program.parameters[0]].initial.Valid());
}

TEST_CASE("definitions behind executable blocks") {
  ReadResult result;
  ReadInto(result, "G1\nDEF INT AA_A\n");
  CHECK(result.Findings() == "NC1024 2:9 AA_A stands behind the first executable block\n");
}

TEST_CASE("macros stand for their text") {
  ReadResult result;
  ReadInto(result, "DEFINE UP_5 AS G0 Z=R5\nDEFINE M06 AS L6\nUP_5+1\nM06\n", {.resolve = false});
  CHECK(result.Findings().empty());
  CHECK(TextOf(result, result.WordAt(1)) == "DEFINE UP_5 AS G0 Z=R5");
  CHECK(result.WordAt(3, 1).op == WordOp::kAxis);
  CHECK(result.ExprOf(result.WordAt(3, 1).value).op == ExprOp::kAdd);
  CHECK(result.WordAt(4).op == WordOp::kCall);
}

TEST_CASE("words the control knows and ncport does not are named") {
  ReadResult result;
  ReadInto(
      result,
      "ASPLINE X1\nG291\nG65 P1000 A1.\n(comment)\nG290\nX1\nN5 WHENEVER $A_IN[1] DO OVR=0\n$P_PFRAME=CTRANS(X,1)\n");
  CHECK(result.Findings() ==
        "NC1019 1:1 ASPLINE is a word of the control that ncport does not translate\n"
        "NC1023 2:1 the text behind G291 is in another language\n"
        "NC1019 7:4 WHENEVER is a word of the control that ncport does not translate\n"
        "NC1019 8:11 CTRANS is a word of the control that ncport does not translate\n");
  CHECK(result.WordAt(6).op == WordOp::kAxis);
}

TEST_CASE("programs of a punch tape file") {
  ReadResult result;
  ReadInto(result, "%_N_MAIN_MPF\n;$PATH=/_N_MPF_DIR\nL10\nM30\n%_N_L10_SPF\nM17\n%\n");
  CHECK(result.Findings().empty());
  REQUIRE(result.module.programs.Size() == 2);
  CHECK(result.module.View(result.module.programs[ir::ProgramId{1U}].name) == "L10");
  CHECK(result.module.programs[ir::ProgramId{0U}].kind == ir::ProgramKind::kMain);
  CHECK(result.WordAt(1).op == WordOp::kFileMark);
  CHECK(result.module.calls[ir::CallId{0U}].program == ir::ProgramId{1U});
}

TEST_CASE("comments, blank lines and indents are kept") {
  ReadResult result;
  ReadInto(result, "; head\n\n   G1 X1   ; tail  \n");
  CHECK(result.BlockAt(3).indent == 3);
  const ir::Comment& tail = result.module.comments[result.BlockAt(3).comments[0]];
  CHECK(result.module.View(tail.text) == " tail");
  CHECK(tail.gap == 3);
  CHECK(result.BlockAt(2).words.Empty());
}

TEST_CASE("words without effect keep their text") {
  ReadResult result;
  ReadInto(result, "GROUP_BEGIN(0,\"drill\",0,0)\nACC[X]=80\nADIS=0.5\nSBLOF\nWORKPIECE(,\"\",,\"BOX\",240,0,-10)\n");
  CHECK(result.Findings().empty());
  CHECK(TextOf(result, result.WordAt(1)) == "GROUP_BEGIN(0,\"drill\",0,0)");
  CHECK(TextOf(result, result.WordAt(2)) == "ACC[X]=80");
  CHECK(result.WordAt(3).value.Valid());
  CHECK(result.module.calls[result.WordAt(5).Extra<ir::CallId>()].args.count == 7);
}

TEST_CASE("limits end in findings") {
  ReadResult result;
  std::string long_block = "R1=1";
  for (int i = 0; i < 600; ++i) long_block += "+1";
  ReadInto(result, long_block + "\nX=" + std::string(70, '(') + "1\nX1\n");
  CHECK(result.sink.All().size() == 2);
  CHECK(result.WordAt(3).op == WordOp::kAxis);
}

TEST_CASE("what was meant: a reserved name, a refused opener, the end of the block") {
  ReadResult result;
  ReadInto(result, "DEF INT VAR=1\nWHILE R1 LT R2\nR1=\nCASE R1 OF\n");
  CHECK(result.Findings() ==
        "NC2008 1:9 VAR is a word of the language and cannot be a name\n"
        "NC1002 2:10 unexpected LT\n"
        "NC1002 3:4 unexpected end of the block\n"
        "NC1002 4:11 unexpected end of the block\n");
}

TEST_CASE("SETMS leaves the first spindle the master") {
  ReadResult result;
  ReadInto(result, "SETMS\nSETMS(1)\nSETMS(2)\n");
  CHECK(result.Findings() == "NC1019 3:1 SETMS is a word of the control that ncport does not translate\n");
  CHECK(TextOf(result, result.WordAt(2)) == "SETMS(1)");
}

TEST_CASE("CALL of a part of an L program") {
  ReadResult result;
  ReadInto(result, "CALL L350 BLOCK N20 TO \"N\"<<50\n", {.resolve = false});
  CHECK(result.Findings().empty());
  const ir::Call& call = result.module.calls[result.WordAt(1).Extra<ir::CallId>()];
  CHECK(result.module.View(call.name) == "L350");
  CHECK(call.from.kind == ir::TargetKind::kNumber);
}

}  // namespace ncport::frontend::sinumerik
