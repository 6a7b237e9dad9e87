#include "base/diag/sink.h"

#include <algorithm>
#include <exception>
#include <string>
#include <tuple>
#include <utility>

#include "base/result.h"

namespace ncport::diag {

namespace {

std::string Format(const Info& info, fmt::format_args args) {
  try {
    return fmt::vformat(info.text, args);
  } catch (const std::exception& error) {
    NCPORT_BUG("{} {} reported with wrong arguments: {}", info.number, info.name, error.what());
  }
}

}  // namespace

Diagnostic& Sink::Add(Code code, const SourceRange& at, fmt::format_args args) {
  const Info& info = InfoOf(code);
  if (info.severity == Severity::kError) ++errors_;
  if (info.severity == Severity::kWarning) ++warnings_;
  if (all_.size() < cap_) {
    all_.push_back({.code = code, .severity = info.severity, .at = at, .message = Format(info, args)});
    return all_.back();
  }
  if (all_.size() == cap_) {
    const Info& limit = InfoOf(Code::kTooManyFindings);
    all_.push_back({.code = limit.code,
                    .severity = limit.severity,
                    .at = {},
                    .message = Format(limit, fmt::make_format_args(cap_))});
  }
  suppressed_ = {.code = code, .severity = info.severity, .at = at};
  return suppressed_;
}

void Sink::SetSeverity(Diagnostic& finding, Severity severity) {
  const auto count = [this](Severity of) -> std::size_t* {
    return of == Severity::kError ? &errors_ : of == Severity::kWarning ? &warnings_ : nullptr;
  };
  if (std::size_t* const before = count(finding.severity)) --*before;
  if (std::size_t* const now = count(severity)) ++*now;
  finding.severity = severity;
}

void Sink::SortByPlace() {
  // An invalid file id is the largest one, so findings without a place sort last by themselves.
  std::ranges::stable_sort(all_, {}, [](const Diagnostic& diagnostic) {
    const SourceRange& at = diagnostic.at;
    return std::tuple{at.file.value, at.line, at.begin};
  });
}

}  // namespace ncport::diag
