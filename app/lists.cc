#include "app/lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "app/lists_json.h"
#include "base/diag/codes.h"
#include "dialects/registry.h"

namespace ncport::app {
namespace {

/// First comment line of a built-in profile: what it stands for.
std::string TitleOf(const dialects::BuiltInProfile& profile) {
  std::string_view text = profile.text;
  while (text.starts_with("\n")) text.remove_prefix(1);
  if (!text.starts_with("# ")) return {};
  return std::string(text.substr(2, text.find('\n') - 2));
}

std::vector<ListEntry> Entries(std::string_view what) {
  std::vector<ListEntry> entries;
  if (what == "profiles") {
    for (const dialects::BuiltInProfile& profile : dialects::BuiltInProfiles()) {
      entries.push_back({{"name", std::string(profile.name)}, {"title", TitleOf(profile)}});
    }
  } else if (what == "rules") {
    for (const diag::Info& info : diag::AllInfos()) {
      entries.push_back({{"code", std::string(info.number)},
                         {"severity", std::string(diag::NameOf(info.severity))},
                         {"name", std::string(info.name)},
                         {"text", std::string(info.text)}});
    }
  } else {
    for (const dialects::LanguageInfo& language : dialects::Languages()) {
      entries.push_back({{"name", std::string(language.name)}, {"title", std::string(language.title)}});
    }
  }
  return entries;
}

}  // namespace

std::string List(std::string_view what, bool json) {
  const std::vector<ListEntry> entries = Entries(what);
  if (json) return ListAsJson(what, entries);
  // Columns as wide as their longest entry; the last one is free. The name of a rule is for programs.
  std::vector<std::size_t> widths;
  for (const ListEntry& entry : entries) {
    widths.resize(std::max(widths.size(), entry.size()));
    for (std::size_t i = 0; i < entry.size(); ++i) widths[i] = std::max(widths[i], entry[i].second.size());
  }
  std::string text;
  for (const ListEntry& entry : entries) {
    std::string line;
    for (std::size_t i = 0; i < entry.size(); ++i) {
      if (what == "rules" && entry[i].first == "name") continue;
      fmt::format_to(std::back_inserter(line), "{:<{}}  ", entry[i].second, widths[i]);
    }
    line.resize(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace ncport::app
