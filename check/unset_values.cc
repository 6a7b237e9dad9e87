// Variables that hold nothing but the zero of their type where they are read: no way there sets them.
#include <cstdint>
#include <vector>

#include "check/places.h"
#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::VariableId;

class UnsetValues {
 public:
  UnsetValues(const Subject& subject, ir::ProgramId program, diag::Sink& sink)
      : module_(subject.module), graph_(subject.graphs.Of(program)), program_(program), sink_(sink) {}

  void Run(bool program_variables_visible) {
    const auto blocks = graph_.Blocks();
    if (graph_.Opaque() || blocks.Empty()) return;
    for (const VariableId id : module_.variables.Ids()) {
      const ir::Variable& variable = module_.variables[id];
      const bool own =
          variable.scope == ir::Scope::kLocal || (variable.scope == ir::Scope::kProgram && !program_variables_visible);
      // A bool that is never set is a switch for tests, and texts start empty.
      const bool number = variable.type == ir::Type::kReal || variable.type == ir::Type::kInt;
      if (!own || !number || variable.owner != program_ || variable.dimension_count != 0) continue;
      if (variable.initial.Valid() || variable.initial_list.Valid()) continue;
      looked_ += blocks.count;
      if (looked_ > kMostLooked) return;
      Look(id);
    }
  }

 private:
  static constexpr std::uint64_t kMostLooked = 20'000'000;  // blocks, all variables of the program together

  void Look(VariableId id) {
    Expr place;
    place.op = ExprOp::kVariable;
    place.a = id.value;
    const auto blocks = graph_.Blocks();
    std::vector<std::uint8_t> may_be_set(blocks.count, 0);  // on arrival
    std::vector<BlockId> open;
    bool set_somewhere = false;
    const auto reach = [&](BlockId to) {
      if (!to.Valid() || may_be_set[to.value - blocks.begin] != 0) return;
      may_be_set[to.value - blocks.begin] = 1;
      open.push_back(to);
    };
    const auto follow = [&](BlockId from) {
      for (const ir::analysis::Edge& edge : graph_.Successors(from)) {
        reach(edge.to);
        if (edge.kind != ir::analysis::EdgeKind::kComputed) continue;
        for (const BlockId target : graph_.ComputedTargets()) reach(target);
      }
    };
    for (const BlockId block : blocks) {
      if (!Sets(module_.blocks[block], place)) continue;
      set_somewhere = true;
      follow(block);
    }
    while (!open.empty()) {
      const BlockId block = open.back();
      open.pop_back();
      follow(block);
    }
    for (const BlockId block : blocks) {
      if (may_be_set[block.value - blocks.begin] != 0 || !graph_.Reachable(block)) continue;
      if (Report(module_.blocks[block], place, set_somewhere)) return;
    }
  }

  [[nodiscard]] bool Sets(const ir::Block& block, const Expr& place) const {
    if ((block.flags & ir::Block::kRefused) != 0) return true;
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      if (SetsPlace(module_, word, place) || MayTouchPlace(module_, word, place)) return true;
    }
    return false;
  }

  bool Report(const ir::Block& block, const Expr& place, bool set_somewhere) {
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      if (MayTouchPlace(module_, word, place)) return false;
      if (const ExprId read = ReadOfPlace(module_, word, place); read.Valid()) {
        sink_.Report(diag::Code::kUnsetValue, module_.RangeOf(block, read), NameOfPlace(module_, place)).help =
            set_somewhere ? "it is 0 here: set it before, or write the 0 where it is declared"
                          : "nothing ever sets it: it is always 0";
        return true;
      }
      if (SetsPlace(module_, word, place)) return false;
    }
    return false;
  }

  const ir::Module& module_;
  const ir::analysis::Cfg& graph_;
  ir::ProgramId program_;
  diag::Sink& sink_;
  std::uint64_t looked_ = 0;
};

}  // namespace

void CheckUnsetValues(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  UnsetValues(subject, program, sink).Run(subject.machine.program_variables_visible);
}

}  // namespace ncport::check
