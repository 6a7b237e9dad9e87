#include "dialects/fanuc/machine.h"

#include <utility>

#include "dialects/fanuc/system_variables.h"
#include "dialects/fanuc/words.h"
#include "dialects/machine_parts.h"
#include "ir/axis_names.h"

namespace ncport::dialects::fanuc {
namespace {

using A = ir::AlarmClass;
using Variant = FanucSettings::Variant;

// Card section 11: numbers of 0i-D, 0i-F and 30i. Mazak and Haas have other numbers and print the class.
constexpr AlarmRow kAlarms[] = {
    {A::kArithmetic, "PS0112", "zero divide"},
    {A::kIndex, "PS0115", "variable number out of range"},
    {A::kMissingTarget, "PS0128", "sequence number not found"},
    {A::kMissingProgram, "PS0076", "program not found"},
    {A::kNesting, "PS0077", "too many sub,macro nesting"},
    {A::kCircle, "PS0020", "over tolerance of radius"},
    {A::kMissingFeed, "PS0011", "feed zero (command)"},
    {A::kUnknownCode, "PS0010", "improper G-code"},
};

/// Codes that #4000 + group reads (fanuc-9.4, mazak-lathe-6.7), from the code table of the system. Groups without a
/// state behind them (cycles, modal macros) stay out: their value is not known.
void SetGroups(const CodeTable& table, ir::Machine& machine) {
  for (const CodeRow& row : table.Rows()) {
    if (row.group == 0 || row.op == ir::WordOp::kLengthOffset) continue;
    double code = 0;
    for (const char digit : row.text.substr(1)) {
      if (digit == '.') break;
      code = code * 10 + (digit - '0');
    }
    machine.groups.push_back({row.group, row.op, row.index, row.extra, code});
  }
}

/// Codes beyond those of one meaning each, for numbers that programs compute (fanuc-5): of those that need words of
/// their block a run takes G54.1 with its P, and refuses the others (kVerbatim).
void SetOtherCodes(const Profile& profile, System system, ir::Machine& machine) {
  using Op = ir::WordOp;
  for (const SpecialRow& row : SpecialCodes()) {
    if (FindSpecial(system, row.text) != &row) continue;
    if (row.special == Special::kLocalSubprogram && !profile.fanuc.local_call.Or(false)) continue;
    const bool haas = profile.fanuc.variant.Is(Variant::kHaas);
    if (row.special == Special::kExtendedOffset && row.rule == kHaasRule && !haas) continue;
    ir::CodeMeaning meaning{.op = Op::kVerbatim};
    if (row.special == Special::kQuiet) meaning.op = Op::kInert;
    if (row.special == Special::kCycleEnd)
      meaning = {.op = Op::kCycle, .index = static_cast<std::uint8_t>(ir::Cycle::kNone)};
    if (row.special == Special::kExtendedOffset && (row.text == "G54.1" || row.text == "G154"))
      meaning = {.op = Op::kWorkOffset, .index = 1, .extra = 54};
    AddComputedCode(row.text, meaning, machine);
  }
  for (const CycleRow& row : Cycles()) {
    if (FindCycle(system, row.text) == &row) AddComputedCode(row.text, {.op = Op::kVerbatim}, machine);
  }
  const auto turns = [&](const Setting<std::string>& text, std::uint8_t index, ir::SpindleState state) {
    if (!text.Known() || text->empty()) return;
    const bool stop = state == ir::SpindleState::kStop;
    AddComputedCode(*text,
                    {.op = Op::kSpindle,
                     .index = index,
                     .extra = static_cast<std::uint32_t>(state),
                     .phase = stop ? ir::Phase::kAfter : ir::Phase::kBefore},
                    machine);
  };
  constexpr std::uint8_t kMain = 0, kSecond = 2, kLive = 3;
  for (const auto& [words, index] : {std::pair{&profile.spindle, kMain}, std::pair{&profile.second_spindle, kSecond},
                                     std::pair{&profile.live_spindle, kLive}}) {
    turns(words->cw, index, ir::SpindleState::kCw);
    turns(words->ccw, index, ir::SpindleState::kCcw);
    turns(words->stop, index, ir::SpindleState::kStop);
  }
}

/// What numbers without a point count (fanuc-2.2, mazak-lathe-7).
void SetUnits(System system, ir::Machine& machine) {
  const NumberUnit minute = UnitOf(WordContext::kFeedPerMinute, system);
  const NumberUnit revolution = UnitOf(WordContext::kFeedPerRevolution, system);
  machine.units.feed_per_minute = minute.metric;
  machine.units.feed_per_minute_inch = minute.inch;
  machine.units.feed_per_revolution = revolution.metric;
  machine.units.feed_per_revolution_inch = revolution.inch;
}

/// Variables that stand for something of the machine, for numbers that programs compute (fanuc-9).
void SetNumberedSystems(const Profile& profile, ir::Machine& machine) {
  for (const SystemRange& range : SystemVariables()) {
    if (FindSystemVariable(profile, range.first) != &range) continue;
    const ir::WriteEffect effect = range.control == Control::kAlarm         ? ir::WriteEffect::kAlarm
                                   : range.control == Control::kMessageStop ? ir::WriteEffect::kMessageStop
                                                                            : ir::WriteEffect::kNone;
    machine.numbered_systems.push_back(
        {range.first, range.last, range.base, range.kind, range.readable, range.writable, effect});
  }
  for (const std::string& axis : profile.axes) {
    if (const auto letter = ir::AxisOf(axis)) machine.position_axes.push_back(*letter);
  }
}

/// Which number an alarm of the program shows: 3000 + n, n itself with 6008#1 MCA, 1000 + n on Haas (fanuc-9.3, 13);
/// Mazak has three ranges (mazak-lathe-6.5).
void SetAlarmNumbers(const FanucSettings& settings, ir::Machine& machine) {
  if (settings.variant.Is(Variant::kMazak)) {
    machine.alarm_numbers = {{1, 10, 980, false}, {11, 20, 990, false}, {21, 0xFFFFFFFFU, 979, true}};
  } else if (settings.variant.Is(Variant::kHaas)) {
    machine.alarm_numbers = {{0, 999, 1000, false}};
  } else if (!settings.alarm_number_as_written.Or(false)) {
    machine.alarm_numbers = {{0, 0xFFFFFFFFU - 3000U, 3000, false}};
  }
}

}  // namespace

void FillMachine(const Profile& profile, ir::Machine& machine) {
  const FanucSettings& settings = profile.fanuc;
  machine.circle_tolerance = settings.circle_tolerance.Or(0.01);  // fanuc-8.3, parameter 3410
  machine.circle_tolerance_factor = 0;
  machine.arc_center_corrected = false;                // fanuc-8.3: a spiral that ends on the end point
  machine.arc_radius_beats_center = true;              // fanuc-8.3
  machine.arc_radius_without_end_stays = true;         // fanuc-8.3: an arc of 0 degrees
  machine.centers_are_diameter_when_absolute = false;  // fanuc-8.2: I is a radius, always from the start
  machine.incremental_traverses_frame = false;
  machine.thread_lead_from_feed = true;    // fanuc-8.1: G32, G33 with F
  machine.reference_via_point = true;      // fanuc-8.1: G28
  machine.position_reads_diameter = true;  // fanuc-8.2, 9.5
  machine.frame_shift_in_diameter = true;  // fanuc-8.2: G52 X is a word of a diameter axis
  machine.feed_type_change_drops_feed = false;
  machine.surface_speed_per_revolution = false;   // G96 changes the unit of S only
  machine.end_in_called_program_returns = false;  // fanuc-1: M30 ends the program wherever it stands
  machine.return_in_main_restarts = true;         // fanuc-1: M99 in the main program
  machine.passes_keep_locals = true;              // fanuc-7.3: L repeats
  machine.modal_call_levels = 4;                  // fanuc-7.4
  machine.modal_call_keeps_locals = true;         // fanuc-7.4
  machine.modal_call_trigger = ir::ModalCallTrigger::kMotionBlocks;
  machine.tool_activates_edge = false;
  // fanuc-8.11: a turret turns at T; mazak-lathe-4.2: M6 on an Integrex.
  // mazak-lathe-4.1, 4.2.
  machine.tool_suffix = SystemOf(profile) == System::kMazakM || SystemOf(profile) == System::kMazakT;
  machine.tool_word_changes = machine.lathe && SystemOf(profile) != System::kMazakM;
  // fanuc-8.1, mazak-lathe-2.6: by 3405#1 DWL, F92.2 a dwell counts revolutions.
  machine.dwell_per_revolution = !settings.dwell.Known()                          ? ir::DwellUnit::kUnknown
                                 : *settings.dwell == FanucSettings::Dwell::kTime ? ir::DwellUnit::kSeconds
                                                                                  : ir::DwellUnit::kRevolutions;
  machine.chip_back_off = settings.g73_back_off.Or(1);                             // fanuc-8.7, parameter 5114
  machine.peck_clearance = settings.g83_clearance.Or(1);                           // 5115
  machine.cycle_level_from_initial = machine.lathe;                                // fanuc-8.7: R is a distance
  machine.rotation_default_angle = settings.rotation_default_angle.Or(0);          // fanuc-8.5, 5410
  machine.rotation_angle_by_distance = settings.rotation_r_by_distance.Or(false);  // 5400#0
  machine.thread_run_out = settings.thread_run_out.Or(0);                          // fanuc-8.8, 5130
  machine.program_prefix = "O";
  machine.fixed_text_pads = settings.print_leading_blanks.Or(false);  // fanuc-10, 6001#1
  SetNumberedSystems(profile, machine);
  SetAlarmNumbers(settings, machine);
  if (settings.variant.Is(Variant::kFanuc)) SetAlarms(kAlarms, machine);
  if (const std::optional<System> system = SystemOf(profile); system.has_value()) {
    SetOtherCodes(profile, *system, machine);
    SetComputedCodes(Codes(*system), machine);
    SetGroups(Codes(*system), machine);
    SetUnits(*system, machine);
  }
}

}  // namespace ncport::dialects::fanuc
