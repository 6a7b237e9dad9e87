#include "frontend/sinumerik/fitted_words.h"

#include <fmt/format.h>

#include <string_view>

#include "ir/nodes.h"
#include "ir/word_values.h"

namespace ncport::frontend::sinumerik {

namespace {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

/// A word that is not there, and the key that says so.
struct Lack {
  std::string_view word;
  std::string_view key;
  std::string_view instead;
};

constexpr std::string_view kJumps = "write IF .. GOTOF and GOTOB with labels";
constexpr std::string_view kCells = "use R parameters";
constexpr std::string_view kSearch = "write GOTOF or GOTOB with a label";

class FittedWords {
 public:
  FittedWords(const ir::Module& module, const dialects::Profile& profile, diag::Sink& sink)
      : module_(module), profile_(profile), sink_(sink) {}

  void Run() {
    const auto no = [](const dialects::Setting<bool>& setting) { return !setting.Or(true); };
    loops_ = profile_.nesting.loop.Or(1) != 0;
    branches_ = profile_.nesting.branch.Or(1) != 0;
    definitions_ = !no(profile_.sinumerik.definitions);
    logic_ = !no(profile_.sinumerik.logic_words);
    both_ways_ = !no(profile_.sinumerik.jumps_both_ways);
    if (loops_ && branches_ && definitions_ && logic_ && both_ways_) return;
    for (const ir::Program& program : module_.programs.All()) {
      if (program.library) continue;
      if (!definitions_ && !program.parameters.Empty())
        Report({program.file, program.header_line, 0, 0}, {"PROC", "sinumerik.definitions", kCells});
      for (const ir::BlockId block : program.blocks) Look(module_.blocks[block]);
    }
  }

 private:
  void Look(const ir::Block& block) {
    if ((block.flags & ir::Block::kRefused) != 0) return;
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      const Lack lack = LackOf(word);
      if (lack.word.empty()) continue;
      Report(module_.RangeOf(block, word), lack);
      return;
    }
  }

  [[nodiscard]] Lack LackOf(const ir::Word& word) const {
    switch (word.op) {
      case WordOp::kWhile:
        if (!loops_) return {"WHILE", "nesting.loop", kJumps};
        break;
      case WordOp::kFor:
        if (!loops_) return {"FOR", "nesting.loop", kJumps};
        break;
      case WordOp::kLoop:
        if (!loops_) return {"LOOP", "nesting.loop", kJumps};
        break;
      case WordOp::kRepeat:
        if (!loops_) return {"REPEAT", "nesting.loop", kJumps};
        break;
      case WordOp::kIf:
        if (!branches_) return {"IF", "nesting.if", kJumps};
        break;
      case WordOp::kDefine:
        if (!definitions_) return {"DEF", "sinumerik.definitions", kCells};
        break;
      case WordOp::kJump: {
        const ir::Jump& jump = module_.jumps[word.Extra<ir::JumpId>()];
        const bool one_way = jump.search == ir::Search::kForward || jump.search == ir::Search::kBackward;
        if (!both_ways_ && (!one_way || jump.quiet || jump.target.kind == ir::TargetKind::kExpression))
          return {"GOTO", "sinumerik.jumps-both-ways", kSearch};
        break;
      }
      default:
        break;
    }
    if (logic_) return {};
    std::string_view found;
    ir::VisitValues(module_, word, [&](ExprId value) {
      if (found.empty()) found = LogicIn(value);
    });
    return found.empty() ? Lack{} : Lack{found, "sinumerik.logic-words", "test one condition after the other"};
  }

  /// The word of logic in the expression; empty: there is none.
  [[nodiscard]] std::string_view LogicIn(ExprId id) const {
    const Expr& expr = module_.exprs[id];
    switch (expr.op) {
      case ExprOp::kNot:
        return "NOT";
      case ExprOp::kAnd:
        return "AND";
      case ExprOp::kOr:
        return "OR";
      case ExprOp::kXor:
        return "XOR";
      case ExprOp::kBitAnd:
        return "B_AND";
      case ExprOp::kBitOr:
        return "B_OR";
      case ExprOp::kBitXor:
        return "B_XOR";
      default:
        break;
    }
    std::string_view found;
    const auto look = [&](ExprId operand) {
      if (found.empty()) found = LogicIn(operand);
    };
    switch (ir::OperandsOf(expr.op)) {
      case ir::Operands::kLeaf:
        break;
      case ir::Operands::kUnary:
        look(ExprId{std::size_t{expr.a}});
        break;
      case ir::Operands::kBinary:
        look(ExprId{std::size_t{expr.a}});
        look(ExprId{std::size_t{expr.b}});
        break;
      case ir::Operands::kList:
        for (std::uint32_t i = 0; i < expr.count; ++i) look(module_.Item(expr.b + i));
        break;
    }
    return found;
  }

  void Report(const SourceRange& at, const Lack& lack) {
    sink_.Report(diag::Code::kUnknownWord, at, lack.word).help =
        fmt::format("this control has none, as {} of its profile says: {}", lack.key, lack.instead);
  }

  const ir::Module& module_;
  const dialects::Profile& profile_;
  diag::Sink& sink_;
  bool loops_ = true, branches_ = true, definitions_ = true, logic_ = true, both_ways_ = true;
};

}  // namespace

void CheckFittedWords(const ir::Module& module, const dialects::Profile& profile, diag::Sink& sink) {
  FittedWords(module, profile, sink).Run();
}

}  // namespace ncport::frontend::sinumerik
