#include "dialects/machine_parts.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace ncport::dialects {
namespace {

/// "G54.1" -> 541; false unless digits with at most one decimal follow the letter.
bool TenthsOf(std::string_view text, std::uint32_t& tenths) {
  tenths = 0;
  std::size_t i = 1;
  for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
    tenths = tenths * 10 + static_cast<std::uint32_t>(text[i] - '0');
  if (i == 1) return false;
  tenths *= 10;
  if (i == text.size()) return true;
  if (text[i] != '.' || i + 2 != text.size() || text[i + 1] < '0' || text[i + 1] > '9') return false;
  tenths += static_cast<std::uint32_t>(text[i + 1] - '0');
  return true;
}

void SortByTenths(std::vector<ir::CodeMeaning>& codes) { std::ranges::sort(codes, {}, &ir::CodeMeaning::tenths); }

}  // namespace

void SetAlarms(std::span<const AlarmRow> rows, ir::Machine& machine) {
  for (const AlarmRow& row : rows) {
    machine.alarms[static_cast<std::size_t>(row.alarm)] = {std::string(row.code), std::string(row.text)};
  }
}

void AddComputedCode(std::string_view text, const ir::CodeMeaning& meaning, ir::Machine& machine) {
  ir::CodeMeaning row = meaning;
  if (!TenthsOf(text, row.tenths)) return;
  (text.starts_with('G') ? machine.g_codes : machine.m_codes).push_back(row);
}

void SetComputedCodes(const CodeTable& table, ir::Machine& machine) {
  for (const CodeRow& row : table.Rows()) {
    std::uint32_t tenths = 0;
    const bool g = row.text.starts_with('G');
    const bool m = row.text.starts_with('M');
    const bool needs_words = row.op == ir::WordOp::kInert && row.phase == ir::Phase::kMotion;
    if ((!g && !m) || needs_words || !TenthsOf(row.text, tenths)) continue;
    (g ? machine.g_codes : machine.m_codes).push_back({tenths, row.op, row.index, row.extra, row.phase});
  }
  SortByTenths(machine.g_codes);
  SortByTenths(machine.m_codes);
}

}  // namespace ncport::dialects
