// Where the radius of a tool stands that cutter compensation keeps off by.
#pragma once

#include "dialects/profile.h"

namespace ncport::dialects {

/// True if the radius stands in a register that a word of its own names (D), whatever the tool: a tool without that
/// word has none (fanuc-8.1). False too where the control may take it from the data of the tool.
bool RadiusInRegister(const Profile& profile);

}  // namespace ncport::dialects
