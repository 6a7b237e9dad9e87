// Structure marks that are misspelled or of another language: `ENDLOP`, `WEND`. What they were meant to be keeps the
// structure together, so that one slip is one finding.
#pragma once

#include <string_view>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "frontend/common/block_sink.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

/// A mark as programs write it.
std::string_view MarkName(ir::WordOp mark);

/// The mark that a misspelled or foreign word was meant to be; kMotion: none.
ir::WordOp MeantMark(std::string_view word);

/// `ENDLOP` alone in a block reads as a call. Where the structure around it has no end of its own, it is the end: its
/// block is refused as that mark, with Code::kUnknownWord. Before ir::BuildStructure.
void TakeMeantEnds(const SourceFiles& files, ir::Module& module, ir::ProgramId program, BlockSink& blocks,
                   diag::Sink& sink);

}  // namespace ncport::frontend::sinumerik
