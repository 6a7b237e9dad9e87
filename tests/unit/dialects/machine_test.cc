#include "dialects/machine.h"

#include <doctest/doctest.h>

#include "dialects/registry.h"

namespace ncport::dialects {
namespace {

const ir::Machine::Alarm& AlarmOf(const ir::Machine& machine, ir::AlarmClass alarm) {
  return machine.alarms[static_cast<std::size_t>(alarm)];
}

TEST_CASE("the start state of the vectors: SINUMERIK mill and lathe") {
  const ir::Machine mill = MachineFor(BuiltIn("sinumerik-840d-mill"));
  CHECK(mill.start.motion == ir::Motion::kLinear);
  CHECK(mill.start.plane == ir::Plane::kXY);
  CHECK(mill.start.units == ir::Units::kMmGeometry);
  CHECK(mill.start.distance == ir::Distance::kAbsolute);
  CHECK(mill.start.work_offset == ir::WorkOffset{true, 0, 0});
  CHECK(mill.start.diameter == ir::Diameter::kRadius);
  CHECK_FALSE(mill.position_known);
  CHECK(mill.transverse_axis == 0xFF);
  CHECK(mill.compare_tolerance == 1e-12);
  CHECK(mill.word_error == ir::WordError::kNone);
  CHECK_FALSE(mill.program_variables_visible);
  CHECK_FALSE(mill.incremental_traverses_frame);
  CHECK(mill.call_depth == 15);
  const ir::Machine lathe = MachineFor(BuiltIn("sinumerik-840d-lathe"));
  CHECK(lathe.transverse_axis == 0);
  CHECK(lathe.lathe);
  CHECK(lathe.start.plane == ir::Plane::kZX);
  CHECK(MachineFor(BuiltIn("sinumerik-802s-lathe")).call_depth == 3);
}

TEST_CASE("the centre of a flat arc is where its words put it") {
  // iso-6; SINUMERIK moves it between both ends (sinumerik-8.3).
  CHECK_FALSE(MachineFor(BuiltIn("iso-mill")).arc_center_corrected);
  CHECK(MachineFor(BuiltIn("sinumerik-840d-mill")).arc_center_corrected);
}

TEST_CASE("the start state of the vectors: Fanuc") {
  const ir::Machine mill = MachineFor(BuiltIn("fanuc-mill"));
  CHECK(mill.start.motion == ir::Motion::kRapid);
  CHECK(mill.start.work_offset.number == 54);
  CHECK(mill.word_error == ir::WordError::kRound);
  CHECK(mill.circle_tolerance_factor == 0);
  CHECK(mill.return_in_main_restarts);
  CHECK(mill.rapid == ir::Rapid::kDogleg);
  const ir::Machine lathe = MachineFor(BuiltIn("fanuc-lathe-a"));
  CHECK(lathe.start.feed_mode == ir::FeedMode::kPerRevolution);
  CHECK(lathe.start.diameter == ir::Diameter::kDiameter);
  CHECK(lathe.transverse_axis == 0);
  const ir::Machine qtn = MachineFor(BuiltIn("mazak-qtn"));
  CHECK(qtn.start.motion == ir::Motion::kUnknown);
  CHECK_FALSE(qtn.start.work_offset.known);
  CHECK(AlarmOf(qtn, ir::AlarmClass::kArithmetic).code.empty());  // Fanuc's numbers are not Mazak's
}

TEST_CASE("the start state of the vectors: NUM") {
  const ir::Machine mill = MachineFor(BuiltIn("num-mill"));
  CHECK(mill.start.motion == ir::Motion::kLinear);
  CHECK(mill.numeric_model == ir::NumericModel::kNum8);
  CHECK(mill.word_error == ir::WordError::kTruncate);
  CHECK(mill.circle_tolerance == 0.02);
  CHECK(MachineFor(BuiltIn("num-lathe")).transverse_axis == 0);
}

TEST_CASE("alarms carry the numbers of the card") {
  const ir::Machine sinumerik = MachineFor(BuiltIn("sinumerik-840d-mill"));
  CHECK(AlarmOf(sinumerik, ir::AlarmClass::kArithmetic).code == "14051");
  CHECK(AlarmOf(sinumerik, ir::AlarmClass::kMissingTarget).code == "14080");
  CHECK(AlarmOf(sinumerik, ir::AlarmClass::kRange).code.empty());  // 12100 is not certain
  CHECK(AlarmOf(MachineFor(BuiltIn("fanuc-mill")), ir::AlarmClass::kArithmetic).code == "PS0112");
  CHECK(AlarmOf(MachineFor(BuiltIn("num-mill")), ir::AlarmClass::kArithmetic).code == "94");
}

TEST_CASE("computed codes are found by number") {
  const ir::Machine machine = MachineFor(BuiltIn("sinumerik-840d-mill"));
  const auto meaning = [](const std::vector<ir::CodeMeaning>& codes, std::uint32_t tenths) -> const ir::CodeMeaning* {
    for (const ir::CodeMeaning& code : codes) {
      if (code.tenths == tenths) return &code;
    }
    return nullptr;
  };
  REQUIRE(meaning(machine.g_codes, 180) != nullptr);
  CHECK(meaning(machine.g_codes, 180)->op == ir::WordOp::kPlane);
  CHECK(meaning(machine.g_codes, 180)->index == static_cast<std::uint8_t>(ir::Plane::kZX));
  CHECK(meaning(machine.m_codes, 50)->op == ir::WordOp::kSpindle);
  CHECK(meaning(machine.g_codes, 40) == nullptr);  // G4 needs words of its block
  for (std::size_t i = 1; i < machine.g_codes.size(); ++i)
    CHECK(machine.g_codes[i - 1].tenths < machine.g_codes[i].tenths);
}

TEST_CASE("settings of the profile reach the machine") {
  Profile profile = BuiltIn("sinumerik-840d-mill");
  profile.sinumerik.rotation_order.Set(SinumerikSettings::RotationOrder::kEuler);
  profile.sinumerik.corner_feed.Set(SinumerikSettings::CornerFeed::kOwn);
  profile.sinumerik.main_variables_visible.Set(true);
  profile.sinumerik.for_end_each_pass.Set(true);
  profile.axes = {"X", "Z", "X1"};
  const ir::Machine machine = MachineFor(profile);
  CHECK_FALSE(machine.rotation_order_rpy);
  CHECK_FALSE(machine.chamfer_feed_from_next);
  CHECK(machine.program_variables_visible);
  CHECK_FALSE(machine.for_end_once);
  CHECK(machine.axes == (1U | 4U | (1U << ir::kFirstNamedAxis)));
}

}  // namespace
}  // namespace ncport::dialects
