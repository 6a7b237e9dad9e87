#include "dialects/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "base/letter_case.h"
#include "dialects/modal_names.h"
#include "dialects/profile_keys.h"
#include "dialects/read_text_file.h"
#include "dialects/toml_document.h"

namespace ncport::dialects {
namespace {

using diag::Code;

/// Words with single blanks, none at the ends: how keys of [tools] are compared.
std::string SingleBlanks(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == ' ' || c == '\t') {
      if (!result.empty() && result.back() != ' ') result.push_back(' ');
    } else {
      result.push_back(c);
    }
  }
  if (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

/// Equal but for the case of letters outside of texts ("...") : tool names keep theirs (sinumerik-1.1).
bool SameWords(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  bool text = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == '"') text = !text;
    if (text ? a[i] != b[i] : Upper(a[i]) != Upper(b[i])) return false;
  }
  return true;
}

constexpr std::string_view kTables[] = {"from",   "to",     "tools",  "offsets", "programs", "variables",
                                        "mcodes", "ranges", "limits", "entry",   "check"};
constexpr std::string_view kCheckKeys[] = {"fail-on", "select", "ignore"};
constexpr std::string_view kFailOn[] = {"error", "warning", "never"};

class Reader {
 public:
  Reader(Config& config, diag::Sink& sink) : config_(config), sink_(sink) {}

  void Read(const TomlNode& root) {
    for (const TomlMember& member : root.members) {
      if (member.key == "from") {
        ReadText("from", member.value, config_.from);
      } else if (member.key == "to") {
        ReadText("to", member.value, config_.to);
      } else if (std::ranges::find(kTables, member.key) == std::end(kTables)) {
        ReportUnknownKey(member.key, member, kTables, sink_);
      } else if (member.value.kind != TomlKind::kTable) {
        Refuse(member.key, member.value, fmt::format("a table [{}]", member.key));
      } else {
        ReadTable(member.key, member.value);
      }
    }
  }

 private:
  void Refuse(std::string_view key, const TomlNode& value, std::string_view needed) {
    sink_.Report(Code::kWrongKeyValue, value.at, key, value.Describe(), needed);
  }

  void ReadText(std::string_view key, const TomlNode& value, std::optional<std::string>& text) {
    if (value.kind != TomlKind::kText || value.text.empty()) return Refuse(key, value, "a profile name or path");
    text = value.text;
    // A path is meant from the folder of this file, wherever ncport is started.
    const bool path = text->find('/') != std::string::npos || text->ends_with(".toml");
    if (path && !text->starts_with('/') && !config_.folder.empty()) *text = config_.folder + "/" + *text;
  }

  void ReadTable(const std::string& name, const TomlNode& table) {
    for (const TomlMember& member : table.members) {
      const std::string path = fmt::format("{}.{}", name, member.key);
      if (name == "tools") {
        ReadMapping(path, member, config_.tools);
      } else if (name == "offsets") {
        ReadMapping(path, member, config_.offsets);
      } else if (name == "variables") {
        ReadMapping(path, member, config_.variables);
      } else if (name == "programs") {
        ReadProgram(path, member);
      } else if (name == "mcodes") {
        ReadMCode(path, member);
      } else if (name == "ranges") {
        ReadRange(path, member);
      } else if (name == "limits") {
        ReadLimit(path, member);
      } else if (name == "entry") {
        ReadEntry(path, member);
      } else {
        ReadCheck(path, member);
      }
    }
  }

  void ReadMapping(const std::string& path, const TomlMember& member, std::vector<WordMapping>& mappings) {
    const std::string source = SingleBlanks(member.key);
    if (source.empty())
      return Refuse(path, member.value, "behind words of the source: an empty key maps nothing; a key");
    if (member.value.kind == TomlKind::kTable && !member.value.members.empty()) {
      for (const TomlMember& machine : member.value.members) {
        if (machine.value.kind != TomlKind::kText || machine.value.text.empty()) {
          Refuse(fmt::format("{}.{}", path, machine.key), machine.value, "a text, words of that machine,");
        } else {
          mappings.push_back({source, SingleBlanks(machine.value.text), machine.key_at, machine.key});
        }
      }
      return;
    }
    if (member.value.kind != TomlKind::kText || member.value.text.empty()) {
      return Refuse(path, member.value, "a text, words of the target,");
    }
    for (const WordMapping& other : mappings) {
      if (!SameWords(other.source, source)) continue;
      sink_.Report(Code::kDoubleName, member.key_at, path).notes.push_back({other.at, "first here"});
      return;
    }
    mappings.push_back({source, SingleBlanks(member.value.text), member.key_at, {}});
  }

  void ReadProgram(const std::string& path, const TomlMember& member) {
    ProgramMapping mapping{member.key, {}, member.key_at};
    const auto add = [&](const TomlNode& value) {
      if (value.kind == TomlKind::kInteger && value.integer >= 1) {
        mapping.targets.push_back(fmt::format("{}", value.integer));
      } else if (value.kind == TomlKind::kText && !value.text.empty()) {
        mapping.targets.push_back(value.text);
      } else {
        Refuse(path, value, "a program number or name");
        return false;
      }
      return true;
    };
    if (member.value.kind != TomlKind::kList) {
      if (!add(member.value)) return;
    } else {
      if (member.value.items.empty()) return Refuse(path, member.value, "a list with one program at least");
      for (const TomlNode& item : member.value.items) {
        if (!add(item)) return;
      }
    }
    config_.programs.push_back(std::move(mapping));
  }

