#include "ir/expr_places.h"

#include <algorithm>

namespace ncport::ir {

std::size_t ExprPlaces::LowerBound(std::size_t expr) const {
  const auto found = std::ranges::lower_bound(entries_, expr, {}, [](const Entry& entry) { return entry.expr.value; });
  return static_cast<std::size_t>(found - entries_.begin());
}

void ExprPlaces::Set(ExprId expr, ExprPlace place) {
  const std::size_t at = LowerBound(expr.value);
  if (at < entries_.size() && entries_[at].expr == expr) {
    entries_[at].place = place;
  } else {
    entries_.insert(entries_.begin() + static_cast<std::ptrdiff_t>(at), {expr, place});
  }
}

ExprPlace ExprPlaces::Of(ExprId expr) const {
  if (!expr.Valid()) return {};
  const std::size_t at = LowerBound(expr.value);
  return at < entries_.size() && entries_[at].expr == expr ? entries_[at].place : ExprPlace{};
}

void ExprPlaces::Truncate(std::size_t count) { entries_.resize(LowerBound(count)); }

}  // namespace ncport::ir
