#include "base/number_text.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <string_view>

namespace ncport {

namespace {

struct Parsed {
  bool ok;
  std::size_t length;
  DecimalText number;
};

Parsed Parse(std::string_view text) {
  const char* p = text.data();
  Parsed parsed{};
  parsed.ok = ParseDecimal(p, text.data() + text.size(), parsed.number);
  parsed.length = static_cast<std::size_t>(p - text.data());
  return parsed;
}

std::string Again(const DecimalText& number) {
  TextBuffer buffer;
  AppendNumber(buffer, number.value, number.int_digits, number.decimals, number.has_point);
  return std::string{buffer.View()};
}

std::string Number(double value, int int_digits, int decimals, bool has_point) {
  TextBuffer buffer;
  AppendNumber(buffer, value, static_cast<std::uint8_t>(int_digits), static_cast<std::uint8_t>(decimals), has_point);
  return std::string{buffer.View()};
}

std::string Trimmed(double value, int decimals) {
  TextBuffer buffer;
  AppendTrimmed(buffer, value, decimals);
  return std::string{buffer.View()};
}

// The same by way of the exact decimal expansion, digit by digit: 1100 decimals hold every double.
std::string TrimmedSlowly(double value, int decimals) {
  std::string digits = fmt::format("{:.1100f}", std::fabs(value));
  const std::size_t point = digits.find('.');
  const bool up = digits[point + 1 + static_cast<std::size_t>(decimals)] >= '5';
  digits.resize(point + 1 + static_cast<std::size_t>(decimals));
  if (up) {
    std::size_t at = digits.size();
    while (at > 0) {
      --at;
      if (digits[at] == '.') continue;
      if (digits[at] != '9') {
        ++digits[at];
        break;
      }
      digits[at] = '0';
      if (at == 0) digits.insert(digits.begin(), '1');
    }
  }
  while (digits.back() == '0') digits.pop_back();
  if (digits.back() == '.') digits.pop_back();
  return value < 0 && digits != "0" ? "-" + digits : digits;
}

}  // namespace

TEST_CASE("a literal is read with the form it was written in") {
  const Parsed parsed = Parse("-007.50X3");
  REQUIRE(parsed.ok);
  CHECK(parsed.length == 7);
  CHECK(parsed.number.value == -7.5);
  CHECK(parsed.number.int_digits == 3);
  CHECK(parsed.number.decimals == 2);
  CHECK(parsed.number.has_point);
  CHECK(parsed.number.exact);
  CHECK(Again(parsed.number) == "-007.50");
}

TEST_CASE("forms that programs contain come back as written") {
  for (const char* text : {"0",
                           "1",
                           "00",
                           "007",
                           "5.",
                           ".5",
                           "0.5",
                           "-.5",
                           "-0",
                           "-0.",
                           "-.0",
                           ".000",
                           "100.",
                           "0.1",
                           "123.456",
                           "1000000",
                           "99999.999",
                           "0.000001",
                           "901050",
                           "30003.036",
                           "-12345678.1234567",
                           "4503599627370495",
                           "0.30000000000000004",
                           "9007199254740992",
                           "9007199254740993000",
                           "00000000000000000000000001.5"}) {
    CAPTURE(text);
    const Parsed parsed = Parse(text);
    REQUIRE(parsed.ok);
    CHECK(parsed.length == std::string_view(text).size());
    CHECK(parsed.number.value == std::strtod(text, nullptr));
    CHECK(std::signbit(parsed.number.value) == (text[0] == '-'));
    CHECK(parsed.number.exact == (Again(parsed.number) == text));
  }
  for (const char* text :
       {"0", "-0", "5.", ".5", "-.0", "123.456", "4503599627370495", "00000000000000000000000001.5"}) {
    CHECK(Parse(text).number.exact);
  }
}

TEST_CASE("reading stops where the number ends") {
  CHECK(Parse("1.2.3").length == 3);
  CHECK(Parse("10E5").length == 2);
  CHECK(Parse("5-3").length == 1);
  CHECK(Parse("+4").length == 2);
  CHECK(Parse("3..").length == 2);
}

TEST_CASE("no digit is no number and moves nothing") {
  for (const char* text : {"", "-", "+", ".", "-.", "+.", "X", "--1", "-+1", " 1"}) {
    CAPTURE(text);
    const Parsed parsed = Parse(text);
    CHECK_FALSE(parsed.ok);
    CHECK(parsed.length == 0);
    CHECK(parsed.number.value == 0);
  }
}

TEST_CASE("a plus sign and digits that a double lacks are known not to come back") {
  CHECK_FALSE(Parse("+5.0").number.exact);
  CHECK(Parse("+5.0").number.value == 5);
  CHECK_FALSE(Parse("9007199254740993").number.exact);
  CHECK_FALSE(Parse("0.1234567890123456789").number.exact);
  CHECK_FALSE(Parse(std::string(300, '1')).number.exact);
  CHECK_FALSE(Parse("1." + std::string(300, '0')).number.exact);
  CHECK(Parse("1." + std::string(300, '0')).number.value == 1);
  CHECK(Parse("1." + std::string(200, '0')).number.exact);
}

TEST_CASE("huge and tiny literals") {
  CHECK(std::isinf(Parse(std::string(400, '9')).number.value));
  CHECK_FALSE(Parse(std::string(400, '9')).number.exact);
  CHECK(Parse("0." + std::string(400, '0') + "1").number.value == 0);
  CHECK(Parse(std::string(400, '0') + "1").number.value == 1);
  CHECK(Parse("0." + std::string(400, '0')).number.value == 0);
}

TEST_CASE("fixed decimals") {
  CHECK(Number(1.5, 0, 3, true) == "1.500");
  CHECK(Number(0.25, 0, 3, true) == ".250");
  CHECK(Number(0.25, 1, 3, true) == "0.250");
  CHECK(Number(10, 0, 0, true) == "10.");
  CHECK(Number(10, 0, 0, false) == "10");
  CHECK(Number(0, 0, 0, false) == "0");
  CHECK(Number(7, 4, 0, false) == "0007");
  CHECK(Number(0.9999, 0, 3, true) == "1.000");
  CHECK(Number(-0.0004, 1, 3, true) == "-0.000");
  CHECK(Number(7, 40, 1, true) == std::string(39, '0') + "7.0");
  CHECK(Number(1e18, 0, 2, true) == "1000000000000000000.00");
  CHECK(Number(1e300, 0, 0, true) == fmt::format("{:.0f}.", 1e300));
  CHECK(Number(0.5, 0, 30, true) == ".5" + std::string(29, '0'));
  CHECK(Number(1e18, 25, 0, false) == std::string(6, '0') + "1" + std::string(18, '0'));
}

TEST_CASE("trimmed decimals") {
  CHECK(Trimmed(0, 6) == "0");
  CHECK(Trimmed(-0.0, 6) == "0");
  CHECK(Trimmed(-0.0000004, 6) == "0");
  CHECK(Trimmed(-0.0000006, 6) == "-0.000001");
  CHECK(Trimmed(100, 3) == "100");
  CHECK(Trimmed(1.25, 1) == "1.3");
  CHECK(Trimmed(-1.25, 1) == "-1.3");
  CHECK(Trimmed(0.5, 0) == "1");
  CHECK(Trimmed(2.5, 0) == "3");
  CHECK(Trimmed(2.675, 2) == "2.67");  // the double is 2.67499999999999982236431605997495353221893310546875
  CHECK(Trimmed(0.0005, 3) == "0.001");
  CHECK(Trimmed(999999.9999999, 6) == "1000000");
  CHECK(Trimmed(1.5, 0) == "2");
  CHECK(Trimmed(123456789012345.678, 3) == "123456789012345.672");
  CHECK(Trimmed(1e15, 6) == "1000000000000000");
  CHECK(Trimmed(-1e22, 6) == "-10000000000000000000000");
  CHECK(Trimmed(0.1, 25) == "0.1000000000000000055511151");
  CHECK(Trimmed(1e12 + 0.001953125, 8) == TrimmedSlowly(1e12 + 0.001953125, 8));
  CHECK(Trimmed(5e-324, 19) == "0");
  CHECK(Trimmed(std::numeric_limits<double>::min(), 6) == "0");
}

TEST_CASE("whole numbers") {
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{9}, std::int64_t{10}, std::int64_t{99}, std::int64_t{100},
        std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
    TextBuffer buffer;
    AppendInteger(buffer, value);
    CHECK(buffer.View() == std::to_string(value));
  }
  std::int64_t power = 1;
  for (int i = 0; i < 18; ++i) {
    power *= 10;
    for (const std::int64_t value : {power - 1, power, power + 1}) {
      TextBuffer buffer;
      AppendInteger(buffer, value);
      REQUIRE(buffer.View() == std::to_string(value));
    }
  }
}

