#include "ir/transform/fit_program.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/plane_axes.h"
#include "ir/structure.h"
#include "ir/transform/constant_values.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

class Fitter {
 public:
  Fitter(Module& module, const Machine& machine, ProgramId program)
      : module_(module), machine_(machine), program_(program), make_(module) {}

  void Run(const analysis::FlowAnalyses& analyses, bool keeps_locals, std::string_view title);

 private:
  [[nodiscard]] SystemConstant SystemAt(const analysis::ModalFlow& flow) const;
  [[nodiscard]] bool Rewrite(BlockId id, const ConstantValues& values, Block& block);
  ExprId Folded(const ConstantValues& values, BlockId block, std::uint32_t word, ExprId root);
  ExprId Simplified(ExprId id);
  void DropUnused();
  [[nodiscard]] bool IsRemovable(ExprId value) const;
  void Title(std::string_view text);

  Module& module_;
  const Machine& machine_;
  ProgramId program_;
  ExprBuilder make_;
};

SystemConstant Fitter::SystemAt(const analysis::ModalFlow& flow) const {
  return [this, &flow](BlockId block, const System& system, double index) -> std::optional<ConstantValue> {
    const ModalState state = flow.At(program_, block);
    switch (system.kind) {
      case SystemKind::kPlaneAxis: {
        if (state.plane == Plane::kUnknown) return std::nullopt;
        const PlaneAxes axes = AxesOf(state.plane);
        const std::uint8_t axis = system.number == 1 ? axes.first : system.number == 2 ? axes.second : axes.normal;
        return ConstantValue{Type::kAxis, static_cast<double>(axis)};
      }
      case SystemKind::kModalCallActive:
        switch (flow.ModalCallBefore(program_, block)) {
          case analysis::ModalFlow::ModalCall::kNone:
            return ConstantValue{Type::kInt, 0};
          case analysis::ModalFlow::ModalCall::kActive:
            return ConstantValue{Type::kInt, 1};
          case analysis::ModalFlow::ModalCall::kUnknown:
            return std::nullopt;
        }
        return std::nullopt;
      case SystemKind::kModalGroup: {
        for (const GroupCode& row : machine_.groups) {
          if (row.group != index) continue;
          if (row.op != WordOp::kUnits) return std::nullopt;
          if (row.index != 0 && row.index == static_cast<std::uint8_t>(state.units))
            return ConstantValue{Type::kInt, row.code};
        }
        return std::nullopt;
      }
      default:
        return std::nullopt;
    }
  };
}

/// The expression with its constant parts as numbers, where digits can say them exactly.
ExprId Fitter::Folded(const ConstantValues& values, BlockId block, std::uint32_t word, ExprId root) {
  if (!root.Valid()) return root;
  const Expr expr = module_.exprs[root];
  if (expr.op == ExprOp::kLiteral || expr.op == ExprOp::kAxisName || expr.op == ExprOp::kText) return root;
  if (const auto value = values.EvaluateAt(block, word, root)) {
    if (value->type == Type::kAxis) return make_.AxisName(static_cast<std::uint8_t>(value->number));
    // Eight digits are what every control of the targets keeps.
    double read = 0;
    const std::string digits = fmt::format("{:.8g}", value->number);
    std::from_chars(digits.data(), digits.data() + digits.size(), read);
    if (read == value->number && digits.find('e') == std::string::npos) {
      const ExprId literal = make_.Literal(std::fabs(value->number), value->type);
      return value->number < 0 ? make_.Unary(ExprOp::kNegate, literal) : literal;
    }
  }
  // Parts of it; the node itself is made anew only if one of them changed.
  Expr made = expr;
  bool changed = false;
  const auto part = [&](std::uint32_t child) {
    const ExprId folded = Folded(values, block, word, ExprId{child});
    changed = changed || folded.value != child;
    return folded.value;
  };
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return root;
    case Operands::kUnary:
      made.a = part(expr.a);
      break;
    case Operands::kBinary: {
      // A side that does not decide alone leaves the other one.
      const auto truth = [&](std::uint32_t child) { return values.EvaluateAt(block, word, ExprId{child}); };
      if (expr.op == ExprOp::kAnd || expr.op == ExprOp::kOr) {
        const double idle = expr.op == ExprOp::kAnd ? 1 : 0;
        if (const auto left = truth(expr.a); left && left->number == idle)
          return Folded(values, block, word, ExprId{expr.b});
        if (const auto right = truth(expr.b); right && right->number == idle)
          return Folded(values, block, word, ExprId{expr.a});
      }
      made.a = part(expr.a);
      made.b = part(expr.b);
      break;
    }
    case Operands::kList: {
      std::vector<ExprId> items;
      for (std::uint32_t i = 0; i < expr.count; ++i) items.push_back(ExprId{part(module_.Item(expr.b + i).value)});
      if (!changed) break;
      made.b = static_cast<std::uint32_t>(module_.expr_items.size());
      module_.expr_items.insert(module_.expr_items.end(), items.begin(), items.end());
      break;
    }
  }
  return changed ? Simplified(module_.AddExpr(made, module_.expr_places.Of(root))) : root;
}

