// What each G and M number means in one G-code system, found by number.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "dialects/fanuc/words.h"
#include "dialects/profile.h"
#include "ir/modes.h"

namespace ncport::frontend::fanuc {

/// At most one of the pointers is set.
struct CodeMeaning {
  const dialects::CodeRow* code = nullptr;
  const dialects::fanuc::SpecialRow* special = nullptr;
  const dialects::fanuc::CycleRow* cycle = nullptr;
  // A spindle word of the profile.
  bool spindle = false;
  std::uint8_t spindle_index = 0;
  ir::SpindleState state = ir::SpindleState::kUnknown;

  [[nodiscard]] bool Known() const { return code != nullptr || special != nullptr || cycle != nullptr || spindle; }
};

class CodeIndex {
 public:
  CodeIndex(const dialects::Profile& profile, dialects::fanuc::System system);

  /// `letter`: G or M; `tenths`: number times ten.
  [[nodiscard]] const CodeMeaning& Find(char letter, std::uint32_t tenths) const;

 private:
  void Add(std::string_view text, const CodeMeaning& meaning);
  void AddSpindle(const dialects::SpindleWords& words, std::uint8_t index);

  std::unordered_map<std::uint32_t, CodeMeaning> meanings_;
};

/// Spindles of the IR: the work (of a lathe) or the tool (of a mill), the second work spindle, driven tools.
inline constexpr std::uint8_t kMainSpindle = 0;
inline constexpr std::uint8_t kSecondSpindle = 2;
inline constexpr std::uint8_t kLiveSpindle = 3;

}  // namespace ncport::frontend::fanuc
