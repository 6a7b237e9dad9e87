// Jumps, structure marks, calls, returns.
#include <cmath>

#include "backends/sinumerik/printer.h"
#include "base/number_text.h"
#include "base/result.h"

namespace ncport::backends::sinumerik {

using ir::TargetKind;
using ir::WordOp;

void Printer::Flow(const ir::Word& word) {
  const auto with_condition = [&](std::string_view text) {
    out_.Append(text);
    out_.Append(' ');
    Expr(word.value);
  };
  switch (word.op) {
    case WordOp::kJump:
      if (word.value.Valid()) {
        with_condition("IF");
        out_.Append(' ');
      }
      return Jump(word.Extra<ir::JumpId>());
    case WordOp::kSwitch:
      return Switch(word);
    case WordOp::kCall:
      return Call(word.Extra<ir::CallId>());
    case WordOp::kWorkpiece:
      out_.Append("WORKPIECE");
      return Arguments(module_.calls[word.Extra<ir::CallId>()].args);
    case WordOp::kModalCall:
      out_.Append("MCALL");
      if (!word.Extra<ir::CallId>().Valid()) return;
      out_.Append(' ');
      return Call(word.Extra<ir::CallId>());
    case WordOp::kRepeatPart:
      return RepeatPart(word);
    case WordOp::kReturn:
      if (static_cast<ir::ReturnKind>(word.index) == ir::ReturnKind::kAuxiliary) return Code(word);
      out_.Append("RET");
      if (!word.value.Valid()) return;
      out_.Append('(');
      Expr(word.value);
      out_.Append(')');
      return;
    case WordOp::kIf:
      return with_condition("IF");
    case WordOp::kElse:
      out_.Append("ELSE");
      return;
    case WordOp::kEndIf:
      out_.Append("ENDIF");
      return;
    case WordOp::kWhile:
      return with_condition("WHILE");
    case WordOp::kEndWhile:
      out_.Append("ENDWHILE");
      return;
    case WordOp::kLoop:
      out_.Append("LOOP");
      return;
    case WordOp::kEndLoop:
      out_.Append("ENDLOOP");
      return;
    case WordOp::kRepeat:
      out_.Append("REPEAT");
      return;
    case WordOp::kUntil:
      return with_condition("UNTIL");
    case WordOp::kFor: {
      const ir::For& record = module_.fors[word.Extra<ir::ForId>()];
      NCPORT_CHECK(!record.step.Valid(), "SINUMERIK counts in steps of 1");
      out_.Append("FOR ");
      Expr(record.variable);
      out_.Append('=');
      Expr(word.value);
      out_.Append(" TO ");
      Expr(record.end);
      return;
    }
    case WordOp::kEndFor:
      out_.Append("ENDFOR");
      return;
    default:
      NCPORT_BUG("{} is no flow", ir::NameOf(word.op));
  }
}

void Printer::Jump(ir::JumpId id) {
  const ir::Jump& jump = module_.jumps[id];
  if (jump.target.kind == TargetKind::kProgramStart) {
    out_.Append("GOTOS");
    return;
  }
  switch (jump.search) {
    case ir::Search::kForward:
      out_.Append("GOTOF ");
      break;
    case ir::Search::kBackward:
      out_.Append("GOTOB ");
      break;
    case ir::Search::kForwardThenBackward:
      out_.Append(jump.quiet ? "GOTOC " : "GOTO ");
      break;
    default:
      NCPORT_BUG("SINUMERIK has no jump with search {}", static_cast<int>(jump.search));
  }
  Target(jump.target);
}

void Printer::Target(const ir::Target& target) {
  switch (target.kind) {
    case TargetKind::kLabel:
      out_.Append(module_.View(target.label));
      return;
    case TargetKind::kNumber:
    case TargetKind::kMainNumber:
      out_.Append(target.kind == TargetKind::kNumber ? 'N' : ':');
      AppendInteger(out_, target.number);
      return;
    case TargetKind::kExpression:
      return Expr(target.expr);
    case TargetKind::kProgramStart:
      break;
  }
  NCPORT_BUG("only a jump goes to the program start");
}

void Printer::Switch(const ir::Word& word) {
  const ir::Switch& record = module_.switches[word.Extra<ir::SwitchId>()];
  out_.Append("CASE ");
  Expr(word.value);
  out_.Append(" OF");
  for (std::uint32_t i = 0; i < record.arm_count; ++i) {
    const ir::SwitchArm& arm = module_.switch_arms[record.first_arm + i];
    out_.Append(' ');
    if (arm.value.Valid()) {
      Expr(arm.value);
    } else {
      out_.Append("DEFAULT");
    }
    out_.Append(' ');
    Jump(arm.jump);
  }
}

void Printer::Call(ir::CallId id) {
  const ir::Call& call = module_.calls[id];
  switch (call.form) {
    case ir::CallForm::kName:
      out_.Append(module_.View(call.name));
      break;
    case ir::CallForm::kText:
      out_.Append("CALL ");
      Expr(call.name_expr);
      break;
    case ir::CallForm::kBlockRange:
      out_.Append("CALL ");
      if (call.name_expr.Valid()) {
        Expr(call.name_expr);
        out_.Append(' ');
      }
      out_.Append("BLOCK ");
      Target(call.from);
      out_.Append(" TO ");
      Target(call.to);
      break;
    case ir::CallForm::kPath:
      out_.Append("PCALL ");
      out_.Append(module_.View(call.name));
      break;
    case ir::CallForm::kExternal:
      out_.Append("EXTCALL ");
      Expr(call.name_expr);
      break;
  }
  if (call.has_brackets || !call.args.Empty()) Arguments(call.args);
  Passes(call.passes);
}

/// Empty places stay, also those at the end.
void Printer::Arguments(IdRange<ir::ArgId> args) {
  out_.Append('(');
  std::uint16_t position = 0;
  for (const ir::ArgId id : args) {
    const ir::Arg& arg = module_.args[id];
    for (; position < arg.position; ++position) out_.Append(',');
    if (arg.value.Valid()) Expr(arg.value);
  }
  out_.Append(')');
}

void Printer::Passes(ir::ExprId passes) {
  if (!passes.Valid()) return;
  const ir::Expr* value = &module_.exprs[passes];
  while (value->op == ir::ExprOp::kConvert) value = &module_.exprs[ir::ExprId{value->a}];
  // P is INT: a literal stands without a point (sinumerik-7.1).
  if (value->op == ir::ExprOp::kLiteral && value->number == std::floor(value->number)) {
    out_.Append(" P");
    return AppendInteger(out_, static_cast<std::int64_t>(value->number));
  }
  out_.Append(value->op == ir::ExprOp::kLiteral ? " P" : " P=");
  Expr(passes);
}

void Printer::RepeatPart(const ir::Word& word) {
  const ir::Part& part = module_.parts[word.Extra<ir::PartId>()];
  out_.Append(part.single ? "REPEATB " : "REPEAT ");
  Target(part.first);
  if (part.has_last) {
    out_.Append(' ');
    Target(part.last);
  }
  if (!word.value.Valid()) return;
  out_.Append(" P=");
  Expr(word.value);
}

}  // namespace ncport::backends::sinumerik
