// The letters of macro calls and the local variables that their values arrive in.
#pragma once

#include <cstdint>

#include "dialects/profile.h"

namespace ncport::dialects {

/// Local cell that the letter of a macro call fills; 0 = the language has no such calls, or the letter is none.
std::uint32_t CellOfArgument(const Profile& profile, char letter);
/// The letter that fills a local cell; 0 = no single letter does.
char LetterOfArgument(const Profile& profile, std::uint32_t cell);

}  // namespace ncport::dialects
