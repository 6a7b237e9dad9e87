#include "dialects/profile_apply.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "base/near_name.h"
#include "dialects/modal_names.h"
#include "dialects/profile_keys.h"
#include "dialects/word_template.h"

namespace ncport::dialects {
namespace {

using diag::Code;

std::string_view LastPart(std::string_view path) { return path.substr(path.rfind('.') + 1); }

/// Reads `<number>` at `at` and moves behind it; false without a digit or above 8 digits.
bool ReadNumber(std::string_view text, std::size_t& at, std::uint32_t& number) {
  const std::size_t begin = at;
  number = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9' && at - begin < 9) {
    number = number * 10 + static_cast<std::uint32_t>(text[at] - '0');
    ++at;
  }
  return at > begin && at - begin <= 8;
}

/// Puts the values of one file into the profile.
class Applier {
 public:
  Applier(Profile& profile, std::vector<bool>& mentioned, diag::Sink& sink)
      : profile_(profile), mentioned_(mentioned), sink_(sink) {}

  /// Keys at the top level of a file; `inherited`: the language is already settled.
  void ApplyFile(const TomlNode& root, bool inherited) {
    if (const TomlMember* language = root.Find("language"); language != nullptr) {
      const Language before = profile_.language;
      ApplyRow(*FindKey("language"), language->value);
      if (inherited && profile_.language != before) {
        profile_.language = before;
        Refuse("language", language->value, fmt::format("\"{}\", as in the profile it inherits from,", NameOf(before)));
      }
    } else if (!inherited) {
      sink_.Report(Code::kMissingKey, {}, "language").help =
          "add: language = \"fanuc\", or another, or inherits = \"...\"";
    }
    ApplyTable(root, "");
  }

 private:
  void ApplyTable(const TomlNode& table, const std::string& prefix) {
    for (const TomlMember& member : table.members) {
      const std::string path = prefix.empty() ? member.key : prefix + "." + member.key;
      if (path == "language") continue;
      if (const KeyRow* row = FindKey(path); row != nullptr) {
        const std::optional<Language> language = LanguageOf(*row);
        if (language.has_value() && *language != profile_.language) {
          sink_.Report(Code::kUnknownKey, member.key_at, path).help =
              fmt::format("table [{}] holds for language \"{}\", this profile is \"{}\"", NameOf(*language),
                          NameOf(*language), NameOf(profile_.language));
        } else {
          ApplyRow(*row, member.value);
        }
      } else if (IsTable(path)) {
        if (member.value.kind == TomlKind::kTable) {
          ApplyTable(member.value, path);
        } else {
          Refuse(path, member.value, "a table");
        }
      } else {
        ReportUnknown(path, prefix, member);
      }
    }
  }

  [[nodiscard]] static bool IsTable(std::string_view path) {
    return std::ranges::any_of(ProfileKeys(), [&](const KeyRow& row) {
      return row.path.size() > path.size() && row.path.starts_with(path) && row.path[path.size()] == '.';
    });
  }

  void ReportUnknown(const std::string& path, const std::string& prefix, const TomlMember& member) {
    std::vector<std::string_view> siblings;
    std::vector<std::string_view> all;
    for (const KeyRow& row : ProfileKeys()) {
      all.push_back(LastPart(row.path));
      std::string_view rest = row.path;
      if (!prefix.empty()) {
        if (!rest.starts_with(prefix) || rest.size() <= prefix.size() || rest[prefix.size()] != '.') continue;
        rest.remove_prefix(prefix.size() + 1);
      }
      siblings.push_back(rest.substr(0, rest.find('.')));
    }
    diag::Diagnostic& finding = sink_.Report(Code::kUnknownKey, member.key_at, path);
    if (const std::string_view near = NearName(member.key, siblings); !near.empty()) {
      finding.help =
          fmt::format("did you mean {}?", prefix.empty() ? std::string(near) : prefix + "." + std::string(near));
      finding.fixes.push_back({member.key_at, std::string(near)});
    } else if (const std::string_view far = NearName(member.key, all); !far.empty()) {
      const auto row =
          std::ranges::find_if(ProfileKeys(), [&](const KeyRow& key) { return LastPart(key.path) == far; });
      finding.help = fmt::format("did you mean {}?", row->path);
    } else {
      finding.help = "all keys: docs/profiles.md";
    }
  }

  void Refuse(std::string_view path, const TomlNode& value, std::string_view needed) {
    sink_.Report(Code::kWrongKeyValue, value.at, path, value.Describe(), needed);
  }

  void ApplyRow(const KeyRow& row, const TomlNode& value) {
    mentioned_[static_cast<std::size_t>(&row - ProfileKeys().data())] = true;
    std::visit([&](const auto& key) { Apply(row, key, value); }, row.binding);
  }

