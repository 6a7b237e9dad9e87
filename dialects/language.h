// The languages by name. Everything else about them is data: code tables, profiles, cards.
#pragma once

#include <cstdint>
#include <string_view>

namespace ncport::dialects {

/// A grammar and its semantics (contracts section 1). Mazak and Haas are profiles of kFanuc.
enum class Language : std::uint8_t { kSinumerik, kFanuc, kNum, kLinuxCnc, kIso };
inline constexpr std::size_t kLanguages = 5;

/// "sinumerik", "fanuc", "num", "linuxcnc", "iso".
std::string_view NameOf(Language language);
/// As its makers write it: "SINUMERIK", "Fanuc" ...
std::string_view TitleOf(Language language);
/// How a program tests a value {0} before it divides by it, for remedies. Empty where the language has no tests.
std::string_view TestExampleOf(Language language);

}  // namespace ncport::dialects
