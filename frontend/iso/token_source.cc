#include "frontend/iso/token_source.h"

#include <cmath>

#include "base/number_text.h"
#include "dialects/iso/words.h"
#include "frontend/common/chars.h"
#include "frontend/iso/token_kind.h"
#include "ir/axis_names.h"

namespace ncport::frontend::iso {
namespace {

using diag::Code;
using K = TokenKind;

constexpr const char* kLiteral = "flat blocks have literal words only: a letter and a number";

/// "G92 S{speed}" -> "G92"
std::string FirstWord(const dialects::Setting<std::string>& form) {
  if (!form.Known()) return {};
  return form->substr(0, form->find(' '));
}

}  // namespace

TokenSource::TokenSource(const dialects::Profile& profile)
    : limit_code_(FirstWord(profile.spindle.limit)), lathe_(profile.IsLathe()) {
  for (const std::string& name : profile.axes) {
    if (const auto axis = ir::AxisOf(name)) axes_ = static_cast<std::uint16_t>(axes_ | (1U << *axis));
  }
}

bool TokenSource::Fail(Code code, std::size_t begin, std::size_t length, const char* help) {
  failed_ = true;
  error_ = {.code = code,
            .begin = static_cast<std::uint32_t>(begin),
            .length = static_cast<std::uint32_t>(length),
            .help = help};
  return false;
}

void TokenSource::Lex(std::string_view line) {
  tokens_.clear();
  comments_.clear();
  failed_ = false;
  std::size_t at = 0;
  while (at < line.size() && IsBlank(line[at])) ++at;
  indent_ = static_cast<std::uint32_t>(at);
  std::size_t in_comments = 0;
  while (at < line.size()) {
    const std::size_t before = at;
    if (IsBlank(line[at])) {
      ++at;
    } else if (at - in_comments > kMaxLineBytes) {
      Fail(Code::kBlockTooLong, at, line.size() - at);
      error_.limit = kMaxLineBytes;
      return;
    } else if (tokens_.size() > kMaxTokens || comments_.size() > kMaxTokens) {
      Fail(Code::kTooManyWords, at, line.size() - at);
      error_.limit = kMaxTokens;
      return;
    } else if (line[at] == '(') {
      if (!LexComment(line, at)) return;
      in_comments += at - before;
    } else if (!LexWord(line, at)) {
      return;
    }
  }
}

bool TokenSource::LexComment(std::string_view line, std::size_t& at) {
  const std::size_t end = line.find(')', at);
  if (end == std::string_view::npos) return Fail(Code::kUnclosedComment, at, line.size() - at);
  std::size_t gap = 0;
  while (gap < at && IsBlank(line[at - gap - 1])) ++gap;
  comments_.push_back({static_cast<std::uint32_t>(at + 1), static_cast<std::uint32_t>(end - at - 1),
                       static_cast<std::uint16_t>(tokens_.size()), static_cast<std::uint16_t>(gap)});
  at = end + 1;
  return true;
}

bool TokenSource::LexWord(std::string_view line, std::size_t& at) {
  const char letter = Upper(line[at]);
  if (!IsLetter(letter)) return Fail(Code::kUnexpectedText, at, 1, kLiteral);
  Token token;
  token.offset = static_cast<std::uint32_t>(at);
  const char* p = line.data() + at + 1;
  const char* end = line.data() + line.size();
  while (p != end && IsBlank(*p)) ++p;
  const char* digits = p;
  DecimalText number;
  if (!ParseDecimal(p, end, number)) {
    if (p == end) return Fail(Code::kMissingValue, at, 1);
    return Fail(Code::kUnexpectedText, static_cast<std::size_t>(p - line.data()), 1, kLiteral);
  }
  at = static_cast<std::size_t>(p - line.data());
  token.length = static_cast<std::uint32_t>(at) - token.offset;
  if (!std::isfinite(number.value)) return Fail(Code::kBadNumber, token.offset, token.length);
  token.number = number.value;
  token.digits = number.int_digits;
  token.format = {.int_digits = number.int_digits,
                  .decimals = number.decimals,
                  .flags = static_cast<std::uint8_t>((number.has_point ? ir::NumberFormat::kPoint : 0) |
                                                     (*digits == '+' ? ir::NumberFormat::kPlusSign : 0))};
  // What follows a number is a blank, the next word or a comment: `X10#1`, `X1=5` are no words of this language.
  if (p != end && !IsBlank(*p) && !IsLetter(Upper(*p)) && *p != '(')
    return Fail(Code::kUnexpectedText, at, 1, kLiteral);
  const bool whole = !number.has_point && number.value >= 0 && *digits != '+';
  if (!Classify(token, line.substr(token.offset, token.length), letter, whole)) return false;
  tokens_.push_back(token);
  return true;
}

/// Kind, and what it carries: `sub` = axis or centre word, `data` = row of the code table.
bool TokenSource::Classify(Token& token, std::string_view text, char letter, bool whole) {
  const auto kind = [&](K value, bool needs_whole) {
    token.kind = static_cast<std::uint16_t>(value);
    return !needs_whole || whole || Fail(Code::kBadNumber, token.offset, token.length, "this word has a whole number");
  };
  switch (letter) {
    case 'G':
    case 'M':
      return ClassifyCode(token, text, letter, whole);
    case 'N':
      return kind(K::kBlockNumber, true);
    case 'O':
      return kind(K::kProgramNumber, true);
    case 'I':
    case 'J':
    case 'K':
      token.sub = static_cast<std::uint8_t>(letter - 'I');
      return kind(K::kCenter, false);
    case 'R':
      return kind(K::kRadius, false);
    case 'F':
      return kind(K::kFeed, false);
    case 'S':
      return kind(K::kSpeed, false);
    case 'T':
      return kind(K::kTool, true);
    case 'H':
      return kind(K::kLength, true);
    case 'D':
      return kind(K::kOffset, true);
    case 'P':
      return kind(K::kParameter, false);
    default:
      break;
  }
  const auto axis = ir::AxisOf(letter);
  if (!axis || (axes_ >> *axis & 1U) == 0) return Fail(Code::kUnknownAddress, token.offset, 1);
  token.sub = *axis;
  return kind(K::kAxis, false);
}

bool TokenSource::ClassifyCode(Token& token, std::string_view text, char letter, bool whole) {
  // The table's spelling: no leading zeros, `G54.1` as it stands.
  std::string code(1, letter);
  std::string_view digits = text.substr(1);
  while (!digits.empty() && IsBlank(digits[0])) digits.remove_prefix(1);
  while (digits.size() > 1 && digits[0] == '0' && IsDigit(digits[1])) digits.remove_prefix(1);
  code += digits;
  if (code == "G4") {
    token.kind = static_cast<std::uint16_t>(K::kDwell);
    return true;
  }
  if (code == "G54.1") {
    token.kind = static_cast<std::uint16_t>(K::kExtendedOffset);
    return true;
  }
  if (!limit_code_.empty() && code == limit_code_) {
    token.kind = static_cast<std::uint16_t>(K::kLimit);
    return true;
  }
  const auto& table = dialects::iso::Codes();
  const dialects::CodeRow* row = table.FindText(code);
  if (row != nullptr) {
    token.kind = static_cast<std::uint16_t>(K::kCode);
    token.data = static_cast<std::uint32_t>(row - table.Rows().data());
    return true;
  }
  if (letter == 'G' || !whole) return Fail(Code::kUnknownCode, token.offset, token.length);
  token.kind = static_cast<std::uint16_t>(K::kAuxiliary);
  return true;
}

}  // namespace ncport::frontend::iso
