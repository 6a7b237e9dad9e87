// What a wrong word was probably meant to be. Texts in, texts out: nothing here decides whether a block is right.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ncport::frontend::sinumerik {

/// A word of another language and what this one has instead.
struct ForeignWord {
  std::string_view text;
  const char* help;
  std::string_view instead = {};  // the word that takes its place, if there is one
};
/// THEN, BREAK, NEXT ..; null for other words.
const ForeignWord* FindForeignWord(std::string_view word);

/// A comparison that other controls write as a word.
struct ForeignOperatorWord {
  std::string_view text;     // "GE"
  std::string_view meaning;  // "greater or equal"
  std::string_view sign;     // ">="
};
/// EQ, NE, GT, GE, LT, LE; null for other words.
const ForeignOperatorWord* FindForeignOperator(std::string_view word);

/// What this control has in place of a code of other controls: `G43`, `G28`, `G81`; null for codes that have no such
/// row. `code` as written, leading zeros do not count.
const char* InsteadOfCode(std::string_view code);

/// A word that begins a block, spelled nearly so, or nothing.
std::string_view NearStatementWord(std::string_view word);
/// A code with a name (DIAMON, BRISK), spelled nearly so, or nothing.
std::string_view NearCodeWord(std::string_view word);
/// A word that stands inside of blocks (AND, TO, GOTOF) or a function, spelled nearly so, or nothing.
std::string_view NearInnerWord(std::string_view word);
/// An address of several letters (CR, LIMS), spelled nearly so, or nothing.
std::string_view NearAddress(std::string_view word);
/// TRUE, FALSE or a function, spelled nearly so, or nothing.
std::string_view NearValueWord(std::string_view word);

/// `Xl0`, `GO`, `Rl`: letters for digits, written with digits. Empty: no such word.
std::string AsNumberWord(std::string_view word);
/// True if the word holds digits and the letters O, I, L only: `2OO`, `1O`, `OO`.
bool LooksLikeNumber(std::string_view word);
/// The same with digits only.
std::string AsDigits(std::string_view word);

/// `SPOS90`, `CR5`: an address of several letters and its value, written with `=`. Empty: no such word.
std::string AsAddressWithValue(std::string_view word);

/// `IC4`, `AC-3.5`: a mode of values and its value, written with brackets. Empty: no such word.
std::string AsModeWithValue(std::string_view word);
/// `TRANSX10`: a word that begins a block and an axis word, with the blank between them. Empty: no such word.
std::string AsWordAndAxis(std::string_view word);
/// What stands behind the first word of a block, for words that the next one runs into.
enum class Behind : std::uint8_t {
  kAnything,    // only what no name looks like may have run into the word: an address with its number
  kComparison,  // a comparison or GOTO: IF, WHILE, UNTIL
  kTo,          // TO: FOR
  kOf,          // OF: CASE
  kType,        // a type in brackets: PROC, EXTERN
};
/// `WHILER1`, `ENDIFG0`, `DEFREAL`: the first word of a block and what ran into it, with the blank between them. Empty:
/// no such word.
std::string AsRunTogether(std::string_view word, Behind behind = Behind::kAnything);
/// `TO3`, `ANDR1`: the same with a word inside of a block.
std::string AsRunTogetherInside(std::string_view word);
/// `REALX_A`: a type and a name. Empty: no such word.
std::string AsTypeAndName(std::string_view word);

/// `GOTOFREADY`: a jump word and its label, with the blank between them, in all ways that there are. Empty: no such
/// word.
std::string AsJumpAndLabel(std::string_view word);

}  // namespace ncport::frontend::sinumerik
