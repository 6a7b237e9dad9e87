#include "exec/memory.h"

#include <type_traits>

namespace ncport::exec {

// calloc gives zeroed pages that cost nothing until they are touched: a space of 100,000 cells is free for a program
// that uses ten of them, and a vacant untouched Value is all zero bits.
static_assert(static_cast<int>(ir::Type::kNone) == 0);
static_assert(std::is_trivially_copyable_v<Value>);

Memory::Memory(std::uint32_t fixed, std::uint64_t max_cells) : fixed_(fixed), max_cells_(max_cells) {
  if (fixed > max_cells) {
    ok_ = false;
    fixed_ = 0;
    return;
  }
  if (fixed == 0) return;
  cells_.reset(static_cast<Value*>(std::calloc(fixed, sizeof(Value))));  // NOLINT(cppcoreguidelines-no-malloc)
  if (cells_ == nullptr) {
    ok_ = false;
    fixed_ = 0;
  }
}

Memory::Address Memory::Push(std::uint32_t count) {
  if (std::uint64_t{fixed_} + stack_.size() + count > max_cells_) return kNoRoom;
  const Address address = Top();
  stack_.resize(stack_.size() + count);
  return address;
}

}  // namespace ncport::exec
