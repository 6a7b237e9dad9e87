#include "tests/port/port_checks.h"

#include <cstdio>
#include <set>
#include <sstream>
#include <string_view>

namespace ncport::tests {

Translated Translate(const std::string& binary, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{binary, "translate"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Translated outcome;
  outcome.process = RunProcess(command);
  const std::string& text = outcome.process.errors;
  outcome.equal = outcome.process.exit_code == 0 && text.find("EQUAL") != std::string::npos;
  std::set<std::string> codes;
  static constexpr std::string_view kError = "error[";
  for (std::size_t at = text.find(kError); at != std::string::npos; at = text.find(kError, at + 1))
    codes.insert(text.substr(at + kError.size(), 6));
  for (const std::string& code : codes) outcome.codes += (outcome.codes.empty() ? "" : ",") + code;
  return outcome;
}

PortChecks::PortChecks(const std::filesystem::path& refused, bool list)
    : name_(refused.filename().string()), list_(list) {
  std::istringstream lines(ReadFileOrDie(refused.string()));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t end = line.rfind(' ');
    refused_[line.substr(0, end)] = line.substr(end + 1);
  }
}

void PortChecks::Judge(const std::string& key, const Translated& outcome, bool same) {
  ++all_;
  same_ += same ? 1U : 0U;
  if (list_) {
    if (!same) std::printf("%s %s\n", key.c_str(), outcome.codes.c_str());
    return;
  }
  const auto known = refused_.find(key);
  if (same) {
    if (known != refused_.end()) Fail(key + " ports now: take it out of " + name_);
  } else if (!outcome.process.Clean() || outcome.process.exit_code != 1 || outcome.codes.empty()) {
    Fail(key + " ended with code " + std::to_string(outcome.process.exit_code), outcome.process.errors);
  } else if (outcome.codes.find("NC7") != std::string::npos) {
    Fail(key + " does not do the same", outcome.process.errors);
  } else if (known == refused_.end()) {
    Fail(key + " is refused and was not before: " + outcome.codes, outcome.process.errors);
  } else if (known->second != outcome.codes) {
    Fail(key + " is refused by " + outcome.codes + ", " + name_ + " says " + known->second, outcome.process.errors);
  }
  if (known != refused_.end()) refused_.erase(known);
}

void PortChecks::CloseList() {
  for (const auto& [key, codes] : refused_) Fail(name_ + " names no vector: " + key);
}

void PortChecks::Fail(const std::string& what, const std::string& detail) {
  ++failures_;
  std::printf("FAIL %s\n%s", what.c_str(), detail.empty() ? "" : (Tail(detail, 12) + "\n").c_str());
}

}  // namespace ncport::tests
