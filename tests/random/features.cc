#include "tests/random/features.h"

#include <charconv>

namespace ncport::tests::random {

namespace {

enum class Kind : std::uint8_t { kStatement, kChance };
struct Row {
  std::string_view name;
  Kind kind;
  std::uint16_t sinumerik;
  std::uint16_t fanuc;
};
constexpr Row kRows[] = {
#define NCPORT_FEATURE(Name, text, kind, sinumerik, fanuc) {text, Kind::kind, sinumerik, fanuc},
#include "tests/random/features.def"
};
static_assert(std::size(kRows) == kFeatures);

}  // namespace

std::string_view NameOf(Feature feature) { return kRows[static_cast<std::size_t>(feature)].name; }

bool Exists(Feature feature, Flavour flavour) {
  const Row& row = kRows[static_cast<std::size_t>(feature)];
  return (flavour == Flavour::kSinumerik ? row.sinumerik : row.fanuc) != 0;
}

bool IsStatement(Feature feature) { return kRows[static_cast<std::size_t>(feature)].kind == Kind::kStatement; }

Weights Weights::For(Flavour flavour) {
  Weights weights;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    weights.values[i] = flavour == Flavour::kSinumerik ? kRows[i].sinumerik : kRows[i].fanuc;
  }
  return weights;
}

bool Weights::Parse(std::string_view text, std::string& wrong) {
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(part.size() == text.size() ? part.size() : part.size() + 1);
    const std::size_t sign = part.find('=');
    std::size_t index = 0;
    while (index < kFeatures && (sign == std::string_view::npos || kRows[index].name != part.substr(0, sign))) ++index;
    std::uint16_t value = 0;
    if (index == kFeatures ||
        std::from_chars(part.data() + sign + 1, part.data() + part.size(), value).ptr != part.data() + part.size()) {
      wrong = part;
      return false;
    }
    values[index] = value;
  }
  return true;
}

}  // namespace ncport::tests::random
