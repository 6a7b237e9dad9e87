#include "dialects/fanuc/machine.h"

#include "dialects/fanuc/words.h"
#include "dialects/machine_parts.h"

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
  if (settings.variant.Is(Variant::kFanuc)) SetAlarms(kAlarms, machine);
  if (const std::optional<System> system = SystemOf(profile); system.has_value()) {
    SetComputedCodes(Codes(*system), machine);
    SetGroups(Codes(*system), machine);
  }
}

}  // namespace ncport::dialects::fanuc
