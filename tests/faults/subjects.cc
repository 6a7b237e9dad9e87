#include "tests/faults/subjects.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "app/comparison.h"
#include "app/ncport.h"
#include "backends/sinumerik/raise_words.h"
#include "base/diag/codes.h"
#include "dialects/machine.h"
#include "tests/faults/seam.h"
#include "tests/random/texts.h"
#include "tests/tools/process.h"
#include "tests/tools/trace_compare.h"
#include "tests/tools/vectors.h"

namespace ncport::tests::faults {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMostBlocks = 300'000;

/// The called programs stand beside the main program.
FileProvider Beside(const fs::path& program) {
  return [folder = program.parent_path()](std::string_view name) -> std::optional<Input> {
    std::string lower(name);
    std::ranges::transform(lower, lower.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string& base : {std::string(name), lower}) {
      for (const char* ending : {"", ".spf", ".mpf", ".SPF", ".MPF", ".nc"}) {
        const fs::path path = folder / (base + ending);
        if (fs::is_regular_file(path)) return Input{path.string(), ReadFileOrDie(path.string())};
      }
    }
    return std::nullopt;
  };
}

void Settle(const Job& job, RunSettings& settings) {
  settings.from = job.from;
  settings.set = job.set;
  settings.start = job.start;
  settings.call = job.call;
  settings.max_blocks = kMostBlocks;
  settings.find = Beside(job.program);
}

std::vector<Input> InputsOf(const Job& job) {
  return {Input{job.program.string(), ReadFileOrDie(job.program.string())}};
}

std::string FirstError(const diag::Sink& sink) {
  for (const diag::Diagnostic& finding : sink.All()) {
    if (finding.severity == diag::Severity::kError)
      return std::string(diag::InfoOf(finding.code).number) + " " + finding.message;
  }
  return "no finding";
}

std::string SaidBy(const diag::Diagnostic& finding) {
  return std::string(diag::InfoOf(finding.code).number) + " " + std::to_string(finding.at.line) + ":" +
         std::to_string(finding.at.begin) + " " + finding.message + " (" + finding.help + ")\n";
}

std::string AllSaid(const diag::Sink& sink) {
  std::string all;
  for (const diag::Diagnostic& finding : sink.All()) all += SaidBy(finding);
  return all;
}

/// The programs printed from what they mean: no word keeps the way in which it was written.
std::string Printed(const ir::Module& module, const dialects::Profile& profile) {
  backends::Translation bare;
  bare.module = module;
  backends::sinumerik::DropSpellings(bare);
  std::string all;
  for (const random::TextFile& file : random::PrintAll(bare.module, profile)) all += file.text;
  return all;
}

/// Takes the options of a command line that a job can have.
void TakeOptions(const std::vector<std::string>& words, const fs::path& folder, Job& job) {
  job.refused = job.refused || std::ranges::find(words, "--refused") != words.end();
  job.keep = job.keep || std::ranges::find(words, "--increments=keep") != words.end();
  job.print = job.print || std::ranges::find(words, "--print") != words.end();
  const auto in_folder = [&](const std::string& name) {
    return fs::exists(folder / name) ? (folder / name).string() : name;
  };
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& value = words[i + 1];
    if (words[i] == "--from") job.from = in_folder(value);
    if (words[i] == "--to") job.to = in_folder(value);
    if (words[i] == "--start") job.start = value;
    if (words[i] == "--set") job.set.push_back(value);
    if (words[i] == "--call") job.call = value;
    if (words[i] == "--config") job.config = in_folder(value);
  }
}

