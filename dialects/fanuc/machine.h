// What a run on a Fanuc, Mazak or Haas control needs besides what all profiles say.
#pragma once

#include "dialects/profile.h"
#include "ir/machine.h"

namespace ncport::dialects::fanuc {

void FillMachine(const Profile& profile, ir::Machine& machine);

}  // namespace ncport::dialects::fanuc
