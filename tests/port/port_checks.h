// Translations of many programs, held against a list of those that are refused. The list names each with the codes of
// its findings, and may only shrink. Never a difference, never output that cannot be compared, never a crash.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/tools/process.h"

namespace ncport::tests {

struct Translated {
  bool equal = false;
  std::string codes;  // of errors, ascending, joined by commas
  ProcessResult process;
};

/// `ncport translate` with these arguments.
Translated Translate(const std::string& binary, const std::vector<std::string>& arguments);

class PortChecks {
 public:
  /// `refused`: lines `KEY CODES`, `#` begins a comment. With `list` nothing is judged: the lines as they are now go to
  /// the standard output.
  PortChecks(const std::filesystem::path& refused, bool list);

  /// `same`: the output does what the source does.
  void Judge(const std::string& key, const Translated& outcome, bool same);
  /// A line that names no program is a failure too.
  void CloseList();
  void Fail(const std::string& what, const std::string& detail = {});

  [[nodiscard]] std::size_t All() const { return all_; }
  [[nodiscard]] std::size_t Same() const { return same_; }
  [[nodiscard]] int Failures() const { return failures_; }

 private:
  std::string name_;
  bool list_;
  std::map<std::string, std::string> refused_;  // codes by key
  std::size_t all_ = 0, same_ = 0;
  int failures_ = 0;
};

}  // namespace ncport::tests
