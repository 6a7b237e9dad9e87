// The six comparisons.
#pragma once

#include "base/result.h"
#include "ir/nodes.h"

namespace ncport::ir {

constexpr bool IsComparison(ExprOp op) { return op >= ExprOp::kEqual && op <= ExprOp::kGreaterEqual; }

/// The comparison that holds when `op` does not.
inline ExprOp Negated(ExprOp op) {
  switch (op) {
    case ExprOp::kEqual:
      return ExprOp::kNotEqual;
    case ExprOp::kNotEqual:
      return ExprOp::kEqual;
    case ExprOp::kLess:
      return ExprOp::kGreaterEqual;
    case ExprOp::kLessEqual:
      return ExprOp::kGreater;
    case ExprOp::kGreater:
      return ExprOp::kLessEqual;
    case ExprOp::kGreaterEqual:
      return ExprOp::kLess;
    default:
      NCPORT_BUG("{} is no comparison", NameOf(op));
  }
}

/// The comparison of the operands in the other order.
inline ExprOp Swapped(ExprOp op) {
  switch (op) {
    case ExprOp::kEqual:
    case ExprOp::kNotEqual:
      return op;
    case ExprOp::kLess:
      return ExprOp::kGreater;
    case ExprOp::kLessEqual:
      return ExprOp::kGreaterEqual;
    case ExprOp::kGreater:
      return ExprOp::kLess;
    case ExprOp::kGreaterEqual:
      return ExprOp::kLessEqual;
    default:
      NCPORT_BUG("{} is no comparison", NameOf(op));
  }
}

}  // namespace ncport::ir
