#include "ir/builder.h"

#include <doctest/doctest.h>

#include <string>

#include "ir/dump.h"
#include "ir/structure.h"
#include "ir/verify.h"

using namespace ncport;
using namespace ncport::ir;

namespace {

std::string TextOf(const Module& module) {
  TextBuffer out;
  Dump(module, out);
  return std::string(out.View());
}

}  // namespace

TEST_CASE("ir builder: a program of every comfortable form") {
  Module m;
  ExprBuilder e(m);
  const SpaceId r = AddSpace(m, "R", 0, 299);
  const SystemId position = AddSystem(m, "$P_EP", SystemKind::kProgrammedPosition);
  const FileId file = AddFile(m, "p.mpf");
  CHECK(AddFile(m, "p.mpf") == file);
  ProgramBuilder sub(m, "SUB", ProgramKind::kSub, file);
  const VariableId a = sub.Parameter("A");
  sub.Parameter("B", Type::kInt, true);
  const std::uint32_t sizes[] = {2, 3};
  const VariableId list = sub.Local("LIST", Type::kReal, sizes);
  sub.Block(1).Add(WordOp::kHeader, {}, 0, sub.Id().value).Finish();
  sub.Block().Assign(e.Element(list, {e.Number("0", Type::kInt), e.Number("1", Type::kInt)}), e.Variable(a)).Finish();
  sub.Block().Assign(e.CellAt(r, e.Cell(r, 1)), e.System(position, {e.AxisName(2)})).Finish();
  sub.Finish();
  ProgramBuilder main(m, "MAIN", ProgramKind::kMain, file);
  BlockBuilder first = main.Block(10);
  first.Number(10).Label("L").Skip(0).Indent(2).Motion(Motion::kRapid).Axis(0, e.Number("1.50"), ValueMode::kAbsolute);
  first.Last().spelling = AddSpelling(m, "X", "r");
  first.Comment("note").Comment("before", CommentPlace::kBeforeWord, 1).Finish();
  main.Block().For(e.Cell(r, 2), e.Number("1"), e.Number("9"), e.Literal(0.25)).Finish();
  main.Block().Call(sub.Id(), {e.Vacant(), ExprId{}}, e.Number("2")).Finish();
  main.Block().Add(WordOp::kEndFor).Finish();
  main.Block().RepeatPart("L", "", {}).RepeatPart("L", "M", e.Number("3")).Finish();
  main.Block()
      .Jump("L", Search::kBackward, e.Binary(ExprOp::kLess, e.Cell(r, 1), e.Spelled("1EX1", 10), Expr::kTolerance))
      .Finish();
  main.Block().JumpToNumber(10, Search::kForward).Finish();
  main.Block()
      .Add(WordOp::kMessage, e.Binary(ExprOp::kConcat, e.Text("a"), e.Convert(e.Name("N"), Type::kString)))
      .Finish();
  main.Block().Axis(1, e.Function(Function::kSin, {e.Unary(ExprOp::kNegate, e.Number(".5"))})).Finish();
  main.Finish();
  diag::Sink sink;
  BuildStructure(m, main.Id(), 0, sink);
  CHECK(sink.Empty());
  CHECK(FindViolation(m) == std::nullopt);
  CHECK(TextOf(m) ==
        "ncport-ir 1\n"
        "file p.mpf\n"
        "spelling X rule r\n"
        "space R 0..299 real kept all zero\n"
        "system $P_EP programmed-position real\n"
        "program SUB sub @p.mpf:0\n"
        "  param A real parameter at @p.mpf:0 0+0\n"
        "  param B int parameter ref at @p.mpf:0 0+0\n"
        "  var LIST real local dims 2 3 at @p.mpf:0 0+0\n"
        "  @p.mpf:1 : header SUB\n"
        "  @p.mpf:2 : assign element:real LIST(0:int, 1:int) = variable:real A\n"
        "  @p.mpf:3 : assign cell-at:real R[cell:real R[1]] = system:real $P_EP(axis-name:axis Z)\n"
        "program MAIN main @p.mpf:0\n"
        "  @p.mpf:10 indent 2 skip 0 N10 label L : motion rapid; axis X absolute = 1.50:real {as X}\n"
        "    ; end-of-block \"note\"\n"
        "    ; before-word word 1 \"before\"\n"
        "  @p.mpf:11 link +2 : for cell:real R[2] to 9:real step literal(0.25, computed):real = 1:real\n"
        "  @p.mpf:12 : call name SUB brackets calls SUB (0: vacant:number, 1: -) passes 2:real\n"
        "  @p.mpf:13 link -2 : end-for\n"
        "  @p.mpf:14 : repeat-part first label L; repeat-part first label L last label M = 3:real\n"
        "  @p.mpf:15 : jump backward label L = lt!tolerance:bool(cell:real R[1], literal(10, as \"1EX1\"):real)\n"
        "  @p.mpf:16 : jump forward number 10\n"
        "  @p.mpf:17 : message = concat:string(\"a\":string, convert!implicit:string(name N()))\n"
        "  @p.mpf:18 : axis Y = call:real sin(negate:real(.5:real))\n");
}

TEST_CASE("ir builder: origins tell how a copy came about") {
  Module m;
  const FileId file = AddFile(m, "p.mpf");
  const OriginId call = AddOrigin(m, file, 3);
  const OriginId copy = AddOrigin(m, file, 20, call, 2, "unroll");
  ProgramBuilder p(m, "P");
  BlockBuilder(m, copy).Flags(Block::kAdded).Finish();
  p.Finish();
  CHECK(TextOf(m) == "ncport-ir 1\nfile p.mpf\nprogram P main\n  @p.mpf:20 turn 2 pass unroll via @p.mpf:3 added\n");
}

TEST_CASE("ir builder: equal spellings share a row") {
  Module m;
  const auto g1 = AddSpelling(m, "G1", "a");
  CHECK(g1 == 1);
  CHECK(AddSpelling(m, "G1", "b") == 2);
  CHECK(AddSpelling(m, "G1", "a") == g1);
}
