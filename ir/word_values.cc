#include "ir/word_values.h"

namespace ncport::ir {

namespace {

using Visit = std::function<void(ExprId)>;

void VisitIndices(const Module& module, ExprId place, const Visit& visit) {
  if (!place.Valid()) return;
  const Expr& expr = module.exprs[place];
  if (expr.op == ExprOp::kCellAt) return visit(ExprId{std::size_t{expr.a}});
  if (OperandsOf(expr.op) != Operands::kList) return;
  for (std::uint32_t i = 0; i < expr.count; ++i) visit(module.Item(expr.b + i));
}

void VisitList(const Module& module, AssignListId id, const Visit& visit) {
  if (!id.Valid()) return;
  const AssignList& list = module.assign_lists[id];
  for (const ExprItemId item : list.values) {
    if (module.Item(item.value).Valid()) visit(module.Item(item.value));
  }
  if (list.count.Valid()) visit(list.count);
}

}  // namespace

void VisitValues(const Module& module, const Word& word, const Visit& visit) {
  const auto maybe = [&](ExprId id) {
    if (id.Valid()) visit(id);
  };
  maybe(word.value);
  VisitPlaces(module, word, [&](ExprId place) { VisitIndices(module, place, visit); });
  switch (word.op) {
    case WordOp::kAlarm:
    case WordOp::kMessage:
    case WordOp::kAxisComputed:
      maybe(word.Extra<ExprId>());
      break;
    case WordOp::kAssignList:
      VisitList(module, word.Extra<AssignListId>(), visit);
      break;
    case WordOp::kDefine: {
      const Variable& variable = module.variables[word.Extra<VariableId>()];
      maybe(variable.initial);
      VisitList(module, variable.initial_list, visit);
      break;
    }
    case WordOp::kJump:
      maybe(module.jumps[word.Extra<JumpId>()].target.expr);
      break;
    case WordOp::kSwitch: {
      const Switch& cases = module.switches[word.Extra<SwitchId>()];
      for (std::uint32_t i = 0; i < cases.arm_count; ++i) {
        const SwitchArm& arm = module.switch_arms[cases.first_arm + i];
        maybe(arm.value);
        maybe(module.jumps[arm.jump].target.expr);
      }
      break;
    }
    case WordOp::kCall:
    case WordOp::kModalCall:
    case WordOp::kWorkpiece:
    case WordOp::kDataSetting: {
      if (!word.Extra<CallId>().Valid()) break;
      const Call& call = module.calls[word.Extra<CallId>()];
      maybe(call.name_expr);
      maybe(call.passes);
      maybe(call.from.expr);
      maybe(call.to.expr);
      for (const ArgId arg : call.args) maybe(module.args[arg].value);
      break;
    }
    case WordOp::kRepeatPart: {
      const Part& part = module.parts[word.Extra<PartId>()];
      maybe(part.first.expr);
      maybe(part.last.expr);
      break;
    }
    case WordOp::kFor: {
      const For& loop = module.fors[word.Extra<ForId>()];
      maybe(loop.end);
      maybe(loop.step);
      break;
    }
    default:
      break;
  }
}

void VisitPlaces(const Module& module, const Word& word, const Visit& visit) {
  ExprId place;
  if (word.op == WordOp::kAssign) place = word.Extra<ExprId>();
  if (word.op == WordOp::kAssignList) place = module.assign_lists[word.Extra<AssignListId>()].place;
  if (word.op == WordOp::kFor) place = module.fors[word.Extra<ForId>()].variable;
  if (place.Valid()) visit(place);
}

void VisitReferences(const Module& module, const Word& word, const Visit& visit) {
  if ((word.op != WordOp::kCall && word.op != WordOp::kModalCall) || !word.Extra<CallId>().Valid()) return;
  const Call& call = module.calls[word.Extra<CallId>()];
  for (const ArgId id : call.args) {
    const Arg& arg = module.args[id];
    if (!arg.value.Valid()) continue;
    bool may_write = !call.program.Valid();
    if (call.program.Valid()) {
      const IdRange<VariableId> parameters = module.programs[call.program].parameters;
      may_write = arg.position < parameters.count && module.variables[parameters[arg.position]].by_reference;
    }
    const ExprOp op = module.exprs[arg.value].op;
    if (may_write && (op == ExprOp::kVariable || op == ExprOp::kElement)) visit(arg.value);
  }
}

}  // namespace ncport::ir
