// Where jumps go: labels and block numbers of one program, looked up in the order in which a control searches.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ir/module.h"

namespace ncport::ir::analysis {

/// Built once a program. A lookup costs a binary search over the blocks that carry the same label or number.
/// Names may stand twice: the first hit in the direction of the search wins.
class LabelTable {
 public:
  /// `ignore_case`: labels compare without regard to the case of ASCII letters.
  LabelTable(const Module& module, ProgramId program, bool ignore_case = true);

  /// The block that a jump of block `from` goes to, or none. Bit n of `skip_levels` = skip level n is on: labels of
  /// blocks with that level are not found. kExpression targets are looked up only when the expression is a literal.
  [[nodiscard]] BlockId Find(const Target& target, BlockId from, Search search, std::uint16_t skip_levels = 0) const;
  [[nodiscard]] BlockId FindLabel(std::string_view label, BlockId from, Search search,
                                  std::uint16_t skip_levels = 0) const;
  /// `main_block`: only blocks with Block::kMainBlock count, else only those without.
  [[nodiscard]] BlockId FindNumber(std::uint32_t number, bool main_block, BlockId from, Search search,
                                   std::uint16_t skip_levels = 0) const;

  /// First and last block of the range that a RepeatPart word in block `from` runs again, both inclusive; none if a
  /// label is missing or the range would be empty or hold the block `from` itself.
  struct Range {
    BlockId first, last;
  };
  [[nodiscard]] std::optional<Range> FindPart(const Part& part, BlockId from, std::uint16_t skip_levels = 0) const;

  /// All blocks with a label or a number, in order: where a computed jump may go.
  [[nodiscard]] const std::vector<BlockId>& Targets() const { return targets_; }

 private:
  using Places = std::vector<BlockId>;  // ascending

  [[nodiscard]] std::string Key(std::string_view label) const;
  [[nodiscard]] const Places* LabelPlaces(std::string_view label) const;
  [[nodiscard]] BlockId FindText(std::string_view text, BlockId from, Search search, std::uint16_t skip_levels) const;
  [[nodiscard]] BlockId Nearest(const Places* places, BlockId from, Search search, std::uint16_t skip_levels) const;
  [[nodiscard]] bool Visible(BlockId block, std::uint16_t skip_levels) const;

  const Module& module_;
  IdRange<BlockId> blocks_;
  bool ignore_case_;
  std::unordered_map<std::string, Places> labels_;
  std::unordered_map<std::uint64_t, Places> numbers_;  // number, bit 32 = main block
  std::vector<BlockId> targets_;
};

}  // namespace ncport::ir::analysis
