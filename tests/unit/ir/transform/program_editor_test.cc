#include "ir/transform/program_editor.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

namespace ncport::ir::transform {
namespace {

struct Fixture {
  Module module;
  ProgramId program;
  std::vector<BlockId> ids;

  Fixture() {
    ExprBuilder e(module);
    ProgramBuilder builder(module, "P");
    ids.push_back(builder.Block().Label("START").Comment("FIRST").Add(WordOp::kStop).Finish());
    ids.push_back(builder.Block().Axis(0, e.Number("1")).Finish());
    ids.push_back(builder.Block().Label("LAST").Axis(1, e.Number("2")).Finish());
    builder.Finish();
    program = builder.Id();
  }
  [[nodiscard]] std::vector<Block> Blocks() const {
    std::vector<Block> blocks;
    for (const BlockId id : module.programs[program].blocks) blocks.push_back(module.blocks[id]);
    return blocks;
  }
};

TEST_CASE("insertions keep their order and lead to the block they stand at") {
  Fixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  Block one = editor.MakeBlock(f.ids[1]);
  one.number = 10;
  Block two = editor.MakeBlock(f.ids[1]);
  two.number = 20;
  Block three = editor.MakeBlock(f.ids[1]);
  three.number = 30;
  editor.InsertAfter(f.ids[1], three);
  editor.InsertBefore(f.ids[1], one);
  editor.InsertBefore(f.ids[1], two);
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  REQUIRE(blocks.size() == 6);
  CHECK(blocks[1].number == 10);
  CHECK(blocks[2].number == 20);
  CHECK(blocks[4].number == 30);
  const Origin& origin = f.module.origins[blocks[1].origin];
  CHECK(f.module.View(origin.pass) == "test pass");
  CHECK(origin.line == f.module.origins[f.module.blocks[f.ids[1]].origin].line);
}

TEST_CASE("comments and labels of a removed block go to the next one") {
  Fixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  editor.Remove(f.ids[0]);
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  REQUIRE(blocks.size() == 2);
  CHECK(f.module.View(blocks[0].label) == "START");
  REQUIRE(blocks[0].comments.count == 1);
  CHECK(f.module.View(f.module.comments[blocks[0].comments[0]].text) == "FIRST");
}

TEST_CASE("a label is never lost to another label") {
  Fixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  editor.Remove(f.ids[0]);
  editor.Remove(f.ids[1]);
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  REQUIRE(blocks.size() == 2);
  CHECK(f.module.View(blocks[0].label) == "START");
  CHECK(blocks[0].words.Empty());
  CHECK(f.module.View(blocks[1].label) == "LAST");
}

}  // namespace
}  // namespace ncport::ir::transform
