// Values: assignments, types, arrays, texts, comparisons, what is read from outside, and the variables at the end.
#include <doctest/doctest.h>

#include <optional>

#include "exec/memory.h"
#include "exec/texts.h"
#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

using ir::ExprOp;
using ir::Function;
using ir::Type;
using ir::WordOp;

namespace {

/// R1 after the assignment of `value`, or the last line of the trace.
template <class Make>
std::string Result(Make make) {
  RunFixture f;
  ir::ProgramBuilder program(f.module, "MAIN");
  program.Block().Assign(f.R(1), make(f)).Finish();
  f.Line(program, "M30");
  program.Finish();
  f.options.report_variables = true;
  std::string text = f.Run();
  if (text.empty()) return f.Finding();
  text.pop_back();
  const std::size_t line = text.rfind('\n');
  text = line == std::string::npos ? text : text.substr(line + 1);
  return text.starts_with("SET R1 ") ? text.substr(7) : text;
}

}  // namespace

TEST_CASE("numbers by type") {
  const auto binary = [](ExprOp op, std::string_view a, Type ta, std::string_view b, Type tb) {
    return Result([&](RunFixture& f) { return f.e.Binary(op, f.N(a, ta), f.N(b, tb)); });
  };
  CHECK(binary(ExprOp::kDivide, "3", Type::kInt, "4", Type::kInt) == "0.75");
  CHECK(binary(ExprOp::kDivide, "3", Type::kInt, "0", Type::kInt) == "ALARM arithmetic division by zero");
  CHECK(binary(ExprOp::kModulo, "3", Type::kInt, "0", Type::kInt) == "ALARM arithmetic division by zero");
  CHECK(binary(ExprOp::kDivideInteger, "3", Type::kReal, "0", Type::kInt) == "ALARM arithmetic division by zero");
  CHECK(binary(ExprOp::kAdd, "2147483647", Type::kInt, "1", Type::kInt) == "ALARM arithmetic result too large");
  CHECK(binary(ExprOp::kAdd, "2147483647", Type::kReal, "1", Type::kInt) == "2147483648");
  CHECK(binary(ExprOp::kMultiply, "99999", Type::kInt, "99999", Type::kInt) == "ALARM arithmetic result too large");
  CHECK(binary(ExprOp::kModulo, "7", Type::kInt, "4.1", Type::kReal) == "2.9");
  CHECK(binary(ExprOp::kDivideInteger, "7", Type::kInt, "0.4", Type::kReal) == "17");
  CHECK(binary(ExprOp::kBitXor, "6", Type::kInt, "3", Type::kInt) == "5");
}

TEST_CASE("operands that are rounded first, functions out of their domain") {
  CHECK(Result([](RunFixture& f) {
          return f.e.Binary(ExprOp::kModulo, f.N("7"), f.N("4.1"), ir::Expr::kOperandsToInt);
        }) == "3");
  CHECK(
      Result([](RunFixture& f) { return f.e.Function(Function::kSqrt, {f.N("-1")}); }).starts_with("ALARM arithmetic"));
  CHECK(Result([](RunFixture& f) { return f.e.Function(Function::kSquare, {f.e.Unary(ExprOp::kNegate, f.N("3"))}); }) ==
        "9");
}

TEST_CASE("comparisons with a relative tolerance (vector 08), and exact ones") {
  const auto compare = [](ExprOp op, std::uint8_t flags) {
    return Result([&](RunFixture& f) { return f.e.Binary(op, f.Add(f.N("0.1"), f.N("0.2")), f.N("0.3"), flags); });
  };
  CHECK(compare(ExprOp::kEqual, ir::Expr::kTolerance) == "1");
  CHECK(compare(ExprOp::kGreater, ir::Expr::kTolerance) == "0");
  CHECK(compare(ExprOp::kGreaterEqual, ir::Expr::kTolerance) == "1");
  CHECK(compare(ExprOp::kEqual, 0) == "0");
  CHECK(compare(ExprOp::kGreater, 0) == "1");
}