void AddVectors(const fs::path& root, Jobs& jobs) {
  for (const Vector& vector : ListVectors(root / "tests/vectors")) {
    if (vector.open || vector.options.empty()) continue;
    Job job;
    job.name = vector.name;
    job.program = vector.program;
    TakeOptions(vector.options, vector.program.parent_path(), job);
    Job read = job;
    read.expected = vector.expected_text;
    read.alarms = vector.ExpectsAlarm();
    jobs.read.push_back(read);
    std::vector<std::string> targets;
    const bool lathe = job.from.find("lathe") != std::string::npos;
    if (vector.language == "sinumerik") {
      targets = {"fanuc-mill", "fanuc-lathe-a", "fanuc-lathe-b", (root / "tests/port/qtn.toml").string(),
                 lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill"};
    } else if (vector.language == "fanuc") {
      targets = {lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill"};
    }
    targets.emplace_back(lathe ? "iso-lathe" : "iso-mill");
    for (const std::string& target : targets) {
      Job write = job;
      write.to = target;
      jobs.write.push_back(write);
    }
  }
}

void AddSamples(const fs::path& root, Jobs& jobs) {
  const auto add = [&](const std::string& program, const std::string& from, const std::vector<std::string>& targets) {
    for (const std::string& target : targets) {
      const fs::path folder = (root / "samples" / program).parent_path();
      Job job{"samples/" + program, root / "samples" / program, from, target};
      if (fs::exists(folder / target)) job.to = (folder / target).string();
      if (fs::exists(folder / "ncport.toml")) job.config = (folder / "ncport.toml").string();
      jobs.write.push_back(job);
    }
  };
  const std::vector<std::string> mills{"fanuc-mill", "mazak-mill", "haas-mill", "iso-mill"};
  add("bolt_circle/main.mpf", "sinumerik-840d-mill", mills);
  add("r_parameters/main.mpf", "sinumerik-840d-mill", mills);
  add("turning_cycle/main.mpf", "sinumerik-840d-lathe", {"qtn.toml", "integrex.toml", "iso-lathe"});
  add("bolt_circle_macro/bolt_circle.nc", "fanuc-mill", {"sinumerik-840d-mill", "iso-mill"});
}

/// Unpacks a golden case and lists its commands.
void AddGolden(const fs::path& file, const fs::path& scratch, Jobs& jobs) {
  const fs::path folder = scratch / file.stem();
  fs::create_directories(folder);
  std::istringstream lines(ReadFileOrDie(file.string()));
  std::vector<std::string> commands;
  std::ofstream out;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=== ")) {
      out = std::ofstream();
      if (line.starts_with("=== run: ")) commands.push_back(line.substr(9));
      if (line.starts_with("=== file: ")) {
        const fs::path path = folder / line.substr(10);
        fs::create_directories(path.parent_path());
        out.open(path);
      }
    } else if (out.is_open()) {
      out << line << '\n';
    }
  }
  out = std::ofstream();
  for (const std::string& command : commands) {
    std::istringstream stream(command);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.size() < 2) continue;
    Job job;
    job.name = "golden/" + words[0] + "/" + file.stem().string();
    job.program = folder / words[1];
    job.golden = true;
    TakeOptions(words, folder, job);
    if (job.config.empty() && fs::exists(folder / "ncport.toml")) job.config = (folder / "ncport.toml").string();
    if (job.from.empty() || !fs::is_regular_file(job.program)) continue;
    if (words[0] == "translate" || words[0] == "flatten") {
      if (!job.to.empty()) jobs.write.push_back(job);
      continue;
    }
    const bool ir = words[0] == "dump" && std::ranges::find(words, "ir") != words.end();
    if (!ir && words[0] != "trace" && words[0] != "check") continue;
    jobs.said.emplace_back(job, ir ? Shown::kIr : words[0] == "trace" ? Shown::kTrace : Shown::kFindings);
  }
}

/// programs/: each has lines `; faults: OPTIONS` or `(FAULTS: OPTIONS)` at its head, one for each use, and may have a
/// trace beside it in NAME.expected, compared for each line without --to.
void AddOwn(const fs::path& folder, Jobs& jobs) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& path : files) {
    std::istringstream lines(ReadFileOrDie(path.string()));
    for (std::string line; std::getline(lines, line);) {
      static constexpr std::string_view kMarks[] = {"; faults: ", "(FAULTS: "};
      for (const std::string_view mark : kMarks) {
        const std::size_t at = line.find(mark);
        if (at == std::string::npos) continue;
        std::string options = line.substr(at + mark.size());
        if (mark[0] == '(') {
          options = options.substr(0, options.find(')'));
          std::ranges::transform(options, options.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
        }
        std::istringstream stream(options);
        std::vector<std::string> words;
        for (std::string word; stream >> word;) words.push_back(word);
        Job job;
        job.name = "programs/" + path.filename().string();
        job.program = path;
        TakeOptions(words, folder, job);
        if (!job.to.empty() || job.print) {
          jobs.write.push_back(job);
          continue;
        }
        fs::path expected = path;
        job.expected = ReadFileOrDie(expected.replace_extension(".expected").string());
        job.alarms = job.expected.find("\nALARM ") != std::string::npos;
        jobs.read.push_back(job);
      }
    }
  }
}

}  // namespace

Jobs ListJobs(const fs::path& root, const fs::path& scratch) {
  Jobs jobs;
  AddOwn(root / "tests/faults/programs", jobs);
  AddSamples(root, jobs);
  for (const char* folder : {"tests/golden/dump", "tests/golden/trace", "tests/golden/check", "tests/golden/translate",
                             "tests/golden/flatten"}) {
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      if (entry.path().extension() == ".case") AddGolden(entry.path(), scratch, jobs);
    }
  }
  AddVectors(root, jobs);
  return jobs;
}