/// Without the steps that a constant made idle: 0+x, x-0, 1*x, x/1; x-(-c) is x+c, x+(-c) is x-c, -1*x is -x. All of
/// them give the same double.
ExprId Fitter::Simplified(ExprId id) {
  const Expr expr = module_.exprs[id];
  if (OperandsOf(expr.op) != Operands::kBinary) return id;
  const ExprId a{expr.a}, b{expr.b};
  const auto left = LiteralValue(module_, a), right = LiteralValue(module_, b);
  // A whole number in a place of a real one counts as real from here on.
  const auto alone = [&](ExprId rest) {
    return module_.exprs[rest].type == expr.type || module_.exprs[rest].type == Type::kReal ? rest : id;
  };
  const auto negated = [&](ExprId rest) { return alone(rest) == rest ? make_.Unary(ExprOp::kNegate, rest) : id; };
  const auto swapped = [&](ExprOp op) {
    Expr made = expr;
    made.op = op;
    made.b = make_.Literal(-*right, module_.exprs[b].type).value;
    return module_.AddExpr(made, module_.expr_places.Of(id));
  };
  switch (expr.op) {
    case ExprOp::kAdd:
      if (left && *left == 0) return alone(b);
      if (right && *right == 0) return alone(a);
      return right && *right < 0 ? swapped(ExprOp::kSubtract) : id;
    case ExprOp::kSubtract:
      if (right && *right == 0) return alone(a);
      return right && *right < 0 ? swapped(ExprOp::kAdd) : id;
    case ExprOp::kMultiply:
      if (left && *left == 1) return alone(b);
      if (right && *right == 1) return alone(a);
      if (left && *left == -1) return negated(b);
      return right && *right == -1 ? negated(a) : id;
    case ExprOp::kDivide:
      return right && *right == 1 ? alone(a) : id;
    default:
      return id;
  }
}

/// Words of the block with what is known in them; false: nothing is left of a block that had words.
bool Fitter::Rewrite(BlockId id, const ConstantValues& values, Block& block) {
  std::vector<Word> words;
  const IdRange<WordId> old = block.words;
  for (std::uint32_t i = 0; i < old.count; ++i) {
    Word word = module_.words[old[i]];
    if (word.op == WordOp::kDefine) {
      words.push_back(word);
      continue;
    }
    if (word.op == WordOp::kJump && word.value.Valid()) {
      if (const auto holds = values.EvaluateAt(id, i, word.value)) {
        if (holds->number == 0) continue;
        word.value = {};
      }
    }
    word.value = Folded(values, id, i, word.value);
    if (word.op == WordOp::kAxisComputed) {
      const auto axis = values.EvaluateAt(id, i, word.Extra<ExprId>());
      if (axis && axis->type == Type::kAxis) {
        word.op = WordOp::kAxis;
        word.index = static_cast<std::uint8_t>(axis->number);
        word.extra = Id<void>::kNone;
        word.spelling = 0;
      }
    }
    if (word.op == WordOp::kFor) {
      For loop = module_.fors[word.Extra<ForId>()];
      loop.end = Folded(values, id, i, loop.end);
      loop.step = Folded(values, id, i, loop.step);
      module_.fors[word.Extra<ForId>()] = loop;
    }
    words.push_back(word);
  }
  SetWords(module_, block, words);
  return !words.empty() || old.Empty();
}

/// Without effect when it is not worked out: the reads of the standard cycles are of the modal state.
bool Fitter::IsRemovable(ExprId value) const {
  const Expr& expr = module_.exprs[value];
  if (expr.op == ExprOp::kDivide || expr.op == ExprOp::kDivideInteger || expr.op == ExprOp::kModulo) return false;
  if (expr.op == ExprOp::kFunction || expr.op == ExprOp::kElement || expr.op == ExprOp::kCellAt) return false;
  if (expr.op == ExprOp::kSystem) {
    const SystemKind kind = module_.systems[SystemId{expr.a}].kind;
    return kind == SystemKind::kActiveFeed || kind == SystemKind::kPlaneAxis || kind == SystemKind::kModalGroup;
  }
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
    case Operands::kList:
      return true;
    case Operands::kUnary:
      return IsRemovable(ExprId{expr.a});
    case Operands::kBinary:
      return IsRemovable(ExprId{expr.a}) && IsRemovable(ExprId{expr.b});
  }
  return false;
}

