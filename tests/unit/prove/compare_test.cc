#include "prove/compare.h"

#include <doctest/doctest.h>

namespace ncport::prove {
namespace {

using exec::Event;
using exec::EventKind;

constexpr std::uint16_t kX = 1, kZ = 4;

/// Builds traces a motion at a time; positions are absolute, as in the trace text.
class Trace {
 public:
  Trace& Rapid(double x, double z) { return Move(EventKind::kRapid, x, z, 0); }
  Trace& Line(double x, double z, double feed) { return Move(EventKind::kLine, x, z, feed); }
  Trace& Added() {
    added_ = true;
    return *this;
  }
  Trace& Put(Event event) {
    event.added = added_;
    added_ = false;
    recorded.OnEvent(event);
    return *this;
  }
  Trace& Number(EventKind kind, std::uint32_t number) {
    Event event;
    event.kind = kind;
    event.number = number;
    return Put(event);
  }
  Trace& Value(EventKind kind, double value) {
    Event event;
    event.kind = kind;
    event.value = value;
    return Put(event);
  }
  Trace& Turn(ir::SpindleState state) {
    Event event;
    event.kind = EventKind::kSpindle;
    event.spindle_state = state;
    return Put(event);
  }
  Trace& Text(EventKind kind, std::string_view text) {
    Event event;
    event.kind = kind;
    event.text = text;
    return Put(event);
  }
  Trace& Alarm(ir::AlarmClass alarm, std::string_view code) {
    Event event;
    event.kind = EventKind::kAlarm;
    event.alarm = alarm;
    event.code = code;
    return Put(event);
  }
  Trace& End() { return Number(EventKind::kEnd, 0); }
  /// Axes that the next motions name and that are known; X and Z unless said otherwise.
  Trace& Names(std::uint16_t moved, std::uint16_t known) {
    moved_ = moved;
    known_ = known;
    return *this;
  }

  RecordedTrace recorded;

 private:
  Trace& Move(EventKind kind, double x, double z, double feed) {
    Event event;
    event.kind = kind;
    event.position[0] = x;
    event.position[2] = z;
    event.known_axes = known_;
    event.moved_axes = moved_;
    event.feed = feed;
    event.diameter_active = true;
    return Put(event);
  }

