#include "backends/fanuc/source_meanings.h"

#include <fmt/format.h>

#include <numbers>

#include "ir/builder.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::backends::fanuc {

bool ShiftSkipLevels(const RaiseInput& input, ir::Module& module, diag::Sink& sink) {
  if (input.source_profile == nullptr) return true;
  const std::int64_t shift = input.profile->skip.Or(1) - input.source_profile->skip.Or(1);
  bool ok = true;
  for (ir::Block& block : module.blocks.All()) {
    if (block.skip_level == ir::Block::kNoSkip) continue;
    const std::int64_t level = block.skip_level + shift;
    if (level < 0 || level > 9) {
      sink.Report(diag::Code::kNotExpressible, module.RangeOf(block), fmt::format("skip level {}", block.skip_level),
                  input.profile->name);
      ok = false;
      continue;
    }
    block.skip_level = static_cast<std::uint8_t>(level);
  }
  return ok;
}

void EndsToReturns(const RaiseInput& input, ir::Module& module) {
  if (!input.source_machine->end_in_called_program_returns) return;
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (module.programs[program].kind == ir::ProgramKind::kMain) continue;
    for (const ir::BlockId block : module.programs[program].blocks) {
      for (const ir::WordId id : module.blocks[block].words) {
        ir::Word& word = module.words[id];
        if (word.op != ir::WordOp::kProgramEnd) continue;
        word.op = ir::WordOp::kReturn;
        word.index = static_cast<std::uint8_t>(ir::ReturnKind::kPlain);
        word.extra = Id<void>::kNone;
        word.spelling = 0;
      }
    }
  }
}

bool RefuseRepeatedCalls(const RaiseInput& input, const ir::Module& module, diag::Sink& sink) {
  const auto writes_arguments = [&](ir::ProgramId program) {
    for (const ir::BlockId block : module.programs[program].blocks) {
      for (const ir::WordId id : module.blocks[block].words) {
        const ir::Word& word = module.words[id];
        if (word.op != ir::WordOp::kAssign) continue;
        const ir::Expr& place = module.exprs[word.Extra<ir::ExprId>()];
        if (place.op != ir::ExprOp::kVariable) continue;
        const ir::VariableId variable{place.a};
        if (module.variables[variable].by_reference) continue;
        for (std::uint32_t i = 0; i < module.programs[program].parameters.count; ++i) {
          if (module.programs[program].parameters[i] == variable) return true;
        }
      }
    }
    return false;
  };
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId block : module.programs[program].blocks) {
      for (const ir::WordId id : module.blocks[block].words) {
        const ir::Word& word = module.words[id];
        if (word.op != ir::WordOp::kCall || !word.Extra<ir::CallId>().Valid()) continue;
        const ir::Call& call = module.calls[word.Extra<ir::CallId>()];
        if (!call.passes.Valid() || !call.program.Valid() || !writes_arguments(call.program)) continue;
        // P1 repeats nothing.
        const ir::Expr& passes = module.exprs[call.passes];
        if (passes.op == ir::ExprOp::kLiteral && passes.number == 1) continue;
        sink.Report(diag::Code::kNotExpressible, module.RangeOf(module.blocks[block], word),
                    "a repeated call of a program that changes its own arguments", input.profile->name)
            .help = "the second pass would find them changed: copy them to variables of the program";
        ok = false;
      }
    }
  }
  return ok;
}

void PiToNumber(ir::Module& module) {
  for (const ir::ProgramId program : module.programs.Ids()) {
    ir::transform::RewriteProgram(module, program, [](ir::Module& rewritten, ir::ExprId id) {
      const ir::Expr& expr = rewritten.exprs[id];
      const bool pi =
          expr.op == ir::ExprOp::kSystem && rewritten.systems[ir::SystemId{expr.a}].kind == ir::SystemKind::kPi;
      return pi ? ir::ExprBuilder(rewritten).Literal(std::numbers::pi) : id;
    });
  }
}

}  // namespace ncport::backends::fanuc
