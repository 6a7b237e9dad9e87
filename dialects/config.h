// `ncport.toml` (contracts section 7): the settings of a folder of programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "ir/modes.h"

namespace ncport::dialects {

/// One line `"T1 D1" = "T0101"`: words with single blanks. A folder whose programs go to several machines names the
/// words of each: `"T1 D1" = { qtn = "T0101", integrex = "T01.01 M6" }`, by profile name or the name of its file.
struct WordMapping {
  std::string source;
  std::string target;
  SourceRange at;
  std::string machine;  // empty: for all
};
struct ProgramMapping {
  std::string source;
  std::vector<std::string> targets;  // numbers as digits; more than one where a cycle is split
  SourceRange at;
};
/// Values that comparison may draw from: "TURNING_CYCLE.EXTD" or "R10" = [20, 300]. An end may be another input with a
/// number added: "TURNING_CYCLE.INTD" = [5, "EXTD-1"]; a parameter of the same program needs no program name.
struct ValueRange {
  std::string name;
  double least = 0;  // a number, or what is added to `least_of`
  double most = 0;
  SourceRange at;
  std::string least_of, most_of;  // empty: the end is a number
};
/// Largest value of a word ("spindle" 1/min, "feed" mm/min), or envelope of an axis ("x": -most .. most, or [least,
/// most]).
struct Limit {
  std::string name;  // lower case
  double least = 0;
  double most = 0;
  SourceRange at;
};
enum class FailOn : std::uint8_t { kError, kWarning, kNever };

struct Config {
  FileId file;         // invalid: there is none
  std::string folder;  // of the file; relative paths in it start there
  std::optional<std::string> from, to;
  std::vector<WordMapping> tools;
  std::vector<WordMapping> offsets;
  std::vector<ProgramMapping> programs;
  std::vector<WordMapping> variables;
  std::vector<MCodeRule> mcodes;
  std::vector<ValueRange> ranges;
  std::vector<std::string> given;  // from --call, not the file: letters that a macro without callers gets, "O9100.R"
  std::vector<Limit> limits;
  ir::ModalState entry;  // groups that the file leaves open are unknown
  std::optional<FailOn> fail_on;
  std::vector<std::string> select, ignore;

  /// This configuration as it holds for a target profile: of the words that are named by machine, its own.
  [[nodiscard]] Config For(std::string_view target) const;
  /// The target words of a tool call, work offset, variable; none = not mapped. "T1" also finds the key "T1 D1".
  [[nodiscard]] const WordMapping* FindTool(std::string_view words) const;
  [[nodiscard]] const WordMapping* FindOffset(std::string_view word) const;
  [[nodiscard]] const WordMapping* FindVariable(std::string_view name) const;
  [[nodiscard]] const ProgramMapping* FindProgram(std::string_view name) const;
};

/// Reads the file at `path`. Fails after errors: unreadable, unknown keys, wrong values.
Result<Config> LoadConfig(std::string_view path, SourceFiles& files, diag::Sink& sink);
/// The nearest `ncport.toml` in the folder of `first_input` or above it; an empty Config if there is none.
Result<Config> FindConfig(std::string_view first_input, SourceFiles& files, diag::Sink& sink);

}  // namespace ncport::dialects