std::string CheckTrace(const Job& job) {
  Context context;
  TraceOptions options;
  Settle(job, options);
  options.variables = true;
  std::string text;
  bool done = false;
  {
    OutputSink output(text);
    done = ::ncport::Trace(context, InputsOf(job), options, output).Ok();
  }
  if (done == job.alarms) return "ends otherwise: " + FirstError(context.findings);
  const ParsedTrace actual = ParseTrace(text), expected = ParseTrace(job.expected);
  if (!actual.error.empty()) return actual.error;
  return CompareVector(actual.trace, expected.trace).value_or("");
}

std::string Say(const Job& job, Shown shown) {
  Context context;
  std::string text;
  {
    OutputSink output(text);
    if (shown == Shown::kTrace) {
      TraceOptions options;
      Settle(job, options);
      static_cast<void>(::ncport::Trace(context, InputsOf(job), options, output));
    } else if (shown == Shown::kIr) {
      DumpOptions options;
      options.from = job.from;
      static_cast<void>(Dump(context, InputsOf(job), options, output));
    } else {
      CheckOptions options;
      options.from = job.from;
      options.find = Beside(job.program);
      static_cast<void>(Check(context, InputsOf(job), options));
    }
  }
  text += AllSaid(context.findings);
  return text;
}

std::string Subject::Prepare() {
  context_ = std::make_unique<Context>();
  auto target = dialects::LoadProfile(job_.print ? job_.from : job_.to, context_->files, context_->findings);
  const auto said = [&] { return FirstError(context_->findings); };
  if (!target.Ok()) return said();
  target_ = *target;
  flat_ = target_.language == dialects::Language::kIso;
  if (!job_.config.empty()) {
    auto config = dialects::LoadConfig(job_.config, context_->files, context_->findings);
    if (!config.Ok()) return said();
    all_config_ = *config;
    config_ = all_config_.For(job_.to);
  }
  Now().asked.clear();
  Now().taken.clear();
  RunSettings settings;
  Settle(job_, settings);
  if (!app::ReadSet(*context_, InputsOf(job_), settings, app::ProfileNeed::kNamed, set_).Ok()) return said();
  machine_ = dialects::MachineFor(set_.profile);
  if (job_.print) {
    text_ = Printed(set_.module, set_.profile);
    asked = Now().asked;
    taken = Now().taken;
    return ReadAndPrint(text_);
  }
  const auto run = app::RunOptionsFor(*context_, set_, settings);
  if (!run.Ok()) return said();
  run_ = *run;
  app::TakeCall(run_, set_, config_);
  if (flat_) {
    Context context;
    TraceOptions options;
    Settle(job_, options);
    OutputSink output(source_trace_);
    if (!::ncport::Trace(context, InputsOf(job_), options, output).Ok())
      return "its trace: " + FirstError(context.findings);
  }
  std::vector<backends::OutputFile> files;
  backends::Translation translation;
  const std::string refused = Write(text_, files, translation);
  asked = Now().asked;
  taken = Now().taken;
  if (job_.refused != !refused.empty() && !job_.golden) return refused.empty() ? "is not refused" : refused;
  refusal_ = refused;
  told_ = now_told_;
  maps_ = now_maps_;
  if (!refused.empty()) return {};
  compared_ = true;
  std::string found = Compare(text_, files, translation);
  // Without inputs a branch that no run takes stays open: differences are found all the same.
  compared_ = !found.starts_with("not compared");
  if (!flat_ && !compared_ && found.find("branch") != std::string::npos) found.clear();
  text_alone_ = job_.golden && !found.empty();
  return text_alone_ ? "" : found;
}

/// What is said of a refused program: the first error, or all of it where that is what the program is for.
std::string Subject::Refusal(const diag::Sink& sink) const {
  return "refused: " + (job_.golden || job_.refused ? AllSaid(sink) : FirstError(sink));
}

void Subject::Tell(const diag::Sink& sink, const backends::Translation& translation) {
  now_told_.clear();
  now_maps_.clear();
  const auto map = [&](std::initializer_list<std::uint64_t> numbers) {
    for (const std::uint64_t number : numbers) now_maps_ += std::to_string(number) + " ";
    now_maps_ += '\n';
  };
  for (const backends::ToolUse& use : translation.tools)
    map({use.source_tool, use.source_edge, use.source_radius, use.target_tool, use.target_offset, use.target_suffix,
         use.target_radius, use.offset_only ? 1U : 0U});
  for (const backends::OffsetUse& use : translation.offsets)
    map({use.source, use.source_extension, use.target, use.target_extension});
  for (const backends::AlarmUse& use : translation.alarms) map({use.source, use.target});
  for (const backends::AuxUse& use : translation.aux) map({use.source, use.target.value_or(9999)});
  if (!job_.golden) return;
  // The head of the output and what stands in stderr.
  for (const auto* lines : {&translation.added, &translation.required, &translation.assumptions}) {
    for (const std::string& line : *lines) now_told_ += line + "\n";
  }
  for (const diag::Diagnostic& finding : sink.All())
    now_told_ += std::to_string(finding.at.line) + " " + finding.message + "\n";
}

