// Functions, operators and keywords (fanuc-2.4, 4; mazak-lathe-6). Shortest forms: docs/languages/fanuc-reserved.txt.
#include "dialects/fanuc/words.h"

#include <algorithm>
#include <iterator>

namespace ncport::dialects::fanuc {

namespace {

using Form = FunctionForm;
using Fn = ir::Function;
using Op = ir::ExprOp;

// The first row of a function is the one that is printed.
constexpr FunctionRow kFunctions[] = {
    {"SIN", "SI", Fn::kSin, Form::kOne, false, "fanuc-4.3"},
    {"COS", "CO", Fn::kCos, Form::kOne, false, "fanuc-4.3"},
    {"TAN", "TA", Fn::kTan, Form::kOne, false, "fanuc-4.3"},
    {"ASIN", "AS", Fn::kAsin, Form::kOne, true, "fanuc-4.3"},
    {"ACOS", "AC", Fn::kAcos, Form::kOne, false, "fanuc-4.3"},
    {"ATAN", "AT", Fn::kAtan2Positive, Form::kQuotient, true, "fanuc-4.3"},
    {"ATAN", "AT", Fn::kAtan, Form::kOne, false, "fanuc-4.3"},
    {"ATN", "AT", Fn::kAtan2Positive, Form::kQuotient, true, "fanuc-2.4"},
    {"ATN", "AT", Fn::kAtan, Form::kOne, false, "fanuc-2.4"},
    {"SQRT", "SQ", Fn::kSqrt, Form::kOne, false, "fanuc-4.3"},
    {"SQR", "SQ", Fn::kSqrt, Form::kOne, false, "fanuc-2.4"},
    {"ABS", "AB", Fn::kAbs, Form::kOne, false, "fanuc-4.3"},
    {"ROUND", "RO", Fn::kRound, Form::kOne, false, "fanuc-4.4"},
    {"ROUND", "RO", Fn::kRoundToIncrement, Form::kOne, false, "fanuc-4.4"},
    {"RND", "RN", Fn::kRound, Form::kOne, false, "fanuc-2.4"},
    {"RND", "RN", Fn::kRoundToIncrement, Form::kOne, false, "fanuc-2.4"},
    {"FIX", "FI", Fn::kTruncate, Form::kOne, false, "fanuc-4.3"},
    {"FUP", "FU", Fn::kRoundAway, Form::kOne, false, "fanuc-4.3"},
    {"LN", "LN", Fn::kLn, Form::kOne, false, "fanuc-4.3"},
    {"EXP", "EX", Fn::kExp, Form::kOne, false, "fanuc-4.3"},
    {"POW", "PO", Fn::kPower, Form::kList, false, "fanuc-4.3"},
    {"BIN", "BI", Fn::kFromBcd, Form::kOne, false, "fanuc-4.3"},
    {"BCD", "BC", Fn::kToBcd, Form::kOne, false, "fanuc-4.3"},
    {"ADP", "AD", Fn::kAddDecimalPoint, Form::kOne, false, "fanuc-4.3"},
    {"PRM", "PR", Fn::kParameter, Form::kList, false, "fanuc-4.3"},
};

constexpr Op kNoCondition = Op::kLiteral;

// AND OR XOR of numbers are bit operations; between bracketed conditions they join (fanuc-4.1, 4.5, 4.6).
constexpr OperatorRow kOperators[] = {
    {"*", "*", Op::kMultiply, kNoCondition, 2, "fanuc-4.1"},
    {"/", "/", Op::kDivide, kNoCondition, 2, "fanuc-4.1"},
    {"MOD", "MO", Op::kModulo, kNoCondition, 2, "fanuc-4.1"},
    {"AND", "AN", Op::kBitAnd, Op::kAnd, 2, "fanuc-4.1"},
    {"+", "+", Op::kAdd, kNoCondition, 3, "fanuc-4.1"},
    {"-", "-", Op::kSubtract, kNoCondition, 3, "fanuc-4.1"},
    {"OR", "OR", Op::kBitOr, Op::kOr, 3, "fanuc-4.1"},
    {"XOR", "XO", Op::kBitXor, Op::kXor, 3, "fanuc-4.1"},
    {"EQ", "EQ", Op::kEqual, kNoCondition, 4, "fanuc-4.6"},
    {"NE", "NE", Op::kNotEqual, kNoCondition, 4, "fanuc-4.6"},
    {"GT", "GT", Op::kGreater, kNoCondition, 4, "fanuc-4.6"},
    {"GE", "GE", Op::kGreaterEqual, kNoCondition, 4, "fanuc-4.6"},
    {"LT", "LT", Op::kLess, kNoCondition, 4, "fanuc-4.6"},
    {"LE", "LE", Op::kLessEqual, kNoCondition, 4, "fanuc-4.6"},
    {"&&", "&&", kNoCondition, Op::kAnd, 5, "mazak-lathe-6.4"},
    {"||", "||", kNoCondition, Op::kOr, 5, "mazak-lathe-6.4"},
};

constexpr KeywordRow kKeywords[] = {
    {"IF", "IF", Keyword::kIf, "fanuc-6.3"},
    {"GOTO", "GO", Keyword::kGoto, "fanuc-6.2"},
    {"THEN", "TH", Keyword::kThen, "fanuc-6.3"},
    {"ELSE", "ELSE", Keyword::kElse, "fanuc-6.3"},
    {"ENDIF", "ENDIF", Keyword::kEndIf, "fanuc-6.3"},
    {"WHILE", "WH", Keyword::kWhile, "fanuc-6.4"},
    {"DO", "DO", Keyword::kDo, "fanuc-6.4"},
    {"END", "EN", Keyword::kEnd, "fanuc-6.4"},
    {"POPEN", "PO", Keyword::kOpen, "fanuc-10"},
    {"PCLOS", "PC", Keyword::kClose, "fanuc-10"},
    {"BPRNT", "BP", Keyword::kPrintBinary, "fanuc-10"},
    {"DPRNT", "DP", Keyword::kPrint, "fanuc-10"},
    {"SETVN", "SE", Keyword::kSetName, "fanuc-3.3"},
};

/// `word` is the row's text or cut from it, but not below its shortest form.
template <class Row>
bool Spells(std::string_view word, const Row& row) {
  return word.size() >= row.shortest.size() && row.text.starts_with(word);
}

template <class Range, class Predicate>
auto FindRow(const Range& rows, Predicate predicate) {
  const auto row = std::ranges::find_if(rows, predicate);
  return row == std::end(rows) ? nullptr : row;
}

}  // namespace

std::span<const FunctionRow> Functions() { return kFunctions; }

const FunctionRow* FindFunction(std::string_view word, bool one_bracket) {
  return FindRow(kFunctions, [&](const FunctionRow& row) {
    const bool fits = row.form == FunctionForm::kList || (row.form == FunctionForm::kOne) == one_bracket;
    return fits && Spells(word, row);
  });
}

const FunctionRow* FindFunction(ir::Function function) {
  if (function == Fn::kAtan2) function = Fn::kAtan2Positive;
  if (function == Fn::kAsinPositive) function = Fn::kAsin;  // 6004#0 NAT: the text is the same
  return FindRow(kFunctions, [&](const FunctionRow& row) { return row.function == function; });
}

std::span<const OperatorRow> Operators() { return kOperators; }

const OperatorRow* FindOperator(std::string_view word) {
  return FindRow(kOperators, [&](const OperatorRow& row) { return Spells(word, row); });
}

const OperatorRow* FindOperator(ir::ExprOp op) {
  if (op == kNoCondition) return nullptr;
  return FindRow(kOperators, [&](const OperatorRow& row) { return row.op == op || row.condition == op; });
}

std::span<const KeywordRow> Keywords() { return kKeywords; }

const KeywordRow* FindKeyword(std::string_view word) {
  return FindRow(kKeywords, [&](const KeywordRow& row) { return Spells(word, row); });
}

}  // namespace ncport::dialects::fanuc
