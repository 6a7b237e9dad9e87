// Assignments, jumps, conditions, loops, printed lines, and the statements at the head of blocks (fanuc-5, 6, 9.3, 10).
#include "base/result.h"
#include "frontend/fanuc/lower.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using diag::Code;
using ir::ExprId;
using ir::ExprOp;
using ir::Word;
using ir::WordOp;

Word& Lowering::AddWord(WordOp op, std::uint32_t first, std::uint32_t last) {
  Word& word = module_.words.Emplace();
  word.op = op;
  word.phase = ir::DefaultPhaseOf(op);
  word.begin = tokens_[first].offset;
  word.length = tokens_[last].End() - word.begin;
  return word;
}

bool Lowering::DoStatement(const Action& action) {
  const Token& token = At(action.first);
  switch (static_cast<Step>(action.op)) {
    case Step::kSkip:
    case Step::kBlockNumber:
      ReplayHead(tokens_, *block_);
      return true;
    case Step::kProgramNumber: {
      // The program itself is the reader's matter; the word keeps its place and its digits.
      Word& word = AddWord(WordOp::kHeader, action.first, action.last);
      word.extra = state_.program.value;
      word.digits = token.digits;
      word.spelling = SpellingOf("O", "fanuc-1");
      return true;
    }
    case Step::kProgramName: {
      if (module_.words.Size() > first_word_) {  // O9123<NAME>: the number names it, the name is shown
        Word& word = AddWord(WordOp::kInert, action.first, action.last);
        word.spelling = SpellingOf(TextOf(token), "fanuc-1");
        return true;
      }
      Word& word = AddWord(WordOp::kHeader, action.first, action.last);
      word.extra = state_.program.value;
      word.spelling = SpellingOf("<>", "fanuc-1");
      return true;
    }
    case Step::kEnterWord:
      word_ = &token;
      return true;
    case Step::kWord: {
      word_ = nullptr;
      const ExprId value = Pop();
      if (!NeedNumber(value)) return false;
      if (action.arg == 1 && !profile_.fanuc.expression_without_brackets.Or(false)) {
        return Fail(Code::kExpectedText, At(action.first + 1U), "an expression in a word stands in brackets", "[");
      }
      pending_.push_back({static_cast<char>(token.sub), action.first, action.last, value, {}});
      return true;
    }
    case Step::kConstant:
      pending_.push_back({static_cast<char>(token.sub), action.first, action.last, {}, {}});
      return true;
    case Step::kName:
      pending_.push_back({kNameLetter, action.first, action.last, {}, {}});
      return true;
    case Step::kSkipRest:
      pending_.push_back({kSkipLetter, action.first, action.last, {}, {}});
      return true;
    case Step::kAssign:
      return Assign(action);
    case Step::kJump:
      return Jump(action);
    case Step::kOpen:
    case Step::kClose: {
      const bool open = static_cast<Step>(action.op) == Step::kOpen;
      AddWord(WordOp::kInert, action.first, action.last).spelling = SpellingOf(open ? "POPEN" : "PCLOS", "fanuc-10");
      return true;
    }
    case Step::kPrintText:
      values_.push_back(Text(module_.View(token.Text())));
      return true;
    case Step::kPrintValue: {
      const Token& format = At(action.last);
      // A field that grows with its number (Haas) is one that holds the longest; blanks in front would fill it, and
      // there are none by the profile (fanuc-10).
      constexpr std::uint8_t kLongest = 16;
      const bool grows = profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas) &&
                         !profile_.fanuc.print_leading_blanks.Or(false);
      const ExprId parts[] = {Pop(), Implied(grows ? kLongest : format.sub), Implied(format.digits)};
      values_.push_back(
          List(ExprOp::kFunction, static_cast<std::uint32_t>(ir::Function::kFixedText), parts, ir::Type::kString, 0));
      return true;
    }
    case Step::kPrint: {
      ExprId all;
      const std::size_t first = values_.size() - action.count;
      for (std::size_t i = first; i < values_.size(); ++i) {
        if (!all.Valid()) {
          all = values_[i];
          continue;
        }
        ir::Expr expr;
        expr.op = ExprOp::kConcat;
        expr.type = ir::Type::kString;
        expr.a = all.value;
        expr.b = values_[i].value;
        all = module_.AddExpr(expr);
      }
      values_.resize(first);
      if (!all.Valid()) all = Text("");
      statement_ = &token;
      Word& word = AddWord(WordOp::kPrint, action.first, action.last);
      word.value = all;
      word.spelling = SpellingOf("DPRNT", "fanuc-10");
      return true;
    }
    case Step::kWhen:
      return When(action);
    case Step::kMark:
      return Mark(action);
    default:
      NCPORT_BUG("step {} is no statement", action.op);
  }
}

bool Lowering::Assign(const Action& action) {
  const ExprId value = Pop();
  const ExprId place = Pop();
  if (!NeedNumber(value)) return false;
  statement_ = &At(action.first);
  const ir::Expr& target = module_.exprs[place];
  if (target.op == ExprOp::kSystem) {
    const std::uint32_t number = module_.systems[ir::SystemId{std::size_t{target.a}}].number;
    const words::SystemRange* range = words::FindSystemVariable(profile_, number);
    if (range != nullptr && range->control != words::Control::kNone) return AddControl(range->control, value, action);
  }
  Word& word = AddWord(WordOp::kAssign, action.first, action.last);
  word.value = value;
  word.extra = place.value;
  return true;
}

