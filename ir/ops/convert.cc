#include "ir/ops/convert.h"

#include <cmath>

#include "ir/ops/arithmetic.h"

namespace ncport::ir::ops {
namespace {

Number InRange(double value, double low, double high) {
  return value >= low && value <= high ? Number{value, Error::kNone} : Fail(Error::kConversion);
}

}  // namespace

Number ToInt(double value, const Machine& machine) {
  return InRange(Round(value), static_cast<double>(machine.int_min), static_cast<double>(machine.int_max));
}

Number ToIntCut(double value, const Machine& machine) {
  return InRange(std::trunc(value) + 0.0, static_cast<double>(machine.int_min), static_cast<double>(machine.int_max));
}

Number ToChar(double value) { return InRange(Round(value), 0, 255); }

Number Convert(double value, Type type, const Machine& machine) {
  switch (type) {
    case Type::kInt:
      return ToInt(value, machine);
    case Type::kChar:
      return ToChar(value);
    case Type::kBool:
      return {value != 0 ? 1.0 : 0.0, Error::kNone};
    default:
      return {value, Error::kNone};
  }
}

Number WholeUpTo(double value, double limit) {
  const double whole = Round(value);
  return whole >= 0 && whole <= limit ? Number{whole, Error::kNone} : Fail(Error::kDomain);
}

}  // namespace ncport::ir::ops
