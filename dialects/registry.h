// What ncport knows by name: languages and built-in profiles, and which language a file seems to be in.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/language.h"
#include "dialects/profile.h"

namespace ncport::dialects {

struct LanguageInfo {
  Language language;
  std::string_view name;
  std::string_view title;           // one line for `ncport list languages`
  std::string_view mill_profile;    // usual profiles, taken when no profile is named
  std::string_view lathe_profile;
};
std::span<const LanguageInfo> Languages();
const LanguageInfo& InfoOf(Language language);
std::optional<Language> FindLanguage(std::string_view name);

struct BuiltInProfile {
  std::string_view name;    // "mazak-qtn"
  std::string_view text;    // TOML
};
/// Sorted by name.
std::span<const BuiltInProfile> BuiltInProfiles();
/// A built-in profile; an unknown name is a bug.
Profile BuiltIn(std::string_view name);

/// The language that a file seems to be in, with the reasons ("ending .mpf", "line 3: GOTOF").
struct LanguageGuess {
  std::vector<Language> languages;   // one: certain; none: nothing speaks for one; two or more: they contradict
  std::vector<std::string> reasons;  // beside `languages`
  bool lathe = false;                // a lathe word of the card occurs
  std::string lathe_reason;

  [[nodiscard]] bool Certain() const { return languages.size() == 1; }
};
LanguageGuess GuessLanguage(std::string_view file_name, std::string_view text);
/// Name of the usual profile for a certain guess.
std::string_view UsualProfile(const LanguageGuess& guess);

}  // namespace ncport::dialects
