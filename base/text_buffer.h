// Output text: an append-only buffer for printers, and where it is flushed to.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

namespace ncport {

/// Growing array of chars. Appending copies bytes and nothing else; memory is never cleared.
class TextBuffer {
 public:
  TextBuffer() = default;
  explicit TextBuffer(std::size_t capacity) { Reserve(capacity); }
  TextBuffer(TextBuffer&& other) noexcept;
  TextBuffer& operator=(TextBuffer&& other) noexcept;
  TextBuffer(const TextBuffer&) = delete;
  TextBuffer& operator=(const TextBuffer&) = delete;
  ~TextBuffer() = default;

  /// Makes room for `count` more chars and returns where they go. Write there, then Advance.
  char* Reserve(std::size_t count) {
    if (capacity_ - size_ < count) [[unlikely]] {
      Grow(count);
    }
    return data_.get() + size_;
  }
  /// The chars from the old end up to `end` (inside the room reserved) are now part of the text.
  void SetEnd(const char* end) { size_ = static_cast<std::size_t>(end - data_.get()); }

  void Append(char c) {
    *Reserve(1) = c;
    ++size_;
  }
  void Append(std::string_view text) {
    if (text.empty()) return;
    std::memcpy(Reserve(text.size()), text.data(), text.size());
    size_ += text.size();
  }

  [[nodiscard]] const char* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool Empty() const { return size_ == 0; }
  [[nodiscard]] std::string_view View() const { return {data_.get(), size_}; }
  /// Drops the text, keeps the memory.
  void Clear() { size_ = 0; }
  /// Drops what was appended after the text had this size.
  void Truncate(std::size_t size) { size_ = size < size_ ? size : size_; }

 private:
  void Grow(std::size_t count);

  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// Where text goes: a file descriptor (not owned) or a string. The first failed write sticks.
class OutputSink {
 public:
  explicit OutputSink(int fd) : fd_(fd) {}
  explicit OutputSink(std::string& target) : target_(&target) {}

  /// Writes all of `text`, also to slow pipes. Fails when the descriptor cannot take it; see Error().
  Status Write(std::string_view text);
  /// Writes the buffer and clears it.
  Status Flush(TextBuffer& buffer);
  /// Bytes taken so far.
  [[nodiscard]] std::size_t Written() const { return written_; }
  /// errno of the failed write, 0 if none failed.
  [[nodiscard]] int Error() const { return error_; }

 private:
  int fd_ = -1;
  std::string* target_ = nullptr;
  std::size_t written_ = 0;
  int error_ = 0;
};

}  // namespace ncport