  void ReadMCode(const std::string& path, const TomlMember& member) {
    if (!IsMCode(member.key)) {
      sink_.Report(Code::kUnknownKey, member.key_at, path).help = "keys are words such as M41, H5 or G187";
      return;
    }
    if (member.value.kind != TomlKind::kText || member.value.text.empty()) {
      return Refuse(path, member.value, "words of the target, or \"drop\",");
    }
    config_.mcodes.push_back({member.key, SingleBlanks(member.value.text)});
  }

  /// `[least, most]`.
  bool ReadPair(const std::string& path, const TomlNode& value, double& least, double& most) {
    const auto number = [](const TomlNode& item) {
      return item.kind == TomlKind::kInteger || item.kind == TomlKind::kNumber;
    };
    if (value.kind != TomlKind::kList || value.items.size() != 2 || !number(value.items[0]) ||
        !number(value.items[1]) || !(value.items[0].number <= value.items[1].number)) {
      Refuse(path, value, "[least, most]");
      return false;
    }
    least = value.items[0].number;
    most = value.items[1].number;
    return true;
  }

  /// "EXTD", "EXTD-1", "CYCLE.EXTD + 0.5": a name, and a number that is added to it.
  static bool ReadSum(std::string_view text, std::string& name, double& added) {
    std::string plain;
    for (const char c : text) {
      if (c != ' ') plain += c;
    }
    const std::size_t sign = std::min(plain.find_first_of("+-"), plain.size());
    name = plain.substr(0, sign);
    if (name.empty() || (std::isalpha(static_cast<unsigned char>(name[0])) == 0 && name[0] != '_')) return false;
    added = 0;
    if (sign == plain.size()) return true;
    const char* first = plain.data() + sign + (plain[sign] == '+' ? 1 : 0);
    const char* last = plain.data() + plain.size();
    const auto [end, error] = std::from_chars(first, last, added);
    return error == std::errc{} && end == last;
  }

  void ReadRange(const std::string& path, const TomlMember& member) {
    ValueRange range{member.key, 0, 0, member.key_at, {}, {}};
    const TomlNode& value = member.value;
    const auto is_text = [](const TomlNode& item) { return item.kind == TomlKind::kText; };
    if (value.kind != TomlKind::kList || value.items.size() != 2 || std::ranges::none_of(value.items, is_text)) {
      if (ReadPair(path, value, range.least, range.most)) config_.ranges.push_back(std::move(range));
      return;
    }
    const auto end = [&](const TomlNode& item, double& number, std::string& name) {
      if (is_text(item)) return ReadSum(item.text, name, number);
      number = item.number;
      return item.kind == TomlKind::kInteger || item.kind == TomlKind::kNumber;
    };
    if (!end(value.items[0], range.least, range.least_of) || !end(value.items[1], range.most, range.most_of))
      return Refuse(path, value, "[least, most], each a number or another input such as \"EXTD-1\",");
    config_.ranges.push_back(std::move(range));
  }

  void ReadLimit(const std::string& path, const TomlMember& member) {
    static constexpr std::string_view kNames[] = {"spindle", "feed", "x", "y", "z", "a", "b", "c", "u", "v", "w"};
    const auto name = std::ranges::find(kNames, member.key);
    if (name == std::end(kNames)) return ReportUnknownKey(path, member, kNames, sink_);
    const bool axis = member.key.size() == 1;
    Limit limit{member.key, 0, 0, member.key_at};
    const TomlNode& value = member.value;
    if (value.kind == TomlKind::kList && axis) {
      if (!ReadPair(path, value, limit.least, limit.most)) return;
    } else if ((value.kind == TomlKind::kInteger || value.kind == TomlKind::kNumber) && value.number > 0) {
      limit.least = axis ? -value.number : 0;
      limit.most = value.number;
    } else {
      return Refuse(path, value, axis ? "a number above 0, or [least, most]," : "a number above 0");
    }
    config_.limits.push_back(std::move(limit));
  }

  void ReadEntry(const std::string& path, const TomlMember& member) {
    const auto group = std::ranges::find_if(ModalGroups(), [&](const ModalGroup& g) { return g.key == member.key; });
    if (group != ModalGroups().end()) {
      SetModalGroup(*group, path, member.value, config_.entry, sink_);
      return;
    }
    std::vector<std::string_view> names;
    for (const ModalGroup& known : ModalGroups()) names.push_back(known.key);
    ReportUnknownKey(path, member, names, sink_);
  }

