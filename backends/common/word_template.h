// Word templates of a profile ("T{tool:02}{offset:02}", "G50 S{speed}") with their holes filled.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/text_buffer.h"

namespace ncport::backends {

/// What goes into `{name}`: a text as it is, or a whole number, with leading zeros where the hole says so (`{name:02}`).
struct Hole {
  std::string_view name;
  std::int64_t number = 0;
  std::string_view text;  // not empty: instead of the number
};

/// Appends `form` with its holes filled. A hole without a value is a bug: profiles are checked when they are read.
void AppendTemplate(TextBuffer& out, std::string_view form, std::span<const Hole> holes);

}  // namespace ncport::backends