// #3000=n(TEXT) is an alarm, #3006=n(TEXT) a message that stops: the comment is the text, `*` in it a blank
// (fanuc-9.3).
bool Lowering::AddControl(words::Control control, ExprId value, const Action& action) {
  std::string text;
  for (std::uint32_t i = 0; i < comments_.size(); ++i) {
    if (comments_[i].token <= action.last) continue;
    text_comment_ = i;
    text = line_.substr(comments_[i].begin, comments_[i].end - comments_[i].begin);
    for (char& c : text) {
      if (c == '*') c = ' ';
    }
    break;
  }
  const ExprId text_expr = text_comment_ != kNoComment ? Text(text) : ExprId{};
  if (control == words::Control::kAlarm) {
    Word& word = AddWord(WordOp::kAlarm, action.first, action.last);
    word.value = value;
    word.extra = text_expr.value;
    word.index = static_cast<std::uint8_t>(ir::AlarmKind::kStops);
    word.spelling = SpellingOf("#3000", "fanuc-9.3");
    return true;
  }
  Word& word = AddWord(WordOp::kMessage, action.first, action.last);
  word.value = text_expr.Valid() ? text_expr : Text("");
  word.extra = value.value;
  word.spelling = SpellingOf("#3006", "fanuc-9.3");
  AddWord(WordOp::kStop, action.first, action.last).spelling = SpellingOf("#3006", "fanuc-9.3");
  return true;
}

bool Lowering::Jump(const Action& action) {
  ir::Jump jump;
  jump.search = ir::Search::kForwardThenFromStart;  // fanuc-6.2
  if (static_cast<JumpForm>(action.arg) == JumpForm::kNumber) {
    const Token& number = At(action.last);
    const bool zero = number.number == 0 && !profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas);
    if ((number.format.flags & ir::NumberFormat::kPoint) != 0 || number.number > 99999999 || zero) {
      return Fail(Code::kOutOfRange, number, nullptr, "block numbers 1 to 99999999");
    }
    jump.target.kind = ir::TargetKind::kNumber;
    jump.target.number = static_cast<std::uint32_t>(number.number);
  } else {
    jump.target.kind = ir::TargetKind::kExpression;
    jump.target.expr = Pop();
    if (!NeedNumber(jump.target.expr)) return false;
  }
  ExprId condition;
  if (action.count == 1) {
    condition = Pop();
    if (!NeedCondition(condition, action)) return false;
  }
  const ir::JumpId id = module_.jumps.Add(jump);
  statement_ = &At(action.first);
  Word& word = AddWord(WordOp::kJump, action.first, action.last);
  word.value = condition;
  word.extra = id.value;
  word.spelling = SpellingOf("GOTO", "fanuc-6.2");
  return true;
}

bool Lowering::When(const Action& action) {
  const ExprId condition = Pop();
  if (!NeedCondition(condition, action)) return false;
  const bool bare = (action.arg & kWhenBare) != 0;
  if (bare && !profile_.fanuc.truth_values.Or(false)) {
    return Fail(Code::kUnexpectedText, At(action.first), "a condition stands behind IF");
  }
  Word& word = AddWord(WordOp::kWhen, action.first, action.last);
  word.value = condition;
  const char* text = bare                              ? "[]"
                     : (action.arg & kWhenClosed) != 0 ? "IF THEN ENDIF"
                     : (action.arg & kWhenThen) != 0   ? "IF THEN"
                                                       : "IF";
  word.spelling = SpellingOf(text, "fanuc-6.3");
  return true;
}

bool Lowering::Mark(const Action& action) {
  auto op = static_cast<WordOp>(action.arg);
  const Token& token = At(action.first);
  std::uint8_t number = 0;
  if (action.count != 0) {
    const Token& written = At(action.count);
    const std::int64_t most = profile_.fanuc.do_numbers.Or(3);
    if ((written.format.flags & ir::NumberFormat::kPoint) != 0 || written.number < 1 ||
        written.number > static_cast<double>(most)) {
      return Fail(Code::kOutOfRange, written, nullptr,
                  most == 3 ? "loop numbers 1 to 3" : "the loop numbers of this control");
    }
    number = static_cast<std::uint8_t>(written.number);
  }
  ExprId condition;
  if (op == WordOp::kIf || op == WordOp::kWhile) {
    condition = Pop();
    if (!NeedCondition(condition, action)) return false;
  }
  const char* text = nullptr;
  switch (op) {
    case WordOp::kIf:
    case WordOp::kElse:
    case WordOp::kEndIf:
      if (!profile_.fanuc.structured_if.Or(false)) {
        return Fail(Code::kNotSupported, token,
                    "this control has IF over several blocks only if profile key fanuc.structured-if says so");
      }
      text = op == WordOp::kIf ? "IF" : op == WordOp::kElse ? "ELSE" : "ENDIF";
      break;
    case WordOp::kWhile:
    case WordOp::kLoop:
      state_.loops.push_back({number, op == WordOp::kLoop});
      text = op == WordOp::kWhile ? "WHILE" : "DO";
      break;
    default: {
      // END tells by its number which loop it ends (fanuc-6.4). A loop that could not be read has number 0.
      auto open = state_.loops.rbegin();
      while (open != state_.loops.rend() && open->number != number && open->number != 0) ++open;
      if (open != state_.loops.rend()) {
        if (open->endless) op = WordOp::kEndLoop;
        state_.loops.erase(std::next(open).base());
      }
      text = "END";
      break;
    }
  }
  Word& word = AddWord(op, action.first, action.last);
  word.value = condition;
  word.index = number;
  word.spelling =
      SpellingOf(text, op == WordOp::kIf || op == WordOp::kElse || op == WordOp::kEndIf ? "fanuc-6.3" : "fanuc-6.4");
  return true;
}

}  // namespace ncport::frontend::fanuc
