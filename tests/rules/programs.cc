// ncport_rule_programs BINARY FOLDER CODES: each diagnostic of CODES (base/diag/codes.def) has a whole page and, in the
// tables FOLDER/*.txt, at least three programs that must be flagged and three that nearly have the mistake and must not
// be. README.md has the form of a table. FOLDER/without_programs.txt names the codes for which programs make no sense.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/process.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

constexpr int kLeastFlagged = 3, kLeastSilent = 3;

struct Program {
  std::string table, name, code, command;
  bool flagged = false;
  int line = 0;               // of the finding; 0: at no line
  std::string says;           // stands in the finding
  std::set<std::string> but;  // other codes that a silent program may show
  std::vector<std::pair<std::string, std::string>> files;
};

struct Finding {
  std::string code, severity, text;
  int line = 0;
};

std::string Trim(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> Words(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  return all;
}

/// `--- NC3001 flagged name | profile or command | line | what it says`, or `silent` with codes in the third field.
Program ReadHead(const std::string& table, const std::string& head) {
  Program program;
  program.table = table;
  std::istringstream fields(head);
  std::string field[4];
  for (std::string& one : field) std::getline(fields, one, '|');
  const std::vector<std::string> first = Words(field[0]);
  if (first.size() != 3 || (first[1] != "flagged" && first[1] != "silent")) {
    std::fprintf(stderr, "%s: not the head of a program: %s\n", table.c_str(), head.c_str());
    std::exit(2);
  }
  program.code = first[0];
  program.flagged = first[1] == "flagged";
  program.name = first[2];
  program.command = Trim(field[1]);
  program.says = Trim(field[3]);
  if (program.flagged) {
    program.line = std::stoi(field[2]);
  } else {
    for (const std::string& code : Words(field[2])) program.but.insert(code);
  }
  return program;
}

std::vector<Program> ReadTable(const fs::path& path) {
  std::vector<Program> programs;
  std::istringstream lines(ReadFileOrDie(path.string()));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("--- ")) {
      programs.push_back(ReadHead(path.filename().string(), line.substr(4)));
      const bool sinumerik = programs.back().command.find("sinumerik") != std::string::npos;
      programs.back().files.emplace_back(sinumerik ? "main.mpf" : "o1.nc", "");
    } else if (!programs.empty() && line.starts_with("+++ ")) {
      auto& files = programs.back().files;
      if (files.back().second.empty()) files.pop_back();
      files.emplace_back(line.substr(4), "");
    } else if (!programs.empty() && !line.empty()) {
      programs.back().files.back().second += line + "\n";
    }
  }
  return programs;
}

/// The findings of a report for reading.
std::vector<Finding> ReadFindings(const std::string& report) {
  static const std::regex head("^(?:[^:]*:(?:([0-9]+):[0-9]+:)? )?(error|warning|info)\\[(NC[0-9]{4})\\]: .*$");
  std::vector<Finding> findings;
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, head)) {
      findings.push_back({match[3], match[2], "", match[1].matched ? std::stoi(match[1]) : 0});
    }
    if (!findings.empty()) findings.back().text += line + "\n";
  }
  return findings;
}

/// Empty: as the table says; else what is wrong.
std::string Wrong(const std::string& binary, const Program& program) {
  const ScratchFolder folder;
  std::vector<std::string> words = Words(program.command);
  if (words.size() == 1) words = {"check", "--from", words[0]};
  words.insert(words.begin(), binary);
  for (const auto& [name, text] : program.files) {
    if (name.find('/') != std::string::npos) fs::create_directories(fs::path(folder.File(name)).parent_path());
    folder.Write(name, text);
    if (name.find('/') == std::string::npos && !name.ends_with(".toml")) words.push_back(name);
  }
  const ProcessResult run = RunProcess(words, "", 60, folder.Path());
  const std::string report = run.errors + (words[1] == "check" ? run.output : "");
  if (!run.Clean() || run.exit_code == 70) return "ended with code " + std::to_string(run.exit_code) + "\n" + report;
  const std::vector<Finding> findings = ReadFindings(report);
  if (!program.flagged) {
    for (const Finding& finding : findings) {
      if (finding.code == program.code) return "is flagged\n" + report;
      if (finding.severity != "info" && !program.but.contains(finding.code)) return "has another finding\n" + report;
    }
    return {};
  }
  bool code = false;
  for (const Finding& finding : findings) {
    if (finding.code != program.code || finding.line != program.line) continue;
    if (finding.text.find(program.says) != std::string::npos) return {};
    code = true;
  }
  return (code ? "is flagged without the words \"" + program.says + "\"\n" : "is not flagged there\n") + report;
}