/// Assignments of variables that nothing reads, and definitions of those that nothing names.
void Fitter::DropUnused() {
  for (bool changed = true; changed;) {
    changed = false;
    std::set<std::uint32_t> read, written;
    const IdRange<BlockId> blocks = module_.programs[program_].blocks;
    for (const BlockId id : blocks) {
      for (const WordId word_id : module_.blocks[id].words) {
        const Word& word = module_.words[word_id];
        VisitWordExprs(module_, word, [&](ExprId root, bool place) {
          VisitReads(module_, root, [&](ExprId node) {
            const Expr& expr = module_.exprs[node];
            if (expr.op != ExprOp::kVariable && expr.op != ExprOp::kElement) return;
            (place && node == root && word.op == WordOp::kAssign ? written : read).insert(expr.a);
          });
        });
      }
    }
    ProgramEditor editor(module_, program_, "specialize_programs");
    for (const BlockId id : blocks) {
      Block block = module_.blocks[id];
      std::vector<Word> kept;
      for (const WordId word_id : block.words) {
        const Word word = module_.words[word_id];
        if (word.op == WordOp::kAssign) {
          const Expr& place = module_.exprs[word.Extra<ExprId>()];
          if (place.op == ExprOp::kVariable && module_.variables[VariableId{place.a}].owner == program_ &&
              !read.contains(place.a) && IsRemovable(word.value))
            continue;
        }
        if (word.op == WordOp::kDefine && !read.contains(word.extra) && !written.contains(word.extra)) continue;
        kept.push_back(word);
      }
      if (kept.size() == block.words.count) continue;
      changed = true;
      if (kept.empty()) {
        editor.Remove(id);
        continue;
      }
      editor.SetWords(id, kept);
    }
    editor.Apply();
  }
}

/// What the text was made for, in its first line.
void Fitter::Title(std::string_view text) {
  const IdRange<BlockId> old = module_.programs[program_].blocks;
  Block first = ProgramEditor(module_, program_, "specialize_programs").MakeBlock(old[0]);
  first.indent = 0;
  Comment comment;
  comment.text = module_.strings.Intern(text);
  comment.place = CommentPlace::kOwnLine;
  first.comments = {static_cast<std::uint32_t>(module_.comments.Size()), 1};
  module_.comments.Add(comment);
  IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()), old.count + 1};
  module_.blocks.Add(first);
  for (const BlockId id : old) {
    const Block copy = module_.blocks[id];
    module_.blocks.Add(copy);
  }
  module_.programs[program_].blocks = range;
  diag::Sink quiet;
  BuildStructure(module_, program_, 0, quiet);
}

void Fitter::Run(const analysis::FlowAnalyses& analyses, bool keeps_locals, std::string_view title) {
  const ConstantValues values(module_, machine_, program_, analyses.Graphs().Of(program_), keeps_locals,
                              SystemAt(analyses.Modal()));
  const IdRange<BlockId> old = module_.programs[program_].blocks;
  std::vector<Block> blocks;
  std::vector<std::uint8_t> marks_stay;  // per open structure
  for (const BlockId id : old) {
    Block block = module_.blocks[id];
    const bool reached = values.Reached(id);
    const Word* word = block.words.count == 1 ? &module_.words[block.words[0]] : nullptr;
    bool stays = reached;
    if (word != nullptr && IsStructureMark(word->op)) {
      switch (word->op) {
        case WordOp::kIf:
          marks_stay.push_back(
              reached && (block.skip_level != Block::kNoSkip || !values.Evaluate(id, word->value)) ? 1 : 0);
          stays = marks_stay.back() != 0;
          break;
        case WordOp::kWhile:
        case WordOp::kFor:
        case WordOp::kLoop:
        case WordOp::kRepeat:
          marks_stay.push_back(reached ? 1 : 0);
          stays = reached;
          break;
        case WordOp::kElse:
          stays = marks_stay.back() != 0;
          break;
        default:
          stays = marks_stay.back() != 0;
          marks_stay.pop_back();
      }
    }
    if (stays && reached) stays = Rewrite(id, values, block);
    if (!stays) {
      if (!block.label.Valid() && block.number == Block::kNoNumber) continue;
      block.words = {};
    }
    if (block.words.Empty() && !block.label.Valid() && block.number == Block::kNoNumber) continue;
    blocks.push_back(block);
  }
  IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()), static_cast<std::uint32_t>(blocks.size())};
  for (const Block& block : blocks) module_.blocks.Add(block);
  module_.programs[program_].blocks = range;
  diag::Sink quiet;
  BuildStructure(module_, program_, 0, quiet);
  DropUnused();
  if (!module_.programs[program_].blocks.Empty()) Title(title);
}

}  // namespace

void FitProgram(Module& module, const Machine& machine, ProgramId program, const analysis::FlowAnalyses& analyses,
                bool keeps_locals, std::string_view title) {
  Fitter(module, machine, program).Run(analyses, keeps_locals, title);
}

}  // namespace ncport::ir::transform
