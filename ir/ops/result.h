// What an operation of the kernel gives: a value, or the reason why there is none.
#pragma once

#include <cstdint>

namespace ncport::ir::ops {

enum class Error : std::uint8_t {
  kNone,
  kDivisionByZero,
  kDomain,      // root of a negative number, arc sine of 2, tangent of 90 degrees, limits of BOUND swapped ...
  kOverflow,    // too large for the type or for a double
  kConversion,  // value outside the target type, text that is no number
};

/// "division by zero" ... for messages; empty for kNone.
constexpr const char* TextOf(Error error) {
  switch (error) {
    case Error::kNone:
      return "";
    case Error::kDivisionByZero:
      return "division by zero";
    case Error::kDomain:
      return "value outside the domain of the function";
    case Error::kOverflow:
      return "result too large";
    case Error::kConversion:
      return "value does not fit the type";
  }
  return "";
}

struct Number {
  double value = 0;
  Error error = Error::kNone;

  [[nodiscard]] constexpr bool Ok() const { return error == Error::kNone; }
};

constexpr Number Fail(Error error) { return {0, error}; }

}  // namespace ncport::ir::ops
