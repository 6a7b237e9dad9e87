#include "ir/ops/text.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace ncport::ir::ops {

namespace {

std::string Written(double value) {
  TextBuffer buffer;
  AppendNumberText(buffer, value);
  return std::string(buffer.View());
}

std::string Formatted(std::string_view format, std::vector<FormatValue> values) {
  TextBuffer buffer;
  const Error error = Format(buffer, format, values);
  return error == Error::kNone ? std::string(buffer.View()) : std::string("error");
}

FormatValue Num(double value) { return {false, value, {}}; }
FormatValue Str(std::string_view text) { return {true, 0, text}; }

}  // namespace

TEST_CASE("numbers as text: ten decimals, no trailing zeros") {
  CHECK(Written(9.654) == "9.654");
  CHECK(Written(3) == "3");
  CHECK(Written(-0.5) == "-0.5");
  CHECK(Written(1.0 / 3) == "0.3333333333");
  CHECK(Written(0.1 + 0.2) == "0.3");
}

TEST_CASE("text as number") {
  CHECK(ParseNumber("1234.9876EX-7").value == 1234.9876e-7);
  CHECK(ParseNumber("1.5EX2").value == 150);
  CHECK(ParseNumber(" -.5 ").value == -0.5);
  CHECK(ParseNumber("+10.").value == 10);
  CHECK(ParseNumber("1ex+3").value == 1000);
  for (const char* bad : {"", "12A", "1E3", "1EX", "EX3", "1.2.3", "-", ".", "1 2", "1EX999"})
    CHECK(!ParseNumber(bad).Ok());
}

TEST_CASE("positions count characters, not bytes") {
  const std::string_view text = "M\xC3\xBCller M";
  CHECK(Length(text) == 8);
  CHECK(CharacterAt(text, 1).code == 0xFC);
  CHECK(IndexOf(text, 'l') == 2);
  CHECK(IndexOf(text, 0xFC) == 1);
  CHECK(IndexOf(text, 'x') == -1);
  CHECK(LastIndexOf(text, 'M') == 7);
  CHECK(IndexOfAny(text, "re") == 4);
  CHECK(Find(text, "ller") == 2);
  CHECK(Find(text, "Ler") == -1);
  CHECK(Substring(text, 1, 2) == "\xC3\xBCl");
  CHECK(Substring(text, 6, 100) == " M");
  CHECK(Substring(text, 20, 1).empty());
  TextBuffer buffer;
  AppendCharacter(buffer, 0xFC);
  AppendUpper(buffer, "aZ1");
  AppendLower(buffer, "aZ1");
  AppendCharacter(buffer, 0);
  CHECK(buffer.View() ==
        "\xC3\xBC"
        "AZ1az1");
}

TEST_CASE("SPRINT formats (sinumerik-4.6)") {
  CHECK(Formatted("%d|%5d|%-5d|%05d", {Num(42.4), Num(42), Num(42), Num(-42)}) == "42|   42|42   |-0042");
  CHECK(Formatted("%f|%8.3f|%.0f", {Num(2.5), Num(2.5), Num(2.4)}) == "2.500000|   2.500|2");
  CHECK(Formatted("%s %s 100%%", {Str("a"), Num(1.5)}) == "a 1.5 100%");
  CHECK(Formatted("%x %b %c", {Num(255), Num(5), Num(65)}) == "FF 101 A");
  CHECK(Formatted("%.2e %g", {Num(12345), Num(0.5)}) == "1.23e+04 0.5");
  CHECK(Formatted("%d", {}) == "error");
  CHECK(Formatted("%d", {Str("a")}) == "error");
  CHECK(Formatted("%q", {Num(1)}) == "error");
  CHECK(Formatted("%999999999999d", {Num(1)}) == "error");
  CHECK(Formatted("%", {Num(1)}) == "error");
}

TEST_CASE("names compare without case") {
  CHECK(SameName("Label_1", "LABEL_1"));
  CHECK(!SameName("LABEL_1", "LABEL_10"));
}

}  // namespace ncport::ir::ops
