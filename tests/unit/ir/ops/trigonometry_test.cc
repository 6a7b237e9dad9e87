#include "ir/ops/trigonometry.h"

#include <doctest/doctest.h>

#include <cmath>

namespace ncport::ir::ops {

TEST_CASE("exact where the true value is") {
  CHECK(Sin(30) == 0.5);
  CHECK(Sin(150) == 0.5);
  CHECK(Sin(-30) == -0.5);
  CHECK(Sin(210) == -0.5);
  CHECK(Sin(390) == 0.5);
  CHECK(Sin(180) == 0);
  CHECK(Sin(90) == 1);
  CHECK(Sin(270) == -1);
  CHECK(Cos(60) == 0.5);
  CHECK(Cos(120) == -0.5);
  CHECK(Cos(90) == 0);
  CHECK(Cos(-270) == 0);
  CHECK(Cos(180) == -1);
  CHECK(Cos(360) == 1);
  CHECK(Tan(45).value == 1);
  CHECK(Tan(135).value == -1);
  CHECK(Tan(-45).value == -1);
  CHECK(Tan(180).value == 0);
  CHECK(Tan(90).error == Error::kDomain);
  CHECK(Tan(-90).error == Error::kDomain);
  CHECK(!std::signbit(Sin(-180)));
}

TEST_CASE("the way back is exact too") {
  CHECK(Asin(0.5).value == 30);
  CHECK(Asin(-0.5).value == -30);
  CHECK(Asin(1).value == 90);
  CHECK(Acos(0.5).value == 60);
  CHECK(Acos(-0.5).value == 120);
  CHECK(Acos(0).value == 90);
  CHECK(Atan(1) == 45);
  CHECK(Atan(-1) == -45);
  CHECK(Atan2(1, -1) == 135);
  CHECK(Atan2(-1, 0) == -90);
  CHECK(Atan2(0, -1) == 180);
  CHECK(Atan2(0, 0) == 0);
  CHECK(Atan2(30.5, 80.1) == doctest::Approx(20.845534));
  CHECK(Asin(1.0000001).error == Error::kDomain);
}

TEST_CASE("all other angles agree with the library") {
  for (int i = -720; i <= 720; ++i) {
    const double degrees = i * 1.37;
    const double radians = degrees * 3.14159265358979323846 / 180;
    CHECK(Sin(degrees) == doctest::Approx(std::sin(radians)).epsilon(1e-12));
    CHECK(Cos(degrees) == doctest::Approx(std::cos(radians)).epsilon(1e-12));
  }
}

}  // namespace ncport::ir::ops