TEST_CASE("logic takes any number as truth") {
  const auto logic = [](ExprOp op, std::string_view a, std::string_view b) {
    return Result([&](RunFixture& f) { return f.e.Binary(op, f.N(a), f.N(b)); });
  };
  CHECK(logic(ExprOp::kAnd, "2", "0.5") == "1");
  CHECK(logic(ExprOp::kAnd, "2", "0") == "0");
  CHECK(logic(ExprOp::kOr, "0", "0") == "0");
  CHECK(logic(ExprOp::kXor, "2", "3") == "0");
  // AND evaluates both sides, so an error on the right is one even when the left decides.
  CHECK(Result([](RunFixture& f) {
          return f.e.Binary(ExprOp::kAnd, f.N("0"), f.e.Binary(ExprOp::kDivide, f.N("1"), f.N("0")));
        }) == "ALARM arithmetic division by zero");
}

TEST_CASE("vacant values: copies keep them, arithmetic takes zero where the language says so") {
  const auto vacant = [](std::uint8_t flags) {
    return Result([&](RunFixture& f) { return f.e.Binary(ExprOp::kAdd, f.e.Vacant(), f.N("2"), flags); });
  };
  CHECK(vacant(ir::Expr::kVacantAsZero) == "2");
  CHECK(vacant(0) == "this cannot be run: an empty value in arithmetic");
  CHECK(Result([](RunFixture& f) { return f.e.Vacant(); }) == "vacant");
  const auto equal = [](ExprOp op, bool left_vacant, std::uint8_t flags) {
    return Result(
        [&](RunFixture& f) { return f.e.Binary(op, left_vacant ? f.e.Vacant() : f.N("0"), f.e.Vacant(), flags); });
  };
  CHECK(equal(ExprOp::kEqual, true, ir::Expr::kVacantDiffers) == "1");
  CHECK(equal(ExprOp::kEqual, false, ir::Expr::kVacantDiffers) == "0");
  CHECK(equal(ExprOp::kNotEqual, false, ir::Expr::kVacantDiffers) == "1");
  CHECK(equal(ExprOp::kEqual, false, 0) == "1");
  CHECK(equal(ExprOp::kGreaterEqual, false, 0) == "1");
}

TEST_CASE_FIXTURE(RunFixture, "assignments act from left to right, before the motion of their block (vector 01)") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block()
      .Assign(R(1), N("5"))
      .Assign(R(2), Add(R(1), N("1")))
      .Assign(R(1), e.Binary(ExprOp::kMultiply, R(2), N("2")))
      .Finish();
  program.Block().Axis(0, R(1)).Motion(ir::Motion::kRapid).Assign(R(1), N("1")).Axis(1, R(1)).Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X12 Y1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "REAL to INT and cell numbers round, indices out of range are alarms (vectors 05, 51)") {
  ir::ProgramBuilder program(module, "MAIN");
  const ir::VariableId whole = program.Local("KB", Type::kInt);
  program.Block()
      .Assign(e.Variable(whole), N("2.5"))
      .Assign(e.CellAt(r, N("1.6")), e.Unary(ExprOp::kNegate, N("2.6")))
      .Finish();
  program.Block().Assign(e.CellAt(r, R(2)), N("1")).Finish();
  program.Finish();
  options.report_variables = true;
  CHECK(Run() == "ALARM index R-3 does not exist\nSET KB 3\nSET R2 -2.6\n");
}

