#include "dialects/code_table.h"

#include <algorithm>
#include <tuple>

#include "base/result.h"

namespace ncport::dialects {

namespace {

auto MeaningKey(const CodeRow& row) { return std::tuple(row.op, row.index, row.extra); }

}  // namespace

CodeTable::CodeTable(std::span<const CodeRow> rows) : rows_(rows) {
  for (std::uint32_t i = 0; i < rows_.size(); ++i) {
    by_text_.push_back(i);
    if (!rows_[i].alias && rows_[i].op != ir::WordOp::kInert) by_meaning_.push_back(i);
  }
  std::sort(by_text_.begin(), by_text_.end(), [&](auto a, auto b) { return rows_[a].text < rows_[b].text; });
  std::sort(by_meaning_.begin(), by_meaning_.end(),
            [&](auto a, auto b) { return MeaningKey(rows_[a]) < MeaningKey(rows_[b]); });
  for (std::size_t i = 1; i < by_text_.size(); ++i) {
    NCPORT_CHECK(rows_[by_text_[i - 1]].text != rows_[by_text_[i]].text, "code {} stands twice in its table",
                 rows_[by_text_[i]].text);
  }
  for (std::size_t i = 1; i < by_meaning_.size(); ++i) {
    NCPORT_CHECK(MeaningKey(rows_[by_meaning_[i - 1]]) != MeaningKey(rows_[by_meaning_[i]]),
                 "codes {} and {} of one table mean the same", rows_[by_meaning_[i - 1]].text,
                 rows_[by_meaning_[i]].text);
  }
}

const CodeRow* CodeTable::FindText(std::string_view text) const {
  const auto it = std::lower_bound(by_text_.begin(), by_text_.end(), text,
                                   [&](std::uint32_t row, std::string_view key) { return rows_[row].text < key; });
  return it != by_text_.end() && rows_[*it].text == text ? &rows_[*it] : nullptr;
}

const CodeRow* CodeTable::FindMeaning(ir::WordOp op, std::uint8_t index, std::uint32_t extra) const {
  const auto key = std::tuple(op, index, extra);
  const auto it = std::lower_bound(by_meaning_.begin(), by_meaning_.end(), key,
                                   [&](std::uint32_t row, const auto& k) { return MeaningKey(rows_[row]) < k; });
  return it != by_meaning_.end() && MeaningKey(rows_[*it]) == key ? &rows_[*it] : nullptr;
}

}  // namespace ncport::dialects
