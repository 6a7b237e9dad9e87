#include "ir/transform/rewrite_exprs.h"

#include <vector>

namespace ncport::ir::transform {

ExprId RewriteExpr(Module& module, ExprId root, const RewriteNode& rewrite) {
  if (!root.Valid()) return root;
  Expr expr = module.exprs[root];
  const auto place = module.expr_places.Of(root);
  bool changed = false;
  const auto child = [&](std::uint32_t value) {
    const ExprId made = RewriteExpr(module, ExprId{value}, rewrite);
    changed = changed || made.value != value;
    return made.value;
  };
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      break;
    case Operands::kUnary:
      expr.a = child(expr.a);
      break;
    case Operands::kBinary:
      expr.a = child(expr.a);
      expr.b = child(expr.b);
      break;
    case Operands::kList: {
      std::vector<ExprId> items;
      for (std::uint32_t i = 0; i < expr.count; ++i) items.push_back(ExprId{child(module.Item(expr.b + i).value)});
      if (!changed) break;
      expr.b = static_cast<std::uint32_t>(module.expr_items.size());
      module.expr_items.insert(module.expr_items.end(), items.begin(), items.end());
      break;
    }
  }
  return rewrite(module, changed ? module.AddExpr(expr, place) : root);
}

namespace {

class ProgramRewrite {
 public:
  ProgramRewrite(Module& module, const RewriteNode& rewrite) : module_(module), rewrite_(rewrite) {}

  void Run(ProgramId program) {
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId word : module_.blocks[block].words) RewriteWord(word);
    }
    for (Variable& variable : module_.variables.All()) {
      if (variable.owner != program) continue;
      variable.initial = Made(variable.initial);
      variable.lower_limit = Made(variable.lower_limit);
      variable.upper_limit = Made(variable.upper_limit);
      if (variable.initial_list.Valid()) RewriteList(variable.initial_list);
    }
  }

 private:
  ExprId Made(ExprId id) { return RewriteExpr(module_, id, rewrite_); }

  void RewriteList(AssignListId id) {
    AssignList list = module_.assign_lists[id];
    list.place = Made(list.place);
    list.count = Made(list.count);
    std::vector<ExprId> values;
    for (const ExprItemId item : list.values) values.push_back(Made(module_.Item(item.value)));
    list.values.begin = static_cast<std::uint32_t>(module_.expr_items.size());
    module_.expr_items.insert(module_.expr_items.end(), values.begin(), values.end());
    module_.assign_lists[id] = list;
  }

  void RewriteTarget(Target& target) { target.expr = Made(target.expr); }

  void RewriteJump(JumpId id) {
    Jump jump = module_.jumps[id];
    RewriteTarget(jump.target);
    module_.jumps[id] = jump;
  }

  void RewriteCall(CallId id) {
    Call call = module_.calls[id];
    call.name_expr = Made(call.name_expr);
    call.passes = Made(call.passes);
    RewriteTarget(call.from);
    RewriteTarget(call.to);
    for (const ArgId arg : call.args) {
      const ExprId made = Made(module_.args[arg].value);
      module_.args[arg].value = made;
    }
    module_.calls[id] = call;
  }

  void RewriteWord(WordId id) {
    Word word = module_.words[id];
    word.value = Made(word.value);
    switch (word.op) {
      case WordOp::kAssign:
      case WordOp::kAlarm:
      case WordOp::kAxisComputed:
      case WordOp::kMessage:
        if (word.Extra<ExprId>().Valid()) word.extra = Made(word.Extra<ExprId>()).value;
        break;
      case WordOp::kAssignList:
        RewriteList(word.Extra<AssignListId>());
        break;
      case WordOp::kJump:
        RewriteJump(word.Extra<JumpId>());
        break;
      case WordOp::kSwitch: {
        const Switch cases = module_.switches[word.Extra<SwitchId>()];
        for (std::uint32_t i = 0; i < cases.arm_count; ++i) {
          const SwitchArm arm = module_.switch_arms[cases.first_arm + i];
          const ExprId made = Made(arm.value);
          module_.switch_arms[cases.first_arm + i].value = made;
          RewriteJump(arm.jump);
        }
        break;
      }
      case WordOp::kCall:
      case WordOp::kModalCall:
      case WordOp::kWorkpiece:
      case WordOp::kDataSetting:
        if (word.Extra<CallId>().Valid()) RewriteCall(word.Extra<CallId>());
        break;
      case WordOp::kRepeatPart: {
        Part part = module_.parts[word.Extra<PartId>()];
        RewriteTarget(part.first);
        RewriteTarget(part.last);
        module_.parts[word.Extra<PartId>()] = part;
        break;
      }
      case WordOp::kFor: {
        For loop = module_.fors[word.Extra<ForId>()];
        loop.variable = Made(loop.variable);
        loop.end = Made(loop.end);
        loop.step = Made(loop.step);
        module_.fors[word.Extra<ForId>()] = loop;
        break;
      }
      default:
        break;
    }
    module_.words[id] = word;
  }

  Module& module_;
  const RewriteNode& rewrite_;
};

}  // namespace

void RewriteProgram(Module& module, ProgramId program, const RewriteNode& rewrite) {
  ProgramRewrite(module, rewrite).Run(program);
}

}  // namespace ncport::ir::transform
