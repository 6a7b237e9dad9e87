#include "backends/iso/flat_writer.h"

#include <doctest/doctest.h>

#include <string>

#include "ir/builder.h"

namespace ncport::backends::iso {
namespace {

using exec::Event;
using exec::EventKind;

/// A profile that leaves all but the spindle's words open.
dialects::Profile WithSpindleWords() {
  dialects::Profile profile;
  profile.spindle.cw.Set("M3");
  profile.spindle.ccw.Set("M4");
  profile.spindle.stop.Set("M5");
  return profile;
}

/// A module with numbered blocks for events to come from, and a writer for one machine.
struct Bench {
  explicit Bench(bool lathe = false) {
    profile.name = lathe ? "iso-lathe" : "iso-mill";
    profile.machine = lathe ? dialects::MachineKind::kLathe : dialects::MachineKind::kMill;
    profile.axes = lathe ? std::vector<std::string>{"X", "Z", "C"} : std::vector<std::string>{"X", "Y", "Z", "A"};
    if (lathe) {
      profile.diameter.Set(dialects::DiameterRule::kYes);
      profile.spindle.limit.Set("G50 S{speed}");
    }
    file = files.Add("a.mpf", std::string("first\nsecond\nthird\nfourth\n"));
  }

  Event Make(EventKind kind, std::uint32_t block = 0) const {
    Event event;
    event.kind = kind;
    event.plane = profile.IsLathe() ? ir::Plane::kZX : ir::Plane::kXY;
    event.feed_mode = profile.IsLathe() ? ir::FeedMode::kPerRevolution : ir::FeedMode::kPerMinute;
    if (block < module.blocks.Size()) event.block = ir::BlockId{block};
    return event;
  }

  /// Moves X Y Z (a lathe: X as radius, Z).
  Event Move(EventKind kind, double x, double y, double z, double feed = 0) {
    Event event = Make(kind);
    for (int axis = 0; axis < 3; ++axis) event.from[axis] = at[axis];
    at[0] = x;
    at[1] = y;
    at[2] = z;
    for (int axis = 0; axis < 3; ++axis) event.position[axis] = at[axis];
    event.known_axes = profile.IsLathe() ? 0b101 : 0b111;
    event.feed = feed;
    return event;
  }

  Event ArcTo(double x, double y, double z, double c0, double c1, bool clockwise, double feed) {
    Event event = Move(EventKind::kArc, x, y, z, feed);
    event.center[0] = c0;
    event.center[1] = c1;
    event.clockwise = clockwise;
    return event;
  }

  FlatWriter& Writer() {
    if (!writer) writer.emplace(module, files, profile, options, output, sink);
    return *writer;
  }
  void Send(const Event& event) { CHECK(Writer().OnEvent(event)); }
  std::string Finish() {
    CHECK(Writer().Finish().Ok());
    return text;
  }

