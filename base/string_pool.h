// Interned strings: names become 32-bit ids that compare fast and print well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/ids.h"

namespace ncport {

struct StringTag;
using StringId = Id<StringTag>;

/// Owns each distinct string once. Views stay valid as long as the pool lives. Id 0 is the empty string.
class StringPool {
 public:
  StringPool();
  StringPool(const StringPool& other);
  StringPool& operator=(const StringPool& other);
  StringPool(StringPool&&) = default;
  StringPool& operator=(StringPool&&) = default;
  ~StringPool() = default;

  /// The id of `text`, new if it was not seen before. Case and bytes count.
  StringId Intern(std::string_view text);
  /// The id of `text` if it is in the pool, else an invalid id.
  [[nodiscard]] StringId Find(std::string_view text) const;
  [[nodiscard]] std::string_view View(StringId id) const { return entries_[id.value].text; }
  /// Number of distinct strings, the empty one included.
  [[nodiscard]] std::size_t Size() const { return entries_.size(); }

 private:
  struct Entry {
    std::string_view text;
    std::uint32_t hash;
  };

  [[nodiscard]] std::size_t SlotOf(std::string_view text, std::uint32_t hash) const;
  std::string_view Keep(std::string_view text);
  void Grow();

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> slots_;  // power of two; Id::kNone = free
  std::vector<std::unique_ptr<char[]>> chunks_;
  char* free_ = nullptr;
  std::size_t free_size_ = 0;
};

}  // namespace ncport
