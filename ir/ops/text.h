// Texts: numbers to text and back, and the string functions. Positions count characters from 0; a character is a code
// point, so that texts from other code pages count as on the control.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/text_buffer.h"
#include "ir/ops/result.h"

namespace ncport::ir::ops {

/// As `<<` writes a number (sinumerik-4.6): up to 10 decimals, no trailing zeros, whole numbers without a point.
void AppendNumberText(TextBuffer& buffer, double value);
/// The character with this code (0..255) as UTF-8; code 0 appends nothing, as it ends a string.
void AppendCharacter(TextBuffer& buffer, double code);

/// The number that `text` is as a whole: sign, digits with at most one point, exponent `EX` with sign, blanks around
/// it. kConversion if it is none.
Number ParseNumber(std::string_view text);

/// Number of characters.
std::size_t Length(std::string_view text);
/// Byte offset of the character at `index`; text.size() when there are not so many.
std::size_t OffsetOf(std::string_view text, std::size_t index);
/// Code of the character that starts at byte `offset` (< size), and how many bytes it has.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
};
Character CharacterAt(std::string_view text, std::size_t offset);
/// First, last position of the character with this code; -1 = none.
std::int64_t IndexOf(std::string_view text, std::uint32_t code);
std::int64_t LastIndexOf(std::string_view text, std::uint32_t code);
/// First position of any character of `set`; -1 = none.
std::int64_t IndexOfAny(std::string_view text, std::string_view set);
/// Position of the part `part`; -1 = none.
std::int64_t Find(std::string_view text, std::string_view part);
/// `count` characters from `first`, fewer when the text ends before.
std::string_view Substring(std::string_view text, std::size_t first, std::size_t count);
void AppendUpper(TextBuffer& buffer, std::string_view text);
void AppendLower(TextBuffer& buffer, std::string_view text);
/// Texts that name the same thing in languages without case (labels, programs, axes): letters A-Z compare without case.
bool SameName(std::string_view a, std::string_view b);

/// `value` with exactly `decimals` digits behind the point (none: no point) and at most `whole` before it: higher ones
/// are lost (fanuc-10). `pads`: blanks for leading zeros, and a blank in the place of a missing sign.
void AppendFixedText(TextBuffer& buffer, double value, int whole, int decimals, bool pads);

/// One value of Format.
struct FormatValue {
  bool is_text = false;
  double number = 0;
  std::string_view text;
};
/// SPRINT (sinumerik-4.6): %d %f %e %g %s %x %b %c %% with width and precision; the width pads left with blanks, `-`
/// right, `0` with zeros. %f without precision has 6 decimals. An unknown letter, a missing value or a text where a
/// number is needed is kConversion.
Error Format(TextBuffer& buffer, std::string_view format, std::span<const FormatValue> values);

}  // namespace ncport::ir::ops
