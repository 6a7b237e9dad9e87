// Jumps, structures, parts, calls: vectors 09 to 28, 63, 65, 68, and budgets.
#include <doctest/doctest.h>

#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

using ir::Search;
using ir::WordOp;

namespace {

/// R1=R1+<step>
void Count(RunFixture& f, ir::ProgramBuilder& program, std::string_view step = "1") {
  program.Block().Assign(f.R(1), f.Add(f.R(1), f.N(step))).Finish();
}
/// G0 X=R1
void Show(RunFixture& f, ir::ProgramBuilder& program, std::uint8_t axis = 0) {
  program.Block().Motion(ir::Motion::kRapid).Axis(axis, f.R(1)).Finish();
}
ir::ExprId Compare(RunFixture& f, ir::ExprOp op, ir::ExprId left, std::string_view right) {
  return f.e.Binary(op, left, f.N(right), ir::Expr::kTolerance);
}
void Mark(ir::ProgramBuilder& program, WordOp op, ir::ExprId condition = {}) {
  program.Block().Add(op, condition).Finish();
}

}  // namespace

TEST_CASE_FIXTURE(RunFixture, "the nearest label in the direction of the search (vector 09)") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Jump("PT_A", Search::kForward).Finish();
  Line(program, "G0 X99");
  program.Block().Label("PT_A").Assign(R(1), Add(R(1), N("1"))).Finish();
  Show(*this, program);
  program.Block().Jump("PT_A", Search::kForward, Compare(*this, ir::ExprOp::kGreaterEqual, R(1), "2")).Finish();
  program.Block().Jump("pt_a", Search::kBackward).Finish();
  program.Block().Label("PT_A").Motion(ir::Motion::kRapid).Axis(1, R(1)).Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X1\nRAPID X2\nRAPID X2 Y2\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a missing target is an alarm when the jump runs, never for a quiet jump (vector 12)") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Jump("NOWHERE_1", Search::kForwardThenBackward).Finish();
  module.jumps[ir::JumpId{std::size_t{0}}].quiet = true;
  Line(program, "G0 X1");
  program.Block().Jump("NOWHERE_2", Search::kForward, Compare(*this, ir::ExprOp::kEqual, R(1), "2")).Finish();
  program.Block().Jump("NOWHERE_3", Search::kForward).Finish();
  Line(program, "G0 X2");
  program.Finish();
  CHECK(Run() == "RAPID X1\nALARM target jump target NOWHERE_3 not found\n");
  CHECK(coverage.blocks[2] == (1 | 4));
  CHECK(coverage.blocks[4] == 0);
}

