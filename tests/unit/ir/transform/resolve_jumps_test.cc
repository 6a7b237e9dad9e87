#include "ir/transform/resolve_jumps.h"

#include <doctest/doctest.h>

#include "ir/analysis/labels.h"
#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

struct Fixture {
  Module module;
  ExprBuilder e{module};
  diag::Sink sink;
  ProgramBuilder program{module, "MAIN"};

  void Jump(std::uint32_t number) { program.Block().JumpToNumber(number, Search::kForwardThenFromStart).Finish(); }
  /// Where the jump of the n-th block of the program goes, as a step in blocks.
  [[nodiscard]] std::uint32_t Goes(std::uint32_t n) const {
    const IdRange<BlockId> blocks = module.programs[program.Id()].blocks;
    const auto& jump = module.jumps[module.words[module.blocks[blocks[n]].words[0]].Extra<JumpId>()];
    CHECK(jump.search != Search::kForwardThenFromStart);
    const analysis::LabelTable labels(module, program.Id());
    return labels.Find(jump.target, blocks[n], jump.search).value - blocks.begin;
  }
};

TEST_CASE("a doubled number is found where the search of the source finds it") {
  Fixture f;
  f.program.Block().Number(20).Finish();  // 0: the first from the start
  f.Jump(20);                             // 1: forward, to 2
  f.program.Block().Number(20).Finish();  // 2: the nearest one backward from 3
  f.Jump(20);                             // 3: none behind, so from the start: 0
  f.program.Finish();
  REQUIRE(ResolveJumps(f.module, f.program.Id(), "U_L", f.sink));
  CHECK(f.Goes(1) == 2);
  CHECK(f.Goes(3) == 0);
}

TEST_CASE("a number that a jump looks for leaves the mark of a structure") {
  Fixture f;
  f.program.Block().Number(5).Add(WordOp::kIf, f.e.Literal(1, Type::kBool)).Finish();
  f.program.Block().Add(WordOp::kEndIf).Finish();
  f.Jump(5);
  f.program.Finish();
  REQUIRE(ResolveJumps(f.module, f.program.Id(), "U_L", f.sink));
  const IdRange<BlockId> blocks = f.module.programs[f.program.Id()].blocks;
  REQUIRE(blocks.count == 4);
  CHECK(f.module.blocks[blocks[0]].number == 5);
  CHECK(f.module.blocks[blocks[0]].words.Empty());
  CHECK(f.module.blocks[blocks[1]].number == Block::kNoNumber);
  CHECK(f.Goes(3) == 0);
}

TEST_CASE("a computed jump needs numbers that stand once") {
  for (const bool doubled : {false, true}) {
    Fixture f;
    const SpaceId space = AddSpace(f.module, "#", 1, 33);
    Jump jump;
    jump.target.kind = TargetKind::kExpression;
    jump.target.expr = f.e.Cell(space, 1);
    jump.search = Search::kForwardThenFromStart;
    const JumpId id = f.module.jumps.Add(jump);
    f.program.Block().Add(WordOp::kJump, {}, 0, id.value).Finish();
    f.program.Block().Number(1).Finish();
    f.program.Block().Number(doubled ? 1 : 2).Finish();
    f.program.Finish();
    CHECK(ResolveJumps(f.module, f.program.Id(), "U_L", f.sink) != doubled);
    if (!doubled) CHECK(f.module.exprs[f.module.jumps[id].target.expr].op == ExprOp::kConcat);
  }
}

}  // namespace
}  // namespace ncport::ir::transform