std::string Subject::ReadAndPrint(const std::string& text) {
  Context context;
  app::ProgramSet again;
  RunSettings settings;
  Settle(job_, settings);
  if (!app::ReadSet(context, {Input{job_.program.string(), text}}, settings, app::ProfileNeed::kNamed, again).Ok())
    return "cannot be read back: " + FirstError(context.findings);
  const std::string other = Printed(again.module, again.profile);
  if (other == text_) return {};
  std::istringstream had(text_), has(other);
  std::string before, behind;
  while (before == behind && std::getline(had, before)) {
    if (!std::getline(has, behind)) behind.clear();
  }
  return "reads back as another program: " + before + " becomes " + behind;
}

std::string Subject::Write(std::string& text, std::vector<backends::OutputFile>& files,
                           backends::Translation& translation) {
  Context context;
  text.clear();
  if (flat_) {
    FlattenOptions options;
    Settle(job_, options);
    options.to = job_.to;
    options.config = &all_config_;
    OutputSink output(text);
    if (!Flatten(context, InputsOf(job_), options, output).Ok()) return Refusal(context.findings);
    Tell(context.findings, translation);
    return {};
  }
  const backends::TranslateInput input{&set_.module, &set_.profile, &machine_, &target_, &config_, job_.keep};
  if (!backends::Raise(input, translation, context.findings)) return Refusal(context.findings);
  files = backends::Print(target_, translation, {});
  Tell(context.findings, translation);
  for (const backends::OutputFile& file : files) text += file.name + "\n" + file.text;
  // Heads of programs name the variables.
  for (const ir::transform::CellMapping& cell : translation.cells) text += cell.target + " = " + cell.source + "\n";
  return {};
}

std::string Subject::Compare(const std::string& text, const std::vector<backends::OutputFile>& files,
                             const backends::Translation& translation) {
  if (flat_) {
    Context context;
    TraceOptions options;
    options.from = job_.to;
    options.max_blocks = kMostBlocks;
    std::string flat;
    {
      OutputSink output(flat);
      if (!::ncport::Trace(context, {Input{"flat.nc", text}}, options, output).Ok())
        return "the flat program: " + FirstError(context.findings);
    }
    ParsedTrace a = ParseTrace(source_trace_), b = ParseTrace(flat);
    if (!a.error.empty() || !b.error.empty()) return a.error + b.error;
    FlatAllowance allowance;
    allowance.diameter_words = target_.diameter.Is(dialects::DiameterRule::kYes);
    const auto difference = CompareWithFlat(a.trace, b.trace, allowance);
    return difference ? "flat: " + *difference : "";
  }
  app::ComparisonSetup setup;
  setup.runs = 25;
  setup.max_blocks = kMostBlocks;
  std::vector<prove::Input> inputs;
  const std::size_t before = context_->findings.All().size();
  const prove::Verification verification =
      app::CompareTranslation(*context_, set_, machine_, run_, target_, translation, files, &config_, setup, inputs);
  if (verification.difference) return "difference: " + verification.difference->what;
  if (!verification.compared && compared_) {
    const auto& all = context_->findings.All();
    return "not compared: " + verification.not_compared + (all.size() > before ? ", " + all.back().message : "");
  }
  return {};
}

std::string Subject::Judge(bool& changed) {
  std::string text;
  std::vector<backends::OutputFile> files;
  backends::Translation translation;
  if (job_.print) {
    text = Printed(set_.module, set_.profile);
    Now().active = kNone;
    Now().table = {};
    changed = text != text_;
    return changed ? ReadAndPrint(text) : "";
  }
  const std::string refused = Write(text, files, translation);
  Now().active = kNone;
  Now().table = {};
  if (refused != refusal_)
    return refused.empty() ? "is not refused" : (refusal_.empty() ? "" : "for other reasons ") + refused;
  if (!refused.empty()) return {};
  changed = text != text_ || now_told_ != told_;
  return (changed || now_maps_ != maps_) && !text_alone_ ? Compare(text, files, translation) : "";
}

}  // namespace ncport::tests::faults
