#include "backends/fanuc/refuse_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "dialects/fanuc/words.h"
#include "ir/transform/word_exprs.h"

namespace ncport::backends::fanuc {

namespace {

using ir::ExprId;
using ir::Module;

void VisitFunctions(const Module& module, ExprId id, const std::function<void(ir::Function)>& visit) {
  if (!id.Valid()) return;
  const ir::Expr& expr = module.exprs[id];
  if (expr.op == ir::ExprOp::kFunction) visit(static_cast<ir::Function>(expr.a));
  switch (ir::OperandsOf(expr.op)) {
    case ir::Operands::kLeaf:
      return;
    case ir::Operands::kUnary:
      return VisitFunctions(module, ExprId{expr.a}, visit);
    case ir::Operands::kBinary:
      VisitFunctions(module, ExprId{expr.a}, visit);
      return VisitFunctions(module, ExprId{expr.b}, visit);
    case ir::Operands::kList:
      for (std::uint32_t i = 0; i < expr.count; ++i) VisitFunctions(module, module.Item(expr.b + i), visit);
      return;
  }
}

}  // namespace

bool RefuseFunctions(const RaiseInput& input, const Module& module, diag::Sink& sink) {
  const std::vector<std::string> missing = input.profile->fanuc.missing_functions.Or({});
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module.words[word_id];
        std::set<ir::Function> named;  // each once for a word
        ir::transform::VisitWordExprs(module, word, [&](ExprId root, bool) {
          VisitFunctions(module, root, [&](ir::Function function) {
            const dialects::fanuc::FunctionRow* row = dialects::fanuc::FindFunction(function);
            if (row != nullptr && std::ranges::find(missing, row->text) == missing.end()) return;
            ok = false;
            if (!named.insert(function).second) return;
            sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word),
                        row != nullptr ? fmt::format("the function {}", row->text)
                                       : fmt::format("the function {}", ir::NameOf(function)),
                        input.profile->name);
          });
        });
      }
    }
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
