#include "backends/fanuc/modal_calls.h"

#include <algorithm>
#include <string>
#include <vector>

#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::analysis::ModalFlow;

Word Cancel() {
  Word word = ir::MakeWord(WordOp::kModalCall);
  word.flags = Word::kAdded;
  return word;
}

/// Per program: a modal call runs it, or a program that calls it.
std::vector<bool> RunByModalCalls(const ir::Module& module, const ir::analysis::CallGraph& calls) {
  std::vector<bool> run(module.programs.Size(), false);
  for (bool more = true; more;) {
    more = false;
    for (const ir::analysis::CallSite& site : calls.AllSites()) {
      if (!site.callee.Valid() || run[site.callee.value] || (!site.modal && !run[site.caller.value])) continue;
      run[site.callee.value] = true;
      more = true;
    }
  }
  return run;
}

/// A control without G66 (fanuc-13): a modal call has no form there.
bool RefuseModalCalls(const RaiseInput& input, const ir::Module& module, diag::Sink& sink) {
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Block& block = module.blocks[id];
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        if (word.op != WordOp::kModalCall || !word.Extra<ir::CallId>().Valid()) continue;
        ok = false;
        sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), "a modal call (this control has no G66)",
                    input.profile->name)
            .help = "write the call in a block of its own behind each move";
      }
    }
  }
  return ok;
}

}  // namespace

bool MapModalCalls(const RaiseInput& input, ir::Module& module, diag::Sink& sink) {
  const std::vector<std::string> missing = input.profile->fanuc.missing_functions.Or({});
  if (std::ranges::find(missing, "G66") != missing.end() && !RefuseModalCalls(input, module, sink)) return false;
  // The same stack on both sides: nothing differs.
  if (input.source_machine->modal_call_levels > 1) return true;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ModalFlow& flow = analyses.Modal();
  const std::vector<bool> run_by_modal_calls = RunByModalCalls(module, analyses.Calls());
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ir::transform::ProgramEditor editor(module, program, "modal_calls");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      for (const WordId word_id : block.words) {
        const Word word = module.words[word_id];
        if (word.op != WordOp::kModalCall || !flow.Reached(program, id)) continue;
        const bool sets = word.Extra<ir::CallId>().Valid();
        if (run_by_modal_calls[program.value]) {
          ok = false;
          sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word),
                      sets ? "a modal call in a program that a modal call runs"
                           : "the end of a modal call in the program that it runs",
                      input.profile->name)
              .help = "start and end modal calls in the program that moves";
          continue;
        }
        switch (flow.ModalCallBefore(program, id)) {
          case ModalFlow::ModalCall::kUnknown:
            ok = false;
            sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word),
                        sets ? "a modal call that ends another one only on some ways to it"
                             : "the end of a modal call that is active only on some ways to it",
                        input.profile->name)
                .help = "end the modal call by a block of its own on each way";
            break;
          case ModalFlow::ModalCall::kActive:
            if (sets) editor.PutInFront(id, {Cancel()});
            break;
          case ModalFlow::ModalCall::kNone: {
            if (sets) break;
            std::vector<Word> kept;
            for (const WordId other : block.words) {
              if (other != word_id) kept.push_back(module.words[other]);
            }
            editor.SetWords(id, kept);
          }
        }
      }
    }
    editor.Apply();
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