TEST_CASE("random literals: value as strtod, text as written") {
  std::mt19937_64 random(1);
  for (int turn = 0; turn < 200000; ++turn) {
    std::string text = random() % 3 == 0 ? "-" : "";
    const std::size_t whole = random() % (turn % 10 == 0 ? 22 : 7);
    const std::size_t decimals = random() % (turn % 10 == 1 ? 24 : 6);
    for (std::size_t i = 0; i < whole; ++i) text += static_cast<char>('0' + random() % 10);
    if (decimals > 0 || random() % 2 == 0) text += '.';
    for (std::size_t i = 0; i < decimals; ++i) text += static_cast<char>('0' + random() % 10);
    CAPTURE(text);
    const Parsed parsed = Parse(text);
    REQUIRE(parsed.ok == (whole + decimals > 0));
    if (!parsed.ok) continue;
    REQUIRE(parsed.length == text.size());
    REQUIRE(parsed.number.value == std::strtod(text.c_str(), nullptr));
    REQUIRE(parsed.number.exact == (Again(parsed.number) == text));
    if (whole + decimals <= 15) {
      REQUIRE(parsed.number.exact);
    }
  }
}

TEST_CASE("random values: rounded once, exactly") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-12, 17);
  for (int turn = 0; turn < 20000; ++turn) {
    const int decimals = static_cast<int>(random() % 13);
    double value = std::pow(10, exponent(random));
    if (turn % 3 == 0) {  // ties and near ties: k/2^n, and decimal halves
      value = static_cast<double>(random() % 1000000) / static_cast<double>(1U << (random() % 20));
    } else if (turn % 3 == 1) {
      value = (static_cast<double>(random() % 1000000) + 0.5) / std::pow(10, decimals);
    }
    if (random() % 2 == 0) value = -value;
    CAPTURE(fmt::format("{:.17g} {}", value, decimals));
    REQUIRE(Trimmed(value, decimals) == TrimmedSlowly(value, decimals));
  }
}

TEST_CASE("printing with enough decimals and reading gives the value back") {
  std::mt19937_64 random(3);
  for (int turn = 0; turn < 50000; ++turn) {
    const double value = static_cast<double>(static_cast<std::int64_t>(random() % 2000000000000) - 1000000000000) / 1e6;
    const std::string text = Trimmed(value, 6);
    CAPTURE(text);
    REQUIRE(Parse(text).number.value == value);
  }
}

}  // namespace ncport
