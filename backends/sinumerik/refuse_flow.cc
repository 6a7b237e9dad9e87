#include "backends/sinumerik/refuse_flow.h"

#include <set>
#include <string_view>

#include "ir/analysis/call_graph.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordOp;

/// Only one modal call is in force at a time here, the source stacks them (sinumerik-7.1, fanuc-7.4): they begin and
/// end in turn, in one main program, with no way in or out between. And every block that moves runs the call, so no
/// block may become two: no cycles and reference moves beside.
bool ModalCallsFit(const Module& module) {
  for (const ir::ProgramId program : module.programs.Ids()) {
    bool active = false;
    int depth = 0;
    std::set<std::uint32_t> targets;
    for (const ir::JumpId id : module.jumps.Ids()) {
      const ir::Jump& jump = module.jumps[id];
      if (jump.target.kind == ir::TargetKind::kNumber) targets.insert(jump.target.number);
      if (jump.target.kind == ir::TargetKind::kExpression) return false;
    }
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      if (active && targets.contains(block.number)) return false;
      for (const ir::WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        switch (word.op) {
          case WordOp::kModalCall: {
            const bool begins = word.Extra<ir::CallId>().Valid();
            if ((begins && (active || module.programs[program].kind != ir::ProgramKind::kMain)) ||
                block.skip_level != ir::Block::kNoSkip || (!begins && depth != 0))
              return false;
            active = begins;
            depth = 0;
            break;
          }
          case WordOp::kJump:
          case WordOp::kReturn:
            if (active) return false;
            break;
          case WordOp::kCycle:
            if (word.index != static_cast<std::uint8_t>(ir::Cycle::kNone)) return false;
            break;
          case WordOp::kReference:
            return false;
          case WordOp::kIf:
          case WordOp::kWhile:
          case WordOp::kLoop:
            ++depth;
            break;
          case WordOp::kEndIf:
          case WordOp::kEndWhile:
          case WordOp::kEndLoop:
            if (--depth < 0 && active) return false;
            break;
          default:
            break;
        }
      }
    }
  }
  return true;
}

/// M99 P: RET names the block by its text, and how it is looked for is not written anywhere: it must stand once in
/// every caller.
bool ReturnsToOneBlock(const Module& module, const ir::analysis::CallGraph& calls, ir::ProgramId program,
                       const Word& word) {
  const ir::Expr& target = module.exprs[word.value];
  if (target.op != ExprOp::kLiteral) return false;
  for (const auto& site : calls.AllSites()) {
    if (site.callee != program) continue;
    if (site.modal) return false;
    int found = 0;
    for (const ir::BlockId id : module.programs[site.caller].blocks) {
      const ir::Block& block = module.blocks[id];
      if (block.number != target.number) continue;
      ++found;
      if (block.skip_level != ir::Block::kNoSkip) return false;
      for (const ir::WordId each : block.words) {
        if (ir::IsStructureMark(module.words[each].op)) return false;
      }
    }
    if (found != 1) return false;
  }
  return true;
}

}  // namespace

bool RefuseFlow(const RaiseInput& input, const Module& module, diag::Sink& sink) {
  const ir::analysis::CallGraph calls(module);
  std::set<std::uint32_t> called;
  for (const auto& site : calls.AllSites()) {
    if (site.callee.Valid()) called.insert(site.callee.value);
  }
  bool ok = true;
  const bool modal_calls_fit = ModalCallsFit(module);
  for (const ir::ProgramId program : module.programs.Ids()) {
    const bool main = module.programs[program].kind == ir::ProgramKind::kMain;
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const auto refuse = [&](const Word& word, std::string_view what, std::string_view help = {}) {
        ok = false;
        sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), what, input.profile->name).help = help;
      };
      if ((block.flags & ir::Block::kRefused) != 0) {
        ok = false;  // has its finding already
        continue;
      }
      for (const ir::WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        switch (word.op) {
          case WordOp::kProgramEnd:
            // A called M30 returns like M17 there (sinumerik-1.2).
            if ((!main || called.contains(program.value)) && !input.source_machine->end_in_called_program_returns)
              refuse(word, "the end of all programs inside a called one");
            break;
          case WordOp::kReturn:
            if (main && (input.source_machine->return_in_main_restarts || word.value.Valid()))
              refuse(word, "a return that starts the main program again",
                     "a macro alone is taken for the main program: give the program that calls it in front of it");
            if (!main && word.value.Valid() && !ReturnsToOneBlock(module, calls, program, word))
              refuse(word, "a return to a block that is not one in the callers");
            break;
          case WordOp::kRestart:
            refuse(word, "a start from the beginning");
            break;
          case WordOp::kSkipRest:
            refuse(word, "a skip mark inside a block");
            break;
          case WordOp::kModalCall: {
            if (!word.Extra<ir::CallId>().Valid()) break;
            const ir::Call& call = module.calls[word.Extra<ir::CallId>()];
            if (!modal_calls_fit || call.form != ir::CallForm::kName || call.passes.Valid()) {
              refuse(word, "a modal macro call in this place");
            } else if (!call.program.Valid()) {
              ok = false;
              sink.Report(diag::Code::kUnknownProgram, module.RangeOf(block, word), module.View(call.name));
            }
            break;
          }
          case WordOp::kCall: {
            const ir::Call& call = module.calls[word.Extra<ir::CallId>()];
            if (call.form != ir::CallForm::kName || call.from_block || call.name_expr.Valid()) {
              refuse(word, "a call of a computed program or of a block range");
            } else if (!call.program.Valid()) {
              ok = false;
              sink.Report(diag::Code::kUnknownProgram, module.RangeOf(block, word), module.View(call.name));
            } else if (module.programs[call.program].kind == ir::ProgramKind::kMain) {
              refuse(word, "a call of the main program");
            } else if (call.new_level && call.passes.Valid() && input.source_machine->passes_keep_locals) {
              refuse(word, "a repeated macro call, whose later passes find the locals of the first,");
            }
            break;
          }
          default:
            break;
        }
      }
    }
  }
  return ok;
}

}  // namespace ncport::backends::sinumerik
