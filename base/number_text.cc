#include "base/number_text.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "base/result.h"

namespace ncport {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr int kMaxFastDecimals = 19;  // 10^19 is the largest power of ten in 64 bits
constexpr std::uint64_t kTenTo[] = {1ULL,
                                    10ULL,
                                    100ULL,
                                    1000ULL,
                                    10000ULL,
                                    100000ULL,
                                    1000000ULL,
                                    10000000ULL,
                                    100000000ULL,
                                    1000000000ULL,
                                    10000000000ULL,
                                    100000000000ULL,
                                    1000000000000ULL,
                                    10000000000000ULL,
                                    100000000000000ULL,
                                    1000000000000000ULL,
                                    10000000000000000ULL,
                                    100000000000000000ULL,
                                    1000000000000000000ULL,
                                    10000000000000000000ULL};

// All of these are doubles without rounding, so a mantissa below 2^53 divided by one is correctly rounded.
constexpr double kTenToDouble[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t kMantissaLimit = 1ULL << 53U;
// Largest mantissa whose literal surely comes back: the quotient is off by less than half of its last digit.
constexpr std::uint64_t kSurelyExact = 1ULL << 52U;
constexpr int kMaxMantissaDigits = 19;
constexpr int kMaxWritten = 255;  // digits before or behind the point that DecimalText can count

constexpr char kPairs[] =
    "000102030405060708091011121314151617181920212223242526272829303132333435363738394041424344454647484950515253545556"
    "57585960"
    "616263646566676869707172737475767778798081828384858687888990919293949596979899";

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

int CountDigits(std::uint64_t number) {
  // 1233/4096 is log10(2); the table corrects the guess. The lowest bit makes 0 a number of one digit and changes no
  // other.
  number |= 1U;
  const int guess = (static_cast<int>(std::bit_width(number)) * 1233) >> 12;
  return guess + (number >= kTenTo[guess] ? 1 : 0);
}

// Writes the last `count` digits of `number`, with leading zeros, to [at, at + count).
void PutDigits(char* at, std::uint64_t number, int count) {
  char* p = at + count;
  while (count >= 2) {
    p -= 2;
    std::memcpy(p, kPairs + (number % 100) * 2, 2);
    number /= 100;
    count -= 2;
  }
  if (count == 1) *at = static_cast<char>('0' + number % 10);
}

// A non-negative number rounded to a fixed number of decimals: whole + fraction / 10^decimals.
struct Fixed {
  std::uint64_t whole;
  std::uint64_t fraction;
};

// value * 10^decimals rounded, halves up, exactly: the product of the 53-bit mantissa and 10^decimals fits in 128 bits,
// and a negative exponent is a shift. For 0 <= value < 2^53 and a result below 2^64, which is the caller's care.
std::uint64_t Scale(double value, int decimals) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto field = static_cast<int>(bits >> 52U);
  std::uint64_t mantissa = bits & (kSurelyExact - 1);
  if (field != 0) mantissa |= kSurelyExact;
  const int shift = 1075 - (field == 0 ? 1 : field);
  const Wide product = static_cast<Wide>(mantissa) * kTenTo[decimals];
  if (shift == 0) return static_cast<std::uint64_t>(product);
  if (shift > 126) return 0;  // the product has at most 117 bits, so this is below one half
  return static_cast<std::uint64_t>((product + (Wide{1} << static_cast<unsigned>(shift - 1))) >>
                                    static_cast<unsigned>(shift));
}

// For 0 <= value < 2^53 and decimals up to kMaxFastDecimals.
Fixed Round(double value, int decimals) {
  const std::uint64_t power = kTenTo[decimals];
  if (value * kTenToDouble[decimals] < 9e18) {
    const std::uint64_t scaled = Scale(value, decimals);
    return {scaled / power, scaled % power};
  }
  // Large values with many decimals: the parts one by one. Cutting off the whole part is exact.
  const auto whole = static_cast<std::uint64_t>(value);
  const std::uint64_t fraction = Scale(value - static_cast<double>(whole), decimals);
  return fraction == power ? Fixed{whole + 1, 0} : Fixed{whole, fraction};
}

bool IsFast(double magnitude, int decimals) {
  return magnitude < static_cast<double>(kMantissaLimit) && decimals <= kMaxFastDecimals;
}

// Beyond 2^53 a double is a whole number; with 20 and more decimals speed does not matter. fmt prints the exact value.
fmt::memory_buffer SlowText(double magnitude, int decimals) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{:.{}f}", magnitude, decimals);
  return text;
}

void AppendSlow(TextBuffer& buffer, double magnitude, int int_digits, int decimals, bool has_point) {
  const fmt::memory_buffer text = SlowText(magnitude, decimals);
  std::string_view digits{text.data(), text.size()};
  const std::size_t whole = decimals > 0 ? digits.size() - static_cast<std::size_t>(decimals) - 1 : digits.size();
  if (int_digits == 0 && decimals > 0 && digits.starts_with("0.")) digits.remove_prefix(1);
  for (std::size_t count = whole; count < static_cast<std::size_t>(int_digits); ++count) buffer.Append('0');
  buffer.Append(digits);
  if (has_point && decimals == 0) buffer.Append('.');
}

// Whether printing the literal [begin, end) from its fields gives it back. Only for literals with more than 15 digits.
bool ComesBack(const char* begin, const char* end, const DecimalText& number) {
  if (!std::isfinite(number.value)) return false;
  TextBuffer text;
  AppendNumber(text, number.value, number.int_digits, number.decimals, number.has_point);
  return text.View() == std::string_view{begin, static_cast<std::size_t>(end - begin)};
}

