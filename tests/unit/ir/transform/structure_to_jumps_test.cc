#include "ir/transform/structure_to_jumps.h"

#include <doctest/doctest.h>

#include <set>

#include "ir/builder.h"
#include "ir/structure.h"
#include "ir/transform/part_ends.h"

namespace ncport::ir::transform {
namespace {

struct Fixture {
  Module module;
  ExprBuilder e{module};
  SpaceId space = AddSpace(module, "R", 0, 99);
  diag::Sink sink;

  ExprId R(std::uint32_t n) { return e.Cell(space, n); }
  ExprId Less(std::uint32_t n, const char* number) { return e.Binary(ExprOp::kLess, R(n), e.Number(number)); }
  bool Lower(ProgramBuilder& builder, StructureToJumpsConfig config = {}) {
    builder.Finish();
    BuildStructure(module, builder.Id(), 0, sink);
    REQUIRE_FALSE(sink.HasErrors());
    return StructureToJumps(module, builder.Id(), config, sink);
  }
  std::size_t Count(ProgramId program, WordOp op) const {
    std::size_t count = 0;
    for (const BlockId block : module.programs[program].blocks) {
      for (const WordId word : module.blocks[block].words) count += module.words[word].op == op ? 1U : 0U;
    }
    return count;
  }
  /// Runs assignments `R = R + literal`, jumps and WHILE by hand: the order of blocks executed tells whether flow is
  /// kept.
  double Run(ProgramId program, std::uint32_t result) {
    const IdRange<BlockId> blocks = module.programs[program].blocks;
    double cells[100] = {};
    std::uint32_t at = 0;
    const auto value = [&](auto&& self, ExprId id) -> double {
      const Expr& x = module.exprs[id];
      const auto a = [&] { return self(self, ExprId{x.a}); };
      const auto b = [&] { return self(self, ExprId{x.b}); };
      switch (x.op) {
        case ExprOp::kLiteral:
          return x.number;
        case ExprOp::kCell:
          return cells[x.b];
        case ExprOp::kVariable:
          return variables[x.a];
        case ExprOp::kAdd:
          return a() + b();
        case ExprOp::kSubtract:
          return a() - b();
        case ExprOp::kMultiply:
          return a() * b();
        case ExprOp::kLess:
          return a() < b();
        case ExprOp::kLessEqual:
          return a() <= b();
        case ExprOp::kGreater:
          return a() > b();
        case ExprOp::kGreaterEqual:
          return a() >= b();
        case ExprOp::kEqual:
          return a() == b();
        case ExprOp::kNotEqual:
          return a() != b();
        default:
          FAIL("unexpected operation");
          return 0;
      }
    };
    for (int steps = 0; at < blocks.count; ++steps) {
      REQUIRE(steps < 100000);
      const Block& block = module.blocks[blocks[at]];
      std::uint32_t next = at + 1;
      for (const WordId id : block.words) {
        const Word& word = module.words[id];
        if (word.op == WordOp::kAssign) {
          const Expr& place = module.exprs[word.Extra<ExprId>()];
          (place.op == ExprOp::kCell ? cells[place.b] : variables[place.a]) = value(value, word.value);
        } else if (word.op == WordOp::kWhile) {
          if (value(value, word.value) == 0) next = block.link.value - blocks.begin + 1;
        } else if (word.op == WordOp::kEndWhile) {
          next = block.link.value - blocks.begin;
        } else if (word.op == WordOp::kJump) {
          if (word.value.Valid() && value(value, word.value) == 0) continue;
          const std::uint32_t number = module.jumps[word.Extra<JumpId>()].target.number;
          std::set<std::uint32_t> found;
          for (std::uint32_t i = 0; i < blocks.count; ++i) {
            if (module.blocks[blocks[i]].number == number) found.insert(i);
          }
          REQUIRE(found.size() == 1);
          next = *found.begin();
          break;
        } else {
          FAIL("a word that should be gone");
        }
      }
      at = next;
    }
    return cells[result];
  }
  double variables[64] = {};
};

TEST_CASE("if and else run one side") {
  for (const char* start : {"1", "7"}) {
    Fixture f;
    ProgramBuilder p(f.module, "P");
    p.Block().Assign(f.R(1), f.e.Number(start)).Finish();
    p.Block().Add(WordOp::kIf, f.e.Binary(ExprOp::kAnd, f.Less(1, "5"), f.Less(2, "3"))).Finish();
    p.Block().Assign(f.R(9), f.e.Number("10")).Finish();
    p.Block().Add(WordOp::kElse).Finish();
    p.Block().Assign(f.R(9), f.e.Number("20")).Finish();
    p.Block().Add(WordOp::kEndIf).Finish();
    p.Block().Assign(f.R(9), f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number("1"))).Finish();
    REQUIRE(f.Lower(p));
    CHECK(f.Count(p.Id(), WordOp::kIf) == 0);
    CHECK(f.Run(p.Id(), 9) == (start[0] == '1' ? 11 : 21));
  }
}

TEST_CASE("loops keep their turns, kept as WHILE or not") {
  for (const std::uint32_t depth : {0U, 1U, 3U}) {
    Fixture f;
    ProgramBuilder p(f.module, "P");
    const auto up = [&](std::uint32_t n, const char* by) { return f.e.Binary(ExprOp::kAdd, f.R(n), f.e.Number(by)); };
    p.Block().For(f.R(1), f.e.Number("1"), f.e.Number("3")).Finish();
    p.Block().Assign(f.R(2), f.e.Number("0")).Finish();
    p.Block().Add(WordOp::kWhile, f.Less(2, "4")).Finish();
    p.Block().Assign(f.R(2), up(2, "1")).Finish();
    p.Block().Assign(f.R(9), up(9, "1")).Finish();
    p.Block().Add(WordOp::kEndWhile).Finish();
    p.Block().Add(WordOp::kEndFor).Finish();
    p.Block().Add(WordOp::kRepeat).Finish();
    p.Block().Assign(f.R(9), up(9, "100")).Finish();
    p.Block().Add(WordOp::kUntil, f.e.Binary(ExprOp::kGreater, f.R(9), f.e.Number("250"))).Finish();
    p.Block().Add(WordOp::kLoop).Finish();
    p.Block().Assign(f.R(9), up(9, "1000")).Finish();
    p.Block().Jump("OUT", Search::kForward, f.e.Binary(ExprOp::kGreater, f.R(9), f.e.Number("2500"))).Finish();
    p.Block().Add(WordOp::kEndLoop).Finish();
    p.Block().Label("OUT").Assign(f.R(9), up(9, "0.5")).Finish();
    StructureToJumpsConfig config;
    config.loop_depth = depth;
    REQUIRE(f.Lower(p, config));
    CHECK(f.Count(p.Id(), WordOp::kWhile) == std::min(depth, 2U));
    CHECK(f.Run(p.Id(), 9) == 3312.5);  // 12, then 312, then in thousands over 2500
  }
}

TEST_CASE("doubled labels keep the targets of their own search") {
  Fixture f;
  ProgramBuilder p(f.module, "P");
  p.Block().Jump("A", Search::kForward).Finish();
  p.Block().Assign(f.R(9), f.e.Number("1")).Finish();
  p.Block().Label("A").Assign(f.R(9), f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number("10"))).Finish();
  p.Block().Jump("A", Search::kForward, f.e.Binary(ExprOp::kGreater, f.R(9), f.e.Number("15"))).Finish();
  p.Block().Jump("A", Search::kBackward).Finish();
  p.Block().Label("A").Assign(f.R(9), f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number("100"))).Finish();
  REQUIRE(f.Lower(p));
  CHECK(f.Run(p.Id(), 9) == 120);
}

