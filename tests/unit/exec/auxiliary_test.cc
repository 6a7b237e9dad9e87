// Spindle, tool, offsets, M functions, messages, alarms, computed codes; the trace as text and JSON.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/exec/run_fixture.h"

namespace ncport::exec {

using ir::WordOp;

TEST_CASE_FIXTURE(RunFixture, "functions before the motion, stops behind it (vector 44)") {
  CHECK(Trace({"G0 X0", "G1 X10 F200 S1000 M3", "G4F=2.5", "X20 M=8", "X30 M5", "M0", "X40 M1"}) ==
        "RAPID X0\nSPINDLE RPM 1000\nSPINDLE CW\nLINE X10 F200\nDWELL 2.5\nM8\nLINE X20 F200\nLINE X30 F200\nSPINDLE "
        "STOP\nSTOP\nLINE X40 F200\nOPTSTOP\n");
}

TEST_CASE_FIXTURE(RunFixture, "the limit of the speed comes before the speed; a second spindle; positions") {
  machine = TestLathe();
  CHECK(Trace({"G96 S180 LIMS=2500 M4", "S2=300", "SPOS=90", "G0 X100 Z0", "G97", "G97 S500"}) ==
        "SPINDLE LIMIT 2500\nSPINDLE CSS 180\nSPINDLE CCW\nSPINDLE2 RPM 300\nSPINDLE POS 90\nRAPID Xr50 Z0\nSPINDLE "
        "RPM 572.957795\nSPINDLE RPM 500\n");
}

TEST_CASE_FIXTURE(RunFixture, "spindle 1 by its number is the master spindle") {
  CHECK(Trace({"S1=800 M3", "S900"}) == "SPINDLE RPM 800\nSPINDLE CW\nSPINDLE RPM 900\n");
}

TEST_CASE_FIXTURE(RunFixture, "a frozen surface speed needs the diameter, and the limit holds") {
  machine = TestLathe();
  Trace({"G96 S180", "G97"});
  CHECK(result.outcome == Outcome::kRefused);
  RunFixture limited;
  limited.machine = TestLathe();
  CHECK(limited.Trace({"G96 S180 LIMS=300", "G0 X10", "G97"}) ==
        "SPINDLE LIMIT 300\nSPINDLE CSS 180\nRAPID Xr5\nSPINDLE RPM 300\n");
}

TEST_CASE_FIXTURE(RunFixture, "surface speed brings the feed per revolution; inch programs give feet") {
  CHECK(Trace({"G1 X1 F100", "G96 S100", "X2 F0.2"}) == "LINE X1 F100\nSPINDLE CSS 100\nLINE X2 F0.2/r\n");
  RunFixture inch;
  CHECK(inch.Trace({"G700 G96 S100"}) == "SPINDLE CSS 30.48\n");
}

TEST_CASE_FIXTURE(RunFixture, "a tool that T makes ready brings its edge with the change (sinumerik-8.8)") {
  machine.tool_activates_edge = true;
  CHECK(Trace({"T1 M6", "G0 X1", "T2", "X2", "M6", "X3"}) ==
        "TOOL 1\nM6\nOFFSET EDGE 1\nRAPID X1\nTOOL 2\nRAPID X2\nM6\nOFFSET EDGE 1\nRAPID X3\n");
  RunFixture apart;
  apart.machine.tool_activates_edge = true;
  // An edge between T and M6 is one of the tool that is still in.
  CHECK(apart.Trace({"T1", "M6", "D3", "T2 D2", "M6", "D0"}) ==
        "TOOL 1\nM6\nOFFSET EDGE 1\nOFFSET EDGE 3\nTOOL 2\nOFFSET EDGE 2\nM6\nOFFSET EDGE 1\nOFFSET NONE\n");
  RunFixture joined;
  joined.machine.tool_activates_edge = true;
  CHECK(joined.Trace({"D2 T1 M6", "M6 T4 D1"}) == "TOOL 1\nM6\nOFFSET EDGE 2\nTOOL 4\nM6\nOFFSET EDGE 1\n");
}

TEST_CASE_FIXTURE(RunFixture, "the change may stand in a called program") {
  machine.tool_activates_edge = true;
  ir::ProgramBuilder change(module, "CHANGE", ir::ProgramKind::kSub);
  Line(change, "M6");
  Line(change, "M17");
  change.Finish();
  ir::ProgramBuilder program(module, "MAIN");
  options.entry = program.Id();
  Line(program, "T7");
  program.Block().Call(change.Id()).Finish();
  Line(program, "T8");
  program.Block().Call(change.Id()).Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() == "TOOL 7\nM6\nOFFSET EDGE 1\nTOOL 8\nM6\nOFFSET EDGE 1\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "events tell whether the tool is in") {
  struct Events final : EventSink {
    bool OnEvent(const Event& event) override {
      seen += event.kind == EventKind::kTool ? (event.tool_waits ? "waits " : "in ")
              : event.tool_change            ? "change "
                                             : "";
      return true;
    }
    std::string seen;
  };
  ir::ProgramBuilder program(module, "MAIN");
  for (const char* line : {"T1", "M6", "M30"}) Line(program, line);
  program.Finish();
  NoEnvironment nothing;
  RunOptions run;
  run.entry = ir::ProgramId{0};
  Events mill;
  exec::Run(module, machine, run, nothing, mill, sink);
  CHECK(mill.seen == "waits change ");
  machine.tool_word_changes = true;
  Events turret;
  exec::Run(module, machine, run, nothing, turret, sink);
  CHECK(turret.seen == "in change ");
}

TEST_CASE_FIXTURE(RunFixture, "tools, edges and registers where the tool word changes the tool") {
  machine.tool_activates_edge = true;
  machine.tool_word_changes = true;
  ir::ProgramBuilder program(module, "MAIN");
  Line(program, "T3");
  Line(program, "T4 D2");
  program.Block().Add(WordOp::kTool, e.Text("MILL_10")).Finish();
  Line(program, "D0 M6");
  program.Block()
      .Add(WordOp::kLengthOffset, {}, 1)
      .Add(WordOp::kLengthOffset, N("5"))
      .Add(WordOp::kRadiusOffset, N("7"))
      .Finish();
  program.Block().Add(WordOp::kLengthOffset).Add(WordOp::kToolOffset, N("3")).Finish();
  Line(program, "M30");
  program.Finish();
  CHECK(Run() ==
        "TOOL 3\nOFFSET EDGE 1\nTOOL 4\nOFFSET EDGE 2\nTOOL \"MILL_10\"\nOFFSET EDGE 1\nM6\nOFFSET NONE\nOFFSET LENGTH "
        "5\nOFFSET RADIUS 7\n"
        "OFFSET NONE\nOFFSET 3\nEND\n");
}

TEST_CASE_FIXTURE(RunFixture, "INT addresses round, negative numbers are alarms") {
  CHECK(Trace({"M=7.6", "H=4", "M=-1"}) == "M8\nH4\nALARM range number of a function is negative or too large\n");
}

TEST_CASE_FIXTURE(RunFixture, "alarms by number: some only show") {
  machine.shown_alarms = {{62000, 62999}};
  CHECK(Trace({"SETAL=62100", "SETAL=65000", "G0 X1"}) == "MSG 62100\nALARM 65000 user\n");
  RunFixture texts;
  ir::ProgramBuilder program(texts.module, "MAIN");
  program.Block()
      .Add(WordOp::kAlarm, texts.N("1"), static_cast<std::uint8_t>(ir::AlarmKind::kShows), texts.e.Text("look").value)
      .Add(WordOp::kPrint, texts.e.Text("printed"))
      .Add(WordOp::kAlarm, texts.N("3021"), static_cast<std::uint8_t>(ir::AlarmKind::kStops),
           texts.e.Text("DIAMETER MISSING").value)
      .Finish();
  program.Finish();
  CHECK(texts.Run() == "MSG look\nPRINT printed\nALARM 3021 DIAMETER MISSING\n");
}

TEST_CASE_FIXTURE(RunFixture, "codes that are computed mean what the table of the machine says") {
  machine.g_codes = {
      {0, WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kRapid), Id<void>::kNone, ir::Phase::kSetting},
      {541, WordOp::kWorkOffset, 0, 54, ir::Phase::kSetting}};
  machine.m_codes = {{50, WordOp::kSpindle, 0, static_cast<std::uint32_t>(ir::SpindleState::kStop), ir::Phase::kAfter},
                     {300, WordOp::kProgramEnd, 0, 30, ir::Phase::kLast}};
  ir::ProgramBuilder program(module, "MAIN");
  program.Block().Add(WordOp::kComputedG, R(1)).Axis(0, N("1")).Add(WordOp::kComputedM, N("5")).Finish();
  program.Block().Add(WordOp::kComputedM, N("41")).Finish();
  program.Block().Add(WordOp::kComputedM, Add(N("20"), N("10"))).Finish();
  program.Block().Add(WordOp::kComputedG, N("99")).Finish();
  program.Finish();
  CHECK(Run() == "RAPID X1\nSPINDLE STOP\nM41\nEND\n");
  options.start_values = {{{}, r, 1, Value::Real(7), ""}};
  CHECK(Run() == "ALARM code code 7 is not known\n");
}

