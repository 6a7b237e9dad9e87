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
  std::string_view title;         // one line for `ncport list languages`
  std::string_view mill_profile;  // usual profiles, taken when no profile is named
  std::string_view lathe_profile;
};
std::span<const LanguageInfo> Languages();
const LanguageInfo& InfoOf(Language language);
std::optional<Language> FindLanguage(std::string_view name);

struct BuiltInProfile {
  std::string_view name;  // "mazak-qtn"
  std::string_view text;  // TOML
};
/// Sorted by name.
std::span<const BuiltInProfile> BuiltInProfiles();
/// A built-in profile; an unknown name is a bug.
Profile BuiltIn(std::string_view name);

/// What `ncport list profiles` shows of one profile.
struct ProfileInfo {
  std::string_view name;
  Language language;
  MachineKind machine;
  std::string title;  // first sentence of the comment at the top of its file
};
/// The built-in profiles that can be used as they are, sorted by name.
std::vector<ProfileInfo> ListProfiles();
/// First sentence of the comment at the top of a profile text.
std::string TitleOf(std::string_view text);

/// The language that a file seems to be in, with the reasons ("ending .mpf", "line 3: GOTOF").
struct LanguageGuess {
  std::vector<Language> languages;   // one: certain; none: nothing speaks for one; two or more: they contradict
  std::vector<std::string> reasons;  // beside `languages`
  bool lathe = false;                // a lathe word of the card occurs
  std::string lathe_reason;

  [[nodiscard]] bool Certain() const { return languages.size() == 1; }
};
LanguageGuess GuessLanguage(std::string_view file_name, std::string_view text);
/// The certain language, or a finding at `at` (file without line is fine) that names what speaks for each.
Result<Language> NeedLanguage(const LanguageGuess& guess, std::string_view file_name, const SourceRange& at,
                              diag::Sink& sink);
/// Name of the usual profile for a certain guess.
std::string_view UsualProfile(const LanguageGuess& guess);

}  // namespace ncport::dialects