TEST_CASE_FIXTURE(RunFixture, "definitions: start values, limits, lists in order, arrays at the end (vector 17)") {
  ir::ProgramBuilder program(module, "MAIN");
  const std::uint32_t dimensions[] = {2, 3};
  const ir::VariableId table = program.Local("TB", Type::kReal, dimensions);
  const ir::VariableId limited = program.Local("LIM", Type::kInt);
  module.variables[limited].lower_limit = I("3");
  module.variables[limited].upper_limit = I("9");
  const ir::VariableId preset = program.Local("PRE", Type::kReal);
  module.variables[preset].initial = Add(N("1"), N("0.5"));
  ir::AssignList list;
  list.values.begin = static_cast<std::uint32_t>(module.expr_items.size());
  for (const ir::ExprId item : {N("1"), N("2"), ir::ExprId{}, N("4")}) module.expr_items.push_back(item);
  list.values.count = 4;
  module.variables[table].initial_list = module.assign_lists.Add(list);
  for (const ir::VariableId id : {table, limited, preset})
    program.Block().Add(WordOp::kDefine, {}, 0, id.value).Finish();
  ir::AssignList repeat;
  repeat.place = e.Element(table, {I("1"), I("1")});
  repeat.repeat = true;
  repeat.values = {static_cast<std::uint32_t>(module.expr_items.size()), 1};
  module.expr_items.push_back(N("7"));
  program.Block().Add(WordOp::kAssignList, {}, 0, module.assign_lists.Add(repeat).value).Finish();
  program.Block().Assign(e.Variable(limited), I("10")).Finish();
  program.Finish();
  options.report_variables = true;
  CHECK(Run() ==
        "ALARM range value of LIM is above its limit\nSET TB[0,0] 1\nSET TB[0,1] 2\nSET TB[0,2] 0\nSET TB[1,0] 4\nSET "
        "TB[1,1] 7\nSET TB[1,2] 7\n"
        "SET LIM 3\nSET PRE 1.5\n");
}

TEST_CASE_FIXTURE(RunFixture, "an index outside the array is an alarm, more values than elements too") {
  ir::ProgramBuilder program(module, "MAIN");
  const std::uint32_t dimensions[] = {3};
  const ir::VariableId list = program.Local("VEC", Type::kReal, dimensions);
  program.Block().Assign(e.Element(list, {I("3")}), N("1")).Finish();
  program.Finish();
  CHECK(Run() == "ALARM index index 3 of VEC is outside 0 to 2\n");
}

