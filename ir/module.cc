#include "ir/module.h"

#include <algorithm>

#include "base/letter_case.h"

namespace ncport::ir {

namespace {

bool SameName(std::string_view a, std::string_view b, bool ignore_case) {
  return ignore_case ? EqualIgnoringCase(a, b) : a == b;
}

}  // namespace

SourceRange Module::RangeOf(const Block& block) const {
  if (!block.origin.Valid()) return {};
  const Origin& origin = origins[block.origin];
  return {origin.file, origin.line, 0, 0};
}

SourceRange Module::RangeOf(const Block& block, const Word& word) const {
  SourceRange range = RangeOf(block);
  range.begin = word.begin;
  range.end = word.begin + word.length;
  return range;
}

SourceRange Module::RangeOf(const Block& block, ExprId expr) const {
  const ExprPlace place = expr_places.Of(expr);
  if (place.length == 0 && expr.Valid()) {
    for (const WordId word : block.words) {
      if (words[word].value == expr) return RangeOf(block, words[word]);
    }
  }
  SourceRange range = RangeOf(block);
  range.begin = place.begin;
  range.end = place.begin + place.length;
  return range;
}

ProgramId Module::FindProgram(std::string_view name, bool ignore_case) const {
  for (const ProgramId id : programs.Ids()) {
    if (SameName(View(programs[id].name), name, ignore_case)) return id;
  }
  return {};
}

}  // namespace ncport::ir
