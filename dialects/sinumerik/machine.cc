#include "dialects/sinumerik/machine.h"

#include "dialects/machine_parts.h"
#include "dialects/sinumerik/words.h"

namespace ncport::dialects::sinumerik {
namespace {

using Op = ir::WordOp;
using A = ir::AlarmClass;

// Card section 10: numbers that appear in a source. Others are not printed.
constexpr AlarmRow kAlarms[] = {
    {A::kArithmetic, "14051", "arithmetic error in part program"},
    {A::kConversion, "14096", "type conversion not possible"},
    {A::kIndex, "17020", "illegal array index"},
    {A::kMissingTarget, "14080", "jump target not found"},
    {A::kMissingProgram, "14011", "program does not exist"},
    {A::kNesting, "14012", "lowest subprogram level exceeded"},
    {A::kCircle, "14040", "error in end point of circle"},
    {A::kMissingFeed, "14800", "programmed path velocity is zero or less"},
    {A::kUnknownCode, "12470", "G function is unknown"},
    {A::kSyntax, "12080", "syntax error in text"},
    {A::kProgramEnd, "14000", "illegal end of file"},
    {A::kNoTransverseAxis, "16510", "no transverse axis"},
};

/// Index words of `$P_GG[group]` (card 8.1). Groups without a state in the IR stay out: their value is not known.
void SetGroups(ir::Machine& machine) {
  auto& groups = machine.groups;
  const auto mode = [&](std::uint16_t group, Op op, auto value, double index) {
    groups.push_back(ModeCode(group, op, value, index));
  };
  mode(1, Op::kMotion, ir::Motion::kRapid, 1);
  mode(1, Op::kMotion, ir::Motion::kLinear, 2);
  mode(1, Op::kMotion, ir::Motion::kArcCw, 3);
  mode(1, Op::kMotion, ir::Motion::kArcCcw, 4);
  mode(1, Op::kMotion, ir::Motion::kArcVia, 5);
  mode(1, Op::kMotion, ir::Motion::kThread, 10);
  mode(1, Op::kMotion, ir::Motion::kTapIn, 11);
  mode(1, Op::kMotion, ir::Motion::kTapOut, 12);
  mode(1, Op::kMotion, ir::Motion::kArcTangent, 15);
  mode(1, Op::kMotion, ir::Motion::kThreadIncreasing, 16);
  mode(1, Op::kMotion, ir::Motion::kThreadDecreasing, 17);
  mode(6, Op::kPlane, ir::Plane::kXY, 1);
  mode(6, Op::kPlane, ir::Plane::kZX, 2);
  mode(6, Op::kPlane, ir::Plane::kYZ, 3);
  mode(7, Op::kCutterComp, ir::CutterComp::kOff, 1);
  mode(7, Op::kCutterComp, ir::CutterComp::kLeft, 2);
  mode(7, Op::kCutterComp, ir::CutterComp::kRight, 3);
  groups.push_back(OffsetCode(8, 0, 1));
  for (std::uint32_t number = 54; number <= 57; ++number) groups.push_back(OffsetCode(8, number, number - 52.0));
  for (std::uint32_t number = 505; number <= 599; ++number) groups.push_back(OffsetCode(8, number, number - 499.0));
  mode(13, Op::kUnits, ir::Units::kInchGeometry, 1);
  mode(13, Op::kUnits, ir::Units::kMmGeometry, 2);
  mode(13, Op::kUnits, ir::Units::kInch, 3);
  mode(13, Op::kUnits, ir::Units::kMm, 4);
  mode(14, Op::kDistance, ir::Distance::kAbsolute, 1);
  mode(14, Op::kDistance, ir::Distance::kIncremental, 2);
  mode(15, Op::kSpeedMode, ir::SpeedMode::kConstantSurface, 4);
  mode(15, Op::kFeedMode, ir::FeedMode::kInverseTime, 1);
  mode(15, Op::kFeedMode, ir::FeedMode::kPerMinute, 2);
  mode(15, Op::kFeedMode, ir::FeedMode::kPerRevolution, 3);
  mode(29, Op::kDiameter, ir::Diameter::kRadius, 1);
  mode(29, Op::kDiameter, ir::Diameter::kDiameter, 2);
  mode(29, Op::kDiameter, ir::Diameter::kDiameterAbsolute, 3);
}

}  // namespace

void FillMachine(const Profile& profile, ir::Machine& machine) {
  const SinumerikSettings& settings = profile.sinumerik;
  machine.compare_tolerance = settings.compare_tolerance.Or(1e-12);               // sinumerik-4.2
  machine.string_max = 200;                                                       // sinumerik-2.5
  machine.program_variables_visible = settings.main_variables_visible.Or(false);  // sinumerik-3.6
  machine.circle_tolerance = settings.circle_tolerance.Or(0.01);                  // sinumerik-8.3
  machine.circle_tolerance_factor = settings.circle_tolerance_factor.Or(0.001);
  machine.incremental_traverses_frame = settings.incremental_traverses_frame.Or(false);                // sinumerik-8.2
  machine.rotation_order_rpy = !settings.rotation_order.Is(SinumerikSettings::RotationOrder::kEuler);  // sinumerik-8.7
  machine.chamfer_feed_from_next = !settings.corner_feed.Is(SinumerikSettings::CornerFeed::kOwn);      // sinumerik-8.9
  machine.frame_shift_in_diameter = settings.frames_as_diameter.Or(false);                             // sinumerik-8.5
  machine.tool_word_changes = settings.tool_change.Is(SinumerikSettings::ToolChange::kAtT);            // sinumerik-8.8
  machine.tool_activates_edge = settings.change_selects_edge.Or(true);                                 // sinumerik-8.8
  machine.for_end_once = !settings.for_end_each_pass.Or(false);                                        // sinumerik-6.3
  machine.modal_call_trigger = ir::ModalCallTrigger::kMotionBlocks;                                    // sinumerik-7.1
  // sinumerik-8.11: 62000 and 66000 clear with CANCEL, 67000 only displays; all others stop.
  machine.shown_alarms = {{62000, 62999}, {66000, 67999}};
  SetAlarms(kAlarms, machine);
  SetComputedCodes(Codes(), machine);
  SetGroups(machine);
}

}  // namespace ncport::dialects::sinumerik
