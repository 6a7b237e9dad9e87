// System variables of Fanuc, Mazak and Haas by number and by name (fanuc-9, mazak-lathe-6.6, 6.7). They are ranges:
// programs reach them by arithmetic, #[5040+#1].
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dialects/fanuc/words.h"
#include "dialects/profile.h"
#include "ir/nodes.h"

namespace ncport::dialects::fanuc {

/// Variables whose write is an event of its own.
enum class Control : std::uint8_t { kNone, kAlarm /* #3000 */, kMessageStop /* #3006 */ };

/// Numbers `first` to `last`. What index a number has in its kind: number - base (#5041 is index 1 of base 5040).
struct SystemRange {
  std::uint32_t first, last;
  std::uint32_t base;
  std::string_view name;  // "position at block end", for messages
  ir::SystemKind kind;
  ir::Type type;
  bool readable;
  bool writable;
  Control control;
  std::uint8_t makers;    // bit per FanucSettings::Variant
  std::uint8_t machines;  // bit 0 mills, bit 1 lathes
  std::string_view rule;
};

/// Numbers that words of programs stand for.
inline constexpr std::uint32_t kToolDataIndex = 3020;  // Mazak: place of the active tool in the tool data (fanuc-9.8)
inline constexpr std::uint32_t kActiveTool = 4120;

/// All ranges. Those of one maker and machine do not overlap.
std::span<const SystemRange> SystemVariables();
/// The range that holds `number` on this machine, or null: there is no such variable (PS0115).
const SystemRange* FindSystemVariable(const Profile& profile, std::uint32_t number);

/// Names of 30i and 0i-F (fanuc-9.10): number of `#_NAME`, or of `#_NAME[n]` as base + n.
struct SystemName {
  std::string_view name;  // "_ABSIO"
  std::uint32_t base;
  bool indexed;
};
std::span<const SystemName> SystemNames();
const SystemName* FindSystemName(std::string_view name);

}  // namespace ncport::dialects::fanuc