TEST_CASE("a part that is repeated runs its count again") {
  Fixture f;
  ProgramBuilder p(f.module, "P");
  p.Block().Assign(f.R(9), f.e.Number("0")).Finish();
  p.Block().Label("PART").Assign(f.R(9), f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number("1"))).Finish();
  p.Block().RepeatPart("PART", "", f.e.Number("3")).Finish();
  p.Block().Assign(f.R(9), f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number("0.5"))).Finish();
  REQUIRE(f.Lower(p));
  CHECK(f.Run(p.Id(), 9) == 4.5);
}

TEST_CASE(
    "a part that lies away from its repeat word is met once and run again, and then control is behind that word") {
  Fixture f;
  ProgramBuilder p(f.module, "P");
  const auto add = [&](const char* number) { return f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number(number)); };
  p.Block().Assign(f.R(9), f.e.Number("0")).Finish();
  p.Block().Label("PART").Assign(f.R(9), add("1")).Finish();
  p.Block().Label("OVER").Assign(f.R(9), add("10")).Finish();
  p.Block().Assign(f.R(9), add("100")).Finish();
  p.Block().RepeatPart("PART", "OVER", f.e.Number("3")).Finish();
  p.Block().Assign(f.R(9), add("0.5")).Finish();
  REQUIRE(f.Lower(p));
  CHECK(f.Run(p.Id(), 9) == 11 + 100 + 33 + 0.5);
}

TEST_CASE("a part that runs inside another one ends where it is repeated") {
  Fixture f;
  ProgramBuilder p(f.module, "P");
  const auto add = [&](const char* number) { return f.e.Binary(ExprOp::kAdd, f.R(9), f.e.Number(number)); };
  p.Block().Assign(f.R(9), f.e.Number("0")).Finish();
  p.Block().Label("OUTER").Assign(f.R(9), add("1000")).Finish();
  p.Block()
      .Add(WordOp::kRepeatPart, f.e.Number("2"), 0,
           f.module.parts
               .Add([&] {
                 Part part;
                 part.single = true;
                 part.first.label = f.module.strings.Intern("INNER");
                 return part;
               }())
               .value)
      .Finish();
  p.Block().Label("INNER").Assign(f.R(9), add("1")).Finish();
  p.Block().Assign(f.R(9), add("0.25")).Finish();
  p.Block().RepeatPart("OUTER", "INNER", f.e.Number("1")).Finish();
  p.Finish();
  MarkPartEnds(f.module, p.Id());
  BuildStructure(f.module, p.Id(), 0, f.sink);
  REQUIRE(StructureToJumps(f.module, p.Id(), {}, f.sink));
  // Twice OUTER: 1000, INNER twice by its repeat word and once as it is met.
  CHECK(f.Run(p.Id(), 9) == 2 * 1003 + 0.25);
}

TEST_CASE("a part that is left before its end is a finding: its counter would stand above 0") {
  Fixture f;
  ProgramBuilder p(f.module, "P");
  p.Block().Label("PART").Assign(f.R(9), f.e.Number("1")).Finish();
  p.Block().Jump("OUT", Search::kForward, f.Less(9, "5")).Finish();
  p.Block().RepeatPart("PART", "", f.e.Number("3")).Finish();
  p.Block().Label("OUT").Assign(f.R(9), f.e.Number("2")).Finish();
  CHECK_FALSE(f.Lower(p));
  CHECK(f.sink.HasErrors());
}

TEST_CASE("a jump to nowhere is a finding") {
  Fixture f;
  ProgramBuilder p(f.module, "P");
  p.Block().Jump("NOWHERE", Search::kForward).Finish();
  CHECK_FALSE(f.Lower(p));
  CHECK(f.sink.HasErrors());
}

}  // namespace
}  // namespace ncport::ir::transform