  void Apply(const KeyRow& row, const TextKey& key, const TomlNode& value) {
    if (value.IsText("ask")) return key.get(profile_).Ask();
    if (value.kind != TomlKind::kText) return Refuse(row.path, value, "a text");
    if (key.pattern) {
      if (const std::string wrong = CheckTemplate(value.text, key.holes); !wrong.empty()) {
        sink_.Report(Code::kWrongKeyValue, value.at, row.path, value.Describe(), ValuesOf(row)).help = wrong;
        return;
      }
    }
    key.get(profile_).Set(value.text);
  }

  void Apply(const KeyRow& row, const TextsKey& key, const TomlNode& value) {
    if (value.IsText("ask")) return key.get(profile_).Ask();
    std::vector<std::string> texts;
    if (!ReadTexts(row, value, texts)) return;
    key.get(profile_).Set(std::move(texts));
  }

  bool ReadTexts(const KeyRow& row, const TomlNode& value, std::vector<std::string>& texts) {
    if (value.kind != TomlKind::kList) {
      Refuse(row.path, value, ValuesOf(row));
      return false;
    }
    for (const TomlNode& item : value.items) {
      if (item.kind != TomlKind::kText) {
        Refuse(row.path, item, "a text");
        return false;
      }
      texts.push_back(item.text);
    }
    return true;
  }

  void Apply(const KeyRow& row, const NumberKey& key, const TomlNode& value) {
    if (value.IsText("ask")) return key.get(profile_).Ask();
    const bool number = value.kind == TomlKind::kNumber || value.kind == TomlKind::kInteger;
    if (!number || !(value.number >= key.least && value.number <= key.most)) {
      return Refuse(row.path, value, "a number, " + ValuesOf(row) + ",");
    }
    key.get(profile_).Set(value.number);
  }

  void Apply(const KeyRow& row, const IntegerKey& key, const TomlNode& value) {
    if (value.IsText("ask")) return key.get(profile_).Ask();
    if (value.kind != TomlKind::kInteger || value.integer < key.least || value.integer > key.most) {
      return Refuse(row.path, value, "a whole number, " + ValuesOf(row) + ",");
    }
    key.get(profile_).Set(value.integer);
  }

  void Apply(const KeyRow& row, const FlagKey& key, const TomlNode& value) {
    if (value.IsText("ask")) return key.get(profile_).Ask();
    if (!value.IsText("yes") && !value.IsText("no")) return Refuse(row.path, value, "\"yes\" or \"no\"");
    key.get(profile_).Set(value.IsText("yes"));
  }

  void Apply(const KeyRow& row, const RangeKey& key, const TomlNode& value) {
    if (value.IsText("ask")) return key.get(profile_).Ask();
    NumberRange range;
    if (ReadRange(row.path, value, key.most, range)) key.get(profile_).Set(range);
  }

  bool ReadRange(std::string_view path, const TomlNode& value, std::uint32_t most, NumberRange& range) {
    const auto fits = [&](const TomlNode& item) {
      return item.kind == TomlKind::kInteger && item.integer >= 0 && item.integer <= most;
    };
    if (value.kind != TomlKind::kList || value.items.size() != 2 || !fits(value.items[0]) || !fits(value.items[1]) ||
        value.items[0].integer > value.items[1].integer) {
      Refuse(path, value, fmt::format("[first, last], 0 .. {},", most));
      return false;
    }
    range = {static_cast<std::uint32_t>(value.items[0].integer), static_cast<std::uint32_t>(value.items[1].integer)};
    return true;
  }

  void Apply(const KeyRow& row, const ChoiceKey& key, const TomlNode& value) {
    if (key.ask != nullptr && value.IsText("ask")) return key.ask(profile_);
    if (value.kind == TomlKind::kText) {
      for (std::size_t i = 0; i < key.names.size(); ++i) {
        if (value.text == key.names[i]) return key.set(profile_, static_cast<std::uint8_t>(i));
      }
    }
    diag::Diagnostic& finding =
        sink_.Report(Code::kWrongKeyValue, value.at, row.path, value.Describe(), "one of " + ValuesOf(row));
    if (const std::string_view near = NearName(value.text, key.names); !near.empty()) {
      finding.help = fmt::format("did you mean \"{}\"?", near);
    }
  }

  void Apply(const KeyRow& row, SpecialKey key, const TomlNode& value) {
    switch (key) {
      case SpecialKey::kInherits:
        return;  // resolved before
      case SpecialKey::kAxes:
        return ApplyAxes(row, value);
      case SpecialKey::kStart:
        return ApplyStart(row, value);
      case SpecialKey::kVariables:
        return ApplyVariables(row, value);
      case SpecialKey::kMCodes:
        return ApplyMCodes(row, value);
      case SpecialKey::kScratch:
        return ApplyScratch(row, value);
    }
  }