TEST_CASE_FIXTURE(RunFixture, "labels of skipped blocks are not there") {
  const auto run = [](std::uint16_t levels) {
    RunFixture f;
    f.options.skip_levels = levels;
    ir::ProgramBuilder program(f.module, "MAIN");
    program.Block().Jump("A", Search::kForward).Finish();
    f.Words(program.Block().Label("A").Skip(1), "G0 X1").Finish();
    f.Words(program.Block().Label("A"), "G0 X2").Finish();
    f.Line(program, "M30");
    program.Finish();
    return f.Run();
  };
  CHECK(run(0) == "RAPID X1\nRAPID X2\nEND\n");
  CHECK(run(1) == "RAPID X1\nRAPID X2\nEND\n");
  CHECK(run(2) == "RAPID X2\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a computed target is a label or a block number") {
  const auto run = [](auto make) {
    RunFixture f;
    ir::ProgramBuilder program(f.module, "MAIN");
    ir::BlockBuilder jump = program.Block();
    jump.Jump("", Search::kForwardThenFromStart);
    f.module.jumps[ir::JumpId{std::size_t{0}}].target = {ir::TargetKind::kExpression, {}, 0, make(f)};
    jump.Finish();
    f.Line(program, "G0 X1");
    f.Words(program.Block().Number(40).Label("L2"), "G0 X2").Finish();
    f.Line(program, "M30");
    program.Finish();
    return f.Run();
  };
  const std::string jumped = "RAPID X2\nEND\n";
  CHECK(run([](RunFixture& f) { return f.e.Text("l2"); }) == jumped);
  CHECK(run([](RunFixture& f) { return f.e.Text("N040"); }) == jumped);
  CHECK(run([](RunFixture& f) { return f.e.Text("40"); }) == jumped);
  CHECK(run([](RunFixture& f) { return f.N("40"); }) == jumped);
  CHECK(run([](RunFixture& f) { return f.e.Binary(ir::ExprOp::kConcat, f.e.Text("L"), f.I("2")); }) == jumped);
  CHECK(run([](RunFixture& f) { return f.e.Text("N41"); }) == "ALARM target jump target N41 not found\n");
}

TEST_CASE_FIXTURE(RunFixture,
                  "a switch rounds its value and takes the first arm that agrees, or the default (vector 14)") {
  ir::ProgramBuilder program(module, "MAIN");
  const auto jump = [&](std::string_view label) {
    ir::Jump record;
    record.target.label = module.strings.Intern(label);
    return module.jumps.Add(record);
  };
  module.switch_arms = {{N("7"), jump("SEVEN")}, {N("9"), jump("NINE")}, {{}, jump("OTHER")}};
  const ir::SwitchId arms = module.switches.Add({0, 3});
  program.Block().Add(WordOp::kSwitch, Add(R(1), N("6.6")), 0, arms.value).Finish();
  Words(program.Block().Label("NINE"), "G0 X9").Finish();
  Line(program, "M30");
  Words(program.Block().Label("OTHER"), "G0 X1").Finish();
  Words(program.Block().Label("SEVEN"), "G0 X7").Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X7\nEND\n");
  options.start_values = {{{}, r, 1, Value::Real(2), ""}};
  CHECK(Run() == "RAPID X9\nEND\n");
  options.start_values = {{{}, r, 1, Value::Real(20), ""}};
  CHECK(Run() == "RAPID X1\nRAPID X7\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "while, until, loop, if and else (vector 16)") {
  ir::ProgramBuilder program(module, "MAIN");
  Mark(program, WordOp::kWhile, Compare(*this, ir::ExprOp::kLess, R(1), "2"));
  Count(*this, program);
  Show(*this, program);
  Mark(program, WordOp::kEndWhile);
  Mark(program, WordOp::kRepeat);
  Count(*this, program, "10");
  Show(*this, program);
  Mark(program, WordOp::kUntil, Compare(*this, ir::ExprOp::kGreater, R(1), "5"));
  Mark(program, WordOp::kLoop);
  Count(*this, program, "-4");
  program.Block().Jump("OUT", Search::kForward, Compare(*this, ir::ExprOp::kLess, R(1), "0")).Finish();
  Mark(program, WordOp::kIf, Compare(*this, ir::ExprOp::kGreater, R(1), "5"));
  Show(*this, program);
  Mark(program, WordOp::kElse);
  Show(*this, program, 1);
  Mark(program, WordOp::kEndIf);
  Mark(program, WordOp::kEndLoop);
  Words(program.Block().Label("OUT"), "G0 Z0").Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X1\nRAPID X2\nRAPID X12\nRAPID X8\nRAPID X8 Y4\nRAPID X8 Y0\nRAPID X8 Y0 Z0\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a counting loop includes its end; start over the end is no pass (vectors 15, 68)") {
  const auto run = [](std::string_view start, std::string_view end, auto change) {
    RunFixture f;
    ir::ProgramBuilder program(f.module, "MAIN");
    f.machine.start.motion = ir::Motion::kRapid;
    change(f);
    program.Block().Assign(f.R(2), f.N(end)).Finish();
    program.Block().For(f.R(1), f.N(start), f.R(2)).Finish();
    Show(f, program);
    program.Block().Assign(f.R(2), f.N("2")).Finish();
    Mark(program, WordOp::kEndFor);
    Show(f, program, 1);
    f.Line(program, "M30");
    program.Finish();
    return f.Run();
  };
  const auto nothing = [](RunFixture&) {};
  CHECK(run("1", "3", nothing) == "RAPID X1\nRAPID X2\nRAPID X3\nRAPID X3 Y4\nEND\n");
  CHECK(run("5", "4", nothing) == "RAPID Y5\nEND\n");
  CHECK(run("1", "3", [](RunFixture& f) { f.machine.for_end_once = false; }) ==
        "RAPID X1\nRAPID X2\nRAPID X2 Y3\nEND\n");
  CHECK(run("1.6", "3", nothing) == "RAPID X2\nRAPID X3\nRAPID X3 Y4\nEND\n");
  CHECK(run("1.6", "3", [](RunFixture& f) { f.machine.for_counter_rounds = false; }) ==
        "RAPID X1.6\nRAPID X2.6\nRAPID X2.6 Y3.6\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "parts run again: one block, two labels, up to the end label (vectors 19, 20, 21, 65)") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Label("BLK").Assign(R(1), Add(R(1), N("5"))).Finish();
  Show(*this, program);
  ir::BlockBuilder one = program.Block();
  one.RepeatPart("BLK", "", N("3"));
  module.parts[ir::PartId{std::size_t{0}}].single = true;
  one.Finish();
  Show(*this, program);
  program.Block().RepeatPart("BEG", "FIN", N("2")).Finish();
  program.Block().Jump("OVER", Search::kForward).Finish();
  program.Block().Label("BEG").Assign(R(1), Add(R(1), N("100"))).Finish();
  Show(*this, program, 1);
  Words(program.Block().Label("FIN"), "G90").Finish();
  Words(program.Block().Label("OVER"), "M30").Finish();
  program.Finish();
  CHECK(Run() == "RAPID X5\nRAPID X20\nRAPID X20 Y120\nRAPID X20 Y220\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "parts nest, and a jump out of a part ends it") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Jump("MAIN", Search::kForward).Finish();
  program.Block().Label("IN").Assign(R(1), Add(R(1), N("1"))).Finish();
  program.Block().Label("OUT").RepeatPart("IN", "IN", N("2")).Finish();
  program.Block().Label("OUTEND").Assign(R(1), Add(R(1), N("100"))).Finish();
  Words(program.Block().Label("MAIN"), "").RepeatPart("OUT", "OUTEND", N("3")).Finish();
  Show(*this, program);
  program.Block().RepeatPart("LEAVE", "LEAVEEND", N("5")).Finish();
  Line(program, "G0 Y1");
  program.Block().Label("LEAVE").Jump("BYE", Search::kForward).Finish();
  program.Block().Label("LEAVEEND").Finish();
  Words(program.Block().Label("BYE"), "G0 Z1").Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X306\nRAPID X306 Z1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a missing section is an alarm") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().RepeatPart("A", "B", N("2")).Finish();
  program.Finish();
  CHECK(Run() == "ALARM target section A not found\n");
}

namespace {

/// MAIN calls SUB, which is built by `body`; MAIN then moves to R1.
template <class Body>
std::string CallOnce(RunFixture& f, Body body, std::initializer_list<ir::ExprId> arguments = {},
                     ir::ExprId passes = {}) {
  ir::ProgramBuilder sub(f.module, "SUB", ir::ProgramKind::kSub);
  body(sub);
  sub.Finish();
  ir::ProgramBuilder program(f.module, "MAIN");
  program.Block().Call(sub.Id(), arguments, passes).Finish();
  Show(f, program);
  f.Line(program, "M30");
  program.Finish();
  f.options.entry = program.Id();
  return f.Run();
}

}  // namespace

TEST_CASE_FIXTURE(RunFixture, "passes: locals are new in each, the range of the count (vectors 22, 27)") {
  const auto body = [&](ir::ProgramBuilder& sub) {
    const ir::VariableId local = sub.Local("KN", ir::Type::kInt);
    sub.Block().Assign(e.Variable(local), Add(e.Variable(local), I("1"))).Finish();
    sub.Block().Motion(ir::Motion::kRapid).Axis(1, e.Variable(local)).Finish();
    Count(*this, sub);
    Line(sub, "M17");
  };
  CHECK(CallOnce(*this, body, {}, N("3")) == "RAPID Y1\nRAPID Y1\nRAPID Y1\nRAPID X3 Y1\nEND\n");
  RunFixture none;
  CHECK(CallOnce(
            none, [&](ir::ProgramBuilder& sub) { none.Line(sub, "M17"); }, {}, none.N("0")) ==
        "ALARM range 0 passes\n");
}

TEST_CASE_FIXTURE(RunFixture, "arguments: by value with defaults, each pass gets them again (vector 23)") {
  const auto body = [&](ir::ProgramBuilder& sub) {
    const ir::VariableId x = sub.Parameter("PX");
    const ir::VariableId y = sub.Parameter("PY");
    const ir::VariableId z = sub.Parameter("PZ", ir::Type::kInt);
    module.variables[y].initial = N("7");
    Words(sub.Block().Motion(ir::Motion::kRapid).Axis(0, e.Variable(x)).Axis(1, e.Variable(y)).Axis(2, e.Variable(z)),
          "")
        .Finish();
    sub.Block().Assign(e.Variable(x), N("99")).Finish();
    Line(sub, "M17");
  };
  CHECK(CallOnce(*this, body, {N("1"), {}, N("2.5")}, N("2")) ==
        "RAPID X1 Y7 Z3\nRAPID X1 Y7 Z3\nRAPID X0 Y7 Z3\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "by reference: variables, elements, whole arrays, cells (vectors 24, 25)") {
  ir::ProgramBuilder sub(module, "SUB", ir::ProgramKind::kSub);
  const ir::VariableId a = sub.Parameter("PA", ir::Type::kReal, true);
  const ir::VariableId list = sub.Parameter("PL", ir::Type::kReal, true);
  module.variables[list].dimension_count = 1;
  sub.Block().Assign(e.Variable(a), Add(e.Variable(a), N("1"))).Finish();
  sub.Block().Assign(e.Element(list, {I("2")}), e.Variable(a)).Finish();
  Line(sub, "M17");
  sub.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  const std::uint32_t dimensions[] = {3};
  const ir::VariableId vector = program.Local("VEC", ir::Type::kReal, dimensions);
  program.Block().Call(sub.Id(), {R(5), e.Variable(vector)}).Finish();
  program.Block().Call(sub.Id(), {e.Element(vector, {I("0")}), e.Variable(vector)}).Finish();
  program.Block()
      .Motion(ir::Motion::kRapid)
      .Axis(0, R(5))
      .Axis(1, e.Element(vector, {I("0")}))
      .Axis(2, e.Element(vector, {I("2")}))
      .Finish();
  program.Block().Call(sub.Id(), {}).Finish();
  Line(program, "M30");
  program.Finish();
  options.entry = program.Id();
  CHECK(Run() == "RAPID X1 Y1 Z1\nALARM other argument by reference is missing\n");
}

TEST_CASE_FIXTURE(RunFixture, "modal state stays as the subprogram left it, or is put back with SAVE (vector 26)") {
  const auto run = [](bool saves, ir::PathMode path = ir::PathMode::kExact) {
    RunFixture f;
    f.machine.start.path = path;
    ir::ProgramBuilder sub(f.module, "SUB", ir::ProgramKind::kSub);
    f.Line(sub, "G91 X1");
    f.Line(sub, "TRANS X100 F5 G64");
    f.Line(sub, "M17");
    sub.Finish();
    f.module.programs[sub.Id()].saves_modal_state = saves;
    ir::ProgramBuilder program(f.module, "MAIN");
    f.Line(program, "G90 G0 X10");
    program.Block().Call(sub.Id()).Finish();
    f.Line(program, "X5");
    f.Line(program, "G1 X6");
    f.Line(program, "M30");
    program.Finish();
    f.options.entry = program.Id();
    return f.Run();
  };
  CHECK(run(false) == "RAPID X10\nRAPID X11\nPATH CONTINUOUS\nRAPID X16\nLINE X22 F5\nEND\n");
  CHECK(run(true) == "RAPID X10\nRAPID X11\nPATH CONTINUOUS\nPATH EXACT\nRAPID X5\nLINE X6 F5\nEND\n");
  // A mode that no word ever named has no line.
  CHECK(run(true, ir::PathMode::kUnknown) == "RAPID X10\nRAPID X11\nPATH CONTINUOUS\nRAPID X5\nLINE X6 F5\nEND\n");
}

TEST_CASE_FIXTURE(
    RunFixture, "an end word in a called program returns; return words in the main program end it or start it again") {
  CHECK(CallOnce(*this, [&](ir::ProgramBuilder& sub) { Line(sub, "G0 Y1 M30"); }) == "RAPID Y1\nRAPID X0 Y1\nEND\n");
  RunFixture total;
  total.machine.end_in_called_program_returns = false;
  CHECK(CallOnce(total, [&](ir::ProgramBuilder& sub) { total.Line(sub, "G0 Y1 M30"); }) == "RAPID Y1\nEND\n");
  RunFixture ends;
  CHECK(ends.Trace({"G0 X1", "M17", "X2"}) == "RAPID X1\n");
  RunFixture endless;
  endless.machine.return_in_main_restarts = true;
  endless.options.max_blocks = 100;
  endless.Trace({"G0 X1", "M17"});
  CHECK(endless.result.outcome == Outcome::kLimit);
  CHECK(endless.sink.All().front().help.find("--max-blocks") != std::string::npos);
}

TEST_CASE_FIXTURE(RunFixture, "a file that ends without an end word") {
  const auto run = [](bool allowed) {
    RunFixture f;
    f.machine.file_end_is_end = allowed;
    return CallOnce(f, [&](ir::ProgramBuilder& sub) { f.Line(sub, "G0 Y1"); });
  };
  CHECK(run(false) == "RAPID Y1\nALARM end program SUB has no end\n");
  CHECK(run(true) == "RAPID Y1\nRAPID X0 Y1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "back to a label of the caller") {
  ir::ProgramBuilder sub(module, "SUB", ir::ProgramKind::kSub);
  sub.Block().Add(WordOp::kReturn, e.Text("BACK"), static_cast<std::uint8_t>(ir::ReturnKind::kToCaller)).Finish();
  sub.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Call(sub.Id(), {}, N("3")).Finish();
  Line(program, "G0 X1");
  Words(program.Block().Label("BACK"), "G0 X2").Finish();
  Line(program, "M30");
  program.Finish();
  options.entry = program.Id();
  CHECK(Run() == "RAPID X2\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "calls too deep, programs that nobody has, names that are computed") {
  ir::ProgramBuilder sub(module, "SUB", ir::ProgramKind::kSub);
  Count(*this, sub);
  sub.Block().Call(ir::ProgramId{std::size_t{0}}).Finish();
  Line(sub, "M17");
  sub.Finish();
  machine.call_depth = 3;
  options.report_variables = true;
  options.entry = sub.Id();
  CHECK(Run() == "ALARM nesting calls nested too deep\nSET R1 4\n");

  RunFixture named;
  ir::ProgramBuilder target(named.module, "TARGET", ir::ProgramKind::kSub);
  named.Line(target, "G0 X1 M17");
  target.Finish();
  ir::ProgramBuilder program(named.module, "MAIN");
  const auto call = [&](std::string_view name) {
    ir::BlockBuilder block = program.Block();
    block.Call(target.Id());
    ir::Call& record = named.module.calls[ir::CallId{named.module.calls.Size() - 1}];
    record.program = {};
    record.name = {};
    record.form = ir::CallForm::kText;
    record.name_expr = named.e.Text(name);
    block.Finish();
  };
  call("/_N_SPF_DIR/_N_target_SPF");
  call("OTHER");
  named.Line(program, "M30");
  program.Finish();
  named.options.entry = program.Id();
  CHECK(named.Run() == "RAPID X1\n");
  CHECK(named.Finding() == "program OTHER was not found");
}

TEST_CASE_FIXTURE(RunFixture,
                  "a modal call runs after each block with motion, also in called programs (vectors 28, 63)") {
  ir::ProgramBuilder drill(module, "DRILL", ir::ProgramKind::kSub);
  const ir::VariableId depth = drill.Parameter("DEPTH");
  const ir::VariableId count = drill.Local("COUNT", ir::Type::kInt);
  drill.Block().Add(WordOp::kDefine, {}, 0, count.value).Finish();
  drill.Block().Assign(e.Variable(count), Add(e.Variable(count), I("1"))).Finish();
  Words(drill.Block().Motion(ir::Motion::kLinear).Axis(2, e.Variable(depth)), "F100").Finish();
  Words(drill.Block().Motion(ir::Motion::kRapid).Axis(2, e.Variable(count)), "M17").Finish();
  drill.Finish();
  ir::ProgramBuilder holes(module, "HOLES", ir::ProgramKind::kSub);
  Line(holes, "G0 X5");
  Line(holes, "M17");
  holes.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  Line(program, "G0 X0");
  program.Block().Assign(R(1), N("-2")).Finish();
  ir::BlockBuilder modal = program.Block();
  modal.Call(drill.Id(), {R(1)});
  modal.Last().op = WordOp::kModalCall;
  modal.Finish();
  program.Block().Assign(R(1), N("-9")).Finish();
  Line(program, "X1");
  Line(program, "M=8");
  program.Block().Call(holes.Id()).Finish();
  program.Block().Add(WordOp::kModalCall).Finish();
  Line(program, "X9");
  Line(program, "M30");
  program.Finish();
  options.entry = program.Id();
  // The argument was taken once; COUNT keeps its value between the runs; the moves of DRILL do not start it again.
  const std::string expected =
      "RAPID X0\nRAPID X1\nLINE X1 Z-2 F100\nRAPID X1 Z1\nM8\nRAPID X5 Z1\nLINE X5 Z-2 F100\nRAPID X5 Z2\nRAPID X9 "
      "Z2\nEND\n";
  CHECK(Run() == expected);
  machine.modal_call_keeps_locals = false;
  CHECK(Run() ==
        "RAPID X0\nRAPID X1\nLINE X1 Z-2 F100\nRAPID X1 Z1\nM8\nRAPID X5 Z1\nLINE X5 Z-2 F100\nRAPID X5 Z1\nRAPID X9 "
        "Z1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a block with motion and end word: the modal subprogram runs before the end") {
  ir::ProgramBuilder drill(module, "DRILL", ir::ProgramKind::kSub);
  Line(drill, "G0 Z1 M17");
  drill.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  ir::BlockBuilder modal = program.Block();
  modal.Call(drill.Id());
  modal.Last().op = WordOp::kModalCall;
  modal.Finish();
  Line(program, "G0 X1 M30");
  Line(program, "X9");
  program.Finish();
  options.entry = program.Id();
  CHECK(Run() == "RAPID X1\nRAPID X1 Z1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a call of a block range runs both ends and comes back") {
  ir::ProgramBuilder program(module, "MAIN");
  Line(program, "G0 X0");
  ir::BlockBuilder call = program.Block();
  call.Call(program.Id());
  ir::Call& record = module.calls[ir::CallId{module.calls.Size() - 1}];
  record.program = {};
  record.name = {};
  record.form = ir::CallForm::kBlockRange;
  record.from.label = module.strings.Intern("A");
  record.to.label = module.strings.Intern("B");
  call.Finish();
  Line(program, "G0 Y1");
  Line(program, "M30");
  Words(program.Block().Label("A"), "G0 X1").Finish();
  Words(program.Block().Label("B"), "G0 X2").Finish();
  program.Finish();
  CHECK(Run() == "RAPID X0\nRAPID X1\nRAPID X2\nRAPID X2 Y1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "a jump out of a called range is refused") {
  ir::ProgramBuilder program(module, "MAIN");
  ir::BlockBuilder call = program.Block();
  call.Call(program.Id());
  ir::Call& record = module.calls[ir::CallId{module.calls.Size() - 1}];
  record.program = {};
  record.name = {};
  record.form = ir::CallForm::kBlockRange;
  record.from.label = module.strings.Intern("A");
  record.to.label = module.strings.Intern("A");
  call.Finish();
  Line(program, "M30");
  program.Block().Label("A").Jump("B", Search::kForward).Finish();
  Words(program.Block().Label("B"), "M30").Finish();
  program.Finish();
  Run();
  CHECK(Finding().find("out of a called range") != std::string::npos);
}

TEST_CASE_FIXTURE(RunFixture, "levels of locals: a call may open one or share that of its caller") {
  const ir::SpaceId locals = ir::AddSpace(module, "#", 1, 33, ir::Type::kNumber, ir::StartValue::kVacant);
  module.spaces[locals].visibility = ir::Visibility::kLevel;
  ir::ProgramBuilder fresh(module, "FRESH", ir::ProgramKind::kSub);
  fresh.Block().Motion(ir::Motion::kRapid).Axis(0, e.Cell(locals, 1)).Finish();
  fresh.Block().Assign(e.Cell(locals, 1), N("5")).Finish();
  Line(fresh, "M17");
  fresh.Finish();
  ir::ProgramBuilder shared(module, "SHARED", ir::ProgramKind::kSub);
  shared.Block().Assign(e.Cell(locals, 1), N("9")).Finish();
  Line(shared, "M17");
  shared.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Assign(e.Cell(locals, 1), N("1")).Finish();
  ir::BlockBuilder macro = program.Block();
  macro.Call(fresh.Id());
  const ir::ArgId arg = module.args.Add({N("2"), 1, 'A'});
  module.calls[ir::CallId{module.calls.Size() - 1}].args = {arg.value, 1};
  macro.Finish();
  program.Block().Motion(ir::Motion::kRapid).Axis(1, e.Cell(locals, 1)).Finish();
  ir::BlockBuilder sub = program.Block();
  sub.Call(shared.Id());
  module.calls[ir::CallId{module.calls.Size() - 1}].new_level = false;
  sub.Finish();
  program.Block().Motion(ir::Motion::kRapid).Axis(2, e.Cell(locals, 1)).Finish();
  Line(program, "M30");
  program.Finish();
  options.entry = program.Id();
  options.report_variables = true;
  CHECK(Run() == "RAPID X2\nRAPID X2 Y1\nRAPID X2 Y1 Z9\nEND\nSET #1 9\n");
}

TEST_CASE_FIXTURE(RunFixture, "variables of the main program are not seen below unless they were resolved to be") {
  ir::ProgramBuilder sub(module, "SUB", ir::ProgramKind::kSub);
  ir::ProgramBuilder* open = &sub;
  const ir::VariableId own = open->Local("PUD");
  sub.Block().Motion(ir::Motion::kRapid).Axis(0, e.Variable(own)).Finish();
  Line(sub, "M17");
  sub.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Assign(e.Variable(own), N("4")).Finish();
  program.Finish();
  module.variables[own].scope = ir::Scope::kProgram;
  options.entry = program.Id();
  // The variable belongs to SUB, which is not the entry: MAIN cannot reach it.
  Run();
  CHECK(result.outcome == Outcome::kRefused);
}

TEST_CASE_FIXTURE(RunFixture, "words behind a condition or a skip switch in the block") {
  ir::ProgramBuilder program(module, "MAIN");
  ir::BlockBuilder when = program.Block();
  when.Add(WordOp::kWhen, Compare(*this, ir::ExprOp::kEqual, R(1), "1"));
  Words(when, "G0 X1").Finish();
  ir::BlockBuilder then = program.Block();
  then.Add(WordOp::kWhen, Compare(*this, ir::ExprOp::kEqual, R(1), "0"));
  Words(then, "G0 X2").Finish();
  ir::BlockBuilder skip = program.Block();
  Words(skip, "G0 Y1");
  skip.Add(WordOp::kSkipRest, {}, 2);
  Words(skip, "M=8").Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "RAPID X2\nM8\nRAPID X2 Y1\nEND\n");
  options.skip_levels = 4;
  CHECK(Run() == "RAPID X2\nRAPID X2 Y1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "refused blocks stop the run only when they are reached") {
  const auto run = [](bool reach) {
    RunFixture f;
    ir::ProgramBuilder program(f.module, "MAIN");
    if (!reach) program.Block().Jump("OVER", Search::kForward).Finish();
    program.Block()
        .Flags(ir::Block::kRefused)
        .Add(WordOp::kVerbatim, {}, 0, f.module.strings.Intern("?").value)
        .Finish();
    f.Words(program.Block().Label("OVER"), "G0 X1 M30").Finish();
    program.Finish();
    return std::pair(f.Run(), f.result.outcome);
  };
  CHECK(run(true) == std::pair(std::string(), Outcome::kRefused));
  CHECK(run(false) == std::pair(std::string("RAPID X1\nEND\n"), Outcome::kEnded));
}

TEST_CASE_FIXTURE(RunFixture, "the block budget ends an endless loop with the option that raises it") {
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Label("A").Jump("A", Search::kBackward).Finish();
  program.Finish();
  options.max_blocks = 1000;
  CHECK(Run().empty());
  CHECK(result.outcome == Outcome::kLimit);
  CHECK(result.blocks_executed == 1000);
}

TEST_CASE_FIXTURE(RunFixture, "events know the calls that lead to them and their turns") {
  struct Watch final : EventSink {
    std::string seen;
    bool OnEvent(const Event& event) override {
      if (event.frames == nullptr || event.kind != EventKind::kRapid) return true;
      for (std::uint32_t i = 0; i < event.frames->depth; ++i)
        seen += fmt::format("{}x{} ", event.frames->call_blocks[i].value, event.frames->turns[i]);
      seen += fmt::format("{}x{};", event.block.value, event.frames->turns[event.frames->depth]);
      return true;
    }
  } watch;
  ir::ProgramBuilder sub(module, "SUB", ir::ProgramKind::kSub);
  Line(sub, "G0 X1");
  Line(sub, "M17");
  sub.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().For(R(1), N("1"), N("2")).Finish();
  program.Block().Call(sub.Id()).Finish();
  Mark(program, WordOp::kEndFor);
  Line(program, "M30");
  program.Finish();
  ir::BuildStructure(module, program.Id(), 0, sink);
  options.entry = program.Id();
  options.count_turns = true;
  NoEnvironment none;
  exec::Run(module, machine, options, none, watch, sink);
  CHECK(watch.seen == "3x1 0x1;3x2 0x1;");
}

TEST_CASE_FIXTURE(RunFixture, "a sink that has enough stops the run") {
  struct Two final : EventSink {
    int count = 0;
    bool OnEvent(const Event&) override { return ++count < 2; }
  } two;
  ir::ProgramBuilder program(module, "MAIN");
  for (int i = 0; i < 5; ++i) Line(program, "G0 X1");
  program.Finish();
  NoEnvironment none;
  CHECK(exec::Run(module, machine, options, none, two, sink).outcome == Outcome::kStopped);
  CHECK(two.count == 2);
}

}  // namespace ncport::exec
