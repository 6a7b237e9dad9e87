// A table of code words of one language, read both ways: text -> meaning for readers, meaning -> text for printers.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "ir/nodes.h"

namespace ncport::dialects {

/// One code word: what it means, the modal group it belongs to, and the card rule it comes from.
struct CodeRow {
  std::string_view text;  // "G1", "DIAMON", upper case
  ir::WordOp op = ir::WordOp::kInert;
  std::uint8_t index = 0;                 // Word::index
  std::uint32_t extra = Id<void>::kNone;  // Word::extra
  ir::Phase phase = ir::Phase::kSetting;
  std::uint8_t group = 0;  // group of the control; 0 = none. Two words of one group exclude each other
  std::string_view rule;   // "sinumerik-8.1"
  bool alias = false;      // read, never printed for this meaning (G01 forms, older words)
  std::uint8_t flags = 0;  // Word::flags that the word carries
};

/// Index over rows that live as long as the program. Building it with two rows of one text is a bug, and so are two
/// rows of one meaning of which none is an alias; inert words have no meaning to look up.
class CodeTable {
 public:
  explicit CodeTable(std::span<const CodeRow> rows);

  [[nodiscard]] std::span<const CodeRow> Rows() const { return rows_; }
  /// Row of this text (upper case), or null.
  [[nodiscard]] const CodeRow* FindText(std::string_view text) const;
  /// Row to print for this meaning, or null.
  [[nodiscard]] const CodeRow* FindMeaning(ir::WordOp op, std::uint8_t index,
                                           std::uint32_t extra = Id<void>::kNone) const;

 private:
  std::span<const CodeRow> rows_;
  std::vector<std::uint32_t> by_text_;     // row numbers, sorted by text
  std::vector<std::uint32_t> by_meaning_;  // sorted by op, index, extra; without aliases and inert rows
};

}  // namespace ncport::dialects
