// ncport_typos BINARY TABLE PROFILE [one]: checks each program of the table and compares line and cause of what is
// found. The head of the table has its form. `one`: the typing error is also the only finding, since one slip has one
// cause.
#include <nlohmann/json.hpp>

#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tools/process.h"

namespace ncport::tests {
namespace {

using Json = nlohmann::json;

constexpr double kLeastCauses = 0.9;  // of all programs

struct Typo {
  std::string name, code, word, text;
  int line = 0;
};

std::string Trim(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<Typo> ReadTable(const std::string& path) {
  std::vector<Typo> typos;
  std::istringstream lines(ReadFileOrDie(path));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("--- ")) {
      std::istringstream fields(line.substr(4));
      std::string field[4];
      for (std::string& one : field) std::getline(fields, one, '|');
      typos.push_back({Trim(field[0]), Trim(field[2]), Trim(field[3]), "", std::stoi(field[1])});
    } else if (!typos.empty() && !line.empty()) {
      typos.back().text += line + "\n";
    }
  }
  return typos;
}

/// Everything that a finding says, and the text that it marks.
std::string TextOf(const Json& finding, const std::string& program) {
  std::string text = finding["message"].get<std::string>();
  if (finding["help"].is_string()) text += "\n" + finding["help"].get<std::string>();
  for (const Json& note : finding["notes"]) text += "\n" + note["message"].get<std::string>();
  std::istringstream lines(program);
  std::string line;
  for (int i = 0; i < finding["line"].get<int>(); ++i) std::getline(lines, line);
  const auto column = finding["column"].get<std::size_t>();
  return text + "\n" + line.substr(column - 1, finding["endColumn"].get<std::size_t>() - column);
}

struct Verdict {
  bool line = false, cause = false;
  int findings = 0;
  std::string said;
};

Verdict Check(const std::string& binary, const std::string& profile, const Typo& typo) {
  const ScratchFolder folder;
  const std::string file = folder.Write(typo.text.starts_with("PROC") ? "program.spf" : "program.mpf", typo.text);
  const ProcessResult run = RunProcess({binary, "check", file, "--from", profile, "--format", "json"});
  Verdict verdict;
  const Json report = Json::parse(run.output, nullptr, false);
  if (!run.Clean() || report.is_discarded()) {
    verdict.said = "ended with code " + std::to_string(run.exit_code) + "\n" + Tail(run.errors, 5);
    return verdict;
  }
  for (const Json& finding : report["findings"]) {
    if (!finding["line"].is_number()) continue;
    ++verdict.findings;
    const bool here = finding["line"].get<int>() == typo.line;
    const std::string text = TextOf(finding, typo.text);
    verdict.line = verdict.line || here;
    verdict.cause =
        verdict.cause || (here && finding["code"] == typo.code && text.find(typo.word) != std::string::npos);
    verdict.said += "    " + std::to_string(finding["line"].get<int>()) + " " + finding["code"].get<std::string>() +
                    " " + text + "\n";
  }
  return verdict;
}

int Run(const std::string& binary, const std::string& table, const std::string& profile, bool one) {
  const std::vector<Typo> typos = ReadTable(table);
  std::size_t lines = 0;
  std::size_t causes = 0;
  std::size_t with_others = 0;
  for (const Typo& typo : typos) {
    const Verdict verdict = Check(binary, profile, typo);
    lines += verdict.line ? 1 : 0;
    causes += verdict.cause ? 1 : 0;
    const bool alone = !one || verdict.findings < 2;
    with_others += alone ? 0 : 1;
    if (verdict.line && verdict.cause && alone) continue;
    const char* what = verdict.line ? "another cause" : "another line";
    if (verdict.line && verdict.cause) what = "more than one finding";
    std::printf("%s: %s, wanted line %d %s '%s', found\n%s", typo.name.c_str(), what, typo.line, typo.code.c_str(),
                typo.word.c_str(), verdict.said.c_str());
  }
  std::printf("%zu programs, right line %zu, right cause %zu\n", typos.size(), lines, causes);
  const bool enough = !typos.empty() && lines == typos.size() && with_others == 0 &&
                      static_cast<double>(causes) >= kLeastCauses * static_cast<double>(typos.size());
  return enough ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  const bool one = argc == 5 && std::string_view(argv[4]) == "one";
  if (argc != 4 && !one) return 2;
  return ncport::tests::Run(argv[1], argv[2], argv[3], one);
}
