#include "frontend/common/text_tables.h"

namespace ncport::frontend {

namespace {

std::uint64_t KeyOf(StringId text, StringId rule) { return std::uint64_t{text.value} << 32U | rule.value; }

}  // namespace

TextTables::TextTables(ir::Module& module) : module_(module) {
  for (std::uint32_t i = 1; i < module_.spellings.size(); ++i) {
    const ir::Spelling& spelling = module_.spellings[i];
    spellings_.emplace(KeyOf(spelling.text, spelling.rule), static_cast<std::uint16_t>(i));
  }
  for (std::uint32_t i = 1; i < module_.literal_texts.size(); ++i)
    literal_texts_.emplace(module_.literal_texts[i].value, static_cast<std::uint16_t>(i));
}

std::uint16_t TextTables::SpellingOf(std::string_view text, std::string_view rule) {
  const StringId text_id = module_.strings.Intern(text);
  const StringId rule_id = module_.strings.Intern(rule);
  const std::uint64_t key = KeyOf(text_id, rule_id);
  const auto found = spellings_.find(key);
  if (found != spellings_.end()) return found->second;
  if (module_.spellings.size() > 0xFFFF) return 0;
  const auto index = static_cast<std::uint16_t>(module_.spellings.size());
  module_.spellings.push_back({text_id, rule_id});
  spellings_.emplace(key, index);
  return index;
}

std::uint16_t TextTables::LiteralText(StringId text) {
  const auto [it, added] = literal_texts_.emplace(text.value, static_cast<std::uint16_t>(module_.literal_texts.size()));
  if (added && module_.literal_texts.size() < 0xFFFF) module_.literal_texts.push_back(text);
  return it->second;
}

}  // namespace ncport::frontend
