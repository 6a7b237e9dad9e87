// Replaces expressions everywhere a program holds them.
#pragma once

#include <functional>

#include "ir/module.h"

namespace ncport::ir::transform {

/// Gets each node after its operands were rewritten; returns what stands there from now on (`id` itself: no change).
using RewriteNode = std::function<ExprId(Module& module, ExprId id)>;

/// Bottom up; nodes whose operands changed are made anew, so that operands stand before their users.
ExprId RewriteExpr(Module& module, ExprId root, const RewriteNode& rewrite);

/// All expressions of the words of one program, of its calls, jumps, loops and lists, and of its variables. Records
/// that two words share are rewritten twice: `rewrite` must leave alone what it made.
void RewriteProgram(Module& module, ProgramId program, const RewriteNode& rewrite);

}  // namespace ncport::ir::transform