TEST_CASE_FIXTURE(RunFixture, "an axis chosen at run time, an axis that does not exist, an axis twice") {
  ir::ProgramBuilder program(module, "MAIN");
  machine.axes = 7;
  program.Block().Motion(ir::Motion::kRapid).Add(WordOp::kAxisComputed, N("4"), 0, e.AxisName(2).value).Finish();
  Line(program, "C5");
  program.Finish();
  CHECK(Run() == "RAPID Z4\nALARM other axis C does not exist\n");
  RunFixture twice;
  CHECK(twice.Trace({"G0 X1 X2"}) == "ALARM syntax axis X twice in one block\n");
}

TEST_CASE_FIXTURE(RunFixture, "numbers of the trace have six decimals at most, and no minus zero") {
  CHECK(Trace({"G0 X0.12345678 Y-0.0000001 Z1000000"}) == "RAPID X0.123457 Y0 Z1000000\n");
}

TEST_CASE_FIXTURE(RunFixture, "the trace as JSON") {
  ir::ProgramBuilder program(module, "MAIN", ir::ProgramKind::kMain, ir::AddFile(module, "a.mpf"));
  Line(program, "G0 X1 Y0");
  Line(program, "G2 X0 Y1 I-1 F100 TURN=1");
  program.Block().Add(WordOp::kMessage, e.Text("say \"it\"\n")).Finish();
  Line(program, "SETAL=65000");
  program.Finish();
  std::string text;
  OutputSink output(text);
  TraceWriter writer(output, module, TraceFormat::kJson);
  NoEnvironment none;
  exec::Run(module, machine, options, none, writer, sink);
  CHECK(writer.Finish().Ok());
  const nlohmann::json json = nlohmann::json::parse(text);
  CHECK(json["version"] == 1);
  REQUIRE(json["events"].size() == 4);
  CHECK(json["events"][0]["kind"] == "rapid");
  CHECK(json["events"][0]["to"]["X"] == 1);
  CHECK(json["events"][0]["file"] == "a.mpf");
  CHECK(json["events"][0]["line"] == 1);
  CHECK(json["events"][1]["center"] == nlohmann::json::array({0, 0}));
  CHECK(json["events"][1]["turns"] == 1);
  CHECK(json["events"][2]["text"] == "say \"it\"\n");
  CHECK(json["events"][3]["code"] == "65000");
}

}  // namespace ncport::exec
