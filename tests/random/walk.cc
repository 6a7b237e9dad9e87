#include "tests/random/walk.h"

#include <algorithm>

#include "ir/word_shape.h"

namespace ncport::tests::random {

namespace {

class Walk {
 public:
  explicit Walk(const ir::Module& module) : module_(module), seen_(module.exprs.Size(), 0) {}

  std::vector<ir::ExprId> Run() {
    for (const ir::Program& program : module_.programs.All()) {
      for (const ir::BlockId block : program.blocks) {
        for (const ir::WordId word : module_.blocks[block].words) AddWord(module_.words[word]);
      }
      for (const ir::VariableId parameter : program.parameters) AddVariable(module_.variables[parameter]);
    }
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  void Add(ir::ExprId id) {
    if (!id.Valid() || seen_[id.value] != 0) return;
    seen_[id.value] = 1;
    found_.push_back(id);
    const ir::Expr& expr = module_.exprs[id];
    switch (ir::OperandsOf(expr.op)) {
      case ir::Operands::kLeaf:
        break;
      case ir::Operands::kUnary:
        Add(ir::ExprId{expr.a});
        break;
      case ir::Operands::kBinary:
        Add(ir::ExprId{expr.a});
        Add(ir::ExprId{expr.b});
        break;
      case ir::Operands::kList:
        for (std::uint32_t i = 0; i < expr.count; ++i) Add(module_.Item(expr.b + i));
        break;
    }
  }
  void AddTarget(const ir::Target& target) { Add(target.expr); }
  void AddJump(ir::JumpId jump) { AddTarget(module_.jumps[jump].target); }
  void AddList(ir::AssignListId id) {
    if (!id.Valid()) return;
    const ir::AssignList& list = module_.assign_lists[id];
    Add(list.place);
    Add(list.count);
    for (const ir::ExprItemId item : list.values) Add(module_.Item(item.value));
  }
  void AddVariable(const ir::Variable& variable) {
    Add(variable.initial);
    Add(variable.lower_limit);
    Add(variable.upper_limit);
    AddList(variable.initial_list);
  }
  void AddWord(const ir::Word& word) {
    Add(word.value);
    if (word.extra == Id<void>::kNone) return;
    switch (ir::ShapeOf(word.op).extra) {
      case ir::ExtraKind::kExpr:
        Add(word.Extra<ir::ExprId>());
        break;
      case ir::ExtraKind::kVariable:
        AddVariable(module_.variables[word.Extra<ir::VariableId>()]);
        break;
      case ir::ExtraKind::kAssignList:
        AddList(word.Extra<ir::AssignListId>());
        break;
      case ir::ExtraKind::kJump:
        AddJump(word.Extra<ir::JumpId>());
        break;
      case ir::ExtraKind::kSwitch: {
        const ir::Switch& record = module_.switches[word.Extra<ir::SwitchId>()];
        for (std::uint32_t i = 0; i < record.arm_count; ++i) {
          Add(module_.switch_arms[record.first_arm + i].value);
          AddJump(module_.switch_arms[record.first_arm + i].jump);
        }
        break;
      }
      case ir::ExtraKind::kCall: {
        const ir::Call& call = module_.calls[word.Extra<ir::CallId>()];
        Add(call.name_expr);
        Add(call.passes);
        for (const ir::ArgId arg : call.args) Add(module_.args[arg].value);
        AddTarget(call.from);
        AddTarget(call.to);
        break;
      }
      case ir::ExtraKind::kPart:
        AddTarget(module_.parts[word.Extra<ir::PartId>()].first);
        AddTarget(module_.parts[word.Extra<ir::PartId>()].last);
        break;
      case ir::ExtraKind::kFor: {
        const ir::For& loop = module_.fors[word.Extra<ir::ForId>()];
        for (const ir::ExprId expr : {loop.variable, loop.end, loop.step}) Add(expr);
        break;
      }
      default:
        break;
    }
  }

  const ir::Module& module_;
  std::vector<std::uint8_t> seen_;
  std::vector<ir::ExprId> found_;
};

}  // namespace

std::vector<ir::ExprId> ReachableExprs(const ir::Module& module) { return Walk(module).Run(); }

}  // namespace ncport::tests::random
