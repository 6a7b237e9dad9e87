// Texts of the source as comments of flat blocks: round brackets cannot nest, and the card wants upper case ASCII.
#pragma once

#include <string_view>

#include "base/text_buffer.h"

namespace ncport::backends::iso {

/// Appends `(prefix text)`: round brackets become square ones, letters upper case, other characters (also control
/// characters) that ASCII lacks `?`, blanks at both ends go. Nothing when both are empty.
void AppendFlatComment(TextBuffer& out, std::string_view prefix, std::string_view text);

}  // namespace ncport::backends::iso
