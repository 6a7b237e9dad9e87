// How often each operation occurs in the programs of a run: the generator must not avoid the hard ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/text_buffer.h"
#include "ir/module.h"

namespace ncport::tests::random {

class Census {
 public:
  /// Counts what the blocks of all programs hold.
  void Add(const ir::Module& module);
  /// The table by count, then the operations that never occurred.
  void Print(TextBuffer& out) const;

  [[nodiscard]] std::uint64_t Of(ir::WordOp op) const { return words_[static_cast<std::size_t>(op)]; }
  [[nodiscard]] std::uint64_t Of(ir::ExprOp op) const { return exprs_[static_cast<std::size_t>(op)]; }
  [[nodiscard]] std::uint64_t Of(ir::Function function) const { return functions_[static_cast<std::size_t>(function)]; }

 private:
  std::uint64_t programs_ = 0;
  std::uint64_t blocks_ = 0;
  std::array<std::uint64_t, 256> words_{}, exprs_{}, functions_{};
};

}  // namespace ncport::tests::random
