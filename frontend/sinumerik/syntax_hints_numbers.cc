// Digits, letters for digits and signs of numbers.
#include <algorithm>

#include "frontend/common/chars.h"
#include "frontend/sinumerik/syntax_hints.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

// `10.5.2`: the second point begins a number of its own.
bool SyntaxHints::TornNumber() {
  if (at_ == 0 || at_ >= tokens_.size() || !TextOf(at_).starts_with('.')) return false;
  const Token& before = tokens_[at_ - 1];
  if (before.End() != tokens_[at_].offset || !IsValue(Before())) return false;
  error_ = {.code = Code::kBadNumber, .begin = before.offset, .length = tokens_[at_].End() - before.offset};
  if (Before() == K::kCell)
    return Say("the number of an R parameter is whole; is a comma meant: {},{}?", TextOf(at_ - 1),
               TextOf(at_).substr(1));
  return Say("a number has one decimal point");
}

// `F2OO`, `=2OOO`: letters that stand for digits go on where the number ends.
bool SyntaxHints::LettersInNumber() {
  std::size_t letters = at_;
  if (error_.code == Code::kNotAlone) letters = TokenAt(error_.begin);
  if (letters == 0 || letters >= tokens_.size()) return false;
  const Token& before = tokens_[letters - 1];
  const std::string_view text = TextOf(letters);
  const bool number = KindAt(letters - 1) == K::kNumber || KindAt(letters - 1) == K::kAxisValue ||
                      KindAt(letters - 1) == K::kAddressValue || KindAt(letters - 1) == K::kCell;
  if (!number || before.End() != tokens_[letters].offset || !LooksLikeNumber(text)) return false;
  const std::string_view whole = line_.substr(before.offset, tokens_[letters].End() - before.offset);
  error_ = {.code = Code::kBadNumber, .begin = before.offset, .length = static_cast<std::uint32_t>(whole.size())};
  return Say("did you mean {}{}?", TextOf(letters - 1), AsDigits(text));
}

// `Z-l5`, `R1=-I0`: a letter for the first digit behind a sign begins a word of its own.
bool SyntaxHints::LettersBehindSign() {
  std::size_t letters = at_;
  if (Kind() == K::kMinus || Kind() == K::kPlus) ++letters;
  if (letters == 0 || letters >= tokens_.size()) return false;
  const Token& sign = tokens_[letters - 1];
  const K kind = KindAt(letters - 1);
  const std::string_view text = TextOf(letters);
  if ((kind != K::kMinus && kind != K::kPlus) || sign.End() != tokens_[letters].offset || !LooksLikeNumber(text) ||
      std::all_of(text.begin(), text.end(), IsDigit))
    return false;
  std::size_t first = letters - 1;
  const K before = first == 0 ? K::kNone : KindAt(first - 1);
  if ((before == K::kAxis || before == K::kAddress) && tokens_[first - 1].End() == sign.offset) --first;
  const std::string_view head = line_.substr(tokens_[first].offset, sign.End() - tokens_[first].offset);
  error_ = {.code = Code::kBadNumber,
            .begin = tokens_[first].offset,
            .length = tokens_[letters].End() - tokens_[first].offset};
  return Say("did you mean {}{}?", head, AsDigits(text));
}

// `Z--2`: two signs in front of a number.
bool SyntaxHints::SecondSign() {
  if (at_ == 0 || at_ >= tokens_.size() || tokens_[at_ - 1].End() != tokens_[at_].offset) return false;
  const K next = KindAt(at_ + 1);
  if (IsOperator(Kind()) && (Before() == K::kAxisValue || Before() == K::kAddressValue) && StartsValue(next)) {
    const std::string_view word = TextOf(at_ - 1);
    return Say("a value that is computed stands behind =: {}={}{}{}", word.substr(0, 1), word.substr(1), TextOf(at_),
               TextOf(at_ + 1));
  }
  if (Kind() != K::kMinus && Kind() != K::kPlus) return false;
  if (Before() != K::kAxis && Before() != K::kAddress) return false;
  error_.code = Code::kUnexpectedText;
  error_.detail = nullptr;
  if (next == K::kMinus || next == K::kPlus) return Say("a number has one sign");
  if (!StartsValue(next)) return Say("a value is missing behind {}", TextOf(at_));
  return Say("a value that is computed stands behind =");
}

std::size_t SyntaxHints::TokenAt(std::uint32_t offset) const {
  std::size_t token = 0;
  while (token < tokens_.size() && tokens_[token].offset != offset) ++token;
  return token;
}

}  // namespace ncport::frontend::sinumerik
