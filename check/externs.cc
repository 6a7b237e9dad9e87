#include <fmt/format.h>

#include <string>

#include "base/letter_case.h"
#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::WordOp;

/// Reports the first difference between the declaration and the header of the program.
void ReportDifference(const ir::Module& module, const ir::Extern& declared, const ir::Program& program,
                      const SourceRange& at, diag::Sink& sink) {
  const std::string_view name = module.View(program.name);
  const auto point_at_header = [&](diag::Diagnostic& finding) {
    if (program.header_line != 0)
      finding.notes.push_back({{program.file, program.header_line, 0, 0}, "the program begins here"});
    finding.help = "EXTERN repeats types, VAR and dimensions of the program";
  };
  if (declared.param_count != program.parameters.count) {
    point_at_header(sink.Report(diag::Code::kArgumentCount, at, name, program.parameters.count, declared.param_count));
    return;
  }
  for (std::uint32_t i = 0; i < declared.param_count; ++i) {
    const ir::ExternParam& here = module.extern_params[declared.first_param + i];
    const ir::Variable& there = module.variables[program.parameters[i]];
    const bool same = here.type == there.type && here.by_reference == there.by_reference &&
                      here.dimension_count == there.dimension_count;
    if (same) continue;
    const auto text = [](ir::Type type, bool by_reference, std::uint8_t dimensions) {
      const std::string name = UpperOf(ir::NameOf(type));
      return fmt::format("{}{}{}", by_reference ? "VAR " : "", name, dimensions != 0 ? "[]" : "");
    };
    point_at_header(sink.Report(
        diag::Code::kTypeMismatch, at,
        fmt::format("{} for parameter {} of {}", text(here.type, here.by_reference, here.dimension_count), i + 1, name),
        fmt::format("{} {}", text(there.type, there.by_reference, there.dimension_count), module.View(there.name))));
    return;
  }
}

}  // namespace

void CheckExterns(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    for (const ir::BlockId block : module.programs[program].blocks) {
      for (const ir::WordId id : module.blocks[block].words) {
        const ir::Word& word = module.words[id];
        if (word.op != WordOp::kExtern) continue;
        const ir::Extern& record = module.externs[word.Extra<ir::ExternId>()];
        const std::string_view name = module.View(record.name);
        const ir::ProgramId callee = module.FindProgram(name, subject.ignore_case);
        // A PROC that was not understood has its finding.
        if (!callee.Valid() || subject.InRefusedBlock(callee, "PROC")) continue;
        ReportDifference(module, record, module.programs[callee], subject.PlaceOf(block, word), sink);
      }
    }
  }
}

}  // namespace ncport::check
