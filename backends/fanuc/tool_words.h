// The words of a row of [tools]: how this target calls a tool.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "backends/fanuc/raise.h"

namespace ncport::backends::fanuc {

/// "M6" stands in "T1 M6 H1".
bool HoldsWord(std::string_view words, std::string_view word);

/// The number behind the letter, without what follows its digits: 101 of "T0101", 1 of "T01.02"; 0: there is none.
/// `digits`: how many there are.
std::uint32_t NumberBehind(std::string_view words, char letter, std::size_t* digits = nullptr);

/// The decimals of the first T word as hundredths: 2 of "T01.02 M6"; 0: none.
std::uint32_t ToolSuffix(std::string_view words);

/// The words of a mill: the call of the tool, and the registers of its length (H) and radius (D).
struct MillToolWords {
  std::string call;  // "T1 M6"
  std::uint32_t tool = 0;
  std::optional<std::uint32_t> length, radius;
};

/// None: no tool number.
std::optional<MillToolWords> ParseMillTool(std::string_view words);

/// The words of a tool call bring the tool in.
bool HasChange(std::string_view call);

/// Says once that a move in machine coordinates of the source keeps the tool offset, and that of the target does not;
/// not between languages that are one.
void TellKeptOffset(const RaiseInput& input, Translation& out);

}  // namespace ncport::backends::fanuc
