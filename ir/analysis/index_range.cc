#include "ir/analysis/index_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ncport::ir::analysis {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMost = 1e6;

struct Bounds {
  double low = -kInfinity, high = kInfinity;

  [[nodiscard]] bool Bounded() const { return std::isfinite(low) && std::isfinite(high); }
};

Bounds Map(const Bounds& a, double (*step)(double)) { return {step(a.low), step(a.high)}; }

Bounds Product(const Bounds& a, const Bounds& b) {
  if (!a.Bounded() || !b.Bounded()) return {};
  const double corners[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return {*std::min_element(corners, corners + 4), *std::max_element(corners, corners + 4)};
}

class Evaluator {
 public:
  explicit Evaluator(const Module& module) : module_(module) {}

  [[nodiscard]] Bounds Of(ExprId id) const {
    const Expr& expr = module_.exprs[id];
    const auto left = [&] { return Of(ExprId{std::size_t{expr.a}}); };
    const auto right = [&] { return Of(ExprId{std::size_t{expr.b}}); };
    switch (expr.op) {
      case ExprOp::kLiteral:
        return {expr.number, expr.number};
      case ExprOp::kVacant:
        return {0, 0};
      case ExprOp::kGroup:
      case ExprOp::kPlus:
      case ExprOp::kConvert:
        return left();
      case ExprOp::kNegate: {
        const Bounds a = left();
        return {-a.high, -a.low};
      }
      case ExprOp::kAdd: {
        const Bounds a = left(), b = right();
        return {a.low + b.low, a.high + b.high};
      }
      case ExprOp::kSubtract: {
        const Bounds a = left(), b = right();
        return {a.low - b.high, a.high - b.low};
      }
      case ExprOp::kMultiply:
        return Product(left(), right());
      case ExprOp::kDivide: {
        const Bounds b = right();
        if (b.low <= 0 && b.high >= 0) return {};
        return Product(left(), {1 / b.high, 1 / b.low});
      }
      case ExprOp::kModulo:
        return Remainder(left(), right(), (expr.flags & Expr::kOperandsToInt) != 0);
      case ExprOp::kFunction:
        return Function(expr);
      default:
        return {};
    }
  }

 private:
  /// The sign is that of the dividend, the size below that of the divisor.
  static Bounds Remainder(const Bounds& a, const Bounds& b, bool whole) {
    const double divisor = std::fmax(std::fabs(b.low), std::fabs(b.high));
    if (!std::isfinite(divisor)) return {};
    const double most = whole ? std::fmax(std::round(divisor) - 1, 0) : divisor;
    return {a.low >= 0 ? 0 : -most, a.high <= 0 ? 0 : most};
  }

  [[nodiscard]] Bounds Function(const Expr& expr) const {
    const auto arg = [&](std::uint32_t i) { return Of(module_.Item(expr.b + i)); };
    switch (static_cast<ir::Function>(expr.a)) {
      case ir::Function::kAbs: {
        const Bounds a = arg(0);
        if (a.low >= 0) return a;
        return {0, std::fmax(std::fabs(a.low), std::fabs(a.high))};
      }
      case ir::Function::kTruncate:
        return Map(arg(0), [](double x) { return std::trunc(x); });
      case ir::Function::kRound:
        return Map(arg(0), [](double x) { return std::round(x); });
      case ir::Function::kRoundUp:
        return Map(arg(0), [](double x) { return std::ceil(x); });
      case ir::Function::kRoundAway: {
        const Bounds a = arg(0);
        return {a.low < 0 ? std::floor(a.low) : std::ceil(a.low), a.high < 0 ? std::floor(a.high) : std::ceil(a.high)};
      }
      case ir::Function::kMinimum: {
        const Bounds a = arg(0), b = arg(1);
        return {std::fmin(a.low, b.low), std::fmin(a.high, b.high)};
      }
      case ir::Function::kMaximum: {
        const Bounds a = arg(0), b = arg(1);
        return {std::fmax(a.low, b.low), std::fmax(a.high, b.high)};
      }
      case ir::Function::kSin:
      case ir::Function::kCos:
        return {-1, 1};
      default:
        return {};
    }
  }

  const Module& module_;
};

}  // namespace

std::optional<IndexRange> IndexRangeOf(const Module& module, ExprId index) {
  const Bounds range = Evaluator(module).Of(index);
  if (!(range.low >= -0.4 && range.high <= kMost)) return std::nullopt;
  return IndexRange{static_cast<std::uint32_t>(std::fmax(std::round(range.low), 0)),
                    static_cast<std::uint32_t>(std::round(range.high))};
}

}  // namespace ncport::ir::analysis
