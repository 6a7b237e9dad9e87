#include "exec/texts.h"

#include <algorithm>
#include <utility>

namespace ncport::exec {

Value Texts::Add(std::string_view text) {
  if (text.empty()) return Value::Text(0);
  used_ += text.size() + sizeof(Entry);
  if (used_ > max_bytes_) {
    full_ = true;
    return Value::Text(0);
  }
  entries_.push_back({chars_.size(), text.size()});
  chars_.Append(text);  // reserves before it copies: `text` must not lie in this pool
  return Value::Text(static_cast<std::uint32_t>(entries_.size() - 1));
}

std::string_view Texts::View(const Value& value) const {
  if (!value.IsText()) return {};
  if ((value.text & kConstant) != 0) {
    StringId id;
    id.value = value.text & ~kConstant;
    return constants_.View(id);
  }
  const Entry& entry = entries_[value.text];
  return chars_.View().substr(entry.offset, entry.size);
}

void Texts::Compact(std::span<const std::span<Value>> roots) {
  TextBuffer chars;
  std::vector<Entry> entries{Entry{}};
  for (const std::span<Value> root : roots) {
    for (Value& value : root) {
      if (!value.IsText() || (value.text & kConstant) != 0 || value.text == 0) continue;
      const Entry old = entries_[value.text];
      entries.push_back({chars.size(), old.size});
      chars.Append(chars_.View().substr(old.offset, old.size));
      value.text = static_cast<std::uint32_t>(entries.size() - 1);
    }
  }
  chars_ = std::move(chars);
  entries_ = std::move(entries);
  used_ = chars_.size() + entries_.size() * sizeof(Entry);
  next_compaction_ = std::max(kFirstCompaction, 2 * used_);
}

}  // namespace ncport::exec
