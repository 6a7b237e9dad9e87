// Letters of macro calls, for writers of other languages that give parameters names.
#pragma once

#include <cstdint>

#include "dialects/fanuc/words.h"

namespace ncport::backends::fanuc {

/// Letter by which G65 reaches a local cell in list I; 0 = no letter does (fanuc-7.3).
inline char ArgumentLetter(std::uint32_t cell) { return dialects::fanuc::ArgumentLetter(cell); }

}  // namespace ncport::backends::fanuc
