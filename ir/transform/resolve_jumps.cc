#include "ir/transform/resolve_jumps.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "ir/analysis/labels.h"
#include "ir/builder.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

class Pass {
 public:
  Pass(Module& module, ProgramId program, std::string_view prefix, diag::Sink& sink)
      : module_(module), program_(program), prefix_(prefix), sink_(sink), make_(module), labels_(module, program) {}

  bool Run() {
    for (const BlockId id : module_.programs[program_].blocks) {
      const Block& block = module_.blocks[id];
      if (block.number != Block::kNoNumber) doubled_ = !numbers_.insert(block.number).second || doubled_;
      if (block.label.Valid()) names_.emplace(module_.View(block.label));
    }
    for (const BlockId id : module_.programs[program_].blocks) {
      for (const WordId word_id : module_.blocks[id].words) {
        const Word word = module_.words[word_id];
        if (word.op == WordOp::kJump) Resolve(id, word, word.Extra<JumpId>());
        if (word.op != WordOp::kSwitch) continue;
        const Switch arms = module_.switches[word.Extra<SwitchId>()];
        for (std::uint32_t i = 0; i < arms.arm_count; ++i)
          Resolve(id, word, module_.switch_arms[arms.first_arm + i].jump);
      }
    }
    FreeMarks();
    return ok_;
  }

 private:
  void Resolve(BlockId from, const Word& word, JumpId id) {
    Jump jump = module_.jumps[id];
    if (jump.search != Search::kForwardThenFromStart) return;
    if (jump.target.kind == TargetKind::kExpression && !AsNumber(jump.target)) {
      computed_ = true;
      if (doubled_) {
        ok_ = false;
        sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[from], word),
                     "a computed jump in a program with doubled block numbers", "a language that searches otherwise");
        return;
      }
      ExprBuilder& make = make_;
      jump.target.expr =
          make.Binary(ExprOp::kConcat, make.Text("N"), make.Function(Function::kRound, {jump.target.expr}));
      jump.search = Search::kForwardThenBackward;
      module_.jumps[id] = jump;
      return;
    }
    const BlockId target = labels_.Find(jump.target, from, jump.search);
    if (!target.Valid()) {
      jump.search = Search::kForwardThenBackward;  // stays the alarm that it is, when it is reached
    } else {
      jump.search = target > from ? Search::kForward : Search::kBackward;
      if (labels_.Find(jump.target, from, jump.search) != target) {
        jump.target.label = LabelOf(target);
        jump.target.kind = TargetKind::kLabel;
      } else {
        targets_.insert(target.value);
      }
    }
    module_.jumps[id] = jump;
  }

  bool AsNumber(Target& target) const {
    ExprId id = target.expr;
    while (module_.exprs[id].op == ExprOp::kGroup) id = ExprId{std::size_t{module_.exprs[id].a}};
    const Expr& expr = module_.exprs[id];
    if (expr.op != ExprOp::kLiteral || !(expr.number >= 0.5 && expr.number < 1e9)) return false;
    target.kind = TargetKind::kNumber;
    target.number = static_cast<std::uint32_t>(expr.number + 0.5);
    return true;
  }

  StringId LabelOf(BlockId target) {
    auto [place, added] = made_.try_emplace(target.value);
    if (!added) return place->second;
    std::string name;
    do name = fmt::format("{}N{}_{}", prefix_, module_.blocks[target].number, ++next_);
    while (!names_.insert(name).second);
    return place->second = module_.strings.Intern(name);
  }

  /// Labels, and numbers that jumps look for, do not stand on structure marks.
  void FreeMarks() {
    ProgramEditor editor(module_, program_, "jump_targets");
    for (const BlockId id : module_.programs[program_].blocks) {
      Block& block = module_.blocks[id];
      const auto made = made_.find(id.value);
      const StringId label = made == made_.end() ? StringId{} : made->second;
      const bool mark = !block.words.Empty() && IsStructureMark(module_.words[block.words[0]].op);
      const bool free_number = mark && block.number != Block::kNoNumber && (computed_ || targets_.contains(id.value));
      if (label.Valid() && !mark && !block.label.Valid()) {
        block.label = label;
        continue;
      }
      if (label.Valid() && (!free_number || block.label.Valid())) {  // a block has one label
        Block place = editor.MakeBlock(id);
        place.skip_level = block.skip_level;
        place.label = label;
        editor.InsertBefore(id, place);
      }
      if (free_number) {
        Block head = editor.MakeBlock(id);
        editor.TakeHead(head, id);
        if (!head.label.Valid()) head.label = label;
        editor.InsertBefore(id, head);
      }
    }
    editor.Apply();
  }

  Module& module_;
  ProgramId program_;
  std::string_view prefix_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::LabelTable labels_;
  std::set<std::uint32_t> numbers_, targets_;
  std::set<std::string, std::less<>> names_;
  std::map<std::uint32_t, StringId> made_;
  int next_ = 0;
  bool doubled_ = false, computed_ = false, ok_ = true;
};

}  // namespace

bool ResolveJumps(Module& module, ProgramId program, std::string_view label_prefix, diag::Sink& sink) {
  return Pass(module, program, label_prefix, sink).Run();
}

}  // namespace ncport::ir::transform
