// ncport_golden BINARY FOLDER CODES [--update [PART OF A NAME]]: runs each FOLDER/**/*.case and compares what ncport
// says and writes. README.md has the form of a case. Also: each diagnostic of CODES (base/diag/codes.def) stands in a
// case, or in uncovered.txt, which may only shrink. Nothing is rewritten without --update.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/process.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

/// One part of a case: `=== kind: name`, then text up to the next part.
struct Part {
  std::string kind;
  std::string name;
  std::string text;
};

struct Case {
  std::string note;  // lines before the first part
  std::vector<Part> parts;

  [[nodiscard]] const Part* Find(const std::string& kind, const std::string& name = {}) const {
    for (const Part& part : parts) {
      if (part.kind == kind && (name.empty() || part.name == name)) return &part;
    }
    return nullptr;
  }
};

Case ReadCase(const std::string& text) {
  Case result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=== ")) {
      const std::size_t colon = line.find(": ");
      Part part;
      part.kind = line.substr(4, colon == std::string::npos ? colon : colon - 4);
      if (colon != std::string::npos) part.name = line.substr(colon + 2);
      result.parts.push_back(part);
    } else {
      (result.parts.empty() ? result.note : result.parts.back().text) += line + "\n";
    }
  }
  return result;
}

std::string WriteCase(const Case& one) {
  std::string text = one.note;
  for (const Part& part : one.parts)
    text += "=== " + part.kind + (part.name.empty() ? "" : ": " + part.name) + "\n" + part.text;
  return text;
}

/// Words of a command line; single and double quotes keep blanks.
std::vector<std::string> CommandWords(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool open = false;
  char quote = 0;
  for (const char c : line) {
    if (quote != 0 ? c == quote : c == '\'' || c == '"') {
      quote = quote != 0 ? '\0' : c;
      open = true;
    } else if (c == ' ' && quote == 0) {
      if (open) words.push_back(word);
      word.clear();
      open = false;
    } else {
      word += c;
      open = true;
    }
  }
  if (open) words.push_back(word);
  return words;
}

