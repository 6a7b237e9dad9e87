// Records of one kind, addressed by typed ids.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/ids.h"

namespace ncport {

template <class IdType, class Record>
class Store {
 public:
  IdType Add(Record record) {
    records_.push_back(std::move(record));
    return IdType{records_.size() - 1};
  }

  /// Adds a record with default values, to be filled where it stands: a record that is made elsewhere from small fields
  /// and copied right away makes the processor wait for its own stores.
  Record& Emplace() { return records_.emplace_back(); }

  [[nodiscard]] const Record& operator[](IdType id) const { return records_[id.value]; }
  [[nodiscard]] Record& operator[](IdType id) { return records_[id.value]; }
  [[nodiscard]] std::size_t Size() const { return records_.size(); }
  [[nodiscard]] bool Empty() const { return records_.empty(); }
  [[nodiscard]] bool Contains(IdType id) const { return id.value < records_.size(); }
  /// Room for `count` records, at least twice what there was: one call for each of many small files stays linear.
  void Reserve(std::size_t count) {
    if (count > records_.capacity()) records_.reserve(std::max(count, 2 * records_.capacity()));
  }
  void Resize(std::size_t count) { records_.resize(count); }

  [[nodiscard]] const std::vector<Record>& All() const { return records_; }
  [[nodiscard]] std::vector<Record>& All() { return records_; }
  [[nodiscard]] IdRange<IdType> Ids() const { return {0, static_cast<std::uint32_t>(records_.size())}; }

 private:
  std::vector<Record> records_;
};

}  // namespace ncport
