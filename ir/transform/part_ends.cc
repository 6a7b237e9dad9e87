#include "ir/transform/part_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/letter_case.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

struct Ending {
  PartId part;
  BlockId first, last;
};

}  // namespace

void MarkPartEnds(Module& module, ProgramId program, bool ignore_case) {
  const analysis::LabelTable labels(module, program, ignore_case);
  std::vector<Ending> endings;
  for (const BlockId id : module.programs[program].blocks) {
    for (const WordId word_id : module.blocks[id].words) {
      const Word& word = module.words[word_id];
      if (word.op != WordOp::kRepeatPart) continue;
      const auto part = word.Extra<PartId>();
      const auto range = labels.FindPart(module.parts[part], id);
      if (!range) continue;
      const bool before_repeat =
          !module.parts[part].single && !module.parts[part].has_last && std::size_t{range->last.value} + 1 == id.value;
      if (!before_repeat) endings.push_back({part, range->first, range->last});
    }
  }
  if (endings.empty()) return;
  // Of parts with one end the one that starts later may run inside the other: its end comes first.
  std::stable_sort(endings.begin(), endings.end(),
                   [](const Ending& a, const Ending& b) { return a.first.value > b.first.value; });
  ProgramEditor editor(module, program, "part_ends");
  std::set<std::string, std::less<>> taken;
  for (const BlockId id : module.programs[program].blocks) {
    if (!module.blocks[id].label.Valid()) continue;
    // Some languages compare labels without regard to case: new ones differ in every one.
    taken.insert(UpperOf(module.View(module.blocks[id].label)));
  }
  std::uint32_t number = 0;
  for (const Ending& ending : endings) {
    std::string name;
    do {
      name = fmt::format("PART_END_{}", ++number);
    } while (taken.contains(name));
    Block end = editor.MakeBlock(ending.last);
    end.flags = Block::kAdded;
    end.label = module.strings.Intern(name);
    editor.SetWords(end, {});
    editor.InsertAfter(ending.last, end);
    Part& part = module.parts[ending.part];
    part.single = false;
    part.has_last = true;
    part.last = {};
    part.last.kind = TargetKind::kLabel;
    part.last.label = end.label;
  }
  editor.Apply();
}

bool LeavesAtEndOnly(const Module& module, const analysis::LabelTable& labels,
                     const analysis::LabelTable::Range& range) {
  const auto inside = [&](BlockId id) { return id.Valid() && id >= range.first && id <= range.last; };
  for (BlockId at = range.first; at <= range.last; at = BlockId{std::size_t{at.value} + 1}) {
    const Block& block = module.blocks[at];
    const auto stays = [&](const Jump& jump) {
      if (jump.target.kind == TargetKind::kProgramStart || jump.target.kind == TargetKind::kExpression) return false;
      const BlockId to = labels.Find(jump.target, at, jump.search);
      return to.Valid() ? inside(to) : jump.quiet;
    };
    for (const WordId id : block.words) {
      const Word& word = module.words[id];
      if (IsStructureMark(word.op) && block.link.Valid() && !inside(block.link)) return false;
      if (word.op == WordOp::kRestart) return false;
      if (word.op == WordOp::kJump && !stays(module.jumps[word.Extra<JumpId>()])) return false;
      if (word.op != WordOp::kSwitch) continue;
      const Switch& cases = module.switches[word.Extra<SwitchId>()];
      for (std::uint32_t arm = 0; arm < cases.arm_count; ++arm) {
        if (!stays(module.jumps[module.switch_arms[cases.first_arm + arm].jump])) return false;
      }
    }
  }
  return true;
}

}  // namespace ncport::ir::transform
