// Words that begin with a letter: addresses, keywords, functions and operators (fanuc-2.4; part of token_source.h).
#include "dialects/fanuc/words.h"
#include "frontend/common/chars.h"
#include "frontend/fanuc/token_source.h"

namespace ncport::frontend::fanuc {

namespace {

namespace words = dialects::fanuc;
using K = TokenKind;
using diag::Code;

K KindOf(ir::ExprOp op, bool between_conditions) {
  switch (op) {
    case ir::ExprOp::kEqual:
      return K::kEqualTo;
    case ir::ExprOp::kNotEqual:
      return K::kNotEqual;
    case ir::ExprOp::kLess:
      return K::kLess;
    case ir::ExprOp::kLessEqual:
      return K::kLessEqual;
    case ir::ExprOp::kGreater:
      return K::kGreater;
    case ir::ExprOp::kGreaterEqual:
      return K::kGreaterEqual;
    case ir::ExprOp::kModulo:
      return K::kModulo;
    case ir::ExprOp::kBitAnd:
      return K::kAnd;
    case ir::ExprOp::kBitOr:
      return K::kOr;
    case ir::ExprOp::kBitXor:
      return K::kXor;
    case ir::ExprOp::kAnd:
      return between_conditions ? K::kBothTrue : K::kNone;
    case ir::ExprOp::kOr:
      return between_conditions ? K::kOneTrue : K::kNone;
    default:
      return K::kNone;
  }
}

K KindOf(words::Keyword keyword) {
  switch (keyword) {
    case words::Keyword::kIf:
      return K::kIf;
    case words::Keyword::kGoto:
      return K::kGoto;
    case words::Keyword::kThen:
      return K::kThen;
    case words::Keyword::kElse:
      return K::kElse;
    case words::Keyword::kEndIf:
      return K::kEndIf;
    case words::Keyword::kWhile:
      return K::kWhile;
    case words::Keyword::kDo:
      return K::kDo;
    case words::Keyword::kEnd:
      return K::kEnd;
    case words::Keyword::kOpen:
      return K::kOpen;
    case words::Keyword::kClose:
      return K::kClose;
    case words::Keyword::kPrint:
      return K::kPrint;
    case words::Keyword::kPrintBinary:
    case words::Keyword::kSetName:
      return K::kRefused;
  }
  return K::kRefused;
}

}  // namespace

TokenSource::Run TokenSource::ReadRun() const {
  Run run;
  const char* p = at_;
  while (p < stop_ && run.count < kMaxRun && IsLetter(*p)) {
    run.letters[run.count] = Upper(*p);
    run.ends[run.count++] = p + 1;
    p = SkipBlanks(p + 1);
  }
  return run;
}

bool TokenSource::BehindOperand() const {
  switch (Last()) {
    case K::kNumber:
    case K::kCell:
    case K::kRightBracket:
      return true;
    default:
      return false;
  }
}

bool TokenSource::BehindOperator() const {
  const K last = Last();
  return last == K::kEquals || (last >= K::kEqualTo && last <= K::kOneTrue);
}

// Operators are expected behind an operand, functions behind an operator, keywords and addresses elsewhere (fanuc-2.4).
void TokenSource::LexLetters() {
  const Run run = ReadRun();
  if (BehindOperand() && LexOperatorWord(run)) return;
  const bool in_expression = depth_ != 0 || BehindOperator();
  if (in_expression) {
    if (LexFunctionWord(run)) return;
    Fail(run.count > 1 ? Code::kUnknownWord : Code::kUnexpectedText, at_, run.ends[run.count - 1]);
    return;
  }
  if (run.count > 1) {
    if (LexKeyword(run)) return;
    Fail(Code::kUnknownWord, at_, run.ends[run.count - 1]);
    return;
  }
  LexAddress(run.letters[0], at_, run.ends[0]);
}

bool TokenSource::LexOperatorWord(const Run& run) {
  for (std::size_t length = run.count; length >= 2; --length) {
    const words::OperatorRow* row = words::FindOperator(run.Text(length));
    if (row == nullptr) continue;
    Push(KindOf(row->op, false), at_, run.ends[length - 1]);
    at_ = run.ends[length - 1];
    return true;
  }
  return false;
}

bool TokenSource::LexFunctionWord(const Run& run) {
  for (std::size_t length = run.count; length >= 2; --length) {
    const words::FunctionRow* row = words::FindFunction(run.Text(length), true);
    if (row == nullptr) continue;
    const K kind = row->function == ir::Function::kAtan        ? K::kAtan
                   : row->function == ir::Function::kParameter ? K::kParameter
                                                               : K::kFunction;
    Push(kind, at_, run.ends[length - 1]).data = static_cast<std::uint32_t>(row - words::Functions().data());
    at_ = run.ends[length - 1];
    return true;
  }
  return false;
}

bool TokenSource::LexKeyword(const Run& run) {
  for (std::size_t length = run.count; length >= 2; --length) {
    const words::KeywordRow* row = words::FindKeyword(run.Text(length));
    if (row == nullptr) continue;
    const K kind = KindOf(row->keyword);
    Push(kind, at_, run.ends[length - 1]);
    at_ = run.ends[length - 1];
    assigning_ = false;
    switch (kind) {
      case K::kRefused:
        refused_ = static_cast<std::uint32_t>(tokens_.size());
        break;
      case K::kPrint:
        LexPrint();
        break;
      case K::kIf:
      case K::kElse:
      case K::kEndIf:
      case K::kWhile:
      case K::kDo:
      case K::kEnd:
        if (structure_ == K::kNone) structure_ = kind;
        break;
      default:
        break;
    }
    return true;
  }
  return false;
}

void TokenSource::LexAddress(char letter, const char* from, const char* behind) {
  assigning_ = false;
  const char* value = SkipBlanks(behind);
  const bool sign = At(value) == '-' || At(value) == '+';
  const char* digits = sign ? SkipBlanks(value + 1) : value;
  if (StartsNumber(digits)) {
    Token& token = Push(K::kWordValue, from, from);
    const char* end = ReadNumber(digits, token);
    if (end == nullptr) return;
    const char operation = At(SkipBlanks(end));
    if (bare_expressions_ && (operation == '+' || operation == '-' || operation == '*')) {
      token = {};
      token.kind = static_cast<std::uint16_t>(K::kAddress);
      token.offset = OffsetOf(from);
      token.length = static_cast<std::uint32_t>(behind - from);
      token.sub = static_cast<std::uint8_t>(letter);
      at_ = value;
      return;
    }
    token.sub = static_cast<std::uint8_t>(letter);
    token.digits = token.format.int_digits;
    token.length = static_cast<std::uint32_t>(end - from);
    if (At(value) == '-') {
      token.number = -token.number;
      if ((token.format.flags & ir::NumberFormat::kAsText) != 0) {
        digits_ = "-";
        digits_ += strings_.View(token.Text());
        token.data = strings_.Intern(digits_).value;
      }
    }
    if (At(value) == '+') token.format.flags |= ir::NumberFormat::kPlusSign;
    at_ = end;
    return;
  }
  if (At(digits) == '#' || At(digits) == '[') {
    Push(K::kAddress, from, behind).sub = static_cast<std::uint8_t>(letter);
    at_ = value;
    return;
  }
  if (sign && (At(digits) == '-' || At(digits) == '+')) {
    Fail(Code::kUnexpectedText, digits, digits + 1, "write one sign, or brackets: X[-#1]");
    return;
  }
  Fail(Code::kMissingValue, from, behind);
}

}  // namespace ncport::frontend::fanuc
