#include "exec/frame.h"

#include <cmath>

#include "ir/ops/trigonometry.h"

namespace ncport::exec {
namespace {

constexpr double kSameLength = 1e-9;  // relative difference of factors that still counts as equal

using Matrix = double[3][3];

void Multiply(Matrix& a, const Matrix& b) {
  Matrix result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result[row][column] = a[row][0] * b[0][column] + a[row][1] * b[1][column] + a[row][2] * b[2][column] + 0.0;
    }
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) a[row][column] = result[row][column];
  }
}

/// False if the matrix has no inverse.
bool Invert(const Matrix& m, Matrix& inverse) {
  const auto minor = [&](int row, int column) {
    const int r0 = (row + 1) % 3, r1 = (row + 2) % 3, c0 = (column + 1) % 3, c1 = (column + 2) % 3;
    return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  if (determinant == 0 || !std::isfinite(1 / determinant)) return false;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) inverse[row][column] = minor(column, row) / determinant + 0.0;
  }
  return true;
}

constexpr std::uint16_t Bit(int axis) { return static_cast<std::uint16_t>(1U << axis); }

}  // namespace

void Frame::AddShift(std::uint8_t axis, double distance) {
  if (axis < kGeometryAxes) {
    for (int row = 0; row < 3; ++row) shift_[row] += matrix_[row][axis] * distance;
  } else {
    shift_[axis] += factor_[axis] * distance;
  }
  Update();
}

void Frame::AddRotation(std::uint8_t axis, double degrees) {
  const double c = ir::ops::Cos(degrees);
  const double s = ir::ops::Sin(degrees);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Matrix rotation = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  rotation[u][u] = c;
  rotation[u][v] = -s;
  rotation[v][u] = s;
  rotation[v][v] = c;
  Multiply(matrix_, rotation);
  Update();
}

void Frame::AddScale(std::uint8_t axis, double factor) {
  if (axis < kGeometryAxes) {
    for (auto& row : matrix_) row[axis] = row[axis] * factor + 0.0;
  } else {
    factor_[axis] *= factor;
  }
  Update();
}

void Frame::Preset(std::uint8_t axis, double work, double base) {
  shift_[axis] = base - Factor(axis) * work;
  Update();
}

void Frame::Update() {
  diagonal_ = true;
  identity_ = true;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      if (row != column && matrix_[row][column] != 0) diagonal_ = false;
    }
    if (matrix_[row][row] != 1) identity_ = false;
  }
  for (int axis = 0; axis < ir::kMaxAxes; ++axis) {
    if (shift_[axis] != 0 || (axis >= kGeometryAxes && factor_[axis] != 1)) identity_ = false;
  }
  identity_ = identity_ && diagonal_;
  invertible_ = Invert(matrix_, inverse_);
  for (int axis = kGeometryAxes; axis < ir::kMaxAxes; ++axis) invertible_ = invertible_ && factor_[axis] != 0;
}

std::uint16_t Frame::ToBase(const double* work, std::uint16_t known, double* base) const {
  std::uint16_t result = 0;
  for (int axis = kGeometryAxes; axis < ir::kMaxAxes; ++axis) {
    if ((known & Bit(axis)) == 0) continue;
    base[axis] = factor_[axis] * work[axis] + shift_[axis];
    result |= Bit(axis);
  }
  double value[3];
  for (int row = 0; row < 3; ++row) {
    double sum = 0;
    bool complete = true;
    for (int column = 0; column < 3; ++column) {
      if (matrix_[row][column] == 0) continue;
      complete = complete && (known & Bit(column)) != 0;
      sum += matrix_[row][column] * work[column];
    }
    value[row] = sum + shift_[row];
    if (complete) result |= Bit(row);
  }
  for (int row = 0; row < 3; ++row) {
    if ((result & Bit(row)) != 0) base[row] = value[row];
  }
  return result;
}

std::uint16_t Frame::ToWork(const double* base, std::uint16_t known, double* work) const {
  std::uint16_t result = 0;
  for (int axis = kGeometryAxes; axis < ir::kMaxAxes; ++axis) {
    if ((known & Bit(axis)) == 0 || factor_[axis] == 0) continue;
    work[axis] = (base[axis] - shift_[axis]) / factor_[axis];
    result |= Bit(axis);
  }
  if (!invertible_) return result;
  double value[3];
  for (int row = 0; row < 3; ++row) {
    double sum = 0;
    bool complete = true;
    for (int column = 0; column < 3; ++column) {
      if (inverse_[row][column] == 0) continue;
      complete = complete && (known & Bit(column)) != 0;
      sum += inverse_[row][column] * (base[column] - shift_[column]);
    }
    value[row] = sum + 0.0;
    if (complete) result |= Bit(row);
  }
  for (int row = 0; row < 3; ++row) {
    if ((result & Bit(row)) != 0) work[row] = value[row];
  }
  return result;
}

std::uint16_t Frame::Reach(std::uint16_t axes) const {
  if (diagonal_) return axes;
  auto result = static_cast<std::uint16_t>(axes & ~7U);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      if ((axes & Bit(column)) != 0 && matrix_[row][column] != 0) result |= Bit(row);
    }
  }
  return result;
}

PlaneMap MapPlane(const Frame& frame, ir::Plane plane) {
  const PlaneAxes axes = AxesOf(plane);
  if (frame.IsIdentity()) return {true, true, false, plane, 1};
  double first[3];
  double second[3];
  for (int row = 0; row < 3; ++row) {
    first[row] = frame.Linear(row, axes.first);
    second[row] = frame.Linear(row, axes.second);
  }
  const auto length = [](const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); };
  const double first_length = length(first);
  const double second_length = length(second);
  PlaneMap map;
  map.scale = first_length;
  const double small = kSameLength * std::fmax(first_length, second_length);
  for (std::uint8_t normal = 0; normal < 3; ++normal) {
    if (std::fabs(first[normal]) > small || std::fabs(second[normal]) > small) continue;
    map.parallel = true;
    map.plane = PlaneWithNormal(normal);
    const PlaneAxes base = AxesOf(map.plane);
    const double turn = first[base.first] * second[base.second] - first[base.second] * second[base.first];
    const double dot = first[base.first] * second[base.first] + first[base.second] * second[base.second];
    map.mirrored = turn < 0;
    map.similar =
        std::fabs(first_length - second_length) <= small && std::fabs(dot) <= small * first_length && turn != 0;
    break;
  }
  return map;
}

}  // namespace ncport::exec
