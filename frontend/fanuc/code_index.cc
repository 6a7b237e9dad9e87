#include "frontend/fanuc/code_index.h"

#include <string>

namespace ncport::frontend::fanuc {

namespace {

namespace words = dialects::fanuc;

/// "G54.1" -> letter G, 541. False: not a code of that form.
bool Parse(std::string_view text, std::uint32_t& key) {
  if (text.size() < 2 || (text[0] != 'G' && text[0] != 'M')) return false;
  std::uint32_t tenths = 0;
  std::size_t i = 1;
  for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
    tenths = tenths * 10 + static_cast<std::uint32_t>(text[i] - '0');
  tenths *= 10;
  if (i + 1 < text.size() && text[i] == '.') {
    tenths += static_cast<std::uint32_t>(text[i + 1] - '0');
    i += 2;
  }
  key = static_cast<std::uint32_t>(text[0]) << 24U | tenths;
  return i == text.size();
}

}  // namespace

CodeIndex::CodeIndex(const dialects::Profile& profile, words::System system) {
  for (const dialects::CodeRow& row : words::Codes(system).Rows()) Add(row.text, {.code = &row});
  for (const words::SpecialRow& row : words::SpecialCodes()) {
    if (words::FindSpecial(system, row.text) != &row) continue;
    // M97 is a call on Haas controls only; on Mazak it ends macro interruption (mazak-lathe-1.1).
    if (row.special == words::Special::kLocalSubprogram && !profile.fanuc.local_call.Or(false)) continue;
    if (row.special == words::Special::kRefusedByHaas &&
        !profile.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas))
      continue;
    const bool haas = profile.fanuc.variant.Is(dialects::FanucSettings::Variant::kHaas);
    if (row.special == words::Special::kExtendedOffset && row.rule == words::kHaasRule && !haas) continue;
    Add(row.text, {.special = &row});
  }
  for (const words::CycleRow& row : words::Cycles()) {
    if (words::FindCycle(system, row.text) == &row) Add(row.text, {.cycle = &row});
  }
  AddSpindle(profile.spindle, kMainSpindle);
  AddSpindle(profile.second_spindle, kSecondSpindle);
  AddSpindle(profile.live_spindle, kLiveSpindle);
}

void CodeIndex::Add(std::string_view text, const CodeMeaning& meaning) {
  std::uint32_t key = 0;
  if (Parse(text, key)) meanings_[key] = meaning;
}

// The profile wins over the table: which spindle M3 turns is a matter of the machine (mazak-lathe-5.1).
void CodeIndex::AddSpindle(const dialects::SpindleWords& words, std::uint8_t index) {
  const auto add = [&](const dialects::Setting<std::string>& text, ir::SpindleState state) {
    if (!text.Known() || text->empty()) return;
    std::uint32_t key = 0;
    if (!Parse(*text, key)) return;
    CodeMeaning& meaning = meanings_[key];
    const dialects::CodeRow* row = meaning.code;
    meaning = {.spindle = true, .spindle_index = index, .state = state};
    if (index == kMainSpindle) meaning.code = row;
  };
  add(words.cw, ir::SpindleState::kCw);
  add(words.ccw, ir::SpindleState::kCcw);
  add(words.stop, ir::SpindleState::kStop);
}

const CodeMeaning& CodeIndex::Find(char letter, std::uint32_t tenths) const {
  static const CodeMeaning none;
  const auto found = meanings_.find(static_cast<std::uint32_t>(letter) << 24U | tenths);
  return found != meanings_.end() ? found->second : none;
}

}  // namespace ncport::frontend::fanuc
