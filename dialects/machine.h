// From a profile to what a run needs to know.
#pragma once

#include "dialects/profile.h"
#include "ir/machine.h"

namespace ncport::dialects {

/// Start state, arithmetic, limits, alarms and computed codes of the profile's language and machine. Open settings take
/// the value that makes a run stop rather than guess (unknown modal state) or the control's delivered value as the card
/// names it.
ir::Machine MachineFor(const Profile& profile);

}  // namespace ncport::dialects
