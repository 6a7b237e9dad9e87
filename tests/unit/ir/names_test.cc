#include <doctest/doctest.h>

#include <set>
#include <string>

#include "ir/enum_names.h"
#include "ir/module.h"

using namespace ncport;
using namespace ncport::ir;

TEST_CASE("ir names: rows of nodes.def are read back in their own order") {
  CHECK(NameOf(WordOp::kMotion) == "motion");
  CHECK(NameOf(WordOp::kVerbatim) == "verbatim");
  CHECK(NameOf(ExprOp::kLiteral) == "literal");
  CHECK(NameOf(ExprOp::kFunction) == "call");
  CHECK(NameOf(Function::kSin) == "sin");
  CHECK(NameOf(Function::kIsAxis) == "is-axis");
  CHECK(NameOf(Type::kAny) == "any");
  CHECK(ValueUseOf(WordOp::kJump) == ValueUse::kMay);
  CHECK(ValueUseOf(WordOp::kAxis) == ValueUse::kMust);
  CHECK(ValueUseOf(WordOp::kStop) == ValueUse::kNever);
  CHECK(DefaultPhaseOf(WordOp::kStop) == Phase::kAfter);
  CHECK(OperandsOf(ExprOp::kCellAt) == Operands::kUnary);
  CHECK(OperandsOf(ExprOp::kConcat) == Operands::kBinary);
  CHECK(ArityOf(Function::kSubstring).least == 2);
  CHECK(ArityOf(Function::kSubstring).most == 3);
}

TEST_CASE("ir names: no two rows of one list share a name") {
  std::set<std::string_view> names;
  for (unsigned i = 0; i <= static_cast<unsigned>(WordOp::kVerbatim); ++i) {
    CHECK(names.insert(NameOf(static_cast<WordOp>(i))).second);
  }
  names.clear();
  for (unsigned i = 0; i <= static_cast<unsigned>(ExprOp::kFunction); ++i) {
    CHECK(names.insert(NameOf(static_cast<ExprOp>(i))).second);
  }
  names.clear();
  for (unsigned i = 0; i <= static_cast<unsigned>(Function::kIsAxis); ++i) {
    CHECK(names.insert(NameOf(static_cast<Function>(i))).second);
  }
}

TEST_CASE("ir names: values outside the lists have no name and break nothing") {
  CHECK(NameOf(static_cast<WordOp>(250)).empty());
  CHECK(NameOf(static_cast<ExprOp>(250)).empty());
  CHECK(NameOf(static_cast<Function>(250)).empty());
  CHECK(NameOf(static_cast<Type>(250)).empty());
  CHECK(NameOf(static_cast<Motion>(250)).empty());
  CHECK_FALSE(IsKnown(static_cast<Plane>(9)));
  CHECK(IsKnown(Plane::kYZ));
}

TEST_CASE("ir names: small lists read both ways") {
  CHECK(FromName<Motion>("arc-ccw") == Motion::kArcCcw);
  CHECK(FromName<ReturnLevel>("r-plane") == ReturnLevel::kRPlane);
  CHECK(FromName<Type>("number") == Type::kNumber);
  CHECK_FALSE(FromName<Motion>("arc").has_value());
  for (unsigned i = 0; i <= static_cast<unsigned>(SystemKind::kUserMemory); ++i) {
    const auto kind = static_cast<SystemKind>(i);
    CHECK(FromName<SystemKind>(NameOf(kind)) == kind);
  }
}

TEST_CASE("ir names: structure marks are If to EndFor") {
  CHECK(IsStructureMark(WordOp::kIf));
  CHECK(IsStructureMark(WordOp::kUntil));
  CHECK(IsStructureMark(WordOp::kEndFor));
  CHECK_FALSE(IsStructureMark(WordOp::kRestart));
  CHECK_FALSE(IsStructureMark(WordOp::kVerbatim));
}

TEST_CASE("ir module: places of words and expressions lie in the line of their block") {
  Module module;
  Block block;
  CHECK_FALSE(module.RangeOf(block).Valid());
  Origin origin;
  origin.file = FileId{std::size_t{2}};
  origin.line = 7;
  block.origin = module.origins.Add(origin);
  Word word;
  word.begin = 4;
  word.length = 3;
  CHECK(module.RangeOf(block, word) == SourceRange{FileId{std::size_t{2}}, 7, 4, 7});
  const ExprId expr = module.AddExpr(Expr{}, {9, 2});
  CHECK(module.RangeOf(block, expr) == SourceRange{FileId{std::size_t{2}}, 7, 9, 11});
  CHECK(module.RangeOf(block) == SourceRange{FileId{std::size_t{2}}, 7, 0, 0});
}

TEST_CASE("ir module: programs are found with and without regard to case") {
  Module module;
  Program program;
  program.name = module.strings.Intern("Ring");
  module.programs.Add(program);
  program.name = module.strings.Intern("RING");
  const ProgramId second = module.programs.Add(program);
  CHECK(module.FindProgram("RING", false) == second);
  CHECK(module.FindProgram("ring", true) == ProgramId{std::size_t{0}});
  CHECK_FALSE(module.FindProgram("ring", false).Valid());
  CHECK_FALSE(module.FindProgram("RIN", true).Valid());
}
