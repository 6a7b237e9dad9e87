// Words of the output that stand there as the machine's data gives them.
#pragma once

#include <cstdint>
#include <string_view>

#include "ir/builder.h"
#include "ir/make_word.h"

namespace ncport::backends::fanuc {

/// What later passes must know of such a word; Word::index.
enum class TextKind : std::uint8_t { kOther, kToolCall };

/// Prints `text` as it is.
inline ir::Word TextWord(ir::Module& module, std::string_view text, TextKind kind = TextKind::kOther) {
  ir::Word word = ir::MakeWord(ir::WordOp::kInert, kind);
  word.spelling = ir::AddSpelling(module, text, "");
  return word;
}

/// False for a word without effect of the source: that one has a rule, and is not carried over.
inline bool IsTextWord(const ir::Module& module, const ir::Word& word) {
  return word.op == ir::WordOp::kInert && word.spelling != 0 &&
         module.View(module.spellings[word.spelling].rule).empty();
}

/// A row of [tools], also one that only changes the offset (Word::kKeepsTool).
inline bool IsToolCall(const ir::Module& module, const ir::Word& word) {
  return word.index == static_cast<std::uint8_t>(TextKind::kToolCall) && IsTextWord(module, word);
}

}  // namespace ncport::backends::fanuc
