// How blocks are spelled in real programs (docs/languages/real-programs.md, section SINUMERIK), as data.
#pragma once

#include <span>
#include <string_view>

namespace ncport::tests {

/// One form. `spaced` has a blank at every place where one may stand; the other spellings are made from it, `printed`
/// is the one met in real programs (empty: as spaced). Lines are separated by LF. `refused_word` is not empty for forms
/// that the reader does not take: each spelling of them gives exactly one finding, which names this word.
struct Form {
  std::string_view row;  // number of the row in real-programs.md, or what it is about
  std::string_view spaced;
  std::string_view printed = {};
  std::string_view refused_word = {};
};
std::span<const Form> SinumerikForms();

}  // namespace ncport::tests
