#include "dialects/profile.h"

#include "dialects/word_template.h"

namespace ncport::dialects {

ToolAddressing Profile::Tools() const {
  if (language == Language::kSinumerik || language == Language::kNum) return ToolAddressing::kEdges;
  return IsLathe() ? ToolAddressing::kTurret : ToolAddressing::kRegisters;
}

std::uint32_t Profile::OffsetDigits() const {
  const std::size_t width = words.tool.Known() ? WidthOf(*words.tool, "offset") : 0;
  return width == 0 ? 2 : static_cast<std::uint32_t>(width);
}

}  // namespace ncport::dialects
