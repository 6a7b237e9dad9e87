// Findings that a folder lives with: `check --baseline` leaves them out, so that only new ones show.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"

namespace ncport::app {

/// Known findings, each by file, code and the text of its block without the block number: blocks above may come and go,
/// and programs may be numbered anew. Equal ones are counted. What is not in a file of programs is never known.
class Baseline {
 public:
  /// All findings of `findings` that have a place.
  static Baseline Of(const diag::Sink& findings, const SourceFiles& files);
  /// Reads what Render wrote; `name` is for the finding about another text.
  static Result<Baseline> Parse(std::string_view json, std::string_view name, diag::Sink& findings);

  /// JSON: {version, findings: [{file, code, block, count}]}, ordered, so that changes show as few lines.
  [[nodiscard]] std::string Render() const;
  /// Takes known findings out of `findings`, of equal ones as many as are known.
  void Silence(diag::Sink& findings, const SourceFiles& files) const;

 private:
  using Key = std::tuple<std::string, std::string, std::string>;  // file, code, block
  static Key KeyOf(const diag::Diagnostic& finding, const SourceFiles& files);

  std::map<Key, std::uint32_t> counts_;
};

}  // namespace ncport::app
