#include "ir/transform/numbers_to_names.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

struct Fixture {
  Module module;
  ExprBuilder e{module};
  SpaceId locals = AddSpace(module, "#", 1, 33);
  SpaceId common = AddSpace(module, "#", 100, 199);
  SpaceId kept = AddSpace(module, "#", 500, 999);
  diag::Sink sink;
  NumbersToNamesConfig config;

  Fixture() {
    module.spaces[locals].lifetime = Lifetime::kCall;
    module.spaces[locals].visibility = Visibility::kLevel;
    config.letter_of = [](std::uint32_t cell) { return cell <= 3 ? static_cast<char>('A' + cell - 1) : '\0'; };
  }
  BlockBuilder& Call(BlockBuilder&& block, ProgramId callee, bool shares) {
    ir::Call call;
    call.program = callee;
    call.name = module.programs[callee].name;
    call.new_level = !shares;
    return block.Add(WordOp::kCall, {}, 0, module.calls.Add(call).value);
  }
  [[nodiscard]] std::string TargetOf(std::string_view source, const NumbersToNamesResult& result) const {
    const auto found = std::find_if(result.map.begin(), result.map.end(),
                                    [&](const CellMapping& mapping) { return mapping.source == source; });
    return found == result.map.end() ? "" : found->target;
  }
};

TEST_CASE("cells that a subprogram shares with its caller become parameters by reference") {
  Fixture f;
  ProgramBuilder sub(f.module, "SUB", ProgramKind::kSub);
  sub.Block().Assign(f.e.Cell(f.locals, 1), f.e.Cell(f.locals, 30)).Finish();
  sub.Finish();
  ProgramBuilder main(f.module, "MAIN");
  f.Call(main.Block(), sub.Id(), true).Finish();
  main.Finish();
  const NumbersToNamesResult result = NumbersToNames(f.module, f.config, f.sink);
  REQUIRE(result.ok);
  const Program& program = f.module.programs[sub.Id()];
  REQUIRE(program.parameters.count == 2);
  CHECK(f.module.variables[program.parameters[0]].by_reference);
  CHECK(f.module.View(f.module.variables[program.parameters[0]].name) == "U_A");
  CHECK(f.module.View(f.module.variables[program.parameters[1]].name) == "U_30");
  CHECK(f.module.calls[CallId{std::size_t{0}}].args.count == 2);
}

TEST_CASE("common cells keep their distance, pins come first, the others fill from the end") {
  Fixture f;
  ProgramBuilder main(f.module, "MAIN");
  main.Block().Assign(f.e.Cell(f.common, 107), f.e.Cell(f.kept, 500)).Finish();
  main.Block().Assign(f.e.Cell(f.common, 108), f.e.Cell(f.kept, 501)).Finish();
  main.Finish();
  f.config.pins = {{501, 20}};
  const NumbersToNamesResult result = NumbersToNames(f.module, f.config, f.sink);
  REQUIRE(result.ok);
  CHECK(f.TargetOf("#107", result) == "R7");
  CHECK(f.TargetOf("#108", result) == "R8");
  CHECK(f.TargetOf("#500", result) == "R99");
  CHECK(f.TargetOf("#501", result) == "R20");
}

TEST_CASE("cells that one index reaches move together; an index without bounds is refused") {
  Fixture f;
  ProgramBuilder main(f.module, "MAIN");
  const ExprId index = f.e.Binary(ExprOp::kAdd, f.e.Number("510"),
                                  f.e.Binary(ExprOp::kModulo, f.e.Function(Function::kAbs, {f.e.Cell(f.locals, 1)}),
                                             f.e.Number("4"), Expr::kOperandsToInt));
  main.Block().Assign(f.e.CellAt(f.common, index), f.e.Number("1")).Finish();
  main.Finish();
  const NumbersToNamesResult result = NumbersToNames(f.module, f.config, f.sink);
  REQUIRE(result.ok);
  CHECK(f.TargetOf("#510", result) == "R96");
  CHECK(f.TargetOf("#513", result) == "R99");

  Fixture open;
  ProgramBuilder other(open.module, "MAIN");
  other.Block().Assign(open.e.CellAt(open.common, open.e.Cell(open.locals, 1)), open.e.Number("1")).Finish();
  other.Finish();
  CHECK_FALSE(NumbersToNames(open.module, open.config, open.sink).ok);
}

TEST_CASE("more common variables than the target has cells are refused") {
  Fixture f;
  f.config.cells = {0, 1};
  ProgramBuilder main(f.module, "MAIN");
  for (std::uint32_t cell = 500; cell < 503; ++cell)
    main.Block().Assign(f.e.Cell(f.kept, cell), f.e.Number("1")).Finish();
  main.Finish();
  CHECK_FALSE(NumbersToNames(f.module, f.config, f.sink).ok);
  CHECK(f.sink.HasErrors());
}

}  // namespace
}  // namespace ncport::ir::transform
