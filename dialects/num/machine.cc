#include "dialects/num/machine.h"

#include "dialects/machine_parts.h"

namespace ncport::dialects::num {
namespace {

using A = ir::AlarmClass;

// Card section 9.3: only 94 is certain. `undefined-variable` is ncport's own rule name.
constexpr AlarmRow kAlarms[] = {
    {A::kArithmetic, "94", "illegal operation in a parametric expression"},
    {A::kIndex, "undefined-variable", "variable does not exist"},
};

}  // namespace

void FillMachine(const Profile& profile, ir::Machine& machine) {
  const NumSettings& settings = profile.num;
  machine.circle_tolerance = settings.circle_tolerance.Or(0.02);  // NUM-62
  machine.circle_tolerance_factor = 0;
  machine.arc_center_corrected = false;
  machine.cell_max = 99999999;     // NUM-10, num-3.1
  machine.file_end_is_end = true;  // num-7: a subprogram ends with its text
  machine.end_in_called_program_returns = !settings.end_in_called_ends_all.Or(true);  // NUM-50
  machine.surface_speed_per_revolution = false;  // num-8.2: G96 changes the unit of S only
  SetAlarms(kAlarms, machine);
}

}  // namespace ncport::dialects::num
