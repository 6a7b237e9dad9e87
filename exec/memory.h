// The variables of one run in one address space: channel variables and cells of spaces at the bottom, the frames of the
// calls on top. An address is an index, so that by-reference parameters are numbers too.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "exec/value.h"

namespace ncport::exec {

class Memory {
 public:
  using Address = std::uint32_t;

  /// `fixed` cells that live for the whole run, at most `max_cells` in all. All start as vacant and untouched.
  Memory(std::uint32_t fixed, std::uint64_t max_cells);

  /// False if the fixed part alone is over the budget or could not be had.
  [[nodiscard]] bool Ok() const { return ok_; }

  [[nodiscard]] Value& operator[](Address address) {
    return address < fixed_ ? cells_.get()[address] : stack_[address - fixed_];
  }

  /// Takes `count` cells, vacant, from the stack; kNoRoom when the budget is used up.
  static constexpr Address kNoRoom = 0xFFFFFFFFU;
  Address Push(std::uint32_t count);
  /// Gives back everything from `address` up.
  void Pop(Address address) { stack_.resize(address - fixed_); }
  [[nodiscard]] Address Top() const { return fixed_ + static_cast<Address>(stack_.size()); }

  [[nodiscard]] std::span<Value> Fixed(std::uint32_t count) { return {cells_.get(), count}; }
  [[nodiscard]] std::span<Value> Stack() { return stack_; }

  // A vacant cell remembers what happened to it in Value::text.
  static constexpr std::uint32_t kUntouched = 0;
  static constexpr std::uint32_t kWrittenVacant = 1;
  static constexpr std::uint32_t kReadFirst = 2;  // read before it was written

 private:
  struct Free {
    void operator()(Value* cells) const { std::free(cells); }  // NOLINT(cppcoreguidelines-no-malloc): see memory.cc
  };

  std::unique_ptr<Value, Free> cells_;
  std::vector<Value> stack_;
  std::uint32_t fixed_ = 0;
  std::uint64_t max_cells_ = 0;
  bool ok_ = true;
};

}  // namespace ncport::exec
