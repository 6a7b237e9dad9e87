#include "backends/fanuc/limit_m_words.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

/// M functions among the words of a text: "T1 M6 H1" has one.
std::size_t CountInText(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const bool starts = i == 0 || text[i - 1] < 'A' || text[i - 1] > 'Z';
    const char next = text[i + 1];
    if (text[i] == 'M' && starts && ((next >= '0' && next <= '9') || next == '#' || next == '[')) ++count;
  }
  return count;
}

/// M functions that the word is printed as.
std::size_t CountOf(const Module& module, const Word& word) {
  switch (word.op) {
    case WordOp::kAux:
    case WordOp::kComputedM:
    case WordOp::kSpindle:
    case WordOp::kStop:
    case WordOp::kOptionalStop:
    case WordOp::kToolChange:
    case WordOp::kProgramEnd:
    case WordOp::kReturn:
      return 1;
    case WordOp::kCall:
      return word.Extra<ir::CallId>().Valid() && !module.calls[word.Extra<ir::CallId>()].new_level ? 1 : 0;
    case WordOp::kInert:
      return word.spelling == 0 ? 0 : CountInText(module.View(module.spellings[word.spelling].text));
    default:
      return 0;
  }
}

/// Words that an M function behind them acts with: M6 changes to the T, M3 turns with the S.
bool LeadsIn(const Word& word) {
  return word.op == WordOp::kTool || word.op == WordOp::kToolOffset || word.op == WordOp::kSpeed ||
         word.op == WordOp::kSpeedMode || word.op == WordOp::kSpeedLimit;
}

/// G41, G42: in force before the M functions of its block. G40 stays with the motion, without one it would make its
/// own.
bool StartsCompensation(const Word& word) {
  return word.op == WordOp::kCutterComp && word.index != static_cast<std::uint8_t>(ir::CutterComp::kOff);
}

using Words = std::vector<Word>;

/// The parts of a block, in order.
class Parts {
 public:
  Parts(const Module& module, std::size_t limit) : module_(module), limit_(limit) {}

  /// Without motion or anything else that belongs between them: cut behind each full part.
  std::vector<Words> Split(const Block& block) {
    Words before, main, after;
    bool starts = false;
    for (const WordId id : block.words) starts = starts || StartsCompensation(module_.words[id]);
    std::size_t first = 0;  // words of the compensation in front of `before`
    std::size_t in_before = 0, in_after = 0;
    for (const WordId id : block.words) {
      const Word& word = module_.words[id];
      const std::size_t count = CountOf(module_, word);
      if (starts && (StartsCompensation(word) || word.op == WordOp::kRadiusOffset)) {
        before.insert(before.begin() + static_cast<std::ptrdiff_t>(first++), word);
      } else if (count == 0 && !LeadsIn(word)) {
        main.push_back(word);
      } else if (word.phase >= ir::Phase::kAfter) {
        after.push_back(word);
        in_after += count;
      } else {
        before.push_back(word);
        in_before += count;
      }
    }
    if (in_before + in_after <= limit_) return {};
    std::stable_sort(after.begin(), after.end(), [](const Word& a, const Word& b) { return a.phase < b.phase; });
    std::vector<Words> parts;
    Words part;
    std::size_t in_part = 0;
    const auto close = [&] {
      if (!part.empty()) parts.push_back(std::exchange(part, {}));
      in_part = 0;
    };
    const auto add = [&](const Word& word) {
      const std::size_t count = CountOf(module_, word);
      if (count != 0 && in_part + count > limit_) close();
      in_part += count;
      part.push_back(word);
    };
    // A T or S in front of an M goes with it into the next part.
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (LeadsIn(before[i]) && in_part >= limit_) close();
      add(before[i]);
    }
    // The rest stands beside the last of those before it and the first of those after it.
    part.insert(part.begin(), main.begin(), main.end());
    for (const Word& word : after) add(word);
    close();
    return parts;
  }

 private:
  const Module& module_;
  std::size_t limit_;
};

}  // namespace

void LimitMWords(const RaiseInput& input, Translation& out) {
  const auto limit = static_cast<std::size_t>(input.profile->block.max_m.Or(0));
  if (limit == 0) return;
  Module& module = out.module;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "limit_m_words");
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      const std::vector<Words> parts = Parts(module, limit).Split(block);
      if (parts.size() < 2) continue;
      for (std::size_t i = 0; i + 1 < parts.size(); ++i) editor.PutInFront(id, parts[i]);
      editor.SetWords(id, parts.back());
    }
    editor.Apply();
  }
}

}  // namespace ncport::backends::fanuc
