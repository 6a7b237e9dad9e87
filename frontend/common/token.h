// One token of a line: its kind, where it stands, and what it carries. The kinds are those of the language's parser
// grammar; everything that parsing and lowering decide by is in the kind, everything else in the payload, so that two
// lines of equal kinds share one recipe.
#pragma once

#include <cstdint>

#include "base/string_pool.h"
#include "ir/nodes.h"

namespace ncport::frontend {

struct Token {
  std::uint16_t kind = 0;
  std::uint8_t sub = 0;      // small number of the kind: axis, extension, level, operator
  std::uint8_t digits = 0;   // of a code as written (G01: 2), of an N word
  std::uint32_t offset = 0;  // bytes from the start of the line
  std::uint32_t length = 0;
  std::uint32_t data = 0;  // row of a table, or StringId::value
  double number = 0;
  ir::NumberFormat format;  // of `number`

  [[nodiscard]] StringId Text() const {
    StringId id;
    id.value = data;
    return id;
  }
  [[nodiscard]] std::uint32_t End() const { return offset + length; }
};

}  // namespace ncport::frontend
