// One value at run time, 16 bytes. Text lives in a pool of the run.
#pragma once

#include <cstdint>

#include "ir/nodes.h"

namespace ncport::exec {

struct Value {
  ir::Type type = ir::Type::kNone;  // kNone = vacant
  std::uint32_t text = 0;           // kString: index in the run's text pool
  double number = 0;                // kInt (exact to 2^53), kReal, kBool, kChar, kAxis (axis index)

  static Value Vacant() { return {}; }
  static Value Int(double value) { return {ir::Type::kInt, 0, value}; }
  static Value Real(double value) { return {ir::Type::kReal, 0, value}; }
  static Value Bool(bool value) { return {ir::Type::kBool, 0, value ? 1.0 : 0.0}; }
  static Value Char(double code) { return {ir::Type::kChar, 0, code}; }
  static Value Axis(std::uint8_t axis) { return {ir::Type::kAxis, 0, static_cast<double>(axis)}; }
  static Value Text(std::uint32_t index) { return {ir::Type::kString, index, 0}; }
  [[nodiscard]] bool IsVacant() const { return type == ir::Type::kNone; }
  [[nodiscard]] bool IsText() const { return type == ir::Type::kString; }
};
static_assert(sizeof(Value) == 16);

/// What a variable of the type holds before anything is written: 0, FALSE, "" or vacant.
constexpr Value ZeroOf(ir::Type type) {
  switch (type) {
    case ir::Type::kString:
    case ir::Type::kInt:
    case ir::Type::kReal:
    case ir::Type::kBool:
    case ir::Type::kChar:
    case ir::Type::kAxis:
      return {type, 0, 0};
    default:
      return {};
  }
}

}  // namespace ncport::exec
