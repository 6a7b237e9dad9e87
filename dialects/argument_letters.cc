#include "dialects/argument_letters.h"

#include "dialects/fanuc/words.h"

namespace ncport::dialects {

std::uint32_t CellOfArgument(const Profile& profile, char letter) {
  return profile.language == Language::kFanuc ? fanuc::ArgumentCell(letter) : 0;
}

char LetterOfArgument(const Profile& profile, std::uint32_t cell) {
  return profile.language == Language::kFanuc ? fanuc::ArgumentLetter(cell) : '\0';
}

}  // namespace ncport::dialects
