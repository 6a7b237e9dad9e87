// The programmable frame: shifts, rotations, scales and mirrors as one affine map from workpiece to trace coordinates.
#pragma once

#include <cstdint>

#include "ir/modes.h"
#include "ir/plane_axes.h"

namespace ncport::exec {

/// X Y Z (axes 0 to 2) share a matrix; every other axis has a factor and a shift of its own.
/// Chaining: the step added last acts first, in the system that the earlier ones made (sinumerik-8.7).
class Frame {
 public:
  static constexpr std::uint8_t kGeometryAxes = 3;

  [[nodiscard]] bool IsIdentity() const { return identity_; }
  /// True if no axis depends on another one: unprogrammed axes need not be known.
  [[nodiscard]] bool IsDiagonal() const { return diagonal_; }
  [[nodiscard]] double Linear(int row, int column) const { return matrix_[row][column]; }
  [[nodiscard]] double Factor(std::uint8_t axis) const {
    return axis < kGeometryAxes ? matrix_[axis][axis] : factor_[axis];
  }
  [[nodiscard]] double Shift(std::uint8_t axis) const { return shift_[axis]; }

  void Reset() { *this = Frame{}; }
  void AddShift(std::uint8_t axis, double distance);
  /// Counter-clockwise seen against the axis `axis` (0 to 2).
  void AddRotation(std::uint8_t axis, double degrees);
  void AddScale(std::uint8_t axis, double factor);
  void AddMirror(std::uint8_t axis) { AddScale(axis, -1); }
  /// Moves the map so that `work` of this axis stands where `base` is; the axis must not depend on others.
  void Preset(std::uint8_t axis, double work, double base);

  /// Maps the axes of `known`; returns those of the result that are known (all they depend on was). Others are
  /// unchanged.
  std::uint16_t ToBase(const double* work, std::uint16_t known, double* base) const;
  std::uint16_t ToWork(const double* base, std::uint16_t known, double* work) const;
  /// Axes of the result that depend on any axis of `axes`.
  [[nodiscard]] std::uint16_t Reach(std::uint16_t axes) const;
  /// False for a factor of 0: positions cannot be taken back.
  [[nodiscard]] bool Invertible() const { return invertible_; }

 private:
  void Update();

  double matrix_[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double inverse_[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double shift_[ir::kMaxAxes] = {};
  double factor_[ir::kMaxAxes] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  bool identity_ = true;
  bool diagonal_ = true;
  bool invertible_ = true;
};

using ir::AxesOf;
using ir::PlaneAxes;
using ir::PlaneWithNormal;

/// Where a plane of the workpiece system comes to lie.
struct PlaneMap {
  bool parallel = false;  // it is a main plane of the trace coordinates
  bool similar = false;   // circles stay circles
  bool mirrored = false;  // clockwise becomes counter-clockwise
  ir::Plane plane = ir::Plane::kXY;
  double scale = 1;  // of lengths in the plane
};
PlaneMap MapPlane(const Frame& frame, ir::Plane plane);

}  // namespace ncport::exec
