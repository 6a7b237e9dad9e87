// Jumps, structure marks, procedures, calls.
#include "base/result.h"
#include "frontend/sinumerik/lower.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::ExprId;
using ir::TargetKind;
using ir::Word;
using ir::WordOp;

ir::Target Lowering::TakeTarget() {
  const ir::Target target = targets_.back();
  targets_.pop_back();
  return target;
}

ir::JumpId Lowering::AddJump(const Token& word) {
  ir::Jump jump;
  jump.target = TakeTarget();
  jump.search = static_cast<ir::Search>(word.sub);
  jump.quiet = word.digits != 0;
  return module_.jumps.Add(jump);
}

IdRange<ir::ArgId> Lowering::TakeArguments(std::uint16_t count) {
  const IdRange<ir::ArgId> range{static_cast<std::uint32_t>(module_.args.Size()), count};
  const std::size_t first = values_.size() - count;
  for (std::uint16_t i = 0; i < count; ++i) module_.args.Add({.value = values_[first + i], .position = i});
  values_.resize(first);
  return range;
}

namespace {

// Corrections and card 8.11: which numbers stop the program. A number of another range, or one that is computed, is
// taken to stop: the run ends where the control might go on, never the other way.
ir::AlarmKind KindOf(double number) {
  const bool shows = (number >= 62000 && number < 63000) || (number >= 66000 && number < 68000);
  return shows ? ir::AlarmKind::kShows : ir::AlarmKind::kStops;
}

}  // namespace

// Procedures that change nothing a run shows. SETMS makes a spindle the master: only the first one, which is the master
// anyway, since another is refused here.
bool Lowering::AddInertCall(const Action& action) {
  const Token& token = At(action.first);
  if (dialects::sinumerik::InertProcedures()[token.data] == "SETMS") {
    std::uint32_t spindle = 1;
    if (action.count > 1 || (action.count == 1 && (!LiteralInt(values_.back(), 1, spindle) || spindle != 1))) {
      return Fail(Code::kNotSupported, token, "SETMS and SETMS(1) are translated");
    }
  }
  values_.resize(values_.size() - action.count);
  return AddInertText(action);
}

bool Lowering::DoFlow(const Action& action) {
  const Token& token = At(action.first);
  ir::Target target;
  switch (static_cast<Step>(action.op)) {
    case Step::kTargetName:
      target.label = token.Text();
      targets_.push_back(target);
      return true;
    case Step::kTargetNumber:
    case Step::kTargetMainNumber:
      target.kind = static_cast<Step>(action.op) == Step::kTargetNumber ? TargetKind::kNumber : TargetKind::kMainNumber;
      target.number = static_cast<std::uint32_t>(token.number);
      targets_.push_back(target);
      return true;
    case Step::kTargetValue:
      target.kind = TargetKind::kExpression;
      target.expr = Pop();
      targets_.push_back(target);
      return true;
    case Step::kTargetStart:
      target.kind = TargetKind::kProgramStart;
      targets_.push_back(target);
      return true;
    case Step::kJump: {
      const ir::JumpId jump = AddJump(At(action.count));
      Word& word = AddWord(WordOp::kJump, action.first, action.last);
      word.extra = jump.value;
      if ((action.arg & 1U) != 0) word.value = Pop();
      return true;
    }
    case Step::kCaseArm: {
      const ir::JumpId jump = AddJump(At(action.count));
      arms_.push_back({action.arg == 0 ? Pop() : ExprId{}, jump});
      return true;
    }
    case Step::kCase: {
      ir::Switch record;
      record.first_arm = static_cast<std::uint32_t>(module_.switch_arms.size());
      record.arm_count = static_cast<std::uint32_t>(arms_.size());
      module_.switch_arms.insert(module_.switch_arms.end(), arms_.begin(), arms_.end());
      arms_.clear();
      const ir::SwitchId id = module_.switches.Add(record);
      Word& word = AddWord(WordOp::kSwitch, action.first, action.last);
      word.value = Pop();
      word.extra = id.value;
      return true;
    }
    case Step::kMessage: {
      if (action.count > 2) return Fail(Code::kUnexpectedText, token, "MSG takes a text and a display mode");
      const ExprId mode = action.count == 2 ? Pop() : ExprId{};
      const ExprId text = action.count >= 1 ? Pop() : ExprId{};
      Word& word = AddWord(WordOp::kMessage, action.first, action.last);
      word.value = text;
      word.extra = mode.value;
      word.spelling = SpellingOf("MSG", "sinumerik-8.11");
      return true;
    }
    case Step::kAlarm: {
      const ExprId text = action.count == 2 ? Pop() : ExprId{};
      const ExprId number = Pop();
      Word& word = AddWord(WordOp::kAlarm, action.first, action.last);
      word.value = number;
      word.extra = text.value;
      const auto kind = IsLiteral(number) ? KindOf(module_.exprs[number].number) : ir::AlarmKind::kStops;
      word.index = static_cast<std::uint8_t>(kind);
      word.spelling = SpellingOf("SETAL", "sinumerik-8.11");
      return true;
    }
    case Step::kPreprocessStop:
      AddWord(WordOp::kPreprocessStop, action.first, action.last).spelling = SpellingOf("STOPRE", "sinumerik-8.11");
      return true;
    case Step::kWorkpiece: {
      ir::Call call;
      call.has_brackets = true;
      call.args = TakeArguments(action.count);
      const ir::CallId id = module_.calls.Add(call);
      AddWord(WordOp::kWorkpiece, action.first, action.last).extra = id.value;
      return true;
    }
    case Step::kInertCall:
      return AddInertCall(action);
    case Step::kInertText:
      return AddInertText(action);
    case Step::kReturn: {
      for (std::uint16_t i = 1; i < action.count; ++i) {
        if (Pop().Valid()) {
          return Fail(Code::kNotSupported, token,
                      "RET with an offset or levels; RET and RET(\"LABEL\") are translated");
        }
      }
      const ExprId target_value = action.count != 0 ? Pop() : ExprId{};
      Word& word = AddWord(WordOp::kReturn, action.first, action.last);
      word.value = target_value;
      const auto kind = target_value.Valid() ? ir::ReturnKind::kToCaller : ir::ReturnKind::kPlain;
      word.index = static_cast<std::uint8_t>(kind);
      word.spelling = SpellingOf("RET", "sinumerik-7.5");
      return true;
    }
    case Step::kMark: {
      Word& word = AddWord(static_cast<WordOp>(action.arg), action.first, action.last);
      if (action.count != 0) word.value = Pop();
      return true;
    }
    case Step::kFor: {
      ir::For record;
      record.end = Pop();
      const ExprId start = Pop();
      record.variable = Pop();
      const ir::ForId id = module_.fors.Add(record);
      Word& word = AddWord(WordOp::kFor, action.first, action.last);
      word.value = start;
      word.extra = id.value;
      return true;
    }
    default:
      NCPORT_BUG("step {} is no flow", action.op);
  }
}

