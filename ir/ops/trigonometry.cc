#include "ir/ops/trigonometry.h"

#include <cmath>

namespace ncport::ir::ops {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadians = kPi / 180.0;

/// Sine of 0..45 degrees.
double SmallSin(double degrees) { return degrees == 30.0 ? 0.5 : std::sin(degrees * kRadians); }
double SmallCos(double degrees) { return std::cos(degrees * kRadians); }

/// Sine of 0..90 degrees, with the sum of two angles of a right triangle exact.
double QuadrantSin(double degrees) {
  if (degrees == 90.0) return 1.0;
  return degrees <= 45.0 ? SmallSin(degrees) : SmallCos(90.0 - degrees);
}
double QuadrantCos(double degrees) {
  if (degrees == 90.0) return 0.0;
  return degrees < 45.0 ? SmallCos(degrees) : SmallSin(90.0 - degrees);
}

/// `degrees`, which came out of an inverse function, or the whole number of degrees beside it when that one is the
/// exact answer.
template <class Forward>
double Snap(double degrees, double value, Forward forward) {
  const double whole = std::round(degrees);
  return whole != degrees && std::fabs(whole - degrees) < 1e-9 && forward(whole) == value ? whole : degrees;
}

}  // namespace

double Sin(double degrees) {
  double angle = std::fmod(degrees, 360.0);  // exact
  double sign = 1.0;
  if (angle < 0) {
    angle = -angle;
    sign = -1.0;
  }
  if (angle >= 180.0) {
    angle -= 180.0;
    sign = -sign;
  }
  if (angle > 90.0) angle = 180.0 - angle;
  return sign * QuadrantSin(angle) + 0.0;
}

double Cos(double degrees) {
  double angle = std::fabs(std::fmod(degrees, 360.0));
  double sign = 1.0;
  if (angle >= 180.0) {
    angle -= 180.0;
    sign = -1.0;
  }
  if (angle > 90.0) {
    angle = 180.0 - angle;
    sign = -sign;
  }
  return sign * QuadrantCos(angle) + 0.0;
}

Number Tan(double degrees) {
  const double cosine = Cos(degrees);
  if (cosine == 0) return Fail(Error::kDomain);
  const double angle = std::fabs(std::fmod(degrees, 180.0));
  if (angle == 45.0 || angle == 135.0) return {Sin(degrees) * cosine > 0 ? 1.0 : -1.0, Error::kNone};
  return {Sin(degrees) / cosine, Error::kNone};
}

Number Asin(double value) {
  if (!(value >= -1 && value <= 1)) return Fail(Error::kDomain);
  return {Snap(std::asin(value) / kRadians, value, Sin), Error::kNone};
}

Number Acos(double value) {
  if (!(value >= -1 && value <= 1)) return Fail(Error::kDomain);
  return {Snap(std::acos(value) / kRadians, value, Cos), Error::kNone};
}

double Atan(double value) {
  return Snap(std::atan(value) / kRadians, value, [](double degrees) { return Tan(degrees).value; });
}

double Atan2(double across, double along) {
  if (across == 0) return along < 0 ? 180.0 : 0.0;
  if (along == 0) return across > 0 ? 90.0 : -90.0;
  const double angle = std::atan2(across, along) / kRadians;
  if (std::fabs(across) == std::fabs(along)) return std::round(angle);  // the diagonals
  return angle;
}

}  // namespace ncport::ir::ops
