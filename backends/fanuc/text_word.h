// Words of the output that stand there as the machine's data gives them.
#pragma once

#include <string_view>

#include "ir/builder.h"
#include "ir/make_word.h"

namespace ncport::backends::fanuc {

/// Prints `text` as it is. A word without effect of the source has a rule besides: it is not carried over.
inline ir::Word TextWord(ir::Module& module, std::string_view text) {
  ir::Word word = ir::MakeWord(ir::WordOp::kInert);
  word.spelling = ir::AddSpelling(module, text, "");
  return word;
}

}  // namespace ncport::backends::fanuc
