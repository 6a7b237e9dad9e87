// Words that a pass makes.
#pragma once

#include <cstdint>
#include <type_traits>

#include "ir/nodes.h"

namespace ncport::ir {

/// A word with the phase of its row in nodes.def.
inline Word MakeWord(WordOp op, std::uint8_t index = 0, ExprId value = {}, std::uint32_t extra = Id<void>::kNone) {
  Word word;
  word.op = op;
  word.index = index;
  word.phase = DefaultPhaseOf(op);
  word.value = value;
  word.extra = extra;
  return word;
}

/// `index`: the mode, kind or operation that the word names.
template <class Index>
requires std::is_enum_v<Index> Word MakeWord(WordOp op, Index index, ExprId value = {},
                                             std::uint32_t extra = Id<void>::kNone) {
  return MakeWord(op, static_cast<std::uint8_t>(index), value, extra);
}

inline Word MakeAssignment(ExprId place, ExprId value) { return MakeWord(WordOp::kAssign, 0, value, place.value); }

}  // namespace ncport::ir
