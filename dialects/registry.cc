#include "dialects/registry.h"

#include "base/result.h"
#include "dialects/profile_loader.h"

namespace ncport::dialects {
namespace {

constexpr LanguageInfo kLanguageInfos[] = {
    {Language::kSinumerik, "sinumerik", "SINUMERIK 840D sl, 828D, 802D, 802S", "sinumerik-840d-mill",
     "sinumerik-840d-lathe"},
    {Language::kFanuc, "fanuc", "FANUC Custom Macro B, Mazak EIA/ISO, Haas", "fanuc-mill", "fanuc-lathe-a"},
    {Language::kNum, "num", "NUM 1020 to 1060, Axium, Flexium", "num-mill", "num-lathe"},
    {Language::kLinuxCnc, "linuxcnc", "LinuxCNC (RS-274 with O words)", "linuxcnc-mill", "linuxcnc-lathe"},
    {Language::kIso, "iso", "flat ISO 6983 blocks with literal words only", "iso-mill", "iso-lathe"},
};
static_assert(std::size(kLanguageInfos) == kLanguages);

}  // namespace

std::string_view NameOf(Language language) { return InfoOf(language).name; }

std::string_view TitleOf(Language language) {
  switch (language) {
    case Language::kSinumerik:
      return "SINUMERIK";
    case Language::kFanuc:
      return "Fanuc";
    case Language::kNum:
      return "NUM";
    case Language::kLinuxCnc:
      return "LinuxCNC";
    case Language::kIso:
      break;
  }
  return "ISO";
}

std::string_view TestExampleOf(Language language) {
  switch (language) {
    case Language::kSinumerik:
      return "test it first, for example a block IF {0}{1}0, a block SETAL(65000), a block ENDIF";
    case Language::kFanuc:
      return "test it first, for example IF[{0} EQ 0]THEN #3000=1";
    default:
      return {};
  }
}

std::span<const LanguageInfo> Languages() { return kLanguageInfos; }

const LanguageInfo& InfoOf(Language language) { return kLanguageInfos[static_cast<std::size_t>(language)]; }

std::optional<Language> FindLanguage(std::string_view name) {
  for (const LanguageInfo& info : kLanguageInfos) {
    if (info.name == name) return info.language;
  }
  return std::nullopt;
}

Profile BuiltIn(std::string_view name) {
  SourceFiles files;
  diag::Sink sink;
  Result<Profile> profile = LoadProfile(name, files, sink);
  NCPORT_CHECK(profile.Ok(), "there is no built-in profile {}", name);
  return std::move(profile).Value();
}

std::vector<ProfileInfo> ListProfiles() {
  std::vector<ProfileInfo> list;
  for (const BuiltInProfile& built_in : BuiltInProfiles()) {
    SourceFiles files;
    diag::Sink sink;
    const Result<ProfileParts> parts = LoadProfileParts(built_in.name, files, sink);
    NCPORT_CHECK(parts.Ok(), "built-in profile {} is broken", built_in.name);
    // A profile that only says what its classes share cannot be used by itself.
    if (!parts->profile.machine_class.Known()) continue;
    list.push_back({built_in.name, parts->profile.language, parts->profile.machine, TitleOf(built_in.text)});
  }
  return list;
}

std::string TitleOf(std::string_view text) {
  std::string title;
  while (text.starts_with("# ")) {
    const std::size_t end = text.find('\n');
    if (!title.empty()) title += ' ';
    title += text.substr(2, end - 2);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  // First sentence; a point between digits or letters does not end one.
  for (std::size_t i = 0; i + 1 < title.size(); ++i) {
    if ((title[i] == '.' || title[i] == ':') && title[i + 1] == ' ') return title.substr(0, i);
  }
  if (title.ends_with('.')) title.pop_back();
  return title;
}

std::string_view UsualProfile(const LanguageGuess& guess) {
  NCPORT_CHECK(guess.Certain(), "no usual profile without a language");
  const LanguageInfo& info = InfoOf(guess.languages.front());
  return guess.lathe ? info.lathe_profile : info.mill_profile;
}

}  // namespace ncport::dialects
