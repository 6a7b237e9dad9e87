#include "dialects/machine.h"

#include <string_view>

#include "dialects/fanuc/machine.h"
#include "dialects/num/machine.h"
#include "dialects/sinumerik/machine.h"
#include "ir/axis_names.h"

namespace ncport::dialects {
namespace {

/// Bit per axis of the profile. Axes with other names (X1, E) take the bits from kFirstNamedAxis on, in their order.
std::uint16_t AxisBits(const Profile& profile) {
  unsigned bits = 0;
  unsigned named = ir::kFirstNamedAxis;
  for (const std::string& axis : profile.axes) {
    if (const auto letter = ir::AxisOf(axis)) {
      bits |= 1U << *letter;
    } else if (named < ir::kMaxAxes) {
      bits |= 1U << named++;
    }
  }
  return static_cast<std::uint16_t>(bits);
}

}  // namespace

ir::Machine MachineFor(const Profile& profile) {
  ir::Machine machine;
  machine.axes = AxisBits(profile);
  machine.lathe = profile.IsLathe();
  // X is the transverse axis of every lathe here; with `diameter = no` its words are radii and nothing is converted.
  if (machine.lathe && !profile.diameter.Is(DiameterRule::kNo)) machine.transverse_axis = 0;
  machine.tool_word_changes = machine.lathe;  // a turret turns at T; languages say more
  machine.start = profile.start;
  machine.numeric_model = profile.numeric_model.Or(ir::NumericModel::kBinary64);
  machine.word_error = profile.word_error.Or(ir::WordError::kNone);
  machine.increment = profile.increment.Or(0.001);
  machine.rapid = profile.rapid.Or(ir::Rapid::kUnknown);
  machine.call_depth = static_cast<std::uint32_t>(profile.nesting.call.Or(machine.call_depth));
  machine.passes_max = static_cast<std::uint32_t>(profile.block.max_passes.Or(machine.passes_max));
  switch (profile.language) {
    case Language::kSinumerik:
      sinumerik::FillMachine(profile, machine);
      break;
    case Language::kFanuc:
      fanuc::FillMachine(profile, machine);
      break;
    case Language::kNum:
      num::FillMachine(profile, machine);
      break;
    case Language::kIso:
      // iso-7: S of a mill is a speed; constant surface speed is a matter of lathes.
      if (!machine.lathe) machine.start.speed_mode = ir::SpeedMode::kRpm;
      // iso-5: each flat program switches compensation off in its first block; that is no event of the work.
      machine.start.comp = ir::CutterComp::kOff;
      // iso-6: the centre is where I, J, K put it; what a control makes of radii that differ is its own affair.
      machine.circle_tolerance_factor = 0;
      machine.arc_center_corrected = false;
      break;
    case Language::kLinuxCnc:  // no card yet: what ir::Machine begins with
      break;
  }
  return machine;
}

}  // namespace ncport::dialects
