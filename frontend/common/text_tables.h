// The spellings of a module, each once: of words as their table has them, and of numbers that no digits describe.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "base/string_pool.h"
#include "ir/module.h"

namespace ncport::frontend {

class TextTables {
 public:
  /// Goes on with what the module has.
  explicit TextTables(ir::Module& module);

  /// For Word::spelling; 0 when the table is full (65,536 rows).
  std::uint16_t SpellingOf(std::string_view text, std::string_view rule);
  /// For Expr::count of a literal with NumberFormat::kAsText.
  std::uint16_t LiteralText(StringId text);

 private:
  ir::Module& module_;
  std::unordered_map<std::uint64_t, std::uint16_t> spellings_;      // text and rule
  std::unordered_map<std::uint32_t, std::uint16_t> literal_texts_;  // StringId -> index
};

}  // namespace ncport::frontend
