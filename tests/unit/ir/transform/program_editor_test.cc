#include "ir/transform/program_editor.h"

#include <doctest/doctest.h>

#include <utility>

#include "ir/analysis/labels.h"
#include "ir/builder.h"
#include "ir/make_word.h"

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

/// One block `:30 GO: /3 ... ;SAY` between two others.
struct HeadFixture : Fixture {
  HeadFixture() {
    Block& block = module.blocks[ids[1]];
    block.label = module.strings.Intern("GO");
    block.number = 30;
    block.number_digits = 3;
    block.skip_level = 3;
    block.flags = Block::kMainBlock | Block::kSkipDigit | Block::kAdded;
    Comment comment;
    comment.text = module.strings.Intern("SAY");
    block.comments = {module.comments.Add(comment).value, 1};
  }
  /// Where a jump to the label, and one to the main block number, go to: a position in the program.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> Targets() const {
    const analysis::LabelTable labels(module, program, false);
    const std::uint32_t begin = module.programs[program].blocks.begin;
    const BlockId last{std::size_t{begin} + module.programs[program].blocks.count - 1};
    return {labels.FindLabel("GO", last, Search::kBackward).value - begin,
            labels.FindNumber(30, true, last, Search::kBackward).value - begin};
  }
};

TEST_CASE("a block in front takes over the head: jumps to the block run it") {
  HeadFixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  editor.PutInFront(f.ids[1], {MakeWord(WordOp::kStop)});
  editor.PutInFront(f.ids[1], {MakeWord(WordOp::kPlane, 1)});
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  REQUIRE(blocks.size() == 5);
  const Block& made = blocks[1];
  CHECK(f.module.View(made.label) == "GO");
  CHECK(made.number == 30);
  CHECK(made.number_digits == 3);
  CHECK((made.flags & Block::kMainBlock) != 0);
  CHECK(f.module.words[made.words[0]].op == WordOp::kStop);
  CHECK(f.module.View(f.module.origins[made.origin].pass) == "test pass");
  for (const std::size_t behind : {std::size_t{2}, std::size_t{3}}) {
    CHECK_FALSE(blocks[behind].label.Valid());
    CHECK(blocks[behind].number == Block::kNoNumber);
    CHECK((blocks[behind].flags & Block::kMainBlock) == 0);
  }
  CHECK(f.Targets() == std::pair<std::uint32_t, std::uint32_t>{1, 1});
  // All are skipped or none is, and all count as added.
  for (std::size_t i = 1; i <= 3; ++i) {
    CHECK(blocks[i].skip_level == 3);
    CHECK((blocks[i].flags & Block::kSkipDigit) != 0);
    CHECK((blocks[i].flags & Block::kAdded) != 0);
  }
  // The comment speaks of the words that stay.
  CHECK(blocks[1].comments.Empty());
  REQUIRE(blocks[3].comments.count == 1);
}

TEST_CASE("comments go along from a block that is going to be removed") {
  HeadFixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  editor.PutInFront(f.ids[1], {MakeWord(WordOp::kStop)}, {.comments = true});
  editor.Remove(f.ids[1]);
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  REQUIRE(blocks.size() == 3);
  REQUIRE(blocks[1].comments.count == 1);
  CHECK(f.module.View(f.module.comments[blocks[1].comments[0]].text) == "SAY");
  CHECK(blocks[2].comments.Empty());
  CHECK(f.module.View(blocks[2].label) == "LAST");
  CHECK(f.Targets() == std::pair<std::uint32_t, std::uint32_t>{1, 1});
}

TEST_CASE("what both ways need runs though the block is skipped") {
  HeadFixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  editor.PutInFront(f.ids[1], {MakeWord(WordOp::kStop)}, {.skip = false});
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  CHECK(blocks[1].skip_level == Block::kNoSkip);
  CHECK((blocks[1].flags & Block::kSkipDigit) == 0);
  CHECK(blocks[2].skip_level == 3);
  CHECK(f.Targets().first == 1);
}

TEST_CASE("a block behind leaves the head and is skipped with the block") {
  HeadFixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  editor.PutBehind(f.ids[1], {MakeWord(WordOp::kStop)});
  editor.Apply();
  const std::vector<Block> blocks = f.Blocks();
  REQUIRE(blocks.size() == 4);
  CHECK(f.module.words[blocks[2].words[0]].op == WordOp::kStop);
  CHECK(blocks[2].skip_level == 3);
  CHECK((blocks[2].flags & (Block::kAdded | Block::kMainBlock)) == Block::kAdded);
  CHECK(blocks[2].number == Block::kNoNumber);
  CHECK(f.Targets() == std::pair<std::uint32_t, std::uint32_t>{1, 1});
}

TEST_CASE("a block without a head gives none") {
  Fixture f;
  ProgramEditor editor(f.module, f.program, "test pass");
  Block made = editor.MakeBlock(f.ids[1]);
  editor.TakeHead(made, f.ids[1], {.comments = true});
  CHECK_FALSE(made.label.Valid());
  CHECK(made.number == Block::kNoNumber);
  CHECK(made.skip_level == Block::kNoSkip);
  CHECK(made.comments.Empty());
}

}  // namespace
}  // namespace ncport::ir::transform
