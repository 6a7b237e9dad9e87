// Where expressions stand in their source lines: for messages only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ir/nodes.h"

namespace ncport::ir {

/// Bytes of a source line that an expression came from. Length 0: not from a source.
struct ExprPlace {
  std::uint32_t begin = 0, length = 0;
};

/// Places by expression. Those without an entry are made by a pass, or are the whole value of a word and stand where it
/// stands (Module::RangeOf): most expressions of real programs are the number of a word, and cost nothing here.
class ExprPlaces {
 public:
  struct Entry {
    ExprId expr;
    ExprPlace place;
  };

  /// Expressions come in the order of their ids. A place of length 0 at 0 is none.
  void Add(ExprId expr, ExprPlace place) {
    if (place.begin != 0 || place.length != 0) entries_.push_back({expr, place});
  }
  /// Gives an expression a place, or another one.
  void Set(ExprId expr, ExprPlace place);
  /// {} for an expression without an entry.
  [[nodiscard]] ExprPlace Of(ExprId expr) const;
  /// Forgets the places of expressions from id `count` on.
  void Truncate(std::size_t count);

  [[nodiscard]] const std::vector<Entry>& All() const { return entries_; }

 private:
  [[nodiscard]] std::size_t LowerBound(std::size_t expr) const;

  std::vector<Entry> entries_;  // by id
};

}  // namespace ncport::ir
