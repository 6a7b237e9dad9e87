// The programs that the faults are judged by, and how each is used.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/pipeline.h"
#include "backends/translate.h"
#include "dialects/config.h"
#include "ir/machine.h"

namespace ncport::tests::faults {

/// A program, and what is to be done with it.
struct Job {
  std::string name;
  std::filesystem::path program;
  std::string from;
  std::string to;      // translate and flatten
  std::string config;  // path of ncport.toml; empty: none
  std::vector<std::string> set;
  std::string start, call;
  std::string expected;  // text of a trace; read only
  bool alarms = false;   // the expected trace ends in an alarm
  bool golden = false;   // the golden cases compare what is written word by word
  bool refused = false;  // the target refuses it, for reasons that are named
  bool keep = false;     // increments stay where the target has words for them
  bool print = false;    // printed in its own language from what it means, and read back
};

/// What a golden case of reading shows.
enum class Shown : std::uint8_t { kTrace, kIr, kFindings };

struct Jobs {
  std::vector<Job> read;  // traced, and compared with the expected trace
  std::vector<Job> write;
  std::vector<std::pair<Job, Shown>> said;  // golden cases of trace, dump and check: all that is said is compared
};
/// Vectors, samples, golden cases (unpacked below `scratch`) and the programs of this test.
Jobs ListJobs(const std::filesystem::path& root, const std::filesystem::path& scratch);

/// Traces a program: empty if it does what is expected, else what is wrong.
std::string CheckTrace(const Job& job);

/// All that is said of a program: trace, IR or nothing, then the findings.
std::string Say(const Job& job, Shown shown);

/// A translation, a flat program or a program printed anew, that is read back and compared; or a refusal.
class Subject {
 public:
  explicit Subject(Job job) : job_(std::move(job)) {}
  /// Reads the source, writes the target and compares, without a fault. Other than empty: why the program is of no use.
  std::string Prepare();
  /// Writes the target with the fault that is on, switches it off, reads back and compares. Empty: nothing was found;
  /// `changed`: but the text is another one.
  std::string Judge(bool& changed);
  [[nodiscard]] const std::string& Name() const { return job_.name; }
  /// A golden case holds the text: another one fails there.
  [[nodiscard]] bool Golden() const { return job_.golden; }

  std::set<std::uint32_t> asked;                          // seams on the way
  std::set<std::pair<const void*, std::uint32_t>> taken;  // rows of tables

 private:
  std::string Write(std::string& text, std::vector<backends::OutputFile>& files, backends::Translation& translation);
  std::string Refusal(const diag::Sink& sink) const;
  void Tell(const diag::Sink& sink, const backends::Translation& translation);
  /// The printed program, read and printed once more: another one than without a fault, or empty.
  std::string ReadAndPrint(const std::string& text);
  std::string Compare(const std::string& text, const std::vector<backends::OutputFile>& files,
                      const backends::Translation& translation);

  Job job_;
  bool flat_ = false, compared_ = false, text_alone_ = false;
  std::unique_ptr<Context> context_;
  app::ProgramSet set_;
  ir::Machine machine_;
  exec::RunOptions run_;
  dialects::Profile target_;
  dialects::Config all_config_, config_;
  std::string text_;
  std::string source_trace_;  // flat
  std::string refusal_;       // all that is said of a program that is refused
  std::string told_, maps_;   // what a golden case shows beside the text; what the comparison maps
  std::string now_told_, now_maps_;
};

}  // namespace ncport::tests::faults
