// What an expression reads, and which words can change it: for rules that ask whether a loop moves its own test.
#pragma once

#include <cstdint>
#include <set>
#include <utility>

#include "check/places.h"
#include "ir/module.h"

namespace ncport::check {

/// Variables and cells that an expression reads.
struct PlacesRead {
  std::set<std::pair<std::uint32_t, std::uint64_t>> places;
  bool known = true;    // false: something else than the words of the program can change what it reads
  bool shared = false;  // called programs see one of them too
};

class PlaceChanges {
 public:
  explicit PlaceChanges(const ir::Module& module);

  [[nodiscard]] PlacesRead ReadsOf(ir::ProgramId program, ir::ExprId expr) const;
  /// True if the word may change one of the places.
  [[nodiscard]] bool Changes(const ir::Word& word, const PlacesRead& read) const;
  [[nodiscard]] bool AnyChanges(ir::BlockId first, ir::BlockId last, const PlacesRead& read) const;
  /// The value is the same in all passes through these blocks.
  [[nodiscard]] bool Unchanged(ir::ProgramId program, ir::ExprId expr, ir::BlockId first, ir::BlockId last) const;
  [[nodiscard]] bool HasModalCalls() const { return has_modal_; }

 private:
  void Read(ir::ProgramId program, ir::ExprId expr, PlacesRead& read) const;
  [[nodiscard]] bool Writes(ir::ExprId place, const PlacesRead& read) const;

  const ir::Module& module_;
  bool has_modal_;
};

}  // namespace ncport::check
