#include "ir/analysis/labels.h"

#include <doctest/doctest.h>

#include "ir/builder.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

// Labels: 0 A, 1 B, 2 -, 3 a, 4 -(jumps from here), 5 B, 6 A, 7 A; numbers: 2 N10, 4 N20, 6 N10, 7 :10
struct Fixture {
  Module module;
  ProgramId program;
  Fixture() {
    ProgramBuilder first(module, "OTHER");
    first.Block().Label("A").Finish();
    first.Finish();
    ProgramBuilder builder(module, "P");
    program = builder.Id();
    builder.Block().Label("A").Finish();
    builder.Block().Label("B").Finish();
    builder.Block().Number(10).Finish();
    builder.Block().Label("a").Finish();
    builder.Block().Number(20).Finish();
    builder.Block().Label("B").Skip(2).Finish();
    builder.Block().Label("A").Number(10).Finish();
    builder.Block().Label("A").Number(10).Flags(Block::kMainBlock).Finish();
    builder.Finish();
  }
  BlockId At(std::size_t index) const { return module.programs[program].blocks[static_cast<std::uint32_t>(index)]; }
};

}  // namespace

TEST_CASE("ir labels: the nearest hit in the direction of the search wins") {
  const Fixture f;
  const LabelTable labels(f.module, f.program);
  const BlockId from = f.At(4);
  CHECK(labels.FindLabel("A", from, Search::kForward) == f.At(6));
  CHECK(labels.FindLabel("A", from, Search::kBackward) == f.At(3));
  CHECK(labels.FindLabel("A", from, Search::kForwardThenBackward) == f.At(6));
  CHECK(labels.FindLabel("A", from, Search::kBackwardThenForward) == f.At(3));
  // Behind the last A the two orders differ: nearest before, or first of the program.
  CHECK(labels.FindLabel("A", f.At(7), Search::kForwardThenBackward) == f.At(7));
  CHECK(labels.FindLabel("A", f.At(7), Search::kForwardThenFromStart) == f.At(0));
  CHECK_FALSE(labels.FindLabel("A", f.At(7), Search::kForward).Valid());
  CHECK_FALSE(labels.FindLabel("C", from, Search::kForwardThenBackward).Valid());
  CHECK(labels.FindLabel("B", f.At(0), Search::kBackwardThenForward) == f.At(1));
  CHECK_FALSE(labels.FindLabel("B", f.At(0), Search::kBackward).Valid());
}

TEST_CASE("ir labels: a block finds its own label backward, not forward") {
  const Fixture f;
  const LabelTable labels(f.module, f.program);
  CHECK(labels.FindLabel("A", f.At(3), Search::kBackward) == f.At(3));
  CHECK(labels.FindLabel("A", f.At(3), Search::kForward) == f.At(6));
}

TEST_CASE("ir labels: case counts only when the language says so") {
  const Fixture f;
  const LabelTable exact(f.module, f.program, false);
  CHECK(exact.FindLabel("A", f.At(4), Search::kBackward) == f.At(0));
  CHECK(exact.FindLabel("a", f.At(4), Search::kBackward) == f.At(3));
}

TEST_CASE("ir labels: numbers, main numbers and literal expressions") {
  Fixture f;
  ExprBuilder e(f.module);
  Target text;
  text.kind = TargetKind::kExpression;
  text.expr = e.Text("b");
  Target number = text;
  number.expr = e.Number("10");
  Target fraction = text;
  fraction.expr = e.Number("10.5");
  Target computed = text;
  computed.expr = e.Unary(ExprOp::kGroup, e.Number("10"));
  const LabelTable labels(f.module, f.program);
  const BlockId from = f.At(4);
  CHECK(labels.FindNumber(10, false, from, Search::kForward) == f.At(6));
  CHECK(labels.FindNumber(10, true, from, Search::kForward) == f.At(7));
  CHECK(labels.FindNumber(10, false, from, Search::kBackward) == f.At(2));
  CHECK_FALSE(labels.FindNumber(30, false, from, Search::kForwardThenFromStart).Valid());
  CHECK(labels.Find(text, from, Search::kForward) == f.At(5));
  CHECK(labels.Find(number, from, Search::kForward) == f.At(6));
  CHECK_FALSE(labels.Find(fraction, from, Search::kForward).Valid());
  CHECK_FALSE(labels.Find(computed, from, Search::kForward).Valid());
  Target start;
  start.kind = TargetKind::kProgramStart;
  CHECK(labels.Find(start, from, Search::kForward) == f.At(0));
}

