#include "dialects/profile_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/near_name.h"
#include "dialects/profile_apply.h"
#include "dialects/profile_keys.h"
#include "dialects/read_text_file.h"
#include "dialects/registry.h"
#include "dialects/toml_document.h"

namespace ncport::dialects {
namespace {

using diag::Code;

bool IsPath(std::string_view name) { return name.find('/') != std::string_view::npos || name.ends_with(".toml"); }

/// Reads a profile and those it inherits from, root first.
class Loader {
 public:
  Loader(SourceFiles& files, diag::Sink& sink) : files_(files), sink_(sink), mentioned_(ProfileKeys().size()) {}

  Result<ProfileParts> Load(std::string_view name) {
    parts_.profile.name = name;
    for (const KeyRow& row : ProfileKeys()) GiveKey(row);
    NCPORT_TRY(LoadInto(std::string(name), "", {}));
    if (sink_.ErrorCount() != errors_before_) return Failure{};
    CheckWhole();
    if (sink_.ErrorCount() != errors_before_) return Failure{};
    for (std::size_t i = 0; i < mentioned_.size(); ++i) {
      const KeyRow& row = ProfileKeys()[i];
      const std::optional<Language> language = LanguageOf(row);
      if (!mentioned_[i] && (!language.has_value() || *language == parts_.profile.language)) {
        parts_.unmentioned.push_back(row.path);
      }
    }
    return std::move(parts_);
  }

 private:
  void GiveKey(const KeyRow& row) {
    std::visit(
        [&](const auto& key) {
          using Key = std::decay_t<decltype(key)>;
          if constexpr (std::is_same_v<Key, ChoiceKey>) {
            if (key.set_key != nullptr) key.set_key(parts_.profile, row.path);
          } else if constexpr (!std::is_same_v<Key, SpecialKey>) {
            key.get(parts_.profile).SetKey(row.path);
          }
        },
        row.binding);
  }

  Status LoadInto(const std::string& name, std::string_view folder, const SourceRange& named_at) {
    if (std::ranges::find(parts_.chain, name) != parts_.chain.end()) {
      diag::Diagnostic& finding = sink_.Report(Code::kProfileCycle, named_at, name);
      finding.notes.push_back({{}, fmt::format("{} -> {}", fmt::join(parts_.chain, " -> "), name)});
      return Failure{};
    }
    parts_.chain.push_back(name);
    return IsPath(name) ? LoadFile(name, folder, named_at) : LoadBuiltIn(name, named_at);
  }

  Status LoadFile(const std::string& name, std::string_view folder, const SourceRange& named_at) {
    const bool absolute = name.starts_with('/');
    const std::string path = absolute || folder.empty() ? name : fmt::format("{}/{}", folder, name);
    const std::size_t before = sink_.ErrorCount();
    const Result<FileId> file = ReadTextFile(path, files_, sink_);
    if (!file.Ok()) {
      if (named_at.Valid() && sink_.ErrorCount() != before) {
        sink_.Report(Code::kUnknownProfile, named_at, name);
      }
      return Failure{};
    }
    NCPORT_TRY_ASSIGN(const TomlNode root, ParseToml(files_, *file, sink_));
    const std::size_t slash = path.rfind('/');
    return ApplyChain(root, slash == std::string::npos ? std::string_view{} : std::string_view(path).substr(0, slash),
                      sink_);
  }

  Status LoadBuiltIn(const std::string& name, const SourceRange& named_at) {
    for (const BuiltInProfile& profile : BuiltInProfiles()) {
      if (profile.name != name) continue;
      // Its text is checked when ncport is built: a finding in it is ours, and its file is none of the user's.
      SourceFiles own_files;
      diag::Sink own_sink;
      const FileId file = own_files.Add(name + ".toml", std::string(profile.text));
      const Result<TomlNode> root = ParseToml(own_files, file, own_sink);
      const Status status = root.Ok() ? ApplyChain(*root, "", own_sink) : Status{Failure{}};
      if (own_sink.HasErrors()) {
        const diag::Diagnostic& first = own_sink.All().front();
        NCPORT_BUG("built-in profile {}:{}: {} {}", name, first.at.line, first.message, first.help);
      }
      return status;
    }
    ReportUnknownProfile(name, named_at);
    return Failure{};
  }

  void ReportUnknownProfile(const std::string& name, const SourceRange& at) {
    std::vector<std::string_view> names;
    for (const BuiltInProfile& profile : BuiltInProfiles()) names.push_back(profile.name);
    diag::Diagnostic& finding = sink_.Report(Code::kUnknownProfile, at, name);
    const std::string_view near = NearName(name, names);
    finding.help =
        near.empty()
            ? std::string("ncport list profiles names them; a profile file is named by its path, ending in .toml")
            : fmt::format("did you mean {}?", near);
  }

