#include "dialects/profile.h"

#include "dialects/word_template.h"

namespace ncport::dialects {

std::uint32_t Profile::OffsetDigits() const {
  const std::size_t width = words.tool.Known() ? WidthOf(*words.tool, "offset") : 0;
  return width == 0 ? 2 : static_cast<std::uint32_t>(width);
}

}  // namespace ncport::dialects
