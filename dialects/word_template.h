// Words with holes, as profiles give them to the writer: "T{tool:02}{offset:02}", "G4 X{seconds}".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/text_buffer.h"

namespace ncport::dialects {

struct TemplateValue {
  std::string_view hole;  // "tool"
  std::string_view text;  // "3"
};

/// Appends `pattern` with its holes filled. `{tool:02}` pads with zeros to two characters. A hole without a value is a
/// bug: the holes of profile keys are checked when the profile is read.
void AppendTemplate(TextBuffer& buffer, std::string_view pattern, std::span<const TemplateValue> values);

/// What is wrong with `pattern` if only these holes (separated by blanks) are known: empty if nothing.
std::string CheckTemplate(std::string_view pattern, std::string_view holes);

/// Width of a hole: 2 of `{offset:02}`, 1 of `{offset}`, 0 if the pattern lacks it.
std::size_t WidthOf(std::string_view pattern, std::string_view hole);

}  // namespace ncport::dialects
