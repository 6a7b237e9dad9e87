// Parse trees of Fanuc blocks to recipes. Only parser.cc includes it together with ANTLR.
#pragma once

#include "frontend/common/shape_cache.h"

namespace antlr4 {
class ParserRuleContext;
}

namespace ncport::frontend::fanuc {

/// `block` is a BlockContext of the generated parser.
void CompileBlock(antlr4::ParserRuleContext& block, Recipe& recipe);

}  // namespace ncport::frontend::fanuc
