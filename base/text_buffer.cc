#include "base/text_buffer.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace ncport {

TextBuffer::TextBuffer(TextBuffer&& other) noexcept
    : data_(std::move(other.data_)),
      size_(std::exchange(other.size_, 0)),
      capacity_(std::exchange(other.capacity_, 0)) {}

TextBuffer& TextBuffer::operator=(TextBuffer&& other) noexcept {
  data_ = std::move(other.data_);
  size_ = std::exchange(other.size_, 0);
  capacity_ = std::exchange(other.capacity_, 0);
  return *this;
}

void TextBuffer::Grow(std::size_t count) {
  constexpr std::size_t kFirst = 256;
  const std::size_t capacity = std::max({kFirst, capacity_ * 2, size_ + count});
  auto data = std::make_unique_for_overwrite<char[]>(capacity);
  if (size_ != 0) std::memcpy(data.get(), data_.get(), size_);
  data_ = std::move(data);
  capacity_ = capacity;
}

Status OutputSink::Write(std::string_view text) {
  if (error_ != 0) return Failure{};
  if (target_ != nullptr) {
    target_->append(text);
    written_ += text.size();
    return {};
  }
  while (!text.empty()) {
    const ssize_t count = ::write(fd_, text.data(), text.size());
    if (count >= 0) {
      written_ += static_cast<std::size_t>(count);
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd wait{.fd = fd_, .events = POLLOUT, .revents = 0};
      ::poll(&wait, 1, -1);
    } else if (errno != EINTR) {
      error_ = errno;
      return Failure{};
    }
  }
  return {};
}

Status OutputSink::Flush(TextBuffer& buffer) {
  const Status status = Write(buffer.View());
  buffer.Clear();
  return status;
}

}  // namespace ncport
