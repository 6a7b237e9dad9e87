#include "dialects/radius_registers.h"

#include <string>

namespace ncport::dialects {

bool RadiusInRegister(const Profile& profile) {
  // Haas and Mazak have settings that take it from the data of the tool.
  return profile.language == Language::kFanuc && profile.fanuc.variant.Is(FanucSettings::Variant::kFanuc) &&
         !profile.words.radius_offset.Or(std::string()).empty();
}

}  // namespace ncport::dialects
