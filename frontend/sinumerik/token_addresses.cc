// Words that begin with one letter: addresses, axes, G and M codes, R cells, numbers of blocks (part of
// token_source.h).
#include <array>
#include <charconv>
#include <cstring>

#include "dialects/sinumerik/words.h"
#include "frontend/sinumerik/chars.h"
#include "frontend/sinumerik/token_source.h"
#include "frontend/sinumerik/word_index.h"
#include "ir/axis_names.h"

namespace ncport::frontend::sinumerik {

namespace {

using K = TokenKind;
using diag::Code;

/// Axis number of one of the nine letters, or kNamedAxis.
std::uint8_t LetterAxis(char upper) {
  static constexpr auto kAxes = [] {
    std::array<std::uint8_t, 256> axes{};
    axes.fill(kNamedAxis);
    std::uint8_t number = 0;
    for (const char letter : ir::kAxisLetters) axes[static_cast<unsigned char>(letter)] = number++;
    return axes;
  }();
  return kAxes[static_cast<unsigned char>(upper)];
}

/// Rows of the addresses of one letter.
std::uint32_t AddressRowOf(char upper) {
  static const auto rows = [] {
    std::array<std::uint32_t, 128> all{};
    all.fill(kAuxiliaryRow);
    const auto addresses = dialects::sinumerik::Addresses();
    for (std::uint32_t row = 0; row < addresses.size(); ++row) {
      if (addresses[row].text.size() == 1) all[static_cast<unsigned char>(addresses[row].text[0])] = row;
    }
    return all;
  }();
  return rows[static_cast<unsigned char>(upper)];
}

/// Row of I1, J1, K1.
std::uint32_t ViaRowOf(char upper) {
  const auto addresses = dialects::sinumerik::Addresses();
  for (std::uint32_t row = 0; row < addresses.size(); ++row) {
    if (addresses[row].op == ir::WordOp::kVia && addresses[row].text[0] == upper) return row;
  }
  return kAuxiliaryRow;
}

}  // namespace

// One letter: an address, an R cell, a code, an L name, a block number.
void TokenSource::LexAddress(Cursor& c) {
  const char* from = c.at;
  const char letter = Upper(*from);
  switch (letter) {
    case 'G':
    case 'M':
      LexCode(c);
      return;
    case 'N':
      LexNumberedWord(c, K::kBlockNumber);
      return;
    case 'R': {
      const char* digits = SkipBlanks(from + 1, c.end);
      if (digits < c.end && *digits == '[') {
        Push(K::kCellAt, from, from + 1);
        c.at = from + 1;
      } else if (digits < c.end && IsDigit(*digits)) {
        LexNumberedWord(c, K::kCell);
      } else {
        Fail(Code::kMissingValue, from, from + 1,
             "R is the space of R parameters: R1, R[1]; the radius of an arc is CR=");
      }
      return;
    }
    case 'L': {
      const char* digits = SkipBlanks(from + 1, c.end);
      const char* end = SkipDigits(digits, c.end);
      if (digits == end) {
        Fail(Code::kMissingValue, from, from + 1);
        return;
      }
      char name[kMaxWord] = {'L'};
      const auto count = static_cast<std::size_t>(end - digits);
      if (count >= kMaxWord) {
        Fail(Code::kUnknownWord, from, end);
        return;
      }
      std::memcpy(name + 1, digits, count);
      c.at = end;
      Push(K::kSubName, from, end).data = strings_.Intern({name, count + 1}).value;
      return;
    }
    default:
      break;
  }
  // Inside brackets a letter is the name of an axis or spindle: `$AA_IM[X]`, `SPI(S1)`.
  const char* value_at = SkipBlanks(from + 1, c.end);
  const std::uint8_t axis = LetterAxis(letter);
  if (depth_ != 0) {
    const char* digits_end = SkipDigits(from + 1, c.end);
    if (axis != kNamedAxis) {
      LexAxis(c, from, digits_end);
    } else {
      c.at = digits_end;
      Push(K::kName, from, digits_end).data =
          strings_.Intern({from, static_cast<std::size_t>(digits_end - from)}).value;
    }
    return;
  }
  // Digits are an extension only before `=` or `[` (card 2.2).
  const char* digits_end = SkipDigits(value_at, c.end);
  const char* behind = SkipBlanks(digits_end, c.end);
  const bool assigned =
      behind < c.end && ((*behind == '=' && !(behind + 1 < c.end && behind[1] == '=')) || *behind == '[');
  const bool extended = assigned && digits_end > value_at;
  const std::uint32_t row = AddressRowOf(letter);
  if (extended && digits_end - value_at > 4) {
    Fail(Code::kUnknownAddress, from, digits_end);
    return;
  }
  if (letter == 'P') {
    if (assigned && !extended) {
      c.at = from + 1;
      Push(K::kPasses, from, from + 1);
      return;
    }
  } else if (axis != kNamedAxis || (row == kAuxiliaryRow && extended)) {
    if (extended || assigned) {
      LexAxis(c, from, extended ? digits_end : from + 1);
      return;
    }
  } else if (row != kAuxiliaryRow && assigned) {
    std::uint32_t number = 0;
    std::from_chars(value_at, digits_end, number);
    c.at = extended ? digits_end : from + 1;
    const std::uint32_t via = extended && number == 1 ? ViaRowOf(letter) : kAuxiliaryRow;
    Token& token = Push(K::kAddress, from, c.at);
    token.data = via != kAuxiliaryRow ? via : row;
    token.sub = via != kAuxiliaryRow ? 0 : static_cast<std::uint8_t>(number);
    const bool takes = via != kAuxiliaryRow || !extended ||
                       dialects::sinumerik::Addresses()[row].extension != dialects::sinumerik::Extension::kNone;
    if (!takes || number > 99) Fail(Code::kUnknownAddress, from, c.at);
    return;
  }
  if (axis == kNamedAxis && row == kAuxiliaryRow && letter != 'P') {
    Fail(Code::kUnknownAddress, from, from + 1);
    return;
  }
  Token& token = Push(letter == 'P'        ? K::kPassesValue
                      : axis != kNamedAxis ? K::kAxisValue
                                           : K::kAddressValue,
                      from, from + 1);
  token.sub = axis;
  token.digits = static_cast<std::uint8_t>(row);  // `data` may become the spelling of the number
  const char* end = ReadValue(value_at, c.end, token);
  if (end != nullptr) {
    if (in_macro_ == nullptr) token.length = static_cast<std::uint32_t>(end - from);
    c.at = end;
    return;
  }
  if (failed_) return;
  c.at = from + 1;
  if (axis != kNamedAxis) {  // `=X`: the axis as a value
    token.kind = static_cast<std::uint16_t>(K::kAxis);
    return;
  }
  Fail(Code::kMissingValue, from, from + 1);
}

// X, X1, X01 as a name; the digits are part of it.
void TokenSource::LexAxis(Cursor& c, const char* start, const char* digits_end) {
  c.at = digits_end;
  Token& token = Push(K::kAxis, start, digits_end);
  token.sub = LetterAxis(Upper(*start));
  const char* digits = SkipBlanks(start + 1, digits_end);
  while (digits + 1 < digits_end && *digits == '0') ++digits;  // leading zeros of an extension do not count (card 2.3)
  const auto count = static_cast<std::size_t>(digits_end - digits);
  if (digits_end == start + 1 || count == 0) return;
  if (count > 4) {
    Fail(Code::kUnknownAddress, start, digits_end);
    return;
  }
  char name[8] = {Upper(*start)};
  std::memcpy(name + 1, digits, count);
  token.sub = kNamedAxis;
  token.data = strings_.Intern({name, count + 1}).value;
}

void TokenSource::LexCode(Cursor& c) {
  const char* from = c.at;
  const bool is_g = Upper(*from) == 'G';
  const char* digits = SkipBlanks(from + 1, c.end);
  const char* end = SkipDigits(digits, c.end);
  const char* behind = SkipBlanks(end, c.end);
  const bool assigned =
      behind < c.end && ((*behind == '=' && !(behind + 1 < c.end && behind[1] == '=')) || *behind == '[');
  std::uint32_t number = 0;
  const bool fits = std::from_chars(digits, end, number).ec == std::errc() && end - digits <= 9;
  if (assigned) {
    c.at = digits == end ? from + 1 : end;
    Token& token = Push(is_g ? K::kComputedG : K::kComputedM, from, c.at);
    token.sub = static_cast<std::uint8_t>(number);
    if (is_g && digits != end) {
      Fail(Code::kUnexpectedText, behind, behind + 1);  // `G1=5`: the number stands there already
    } else if (number > 99) {
      Fail(Code::kUnknownCode, from, c.at);
    }
    return;
  }
  if (digits == end || !fits) {
    Fail(digits == end ? Code::kMissingValue : Code::kUnknownCode, from, digits == end ? from + 1 : end);
    return;
  }
  c.at = end;
  Token& token = Push(K::kCode, from, end);
  token.number = number;
  token.digits = static_cast<std::uint8_t>(end - digits);
  token.data = is_g ? FindGCode(number) : FindMCode(number);
  if (is_g && token.data == kAuxiliaryRow) {
    if (!IsRefusedGCode(number)) {
      Fail(Code::kUnknownCode, from, end);
      return;
    }
    token.kind = static_cast<std::uint16_t>(K::kRefused);
    if (refused_ == 0) refused_ = static_cast<std::uint32_t>(tokens_.size());
  }
}

// N10, :10, R5: a letter or sign and a whole number.
void TokenSource::LexNumberedWord(Cursor& c, K kind) {
  const char* from = c.at;
  const char* digits = SkipBlanks(from + 1, c.end);
  const char* end = SkipDigits(digits, c.end);
  std::uint32_t number = 0;
  if (digits == end || std::from_chars(digits, end, number).ec != std::errc() || end - digits > 200) {
    Fail(digits == end ? Code::kMissingValue : Code::kBadNumber, from, digits == end ? from + 1 : end);
    return;
  }
  c.at = end;
  Token& token = Push(kind, from, end);
  token.number = number;
  token.digits = static_cast<std::uint8_t>(end - digits);
}

}  // namespace ncport::frontend::sinumerik
