#include "ir/transform/feeds_to_numbers.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Numbers(const std::string& blocks) {
  diag::Sink sink;
  return test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nsystem $P_F active-feed real\nprogram M main @m:0\n"
      "  var OLD real local\n" +
          blocks,
      sink, [&](Module& module, diag::Sink&) {
        FeedsToNumbers(module, Machine{}, {});
        return true;
      });
}

bool Reads(const std::string& text) { return text.find("system") != std::string::npos; }

TEST_CASE("the active feed is the number of the feed word in force, also of one that was put back") {
  const std::string text = Numbers(
      "  @m:1 : feed = 100:real\n"
      "  @m:2 : assign variable:real OLD = system:real $P_F()\n"
      "  @m:3 : feed = mul:real(variable:real OLD, 0.5:real)\n"
      "  @m:4 : axis X = 1\n"
      "  @m:5 : feed = variable:real OLD\n"
      "  @m:6 : assign cell:real R[1] = system:real $P_F()\n");
  CHECK_FALSE(Reads(text));
  CHECK(text.find("R[1] = literal(100") != std::string::npos);
}

TEST_CASE("a feed that is not one number on all ways stays the machine's") {
  const std::string read = "  @m:9 label L : assign cell:real R[1] = system:real $P_F()\n";
  for (const std::string_view blocks :
       {"",  // none programmed
        "  @m:1 : feed = cell:real R[2]\n", "  @m:1 : feed = 100:real\n  @m:2 : feed-mode per-revolution\n",
        "  @m:1 : units inch\n  @m:2 : feed = 100:real\n",
        "  @m:1 : feed = 100:real\n"
        "  @m:2 : jump forward label L = lt:bool(cell:real R[2], 1:real)\n"
        "  @m:3 : feed = 200:real\n",
        "  @m:1 : feed = 100:real\n"
        "  @m:2 : assign variable:real OLD = system:real $P_F()\n"
        "  @m:3 : assign variable:real OLD = 7:real\n"
        "  @m:4 : feed = variable:real OLD\n"})
    CHECK(Reads(Numbers(std::string(blocks) + read)));
}

}  // namespace
}  // namespace ncport::ir::transform
