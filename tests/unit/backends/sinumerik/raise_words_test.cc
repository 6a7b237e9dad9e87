// ArrangeWords, SettleArcs, WriteStartModes on dumps.
#include "backends/sinumerik/raise_words.h"

#include "tests/unit/backends/sinumerik/pass_fixture.h"

namespace ncport::backends::sinumerik {
namespace {

using ir::test::Show;
using test::Passed;
using test::Setting;

Passed Arranged(std::string_view blocks, const Setting& setting = {}, Show show = Show::kPlain) {
  return test::Run(blocks, ArrangeWords, setting, show);
}

void Refused(const Passed& passed, std::string_view why) {
  CHECK(passed.findings == "NC6001");
  CHECK_MESSAGE(passed.messages.find(why) != std::string::npos, passed.messages);
}

TEST_CASE("arrange_words: words that SINUMERIK reads alike stay as they are") {
  const Passed passed = Arranged(
      "  @m:1 N10 : motion rapid; axis X = 1\n    ; end-of-block \"note\"\n"
      "  @m:2 : motion linear; axis Y = 2; feed = 100; spindle cw; speed = 800\n"
      "  @m:3 : dwell-seconds = 2\n"
      "  @m:4 : return plain\n",
      {}, Show::kMarks);
  CHECK(passed.findings.empty());
  CHECK(passed.text ==
        "N10 motion rapid; axis X = 1\n    ; end-of-block \"note\"\n"
        "motion linear; axis Y = 2; feed = 100; spindle cw; speed = 800\n"
        "dwell-seconds = 2\n"
        "return plain\n");
}

TEST_CASE("arrange_words: a dwell stands alone, between what acts before and behind the motion (sinumerik-8.2)") {
  const Passed passed = Arranged(
      "  @m:1 skip 1 N10 : dwell-seconds = 2; spindle cw; stop\n    ; end-of-block \"note\"\n", {}, Show::kMarks);
  CHECK(passed.text ==
        "skip 1 N10 spindle cw\n    ; end-of-block \"note\"\n"
        "skip 1 dwell-seconds = 2\n"
        "skip 1 stop\n");
}

TEST_CASE("arrange_words: words that switch off what nothing switches on go") {
  CHECK(Arranged("  @m:1 : cycle none; polar-mode 0; length-offset; frame rotate-end; plane xy\n").text ==
        "edge = 0; plane xy\n");
  CHECK(Arranged("  @m:1 : frame rotate-end\n  @m:2 : frame rotate-about; frame-angle = 5\n").text.find("rotate-end") !=
        std::string::npos);
  CHECK(Arranged("  @m:1 : cycle none\n  @m:2 : cycle drill; axis Z = 1\n").text.find("cycle none") !=
        std::string::npos);
}

TEST_CASE("arrange_words: RET stands alone, M17 may share its block (sinumerik-1.2)") {
  CHECK(Arranged("  @m:1 : axis X = 1; return plain\n").text == "axis X = 1; return auxiliary\n");
  CHECK(Arranged("  @m:1 : return to-caller = 100\n").text == "return to-caller = \"N100\"\n");
  Refused(Arranged("  @m:1 : axis X = 1; return to-caller = 100\n"), "beside a return to a block");
}

TEST_CASE("arrange_words: group 15 holds feed and spindle modes: changes that end the other one are refused") {
  // The mode that is in force anyway says nothing.
  CHECK(Arranged("  @m:1 : feed-mode per-minute; axis X = 1\n").text == "axis X = 1\n");
  CHECK(Arranged("  @m:1 : feed-mode per-revolution; feed = 0.2\n").findings.empty());
  Refused(Arranged("  @m:1 : feed-mode per-revolution; feed = 0.2\n  @m:2 : speed-mode constant-surface; speed = 100\n"
                   "  @m:3 : feed-mode per-minute; feed = 100\n"),
          "constant surface speed");
  Refused(Arranged("  @m:1 : speed-mode constant-surface; speed = 100\n"), "where the feed may be per minute");
}

TEST_CASE("arrange_words: a change of the feed's unit needs an F before anything moves at feed") {
  Setting keeps;
  keeps.machine = [](ir::Machine& machine) { machine.feed_type_change_drops_feed = false; };
  const std::string change = "  @m:1 : feed-mode per-revolution\n";
  CHECK(Arranged(change + "  @m:2 : feed = 0.2; motion linear; axis X = 1\n", keeps).findings.empty());
  CHECK(Arranged(change + "  @m:2 : motion rapid; axis X = 1\n  @m:3 : motion linear; feed = 0.2; axis X = 2\n", keeps)
            .findings.empty());
  for (const char* behind :
       {"  @m:2 : motion linear; axis X = 1\n  @m:3 : feed = 0.2\n", "  @m:2 skip 1 : feed = 0.2\n",
        "  @m:2 label A : motion rapid; axis X = 2\n  @m:3 : feed = 0.2\n",
        "  @m:2 : call name S\n  @m:3 : feed = 0.2\n", ""}) {
    CAPTURE(behind);
    Refused(Arranged(change + behind, keeps), "keeps the number F");
  }
}

TEST_CASE("arrange_words: the lead of a thread is F there, the centre word of the axis here") {
  Setting lathe;
  lathe.lathe = true;
  const Passed passed = Arranged("  @m:1 : motion thread; axis Z = -10; feed = 1.5\n", lathe);
  CHECK(passed.findings.empty());
  CHECK(passed.text == "motion thread; axis Z = -10; feed = 1.5; center K step = 1.5\n");
  Refused(Arranged("  @m:1 : feed = 1.5\n  @m:2 : motion thread; axis Z = -10\n", lathe), "lead stands in another");
  Refused(Arranged("  @m:1 : motion thread-increasing; axis Z = -10; feed = 1.5\n", lathe), "changing lead");
}

TEST_CASE("arrange_words: the lead of a taper goes under the letter of the longer side (sinumerik-8.4)") {
  Setting lathe;
  lathe.lathe = true;
  const std::string start =
      "  @m:1 : diameter diameter; units mm; distance absolute; motion rapid; axis X = 50; axis Z = 0\n";
  const auto lead = [&](const std::string& blocks) {
    const Passed passed = Arranged(blocks, lathe);
    CHECK_MESSAGE(passed.findings.empty(), passed.messages);
    const std::size_t at = passed.text.rfind("center ");
    return at == std::string::npos ? std::string() : passed.text.substr(at, 8);
  };
  CHECK(lead(start + "  @m:2 : motion thread; axis X = 52; axis Z = -10; feed = 1.5\n") == "center K");
  CHECK(lead(start + "  @m:2 : motion thread; axis X = 90; axis Z = -10; feed = 1.5\n") == "center I");
  // 30 mm of diameter are 15 mm of way. As long as the other: either letter says the same.
  CHECK(lead(start + "  @m:2 : motion thread; axis X = 80; axis Z = -15.001; feed = 1.5\n") == "center K");
  CHECK(lead(start + "  @m:2 : motion thread; axis X = 80; axis Z = -14.999; feed = 1.5\n") == "center I");
  CHECK(lead(start + "  @m:2 : motion thread; axis X = 80; axis Z = -15; feed = 1.5\n") == "center K");
  // Increments need no start.
  CHECK(lead("  @m:1 : diameter diameter; units mm; motion thread; axis X incremental = 2; axis Z incremental = -10; "
             "feed = 1.5\n") == "center K");
  // A value that is known from the run before.
  CHECK(lead("  @m:1 : assign R[1] = 60\n" + start +
             "  @m:3 : motion thread; axis X = R[1]; axis Z = -10; feed = 1.5\n") == "center K");
  const std::string thread = "  @m:3 : motion thread; axis X = 52; axis Z = -10; feed = 1.5\n";
  const std::string_view open = "points that are not known";
  Refused(Arranged(thread, lathe), open);
  Refused(Arranged(start + "  @m:2 : edge = 1\n" + thread, lathe), open);
  Refused(Arranged(start + "  @m:2 : motion thread; axis X = R[1]; axis Z = -10; feed = 1.5\n", lathe), open);
  Refused(Arranged(start + "  @m:2 skip 1 : axis X = 90\n" + thread, lathe), "not the same in every run");
  Refused(Arranged(start + "  @m:2 : frame rotate-about; frame-angle = 5\n" + thread, lathe), "rotates or scales");
  Refused(Arranged(start + "  @m:2 : motion thread; axis X = 1; axis Y = 1; axis Z = -10; feed = 1.5\n", lathe),
          "more than two axes");
}

TEST_CASE("arrange_words: the reference point by way of the words' point, then the motion as it was") {
  CHECK(Arranged("  @m:1 : motion linear; feed = 100; axis X = 1\n"
                 "  @m:2 N20 : distance incremental; reference reference; axis Z = 5\n")
            .text ==
        "motion linear; feed = 100; axis X = 1\n"
        "N20 distance incremental; motion rapid; axis Z = 5\n"
        "reference fixed-point; inert = 1; axis Z = 0\n"
        "motion linear\n");
  // A step of nothing is no way: no rapid that would need the motion again.
  CHECK(Arranged("  @m:1 : motion linear; feed = 100; axis X = 1\n"
                 "  @m:2 N20 : distance incremental; reference reference; axis Z = 0\n")
            .text ==
        "motion linear; feed = 100; axis X = 1\n"
        "N20 distance incremental\n"
        "reference fixed-point; inert = 1; axis Z = 0\n");
  Refused(Arranged("  @m:1 : reference second-reference; axis Z = 0\n"), "another point");
  Refused(Arranged("  @m:1 : reference reference\n"), "this move to the reference point");
  Refused(Arranged("  @m:1 skip 1 : reference reference; axis Z = 0\n"), "this move to the reference point");
  Refused(Arranged("  @m:1 : reference reference; axis Z = 0; radius = 100\n"), "a word beside");
}

Passed Settled(std::string_view blocks, const Setting& setting = {}) { return test::Run(blocks, SettleArcs, setting); }

TEST_CASE("settle_arcs: arcs and threads keep their words, a radius beats a centre (fanuc-8.3)") {
  const Passed passed = Settled(
      "  @m:1 : motion arc-cw; axis X = 1; axis Y = 2; center I step = 1\n"
      "  @m:2 : axis X = 2; radius = 5\n"
      "  @m:3 : axis X = 3; radius = 5; center I step = 1; center J step = 1\n"
      "  @m:4 : motion thread; axis Z = 1; center K step = 1\n");
  CHECK(passed.findings.empty());
  CHECK(passed.text ==
        "motion arc-cw; axis X = 1; axis Y = 2; center I step = 1\n"
        "axis X = 2; radius = 5\n"
        "axis X = 3; radius = 5\n"
        "motion thread; axis Z = 1; center K step = 1\n");
}

TEST_CASE("settle_arcs: words of an arc where none is certain to be in force are refused") {
  const std::string_view why = "no arc is certain";
  Refused(Settled("  @m:1 : motion linear; axis X = 1; radius = 5\n"), why);
  Refused(Settled("  @m:1 : motion rapid; axis X = 1; center I step = 5\n"), why);
  Refused(Settled("  @m:1 : motion arc-cw; axis X = 1; radius = 5\n"
                  "  @m:2 : jump forward label A = lt(R[1], 2)\n"
                  "  @m:3 : motion linear; axis X = 1\n"
                  "  @m:4 label A : axis X = 3; radius = 5\n"),
          why);
  Refused(Settled("  @m:1 : motion arc-cw; axis X = 1; radius = 5\n"
                  "  @m:2 skip 1 : motion linear; axis X = 1\n"
                  "  @m:3 : axis X = 3; radius = 5\n"),
          why);
  // Where no run comes it does not matter.
  CHECK(Settled("  @m:1 : jump forward label A\n  @m:2 : motion linear; axis X = 1; radius = 5\n  @m:3 label A : axis "
                "X = 1\n")
            .findings.empty());
}

TEST_CASE("settle_arcs: a radius without an end point is no motion there, an alarm here") {
  Setting stays;
  stays.machine = [](ir::Machine& machine) { machine.arc_radius_without_end_stays = true; };
  CHECK(Settled("  @m:1 : motion arc-cw; radius = 5\n", stays).text == "motion arc-cw\n");
  Refused(Settled("  @m:1 : motion arc-cw; axis Z = 1; radius = 5\n", stays), "without an end point");
  CHECK(Settled("  @m:1 : motion arc-cw; axis X = 1; radius = 5\n", stays).findings.empty());
}

TEST_CASE("start_modes: main programs write what their control promises, subprograms nothing") {
  const auto all = [](const RaiseInput& input, Translation& out, diag::Sink&) {
    WriteStartModes(input, out, false);
    return true;
  };
  Setting setting;
  setting.machine = [](ir::Machine& machine) {
    machine.start = {};
    machine.start.plane = ir::Plane::kXY;
    machine.start.distance = ir::Distance::kAbsolute;
    machine.start.speed_mode = ir::SpeedMode::kRpm;
  };
  const std::string programs =
      "program M main @m:0\n  @m:1 N10 : axis X = 1\nprogram S sub @m:10\n  @m:11 : axis X = 1\n";
  const Passed passed = test::RunAll(programs, all, setting, Show::kMarks);
  CHECK(passed.text ==
        "program M main\n"
        "added speed-mode rpm\n    ; end-of-block gap 1 \"added: start of the source control\"\n"
        "added plane xy; distance absolute\n    ; end-of-block gap 1 \"added: start of the source control\"\n"
        "N10 axis X = 1\n"
        "program S sub\n"
        "axis X = 1\n");
  CHECK(passed.out.added.size() == 1);
  setting.machine = [](ir::Machine& machine) { machine.start = {}; };
  const Passed none = test::RunAll(programs, all, setting);
  CHECK(none.text == "program M main\nN10 axis X = 1\nprogram S sub\naxis X = 1\n");
  CHECK(none.out.added.empty());
}

TEST_CASE("start_modes: only those that decide what a word means before the program sets them, behind definitions") {
  const auto relied = [](std::string_view blocks) {
    Setting setting;
    setting.machine = [](ir::Machine& machine) {
      machine.start = {};
      machine.start.motion = ir::Motion::kRapid;
      machine.start.plane = ir::Plane::kXY;
      machine.start.distance = ir::Distance::kAbsolute;
      machine.start.units = ir::Units::kMm;
      machine.start.feed_mode = ir::FeedMode::kPerMinute;
      machine.start.comp = ir::CutterComp::kOff;
    };
    return test::Run(
               "  var A real local\n" + std::string(blocks),
               [](const RaiseInput& input, Translation& out, diag::Sink&) {
                 WriteStartModes(input, out, true);
                 return true;
               },
               setting)
        .text;
  };
  CHECK(relied("  @m:1 : define A\n  @m:2 : plane xy; distance absolute; units mm; motion rapid; axis X = 1\n") ==
        "define A\nplane xy; distance absolute; units mm; motion rapid; axis X = 1\n");
  CHECK(relied("  @m:1 : define A\n  @m:2 : axis X = 1\n  @m:3 : motion linear; axis X = 2\n") ==
        "define A\nmotion rapid; plane xy; distance absolute; feed-mode per-minute; comp off; units mm\naxis X = 1\n"
        "motion linear; axis X = 2\n");
  // Set on one way only.
  CHECK(relied("  @m:1 : units mm; motion rapid; plane xy\n  @m:2 : jump forward label A = lt(R[1], 2)\n"
               "  @m:3 : distance incremental\n  @m:4 label A : axis X = 1\n")
            .starts_with("distance absolute\n"));
  CHECK(relied("  @m:1 : stop\n") == "stop\n");
}

}  // namespace
}  // namespace ncport::backends::sinumerik
