#include "base/encoding.h"

#include <doctest/doctest.h>

#include <random>
#include <string>

#include "base/utf8.h"

namespace ncport {

namespace {

std::string RoundTrip(const std::string& bytes) {
  const DecodedText decoded = DecodeText(bytes);
  const EncodedText encoded = EncodeBack(decoded.text, decoded.encoding);
  CHECK(encoded.replaced == 0);
  return encoded.bytes;
}

}  // namespace

TEST_CASE("plain text stays as it is") {
  const DecodedText decoded = DecodeText("G1 X10\r\nM30\r");
  CHECK(decoded.encoding == Encoding::kAscii);
  CHECK(decoded.text == "G1 X10\r\nM30\r");
  CHECK(decoded.control_bytes == 0);
  CHECK_FALSE(decoded.had_nul);
  CHECK_FALSE(decoded.had_tape_mark);
  CHECK_FALSE(decoded.is_binary);
  CHECK(DecodeText("").text.empty());
  CHECK_FALSE(DecodeText("").is_binary);
}

TEST_CASE("UTF-8 is known by being valid, with or without a byte order mark") {
  CHECK(DecodeText("; \xC3\xA4\n").encoding == Encoding::kUtf8);
  const DecodedText bom = DecodeText("\xEF\xBB\xBF; \xC3\xA4\n");
  CHECK(bom.encoding == Encoding::kUtf8Bom);
  CHECK(bom.text == "; \xC3\xA4\n");
  CHECK(RoundTrip("\xEF\xBB\xBF; \xC3\xA4\n") == "\xEF\xBB\xBF; \xC3\xA4\n");
}

TEST_CASE("a single byte page is read as Latin-1 or Windows-1252") {
  const DecodedText latin = DecodeText("; f\xFCr \xD8 10\n");
  CHECK(latin.encoding == Encoding::kLatin1);
  CHECK(latin.text == "; f\xC3\xBCr \xC3\x98 10\n");
  const DecodedText windows = DecodeText("; \x80 5\n");
  CHECK(windows.encoding == Encoding::kWindows1252);
  CHECK(windows.text == "; \xE2\x82\xAC 5\n");
}

TEST_CASE("every byte above 127 comes back, also of pages that are only guessed") {
  std::string all = "; ";
  for (int byte = 0x80; byte < 0x100; ++byte) all += static_cast<char>(byte);
  CHECK(RoundTrip(all) == all);
  const std::string gbk = "(\xB5\xB6\xBE\xDF)\n";
  CHECK(RoundTrip(gbk) == gbk);
  std::mt19937 random(4);
  for (int turn = 0; turn < 2000; ++turn) {
    std::string bytes = "X1 ";
    for (unsigned i = random() % 40; i > 0; --i) {
      bytes += static_cast<char>(random() % 2 == 0 ? 0x20 + random() % 0x5F : 0x80 + random() % 0x80);
    }
    REQUIRE(RoundTrip(bytes) == bytes);
    REQUIRE(IsValidUtf8(DecodeText(bytes).text));
  }
}

TEST_CASE("NULs and tape bytes are left out and counted") {
  const DecodedText decoded = DecodeText(std::string("\0\0\0\0%\r\nO1\x11 G0\x7F\r\n%\x13\x1A\0", 20));
  CHECK_FALSE(decoded.is_binary);
  CHECK(decoded.had_nul);
  CHECK(decoded.had_tape_mark);
  CHECK(decoded.text == "%\r\nO1 G0\r\n%");
  CHECK(decoded.control_bytes == 9);
  CHECK(DecodeText("M30\n\x1A").text == "M30\n");
}

TEST_CASE("a tape mark is a line of its own") {
  CHECK(DecodeText("%").had_tape_mark);
  CHECK(DecodeText("  % \nO1\n").had_tape_mark);
  CHECK(DecodeText("O1\n%\n").had_tape_mark);
  CHECK(DecodeText("O1\r%").had_tape_mark);
  CHECK_FALSE(DecodeText("%1000\nG0\n").had_tape_mark);
  CHECK_FALSE(DecodeText("%_N_PART_MPF\n").had_tape_mark);
  CHECK_FALSE(DecodeText("(50 %)\n").had_tape_mark);
  CHECK_FALSE(DecodeText("A %\n").had_tape_mark);
}

TEST_CASE("what is not text is refused with the reason") {
  CHECK(DecodeText("\x7F"
                   "ELF\x02\x01\x01")
            .binary_reason == "it starts like an executable");
  CHECK(DecodeText("\xFF\xFEG\0").binary_reason == "it starts like UTF-16; save it as UTF-8");
  CHECK(DecodeText(std::string(100, '\0')).is_binary);
  std::string noise;
  std::mt19937 random(5);
  for (int i = 0; i < 4000; ++i) noise += static_cast<char>(random());
  CHECK(DecodeText(noise).is_binary);
  CHECK(DecodeText(noise).text.empty());
  std::string wide;
  for (const char c : std::string("G1 X10 Y20\n")) {
    wide += c;
    wide += std::string(2, '\0');
  }
  CHECK(DecodeText(wide).is_binary);
}

TEST_CASE("one stray control byte is no reason to refuse") { CHECK_FALSE(DecodeText("G0 X1\x01\nM30\n").is_binary); }

TEST_CASE("characters that the page lacks are replaced and counted") {
  const EncodedText latin = EncodeBack("a\xE2\x82\xAC\xC3\xA4\xE4\xBD\xA0", Encoding::kLatin1);
  CHECK(latin.bytes == "a?\xE4?");
  CHECK(latin.replaced == 2);
  CHECK(EncodeBack("\xC3\xA4", Encoding::kAscii).bytes == "?");
  CHECK(EncodeBack("\xE2\x82\xAC", Encoding::kWindows1252).bytes == "\x80");
}

TEST_CASE("UTF-8 that is none") {
  for (const char* bad : {"\x80", "\xC0\xAF", "\xC1\x81", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF0\x80\x80\xAF",
                          "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xC3", "\xE2\x82", "\xC3(", "\xFF"}) {
    CHECK_FALSE(IsValidUtf8(bad));
  }
  CHECK(CountUtf8("\xC3\xA4"
                  "b\xE2\x82\xAC\xF0\x9F\x98\x80") == 4);
  CHECK(CountUtf8("\xC3"
                  "b") == 2);
  std::string all;
  for (const char32_t code : {0x24, 0x7F, 0x80, 0x7FF, 0x800, 0xFFFD, 0x10000, 0x10FFFF}) {
    std::string one;
    AppendUtf8(one, code);
    CHECK(FirstUtf8(one).code == code);
    CHECK(FirstUtf8(one).length == one.size());
    all += one;
  }
  CHECK(IsValidUtf8(all));
}

}  // namespace ncport
