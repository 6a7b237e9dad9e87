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

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir {

/// Sets Block::link of all marks of one program. An unclosed, unopened or crossed mark is a finding at its place with a
/// note at the opener, and its block is marked kRefused. `max_depth`: nesting that the language allows (0 = no limit).
void BuildStructure(Module& module, ProgramId program, std::uint32_t max_depth, diag::Sink& sink);

}  // namespace ncport::ir
