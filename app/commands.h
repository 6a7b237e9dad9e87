// The commands of the command line: files, findings and exit codes. What they do with programs is in app/ncport.h; the
// options that fill their arguments are in main.cc.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/ncport.h"

namespace ncport::app {

// Contracts section 2.
enum Exit : int { kDone = 0, kFindings = 1, kUsage = 2 };

/// Options of all commands that read programs.
struct Common {
  std::vector<std::string> files;
  std::vector<std::string> folders;
  std::string from;
  std::string config;
  bool quiet = false;
};

struct Running {
  std::string call;
  std::vector<std::string> set;
  std::string start;
  std::uint64_t max_blocks = RunSettings{}.max_blocks;
  std::uint64_t max_cells = RunSettings{}.max_cells;
  std::uint64_t max_text_bytes = RunSettings{}.max_text_bytes;
};

struct TraceArguments : Common, Running {
  std::string format = "text";
  bool variables = false;
};

struct FlattenArguments : Common, Running {
  std::string to, output = "-", source_map, report;
  bool side_by_side = false;
  std::uint64_t max_output = FlattenOptions{}.max_bytes;
};

struct CheckArguments : Common {
  std::string format = "text", fail_on, target, baseline, new_baseline;
  std::vector<std::string> select, ignore;
  bool fix = false;
};

struct DumpArguments : Common {
  std::string stage = "ir";
};

struct TranslateArguments : Common, Running {
  std::string to, output = "-", unsupported = "error", source_map, report;
  std::string increments = "exact";
  bool verify = false;
  std::uint32_t runs = 200;
  std::uint64_t seed = 1;
};

struct DiffArguments : Common, Running {
  std::string from_a, from_b;
  double tolerance = DiffOptions{}.tolerance;
  std::uint64_t max_events = DiffOptions{}.max_events;
};

/// A message that is no finding of a program, to standard error.
void Say(std::string_view text);
/// Writes a text that is complete to standard output. Exit code.
int Print(std::string_view text);

// Each reads its files, does its work and prints; exit code.
int RunTrace(const TraceArguments& arguments);
int RunFlatten(const FlattenArguments& arguments);
int RunCheck(const CheckArguments& arguments);
int RunDump(const DumpArguments& arguments);
int RunTranslate(const TranslateArguments& arguments);
int RunDiff(const DiffArguments& arguments);
int RunExplain(const std::string& code);

}  // namespace ncport::app
