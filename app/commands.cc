#include "app/commands.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "app/output_file.h"
#include "app/program_folders.h"
#include "base/diag/github_renderer.h"
#include "base/diag/json_renderer.h"
#include "base/diag/sarif_renderer.h"
#include "base/diag/text_renderer.h"

namespace ncport::app {

void Say(std::string_view text) { fmt::print(stderr, "ncport: {}\n", text); }

namespace {

bool IsFolder(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode);
}

/// `out/`: a path that ends like a folder and is not there becomes one; what leads there must be there.
bool MakeFolder(const std::string& path) { return path.ends_with('/') && ::mkdir(path.c_str(), 0777) == 0; }

/// Findings about the command line, profiles and configuration: the programs are not to blame.
bool IsUsage(diag::Code code) {
  using diag::Code;
  switch (code) {
    case Code::kBadOption:
    case Code::kNoProfile:
    case Code::kUnclearLanguage:
    case Code::kUnknownProfile:
    case Code::kUnreadableFile:
    case Code::kTomlSyntax:
    case Code::kUnknownKey:
    case Code::kWrongKeyValue:
    case Code::kProfileCycle:
    case Code::kMissingKey:
      return true;
    default:
      return false;
  }
}

/// Inputs, configuration and findings of one command.
class Session {
 public:
  explicit Session(const Common& common) : common_(common), folders_(common.folders) {}

  /// Reads configuration and inputs. False: a message was printed, the exit code is kUsage.
  bool Read() {
    for (const std::string& file : common_.files) {
      if (IsFolder(file)) {
        Say(fmt::format("{0} is a folder: name the programs in it ({0}/*); -I {0} finds called programs there", file));
        return false;
      }
      std::string error;
      std::optional<std::string> bytes = ReadBytes(file, error);
      if (!bytes) {
        Say(error);
        return false;
      }
      inputs_.push_back({file == "-" ? "(stdin)" : file, *std::move(bytes)});
    }
    const bool named = !common_.config.empty();
    Result<dialects::Config> config =
        named ? dialects::LoadConfig(common_.config, context.files, context.findings)
              : dialects::FindConfig(common_.files.front(), context.files, context.findings);
    if (!config.Ok()) {
      PrintFindings();
      return false;
    }
    config_ = std::move(config).Value();
    // Text without a name says nothing about its language (contracts section 2).
    for (const std::string& file : common_.files) {
      if (file != "-" || !common_.from.empty() || config_.from) continue;
      Say("standard input needs --from");
      return false;
    }
    return true;
  }

  void Fill(ReadSettings& settings) {
    settings.from = common_.from;
    settings.config = &config_;
    settings.find = [this](std::string_view program) { return folders_.Find(program); };
  }
  void Fill(RunSettings& settings, const Running& running) {
    Fill(settings);
    settings.call = running.call;
    settings.set = running.set;
    settings.start = running.start;
    settings.max_blocks = running.max_blocks;
    settings.max_cells = running.max_cells;
    settings.max_text_bytes = running.max_text_bytes;
  }

  /// Findings to standard error, in the order of their places. --quiet leaves errors only.
  void PrintFindings() {
    if (common_.quiet) {
      context.findings.Remove(
          [](const diag::Diagnostic& finding) { return finding.severity != diag::Severity::kError; });
    }
    context.findings.SortByPlace();
    const std::string text = diag::RenderText(context.findings, context.files);
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
  }

  /// Exit code of a command that ended with `ok`, its findings printed.
  int End(Status ok) {
    PrintFindings();
    if (!folders_.Error().empty()) {
      Say(folders_.Error());
      return kUsage;
    }
    if (ok.Ok()) return kDone;
    // Findings about options have no place in a file: they are wrong usage when nothing else was wrong.
    for (const diag::Diagnostic& finding : context.findings.All()) {
      if (finding.severity == diag::Severity::kError && !IsUsage(finding.code)) return kFindings;
    }
    return context.findings.HasErrors() ? kUsage : kFindings;
  }

  [[nodiscard]] const std::vector<Input>& Inputs() const { return inputs_; }
  /// For the one who reads them: the bytes are not kept twice.
  [[nodiscard]] std::vector<Input> TakeInputs() { return std::move(inputs_); }
  [[nodiscard]] const dialects::Config& Config() const { return config_; }
  [[nodiscard]] const std::string& FolderError() const { return folders_.Error(); }

  Context context;

 private:
  const Common& common_;
  ProgramFolders folders_;
  std::vector<Input> inputs_;
  dialects::Config config_;
};

int CannotPrint(const OutputSink& out) {
  Say(fmt::format("cannot write standard output: {}", std::strerror(out.Error())));
  return kUsage;
}

/// Writes the repaired texts over their files. False: a message was printed.
bool WriteFixed(Context& context) {
  for (const FixedFile& fixed : Fix(context)) {
    std::string error;
    // Bytes that were decoded or left out could not be written back as they were.
    if (fixed.name == "(stdin)" || ReadBytes(fixed.name, error) != fixed.before) {
      Say(fmt::format("{} is not changed: it is no file of plain text", fixed.name));
      return false;
    }
    OutputFile file(fixed.name);
    if (!file.Open().Ok() || !file.Text().Write(fixed.after).Ok() || !file.Commit().Ok()) {
      Say(file.Error());
      return false;
    }
    Say(fmt::format("{}: {} {} repaired", fixed.name, fixed.fixes, fixed.fixes == 1 ? "finding" : "findings"));
  }
  return true;
}

}  // namespace

