// ncport_corpus BINARY CORPUS RECORD: reads and checks every real program of the shared corpus whose language can be
// read. No crash, no endless run; how many of the blocks are understood is printed and must not fall below RECORD, a
// file with a line "language understood blocks" each. Prints one line and passes when the corpus is not there.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/process.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsPerFile = 20;

struct Folder {
  const char* name;  // below the corpus
  const char* profile;
  std::vector<std::string> endings;  // lower case; empty: every file but documents
};

std::vector<Folder> Folders() {
  return {{"sinumerik", "sinumerik-840d-mill", {".mpf", ".spf", ".arc", ".def", ".cpf", ".ini"}}};
}

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<fs::path> Programs(const fs::path& root, const Folder& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder.name)) {
    if (!entry.is_regular_file()) continue;
    const std::string ending = Lower(entry.path().extension().string());
    if (std::find(folder.endings.begin(), folder.endings.end(), ending) != folder.endings.end())
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Lines that hold more than blanks and a comment.
std::set<int> Blocks(const std::string& text) {
  std::set<int> lines;
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && line[first] != ';') lines.insert(number);
  }
  return lines;
}

struct Count {
  long blocks = 0, understood = 0, files = 0;
  double seconds = 0, longest = 0;
};

int Main(const std::string& binary, const fs::path& corpus, const std::string& record_file) {
  if (corpus.empty() || !fs::is_directory(corpus)) {
    std::printf("the shared corpus is not beside this tree: nothing was read\n");
    return 0;
  }
  int failed = 0;
  const auto fail = [&](const std::string& text) {
    ++failed;
    std::printf("FAILED %s\n", text.c_str());
  };
  std::map<std::string, Count> counts;
  for (const Folder& folder : Folders()) {
    Count& count = counts[folder.name];
    for (const fs::path& file : Programs(corpus, folder)) {
      const std::string name = fs::relative(file, corpus).string();
      const ProcessResult run = RunProcess(
          {binary, "check", file.string(), "--from", folder.profile, "--format", "json", "--fail-on", "never"}, {},
          kSecondsPerFile);
      ++count.files;
      count.seconds += run.seconds;
      count.longest = std::max(count.longest, run.seconds);
      if (!run.Clean() || run.exit_code == 70) {
        fail(name + ": " + (run.timed_out ? "time limit" : "ended with code " + std::to_string(run.exit_code)) + "\n" +
             Tail(run.errors, 5));
        continue;
      }
      const nlohmann::json report = nlohmann::json::parse(run.output, nullptr, false);
      if (report.is_discarded() || !report.contains("findings")) {
        fail(name + ": the report is not the JSON of the contract");
        continue;
      }
      std::set<int> blocks = Blocks(ReadFileOrDie(file.string()));
      count.blocks += static_cast<long>(blocks.size());
      bool whole_file = false;
      for (const auto& finding : report["findings"]) {
        const std::string code = finding.value("code", "");
        if (finding.value("severity", "") != "error" || !code.starts_with("NC1")) continue;
        whole_file |= finding.value("line", 0) == 0;
        blocks.erase(finding.value("line", 0));
      }
      count.understood += whole_file ? 0 : static_cast<long>(blocks.size());
    }
  }
  std::map<std::string, long> record;
  std::istringstream lines(ReadFileOrDie(record_file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string language;
    long understood = 0;
    if (line.empty() || line[0] == '#' || !(words >> language >> understood)) continue;
    record[language] = understood;
  }
  for (const auto& [language, count] : counts) {
    std::printf(
        "%s: %ld of %ld blocks understood (%.1f %%) in %ld files, %.1f s, longest %.2f s\n", language.c_str(),
        count.understood, count.blocks,
        count.blocks == 0 ? 0.0 : 100.0 * static_cast<double>(count.understood) / static_cast<double>(count.blocks),
        count.files, count.seconds, count.longest);
    if (count.files == 0) fail(language + ": no file was found");
    if (!record.contains(language)) fail(language + ": no number in " + record_file);
    if (count.understood < record[language])
      fail(language + ": fell below the recorded " + std::to_string(record[language]));
    if (count.understood > record[language])
      std::printf("%s: more than recorded; write %ld into %s\n", language.c_str(), count.understood,
                  record_file.c_str());
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: ncport_corpus BINARY CORPUS RECORD\n");
    return 2;
  }
  return ncport::tests::Main(argv[1], argv[2], argv[3]);
}
