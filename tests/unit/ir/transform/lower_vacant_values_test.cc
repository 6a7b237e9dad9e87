#include "ir/transform/lower_vacant_values.h"

#include <doctest/doctest.h>

#include <string>

#include "base/text_buffer.h"
#include "ir/builder.h"
#include "ir/dump.h"
#include "ir/transform/adapt_expressions.h"

namespace ncport::ir::transform {
namespace {

/// A main program over locals #1.. and common cells #100...
struct Fixture {
  Module module;
  ExprBuilder e{module};
  SpaceId locals = AddSpace(module, "#", 1, 33, Type::kNumber, StartValue::kVacant);
  SpaceId common = AddSpace(module, "#", 100, 199, Type::kNumber, StartValue::kVacant);
  diag::Sink sink;

  Fixture() {
    module.spaces[locals].lifetime = Lifetime::kCall;
    module.spaces[locals].visibility = Visibility::kLevel;
  }
  ExprId Local(std::uint32_t number) { return e.Cell(locals, number); }
  ExprId IsEmpty(ExprId cell) { return e.Binary(ExprOp::kEqual, cell, e.Vacant(), Expr::kVacantDiffers); }
  static void Move(BlockBuilder block, std::uint8_t axis, ExprId value) {
    block.Axis(axis, value);
    block.Last().flags |= Word::kVanishesVacant;
    block.Finish();
  }
  std::string Run(ProgramBuilder& program, const analysis::VacancyConfig& config = {}) {
    program.Finish();
    result = LowerVacantValues(module, Machine{}, config, sink);
    TextBuffer out;
    Dump(module, out, {.places = false});
    return std::string(out.View());
  }
  VacantValuesResult result;
};

bool Holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_CASE("a word whose variable is empty for certain goes, one that holds a number stays") {
  Fixture f;
  ProgramBuilder program(f.module, "MAIN");
  program.Block().Assign(f.Local(1), f.e.Vacant()).Finish();
  program.Block().Assign(f.Local(2), f.e.Number("0")).Finish();
  Fixture::Move(program.Block(), 0, f.Local(1));
  Fixture::Move(program.Block(), 1, f.Local(2));
  const std::string dump = f.Run(program);
  CHECK(f.result.ok);
  CHECK_FALSE(Holds(dump, "axis X"));
  CHECK(Holds(dump, "axis Y"));
  CHECK_FALSE(Holds(dump, "vanishes"));
  CHECK_FALSE(Holds(dump, "vacant:number"));
  CHECK_FALSE(Holds(dump, "given"));
}

TEST_CASE("where a local is empty on some ways only, a truth value stands beside it") {
  Fixture f;
  ProgramBuilder program(f.module, "MAIN");
  program.Block().Assign(f.e.Cell(f.common, 100), f.e.Number("1")).Finish();
  program.Block()
      .JumpToNumber(9, Search::kForward, f.e.Binary(ExprOp::kLess, f.e.Cell(f.common, 100), f.e.Number("5")))
      .Finish();
  program.Block().Assign(f.Local(1), f.e.Number("3")).Finish();
  Fixture::Move(program.Block().Number(9), 0, f.Local(1));
  program.Block().JumpToNumber(9, Search::kBackward, f.IsEmpty(f.Local(1))).Finish();
  const std::string dump = f.Run(program);
  CHECK(f.result.ok);
  CHECK(Holds(dump, "space given 1..33"));
  CHECK(Holds(dump, "N9"));
  CHECK(Holds(dump, "given[1]"));
  CHECK_FALSE(Holds(dump, "else"));  // without the word nothing of the block is left
  CHECK(Holds(dump, "not"));
}

TEST_CASE("a test for emptiness tells what holds behind it") {
  Fixture f;
  ProgramBuilder program(f.module, "MACRO", ProgramKind::kSub);
  program.Block().JumpToNumber(9, Search::kForward, f.IsEmpty(f.Local(1))).Finish();
  Fixture::Move(program.Block(), 0, f.Local(1));  // a number here, on every way
  program.Block().Number(9).Finish();
  const std::string dump = f.Run(program);
  CHECK(f.result.ok);
  CHECK(Holds(dump, "axis X"));
  CHECK_FALSE(Holds(dump, "else"));
  CHECK(f.result.read_at_entry.contains({program.Id(), 1}));
}

TEST_CASE("a common variable that may be empty is refused unless it is declared") {
  for (const bool declared : {false, true}) {
    Fixture f;
    ProgramBuilder program(f.module, "MAIN");
    Fixture::Move(program.Block(), 0, f.e.Cell(f.common, 101));
    analysis::VacancyConfig config;
    config.holds_number = [&](std::uint32_t) { return declared; };
    f.Run(program, config);
    CHECK(f.result.ok == declared);
    CHECK(f.sink.HasErrors() != declared);
  }
}

TEST_CASE("the unit and the rounding of a word hide no emptiness, a written operation does") {
  Fixture f;
  ProgramBuilder program(f.module, "MAIN");
  Fixture::Move(program.Block(), 0, RoundedTo(f.module, f.Local(1), 0.001));
  Fixture::Move(program.Block(), 1, f.e.Function(Function::kRound, {f.Local(1)}));
  Fixture::Move(program.Block(), 2, f.e.Binary(ExprOp::kMultiply, f.Local(1), f.e.Number("2"), Expr::kVacantAsZero));
  const std::string dump = f.Run(program);
  CHECK(f.result.ok);
  CHECK_FALSE(Holds(dump, "axis X"));
  CHECK_FALSE(Holds(dump, "axis Y"));
  CHECK(Holds(dump, "axis Z"));
}

TEST_CASE("common cells that are read before they are written are known") {
  Fixture f;
  ProgramBuilder program(f.module, "MAIN");
  program.Block().Assign(f.e.Cell(f.common, 100), f.e.Number("1")).Finish();
  program.Block().Assign(f.Local(1), f.e.Cell(f.common, 100)).Finish();
  program.Block().Assign(f.Local(2), f.e.Cell(f.common, 101)).Finish();
  f.Run(program);
  CHECK(f.result.common_at_entry == std::set<std::uint32_t>{101});
}

TEST_CASE("an argument that is empty is a missing one") {
  Fixture f;
  ProgramBuilder sub(f.module, "SUB", ProgramKind::kSub);
  Fixture::Move(sub.Block(), 0, f.Local(1));
  Fixture::Move(sub.Block(), 1, f.Local(2));
  sub.Finish();
  ProgramBuilder program(f.module, "MAIN");
  Call call;
  call.name = f.module.strings.Intern("SUB");
  call.program = sub.Id();
  Arg first;
  first.letter = 'A';
  first.position = 1;
  first.value = f.e.Number("4");
  Arg second;
  second.letter = 'B';
  second.position = 2;
  second.value = f.Local(7);  // never written in a main program: empty
  call.args = {f.module.args.Add(first).value, 2};
  f.module.args.Add(second);
  const CallId id = f.module.calls.Add(call);
  program.Block().Add(WordOp::kCall, {}, 0, id.value).Finish();
  const std::string dump = f.Run(program);
  CHECK(f.result.ok);
  CHECK(f.module.calls[id].args.count == 1);
  CHECK(Holds(dump, "axis X"));
  CHECK_FALSE(Holds(dump, "axis Y"));
}

}  // namespace
}  // namespace ncport::ir::transform
