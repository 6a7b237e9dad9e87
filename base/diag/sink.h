// Collects findings. Errors of the user go here; the code that found one goes on with the next block.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <deque>

#include "base/diag/diagnostic.h"

namespace ncport::diag {

class Sink {
 public:
  static constexpr std::size_t kDefaultCap = 10000;

  /// Keeps at most `cap` findings; the next one becomes Code::kTooManyFindings and later ones are only counted.
  explicit Sink(std::size_t cap = kDefaultCap) : cap_(cap) {}

  /// Adds a finding with the text of the registry and these arguments (texts, whole numbers, doubles). The reference is
  /// for notes, help and the like; it stays valid until SortByPlace. A number of arguments that does not fit is a bug.
  template <class... Args>
  Diagnostic& Report(Code code, const SourceRange& at, const Args&... args) {
    return Add(code, at, fmt::make_format_args(args...));
  }
  /// As Report, with another severity than that of the registry: how sure the finding is decides it.
  template <class... Args>
  Diagnostic& ReportAs(Severity severity, Code code, const SourceRange& at, const Args&... args) {
    Diagnostic& finding = Add(code, at, fmt::make_format_args(args...));
    SetSeverity(finding, severity);
    return finding;
  }

  /// Counts include suppressed findings.
  [[nodiscard]] std::size_t ErrorCount() const { return errors_; }
  [[nodiscard]] std::size_t WarningCount() const { return warnings_; }
  [[nodiscard]] bool HasErrors() const { return errors_ != 0; }
  [[nodiscard]] bool Empty() const { return all_.empty(); }

  [[nodiscard]] const std::deque<Diagnostic>& All() const { return all_; }
  /// Orders by file (in order of reading), line and column; findings at one place keep their order, those without a
  /// place come last.
  void SortByPlace();
  /// Removes the findings for which `drop` is true (ignored codes, a baseline) and takes them out of the counts.
  template <class Predicate>
  std::size_t Remove(Predicate drop) {
    return std::erase_if(all_, [&](const Diagnostic& diagnostic) {
      if (!drop(diagnostic)) return false;
      if (diagnostic.severity == Severity::kError) --errors_;
      if (diagnostic.severity == Severity::kWarning) --warnings_;
      return true;
    });
  }

 private:
  Diagnostic& Add(Code code, const SourceRange& at, fmt::format_args args);
  void SetSeverity(Diagnostic& finding, Severity severity);

  std::deque<Diagnostic> all_;  // references stay valid when it grows
  Diagnostic suppressed_{};     // takes what is added to a finding over the cap
  std::size_t cap_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
};

}  // namespace ncport::diag
