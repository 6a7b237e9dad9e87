// The command line: the options of all commands in one place, as --help shows them.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/lists.h"
#include "app/ncport.h"
#include "app/output_file.h"
#include "base/near_name.h"

namespace ncport::app {
namespace {

void AddCommon(CLI::App& command, Common& common) {
  command
      .add_option("FILE", common.files,
                  "program files; the first program of the first file is the main program; - = standard input")
      ->required();
  command.add_option("--from", common.from, "profile of the programs: a name or a file (ncport list profiles)");
  command.add_option("-I", common.folders, "folder in which called programs are looked up")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command.add_option("--config", common.config, "configuration file; default: the nearest ncport.toml");
  command.add_flag("--quiet", common.quiet, "no notes and warnings");
}

void AddRunning(CLI::App& command, Running& running) {
  command.add_option("--call", running.call, "run this program with constants as arguments: 'RING(10,,2.5)'");
  command.add_option("--set", running.set, "start value of a variable: NAME=VALUE")->allow_extra_args(false);
  command.add_option("--start", running.start, "position at the start, as the profile programs it: X0Y0Z0");
  command.add_option("--max-blocks", running.max_blocks, "executed blocks after which the run is stopped");
  command.add_option("--max-cells", running.max_cells,
                     "variables that a run may hold, each element of an array counted");
  command.add_option("--max-text-bytes", running.max_text_bytes, "memory that the texts of a run may take");
}

int Main(int argc, char** argv) {
  InstallCleanup();
  CLI::App app{"Compiler for CNC programs: runs, checks and writes them again"};
  app.name("ncport");
  app.set_version_flag("--version", std::string("ncport ") + std::string(Version()));
  app.require_subcommand(1);
  int code = kDone;

  TranslateArguments translate;
  CLI::App* command = app.add_subcommand("translate", "writes programs for another control");
  AddCommon(*command, translate);
  AddRunning(*command, translate);
  command->add_option("--to", translate.to, "profile of the target");
  command->add_flag("--verify", translate.verify,
                    "run both programs over parameter sets and compare what the machine does");
  command->add_option("--runs", translate.runs, "parameter sets to compare");
  command->add_option("--seed", translate.seed, "seed of the parameter sets");
  command
      ->add_option("--unsupported", translate.unsupported,
                   "a block that the target cannot express: error, or stop = an alarm in its place")
      ->check(CLI::IsMember({"error", "stop"}));
  command
      ->add_option("--increments", translate.increments,
                   "increments of the source: exact = positions, which do not drift; keep = increments (U W, G91), "
                   "with a warning where the target rounds them")
      ->check(CLI::IsMember({"exact", "keep"}));
  command
      ->add_option("--source-map", translate.source_map, "file for the places that the blocks come from, as JSON lines")
      ->type_name("FILE");
  command
      ->add_option("--report", translate.report,
                   "sheet that goes to the machine with the programs; .html or .json by its ending")
      ->type_name("FILE");
  command
      ->add_option("-o", translate.output,
                   "file to write, or folder where the name of a file is the name of its program")
      ->type_name("FILE|DIR");
  command->callback([&] { code = RunTranslate(translate); });

  DiffArguments diff;
  command = app.add_subcommand("diff", "compares two programs by what they do");
  AddCommon(*command, diff);
  AddRunning(*command, diff);
  command->add_option("--from-a", diff.from_a, "profile of the first program");
  command->add_option("--from-b", diff.from_b, "profile of the second program");
  command->add_option("--tolerance", diff.tolerance, "allowed difference of positions, mm")->type_name("MM");
  command->add_option("--max-events", diff.max_events, "events of each run that may be compared");
  command->callback([&] { code = RunDiff(diff); });

  FlattenArguments flatten;
  command = app.add_subcommand("flatten", "runs a program and writes every block with literal values");
  AddCommon(*command, flatten);
  AddRunning(*command, flatten);
  command->add_option("--to", flatten.to, "profile of the output: iso-mill, iso-lathe");
  command->add_option("-o", flatten.output, "file to write")->type_name("FILE");
  command
      ->add_option("--source-map", flatten.source_map, "file for the places that the blocks come from, as JSON lines")
      ->type_name("FILE");
  command
      ->add_option("--report", flatten.report,
                   "sheet that goes to the machine with the program; .html or .json by its ending")
      ->type_name("FILE");
  command->add_flag("--side-by-side", flatten.side_by_side, "source blocks beside their flat blocks, for reading");
  command->add_option("--max-output", flatten.max_output, "longest output in bytes");
  command->callback([&] { code = RunFlatten(flatten); });

  CheckArguments check;
  command = app.add_subcommand("check", "looks for mistakes without running");
  AddCommon(*command, check);
  command->add_option("--format", check.format, "form of the report")
      ->check(CLI::IsMember({"text", "json", "sarif", "github"}));
  command->add_option("--fail-on", check.fail_on, "what gives exit code 1")
      ->check(CLI::IsMember({"error", "warning", "never"}));
  command->add_option("--select", check.select, "only these codes, or codes that begin so: NC3001,NC4")
      ->delimiter(',')
      ->type_name("CODES")
      ->allow_extra_args(false);
  command->add_option("--ignore", check.ignore, "not these codes")
      ->delimiter(',')
      ->type_name("CODES")
      ->allow_extra_args(false);
  command->add_option("--for", check.target, "find also what cannot be written for this profile")->type_name("PROFILE");
  command->add_flag("--fix", check.fix, "do the repairs that findings offer, in the files");
  command->add_option("--baseline", check.baseline, "leave out the findings that this file lists")->type_name("FILE");
  command->add_option("--write-baseline", check.new_baseline, "list all findings in this file and leave them out")
      ->type_name("FILE");
  command->callback([&] { code = RunCheck(check); });

  TraceArguments trace;
  command = app.add_subcommand("trace", "runs a program and prints what the machine would do");
  AddCommon(*command, trace);
  AddRunning(*command, trace);
  command->add_flag("--vars", trace.variables, "final values of the variables");
  command->add_option("--format", trace.format, "form of the events")->check(CLI::IsMember({"text", "json"}));
  command->callback([&] { code = RunTrace(trace); });

  DumpArguments dump;
  command = app.add_subcommand("dump", "shows a stage of the compiler as text");
  AddCommon(*command, dump);
  command->add_option("--stage", dump.stage, "which stage")->check(CLI::IsMember({"tokens", "ir", "cfg"}));
  command->callback([&] { code = RunDump(dump); });

  std::string explained;
  command = app.add_subcommand("explain", "one page on a diagnostic");
  command->add_option("CODE", explained, "NC and four digits")->required();
  command->callback([&] { code = RunExplain(explained); });

  std::string list_what;
  std::string list_format = "text";
  command = app.add_subcommand("list", "what ncport knows: profiles, rules, languages");
  command->add_option("WHAT", list_what, "profiles, rules or languages")
      ->required()
      ->check(CLI::IsMember({"profiles", "rules", "languages"}));
  command->add_option("--format", list_format, "form of the list")->check(CLI::IsMember({"text", "json"}));
  command->callback([&] { code = Print(List(list_what, list_format == "json")); });

  std::vector<std::string> commands;
  for (const CLI::App* known : app.get_subcommands({})) commands.push_back(known->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    const std::vector<std::string_view> names(commands.begin(), commands.end());
    const std::string_view near = NearName(argv[1], names);
    Say(fmt::format("there is no command {}; {}", argv[1],
                    near.empty() ? "ncport --help shows all" : fmt::format("did you mean {}?", near)));
    return kUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;  // --help, --version
    app.exit(error, asked ? std::cout : std::cerr, std::cerr);
    return asked ? kDone : kUsage;
  }
  return code;
}

}  // namespace
}  // namespace ncport::app

int main(int argc, char** argv) { return ncport::app::Main(argc, argv); }