  void ApplyAxes(const KeyRow& row, const TomlNode& value) {
    std::vector<std::string> axes;
    if (!ReadTexts(row, value, axes)) return;
    if (axes.empty() || axes.size() > ir::kMaxAxes) {
      return Refuse(row.path, value, fmt::format("a list of 1 to {} axes", ir::kMaxAxes));
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const std::string& axis = axes[i];
      const bool letter = !axis.empty() && axis[0] >= 'A' && axis[0] <= 'Z';
      const bool digits =
          std::all_of(axis.begin() + (letter ? 1 : 0), axis.end(), [](char c) { return c >= '0' && c <= '9'; });
      const bool twice = std::find(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(i), axis) !=
                         axes.begin() + static_cast<std::ptrdiff_t>(i);
      if (!letter || !digits || axis.size() > 3 || twice) {
        return Refuse(row.path, value.items[i], "each axis once, a capital letter with up to two digits,");
      }
    }
    profile_.axes = std::move(axes);
  }

  void ApplyStart(const KeyRow& row, const TomlNode& value) {
    if (value.IsText("unknown")) {
      profile_.start = {};
      return;
    }
    if (value.kind != TomlKind::kTable) return Refuse(row.path, value, ValuesOf(row));
    std::vector<std::string_view> names;
    for (const ModalGroup& group : ModalGroups()) names.push_back(group.key);
    for (const TomlMember& member : value.members) {
      const std::string path = fmt::format("{}.{}", row.path, member.key);
      const auto group = std::ranges::find_if(ModalGroups(), [&](const ModalGroup& g) { return g.key == member.key; });
      if (group != ModalGroups().end()) {
        SetModalGroup(*group, path, member.value, profile_.start, sink_);
      } else {
        ReportUnknownKey(path, member, names, sink_);
      }
    }
  }

  /// Index of the text of `value` in `names`, or -1 with a finding.
  int ReadName(std::string_view path, const TomlNode& value, std::span<const std::string_view> names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (value.IsText(names[i])) return static_cast<int>(i);
    }
    Refuse(path, value, fmt::format("one of {}", fmt::join(names, " | ")));
    return -1;
  }

  /// Spaces of one file must keep out of each other; one that touches inherited ones replaces them.
  void ApplyVariables(const KeyRow& row, const TomlNode& value) {
    if (value.kind != TomlKind::kList) return Refuse(row.path, value, ValuesOf(row));
    std::vector<VariableSpace> spaces;
    for (const TomlNode& item : value.items) {
      if (item.kind != TomlKind::kTable) {
        Refuse(row.path, item, "a table with name, range, type, lifetime, visibility, start and reserved");
        continue;
      }
      VariableSpace space;
      if (!ReadSpace(item, space)) continue;
      const auto other =
          std::ranges::find_if(spaces, [&](const VariableSpace& known) { return Overlap(known, space); });
      if (other != spaces.end()) {
        Refuse("variables.range", item.Find("range")->value,
               fmt::format("a range without cells of {0}{1} to {0}{2}", other->name, other->range.first,
                           other->range.last));
        continue;
      }
      spaces.push_back(std::move(space));
    }
    if (value.items.empty()) profile_.variables.clear();
    std::erase_if(profile_.variables, [&](const VariableSpace& inherited) {
      return std::ranges::any_of(spaces, [&](const VariableSpace& space) { return Overlap(inherited, space); });
    });
    for (VariableSpace& space : spaces) profile_.variables.push_back(std::move(space));
    std::ranges::sort(profile_.variables, [](const VariableSpace& a, const VariableSpace& b) {
      return std::tie(a.name, a.range.first) < std::tie(b.name, b.range.first);
    });
  }

  static bool Overlap(const VariableSpace& a, const VariableSpace& b) {
    return a.name == b.name && a.range.first <= b.range.last && b.range.first <= a.range.last;
  }

