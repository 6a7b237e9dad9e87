#include "backends/sinumerik/legal_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "dialects/sinumerik/words.h"
#include "ir/axis_names.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordOp;

class LegalCheck {
 public:
  LegalCheck(const RaiseInput& input, const Module& module, diag::Sink& sink, bool expressions)
      : input_(input), module_(module), sink_(sink), expressions_(expressions) {}

  bool Run() {
    for (const ir::ProgramId program : module_.programs.Ids()) {
      for (const ir::BlockId id : module_.programs[program].blocks) {
        block_ = &module_.blocks[id];
        for (const ir::WordId word_id : block_->words) CheckWord(module_.words[word_id]);
      }
    }
    return ok_;
  }

 private:
  /// One finding for a block, however many of its words have no form.
  void Refuse(const Word& word, std::string_view what) {
    ok_ = false;
    if (block_->origin.Valid() && !refused_.insert(block_->origin.value).second) return;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(*block_, word), what, input_.profile->name);
  }

  void CheckWord(const Word& word) {
    CheckExpr(word, word.value);
    switch (word.op) {
      case WordOp::kAssign:
        CheckExpr(word, word.Extra<ExprId>());
        return;
      case WordOp::kCall:
      case WordOp::kModalCall:
        if (!word.Extra<ir::CallId>().Valid()) return;
        for (const ir::ArgId arg : module_.calls[word.Extra<ir::CallId>()].args)
          CheckExpr(word, module_.args[arg].value);
        CheckExpr(word, module_.calls[word.Extra<ir::CallId>()].passes);
        return;
      case WordOp::kJump: {
        const ir::Jump& jump = module_.jumps[word.Extra<ir::JumpId>()];
        if (jump.target.kind == ir::TargetKind::kExpression) CheckExpr(word, jump.target.expr);
        return;
      }
      case WordOp::kAlarm:
      case WordOp::kMessage:
      case WordOp::kStop:
      case WordOp::kIf:
      case WordOp::kElse:
      case WordOp::kEndIf:
      case WordOp::kWhile:
      case WordOp::kEndWhile:
      case WordOp::kLoop:
      case WordOp::kEndLoop:
      case WordOp::kReturn:
      case WordOp::kAux:
      case WordOp::kHeader:
      case WordOp::kExtern:
      case WordOp::kDefine:
      case WordOp::kDwellSeconds:
      case WordOp::kInert:  // made here: those of the source are gone
        return;
      case WordOp::kTool:
      case WordOp::kToolChange:
      case WordOp::kReference:
      case WordOp::kProgramEnd:
      case WordOp::kWorkOffset:
        return;  // each has a pass that refuses it
      case WordOp::kToolOffset:
      case WordOp::kRadiusOffset:
      case WordOp::kLengthOffset:
      case WordOp::kRestart:
      case WordOp::kSkipRest:
      case WordOp::kCycle:  // a later pass writes cycles out or refuses them
      case WordOp::kCycleValue:
      case WordOp::kReturnLevel:
        if (!expressions_) return;
        break;
      case WordOp::kFrame:
      case WordOp::kFrameAngle:
        if (!expressions_ && IsMapped(word)) return;
        break;
      case WordOp::kAxis:
        if (word.index >= ir::kLetterAxes) Refuse(word, "an axis with a name of its own");
        if (!HasAxis(word.index)) Refuse(word, "an axis that the target does not have");
        return;
      case WordOp::kSpindle:
      case WordOp::kSpeed:
      case WordOp::kSpeedLimit:
        if (word.index > 1) Refuse(word, "a second spindle");
        return;
      default:
        break;
    }
    const bool code = dialects::sinumerik::Codes().FindMeaning(word.op, word.index, word.extra) != nullptr;
    const bool address = dialects::sinumerik::FindAddress(word.op, word.index) != nullptr;
    if (word.value.Valid() ? !address : !code) {
      Refuse(word, word.spelling != 0 ? module_.View(module_.spellings[word.spelling].text) : ir::NameOf(word.op));
    }
  }

  /// A later pass gives these frames their form.
  [[nodiscard]] static bool IsMapped(const Word& word) {
    if (word.op == WordOp::kFrameAngle) return true;
    const auto op = static_cast<ir::FrameOp>(word.index);
    return op == ir::FrameOp::kLocalShift || op == ir::FrameOp::kRotateAbout || op == ir::FrameOp::kRotateEnd;
  }

  [[nodiscard]] bool HasAxis(std::uint8_t axis) const {
    return std::any_of(input_.profile->axes.begin(), input_.profile->axes.end(),
                       [&](const std::string& name) { return ir::AxisOf(name) == axis; });
  }

  void CheckExpr(const Word& word, ExprId id) {
    if (!id.Valid() || !expressions_) return;
    const ir::Expr& expr = module_.exprs[id];
    switch (expr.op) {
      case ExprOp::kFunction: {
        const auto function = static_cast<ir::Function>(expr.a);
        if (dialects::sinumerik::FindFunction(function) == nullptr && function != ir::Function::kToText)
          return Refuse(word, fmt::format("the function {}", ir::NameOf(function)));
        for (std::uint32_t i = 0; i < expr.count; ++i) CheckExpr(word, module_.Item(expr.b + i));
        return;
      }
      case ExprOp::kBitAnd:
      case ExprOp::kBitOr:
      case ExprOp::kBitXor:
        return Refuse(word, "a bit operation on numbers that are not INT");  // sinumerik-4.2
      case ExprOp::kVacant:
      case ExprOp::kName:
        return Refuse(word, ir::NameOf(expr.op));
      default:
        break;
    }
    if (ir::OperandsOf(expr.op) == ir::Operands::kUnary || ir::OperandsOf(expr.op) == ir::Operands::kBinary)
      CheckExpr(word, ExprId{std::size_t{expr.a}});
    if (ir::OperandsOf(expr.op) == ir::Operands::kBinary) CheckExpr(word, ExprId{std::size_t{expr.b}});
  }

  const RaiseInput& input_;
  const Module& module_;
  diag::Sink& sink_;
  bool expressions_;
  const ir::Block* block_ = nullptr;
  std::set<std::uint32_t> refused_;  // origins of blocks
  bool ok_ = true;
};

}  // namespace

bool CheckLegal(const RaiseInput& input, const ir::Module& module, bool expressions, diag::Sink& sink) {
  return LegalCheck(input, module, sink, expressions).Run();
}

}  // namespace ncport::backends::sinumerik
