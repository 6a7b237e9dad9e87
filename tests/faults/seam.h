// Where seeded faults are switched. The product holds none of this: ncport_seed_faults writes copies of its sources in
// which each fault is an expression that asks On(), and only ncport_faults is built from those copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <set>
#include <span>
#include <utility>
#include <vector>

#define NCPORT_SEAM(number, normal, faulty) (::ncport::tests::faults::On(number) ? (faulty) : (normal))

namespace ncport::tests::faults {

inline constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// Which side of a table a fault is on: what readers take from it, or what printers do.
enum class Side : std::uint8_t { kRead, kWrite, kBoth };

/// A row of a table that is swapped with the next one. `table` is the address of the table's first row.
struct TableFault {
  const void* table = nullptr;
  Side side = Side::kRead;
  std::uint32_t row = kNone, other = kNone;
};

/// What is switched on, and which places were asked.
struct State {
  std::uint32_t active = kNone;  // number of a seam
  TableFault table;
  std::set<std::uint32_t> asked;                          // numbers of seams
  std::set<std::pair<const void*, std::uint32_t>> taken;  // rows that printers took; kNone: some row of the table
};
State& Now();

inline bool On(std::uint32_t number) {
  State& state = Now();
  if (state.active == kNone) state.asked.insert(number);
  return state.active == number;
}

/// Exchanges what is written, and leaves what is meant.
template <class Row>
void SwapTexts(Row& a, Row& b) {
  if constexpr (requires { a.text; }) {
    std::swap(a.text, b.text);
  } else {
    std::swap(a.letter, b.letter);
  }
  if constexpr (requires { a.shortest; }) std::swap(a.shortest, b.shortest);
}

/// Rows that can be changed: readers keep what they saw first, so the harness swaps texts in them before any is read.
template <class Row>
std::span<const Row> Keep(std::span<const Row> rows) {
  static std::list<std::vector<Row>> kept;
  return kept.emplace_back(rows.begin(), rows.end());
}

/// The table, with the texts of two rows exchanged if that fault is on.
template <Side kSide, class Row, std::size_t kRows>
const Row (&Table(const Row (&rows)[kRows]))[kRows] {
  State& state = Now();
  if (kSide != Side::kRead) state.taken.insert({rows, kNone});
  if (state.table.table != rows || (kSide != Side::kBoth && state.table.side != kSide)) return rows;
  static Row copy[kRows];
  for (std::size_t i = 0; i < kRows; ++i) copy[i] = rows[i];
  SwapTexts(copy[state.table.row], copy[state.table.other]);
  return copy;
}

/// The row that a search for a meaning found.
template <class Row>
const Row* WriteRow(std::span<const Row> rows, const Row* found) {
  if (found == nullptr) return found;
  State& state = Now();
  const auto at = static_cast<std::uint32_t>(found - rows.data());
  state.taken.insert({rows.data(), at});
  if (state.table.table != rows.data() || state.table.side != Side::kWrite) return found;
  return at == state.table.row ? &rows[state.table.other] : at == state.table.other ? &rows[state.table.row] : found;
}

}  // namespace ncport::tests::faults
