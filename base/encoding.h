// Bytes of a program file to UTF-8 text and back. Real files are ASCII, UTF-8, single-byte pages or GBK, with NULs and
// tape control bytes between the blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ncport {

enum class Encoding : std::uint8_t {
  kAscii,
  kUtf8,
  kUtf8Bom,
  kLatin1,       // bytes 128-159 do not occur
  kWindows1252,  // also stands in for GBK and all other pages: each byte maps to one character and back
};

/// "ASCII", "UTF-8" ...
std::string_view NameOf(Encoding encoding);

struct DecodedText {
  std::string text;  // UTF-8, without byte order mark, NULs and tape control bytes
  Encoding encoding = Encoding::kAscii;
  bool had_nul = false;
  bool had_tape_mark = false;      // a line holds nothing but % (and blanks)
  std::size_t control_bytes = 0;   // NUL, DC1-DC4, DEL, final SUB: left out of `text`
  bool is_binary = false;          // not a program; `text` is empty
  std::string_view binary_reason;  // why, in plain words
};

/// Decodes a whole file. Bytes above 127 that are not UTF-8 throughout are read as Windows-1252, its five holes as
/// U+0081 ..., so that EncodeBack gives every byte back. Takes the bytes over: text that needs no decoding is not
/// copied.
DecodedText DecodeText(std::string bytes);

struct EncodedText {
  std::string bytes;
  std::size_t replaced = 0;  // characters that the encoding lacks, written as '?'
};

/// The bytes of `text` (UTF-8) in `encoding`.
EncodedText EncodeBack(std::string_view text, Encoding encoding);

}  // namespace ncport