bool Lowering::DoCall(const Action& action) {
  const Token& token = At(action.first);
  ir::Call call;
  call.has_brackets = (action.arg & kCallBrackets) != 0;
  if ((action.arg & kCallPasses) != 0) call.passes = Pop();
  switch (static_cast<Step>(action.op)) {
    case Step::kCall:
      call.name = token.Text();
      call.args = TakeArguments(action.count);
      break;
    case Step::kModalCall: {
      ir::CallId id;
      if ((action.arg & kCallNamed) != 0) {
        call.name = token.Text();
        call.args = TakeArguments(action.count);
        id = module_.calls.Add(call);
      }
      const std::uint32_t first = (action.arg & kCallNamed) != 0 ? action.first - 1U : action.first;
      AddWord(WordOp::kModalCall, first, action.last).extra = id.value;
      return true;
    }
    case Step::kTextCall: {
      call.form = ir::CallForm::kText;
      if ((action.arg & kCallSubName) != 0) {
        call.name = token.Text();
      } else if ((action.arg & kCallNamed) != 0) {
        // CALL NAME(args): the name is a variable that holds the program's name.
        call.args = TakeArguments(action.count);
        ir::Expr name;
        name.op = ir::ExprOp::kName;
        name.a = token.data;
        name.b = static_cast<std::uint32_t>(module_.expr_items.size());
        call.name_expr = module_.AddExpr(name, {token.offset, token.length});
      } else if ((action.arg & kCallWithName) != 0) {
        call.name_expr = Pop();
      }
      if ((action.arg & kCallRange) != 0) {
        call.form = ir::CallForm::kBlockRange;
        call.to = TakeTarget();
        call.from = TakeTarget();
      } else if (!call.name_expr.Valid() && !call.name.Valid()) {
        return Fail(Code::kMissingValue, token, "name the program to call");
      }
      const std::uint32_t first = (action.arg & kCallNamed) != 0 ? action.first - 1U : action.first;
      const ir::CallId id = module_.calls.Add(call);
      AddWord(WordOp::kCall, first, action.last).extra = id.value;
      return true;
    }
    case Step::kPathCall: {
      call.form = ir::CallForm::kPath;
      call.name = token.Text();
      call.args = TakeArguments(action.count);
      const ir::CallId id = module_.calls.Add(call);
      AddWord(WordOp::kCall, action.first - 1U, action.last).extra = id.value;
      return true;
    }
    case Step::kExternalCall:
      call.form = ir::CallForm::kExternal;
      call.name_expr = Pop();
      break;
    case Step::kRepeatPart: {
      ir::Part part;
      part.single = (action.arg & kPartSingle) != 0;
      part.has_last = (action.arg & kPartLast) != 0;
      if (part.has_last) part.last = TakeTarget();
      // The predefined end label ends the section where it lies between (sinumerik-6.4).
      if (!part.has_last && !part.single) part.last.label = module_.strings.Intern("ENDLABEL");
      part.first = TakeTarget();
      const ir::PartId id = module_.parts.Add(part);
      Word& word = AddWord(WordOp::kRepeatPart, action.first, action.last);
      word.value = call.passes;
      word.extra = id.value;
      return true;
    }
    default:
      NCPORT_BUG("step {} is no call", action.op);
  }
  const ir::CallId id = module_.calls.Add(call);
  AddWord(WordOp::kCall, action.first, action.last).extra = id.value;
  return true;
}

}  // namespace ncport::frontend::sinumerik