int Print(std::string_view text) {
  OutputSink out(STDOUT_FILENO);
  return out.Write(text).Ok() ? kDone : CannotPrint(out);
}

int RunTrace(const TraceArguments& arguments) {
  Session session(arguments);
  if (!session.Read()) return kUsage;
  TraceOptions options;
  session.Fill(options, arguments);
  options.format = arguments.format == "json" ? TraceFormat::kJson : TraceFormat::kText;
  options.variables = arguments.variables;
  OutputSink out(STDOUT_FILENO);
  const Status ok = Trace(session.context, session.TakeInputs(), options, out);
  const int code = session.End(ok);
  return out.Error() != 0 ? CannotPrint(out) : code;
}

int RunFlatten(const FlattenArguments& arguments) {
  Session session(arguments);
  if (!session.Read()) return kUsage;
  const std::optional<ReportForm> report_form =
      arguments.report.empty() ? ReportForm::kHtml : ReportFormOf(arguments.report);
  if (!report_form) {
    Say(fmt::format("the form of the report follows from its ending, .html or .json; {} has another",
                    arguments.report));
    return kUsage;
  }
  std::vector<std::unique_ptr<OutputFile>> files;
  files.push_back(std::make_unique<OutputFile>(arguments.output));
  const auto add = [&](const std::string& path) -> OutputFile* {
    return path.empty() ? nullptr : files.emplace_back(std::make_unique<OutputFile>(path)).get();
  };
  OutputFile* const map = add(arguments.source_map);
  OutputFile* const report = add(arguments.report);
  for (const auto& file : files) {
    if (file->Open().Ok()) continue;
    Say(file->Error());
    return kUsage;
  }
  FlattenOptions options;
  session.Fill(options, arguments);
  options.to = arguments.to;
  options.side_by_side = arguments.side_by_side;
  options.max_bytes = arguments.max_output;
  if (map != nullptr) options.source_map = &map->Text();
  if (report != nullptr) options.report = &report->Text();
  options.report_form = *report_form;
  if (arguments.output != "-") options.output_name = arguments.output;
  const Status ok = Flatten(session.context, session.TakeInputs(), options, files[0]->Text());
  const int code = session.End(ok);
  std::string error;
  // A failed write explains a failure without findings, and is wrong use of the disk, not an error of the program.
  const bool writing_failed =
      std::any_of(files.begin(), files.end(), [](const auto& file) { return file->Text().Error() != 0; });
  if (code != kDone && !writing_failed) return code;
  if (CommitAll(files, error).Ok()) return code;
  Say(error);
  return kUsage;
}

int RunCheck(const CheckArguments& arguments) {
  Session session(arguments);
  if (!session.Read()) return kUsage;
  CheckOptions options;
  session.Fill(options);
  options.select = arguments.select.empty() ? session.Config().select : arguments.select;
  options.ignore = arguments.ignore.empty() ? session.Config().ignore : arguments.ignore;
  options.target = arguments.target;
  Input baseline{arguments.baseline, {}};
  if (!arguments.baseline.empty()) {
    std::string error;
    std::optional<std::string> bytes = ReadBytes(arguments.baseline, error);
    if (!bytes) {
      Say(error);
      return kUsage;
    }
    baseline.bytes = *std::move(bytes);
    options.baseline = &baseline;
  }
  std::string new_baseline;
  if (!arguments.new_baseline.empty()) options.new_baseline = &new_baseline;
  (void)Check(session.context, session.TakeInputs(), options);

  // Wrong usage is no finding of the programs.
  Context& context = session.context;
  for (const diag::Diagnostic& finding : context.findings.All()) {
    if (IsUsage(finding.code)) return session.End(Failure{});
  }
  if (!session.FolderError().empty()) return session.End(Failure{});
  if (arguments.fix && !WriteFixed(context)) return kUsage;
  if (!arguments.new_baseline.empty()) {
    OutputFile file(arguments.new_baseline);
    if (!file.Open().Ok() || !file.Text().Write(new_baseline).Ok() || !file.Commit().Ok()) {
      Say(file.Error());
      return kUsage;
    }
  }

  dialects::FailOn fail_on = session.Config().fail_on.value_or(dialects::FailOn::kError);
  if (arguments.fail_on == "error") fail_on = dialects::FailOn::kError;
  if (arguments.fail_on == "warning") fail_on = dialects::FailOn::kWarning;
  if (arguments.fail_on == "never") fail_on = dialects::FailOn::kNever;
  const bool errors = context.findings.HasErrors();
  const bool warnings = context.findings.WarningCount() != 0;

  if (arguments.quiet) {
    context.findings.Remove([](const diag::Diagnostic& finding) { return finding.severity != diag::Severity::kError; });
  }
  context.findings.SortByPlace();
  std::string report;
  if (arguments.format == "json") {
    report = diag::RenderJson(context.findings, context.files);
  } else if (arguments.format == "sarif") {
    report = diag::RenderSarif(context.findings, context.files, Version());
  } else if (arguments.format == "github") {
    report = diag::RenderGithub(context.findings, context.files);
  } else {
    report = diag::RenderText(context.findings, context.files);
  }
  const int written = Print(report);
  if (written != kDone) return written;
  const bool failed =
      fail_on == dialects::FailOn::kError ? errors : fail_on == dialects::FailOn::kWarning && (errors || warnings);
  return failed ? kFindings : kDone;
}

