#include "base/encoding.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "base/utf8.h"

namespace ncport {

namespace {

// Bytes 128-159 of Windows-1252. The five bytes without a meaning stand for themselves.
constexpr std::array<char32_t, 32> kWindows1252{0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x008D, 0x017D, 0x008F,
                                                0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

constexpr std::string_view kBom = "\xEF\xBB\xBF";

// What tape readers and DNC lines leave in files: NUL, DC1-DC4 (reader and punch on, off), DEL (rubout).
bool IsTapeByte(unsigned char c) { return c == 0 || (c >= 0x11 && c <= 0x14) || c == 0x7F; }
constexpr bool IsLayout(unsigned char c) { return static_cast<unsigned char>(c - 0x09U) <= 0x0DU - 0x09U; }

// One look at every byte finds out whether there is anything to do: nearly all files are plain ASCII.
bool IsPlain(std::string_view bytes) {
  const auto is_odd = [](char byte) {
    const auto c = static_cast<unsigned char>(byte);
    // No `||`: without branches the compiler looks at many bytes at once.
    return static_cast<unsigned char>(
        static_cast<unsigned char>(c >= 0x7F) |
        static_cast<unsigned char>(static_cast<unsigned char>(c < 0x20) & static_cast<unsigned char>(!IsLayout(c))));
  };
  constexpr std::size_t kPiece = 64;
  std::size_t at = 0;
  for (; at + kPiece <= bytes.size(); at += kPiece) {
    const char* piece = bytes.data() + at;
    unsigned char odd = 0;
    for (std::size_t i = 0; i < kPiece; ++i) odd |= is_odd(piece[i]);
    if (odd != 0) return false;
  }
  unsigned char odd = 0;
  for (; at < bytes.size(); ++at) odd |= is_odd(bytes[at]);
  return odd == 0;
}

// Binary files are told by what text never has. Tape bytes are no sign of it by themselves: punched leaders are NULs.
std::string_view BinaryReason(std::string_view bytes) {
  struct Magic {
    std::string_view start;
    std::string_view reason;
  };
  static constexpr Magic kMagic[] = {
      {"\x7F"
       "ELF",
       "it starts like an executable"},
      {"MZ\x90", "it starts like an executable"},
      {"PK\x03\x04", "it starts like a ZIP archive"},
      {"\x1F\x8B", "it starts like a gzip archive"},
      {"%PDF-", "it starts like a PDF document"},
      {"\x89PNG", "it starts like a picture"},
      {"\xFF\xD8\xFF", "it starts like a picture"},
      {"GIF8", "it starts like a picture"},
      {"\xFF\xFE", "it starts like UTF-16; save it as UTF-8"},
      {"\xFE\xFF", "it starts like UTF-16; save it as UTF-8"},
      {"\xD0\xCF\x11\xE0", "it starts like an office document"},
  };
  for (const Magic& magic : kMagic) {
    if (bytes.starts_with(magic.start)) return magic.reason;
  }
  const std::size_t first = bytes.find_first_not_of('\0');
  if (first == std::string_view::npos) return bytes.empty() ? std::string_view{} : "it holds nothing but NUL bytes";
  const std::string_view body = bytes.substr(first, bytes.find_last_not_of('\0') + 1 - first);
  std::size_t control = 0;
  std::size_t tape = 0;
  for (const char c : body) {
    const auto byte = static_cast<unsigned char>(c);
    if (IsTapeByte(byte)) {
      ++tape;
    } else if (byte < 0x20 && !IsLayout(byte) && byte != 0x1A) {
      ++control;
    }
  }
  // One stray control byte in a small file is a slip; one in a hundred is another kind of file. Tape bytes between
  // blocks may be up to half of a text.
  if (control > 1 && control * 100 > body.size()) return "it holds control characters that no text has";
  if (tape * 2 > body.size()) return "most of its bytes are NUL";
  return {};
}

bool HasTapeMark(std::string_view text) {
  std::size_t at = 0;
  while ((at = text.find('%', at)) != std::string_view::npos) {
    const std::size_t before = text.find_last_not_of(" \t", at == 0 ? 0 : at - 1);
    const std::size_t after = text.find_first_not_of(" \t", at + 1);
    const bool starts = at == 0 || before == std::string_view::npos || text[before] == '\n' || text[before] == '\r';
    const bool ends = after == std::string_view::npos || text[after] == '\n' || text[after] == '\r';
    if (starts && ends) return true;
    ++at;
  }
  return false;
}

// Copies `bytes` without tape bytes and the final SUB of DOS editors.
std::string WithoutControl(std::string_view bytes, DecodedText& decoded) {
  const std::size_t all = bytes.size();
  while (!bytes.empty() && (bytes.back() == '\x1A' || IsTapeByte(static_cast<unsigned char>(bytes.back())))) {
    bytes.remove_suffix(1);
  }
  std::string text{bytes};
  std::erase_if(text, [](char c) { return IsTapeByte(static_cast<unsigned char>(c)); });
  decoded.control_bytes = all - text.size();
  return text;
}

std::string FromWindows1252(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    AppendUtf8(text, byte >= 0x80 && byte < 0xA0 ? kWindows1252[byte - 0x80U] : byte);
  }
  return text;
}

bool IsAscii(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// The byte of a character in Latin-1 or Windows-1252, or -1.
int ByteOf(char32_t c, Encoding encoding) {
  if (c < 0x80 || (c >= 0xA0 && c <= 0xFF)) return static_cast<int>(c);
  if (encoding == Encoding::kLatin1) return c < 0x100 ? static_cast<int>(c) : -1;
  if (encoding == Encoding::kAscii) return -1;
  const auto* const found = std::ranges::find(kWindows1252, c);
  return found == kWindows1252.end() ? -1 : static_cast<int>(0x80 + (found - kWindows1252.begin()));
}

}  // namespace

std::string_view NameOf(Encoding encoding) {
  switch (encoding) {
    case Encoding::kAscii:
      return "ASCII";
    case Encoding::kUtf8:
      return "UTF-8";
    case Encoding::kUtf8Bom:
      return "UTF-8 with byte order mark";
    case Encoding::kLatin1:
      return "Latin-1";
    case Encoding::kWindows1252:
      return "Windows-1252";
  }
  return {};
}

DecodedText DecodeText(std::string whole) {
  DecodedText decoded;
  if (IsPlain(whole)) {
    decoded.had_tape_mark = HasTapeMark(whole);
    decoded.text = std::move(whole);
    return decoded;
  }
  std::string_view bytes = whole;
  decoded.binary_reason = BinaryReason(bytes);
  if (!decoded.binary_reason.empty()) {
    decoded.is_binary = true;
    return decoded;
  }
  const bool bom = bytes.starts_with(kBom);
  if (bom) bytes.remove_prefix(kBom.size());
  decoded.had_nul = bytes.find('\0') != std::string_view::npos;
  std::string text = WithoutControl(bytes, decoded);
  if (IsValidUtf8(text)) {
    decoded.encoding = bom ? Encoding::kUtf8Bom : IsAscii(text) ? Encoding::kAscii : Encoding::kUtf8;
    decoded.text = std::move(text);
  } else {
    const bool has_c1 =
        std::ranges::any_of(text, [](char c) { return (static_cast<unsigned char>(c) & 0xE0U) == 0x80; });
    decoded.encoding = has_c1 ? Encoding::kWindows1252 : Encoding::kLatin1;
    decoded.text = FromWindows1252(text);
  }
  decoded.had_tape_mark = HasTapeMark(decoded.text);
  return decoded;
}

EncodedText EncodeBack(std::string_view text, Encoding encoding) {
  EncodedText encoded;
  if (encoding == Encoding::kUtf8 || encoding == Encoding::kUtf8Bom) {
    if (encoding == Encoding::kUtf8Bom) encoded.bytes = kBom;
    encoded.bytes += text;
    return encoded;
  }
  encoded.bytes.reserve(text.size());
  while (!text.empty()) {
    const Utf8Char c = FirstUtf8(text);
    const int byte = encoding == Encoding::kAscii && c.code >= 0x80 ? -1 : ByteOf(c.code, encoding);
    if (byte < 0) ++encoded.replaced;
    encoded.bytes.push_back(byte < 0 ? '?' : static_cast<char>(byte));
    text.remove_prefix(c.length);
  }
  return encoded;
}

}  // namespace ncport
