// The alarm that the control itself raises for what a finding says, where its number is certain.
#pragma once

#include <string_view>

#include "base/diag/codes.h"
#include "dialects/profile.h"

namespace ncport::dialects {

/// "SINUMERIK alarm 14080"; empty: there is none, or the card is not sure of its number.
std::string_view AlarmFor(const Profile& profile, diag::Code code);

}  // namespace ncport::dialects
