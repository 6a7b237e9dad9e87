// New names and their types: what DEF and PROC declare.
#include <algorithm>
#include <vector>

#include "base/near_name.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/syntax_hints.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

namespace words = dialects::sinumerik;

// A word of the language, or a number, where a new name stands.
bool SyntaxHints::NewName() {
  if (error_.code != Code::kExpectedText || error_.detail == nullptr || at_ >= tokens_.size() ||
      std::string_view(error_.detail) != "a name")
    return false;
  const std::string_view text = TextOf(at_);
  if (text.size() > 1 && std::all_of(text.begin(), text.end(), [](char c) { return IsLetter(c) || c == '_'; })) {
    error_.code = Code::kReservedName;
    error_.detail = nullptr;
    return true;
  }
  if (Kind() == K::kComma) return Say("a name is missing in front of the comma");
  const std::size_t behind = tokens_[at_].offset + tokens_[at_].length;
  if (text.find('$') != std::string_view::npos || (behind < line_.size() && line_[behind] == '$'))
    return Say("a name holds letters, digits and _; $ stands in front of system variables");
  return Say("a name begins with two letters, or with _ and a letter");
}

// `DEF INT A-B`, `DEF INT A B`: signs inside a name, or a comma that is missing.
bool SyntaxHints::TornName() {
  const K first = KindAt(First());
  if (first != K::kDef || Before() != K::kName || Holds(K::kEquals) || at_ >= tokens_.size()) return false;
  if (IsOperator(Kind())) return Say("a name holds letters, digits and _");
  if (Kind() == K::kNumber || Kind() == K::kText || Kind() == K::kBoolean)
    return Say("a start value stands behind =: {}={}", TextOf(at_ - 1), TextOf(at_));
  if (TextOf(at_).starts_with('$'))
    return Say("a name holds letters, digits and _; $ stands in front of system variables");
  return StartsValue(Kind()) && Kind() != K::kLeftParen && Say("a comma stands between two names");
}

// `DEF INTEGER A`, `PROC P(A)`: a name where the type stands.
bool SyntaxHints::MissingType() {
  const K first = KindAt(First());
  if (Kind() != K::kName) return false;
  const bool definition = first == K::kDef && !Holds(K::kType) && !Holds(K::kStringType) && !Holds(K::kEquals);
  const bool parameter =
      first == K::kProc && (Before() == K::kLeftParen || Before() == K::kComma || Before() == K::kVar);
  if (!definition && !parameter) return false;
  Put(Code::kExpectedText, at_, "a type");
  if (const std::string split = AsTypeAndName(TextOf(at_)); !split.empty()) return Say("a blank is missing: {}", split);
  std::vector<std::string_view> types;
  for (const auto& row : words::Types()) types.push_back(row.text);
  std::string_view near = NearName(TextOf(at_), types);
  for (const std::string_view type : types) {
    if (near.empty() && type.size() > 2 && IsWord(TextOf(at_).substr(0, type.size()), type)) near = type;
  }
  if (!near.empty()) return Say("did you mean {}?", near);
  return Say("the types are INT, REAL, BOOL, CHAR, STRING[n], AXIS, FRAME");
}

}  // namespace ncport::frontend::sinumerik