TEST_CASE_FIXTURE(RunFixture, "values given from outside beat definitions, arguments beat defaults") {
  ir::ProgramBuilder program(module, "MAIN", ir::ProgramKind::kSub);
  const ir::VariableId first = program.Parameter("PA");
  const ir::VariableId second = program.Parameter("PB");
  const ir::VariableId text = program.Parameter("PT", Type::kString);
  const ir::VariableId local = program.Local("LOC");
  module.variables[second].initial = N("5");
  module.variables[local].initial = N("6");
  program.Block().Add(WordOp::kDefine, {}, 0, local.value).Finish();
  program.Block().Add(WordOp::kMessage, e.Variable(text)).Finish();
  program.Block()
      .Motion(ir::Motion::kRapid)
      .Axis(0, e.Variable(first))
      .Axis(1, e.Variable(second))
      .Axis(2, e.Variable(local))
      .Axis(3, R(3))
      .Finish();
  Line(program, "M17");
  program.Finish();
  options.is_call = true;
  options.arguments = {{0, 0, Value::Int(2), ""}, {2, 0, Value::Text(0), "hello"}};
  options.start_values = {{local, {}, 0, Value::Real(8), ""}, {{}, r, 3, Value::Real(9), ""}};
  CHECK(Run() == "MSG hello\nRAPID X2 Y5 Z8 A9\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "texts (vector 45)") {
  ir::ProgramBuilder program(module, "MAIN");
  const ir::VariableId text = program.Local("TXT", Type::kString);
  module.variables[text].string_length = 40;
  const auto tail = [&](std::initializer_list<ir::ExprId> arguments) {
    return e.Function(Function::kSubstring, arguments, Type::kString);
  };
  const auto join = [&](ir::ExprId a, ir::ExprId b) { return e.Binary(ExprOp::kConcat, a, b); };
  const auto variable = [&] { return e.Variable(text); };
  program.Block().Assign(variable(), join(join(join(e.Text("i:"), I("2")), e.Text("/v:")), N("9.654"))).Finish();
  const auto message = [&](ir::ExprId value) { program.Block().Add(WordOp::kMessage, value).Finish(); };
  message(variable());
  program.Block().Assign(R(1), e.Function(Function::kStringLength, {variable()}, Type::kInt)).Finish();
  program.Block().Assign(R(2), e.Function(Function::kIndexOf, {variable(), e.Text("/")}, Type::kInt)).Finish();
  program.Block().Assign(R(3), e.Function(Function::kLastIndexOf, {variable(), e.Text("z")}, Type::kInt)).Finish();
  program.Block().Assign(R(4), e.Function(Function::kFind, {variable(), e.Text("v:")}, Type::kInt)).Finish();
  message(tail({variable(), I("4"), I("3")}));
  message(e.Function(Function::kToUpper, {tail({variable(), I("4")})}, Type::kString));
  program.Block().Assign(R(5), e.Function(Function::kParseNumber, {e.Text("1.5EX2")})).Finish();
  program.Block().Assign(R(6), e.Function(Function::kIsNumber, {e.Text("12A")}, Type::kBool)).Finish();
  program.Block().Assign(e.Element(text, {I("0")}), e.Text("N")).Finish();
  message(variable());
  message({});
  message(e.Function(Function::kFormat, {e.Text("%5d|%8.3f|%s"), I("42"), N("2.5"), e.Text("x")}, Type::kString));
  Line(program, "M30");
  program.Finish();
  options.report_variables = true;
  CHECK(Run() ==
        "MSG i:2/v:9.654\nMSG v:9\nMSG V:9.654\nMSG N:2/v:9.654\nMSG\nMSG    42|   2.500|x\nEND\n"
        "SET TXT \"N:2/v:9.654\"\nSET R1 11\nSET R2 3\nSET R3 -1\nSET R4 4\nSET R5 150\nSET R6 0\n");
}

TEST_CASE_FIXTURE(RunFixture, "a text longer than its variable is cut, numbers are no texts") {
  ir::ProgramBuilder program(module, "MAIN");
  const ir::VariableId text = program.Local("TXT", Type::kString);
  module.variables[text].string_length = 3;
  program.Block().Assign(e.Variable(text), e.Text("abcdef")).Finish();
  program.Block().Assign(e.Variable(text), N("5")).Finish();
  program.Finish();
  options.report_variables = true;
  CHECK(Run() == "ALARM conversion value does not fit the type\nSET TXT \"abc\"\n");
}

TEST_CASE_FIXTURE(RunFixture, "a loop that builds texts stays inside its budget") {
  ir::ProgramBuilder program(module, "MAIN");
  const ir::VariableId text = program.Local("TXT", Type::kString);
  module.variables[text].string_length = 100;
  program.Block().For(R(1), N("1"), N("60000")).Finish();
  program.Block()
      .Assign(e.Variable(text), e.Binary(ExprOp::kConcat, e.Text("a text of some length, number "), R(1)))
      .Finish();
  program.Block().Add(WordOp::kEndFor).Finish();
  program.Block().Add(WordOp::kMessage, e.Variable(text)).Finish();
  Line(program, "M30");
  program.Finish();
  options.max_text_bytes = 1U << 21U;
  CHECK(Run() == "MSG a text of some length, number 60000\nEND\n");
}

TEST_CASE("texts of a pool survive compaction, a budget that is used up is told") {
  StringPool constants;
  const StringId constant = constants.Intern("constant");
  Texts texts(constants, 2000);
  Value kept[] = {texts.Add("kept"), Texts::Constant(constant), Value::Real(1), texts.Add("")};
  (void)texts.Add("dropped");
  const std::span<Value> roots[] = {kept};
  texts.Compact(roots);
  CHECK(texts.View(kept[0]) == "kept");
  CHECK(texts.View(kept[1]) == "constant");
  CHECK(texts.View(kept[3]).empty());
  (void)texts.Add(std::string(3000, 'x'));
  CHECK(texts.Full());
}

TEST_CASE_FIXTURE(RunFixture, "budgets of variables") {
  ir::ProgramBuilder program(module, "MAIN");
  const std::uint32_t dimensions[] = {60000, 1000};
  program.Local("BIG", Type::kReal, dimensions);
  Line(program, "M30");
  program.Finish();
  CHECK(Run().empty());
  CHECK(result.outcome == Outcome::kLimit);
  CHECK(Finding().find("variables of the run take more than") != std::string::npos);
}

TEST_CASE_FIXTURE(RunFixture, "what only the machine knows is asked, and refused without an answer") {
  struct Asked final : Environment {
    std::string asked;
    std::optional<Value> Read(const ir::System&, std::string_view name, const Value* indices,
                              std::size_t count) override {
      asked += fmt::format("{}[{}] ", name, count > 0 ? indices[0].number : -1);
      return Value::Real(12.5);
    }
    bool Write(const ir::System&, std::string_view name, const Value*, std::size_t, const Value& value) override {
      asked += fmt::format("{}={} ", name, value.number);
      return true;
    }
  } asked;
  ir::ProgramBuilder program(module, "MAIN");
  const ir::SystemId input = ir::AddSystem(module, "$A_INA", ir::SystemKind::kEnvironment);
  module.systems[input].writable = true;
  program.Block().Assign(R(1), e.System(input, {I("3")})).Assign(e.System(input), N("4")).Finish();
  program.Block().Motion(ir::Motion::kRapid).Axis(0, R(1)).Finish();
  Line(program, "M30");
  program.Finish();
  environment = &asked;
  CHECK(Run() == "RAPID X12.5\nEND\n");
  CHECK(asked.asked == "$A_INA[3] $A_INA=4 ");
  environment = nullptr;
  CHECK(Run().empty());
  CHECK(Finding() == "$A_INA is known only to the machine");
}

TEST_CASE_FIXTURE(RunFixture, "system variables that follow from the program") {
  ir::ProgramBuilder program(module, "MAIN");
  machine.groups = {{1, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kRapid), Id<void>::kNone, 1},
                    {1, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kLinear), Id<void>::kNone, 2},
                    {8, WordOp::kWorkOffset, 0, 0, 1},
                    {8, WordOp::kWorkOffset, 0, 54, 2}};
  const auto system = [&](ir::SystemKind kind, std::string_view name, std::uint32_t number = 0) {
    const ir::SystemId id = ir::AddSystem(module, name, kind);
    module.systems[id].number = number;
    return id;
  };
  const auto position = system(ir::SystemKind::kProgrammedPosition, "$P_EP");
  const auto group = system(ir::SystemKind::kModalGroup, "$P_GG");
  const auto feed = system(ir::SystemKind::kActiveFeed, "$P_F");
  const auto speed = system(ir::SystemKind::kActiveSpeed, "$P_S");
  const auto tool = system(ir::SystemKind::kActiveTool, "$P_TOOLNO");
  const auto edge = system(ir::SystemKind::kActiveEdge, "$P_TOOL");
  const auto third = system(ir::SystemKind::kPlaneAxis, "$P_AXN3", 3);
  const auto level = system(ir::SystemKind::kProgramLevel, "$P_STACK");
  const auto memory = system(ir::SystemKind::kUserMemory, "$AC_MARKER");
  const auto called = system(ir::SystemKind::kProgrammedTool, "$P_TOOLP");
  Line(program, "G700 G0 X1 Y2 G54 T5 M6 D2 S800 F10 G19");
  program.Block()
      .Assign(R(1), e.System(position, {e.AxisName(0)}))
      .Assign(R(2), e.System(group, {I("1")}))
      .Assign(R(3), e.System(group, {I("8")}))
      .Assign(R(4), e.System(feed))
      .Assign(R(5), e.System(speed))
      .Assign(R(6), e.System(tool))
      .Assign(R(7), e.System(edge))
      .Assign(R(8), e.Binary(ExprOp::kEqual, e.System(third), e.AxisName(0)))
      .Assign(R(9), e.System(level))
      .Assign(e.System(memory, {I("4")}), N("3"))
      .Assign(R(10), Add(e.System(memory, {I("4")}), e.System(memory, {I("5")})))
      .Assign(R(12), e.System(called))
      .Finish();
  program.Block().Assign(R(11), e.System(position, {e.AxisName(2)})).Finish();
  program.Finish();
  options.report_variables = true;
  const std::string text = Run();
  CHECK(result.outcome == Outcome::kRefused);  // nobody has placed Z
  CHECK(Finding() == "$P_EP is known only to the machine");
  module.blocks[ir::BlockId{std::size_t{2}}].words = {};
  machine.file_end_is_end = true;
  CHECK(
      Run().ends_with("END\nSET R1 1\nSET R2 1\nSET R3 2\nSET R4 10\nSET R5 800\nSET R6 5\nSET R7 2\nSET R8 1\nSET R9 "
                      "0\nSET R10 3\nSET R12 5\n"));
}

