// Pieces of ir::Machine that every language fills the same way from its tables.
#pragma once

#include <span>
#include <string_view>

#include "dialects/code_table.h"
#include "ir/machine.h"

namespace ncport::dialects {

/// The control's own number and text for a class of alarms; only numbers that the card is sure of.
struct AlarmRow {
  ir::AlarmClass alarm;
  std::string_view code;
  std::string_view text;
};
void SetAlarms(std::span<const AlarmRow> rows, ir::Machine& machine);

/// One more code by its text; none if that is no code. Call it before SetComputedCodes, which sorts them.
void AddComputedCode(std::string_view text, const ir::CodeMeaning& meaning, ir::Machine& machine);
/// Makes the G and M rows of the table known to programs that compute a code (`G#30`, `M=QU(5)`). Rows that need words
/// of their block to mean something (G4) stay out: they cannot be known by number alone.
void SetComputedCodes(const CodeTable& table, ir::Machine& machine);

/// Code of the modal group `group` for a mode of the enum of `op`.
template <class Mode>
ir::GroupCode ModeCode(std::uint16_t group, ir::WordOp op, Mode mode, double code) {
  return {group, op, static_cast<std::uint8_t>(mode), Id<void>::kNone, code};
}
/// Code of the group while work offset `number` is in force.
inline ir::GroupCode OffsetCode(std::uint16_t group, std::uint32_t number, double code) {
  return {group, ir::WordOp::kWorkOffset, 0, number, code};
}

}  // namespace ncport::dialects
