// The page docs/profiles.md, from the key table and the built-in profiles.
#include <fmt/format.h>

#include <iterator>
#include <string>

#include "dialects/modal_names.h"
#include "dialects/profile_keys.h"
#include "dialects/profile_loader.h"
#include "dialects/registry.h"

namespace ncport::dialects {
namespace {

/// `|` would end a table cell.
std::string Cell(std::string_view text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell.push_back('\\');
    cell.push_back(c);
  }
  return cell;
}

std::string_view TopOf(const KeyRow& row) { return row.path.substr(0, row.path.find('.')); }

void AppendKeys(std::string& page, bool of_language) {
  std::string_view top;
  for (const KeyRow& row : ProfileKeys()) {
    if (LanguageOf(row).has_value() != of_language) continue;
    const bool starts_table = TopOf(row) != top && (of_language || top.empty());
    top = TopOf(row);
    if (starts_table) {
      if (of_language) fmt::format_to(std::back_inserter(page), "\n## Table [{}]\n", top);
      page += "\n| key | values | meaning |\n|---|---|---|\n";
    }
    fmt::format_to(std::back_inserter(page), "| `{}` | {} | {} |\n", row.path, Cell(ValuesOf(row)), Cell(row.meaning));
  }
}

}  // namespace

std::string ProfilePage() {
  std::string page =
      "# Profiles\n"
      "\n"
      "Written by `ncport_profile_page` from the key table in `dialects/profile_keys.cc`; a test holds it current.\n"
      "\n"
      "A profile is a TOML file that describes one machine: a language and all that differs between machines of that "
      "language. It\n"
      "names another with `inherits` and says what is different. `ask` instead of a value means that the machine's "
      "owner must\n"
      "answer first: a program that needs the key is refused with the line to add. A key that no file of the chain has "
      "is asked too.\n"
      "Unknown keys and values are errors with their place.\n"
      "\n"
      "## Built-in profiles\n"
      "\n"
      "| name | language | machine | inherits | what it is |\n"
      "|---|---|---|---|---|\n";
  for (const BuiltInProfile& built_in : BuiltInProfiles()) {
    SourceFiles files;
    diag::Sink sink;
    const Result<ProfileParts> parts = LoadProfileParts(built_in.name, files, sink);
    NCPORT_CHECK(parts.Ok(), "built-in profile {} is broken", built_in.name);
    fmt::format_to(std::back_inserter(page), "| `{}`{} | {} | {} | {} | {} |\n", built_in.name,
                   parts->profile.machine_class.Known() ? "" : " (refused alone)", NameOf(parts->profile.language),
                   parts->profile.IsLathe() ? "lathe" : "mill",
                   parts->chain.size() > 1 ? fmt::format("`{}`", parts->chain[1]) : "", Cell(TitleOf(built_in.text)));
  }
  page += "\n## Keys of every profile\n";
  AppendKeys(page, false);
  page +=
      "\n## Table [start]\n"
      "\n"
      "The state that the machine promises at program start. `[entry]` of `ncport.toml` has the same keys.\n"
      "\n"
      "| key | values | meaning |\n"
      "|---|---|---|\n";
  for (const ModalGroup& group : ModalGroups()) {
    fmt::format_to(std::back_inserter(page), "| `start.{}` | {} | {} |\n", group.key, Cell(ValuesOf(group)),
                   Cell(group.meaning));
  }
  AppendKeys(page, true);
  return page;
}

}  // namespace ncport::dialects