int RunDump(const DumpArguments& arguments) {
  Session session(arguments);
  if (!session.Read()) return kUsage;
  DumpOptions options;
  session.Fill(options);
  options.stage = arguments.stage == "tokens" ? DumpStage::kTokens
                  : arguments.stage == "cfg"  ? DumpStage::kCfg
                                              : DumpStage::kIr;
  OutputSink out(STDOUT_FILENO);
  const Status ok = Dump(session.context, session.TakeInputs(), options, out);
  const int code = session.End(ok);
  return out.Error() != 0 ? CannotPrint(out) : code;
}

int RunTranslate(const TranslateArguments& arguments) {
  Session session(arguments);
  if (!session.Read()) return kUsage;
  TranslateOptions options;
  session.Fill(options, arguments);
  options.to = arguments.to;
  options.verify = arguments.verify;
  options.runs = arguments.runs;
  options.seed = arguments.seed;
  options.stop_at_unsupported = arguments.unsupported == "stop";
  options.keep_increments = arguments.increments == "keep";
  std::vector<std::unique_ptr<OutputFile>> files;
  if (!arguments.source_map.empty()) {
    OutputFile& map = *files.emplace_back(std::make_unique<OutputFile>(arguments.source_map));
    if (!map.Open().Ok()) {
      Say(map.Error());
      return kUsage;
    }
    options.source_map = &map.Text();
  }
  if (!arguments.report.empty()) {
    const std::optional<ReportForm> form = ReportFormOf(arguments.report);
    if (!form) {
      Say(fmt::format("the form of the report follows from its ending, .html or .json; {} has another",
                      arguments.report));
      return kUsage;
    }
    OutputFile& report = *files.emplace_back(std::make_unique<OutputFile>(arguments.report));
    if (!report.Open().Ok()) {
      Say(report.Error());
      return kUsage;
    }
    options.report = &report.Text();
    options.report_form = *form;
  }
  TranslateResult result;
  const Status ok = Translate(session.context, session.TakeInputs(), options, result);
  const int code = session.End(ok);
  if (!result.summary.empty() && !arguments.quiet) fmt::print(stderr, "{}", result.summary);
  if (result.files.empty() || code == kUsage) return code == kDone ? kFindings : code;
  const bool folder = IsFolder(arguments.output) || MakeFolder(arguments.output);
  const bool named = result.files.size() > 1 || !result.files.front().name.empty();
  if (named && !folder) {
    Say("on this machine the file name is the program: -o must name a folder");
    return kUsage;
  }
  for (const TranslatedFile& made : result.files) {
    std::string path = arguments.output;
    if (folder) path += "/" + (made.name.empty() ? std::string("output.nc") : made.name);
    OutputFile& file = *files.emplace_back(std::make_unique<OutputFile>(path));
    if (!file.Open().Ok() || !file.Text().Write(made.text).Ok()) {
      Say(file.Error().empty() ? path + " could not be written" : file.Error());
      return kUsage;
    }
  }
  std::string error;
  if (CommitAll(files, error).Ok()) return code;
  Say(error);
  return kUsage;
}

int RunDiff(const DiffArguments& arguments) {
  Session session(arguments);
  if (!session.Read()) return kUsage;
  if (session.Inputs().size() != 2) {
    Say("diff compares two files");
    return kUsage;
  }
  DiffOptions options;
  session.Fill(options, arguments);
  options.from_a = arguments.from_a;
  options.from_b = arguments.from_b;
  options.tolerance = arguments.tolerance;
  options.max_events = arguments.max_events;
  DiffResult result;
  const Status ok = Diff(session.context, session.Inputs()[0], session.Inputs()[1], options, result);
  const int code = session.End(ok);
  if (!result.summary.empty() && !arguments.quiet) fmt::print(stderr, "{}", result.summary);
  return code;
}

int RunExplain(const std::string& code) {
  const std::string_view page = Explain(code);
  if (!page.empty()) return Print(page);
  Say(fmt::format("there is no diagnostic {}; `ncport list rules` shows all", code));
  return kUsage;
}

}  // namespace ncport::app
