// What a run on a SINUMERIK needs besides what all profiles say.
#pragma once

#include "dialects/profile.h"
#include "ir/machine.h"

namespace ncport::dialects::sinumerik {

void FillMachine(const Profile& profile, ir::Machine& machine);

}  // namespace ncport::dialects::sinumerik
