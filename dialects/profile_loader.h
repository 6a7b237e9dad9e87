// The inner side of LoadProfile, for the check of the built-in profiles.
#pragma once

#include <string_view>
#include <vector>

#include "dialects/profile.h"

namespace ncport::dialects {

struct ProfileParts {
  Profile profile;
  std::vector<std::string_view> unmentioned;  // keys of its language that no file of the chain answers or asks
  std::vector<std::string> chain;             // the profile and those it inherits from, nearest first
};

/// LoadProfile without the refusal of an open machine class (`mazak-integrex`).
Result<ProfileParts> LoadProfileParts(std::string_view name_or_path, SourceFiles& files, diag::Sink& sink);

}  // namespace ncport::dialects
