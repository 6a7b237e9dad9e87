// Turns the parse tree of a block into its recipe.
#pragma once

#include "frontend/common/shape_cache.h"

namespace antlr4 {
class ParserRuleContext;
}

namespace ncport::frontend::sinumerik {

/// `block`: context of the rule `block`.
void CompileBlock(antlr4::ParserRuleContext& block, Recipe& recipe);

}  // namespace ncport::frontend::sinumerik
