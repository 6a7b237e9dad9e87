#include "check/subject.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "base/letter_case.h"
#include "base/near_name.h"
#include "dialects/machine.h"

namespace ncport::check {
namespace {

bool IsNameCharacter(char c) { return (Upper(c) >= 'A' && Upper(c) <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

void AddWords(std::string_view text, std::unordered_set<std::string>& words) {
  std::size_t begin = 0;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    if (at < text.size() && IsNameCharacter(text[at])) continue;
    if (at > begin) words.emplace(text.substr(begin, at - begin));
    begin = at + 1;
  }
}

}  // namespace

Subject::Subject(const ir::Module& checked, const dialects::Profile& read_for, const ir::ModalState& sub_entry)
    : module(checked),
      profile(read_for),
      machine(dialects::MachineFor(profile)),
      ignore_case(profile.names.ignore_case.Or(true)),
      graphs(module, ignore_case),
      calls(module),
      modal(module, machine, graphs, calls, {machine.start, sub_entry}),
      refused_words_(module.programs.Size()) {
  has_cycles =
      std::ranges::any_of(module.words.All(), [](const ir::Word& word) { return word.op == ir::WordOp::kCycle; });
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      if ((block.flags & ir::Block::kRefused) == 0) continue;
      for (const ir::WordId word : block.words) {
        if (module.words[word].op != ir::WordOp::kVerbatim) continue;
        AddWords(KeyOf(module.View(module.words[word].Extra<StringId>())), refused_words_[program.value]);
      }
    }
  }
}

SourceRange Subject::PlaceOf(ir::BlockId block) const {
  const ir::Block& record = module.blocks[block];
  SourceRange range = module.RangeOf(record);
  if (record.words.Empty()) return range;
  const ir::Word& first = module.words[record.words[0]];
  const ir::Word& last = module.words[record.words[record.words.count - 1]];
  range.begin = first.begin;
  range.end = last.begin + last.length;
  return range;
}

SourceRange Subject::PlaceOf(ir::BlockId block, const ir::Word& word) const {
  return module.RangeOf(module.blocks[block], word);
}

SourceRange Subject::PlaceOf(const ir::Variable& variable) const {
  return {variable.file, variable.line, variable.begin, variable.begin + variable.length};
}

SourceRange Subject::PlaceOfLabel(ir::BlockId id) const {
  const ir::Block& block = module.blocks[id];
  SourceRange place = module.RangeOf(block);
  if (block.number == ir::Block::kNoNumber && block.skip_level == ir::Block::kNoSkip) {
    place.begin = block.indent;
    place.end = block.indent + static_cast<std::uint32_t>(module.View(block.label).size());
  }
  return place;
}

std::string Subject::KeyOf(std::string_view name) const {
  std::string key(name);
  if (!ignore_case) return key;
  for (char& c : key) c = Upper(c);
  return key;
}

bool Subject::InRefusedBlock(ir::ProgramId program, std::string_view name) const {
  const std::unordered_set<std::string>& words = refused_words_[program.value];
  return !words.empty() && words.contains(KeyOf(name));
}

bool Subject::NearRefusedWord(ir::ProgramId program, std::string_view name) const {
  const std::unordered_set<std::string>& words = refused_words_[program.value];
  if (words.empty()) return false;
  const std::vector<std::string_view> views(words.begin(), words.end());
  return !NearName(name, views).empty();
}

}  // namespace ncport::check