  SourceFiles files;
  FileId file;
  ir::Module module;
  dialects::Profile profile = WithSpindleWords();
  dialects::Config config;
  FlatOptions options;
  std::string text;
  OutputSink output{text};
  diag::Sink sink;
  std::optional<FlatWriter> writer;
  double at[3] = {};
};

constexpr const char* kMillHeader = "G17 G21 G90 G94 G40\n";

TEST_CASE("straight moves are absolute; modal words come on change only") {
  Bench bench;
  bench.Send(bench.Move(EventKind::kRapid, 10, -5.5, 50));
  bench.Send(bench.Move(EventKind::kRapid, 10, -5.5, 2));
  bench.Send(bench.Move(EventKind::kLine, 10, -5.5, -1, 100));
  bench.Send(bench.Move(EventKind::kLine, 20, -5.5, -1, 100));
  bench.Send(bench.Move(EventKind::kLine, 20, 1.0 / 3, -1, 250.5));
  CHECK(bench.Finish() == std::string(kMillHeader) +
                              "G0 X10. Y-5.5 Z50.\n"
                              "Z2.\n"
                              "G1 Z-1. F100.\n"
                              "X20.\n"
                              "Y0.333 F250.5\n"
                              "M30\n");
  CHECK(bench.sink.Empty());
}

TEST_CASE("an axis that the source names is written although it stands there") {
  Bench bench;
  bench.Send(bench.Move(EventKind::kRapid, 1, 2, 3));
  Event again = bench.Move(EventKind::kRapid, 1, 2, 3);
  again.moved_axes = 0b001;
  bench.Send(again);
  CHECK(bench.Finish() == std::string(kMillHeader) + "G0 X1. Y2. Z3.\nX1.\nM30\n");
}

TEST_CASE("arcs have their centre from the start point, and both end coordinates") {
  Bench bench;
  bench.Send(bench.Move(EventKind::kRapid, 0, 0, 0));
  bench.Send(bench.ArcTo(10, 10, 0, 10, 0, true, 100));
  Event full = bench.ArcTo(10, 10, -2, 10, 20, false, 100);
  full.full_circle = true;
  bench.Send(full);
  CHECK(bench.Finish() == std::string(kMillHeader) +
                              "G0 X0. Y0. Z0.\n"
                              "G2 X10. Y10. I10. J0. F100.\n"
                              "G3 X10. Y10. Z-2. I0. J10.\n"
                              "M30\n");
}

TEST_CASE("additional turns become full circles with the way across spread over the whole angle") {
  Bench bench;
  bench.Send(bench.Move(EventKind::kRapid, 10, 0, 0));
  Event helix = bench.ArcTo(-10, 0, -5, 0, 0, false, 100);
  helix.turns = 2;  // 2.5 turns in all: 2 mm each
  bench.Send(helix);
  CHECK(bench.Finish() == std::string(kMillHeader) +
                              "G0 X10. Y0. Z0.\n"
                              "G3 X10. Y0. Z-2. I-10. J0. F100.\n"
                              "X10. Y0. Z-4. I-10. J0.\n"
                              "X-10. Y0. Z-5. I-10. J0.\n"
                              "M30\n");
}

TEST_CASE("another plane is written with the motion that needs it") {
  Bench bench;
  bench.Send(bench.Move(EventKind::kRapid, 0, 0, 0));
  Event arc = bench.ArcTo(10, 0, 10, 0, 10, false, 100);
  arc.plane = ir::Plane::kZX;
  bench.Send(arc);
  CHECK(bench.Finish() == std::string(kMillHeader) + "G0 X0. Y0. Z0.\nG18 G3 X10. Z10. I10. K0. F100.\nM30\n");
}

TEST_CASE("a lathe writes X as diameter and centre words as radius") {
  Bench bench(true);
  bench.Send(bench.Move(EventKind::kRapid, 25, 0, 1));
  bench.Send(bench.Move(EventKind::kLine, 25.0005, 0, -10, 0.25));
  bench.Send(bench.ArcTo(30, 0, -15, -15, 25, false, 0.25));
  CHECK(bench.Finish() ==
        "G18 G21 G90 G95 G40\n"
        "G0 X50. Z1.\n"
        "G1 X50.001 Z-10. F0.25\n"
        "G3 X60. Z-15. I0. K-5.\n"
        "M30\n");
}

TEST_CASE("the speed limit stands in front of the surface speed, whatever their order in the source") {
  Bench bench(true);
  Event css = bench.Make(EventKind::kSpindleSurface);
  css.value = 300;
  Event limit = bench.Make(EventKind::kSpindleLimit);
  limit.value = 3200;
  bench.Send(css);
  bench.Send(limit);
  Event sense = bench.Make(EventKind::kSpindle);
  sense.spindle_state = ir::SpindleState::kCw;
  bench.Send(sense);
  bench.Send(bench.Move(EventKind::kLine, 10, 0, 0, 0.2));
  CHECK(bench.Finish() ==
        "G18 G21 G90 G95 G40\n"
        "G50 S3200\n"
        "G96 S300\n"
        "M3\n"
        "G95 G1 X20. Z0. F0.2\n"
        "M30\n");
}

TEST_CASE("a spindle word that the profile leaves open is refused, not guessed") {
  Bench bench;
  bench.profile.name = "mazak-integrex-new";
  bench.profile.spindle.cw.Ask();
  bench.profile.spindle.cw.SetKey("spindle.cw");
  Event event = bench.Make(EventKind::kSpindle);
  event.spindle_state = ir::SpindleState::kCw;
  bench.Send(event);
  CHECK(bench.Finish().find("M3\n") == std::string::npos);
  REQUIRE(bench.sink.All().size() == 1);
  CHECK(bench.sink.HasErrors());
  CHECK(bench.sink.All()[0].message == "profile mazak-integrex-new leaves spindle.cw open");
}

TEST_CASE("speed and sense of one block share a flat block") {
  Bench bench;
  Event speed = bench.Make(EventKind::kSpindleSpeed);
  speed.value = 1000;
  Event sense = bench.Make(EventKind::kSpindle);
  sense.spindle_state = ir::SpindleState::kCcw;
  bench.Send(speed);
  bench.Send(sense);
  Event stop = bench.Make(EventKind::kSpindle);
  bench.Send(stop);
  CHECK(bench.Finish() == std::string(kMillHeader) + "S1000 M4\nM5\nM30\n");
}

TEST_CASE("tools and edges of a mill") {
  Bench bench;
  Event tool = bench.Make(EventKind::kTool);
  tool.number = 3;
  tool.tool_waits = true;
  Event change = bench.Make(EventKind::kAux);
  change.number = 6;
  change.tool_change = true;
  Event edge = bench.Make(EventKind::kOffset);
  edge.offset = exec::OffsetKind::kEdge;
  edge.number = 1;
  Event comp = bench.Make(EventKind::kComp);
  comp.comp = ir::CutterComp::kLeft;

  SUBCASE("edge 1 of a numbered tool uses the registers of its number, and says so") {
    for (const Event& event : {tool, change, edge, comp}) bench.Send(event);
    CHECK(bench.Finish() == std::string(kMillHeader) + "T3\nM6\nG43 H3\nG41 D3\nM30\n");
    REQUIRE(bench.sink.WarningCount() == 1);
    CHECK(bench.sink.All()[0].message == "T3 D1 becomes T3 H3 D3: the offset registers with the tool's number");
  }
  SUBCASE("another edge needs a line in the configuration, which the finding shows") {
    edge.number = 2;
    for (const Event& event : {tool, change, edge}) bench.Send(event);
    REQUIRE(bench.sink.ErrorCount() == 1);
    CHECK(bench.sink.All()[0].code == diag::Code::kUnmappedTool);
    CHECK(bench.sink.All()[0].help.find("'T3 D2' = ") != std::string::npos);
  }
  SUBCASE("an edge without a tool is refused") {
    for (const Event& event : {edge, comp}) bench.Send(event);
    bench.Finish();
    REQUIRE(bench.sink.ErrorCount() == 2);
    CHECK(bench.sink.All()[0].code == diag::Code::kOffsetWithoutTool);
    CHECK(bench.sink.All()[1].code == diag::Code::kOffsetWithoutTool);
  }
  SUBCASE("the edge is one of the tool that is in, not of the one that stands ready") {
    Event next = tool;
    next.number = 4;
    for (const Event& event : {tool, change, edge, next, comp, edge, change, edge}) bench.Send(event);
    CHECK(bench.Finish() == std::string(kMillHeader) + "T3\nM6\nG43 H3\nT4\nG43 H3\nG41 D3\nM6\nG43 H4\nD4\nM30\n");
  }
  SUBCASE("compensation takes the edge of its block") {
    Event off = bench.Make(EventKind::kOffset);
    off.offset = exec::OffsetKind::kNone;
    for (const Event& event : {tool, change, off, comp, edge}) bench.Send(event);
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    CHECK(bench.Finish() == std::string(kMillHeader) + "T3\nM6\nG49\nG43 H3\nG41 D3\nG0 X1. Y1. Z1.\nM30\n");
    CHECK(bench.sink.ErrorCount() == 0);
  }
  SUBCASE("an edge in front of the first change matters only when something moves with it") {
    for (const Event& event : {tool, edge, change, edge}) bench.Send(event);
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    CHECK(bench.Finish() == std::string(kMillHeader) + "T3\nM6\nG43 H3\nG0 X1. Y1. Z1.\nM30\n");
    CHECK(bench.sink.ErrorCount() == 0);
  }
  SUBCASE("an edge in front of the first change that is moved with is refused") {
    for (const Event& event : {tool, edge}) bench.Send(event);
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    REQUIRE(bench.sink.ErrorCount() == 1);
    CHECK(bench.sink.All()[0].code == diag::Code::kOffsetWithoutTool);
  }
  SUBCASE("an edge without a tool is refused at the end, if not before") {
    bench.Send(edge);
    bench.Finish();
    CHECK(bench.sink.ErrorCount() == 1);
  }
  SUBCASE("a control that changes at T gets its M6") {
    tool.tool_waits = false;
    bench.Send(tool);
    CHECK(bench.Finish() == std::string(kMillHeader) + "T3\nM6\nM30\n");
  }
  SUBCASE("a name needs a mapping") {
    tool.text = "MILL_10";
    bench.Send(tool);
    bench.Finish();
    REQUIRE(bench.sink.ErrorCount() == 1);
    CHECK(bench.sink.All()[0].help == "add to [tools] in ncport.toml: 'T=\"MILL_10\" D1' = \"T1 H1 D1\"");
  }
}

TEST_CASE("a lathe joins tool and offset") {
  Bench bench(true);
  Event tool = bench.Make(EventKind::kTool);
  tool.number = 3;
  Event offset = bench.Make(EventKind::kOffset);
  offset.offset = exec::OffsetKind::kNumber;
  offset.number = 13;
  Event none = bench.Make(EventKind::kOffset);
  none.offset = exec::OffsetKind::kNone;
  bench.Send(tool);
  bench.Send(offset);
  bench.Send(none);
  bench.Send(tool);
  bench.Send(bench.Move(EventKind::kRapid, 1, 0, 1));
  CHECK(bench.Finish() == "G18 G21 G90 G95 G40\nT0313\nT0300\nT0300\nG0 X2. Z1.\nM30\n");
}

TEST_CASE("a turret waits for the change word of the source") {
  Bench bench(true);
  dialects::Config config;
  config.mcodes.push_back({"M6", "drop"});
  bench.options.config = &config;
  Event tool = bench.Make(EventKind::kTool);
  tool.number = 3;
  tool.tool_waits = true;
  Event change = bench.Make(EventKind::kAux);
  change.number = 6;
  change.tool_change = true;
  Event edge = bench.Make(EventKind::kOffset);
  edge.offset = exec::OffsetKind::kEdge;
  edge.number = 1;
  bench.Send(tool);
  bench.Send(bench.Move(EventKind::kRapid, 1, 0, 1));
  bench.Send(change);
  bench.Send(edge);
  CHECK(bench.Finish() == "G18 G21 G90 G95 G40\nG0 X2. Z1.\n(M6 LEFT OUT)\nT0303\nM30\n");
}

TEST_CASE("the offset that the source starts in stands in front of the first motion") {
  Bench bench;
  SUBCASE("once, when none was selected") {
    bench.options.start_offset = {true, 54, 0};
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    bench.Send(bench.Move(EventKind::kRapid, 2, 1, 1));
    CHECK(bench.Finish() == std::string(kMillHeader) + "G54\nG0 X1. Y1. Z1.\nX2.\nM30\n");
  }
  SUBCASE("not when the program selects one") {
    bench.options.start_offset = {true, 54, 0};
    Event offset = bench.Make(EventKind::kWorkOffset);
    offset.number = 55;
    bench.Send(offset);
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    CHECK(bench.Finish() == std::string(kMillHeader) + "G55\nG0 X1. Y1. Z1.\nM30\n");
  }
  SUBCASE("none and unknown write nothing") {
    bench.options.start_offset = {true, 0, 0};
    SUBCASE("unknown") { bench.options.start_offset = {}; }
    SUBCASE("none") {}
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    CHECK(bench.Finish() == std::string(kMillHeader) + "G0 X1. Y1. Z1.\nM30\n");
  }
  SUBCASE("through the map") {
    dialects::Config config;
    dialects::WordMapping& offset = config.offsets.emplace_back();
    offset.source = "G54";
    offset.target = "G57";
    bench.options.config = &config;
    bench.options.start_offset = {true, 54, 0};
    bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
    CHECK(bench.Finish() == std::string(kMillHeader) + "G57\nG0 X1. Y1. Z1.\nM30\n");
  }
}

TEST_CASE("extended work offsets have the form of the target, or none") {
  Bench bench;
  Event offset = bench.Make(EventKind::kWorkOffset);
  offset.number = 54;
  offset.extension = 3;
  SUBCASE("G54.1 P") {
    bench.profile.words.work_offset_extended.Set("G54.1 P{number}");
    bench.Send(offset);
    CHECK(bench.Finish() == std::string(kMillHeader) + "G54.1 P3\nM30\n");
    CHECK(bench.Writer().Record().offsets.front().target == "G54.1 P3");
  }
  SUBCASE("another form") {
    bench.profile.words.work_offset_extended.Set("G154 P{number}");
    bench.Send(offset);
    CHECK(bench.Finish() == std::string(kMillHeader) + "G154 P3\nM30\n");
  }
  SUBCASE("none") {
    bench.profile.words.work_offset_extended.Set("");
    bench.Send(offset);
    REQUIRE(bench.sink.ErrorCount() == 1);
    CHECK(bench.sink.All()[0].message == "work offset G54.1 P3 is not mapped");
  }
}

TEST_CASE("rapids of several axes are listed, each source block once") {
  Bench bench;
  bench.options.list_rapids = true;
  bench.Send(bench.Move(EventKind::kRapid, 1, 1, 1));
  bench.Send(bench.Move(EventKind::kRapid, 2, 1, 1));
  bench.Send(bench.Move(EventKind::kLine, 3, 2, 1, 100));
  bench.Send(bench.Move(EventKind::kRapid, 4, 3, 1));
  bench.Finish();
  const auto& rapids = bench.Writer().Record().rapids;
  REQUIRE(rapids.size() == 2);
  CHECK(rapids[0].axes == 0b111);
  CHECK(rapids[0].line == 2);
  CHECK(rapids[1].axes == 0b011);
  CHECK(rapids[1].line == 5);
}

TEST_CASE("work offsets beyond G59 and none need a mapping; M functions of the builder too") {
  Bench bench;
  Event offset = bench.Make(EventKind::kWorkOffset);
  offset.number = 54;
  bench.Send(offset);
  offset.number = 505;
  bench.Send(offset);
  Event builder = bench.Make(EventKind::kAux);
  builder.number = 41;
  bench.Send(builder);
  Event coolant = bench.Make(EventKind::kAux);
  coolant.number = 8;
  bench.Send(coolant);
  CHECK(bench.Finish() == std::string(kMillHeader) + "G54\nM8\nM30\n");
  REQUIRE(bench.sink.ErrorCount() == 2);
  CHECK(bench.sink.All()[0].message == "work offset G505 is not mapped");
  CHECK(bench.sink.All()[1].message == "M41 belongs to the machine builder and is not mapped");
}

TEST_CASE("what flat blocks cannot say is refused by name") {
  Bench bench;
  for (const EventKind kind : {EventKind::kTap, EventKind::kRapidMachine, EventKind::kReference, EventKind::kProbe,
                               EventKind::kSpindlePosition}) {
    bench.Send(bench.Make(kind));
  }
  Event revolutions = bench.Make(EventKind::kDwell);
  revolutions.per_revolution = true;
  revolutions.value = 2;
  bench.Send(revolutions);
  Event inverse = bench.Move(EventKind::kLine, 1, 1, 1, 5);
  inverse.feed_mode = ir::FeedMode::kInverseTime;
  bench.Send(inverse);
  Event tilted = bench.Move(EventKind::kLine, 1, 1, 1, 5);
  tilted.known_axes |= 1U << 4;  // B, which the mill does not have
  bench.Send(tilted);
  CHECK(bench.sink.ErrorCount() == 8);
  for (const diag::Diagnostic& diagnostic : bench.sink.All()) CHECK(diagnostic.code == diag::Code::kNotExpressible);
}

TEST_CASE("feed as inverse time stands in each block, where the profile has a word for it") {
  Bench bench;
  bench.profile.words.feed_inverse_time.Set("G93");
  for (const double x : {1.0, 2.0}) {
    Event move = bench.Move(EventKind::kLine, x, 0, 0, 1.5);
    move.feed_mode = ir::FeedMode::kInverseTime;
    bench.Send(move);
  }
  CHECK(bench.Finish() == std::string(kMillHeader) + "G93 G1 X1. Y0. Z0. F1.5\nX2. F1.5\nM30\n");
}

TEST_CASE("a value that rounding takes away is refused") {
  Bench bench;
  bench.Send(bench.Move(EventKind::kLine, 1, 1, 1, 0.0001));
  Event thread = bench.Move(EventKind::kThread, 1, 1, -99);
  thread.value = 25.4 / 19;  // 1.336842..: after 75 revolutions off by more than half an increment
  bench.Send(thread);
  Event huge = bench.Move(EventKind::kRapid, 1e10, 0, 0);
  bench.Send(huge);
  REQUIRE(bench.sink.ErrorCount() == 3);
  CHECK(bench.sink.All()[0].code == diag::Code::kWordTooCoarse);
  CHECK(bench.sink.All()[1].code == diag::Code::kWordTooCoarse);
  CHECK(bench.sink.All()[2].code == diag::Code::kOutOfRange);
}

TEST_CASE("threads carry the lead under the letter of the longer way") {
  Bench bench(true);
  bench.Send(bench.Move(EventKind::kRapid, 10, 0, 5));
  Event thread = bench.Move(EventKind::kThread, 10, 0, -20);
  thread.value = 1.5;
  bench.Send(thread);
  CHECK(bench.Finish() == "G18 G21 G90 G95 G40\nG0 X20. Z5.\nG33 Z-20. K1.5\nM30\n");
}

TEST_CASE("an alarm of the program is a finding") {
  Bench bench;
  Event alarm = bench.Make(EventKind::kAlarm);
  alarm.code = "14051";
  alarm.text = "division by zero";
  bench.Send(alarm);
  REQUIRE(bench.sink.ErrorCount() == 1);
  CHECK(bench.sink.All()[0].message == "the program stops with alarm 14051 division by zero");
}

TEST_CASE("output over the limit stops the run with a finding that names the option") {
  Bench bench;
  bench.options.max_bytes = 100;
  bool went_on = true;
  int sent = 0;
  for (; went_on && sent < 100000; ++sent) went_on = bench.Writer().OnEvent(bench.Move(EventKind::kRapid, sent, 0, 0));
  CHECK(sent < 100000);
  REQUIRE(bench.sink.ErrorCount() == 1);
  CHECK(bench.sink.All()[0].code == diag::Code::kOutputLimit);
  CHECK(bench.sink.All()[0].help.find("--max-output") != std::string::npos);
  CHECK(!bench.Writer().Finish().Ok());
}

// --- comments

struct CommentBench : Bench {
  CommentBench() {
    // 1: a comment line; 2: an assignment with a comment; 3: a motion with a comment; 4: a branch that does not run.
    ir::ExprBuilder e(module);
    ir::ProgramBuilder program(module, "A", ir::ProgramKind::kMain, file);
    program.Block(1).Comment("Header (mm)", ir::CommentPlace::kOwnLine).Finish();
    ir::BlockBuilder second = program.Block(2);
    second.Add(ir::WordOp::kPreprocessStop).Comment("depth");
    second.Last().length = 6;
    second.Finish();
    program.Block(3).Axis(0, e.Number("1")).Comment("cut").Finish();
    program.Block(4).Axis(0, e.Number("2")).Comment("other way").Finish();
    program.Finish();
    coverage.blocks = {0, 1, 1, 0};
    options.coverage = &coverage;
  }
  exec::Coverage coverage;
};

TEST_CASE("comments stand where their block ran first; what did not run is in the report") {
  CommentBench bench;
  Event move = bench.Move(EventKind::kRapid, 1, 0, 0);
  move.block = ir::BlockId{2};
  bench.Send(move);
  move.position[0] = 2;
  bench.Send(move);
  CHECK(bench.Finish() == std::string(kMillHeader) +
                              "(HEADER [MM])\n"
                              "(SECOND)\n"
                              "(DEPTH)\n"
                              "G0 X1. Y0. Z0. (CUT)\n"
                              "X2.\n"
                              "M30\n");
  // The stop of preprocessing became a comment, one comment did not come.
  REQUIRE(bench.sink.All().size() == 2);
  CHECK(bench.sink.All()[0].code == diag::Code::kListedLoss);
  CHECK(bench.sink.All()[1].code == diag::Code::kCommentsLeftOut);
  CHECK(bench.sink.All()[1].at.line == 4);
  CHECK(bench.sink.ErrorCount() == 0);
}

TEST_CASE("messages become comments and are listed once a block") {
  CommentBench bench;
  Event message = bench.Make(EventKind::kMessage);
  message.block = ir::BlockId{3};
  message.text = "Lage \xC3\xBC (1)";
  bench.Send(message);
  bench.Send(message);
  const std::string text = bench.Finish();
  CHECK(text.find("(MSG LAGE ? [1]) (OTHER WAY)\n(MSG LAGE ? [1])\n") != std::string::npos);
  std::size_t losses = 0;
  for (const diag::Diagnostic& diagnostic : bench.sink.All()) {
    if (diagnostic.message.find("the message") != std::string::npos) ++losses;
  }
  CHECK(losses == 1);
}

TEST_CASE("a listener hears each block with its line and origin") {
  struct Listener : FlatListener {
    void OnFlatBlock(std::uint64_t line, std::string_view text, const FlatOrigin& origin) override {
      heard += std::to_string(line) + ":" + std::string(text) + "@" +
               (origin.block.Valid() ? std::to_string(origin.block.value) : "-") + ";";
    }
    std::string heard;
  } listener;
  CommentBench bench;
  bench.Writer().SetListener(&listener);
  Event move = bench.Move(EventKind::kRapid, 1, 0, 0);
  move.block = ir::BlockId{2};
  bench.Send(move);
  bench.Finish();
  CHECK(listener.heard ==
        "1:G17 G21 G90 G94 G40@-;2:(HEADER [MM])@0;3:(SECOND)@1;4:(DEPTH)@1;5:G0 X1. Y0. Z0. (CUT)@2;6:M30@-;");
}

}  // namespace
}  // namespace ncport::backends::iso