std::string WithLineEnd(std::string text) {
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

/// The case with the parts that ncport produced: stdout, stderr, exit, output files.
std::optional<Case> Produce(const std::string& binary, const Case& asked, std::string& why) {
  const Part* run = asked.Find("run");
  if (run == nullptr || run->name.empty()) {
    why = "has no line `=== run: ...`";
    return std::nullopt;
  }
  const ScratchFolder folder;
  Case result;
  result.note = asked.note;
  for (const Part& part : asked.parts) {
    if (part.kind == "run" || part.kind == "input") result.parts.push_back(part);
    if (part.kind != "file") continue;
    fs::create_directories(fs::path(folder.File(part.name)).parent_path());
    folder.Write(part.name, part.text);
    result.parts.push_back(part);
  }
  std::vector<std::string> words = CommandWords(run->name);
  words.insert(words.begin(), fs::absolute(binary).string());
  const Part* input = asked.Find("input");
  const ProcessResult done = RunProcess(words, input == nullptr ? "" : input->text, 60, folder.Path());
  if (!done.Clean()) {
    why = done.timed_out ? "took more than a minute"
                         : "ended by a signal, code " + std::to_string(done.exit_code) + "\n" + Tail(done.errors, 5);
    return std::nullopt;
  }
  if (!done.output.empty()) result.parts.push_back({"stdout", "", WithLineEnd(done.output)});
  if (!done.errors.empty()) result.parts.push_back({"stderr", "", WithLineEnd(done.errors)});
  // Files that the run wrote.
  std::vector<std::string> written;
  for (const auto& entry : fs::recursive_directory_iterator(folder.Path())) {
    const std::string name = fs::relative(entry.path(), folder.Path()).string();
    if (entry.is_regular_file() && asked.Find("file", name) == nullptr) written.push_back(name);
  }
  std::sort(written.begin(), written.end());
  for (const std::string& name : written)
    result.parts.push_back({"written", name, WithLineEnd(ReadFileOrDie(folder.File(name)))});
  result.parts.push_back({"exit", std::to_string(done.exit_code), ""});
  return result;
}

/// Codes of the findings in a report for reading; pages and lists that name codes show none.
std::set<std::string> CodesFound(const std::string& report) {
  static const std::regex found("(?:error|warning|info)\\[(NC[0-9]{4})\\]: ");
  std::set<std::string> codes;
  for (std::sregex_iterator i(report.begin(), report.end(), found), end; i != end; ++i) codes.insert((*i)[1]);
  return codes;
}

/// First line in which two texts differ.
std::string FirstDifference(const std::string& expected, const std::string& actual) {
  std::istringstream left(expected), right(actual);
  for (int line = 1;; ++line) {
    std::string a, b;
    const bool has_a = static_cast<bool>(std::getline(left, a)), has_b = static_cast<bool>(std::getline(right, b));
    if (!has_a && !has_b) return "the same but for line ends";
    if (has_a != has_b || a != b) {
      return "line " + std::to_string(line) + "\n  expected: " + (has_a ? a : "(end)") +
             "\n  actual:   " + (has_b ? b : "(end)");
    }
  }
}

/// Codes of a list of diagnostics.
std::set<std::string> CodesIn(const std::string& text) {
  static const std::regex code("NC[0-9]{4}");
  std::set<std::string> codes;
  for (std::sregex_iterator i(text.begin(), text.end(), code), end; i != end; ++i) codes.insert(i->str());
  return codes;
}

int Main(const std::string& binary, const fs::path& folder, const std::string& codes_file, bool update,
         const std::string& only) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".case") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  int failed = 0, passed = 0;
  std::set<std::string> seen;
  const auto fail = [&](const std::string& what, const std::string& why) {
    ++failed;
    std::printf("FAILED %s\n%s\n", what.c_str(), why.c_str());
  };
  for (const fs::path& file : files) {
    const std::string name = fs::relative(file, folder).string();
    const std::string text = ReadFileOrDie(file.string());
    const Case asked = ReadCase(text);
    for (const Part& part : asked.parts) {
      if (part.kind == "stdout" || part.kind == "stderr") seen.merge(CodesFound(part.text));
    }
    if (name.find(only) == std::string::npos) continue;
    std::string why;
    const std::optional<Case> produced = Produce(binary, asked, why);
    if (!produced) {
      fail(name, why);
      continue;
    }
    const std::string actual = WriteCase(*produced);
    if (update && actual != text) {
      std::ofstream(file, std::ios::binary) << actual;
      std::printf("rewritten: %s\n", name.c_str());
      continue;
    }
    const bool is_bad = file.filename().string().starts_with("bad_");
    if (actual != text) {
      fail(name, FirstDifference(text, actual));
    } else if (is_bad == (produced->Find("exit")->name == "0")) {
      fail(name, is_bad ? "is named bad_ but ends with 0" : "ends with an error: such cases are named bad_*.case");
    } else {
      ++passed;
    }
  }
  if (only.empty() && !update) {
    std::set<std::string> uncovered = CodesIn(ReadFileOrDie((folder / "uncovered.txt").string()));
    for (const std::string& code : CodesIn(ReadFileOrDie(codes_file))) {
      const bool listed = uncovered.erase(code) != 0;
      if (!seen.contains(code) && !listed) fail(code, "no case shows this diagnostic");
      if (seen.contains(code) && listed) fail(code, "a case shows it: take it out of uncovered.txt");
    }
    for (const std::string& code : uncovered) fail(code, "stands in uncovered.txt and is no diagnostic");
  }
  std::printf("%d of %zu golden cases as written, %zu diagnostics shown by cases\n", passed, files.size(), seen.size());
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc < 4 || (argc > 4 && std::string(argv[4]) != "--update")) {
    std::fprintf(stderr, "usage: ncport_golden BINARY FOLDER CODES [--update [PART OF A NAME]]\n");
    return 2;
  }
  return ncport::tests::Main(argv[1], argv[2], argv[3], argc > 4, argc > 5 ? argv[5] : "");
}
