// ncport_paper BINARY PAPER: checks the listing of a paper as it is printed there (its line breaks, lost words and
// doubled names are part of it; the paper is not part of this tree). Each defect has its finding, no block has two.
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/process.h"

namespace ncport::tests {
namespace {

using Json = nlohmann::json;

/// Texts between the fences of the paper, in order.
std::vector<std::string> Listings(const std::string& text) {
  std::vector<std::string> listings;
  std::istringstream lines(text);
  bool open = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      open = !open;
      if (open) listings.emplace_back();
    } else if (open && !(listings.back().empty() && line.empty())) {
      listings.back() += line + "\n";
    }
  }
  return listings;
}

/// What the finding of the first line that holds `line` must say.
struct Defect {
  const char* line;
  const char* code;
  const char* word;
};
constexpr Defect kDefects[] = {
    {"PROC TURNING_CYCLE(", "NC1006", "a block ends with its line"},
    {"REAL FALLX,", "NC2002", "RFR is declared twice"},
    {"DIV ()", "NC1002", "the brackets are empty"},
    {"MOD ()", "NC1002", "the brackets are empty"},
    {"    =(", "NC1002", "missing in front of ="},
    {"MSG (\"**ROUGHING", "", "a block ends with its line"},
    {"X=- F=RFR", "", "a value is missing behind -"},
};

std::string Said(const Json& finding) {
  std::string text = finding["message"].get<std::string>();
  if (finding["help"].is_string()) text += "\n" + finding["help"].get<std::string>();
  return text;
}

int Run(const std::string& binary, const std::string& paper) {
  if (paper.empty() || !std::filesystem::is_regular_file(paper)) {
    std::printf("skipped: the paper is not here (NCPORT_SHARED)\n");
    return 0;
  }
  const std::vector<std::string> listings = Listings(ReadFileOrDie(paper));
  std::string cycle;
  for (std::size_t i = 0; i + 1 < listings.size(); ++i) {
    if (listings[i].starts_with("PROC TURNING_CYCLE")) cycle = listings[i] + listings[i + 1];
  }
  if (cycle.empty()) {
    std::printf("the paper holds no listing that begins with PROC TURNING_CYCLE\n");
    return 1;
  }
  const ScratchFolder folder;
  const std::string file = folder.Write("turning_cycle.spf", cycle);
  const ProcessResult run = RunProcess({binary, "check", file, "--from", "sinumerik-840d-lathe", "--format", "json"});
  const Json report = Json::parse(run.output, nullptr, false);
  int wrong = 0;
  if (!run.Clean() || report.is_discarded() || run.exit_code != 1) {
    std::printf("ended with code %d\n%s\n", run.exit_code, Tail(run.errors, 5).c_str());
    return 1;
  }
  std::vector<std::string> lines;
  std::istringstream text(cycle);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  std::map<int, std::vector<Json>> by_line;
  for (const Json& finding : report["findings"]) by_line[finding["line"].get<int>()].push_back(finding);
  for (const auto& [line, findings] : by_line) {
    if (findings.size() < 2) continue;
    ++wrong;
    std::printf("line %d has %zu findings\n", line, findings.size());
  }
  for (const Defect& defect : kDefects) {
    bool named = false;
    std::string said;
    for (std::size_t i = 0; i < lines.size() && !named; ++i) {
      if (lines[i].find(defect.line) == std::string::npos) continue;
      for (const Json& finding : by_line[static_cast<int>(i) + 1]) {
        said += finding["code"].get<std::string>() + " " + Said(finding) + "\n";
        const std::string code = finding["code"].get<std::string>();
        named = named || (code.find(defect.code) == 0 && Said(finding).find(defect.word) != std::string::npos);
      }
    }
    if (named) continue;
    ++wrong;
    std::printf("'%s': wanted %s '%s', found\n%s", defect.line, defect.code, defect.word, said.c_str());
  }
  std::printf("%zu lines, %zu findings\n", lines.size(), report["findings"].size());
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  return ncport::tests::Run(argv[1], argv[2]);
}
