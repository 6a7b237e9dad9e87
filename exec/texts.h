// The texts of one run: a pool with a budget, compacted between blocks so that loops that build messages stay small.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/string_pool.h"
#include "base/text_buffer.h"
#include "exec/value.h"

namespace ncport::exec {

/// Value::text is an index here, or the id of a text of the module (bit 31): constants are never copied.
class Texts {
 public:
  Texts(const StringPool& constants, std::uint64_t max_bytes) : constants_(constants), max_bytes_(max_bytes) {}

  [[nodiscard]] static Value Constant(StringId id) { return Value::Text(kConstant | id.value); }
  /// Copies `text`. Over the budget the text is empty and Full() is true.
  Value Add(std::string_view text);
  [[nodiscard]] std::string_view View(const Value& value) const;
  [[nodiscard]] bool Full() const { return full_; }
  /// Between blocks: true when it is time to call Compact with every place that may hold a text.
  [[nodiscard]] bool WantsCompaction() const { return used_ > next_compaction_; }
  /// Keeps the texts of `roots` only and renumbers them.
  void Compact(std::span<const std::span<Value>> roots);

 private:
  static constexpr std::uint32_t kConstant = 0x80000000U;
  static constexpr std::uint64_t kFirstCompaction = 1U << 20U;

  struct Entry {
    std::size_t offset = 0;
    std::size_t size = 0;
  };

  const StringPool& constants_;
  TextBuffer chars_;
  std::vector<Entry> entries_{Entry{}};  // entry 0: the empty text
  std::uint64_t max_bytes_;
  std::uint64_t used_ = 0;  // characters and entries, in bytes
  std::uint64_t next_compaction_ = kFirstCompaction;
  bool full_ = false;
};

}  // namespace ncport::exec