/// Parts of a page on a diagnostic that `explain` does not show.
std::string MissingParts(const std::string& binary, const std::string& code) {
  const ProcessResult run = RunProcess({binary, "explain", code});
  if (run.exit_code != 0) return " has no page";
  std::string missing;
  const std::size_t wrong = run.output.find("\nWrong:\n\n```\n");
  const std::size_t heading = run.output.find("\n\n");
  if (!run.output.starts_with("## " + code)) missing += " has no heading";
  if (heading == std::string::npos || wrong == std::string::npos || wrong < heading + 30) missing += " says no reason";
  if (wrong == std::string::npos) missing += " has no part Wrong";
  if (run.output.find("\nRight:\n\n```\n") == std::string::npos) missing += " has no part Right";
  const std::size_t remedy = run.output.find("\nRemedy: ");
  if (remedy == std::string::npos || run.output.size() < remedy + 20) missing += " has no Remedy";
  return missing;
}

std::vector<std::string> CodesOf(const std::string& definitions) {
  static const std::regex row("NCPORT_DIAG\\([A-Za-z]+, \"(NC[0-9]{4})\"");
  std::vector<std::string> codes;
  for (std::sregex_iterator i(definitions.begin(), definitions.end(), row), end; i != end; ++i)
    codes.push_back((*i)[1]);
  return codes;
}

/// Codes with a reason: `NC9001 reason`.
std::map<std::string, std::string> WithoutPrograms(const std::string& text) {
  std::map<std::string, std::string> reasons;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("NC")) reasons[line.substr(0, 6)] = Trim(line.substr(6));
  }
  return reasons;
}

int Run(const std::string& binary, const std::string& folder, const std::string& codes_file, const std::string& only) {
  std::vector<fs::path> tables;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("NC") && name.ends_with(".txt")) tables.push_back(entry.path());
  }
  std::sort(tables.begin(), tables.end());
  std::map<std::string, std::pair<int, int>> counts;  // code: flagged, silent
  std::set<std::string> names;
  int wrong = 0, all = 0;
  const auto fail = [&](const std::string& what) {
    std::printf("%s\n", what.c_str());
    ++wrong;
  };
  for (const fs::path& table : tables) {
    for (const Program& program : ReadTable(table)) {
      if (!only.empty() && program.code != only && program.name != only) continue;
      ++all;
      (program.flagged ? counts[program.code].first : counts[program.code].second)++;
      const std::string title = program.table + ": " + program.code + " " + program.name;
      if (!names.insert(program.code + program.name).second) fail(title + ": this name stands twice");
      if (const std::string why = Wrong(binary, program); !why.empty()) fail(title + ": " + why);
    }
  }
  const std::vector<std::string> codes = CodesOf(ReadFileOrDie(codes_file));
  auto reasons = WithoutPrograms(ReadFileOrDie(folder + "/without_programs.txt"));
  for (const std::string& code : codes) {
    if (!only.empty() && code != only) continue;
    if (const std::string missing = MissingParts(binary, code); !missing.empty()) fail("the page of " + code + missing);
    const auto [flagged, silent] = counts[code];
    const auto reason = reasons.find(code);
    const bool enough = flagged >= kLeastFlagged && silent >= kLeastSilent;
    if (reason == reasons.end() && !enough) {
      fail(code + " has " + std::to_string(flagged) + " flagged and " + std::to_string(silent) +
           " silent programs of " + std::to_string(kLeastFlagged) + " and " + std::to_string(kLeastSilent));
    } else if (reason != reasons.end() && (enough || reason->second.size() < 10)) {
      fail("without_programs.txt: " + code + (enough ? " has its programs" : " has no reason"));
    }
    counts.erase(code);
    reasons.erase(code);
  }
  if (only.empty()) {
    for (const auto& [code, count] : counts) fail("no diagnostic " + code + " in codes.def, but a program names it");
    for (const auto& [code, reason] : reasons) fail("no diagnostic " + code + " in codes.def, but a reason names it");
  }
  std::printf("%d programs, %d codes, %d wrong\n", all, static_cast<int>(codes.size()), wrong);
  return wrong == 0 && all > 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: ncport_rule_programs BINARY FOLDER CODES [CODE OR NAME]\n");
    return 2;
  }
  return ncport::tests::Run(std::filesystem::absolute(argv[1]).string(), argv[2], argv[3], argc == 5 ? argv[4] : "");
}
