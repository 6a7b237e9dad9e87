#include "ir/dump.h"

#include <utility>

#include "app/ncport.h"
#include "app/pipeline.h"
#include "ir/analysis/cfg.h"

namespace ncport {

Status Dump(Context& context, std::vector<Input> inputs, const DumpOptions& options, OutputSink& output) {
  app::ProgramSet set;
  // A program with errors can be looked at too: its refused blocks are marked.
  const Status read = app::ReadSet(context, std::move(inputs), options, app::ProfileNeed::kGuess, set);
  if (set.module.programs.Empty()) return read;
  TextBuffer text;
  if (options.stage == DumpStage::kCfg) {
    ir::analysis::DumpCfg(set.module, text);
  } else {
    ir::Dump(set.module, text);
  }
  return read & output.Flush(text);
}

}  // namespace ncport