TEST_CASE_FIXTURE(RunFixture, "the tool in the spindle and the one that stands ready") {
  ir::ProgramBuilder program(module, "MAIN");
  ir::SystemId in = ir::AddSystem(module, "$P_TOOLNO", ir::SystemKind::kActiveTool);
  ir::SystemId called = ir::AddSystem(module, "$P_TOOLP", ir::SystemKind::kProgrammedTool);
  Line(program, "T5 M6");
  Line(program, "T6");
  program.Block().Assign(R(1), e.System(in)).Assign(R(2), e.System(called)).Finish();
  Line(program, "M6");
  program.Block().Assign(R(3), e.System(in)).Finish();
  Line(program, "M30");
  program.Finish();
  options.report_variables = true;
  CHECK(Run().ends_with("END\nSET R1 5\nSET R2 6\nSET R3 6\n"));
}

TEST_CASE_FIXTURE(RunFixture, "coverage: blocks, branches, cells read first, quotients") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block()
      .Assign(R(1), R(2))
      .Assign(R(2), R(2))
      .Assign(R(3), e.Binary(ExprOp::kDivideInteger, N("7"), N("2")))
      .Finish();
  program.Block().Jump("A", ir::Search::kForward, e.Binary(ExprOp::kGreater, R(3), N("5"))).Finish();
  Line(program, "M30");
  Words(program.Block().Label("A"), "G0 X1").Finish();
  program.Finish();
  Run();
  CHECK(coverage.blocks == std::vector<std::uint8_t>{1, 1 | 4, 1, 0});
  CHECK(coverage.cells_read_before_written == std::vector<std::uint32_t>{2});
  CHECK(coverage.quotients.size() == 1);
  CHECK(coverage.quotients[0].numerator == 7);
}

