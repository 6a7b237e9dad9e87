#include "backends/fanuc/limit_nesting.h"

#include <vector>

#include "backends/fanuc/print_expr.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Word;
using ir::WordOp;

class Pass {
 public:
  Pass(ir::Module& module, ir::ProgramId program, int levels)
      : module_(module), program_(program), levels_(levels), make_(module), editor_(module, program, "limit_nesting") {}

  void Run() {
    for (const BlockId id : module_.programs[program_].blocks) LowerBlock(id);
    editor_.Apply();
  }

 private:
  void LowerBlock(BlockId id) {
    held_.clear();
    const Block block = module_.blocks[id];
    for (const ir::WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kCall || word.op == WordOp::kModalCall) LowerCall(word.Extra<ir::CallId>(), id);
      if (word.op == WordOp::kAssign)
        module_.words[word_id].extra = Fit(word.Extra<ExprId>(), levels_, id).value;  // the index of the place
      if (!word.value.Valid() || module_.exprs[word.value].type == ir::Type::kString) continue;
      // The condition of WHILE is computed in each pass: StructureToJumps keeps plain ones only.
      if (word.op == WordOp::kWhile || word.op == WordOp::kAlarm) continue;
      const bool in_word = word.op != WordOp::kAssign;
      const ExprId value = Fit(word.value, in_word ? levels_ - 1 : levels_, id);
      module_.words[word_id].value = value;
    }
    if (held_.empty()) return;
    editor_.TakeHead(held_.front(), id);
    for (const Block& made : held_) editor_.InsertBefore(id, made);
  }

  /// Arguments stand in brackets, as the values of words do.
  void LowerCall(ir::CallId call, BlockId id) {
    if (!call.Valid()) return;
    for (const ir::ArgId arg : module_.calls[call].args) {
      if (!module_.args[arg].value.Valid()) continue;
      const ExprId fitted = Fit(module_.args[arg].value, levels_ - 1, id);
      module_.args[arg].value = fitted;
    }
  }

  /// The expression with its deepest parts held in locals until it fits.
  ExprId Fit(ExprId id, int levels, BlockId block) {
    if (BracketDepth(module_, id, false) <= levels) return id;
    Expr expr = module_.exprs[id];
    const auto fit = [&](std::uint32_t child) {
      const ExprId fitted = Fit(ExprId{child}, levels - 1, block);
      return Hold(fitted, levels - 1, block).value;
    };
    switch (ir::OperandsOf(expr.op)) {
      case ir::Operands::kLeaf:
        return id;
      case ir::Operands::kUnary:
        expr.a = fit(expr.a);
        break;
      case ir::Operands::kBinary:
        expr.a = fit(expr.a);
        expr.b = fit(expr.b);
        break;
      case ir::Operands::kList: {
        std::vector<ExprId> items;
        for (std::uint32_t i = 0; i < expr.count; ++i) items.push_back(ExprId{fit(module_.Item(expr.b + i).value)});
        expr.b = static_cast<std::uint32_t>(module_.expr_items.size());
        module_.expr_items.insert(module_.expr_items.end(), items.begin(), items.end());
        break;
      }
    }
    return module_.AddExpr(expr);
  }

  /// A local with this value, when it is still too deep to stand here.
  ExprId Hold(ExprId value, int levels, BlockId block) {
    if (BracketDepth(module_, value, false) < levels || levels > 2) return value;
    if (ir::OperandsOf(module_.exprs[value].op) == ir::Operands::kLeaf) return value;
    const ExprId local = make_.Variable(ir::transform::NewLocal(module_, program_, "PART", ir::Type::kReal));
    Word word = ir::MakeAssignment(local, value);
    Block made = editor_.MakeBlock(block);
    made.skip_level = module_.blocks[block].skip_level;  // what it divides by may be zero then
    editor_.SetWords(made, {word});
    held_.push_back(made);
    return local;
  }

  ir::Module& module_;
  ir::ProgramId program_;
  int levels_;
  ir::ExprBuilder make_;
  ir::transform::ProgramEditor editor_;
  std::vector<Block> held_;
};

}  // namespace

void LimitNesting(ir::Module& module, ir::ProgramId program, int levels) { Pass(module, program, levels).Run(); }

}  // namespace ncport::backends::fanuc