  bool added_ = false;
  std::uint16_t moved_ = kX | kZ, known_ = kX | kZ;
};

bool Agree(const Trace& a, const Trace& b, const CompareOptions& options = {}) {
  return !Compare(a.recorded, b.recorded, options).difference.has_value();
}

TEST_CASE("equal traces agree and a changed coordinate, feed, kind or length does not") {
  Trace a;
  a.Rapid(10, 2).Line(10, -5, 0.2).End();
  Trace same;
  same.Rapid(10, 2).Line(10, -5, 0.2).End();
  CHECK(Agree(a, same));
  Trace moved;
  moved.Rapid(10, 2).Line(10, -5.001, 0.2).End();
  CHECK_FALSE(Agree(a, moved));
  Trace slower;
  slower.Rapid(10, 2).Line(10, -5, 0.21).End();
  CHECK_FALSE(Agree(a, slower));
  Trace kind;
  kind.Rapid(10, 2).Rapid(10, -5).End();
  CHECK_FALSE(Agree(a, kind));
  Trace shorter;
  shorter.Rapid(10, 2).End();
  CHECK_FALSE(Agree(a, shorter));
  CHECK_FALSE(Agree(shorter, a));
}

TEST_CASE("cutter compensation that an added block leaves on is a difference, one that it switches off is none") {
  const auto comp = [](ir::CutterComp side) {
    Event event;
    event.kind = EventKind::kComp;
    event.comp = side;
    return event;
  };
  Trace a, on, off, both;
  a.Rapid(10, 2).Line(10, -5, 0.2).End();
  on.Added().Put(comp(ir::CutterComp::kLeft)).Rapid(10, 2).Line(10, -5, 0.2).End();
  off.Added().Put(comp(ir::CutterComp::kOff)).Rapid(10, 2).Line(10, -5, 0.2).End();
  both.Added().Put(comp(ir::CutterComp::kLeft)).Added().Put(comp(ir::CutterComp::kOff));
  both.Rapid(10, 2).Line(10, -5, 0.2).End();
  CHECK_FALSE(Agree(a, on));
  CHECK(Agree(a, off));
  CHECK(Agree(a, both));
}

TEST_CASE("the allowance is half an increment where a control rounds, halved on a diameter, and does not grow") {
  CompareOptions options;
  options.target = {ir::WordError::kRound, 0.001, 0};
  Trace a, b, drift;
  for (int i = 1; i <= 10; ++i) {
    a.Line(10.0 * i, -i, 1);
    b.Line(10.0 * i + 0.00025, -i + 0.0005, 1);
    drift.Line(10.0 * i + 0.0003 * i, -i, 1);
  }
  CHECK(Agree(a, b, options));
  CHECK_FALSE(Agree(a, drift, options));
  Trace radius;
  for (int i = 1; i <= 10; ++i) radius.Line(10.0 * i + 0.0005, -i, 1);
  CHECK_FALSE(Agree(a, radius, options));
  options.target.diameter_axis = 0xFF;
  CHECK(Agree(a, radius, options));
}

TEST_CASE("a word in inches is off by more, for as long as its axis stands there") {
  CompareOptions options;
  options.source.word_error = ir::WordError::kRound;
  options.source.increment = 0.001;
  // 1/64 inch is X0.396875, rounded to 0.0156 inch X0.39624.
  const auto run = [](Trace& trace, double x, bool inch) {
    for (const double z : {1.0, 2.0}) {
      Event event;
      event.kind = EventKind::kLine;
      event.position[0] = x;
      event.position[2] = z;
      event.known_axes = kX | kZ;
      event.moved_axes = z == 1 ? kX | kZ : kZ;
      event.inch = inch && z == 1;
      trace.Put(event);
    }
    trace.End();
  };
  Trace rounded, exact, millimetres, far;
  run(rounded, 0.39624, true);
  run(exact, 0.396875, true);
  run(millimetres, 0.39624, false);
  run(far, 0.3977, true);
  CHECK(Agree(rounded, exact, options));
  CHECK_FALSE(Agree(millimetres, exact, options));
  CHECK_FALSE(Agree(rounded, far, options));
}

TEST_CASE("a centre that one control moves along the chord is compared with the other one moved likewise") {
  CompareOptions options;
  options.source.word_error = ir::WordError::kRound;
  options.source.increment = 0.001;
  // From X0 Y1 to X-.063, with I.188 J-.25 as a control rounds 3/16 and 4/16: the radii at both ends differ by 0.0008.
  const auto compare = [&](double u, double v, double end = 0.938) {
    Event event;
    event.kind = EventKind::kArc;
    event.from[1] = 1;
    event.position[0] = -0.063;
    event.position[1] = end;
    event.known_axes = event.moved_axes = 3;
    Trace kept, other;
    event.center[0] = 0.188;
    event.center[1] = 0.75;
    kept.Put(event).End();
    event.center[0] = u;
    event.center[1] = v;
    other.Put(event).End();
    return Compare(kept.recorded, other.recorded, options);
  };
  CHECK(compare(0.18598, 0.748012).difference);  // both keep it
  options.target.center_moves = 0.01;
  CHECK_FALSE(compare(0.18598, 0.748012).difference);
  CHECK(compare(0.18598, 0.748012).centers_moved == 1);
  CHECK(compare(0.188, 0.75).centers_moved == 0);
  CHECK(compare(0.18598 + 0.0015, 0.748012).difference);
  CHECK(compare(0.18598, 0.748012 - 0.0015).difference);
  options.target.center_moves = 0.002;  // it moves by 0.0028
  CHECK(compare(0.18598, 0.748012).difference);
  options.source.center_moves = options.target.center_moves = 0.01;  // both move it: these are their centres
  CHECK(compare(0.18598, 0.748012).difference);
  // Radii that differ by 0.0039 mean different circles: rounding does not explain that.
  options.source.center_moves = 0;
  options.target.center_moves = 0.1;
  CHECK(compare(0.196677, 0.759641, 0.93).difference);
}

TEST_CASE("added blocks are left out before, behind and around a tool change, and nowhere else") {
  Trace a;
  a.Rapid(50, 2).Line(50, -5, 1).Number(EventKind::kTool, 2).Rapid(60, 5).Line(60, -1, 1).End();
  Trace framed;
  framed.Added()
      .Rapid(99, 99)
      .Rapid(50, 2)
      .Line(50, -5, 1)
      .Added()
      .Rapid(200, 100)
      .Number(EventKind::kTool, 2)
      .Rapid(60, 5);
  framed.Line(60, -1, 1).Added().Rapid(200, 100).End();
  CHECK(Agree(a, framed));
  Trace between;
  between.Rapid(50, 2)
      .Added()
      .Rapid(200, 100)
      .Line(50, -5, 1)
      .Number(EventKind::kTool, 2)
      .Rapid(60, 5)
      .Line(60, -1, 1)
      .End();
  CHECK_FALSE(Agree(a, between));
}

TEST_CASE("behind an added retract the program must name the axis before it cuts") {
  Trace a;
  a.Rapid(50, 2).Number(EventKind::kTool, 2).Names(kZ, kX | kZ).Rapid(50, 1).Line(50, -1, 1).End();
  Trace b;
  b.Rapid(50, 2)
      .Added()
      .Rapid(200, 2)
      .Number(EventKind::kTool, 2)
      .Names(kZ, kX | kZ)
      .Rapid(200, 1)
      .Line(200, -1, 1)
      .End();
  CHECK_FALSE(Agree(a, b));
}

TEST_CASE("an axis that one side alone programs may stand but not move") {
  Trace a, standing, moving;
  a.Names(kZ, kZ).Rapid(0, 2).Line(0, -5, 1).End();
  standing.Rapid(0, 2).Line(0, -5, 1).End();
  moving.Rapid(0, 2).Line(3, -5, 1).End();
  CHECK(Agree(a, standing));
  CHECK_FALSE(Agree(a, moving));
}

TEST_CASE("spindle states count where the tool cuts, not where they are written") {
  Trace a, b, other;
  a.Turn(ir::SpindleState::kCw).Value(EventKind::kSpindleSpeed, 800).Rapid(1, 1).Line(1, 0, 1).End();
  b.Rapid(1, 1)
      .Value(EventKind::kSpindleSpeed, 800)
      .Turn(ir::SpindleState::kCw)
      .Value(EventKind::kSpindleSpeed, 800)
      .Line(1, 0, 1)
      .End();
  other.Value(EventKind::kSpindleSpeed, 900).Turn(ir::SpindleState::kCw).Rapid(1, 1).Line(1, 0, 1).End();
  CHECK(Agree(a, b));
  CHECK(Compare(a.recorded, b.recorded, {}).spindle_moved_across_rapid == 1);
  CHECK_FALSE(Agree(a, other));
}

TEST_CASE("a speed may be off by the error of its own word, a length by no more than its own") {
  Trace computed, whole, other;
  computed.Value(EventKind::kSpindleSpeed, 213.4).Line(1, 0, 1).End();
  whole.Value(EventKind::kSpindleSpeed, 213).Line(1, 0, 1).End();
  other.Value(EventKind::kSpindleSpeed, 214).Line(1, 0, 1).End();
  CompareOptions options;
  CHECK(Compare(computed.recorded, whole.recorded, options).difference);
  options.target.speed_error = 0.5;
  CHECK_FALSE(Compare(computed.recorded, whole.recorded, options).difference);
  CHECK(Compare(computed.recorded, other.recorded, options).difference);
}

TEST_CASE("a second spindle counts as the first one does") {
  const auto second = [](double speed) {
    Event event;
    event.kind = EventKind::kSpindleSpeed;
    event.spindle = 2;
    event.value = speed;
    return event;
  };
  Trace a, b, c;
  a.Put(second(500)).Line(1, 2, 100).End();
  b.Put(second(600)).Line(1, 2, 100).End();
  c.Line(1, 2, 100).End();
  CHECK_FALSE(Compare(a.recorded, a.recorded, {}).difference);
  CHECK(Compare(a.recorded, b.recorded, {}).difference);
  CHECK(Compare(a.recorded, c.recorded, {}).difference);
}

TEST_CASE("the speed limit must be in force before constant surface speed") {
  Trace a, late;
  a.Value(EventKind::kSpindleLimit, 3000).Value(EventKind::kSpindleSurface, 180).Rapid(1, 1).Line(1, 0, 1).End();
  late.Value(EventKind::kSpindleSurface, 180);
  late.Rapid(1, 1);
  Event limit;
  limit.kind = EventKind::kSpindleLimit;
  limit.value = 3000;
  limit.block = ir::BlockId{7U};
  late.Put(limit).Line(1, 0, 1).End();
  CHECK_FALSE(Agree(a, late));
}

TEST_CASE("tools, work offsets and M functions go through the maps") {
  CompareOptions options;
  Trace a, b;
  a.Text(EventKind::kTool, "ROUGH")
      .Number(EventKind::kWorkOffset, 505)
      .Number(EventKind::kAux, 41)
      .Number(EventKind::kAux, 77)
      .Rapid(1, 1)
      .End();
  b.Number(EventKind::kTool, 3).Number(EventKind::kWorkOffset, 54).Number(EventKind::kAux, 141).Rapid(1, 1).End();
  CHECK_FALSE(Agree(a, b, options));
  options.maps.tools_mapped = true;
  ToolPair tool;
  tool.source_name = "ROUGH";
  tool.target_tool = 3;
  options.maps.tools.push_back(tool);
  options.maps.work_offsets.push_back({505, 54, 0, 0});
  options.maps.aux.push_back({41, 141});
  options.maps.aux.push_back({77, std::nullopt});
  CHECK(Agree(a, b, options));
  options.maps.tools[0].target_tool = 4;
  CHECK_FALSE(Agree(a, b, options));
}

TEST_CASE("the offset in force belongs to the tool that is in, not to the one that stands ready") {
  CompareOptions options;
  options.maps.tools_mapped = true;
  options.maps.separate_registers = true;
  for (const std::uint32_t tool : {1U, 2U}) {
    ToolPair pair;
    pair.source_tool = pair.target_tool = pair.target_offset = pair.target_radius = tool;
    pair.source_edge = 1;
    options.maps.tools.push_back(pair);
  }
  const auto program = [](Trace& trace, bool source, std::uint32_t length) {
    const auto tool = [&](std::uint32_t number) {
      Event event;
      event.kind = EventKind::kTool;
      event.number = number;
      event.tool_waits = true;
      trace.Put(event);
    };
    tool(1);
    Event change;
    change.kind = EventKind::kAux;
    change.number = 6;
    change.tool_change = true;
    trace.Put(change);
    Event offset;
    offset.kind = EventKind::kOffset;
    offset.offset = source ? exec::OffsetKind::kEdge : exec::OffsetKind::kLength;
    offset.number = source ? 1 : length;
    trace.Put(offset);
    tool(2);  // stands ready while tool 1 cuts
    trace.Rapid(1, 1).Line(1, 0, 1).End();
  };
  Trace edges, right, wrong;
  program(edges, true, 0);
  program(right, false, 1);
  program(wrong, false, 2);
  CHECK(Agree(edges, right, options));
  CHECK_FALSE(Agree(edges, wrong, options));
}

TEST_CASE("messages count unless the report lists them as lost") {
  CompareOptions options;
  Trace a, b;
  a.Text(EventKind::kMessage, "LAYER 1").Rapid(1, 1).End();
  b.Rapid(1, 1).End();
  CHECK_FALSE(Agree(a, b, options));
  options.maps.messages_lost = true;
  CHECK(Agree(a, b, options));
}

TEST_CASE("alarms agree by class across languages and by their first word within one") {
  CompareOptions options;
  Trace a, b;
  a.Rapid(1, 1).Alarm(ir::AlarmClass::kArithmetic, "14051");
  b.Rapid(1, 1).Alarm(ir::AlarmClass::kArithmetic, "112");
  CHECK(Agree(a, b, options));
  options.maps.cross_language = false;
  CHECK_FALSE(Agree(a, b, options));
}

TEST_CASE("a piece of a split rapid that leaves an axis unknown is not its end") {
  CompareOptions options;
  options.maps.split_rapids.push_back(0);
  Trace a, b;
  Event whole;
  whole.kind = EventKind::kRapid;
  whole.known_axes = whole.moved_axes = kX | kZ;
  whole.position[0] = 25;
  whole.position[2] = 50;
  whole.block = ir::BlockId{0U};
  a.Put(whole).Line(20, 50, 0.2).End();
  Event piece = whole;
  piece.known_axes = piece.moved_axes = kX;
  b.Put(piece).Put(whole).Line(20, 50, 0.2).End();
  CHECK(Agree(a, b, options));
}

TEST_CASE("a work offset that the head of the target selected is no event again, another one is a difference") {
  for (const std::uint32_t number : {54U, 55U}) {
    Trace a, b;
    a.Number(EventKind::kWorkOffset, 54).Rapid(1, 1).End();
    b.Added().Number(EventKind::kWorkOffset, number).Rapid(1, 1).End();
    CHECK(Agree(a, b) == (number == 54));
  }
}

TEST_CASE("a split rapid ends where the rapid does") {
  CompareOptions options;
  options.maps.split_rapids.push_back(0);
  Trace a, b, wrong;
  Event start;
  start.kind = EventKind::kRapid;
  start.known_axes = start.moved_axes = kX | kZ;
  start.block = ir::BlockId{0U};
  start.position[0] = 10;
  start.position[2] = 20;
  a.Put(start).End();
  b.Rapid(10, 0).Rapid(10, 20).End();
  wrong.Rapid(10, 0).Rapid(10, 19).End();
  CHECK(Agree(a, b, options));
  CHECK_FALSE(Agree(a, wrong, options));
}

TEST_CASE("the spindle counts where the program stops, dwells or changes the tool") {
  using State = ir::SpindleState;
  for (const EventKind kind : {EventKind::kStop, EventKind::kOptionalStop, EventKind::kDwell, EventKind::kTool}) {
    CAPTURE(static_cast<int>(kind));
    Trace turning, standing, other;
    turning.Turn(State::kCw).Number(kind, 1).Turn(State::kStop).End();
    standing.Turn(State::kCw).Turn(State::kStop).Number(kind, 1).End();
    other.Turn(State::kCcw).Number(kind, 1).Turn(State::kStop).End();
    CHECK(Agree(turning, turning));
    CHECK_FALSE(Agree(turning, standing));
    CHECK_FALSE(Agree(turning, other));
  }
  Trace plain, stopped;
  plain.Turn(State::kCw).Number(EventKind::kTool, 1).Turn(State::kStop).End();
  stopped.Turn(State::kCw).Added().Turn(State::kStop).Number(EventKind::kTool, 1).Turn(State::kStop).End();
  CHECK(Agree(plain, stopped));  // a frame of the target stops it for the change
}

TEST_CASE("tools of one number with other decimals, reference points and signs of a length are told apart") {
  const auto one = [](EventKind kind, std::uint32_t number, std::uint32_t extension, bool minus) {
    Event event;
    event.kind = kind;
    event.number = number;
    event.extension = extension;
    event.offset = exec::OffsetKind::kLength;
    event.length_minus = minus;
    return event;
  };
  const auto agree = [](const Event& a, const Event& b) {
    Trace left, right;
    left.Put(a).End();
    right.Put(b).End();
    CompareOptions options;
    options.maps.cross_language = false;
    return Agree(left, right, options);
  };
  CHECK(agree(one(EventKind::kTool, 1, 1, false), one(EventKind::kTool, 1, 1, false)));
  CHECK_FALSE(agree(one(EventKind::kTool, 1, 1, false), one(EventKind::kTool, 1, 2, false)));
  CHECK_FALSE(agree(one(EventKind::kReference, 0, 0, false), one(EventKind::kReference, 2, 0, false)));
  CHECK_FALSE(agree(one(EventKind::kOffset, 1, 0, false), one(EventKind::kOffset, 1, 0, true)));
}

TEST_CASE("reference points of one kind are told apart by their number") {
  const auto agree = [](ir::ReferenceKind a, std::uint32_t point_a, ir::ReferenceKind b, std::uint32_t point_b) {
    Trace left, right;
    Event event;
    event.kind = EventKind::kReference;
    event.number = static_cast<std::uint32_t>(a);
    event.extension = point_a;
    left.Put(event).End();
    event.number = static_cast<std::uint32_t>(b);
    event.extension = point_b;
    right.Put(event).End();
    CompareOptions options;
    options.maps.cross_language = true;
    return Agree(left, right, options);
  };
  constexpr auto kFixed = ir::ReferenceKind::kFixedPoint;
  constexpr auto kSecond = ir::ReferenceKind::kSecondReference;
  constexpr auto kReference = ir::ReferenceKind::kReference;
  CHECK_FALSE(agree(kFixed, 1, kFixed, 2));
  CHECK(agree(kFixed, 0, kFixed, 1));
  CHECK(agree(kFixed, 2, kFixed, 2));
  CHECK(agree(kReference, 0, kFixed, 1));
  CHECK_FALSE(agree(kReference, 0, kFixed, 2));
  CHECK(agree(kSecond, 0, kSecond, 2));
  CHECK_FALSE(agree(kSecond, 0, kSecond, 3));
}

TEST_CASE("an alarm without a number is known by its class") {
  Trace numbered, plain, range;
  numbered.Alarm(ir::AlarmClass::kArithmetic, "PS0112");
  plain.Alarm(ir::AlarmClass::kArithmetic, "");
  range.Alarm(ir::AlarmClass::kRange, "");
  CompareOptions options;
  options.maps.cross_language = false;
  CHECK(Agree(numbered, plain, options));
  CHECK_FALSE(Agree(numbered, range, options));
}

TEST_CASE("a step of nothing on the way to the reference point is no move, any other step is one") {
  const auto reference = [] {
    Event event;
    event.kind = EventKind::kReference;
    event.moved_axes = 4;
    return event;
  };
  const auto by_way = [&](double z) {
    Event event;
    event.kind = EventKind::kRapid;
    event.moved_axes = 4;
    event.known_axes = 5;
    event.position[0] = 1;
    event.position[2] = z;
    return event;
  };
  Trace straight, nothing, step, open, blind;
  straight.Line(1, 2, 100).Put(reference()).End();
  nothing.Line(1, 2, 100).Put(by_way(2)).Put(reference()).End();
  step.Line(1, 2, 100).Put(by_way(1)).Put(reference()).End();
  CHECK(Agree(straight, nothing));
  CHECK_FALSE(Agree(straight, step));
  // Where the axis stood is not known: it may move.
  open.Put(reference()).Line(1, 2, 100).End();
  blind.Put(by_way(0)).Put(reference()).Line(1, 2, 100).End();
  CHECK_FALSE(Agree(open, blind));
}

TEST_CASE("the path mode counts at motions, wherever it was selected") {
  const auto path = [](ir::PathMode mode, bool one_block = false) {
    Event event;
    event.kind = EventKind::kPath;
    event.path = mode;
    event.one_block = one_block;
    return event;
  };
  Trace a, head, other;
  a.Put(path(ir::PathMode::kExact)).Line(1, 1, 1).End();
  head.Added().Put(path(ir::PathMode::kExact)).Line(1, 1, 1).End();
  other.Put(path(ir::PathMode::kContinuous)).Line(1, 1, 1).End();
  CHECK(Agree(a, head));
  CHECK_FALSE(Agree(a, other));
  // A return puts back what was in force before any word chose, and so does the word that the translation added.
  Trace back, added, left;
  back.Put(path(ir::PathMode::kContinuous)).Line(1, 1, 1).Put(path(ir::PathMode::kUnknown)).Line(2, 2, 2).End();
  added.Put(path(ir::PathMode::kContinuous)).Line(1, 1, 1);
  added.Added().Put(path(ir::PathMode::kExact)).Line(2, 2, 2).End();
  left.Put(path(ir::PathMode::kContinuous)).Line(1, 1, 1).Line(2, 2, 2).End();
  CHECK(Agree(back, added));
  CHECK_FALSE(Agree(back, left));
  // Also where the mode of the start, which a block at the head names, is the one that the callee left.
  Trace none, same, other_mode;
  none.Put(path(ir::PathMode::kExact)).Line(1, 1, 1).Put(path(ir::PathMode::kUnknown)).Line(2, 2, 2).End();
  same.Added().Put(path(ir::PathMode::kContinuous)).Put(path(ir::PathMode::kExact)).Line(1, 1, 1);
  same.Added().Put(path(ir::PathMode::kContinuous)).Line(2, 2, 2).End();
  other_mode.Added().Put(path(ir::PathMode::kContinuous)).Put(path(ir::PathMode::kExact)).Line(1, 1, 1);
  other_mode.Line(2, 2, 2).End();
  CHECK(Agree(none, same));
  CHECK_FALSE(Agree(none, other_mode));
  // An exact stop of one block, before and behind which the source does not say its mode: the head of the target does.
  Trace once, target, stays;
  once.Put(path(ir::PathMode::kExact, true)).Line(1, 1, 1).Put(path(ir::PathMode::kUnknown, true)).Line(2, 1, 1).End();
  target.Added().Put(path(ir::PathMode::kContinuous)).Put(path(ir::PathMode::kExact, true)).Line(1, 1, 1);
  target.Put(path(ir::PathMode::kContinuous, true)).Line(2, 1, 1).End();
  stays.Put(path(ir::PathMode::kExact)).Line(1, 1, 1).Line(2, 1, 1).End();
  CHECK(Agree(once, target));
  CHECK_FALSE(Agree(once, stays));
}

}  // namespace
}  // namespace ncport::prove