TEST_CASE_FIXTURE(RunFixture, "cells whose start value nobody knows are refused when they are read first") {
  module.spaces[r].start = ir::StartValue::kUnknown;
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Assign(R(1), N("1")).Assign(R(2), R(1)).Assign(R(3), R(4)).Finish();
  program.Finish();
  Run();
  CHECK(result.outcome == Outcome::kRefused);
}

TEST_CASE_FIXTURE(RunFixture, "stores of the eight digit rule") {
  machine.numeric_model = ir::NumericModel::kNum8;
  ir::ProgramBuilder program(module, "MAIN");
  program.Block()
      .Assign(R(1), e.Binary(ExprOp::kDivide, N("200"), N("3")))
      .Assign(R(2), e.Binary(ExprOp::kMultiply, R(1), N("3")))
      .Finish();
  program.Block().Assign(R(3), Add(N("99999999"), N("1"))).Finish();
  program.Finish();
  options.report_variables = true;
  CHECK(Run() == "ALARM arithmetic result too large\nSET R1 66.666666\nSET R2 199.99999\n");
}

TEST_CASE("memory: addresses of the fixed part and of the stack are one space") {
  Memory memory(10, 100);
  CHECK(memory.Ok());
  const Memory::Address frame = memory.Push(5);
  CHECK(frame == 10);
  memory[frame + 4] = Value::Int(3);
  memory[2] = Value::Int(4);
  CHECK(memory[frame + 4].number == 3);
  CHECK(memory.Push(100) == Memory::kNoRoom);
  memory.Pop(frame);
  CHECK(memory.Top() == 10);
  CHECK(!Memory(101, 100).Ok());
}

}  // namespace ncport::exec
