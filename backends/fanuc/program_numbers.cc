#include "backends/fanuc/program_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/letter_case.h"

namespace ncport::backends::fanuc {

using ir::Module;
using ir::transform::SplitProgram;
using ir::transform::SplitResult;

bool NumberPrograms(const RaiseInput& input, const SplitResult& split, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  std::set<std::string> taken;
  std::vector<std::string> names(module.programs.Size());
  const auto source_name = [&](ir::ProgramId program) {
    return std::string(module.View(module.programs[program].name));
  };
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (!names[program.value].empty()) continue;
    std::vector<ir::ProgramId> parts{program};
    for (const SplitProgram& whole : split.programs) {
      if (whole.whole == program) parts = whole.parts;
    }
    const dialects::ProgramMapping* mapping =
        input.config == nullptr ? nullptr : input.config->FindProgram(source_name(program));
    if (mapping == nullptr) continue;
    if (mapping->targets.size() < parts.size()) {
      sink.Report(diag::Code::kNotExpressible, mapping->at,
                  fmt::format("{} under one number: it is split at its tool changes", source_name(program)),
                  profile.name)
          .help = fmt::format("give {} numbers: {} = [4001, 4002]", parts.size(), source_name(program));
      ok = false;
      continue;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      names[parts[i].value] = mapping->targets[i];
      if (!taken.insert(mapping->targets[i]).second) {
        sink.Report(diag::Code::kDoubleName, mapping->at, mapping->targets[i]);
        ok = false;
      }
    }
  }
  std::uint32_t next_main = 1001;
  std::uint32_t next_sub = profile.names.macro_numbers.Known() ? profile.names.macro_numbers->first + 1 : 4001;
  for (const ir::ProgramId program : module.programs.Ids()) {
    std::string& name = names[program.value];
    if (!name.empty()) continue;
    const std::string source = source_name(program);
    const char letter = Upper(source.empty() ? ' ' : source[0]);
    const std::size_t digits = source.size() > 1 && (letter == 'L' || letter == 'O') ? 1 : 0;
    const bool numbered =
        source.find_first_not_of("0123456789", digits) == std::string::npos && source.size() - digits <= 4;
    if (numbered && !taken.contains(source.substr(digits)) && std::stoul(source.substr(digits)) != 0) {
      name = std::to_string(std::stoul(source.substr(digits)));
    }
    std::uint32_t& next = module.programs[program].kind == ir::ProgramKind::kMain ? next_main : next_sub;
    while (name.empty()) {
      const std::string wish = std::to_string(next++);
      if (!taken.contains(wish)) name = wish;
    }
    taken.insert(name);
  }
  for (const bool main : {true, false}) {
    for (const ir::ProgramId program : module.programs.Ids()) {
      if ((module.programs[program].kind == ir::ProgramKind::kMain) != main) continue;
      ir::ProgramId whole = program;
      for (const SplitProgram& cut : split.programs) {
        if (std::find(cut.parts.begin(), cut.parts.end(), program) != cut.parts.end()) whole = cut.whole;
      }
      out.programs.push_back({program, source_name(program), names[program.value], main, whole});
    }
  }
  for (const ProgramName& name : out.programs) module.programs[name.program].name = module.strings.Intern(name.target);
  return ok;
}

}  // namespace ncport::backends::fanuc
