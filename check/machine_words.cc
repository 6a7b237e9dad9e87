// Words that ask for what the machine does not have: axes, numbered variables, diameters of an axis that is not
// transverse. The evaluator stops at each (exec/motion.cc, exec/eval_cells.cc).
#include <fmt/format.h>

#include <set>
#include <string>

#include "check/rules.h"
#include "check/word_expressions.h"
#include "ir/word_values.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::ValueMode;
using ir::Word;
using ir::WordOp;

constexpr std::string_view kLetters = "XYZABCUVW";

class MachineWords {
 public:
  MachineWords(const Subject& subject, diag::Sink& sink) : subject_(subject), sink_(sink) {
    for (const std::string& axis : subject.profile.axes) axes_ += axes_.empty() ? axis : " " + axis;
  }

  void Look(BlockId id) {
    const ir::Block& block = subject_.module.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) return;
    for (const ir::WordId word_id : block.words) {
      const Word& word = subject_.module.words[word_id];
      if (word.op == WordOp::kAxis) LookAtAxis(id, word);
      if (word.op == WordOp::kDiameter) LookAtDiameter(id, word);
      const auto look = [&](ExprId expr) { LookAtCells(id, expr); };
      ir::VisitValues(subject_.module, word, look);
      ir::VisitPlaces(subject_.module, word, look);
    }
  }

 private:
  void LookAtAxis(BlockId id, const Word& word) {
    if (word.index >= kLetters.size()) return;  // by a name that the program or the profile gave
    const std::string_view name = kLetters.substr(word.index, 1);
    if ((subject_.machine.axes >> word.index & 1U) == 0) {
      sink_.Report(diag::Code::kNoAxis, subject_.PlaceOf(id, word), name, axes_).help =
          "a machine with more axes has a profile of its own, which names them: axes = [..]";
      return;
    }
    const bool diameter = word.mode == ValueMode::kAbsoluteDiameter || word.mode == ValueMode::kIncrementalDiameter;
    if (diameter && word.index != subject_.machine.transverse_axis)
      sink_.Report(diag::Code::kNoTransverseAxis, subject_.PlaceOf(id, word), fmt::format("a diameter of {}", name));
  }

  void LookAtDiameter(BlockId id, const Word& word) {
    if (word.index == static_cast<std::uint8_t>(ir::Diameter::kRadius) ||
        subject_.machine.transverse_axis < kLetters.size())
      return;
    sink_.Report(diag::Code::kNoTransverseAxis, subject_.PlaceOf(id, word), "a mode for diameters");
  }

  /// Numbers that stand in the text; each once, since builders set how many there are.
  void LookAtCells(BlockId id, ExprId expr_id) {
    const ir::Module& module = subject_.module;
    const ir::Expr& expr = module.exprs[expr_id];
    ForOperands(module, expr, [&](ExprId operand) { LookAtCells(id, operand); });
    if (expr.op != ExprOp::kCell) return;
    const ir::Space& space = module.spaces[ir::SpaceId{std::size_t{expr.a}}];
    if (expr.b >= space.first && expr.b <= space.last) return;
    if (!told_.emplace(expr.a, expr.b).second) return;
    const std::string_view name = module.View(space.name);
    sink_
        .ReportAs(diag::Severity::kWarning, diag::Code::kOutOfRange, module.RangeOf(module.blocks[id], expr_id),
                  fmt::format("{}{}", name, expr.b), fmt::format("{0}{1} to {0}{2}", name, space.first, space.last))
        .help = "where the machine has more of them, its profile says how many: [[variables]] range";
  }

  const Subject& subject_;
  diag::Sink& sink_;
  std::string axes_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> told_;
};

}  // namespace

void CheckMachineWords(const Subject& subject, diag::Sink& sink) {
  MachineWords words(subject, sink);
  for (const ir::ProgramId program : subject.module.programs.Ids()) {
    if (subject.module.programs[program].library) continue;
    for (const BlockId block : subject.module.programs[program].blocks) words.Look(block);
  }
}

}  // namespace ncport::check