  Status ApplyChain(const TomlNode& root, std::string_view folder, diag::Sink& sink) {
    bool inherited = false;
    if (const TomlMember* inherits = root.Find("inherits"); inherits != nullptr) {
      if (inherits->value.kind != TomlKind::kText || inherits->value.text.empty()) {
        sink.Report(Code::kWrongKeyValue, inherits->value.at, "inherits", inherits->value.Describe(),
                    "a profile name or path");
        return Failure{};
      }
      NCPORT_TRY(LoadInto(inherits->value.text, folder, inherits->value.at));
      inherited = true;
    }
    if (!inherited && root.Find("machine") == nullptr) {
      sink.Report(Code::kMissingKey, {}, "machine").help = "add: machine = \"mill\" or \"lathe\"";
    }
    ApplyProfileFile(root, inherited, parts_.profile, mentioned_, sink);
    return {};
  }

  /// What must hold between keys, whichever file they come from.
  void CheckWhole() {
    const Profile& profile = parts_.profile;
    if (profile.axes.empty()) sink_.Report(Code::kMissingKey, {}, "axes").help = "add: axes = [\"X\", \"Y\", \"Z\"]";
    for (const ScratchRange& scratch : profile.scratch) {
      const bool inside = std::ranges::any_of(profile.variables, [&](const VariableSpace& space) {
        return space.name == scratch.space && space.range.Contains(scratch.range.first) &&
               space.range.Contains(scratch.range.last);
      });
      if (inside) continue;
      const std::string range =
          fmt::format("{}{}-{}{}", scratch.space, scratch.range.first, scratch.space, scratch.range.last);
      sink_.Report(Code::kWrongKeyValue, {}, "scratch", range, "a part of one space of variables");
    }
  }

  SourceFiles& files_;
  diag::Sink& sink_;
  const std::size_t errors_before_ = sink_.ErrorCount();
  std::vector<bool> mentioned_;
  ProfileParts parts_;
};

}  // namespace

Result<ProfileParts> LoadProfileParts(std::string_view name_or_path, SourceFiles& files, diag::Sink& sink) {
  return Loader(files, sink).Load(name_or_path);
}

Result<Profile> LoadProfile(std::string_view name_or_path, SourceFiles& files, diag::Sink& sink) {
  NCPORT_TRY_ASSIGN(ProfileParts parts, LoadProfileParts(name_or_path, files, sink));
  // The same words turn different spindles in different classes: without a class nothing may be read or written.
  if (!Need(parts.profile, parts.profile.machine_class, {}, sink)) return Failure{};
  return std::move(parts.profile);
}

/// The values as a TOML file writes them: "yes" | "no".
std::string QuotedValues(const KeyRow& row) {
  const std::string values = ValuesOf(row);
  const bool words = std::holds_alternative<ChoiceKey>(row.binding) || std::holds_alternative<FlagKey>(row.binding);
  if (std::holds_alternative<TextKey>(row.binding)) return fmt::format("\"{}\"", values);
  if (!words) return values;
  std::string quoted = "\"";
  for (const char c : values) {
    if (c == ' ') continue;
    if (c == '|') {
      quoted += "\" | \"";
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

void ReportOpenKey(const Profile& profile, std::string_view key, const SourceRange& at, diag::Sink& sink) {
  const KeyRow* row = FindKey(key);
  NCPORT_CHECK(row != nullptr, "'{}' is no profile key", key);
  diag::Diagnostic& finding = sink.Report(Code::kOpenKey, at, profile.name, key);
  finding.notes.push_back({{}, fmt::format("{}: {}", key, row->meaning)});
  finding.help = fmt::format("add to a profile file{}: {} = {}",
                             IsPath(profile.name) ? "" : fmt::format(" with inherits = \"{}\"", profile.name), key,
                             QuotedValues(*row));
  // Built-in profiles that answer the question are the shortest answer: mazak-integrex-old, mazak-integrex-new.
  std::string answers;
  for (const BuiltInProfile& other : BuiltInProfiles()) {
    if (other.name.size() > profile.name.size() && other.name.starts_with(profile.name) &&
        other.name[profile.name.size()] == '-') {
      answers += answers.empty() ? "" : " or ";
      answers += other.name;
    }
  }
  if (!answers.empty()) finding.help = fmt::format("which one: {}? Or {}", answers, finding.help);
}

}  // namespace ncport::dialects
