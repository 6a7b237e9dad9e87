#include "ir/transform/rewrite_exprs.h"

#include <vector>

#include "ir/builder.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

constexpr std::string_view kHead =
    "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nspace Q 0..99 real kept all zero\n"
    "system $P_EP programmed-position real\n";

/// The whole dump after cells R[n] became Q[n] in the first program.
std::string Renamed(std::string_view text) {
  diag::Sink sink;
  Result<Module> module = ParseDump(std::string(kHead) + std::string(text), sink);
  REQUIRE_MESSAGE(module.Ok(), (sink.Empty() ? "" : sink.All().front().message));
  RewriteProgram(module.Value(), ProgramId{0U}, [](Module& m, ExprId id) {
    const Expr expr = m.exprs[id];
    if ((expr.op != ExprOp::kCell || expr.a != 0) && (expr.op != ExprOp::kCellAt || expr.b != 0)) return id;
    Expr made = expr;
    (expr.op == ExprOp::kCell ? made.a : made.b) = 1;
    return m.AddExpr(made, m.expr_places.Of(id));
  });
  CHECK(FindViolation(module.Value()).value_or("") == "");
  TextBuffer out;
  Dump(module.Value(), out, {});
  return std::string(out.View()).substr(kHead.size());
}

/// `text` with every cell of R renamed.
std::string Expected(std::string_view text) {
  return std::regex_replace(std::string(text), std::regex(" R\\["), " Q[");
}

TEST_CASE("expressions are found in every kind of word and record of the program") {
  const std::string_view text = R"(program M main @m:0
  param P real parameter initial cell R[1]
  var N int local lower cell R[2] upper cell R[3]
  var L real local dims 4 initial-list (cell R[4], -, cell R[5])
  @m:1 : axis X = add(cell R[6], call sin(cell R[7])); axis-computed call axis-from-text(cell R[8]) = cell R[9]
  @m:2 : assign cell R[10] = cell R[11]; assign cell-at R[cell R[12]] = negate(cell R[13]); assign element L(cell R[14]) = system $P_EP(cell R[15])
  @m:3 : assign-list place element L(cell R[16]) (cell R[17], -, cell R[18]) repeat count cell R[19]
  @m:4 : message cell R[20] = cell R[21]; alarm stops cell R[22] = cell R[23]; print = cell R[24]
  @m:5 : jump forward expression cell R[25] = lt(cell R[26], cell R[27])
  @m:6 : switch (cell R[28] => forward expression cell R[29], - => forward label A) = cell R[30]
  @m:7 : call text - by cell R[31] (0: cell R[32], 1: -, 2: cell R[33]) passes cell R[34]; modal-call name SUB (0: cell R[35])
  @m:8 : call block-range - same-level from expression cell R[36] to expression cell R[37]
  @m:9 : repeat-part first expression cell R[38] last expression cell R[39] = cell R[40]
  @m:10 link +1 : for variable N to cell R[41] step cell R[42] = cell R[43]
  @m:11 link -1 : end-for
  @m:12 : data-setting name - (0 L: cell R[44]); workpiece name - (0: cell R[45])
  @m:13 : return to-caller = cell R[46]; dwell-seconds = group(cell R[47])
  @m:14 label A : cycle-value level = cell R[48]; when = cell R[49]; feed = cell R[50]
)";
  CHECK(Renamed(text) == Expected(text));
}

TEST_CASE("other programs, and variables of other programs, stay as they are") {
  const std::string written = Renamed(
      "program M main @m:0\n  @m:1 : axis X = cell R[1]\n"
      "program S sub @m:2\n  var N int local lower cell R[2]\n  @m:3 : axis X = cell R[3]\n");
  CHECK(written ==
        "program M main @m:0\n  @m:1 : axis X = cell Q[1]\n"
        "program S sub @m:2\n  var N int local lower cell R[2]\n  @m:3 : axis X = cell R[3]\n");
}

TEST_CASE("a rewrite that changes nothing makes no node, in lists too") {
  Module module;
  ExprBuilder make(module);
  const ExprId root = make.Binary(ExprOp::kAdd, make.Function(Function::kMinimum, {make.Number("1"), make.Number("2")}),
                                  make.Number("3"));
  const std::size_t nodes = module.exprs.Size(), items = module.expr_items.size();
  CHECK(RewriteExpr(module, root, [](Module&, ExprId id) { return id; }) == root);
  CHECK(module.exprs.Size() == nodes);
  CHECK(module.expr_items.size() == items);
  CHECK_FALSE(RewriteExpr(module, {}, [](Module&, ExprId id) { return id; }).Valid());
}

TEST_CASE("bottom up: a node sees its operands as they were made; flags, types and places stay") {
  Module module;
  ExprBuilder make(module);
  const ExprId inner = make.Number("1");
  const ExprId root = make.Binary(ExprOp::kLess, inner, make.Number("2"), Expr::kTolerance);
  module.expr_places.Set(root, {3, 5});
  std::vector<ExprOp> seen;
  const ExprId made = RewriteExpr(module, root, [&](Module& m, ExprId id) {
    seen.push_back(m.exprs[id].op);
    if (id == inner) return ExprBuilder(m).Literal(7);
    if (m.exprs[id].op == ExprOp::kLess) CHECK(m.exprs[ExprId{m.exprs[id].a}].number == 7);
    return id;
  });
  CHECK(seen == std::vector<ExprOp>{ExprOp::kLiteral, ExprOp::kLiteral, ExprOp::kLess});
  CHECK(made != root);
  CHECK(module.exprs[made].flags == Expr::kTolerance);
  CHECK(module.exprs[made].type == Type::kBool);
  CHECK(module.expr_places.Of(made).begin == 3);
  CHECK(module.expr_places.Of(made).length == 5);
  CHECK(module.exprs[root].a == inner.value);  // the old node is what it was: others may hold it
  CHECK(made.value > module.exprs[made].a);
}

TEST_CASE("a list with one changed entry is made anew behind the old one") {
  Module module;
  ExprBuilder make(module);
  const ExprId two = make.Number("2");
  const ExprId root = make.Function(Function::kMinimum, {make.Number("1"), two});
  const ExprId made =
      RewriteExpr(module, root, [&](Module& m, ExprId id) { return id == two ? ExprBuilder(m).Literal(9) : id; });
  CHECK(module.exprs[module.Item(module.exprs[root].b + 1)].number == 2);
  CHECK(module.exprs[module.Item(module.exprs[made].b)].number == 1);
  CHECK(module.exprs[module.Item(module.exprs[made].b + 1)].number == 9);
}

}  // namespace
}  // namespace ncport::ir::transform