  void ReadCheck(const std::string& path, const TomlMember& member) {
    if (member.key == "fail-on") {
      for (std::size_t i = 0; i < std::size(kFailOn); ++i) {
        if (member.value.IsText(kFailOn[i])) config_.fail_on = static_cast<FailOn>(i);
      }
      if (!config_.fail_on.has_value()) Refuse(path, member.value, fmt::format("one of {}", fmt::join(kFailOn, " | ")));
    } else if (member.key == "select") {
      ReadCodes(path, member.value, config_.select);
    } else if (member.key == "ignore") {
      ReadCodes(path, member.value, config_.ignore);
    } else {
      ReportUnknownKey(path, member, kCheckKeys, sink_);
    }
  }

  /// Codes of findings, or their beginnings ("NC5").
  void ReadCodes(const std::string& path, const TomlNode& value, std::vector<std::string>& codes) {
    if (value.kind != TomlKind::kList) return Refuse(path, value, "a list of codes [\"NC2007\"]");
    for (const TomlNode& item : value.items) {
      const bool known = item.kind == TomlKind::kText && item.text.size() >= 3 &&
                         std::ranges::any_of(diag::AllInfos(), [&](const diag::Info& info) {
                           return info.number.starts_with(item.text);
                         });
      if (!known) return Refuse(path, item, "a code such as \"NC2007\" that exists");
      codes.push_back(item.text);
    }
  }

  Config& config_;
  diag::Sink& sink_;
};

/// Behind the first word that is `D` and a number, if any: "T1 D1" -> "T1".
std::string_view WithoutEdge(std::string_view words) {
  const std::size_t blank = words.rfind(' ');
  if (blank == std::string_view::npos || blank + 2 >= words.size() || Upper(words[blank + 1]) != 'D') return words;
  const std::string_view number = words.substr(blank + 2);
  return number.find_first_not_of("0123456789") == std::string_view::npos ? words.substr(0, blank) : words;
}

const WordMapping* FindWords(const std::vector<WordMapping>& mappings, std::string_view words) {
  for (const WordMapping& mapping : mappings) {
    if (SameWords(mapping.source, words)) return &mapping;
  }
  return nullptr;
}

}  // namespace

Config Config::For(std::string_view target) const {
  // "shop/integrex.toml" -> "integrex"; of a built-in profile a part of its name will do: "mazak-integrex-new".
  if (const std::size_t slash = target.rfind('/'); slash != std::string_view::npos) target.remove_prefix(slash + 1);
  if (target.ends_with(".toml")) target.remove_suffix(5);
  const auto names = [target](std::string_view machine) {
    for (std::size_t at = target.find(machine); at != std::string_view::npos; at = target.find(machine, at + 1)) {
      const std::size_t end = at + machine.size();
      if ((at == 0 || target[at - 1] == '-') && (end == target.size() || target[end] == '-')) return true;
    }
    return false;
  };
  Config chosen = *this;
  for (std::vector<WordMapping>* mappings : {&chosen.tools, &chosen.offsets, &chosen.variables}) {
    std::erase_if(*mappings,
                  [&](const WordMapping& mapping) { return !mapping.machine.empty() && !names(mapping.machine); });
  }
  return chosen;
}

const WordMapping* Config::FindTool(std::string_view words) const {
  const std::string wanted = SingleBlanks(words);
  if (const WordMapping* exact = FindWords(tools, wanted); exact != nullptr) return exact;
  // A call without D also matches its D1 key (contracts section 7).
  if (WithoutEdge(wanted) == wanted) return FindWords(tools, wanted + " D1");
  return nullptr;
}

const WordMapping* Config::FindOffset(std::string_view word) const { return FindWords(offsets, SingleBlanks(word)); }

const WordMapping* Config::FindVariable(std::string_view name) const {
  return FindWords(variables, SingleBlanks(name));
}

const ProgramMapping* Config::FindProgram(std::string_view name) const {
  for (const ProgramMapping& mapping : programs) {
    if (SameWords(mapping.source, name)) return &mapping;
  }
  return nullptr;
}

Result<Config> LoadConfig(std::string_view path, SourceFiles& files, diag::Sink& sink) {
  const std::size_t before = sink.ErrorCount();
  Config config;
  NCPORT_TRY_ASSIGN(config.file, ReadTextFile(path, files, sink));
  const std::size_t slash = path.rfind('/');
  if (slash != std::string_view::npos) config.folder = path.substr(0, slash == 0 ? 1 : slash);
  NCPORT_TRY_ASSIGN(const TomlNode root, ParseToml(files, config.file, sink));
  Reader(config, sink).Read(root);
  if (sink.ErrorCount() != before) return Failure{};
  return config;
}

Result<Config> FindConfig(std::string_view first_input, SourceFiles& files, diag::Sink& sink) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path folder = fs::absolute(fs::path(first_input), error).parent_path();
  if (error) return Config{};
  // Findings name the file as seen from here, like the files of the command line.
  while (true) {
    const fs::path candidate = folder / "ncport.toml";
    if (fs::is_regular_file(candidate, error)) return LoadConfig(fs::proximate(candidate, error).string(), files, sink);
    if (!folder.has_parent_path() || folder.parent_path() == folder) return Config{};
    folder = folder.parent_path();
  }
}

}  // namespace ncport::dialects
