// What a run on a NUM control needs besides what all profiles say.
#pragma once

#include "dialects/profile.h"
#include "ir/machine.h"

namespace ncport::dialects::num {

void FillMachine(const Profile& profile, ir::Machine& machine);

}  // namespace ncport::dialects::num