  bool ReadSpace(const TomlNode& table, VariableSpace& space) {
    static constexpr std::string_view kKeys[] = {"name",       "range", "type",    "lifetime",
                                                 "visibility", "start", "reserved"};
    static constexpr std::string_view kTypes[] = {"int", "real", "number"};
    static constexpr ir::Type kTypeValues[] = {ir::Type::kInt, ir::Type::kReal, ir::Type::kNumber};
    static constexpr std::string_view kLifetimes[] = {"call", "program", "kept"};
    static constexpr std::string_view kVisibilities[] = {"level", "program", "all"};
    static constexpr std::string_view kStarts[] = {"zero", "vacant", "kept", "unknown"};
    bool ok = true;
    for (const TomlMember& member : table.members) {
      const std::string path = "variables." + member.key;
      const TomlNode& value = member.value;
      int index = 0;
      if (member.key == "name") {
        const bool fits = value.kind == TomlKind::kText && !value.text.empty() && value.text.size() <= 8;
        if (!fits) Refuse(path, value, "a text of 1 to 8 characters");
        ok = ok && fits;
        space.name = value.text;
      } else if (member.key == "range") {
        ok = ReadRange(path, value, 99999999, space.range) && ok;
      } else if (member.key == "type") {
        index = ReadName(path, value, kTypes);
        if (index >= 0) space.type = kTypeValues[index];
      } else if (member.key == "lifetime") {
        index = ReadName(path, value, kLifetimes);
        if (index >= 0) space.lifetime = static_cast<ir::Lifetime>(index);
      } else if (member.key == "visibility") {
        index = ReadName(path, value, kVisibilities);
        if (index >= 0) space.visibility = static_cast<ir::Visibility>(index);
      } else if (member.key == "start") {
        index = ReadName(path, value, kStarts);
        if (index >= 0) space.start = static_cast<ir::StartValue>(index);
      } else if (member.key == "reserved") {
        ok = ReadReserved(path, value, space.reserved) && ok;
      } else {
        ReportUnknownKey(path, member, kKeys, sink_);
        ok = false;
      }
      ok = ok && index >= 0;
    }
    for (const std::string_view needed : {"name", "range", "type", "lifetime", "visibility", "start"}) {
      if (table.Find(needed) != nullptr) continue;
      sink_.Report(Code::kMissingKey, table.at, fmt::format("variables.{}", needed));
      ok = false;
    }
    return ok;
  }

  bool ReadReserved(std::string_view path, const TomlNode& value, std::vector<NumberRange>& ranges) {
    if (value.kind != TomlKind::kList) {
      Refuse(path, value, "a list of ranges [[first, last]]");
      return false;
    }
    for (const TomlNode& item : value.items) {
      NumberRange range;
      if (!ReadRange(path, item, 99999999, range)) return false;
      ranges.push_back(range);
    }
    return true;
  }

  void ApplyMCodes(const KeyRow& row, const TomlNode& value) {
    if (value.kind != TomlKind::kTable) return Refuse(row.path, value, ValuesOf(row));
    for (const TomlMember& member : value.members) {
      MCodeRule rule;
      if (!ReadMCode(member, rule)) continue;
      const auto same =
          std::ranges::find_if(profile_.mcodes, [&](const MCodeRule& other) { return other.source == rule.source; });
      if (same != profile_.mcodes.end()) {
        *same = std::move(rule);
      } else {
        profile_.mcodes.push_back(std::move(rule));
      }
    }
  }

  bool ReadMCode(const TomlMember& member, MCodeRule& rule) {
    if (!IsMCode(member.key)) {
      sink_.Report(Code::kUnknownKey, member.key_at, "mcodes." + member.key).help =
          "keys are words such as M41, H5 or G187";
      return false;
    }
    if (member.value.kind != TomlKind::kText) {
      Refuse("mcodes." + member.key, member.value, "words of the target, or \"drop\",");
      return false;
    }
    rule = {member.key, member.value.text};
    return true;
  }

  void ApplyScratch(const KeyRow& row, const TomlNode& value) {
    std::vector<std::string> texts;
    if (!ReadTexts(row, value, texts)) return;
    std::vector<ScratchRange> ranges;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      ScratchRange range;
      if (!ReadScratch(texts[i], range)) return Refuse(row.path, value.items[i], "a range such as \"#100-#149\"");
      ranges.push_back(std::move(range));
    }
    profile_.scratch = std::move(ranges);
  }

  /// "#100-#149", "R90-R99" or "L0-19".
  static bool ReadScratch(std::string_view text, ScratchRange& range) {
    std::size_t at = text.find_first_of("0123456789");
    if (at == 0 || at == std::string_view::npos) return false;
    range.space = text.substr(0, at);
    if (!ReadNumber(text, at, range.range.first) || at >= text.size() || text[at] != '-') return false;
    ++at;
    if (text.substr(at).starts_with(range.space)) at += range.space.size();
    return ReadNumber(text, at, range.range.last) && at == text.size() && range.range.first <= range.range.last;
  }

  Profile& profile_;
  std::vector<bool>& mentioned_;
  diag::Sink& sink_;
};

}  // namespace

void ApplyProfileFile(const TomlNode& root, bool inherited, Profile& profile, std::vector<bool>& mentioned,
                      diag::Sink& sink) {
  Applier(profile, mentioned, sink).ApplyFile(root, inherited);
}

}  // namespace ncport::dialects
