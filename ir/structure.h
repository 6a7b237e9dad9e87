// Structure marks (IF .. ENDIF, loops) are blocks with one word; Block::link joins them so that control needs no stack:
//
//   If      -> its Else, or its EndIf            taken when the condition is false: the block behind the link runs next
//   Else    -> its EndIf
//   EndIf   -> its If                            (for readers; control falls through)
//   While   -> its EndWhile                      false: the block behind the link
//   EndWhile, EndLoop, EndFor -> the opening block: control goes back to it
//   Loop    -> its EndLoop,   For -> its EndFor
//   Repeat  -> its Until,     Until -> its Repeat: false: the block behind Repeat
#pragma once

#include <string_view>

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir {

/// Sets Block::link of all marks of one program; other blocks stay as they are. Linear in the number of blocks.
/// Marks fit together when their kinds and DO numbers (Word::index) agree. An unclosed, unopened or crossed mark is one
/// finding at its place with a note at its partner or at the mark that ended it, and its block is marked kRefused.
/// A mark that the frontend refused keeps its place in the structure: a Verbatim with the mark's WordOp as Word::index.
/// `max_depth`: nesting that the language allows (0 = no limit); the first mark beyond it is a finding.
/// `mark_name`: how findings call a mark, as the language writes it.
void BuildStructure(Module& module, ProgramId program, std::uint32_t max_depth, diag::Sink& sink,
                    std::string_view (*mark_name)(WordOp) = nullptr);

}  // namespace ncport::ir
