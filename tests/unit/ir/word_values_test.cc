#include "ir/word_values.h"

#include <set>

#include "ir/transform/linear_form.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir {
namespace {

using test::WithCells;
using transform::VisitReads;
using Numbers = std::set<std::uint32_t>;

struct Cells {
  Numbers values, places, references;
};

/// Numbers of the cells of R that the words of the first program name, and of its variables by their order.
Cells Of(std::string_view blocks) {
  diag::Sink sink;
  Result<Module> parsed = ParseDump(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n  var A real local\n"
      "  var B real local\n  var L real local dims 4 initial cell:real R[90] initial-list (cell:real R[91], -)\n" +
          WithCells(blocks) +
          "program SUB sub @m:20\n  param P real parameter\n  param Q real parameter ref\n  @m:21 : axis X = 1\n",
      sink);
  REQUIRE_MESSAGE(parsed.Ok(), (sink.Empty() ? "" : sink.All().front().message));
  const Module& module = parsed.Value();
  Cells cells;
  const auto number = [&](ExprId id) {
    return module.exprs[id].op == ExprOp::kCell ? module.exprs[id].b : module.exprs[id].a;
  };
  for (const BlockId block : module.programs[ProgramId{0U}].blocks) {
    for (const WordId id : module.blocks[block].words) {
      const Word& word = module.words[id];
      VisitValues(module, word, [&](ExprId value) {
        VisitReads(module, value, [&](ExprId read) {
          if (module.exprs[read].op == ExprOp::kCell) cells.values.insert(number(read));
        });
      });
      VisitPlaces(module, word, [&](ExprId place) { cells.places.insert(number(place)); });
      VisitReferences(module, word, [&](ExprId place) { cells.references.insert(number(place)); });
    }
  }
  return cells;
}

TEST_CASE("values stand in every kind of word; a place gives its indices only") {
  const Cells cells =
      Of("  @m:1 : axis X = add(R[1], call sin(R[2])); axis-computed call axis-from-text(R[3]) = R[4]\n"
         "  @m:2 : assign R[50] = R[5]; assign cell-at R[R[6]] = 1; assign element L(R[7]) = 1\n"
         "  @m:3 : assign-list place element L(R[8]) (R[9], -, R[10]) repeat count R[11]\n"
         "  @m:4 : message R[12] = R[13]; alarm stops R[14] = R[15]; print = R[16]\n"
         "  @m:5 : jump forward expression R[17] = R[18]\n"
         "  @m:6 : switch (R[19] => forward expression R[20]) = R[21]\n"
         "  @m:7 : call text - by R[22] (0: R[23], 1: -) passes R[24]; modal-call name SUB (0: R[25]); modal-call\n"
         "  @m:8 : call block-range - from expression R[26] to expression R[27]\n"
         "  @m:9 : repeat-part first expression R[28] last expression R[29] = R[30]\n"
         "  @m:10 link +1 : for R[51] to R[31] step R[32] = R[33]\n"
         "  @m:11 link -1 : end-for\n"
         "  @m:12 : data-setting name - (0 L: R[34]); workpiece name - (0: R[35]); when = R[36]\n");
  Numbers expected;
  for (std::uint32_t n = 1; n <= 36; ++n) expected.insert(n);
  CHECK(cells.values == expected);
  CHECK(cells.places.contains(50));
  CHECK(cells.places.contains(51));
}

TEST_CASE("a definition takes its start values") {
  CHECK(Of("  @m:1 : define L\n").values == Numbers{90, 91});
  CHECK(Of("  @m:1 : define A\n").values.empty());
}

TEST_CASE("a call may write the arguments of its parameters by reference, and all variables if it is not known") {
  CHECK(Of("  @m:1 : call name SUB calls SUB (0: variable A, 1: variable B)\n").references == Numbers{1});
  CHECK(Of("  @m:1 : modal-call name SUB calls SUB (0: variable A, 1: variable B)\n").references == Numbers{1});
  CHECK(Of("  @m:1 : call name SUB (0: variable A, 1: variable B)\n").references == Numbers{0, 1});
  CHECK(Of("  @m:1 : call name SUB calls SUB (0: variable A)\n").references.empty());
  CHECK(Of("  @m:1 : call name SUB calls SUB (0: variable A, 1: -)\n").references.empty());
}

}  // namespace
}  // namespace ncport::ir