double SlowValue(const char* begin, const char* end) {
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value, std::chars_format::fixed);
  if (error != std::errc::result_out_of_range) return value;
  // from_chars leaves the value alone on overflow and underflow. Which one it was: a digit other than 0 before the
  // point.
  for (const char* p = begin; p < end && *p != '.'; ++p) {
    if (*p >= '1' && *p <= '9') return std::numeric_limits<double>::infinity();
  }
  return 0;
}

}  // namespace

bool ParseDecimal(const char*& p, const char* end, DecimalText& number) {
  const char* const begin = p;
  const char* at = p;
  const bool has_sign = at < end && (*at == '-' || *at == '+');
  const bool negative = has_sign && *at == '-';
  if (has_sign) ++at;
  const char* const digits = at;

  std::uint64_t mantissa = 0;  // right while there are at most 19 digits after leading zeros; wraps harmlessly else
  while (at < end && *at == '0') ++at;
  const char* const leading = at;
  while (at < end && IsDigit(*at)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
  const auto whole = at - digits;
  auto significant = at - leading;
  std::ptrdiff_t decimals = 0;
  const bool has_point = at < end && *at == '.';
  if (has_point) {
    const char* const point = at++;
    while (at < end && IsDigit(*at)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
    decimals = at - point - 1;
    significant += decimals;
  }
  if (whole + decimals == 0) return false;

  const bool counted = whole <= kMaxWritten && decimals <= kMaxWritten;
  const bool fast = significant <= kMaxMantissaDigits && mantissa <= kMantissaLimit &&
                    decimals < static_cast<std::ptrdiff_t>(std::size(kTenToDouble));
  const double magnitude = fast ? static_cast<double>(mantissa) / kTenToDouble[decimals] : SlowValue(digits, at);
  number.value = negative ? -magnitude : magnitude;
  number.int_digits = static_cast<std::uint8_t>(counted ? whole : 0);
  number.decimals = static_cast<std::uint8_t>(counted ? decimals : 0);
  number.has_point = has_point;
  if (!counted || (has_sign && !negative)) {
    number.exact = false;
  } else if (fast && mantissa < kSurelyExact && decimals <= kMaxFastDecimals) {
    number.exact = true;
  } else {
    number.exact = ComesBack(begin, at, number);
  }
  p = at;
  return true;
}

void AppendNumber(TextBuffer& buffer, double value, std::uint8_t int_digits, std::uint8_t decimals, bool has_point) {
  NCPORT_CHECK(std::isfinite(value), "number {} cannot be printed", value);
  if (std::signbit(value)) buffer.Append('-');
  const double magnitude = std::fabs(value);
  if (!IsFast(magnitude, decimals)) {
    AppendSlow(buffer, magnitude, int_digits, decimals, has_point);
    return;
  }
  const Fixed fixed = Round(magnitude, decimals);
  int width = fixed.whole == 0 ? 0 : CountDigits(fixed.whole);
  if (width < int_digits) width = int_digits;
  if (width == 0 && decimals == 0) width = 1;  // never a number without digits
  char* p = buffer.Reserve(static_cast<std::size_t>(width) + decimals + 1);
  if (width > 20) {  // PutDigits would go on with zeros, but pairs of a zero number are slow
    std::memset(p, '0', static_cast<std::size_t>(width - 20));
    p += width - 20;
    width = 20;
  }
  PutDigits(p, fixed.whole, width);
  p += width;
  if (decimals > 0) {
    *p++ = '.';
    PutDigits(p, fixed.fraction, decimals);
    p += decimals;
  } else if (has_point) {
    *p++ = '.';
  }
  buffer.SetEnd(p);
}

void AppendTrimmed(TextBuffer& buffer, double value, int max_decimals) {
  NCPORT_CHECK(std::isfinite(value), "number {} cannot be printed", value);
  const double magnitude = std::fabs(value);
  int decimals = max_decimals < 0 ? 0 : max_decimals;
  if (!IsFast(magnitude, decimals)) {
    if (magnitude >= static_cast<double>(kMantissaLimit)) decimals = 0;
    const fmt::memory_buffer text = SlowText(magnitude, decimals);
    std::string_view digits{text.data(), text.size()};
    if (decimals > 0) {
      digits = digits.substr(0, digits.find_last_not_of('0') + 1);
      if (digits.ends_with('.')) digits.remove_suffix(1);
    }
    if (value < 0 && digits != "0") buffer.Append('-');
    buffer.Append(digits);
    return;
  }
  Fixed fixed = Round(magnitude, decimals);
  constexpr std::size_t kRoom = 1 + 20 + 1 + kMaxFastDecimals;
  char* p = buffer.Reserve(kRoom);
  if (value < 0 && (fixed.whole | fixed.fraction) != 0) *p++ = '-';
  const int width = CountDigits(fixed.whole);
  PutDigits(p, fixed.whole, width);
  p += width;
  if (fixed.fraction != 0) {
    *p++ = '.';
    PutDigits(p, fixed.fraction, decimals);
    p += decimals;
    while (p[-1] == '0') --p;
  }
  buffer.SetEnd(p);
}

void AppendInteger(TextBuffer& buffer, std::int64_t value) {
  char* p = buffer.Reserve(20);
  auto magnitude = static_cast<std::uint64_t>(value);
  if (value < 0) {
    *p++ = '-';
    magnitude = 0 - magnitude;
  }
  const int width = CountDigits(magnitude);
  PutDigits(p, magnitude, width);
  buffer.SetEnd(p + width);
}

}  // namespace ncport
