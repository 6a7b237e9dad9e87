#include "backends/fanuc/text_values.h"

#include <fmt/format.h>

#include <string>

#include "dialects/fanuc/words.h"
#include "ir/enum_names.h"
#include "ir/word_values.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;

/// Functions without a word here that LowerExpressions makes of others.
bool IsBuilt(ir::Function function) {
  switch (function) {
    case ir::Function::kAsin:
    case ir::Function::kAtan2:
    case ir::Function::kSquare:
    case ir::Function::kRoundUp:
    case ir::Function::kMinimum:
    case ir::Function::kMaximum:
    case ir::Function::kBound:
      return true;
    default:
      return false;
  }
}

/// What of the expression is no number; empty: nothing.
std::string Foreign(const ir::Module& module, ExprId id) {
  const Expr& expr = module.exprs[id];
  if (expr.op == ExprOp::kText || expr.op == ExprOp::kConcat) return "a value that hangs on a text";
  if (expr.op == ExprOp::kFunction) {
    const auto function = static_cast<ir::Function>(expr.a);
    if (dialects::fanuc::FindFunction(function) == nullptr && !IsBuilt(function))
      return fmt::format("the function {}", ir::NameOf(function));
  }
  std::string found;
  switch (ir::OperandsOf(expr.op)) {
    case ir::Operands::kLeaf:
      break;
    case ir::Operands::kUnary:
      return Foreign(module, ExprId{expr.a});
    case ir::Operands::kBinary:
      found = Foreign(module, ExprId{expr.a});
      return found.empty() ? Foreign(module, ExprId{expr.b}) : found;
    case ir::Operands::kList:
      for (std::uint32_t i = 0; i < expr.count && found.empty(); ++i) {
        if (const ExprId item = module.Item(expr.b + i); item.Valid()) found = Foreign(module, item);
      }
      break;
  }
  return found;
}

}  // namespace

bool RefuseTexts(const RaiseInput& input, const ir::Module& module, diag::Sink& sink) {
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module.words[word_id];
        std::string found;
        if (word.op == ir::WordOp::kCall && word.Extra<ir::CallId>().Valid()) {
          const ExprId name = module.calls[word.Extra<ir::CallId>()].name_expr;
          if (name.Valid() && module.exprs[name].op != ExprOp::kText)
            found = "a call of a program whose name is computed";
        }
        // A computed target of a jump has a finding of its own.
        const ExprId target =
            word.op == ir::WordOp::kJump ? module.jumps[word.Extra<ir::JumpId>()].target.expr : ExprId{};
        ir::VisitValues(module, word, [&](ExprId root) {
          if (!found.empty() || !root.Valid() || root == target || module.exprs[root].op == ExprOp::kText) return;
          found = Foreign(module, root);
        });
        if (found.empty()) continue;
        ok = false;
        sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), found, input.profile->name);
      }
    }
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