TEST_CASE("ir labels: labels of skipped blocks are not found while their level is on") {
  const Fixture f;
  const LabelTable labels(f.module, f.program);
  CHECK(labels.FindLabel("B", f.At(4), Search::kForwardThenBackward) == f.At(5));
  CHECK(labels.FindLabel("B", f.At(4), Search::kForwardThenBackward, 1U << 2U) == f.At(1));
  CHECK(labels.FindLabel("B", f.At(4), Search::kForwardThenBackward, 1U << 1U) == f.At(5));
}

TEST_CASE("ir labels: candidates of computed jumps are the marked blocks of this program") {
  const Fixture f;
  const LabelTable labels(f.module, f.program);
  CHECK(labels.Targets().size() == 8);
  CHECK(labels.Targets().front() == f.At(0));
  CHECK(labels.Targets().back() == f.At(7));
}

TEST_CASE("ir labels: ranges of repeated parts") {
  Fixture f;
  const LabelTable labels(f.module, f.program);
  Part part;
  part.first.label = f.module.strings.Intern("B");
  // Up to the block before the word.
  auto range = labels.FindPart(part, f.At(4));
  REQUIRE(range.has_value());
  CHECK(range->first == f.At(1));
  CHECK(range->last == f.At(3));
  // Up to the end label, if it stands between.
  part.last.label = f.module.strings.Intern("A");
  range = labels.FindPart(part, f.At(4));
  REQUIRE(range.has_value());
  CHECK(range->last == f.At(3));
  range = labels.FindPart(part, f.At(3));
  REQUIRE(range.has_value());
  CHECK(range->last == f.At(2));
  // Up to a label that was written; the block of the word must not lie inside.
  part.has_last = true;
  range = labels.FindPart(part, f.At(4));
  REQUIRE(range.has_value());
  CHECK(range->last == f.At(3));
  CHECK_FALSE(labels.FindPart(part, f.At(2)).has_value());
  // One block, behind the word.
  Part single;
  single.single = true;
  single.first.label = f.module.strings.Intern("B");
  range = labels.FindPart(single, f.At(0));
  REQUIRE(range.has_value());
  CHECK(range->first == f.At(1));
  CHECK(range->last == f.At(1));
  // Without an end a part behind the word has no range; the same for a label that is not there.
  Part ahead;
  ahead.first.label = f.module.strings.Intern("B");
  CHECK_FALSE(labels.FindPart(ahead, f.At(0)).has_value());
  ahead.first.label = f.module.strings.Intern("NONE");
  CHECK_FALSE(labels.FindPart(ahead, f.At(4)).has_value());
}

TEST_CASE("ir labels: a part that starts at the first block of all finds its end") {
  Module module;
  ProgramBuilder builder(module, "P");
  builder.Block().Label("S").Finish();
  builder.Block().Label("E").Finish();
  const BlockId from = builder.Block().Finish();
  builder.Finish();
  Part part;
  part.first.label = module.strings.Intern("S");
  part.last.label = module.strings.Intern("S");
  part.has_last = true;
  const LabelTable labels(module, builder.Id());
  const auto range = labels.FindPart(part, from);
  REQUIRE(range.has_value());
  CHECK(range->first == BlockId{std::size_t{0}});
  CHECK(range->last == BlockId{std::size_t{0}});
}
