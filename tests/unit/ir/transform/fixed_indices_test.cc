#include "ir/transform/fixed_indices.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Fixed(const std::string& blocks) {
  diag::Sink sink;
  return test::After("ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nprogram M main @m:0\n" + blocks, sink,
                     [&](Module& module, diag::Sink&) {
                       FixIndices(module, Machine{});
                       return true;
                     });
}

TEST_CASE("an index of one value on all ways is a cell of its own, rounded as the control rounds it") {
  const std::string text = Fixed(
      "  @m:1 : assign cell:real R[1] = 10:real\n"
      "  @m:2 : assign cell-at:real R[cell:real R[1]] = 3.5:real\n"
      "  @m:3 : assign cell-at:real R[1.6:real] = cell-at:real R[add:real(cell:real R[1], 1:int)]\n");
  CHECK(text.find("cell-at") == std::string::npos);
  CHECK(text.find("assign cell:real R[10] = 3.5") != std::string::npos);
  CHECK(text.find("assign cell:real R[2] = cell:real R[11]") != std::string::npos);
}

TEST_CASE("an index that differs between ways, or that its own block may change, stays") {
  for (const std::string_view blocks :
       {"  @m:1 : assign cell:real R[1] = 10:real\n"
        "  @m:2 label L : assign cell-at:real R[cell:real R[1]] = 3.5:real\n"
        "  @m:3 : assign cell:real R[1] = add:real(cell:real R[1], 1:int)\n"
        "  @m:4 : jump backward label L = lt:bool(cell:real R[1], 20:real)\n",
        "  @m:1 : assign cell:real R[1] = 10:real\n"
        "  @m:2 : assign cell:real R[1] = 5:real; axis X = cell-at:real R[cell:real "
        "R[1]]\n",
        "  @m:1 : axis X = cell-at:real R[cell:real R[1]]\n", "  @m:1 : axis X = cell-at:real R[120:real]\n"})
    CHECK(Fixed(std::string(blocks)).find("cell-at") != std::string::npos);
}

}  // namespace
}  // namespace ncport::ir::transform
