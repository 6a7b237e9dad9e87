// ncport as a library: program text in, result text and findings out. Touches no file but through the callbacks given.
//
//   ncport::Context context;
//   std::string text;
//   OutputSink output(text);
//   ncport::TraceOptions options;
//   options.from = "sinumerik-840d-mill";
//   const bool done = ncport::Trace(context, {{"main.mpf", bytes}}, options, output).Ok();
//   // context.findings holds what was found
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/report.h"
#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/config.h"

namespace ncport {

/// The texts that were read and what was found in them. One for each call of a function below.
struct Context {
  SourceFiles files;
  diag::Sink findings;
};

/// A program file: its name as findings print it, and its bytes as they stand in the file.
struct Input {
  std::string name;
  std::string bytes;
};

/// Finds the file of a called program by the name that the call gives (`RING`, `L10`, `O9810`); nothing: it is not
/// there.
using FileProvider = std::function<std::optional<Input>(std::string_view program)>;

/// What every function takes.
struct ReadSettings {
  std::string from;  // profile of the input; empty: from `config`, else guessed where that is allowed
  const dialects::Config* config = nullptr;  // ncport.toml
  FileProvider find;                         // may be empty: all programs are among the inputs
};

/// What the functions take that run a program.
struct RunSettings : ReadSettings {
  std::string call;              // `RING(10,,2.5)`; empty: the first program of the first input
  std::vector<std::string> set;  // `R1=5`, `NAME=VALUE`
  std::string start;             // `X0Y0Z0` as the profile programs them; empty: position unknown
  std::uint64_t max_blocks = 10'000'000;
  std::uint64_t max_cells = std::uint64_t{1} << 22U;        // memory of variables
  std::uint64_t max_text_bytes = std::uint64_t{64} << 20U;  // memory of texts
};

enum class TraceFormat : std::uint8_t { kText, kJson };
struct TraceOptions : RunSettings {
  TraceFormat format = TraceFormat::kText;
  bool variables = false;  // final values behind the last event
};

struct FlattenOptions : RunSettings {
  std::string to;                    // profile of the output; empty: from `config`
  bool side_by_side = false;         // source blocks beside flat ones, for reading; not a program
  OutputSink* source_map = nullptr;  // JSON lines, see backends/iso/source_map.h
  OutputSink* report = nullptr;      // the sheet that goes to the machine, see app/report.h
  app::ReportForm report_form = app::ReportForm::kHtml;
  std::string output_name;  // as places in the report print it; may be empty
  std::uint64_t max_bytes = std::uint64_t{1} << 30U;
};

struct TranslateOptions : RunSettings {
  std::string to;                // profile of the output; empty: from `config`
  bool verify = false;           // run both programs and compare; a difference is an error
  std::uint32_t runs = 200;      // parameter sets that count
  std::uint64_t seed = 1;        // of the sets
  OutputSink* report = nullptr;  // the sheet of app/report.h
  app::ReportForm report_form = app::ReportForm::kHtml;
  bool stop_at_unsupported = false;  // refused blocks become alarms; the result has files and the call fails
  OutputSink* source_map = nullptr;  // JSON lines {version, out, file, line, calls, turns}
  bool keep_increments = false;      // else positions, where the target rounds each increment
};

/// A file of the output.
struct TranslatedFile {
  std::string name;  // empty: the only file, named by the user
  std::string text;
};
struct TranslateResult {
  std::vector<TranslatedFile> files;  // also after a failure with `stop_at_unsupported`: to be written all the same
  std::string summary;                // of the comparison, for reading; empty without `verify`
};

/// `call`, `set` and `start` hold for both programs; `from` where a side has no profile of its own.
struct DiffOptions : RunSettings {
  std::string from_a, from_b;
  double tolerance = 0.0001;             // mm, degrees, on top of what the words of each side round
  std::uint64_t max_events = 2'000'000;  // kept of each run, some 400 bytes each
};

struct DiffResult {
  std::string summary;  // EQUAL and what was compared, for reading; empty after a difference
};

struct CheckOptions : ReadSettings {
  std::vector<std::string> select, ignore;  // codes or their first characters (`NC5`); empty select: all
  std::string target;                       // profile: find also what `translate --to` would refuse; empty: none
  const Input* baseline = nullptr;          // text of app/baseline.h: findings to leave out
  std::string* new_baseline = nullptr;      // takes the baseline of all findings, which are then left out
};

enum class DumpStage : std::uint8_t { kTokens, kIr, kCfg };
struct DumpOptions : ReadSettings {
  DumpStage stage = DumpStage::kIr;
};

/// Runs the program and writes its events. Fails after errors and after an alarm of the program.
Status Trace(Context& context, std::vector<Input> inputs, const TraceOptions& options, OutputSink& output);

/// Runs the program and writes flat blocks. After a failure what was written is worthless.
Status Flatten(Context& context, std::vector<Input> inputs, const FlattenOptions& options, OutputSink& output);

/// Writes the programs in the language of the target, loops and variables kept. Fails after errors.
Status Translate(Context& context, std::vector<Input> inputs, const TranslateOptions& options, TranslateResult& result);

/// Runs both programs and compares what the machine does, also across languages. Blocks that a translation marks as its
/// own are left out as contracts section 6 allows. Fails after a difference.
Status Diff(Context& context, const Input& a, const Input& b, const DiffOptions& options, DiffResult& result);

/// Reads and checks all programs. Fails when an error was found. Findings that a comment `ncport: ignore NCxxxx` or the
/// options silence are not in the context.
Status Check(Context& context, std::vector<Input> inputs, const CheckOptions& options);

/// A text in which repairs of findings are done.
struct FixedFile {
  std::string name;
  std::string before, after;
  std::size_t fixes = 0;
};
/// The texts, as UTF-8, that Check read into `context` and for which findings offer repairs, repaired; those findings
/// are taken out. Of repairs that overlap the first is done and the others stay.
std::vector<FixedFile> Fix(Context& context);

/// Shows a stage of the compiler as text.
Status Dump(Context& context, std::vector<Input> inputs, const DumpOptions& options, OutputSink& output);

/// The page on a diagnostic (`NC3001`): why, wrong example, right example, remedy. Empty: there is no such code.
std::string_view Explain(std::string_view code);

/// "0.1.0"
std::string_view Version();

}  // namespace ncport
