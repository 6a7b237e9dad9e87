#include "base/string_pool.h"

#include <algorithm>
#include <cstring>

namespace ncport {

namespace {

constexpr std::size_t kChunk = 16 * 1024;
constexpr std::size_t kFirstSlots = 64;

// Eight bytes a step, folded by a 64x64 -> 128 bit product. Names are short: one or two steps.
std::uint32_t Hash(std::string_view text) {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15ULL;
  std::uint64_t state = text.size() * kFactor;
  const char* p = text.data();
  std::size_t left = text.size();
  while (left > 0) {
    std::uint64_t word = 0;
    const std::size_t step = std::min<std::size_t>(left, sizeof(word));
    std::memcpy(&word, p, step);
    __extension__ using Wide = unsigned __int128;
    const Wide product = static_cast<Wide>(state ^ word) * kFactor;
    state = static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64U);
    state += kFactor;
    p += step;
    left -= step;
  }
  return static_cast<std::uint32_t>(state ^ (state >> 32U));
}

}  // namespace

StringPool::StringPool() : slots_(kFirstSlots, StringId::kNone) { Intern({}); }

StringPool::StringPool(const StringPool& other) : StringPool() {
  for (const Entry& entry : other.entries_) Intern(entry.text);
}

StringPool& StringPool::operator=(const StringPool& other) {
  if (this != &other) *this = StringPool(other);
  return *this;
}

StringId StringPool::Intern(std::string_view text) {
  const std::uint32_t hash = Hash(text);
  std::size_t slot = SlotOf(text, hash);
  if (slots_[slot] != StringId::kNone) return StringId{slots_[slot]};
  if ((entries_.size() + 1) * 2 > slots_.size()) {
    Grow();
    slot = SlotOf(text, hash);
  }
  const StringId id{entries_.size()};
  entries_.push_back({Keep(text), hash});
  slots_[slot] = id.value;
  return id;
}

StringId StringPool::Find(std::string_view text) const {
  const std::uint32_t found = slots_[SlotOf(text, Hash(text))];
  return found == StringId::kNone ? StringId{} : StringId{found};
}

std::size_t StringPool::SlotOf(std::string_view text, std::uint32_t hash) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash & mask;
  while (slots_[slot] != StringId::kNone) {
    const Entry& entry = entries_[slots_[slot]];
    if (entry.hash == hash && entry.text == text) break;
    slot = (slot + 1) & mask;
  }
  return slot;
}

std::string_view StringPool::Keep(std::string_view text) {
  if (text.empty()) return {};
  if (text.size() > free_size_) {
    // A long string gets a chunk of its own; the rest of the current chunk stays in use.
    if (text.size() > kChunk / 4) {
      chunks_.push_back(std::make_unique_for_overwrite<char[]>(text.size()));
      std::memcpy(chunks_.back().get(), text.data(), text.size());
      return {chunks_.back().get(), text.size()};
    }
    chunks_.push_back(std::make_unique_for_overwrite<char[]>(kChunk));
    free_ = chunks_.back().get();
    free_size_ = kChunk;
  }
  char* const kept = free_;
  std::memcpy(kept, text.data(), text.size());
  free_ += text.size();
  free_size_ -= text.size();
  return {kept, text.size()};
}

void StringPool::Grow() {
  slots_.assign(slots_.size() * 2, StringId::kNone);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t index = 0; index < entries_.size(); ++index) {
    std::size_t slot = entries_[index].hash & mask;
    while (slots_[slot] != StringId::kNone) slot = (slot + 1) & mask;
    slots_[slot] = index;
  }
}

}  // namespace ncport
