// The one table of profile keys: path, values, meaning, and where the value goes. The loader and docs/profiles.md use
// it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "dialects/profile.h"

namespace ncport::dialects {

/// A text; with `holes` not empty or `pattern` true a word template (word_template.h).
struct TextKey {
  Setting<std::string>& (*get)(Profile&);
  bool pattern = false;
  std::string_view holes = {};  // separated by blanks
};
/// A list of texts (blocks, names).
struct TextsKey {
  Setting<std::vector<std::string>>& (*get)(Profile&);
};
struct NumberKey {
  Setting<double>& (*get)(Profile&);
  double least, most;
};
struct IntegerKey {
  Setting<std::int64_t>& (*get)(Profile&);
  std::int64_t least, most;
};
/// `yes` or `no`.
struct FlagKey {
  Setting<bool>& (*get)(Profile&);
};
/// `[first, last]`.
struct RangeKey {
  Setting<NumberRange>& (*get)(Profile&);
  std::uint32_t most;
};
/// One of a list of words; the index is the enumerator. An empty name: this enumerator cannot be written.
struct ChoiceKey {
  std::span<const std::string_view> names;
  void (*set)(Profile&, std::uint8_t);
  void (*ask)(Profile&);                        // null: the key needs a value
  void (*set_key)(Profile&, std::string_view);  // null with `ask`
};
/// Keys with a form of their own; the loader has a function for each.
enum class SpecialKey : std::uint8_t { kInherits, kAxes, kStart, kVariables, kMCodes, kScratch };

using KeyBinding = std::variant<TextKey, TextsKey, NumberKey, IntegerKey, FlagKey, RangeKey, ChoiceKey, SpecialKey>;

struct KeyRow {
  std::string_view path;     // "fanuc.atan-range"
  std::string_view meaning;  // one line, with units
  KeyBinding binding;
};

/// All rows in the order of the page.
std::span<const KeyRow> ProfileKeys();
const KeyRow* FindKey(std::string_view path);
/// The language that a key of a language table holds for; none: all.
std::optional<Language> LanguageOf(const KeyRow& row);
/// What may stand behind the key: "round | truncate | none", "0 .. 9".
std::string ValuesOf(const KeyRow& row);

/// True for a word that `mcodes` may name: M41, H5, G187, G54.1.
bool IsMCode(std::string_view word);

/// The page docs/profiles.md.
std::string ProfilePage();

}  // namespace ncport::dialects
