#include <string>
#include <vector>

#include "check/rules.h"
#include "check/targets.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::WordOp;

bool Opens(WordOp op) {
  return op == WordOp::kIf || op == WordOp::kWhile || op == WordOp::kLoop || op == WordOp::kRepeat ||
         op == WordOp::kFor;
}
bool ClosesLoop(WordOp op) {
  return op == WordOp::kEndWhile || op == WordOp::kEndLoop || op == WordOp::kUntil || op == WordOp::kEndFor;
}

/// For each block of a program the mark that the innermost part around it begins with: IF, ELSE or the start of a loop.
class Nesting {
 public:
  Nesting(const ir::Module& module, ir::ProgramId program) : first_(module.programs[program].blocks.begin) {
    std::vector<BlockId> open;
    const auto inside = [&] { return open.empty() ? BlockId{} : open.back(); };
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const WordOp mark = MarkOf(module, block);
      // A mark without its partner has its finding and holds nothing together.
      const bool joined = block.link.Valid();
      if (joined && mark == WordOp::kElse && !open.empty()) open.pop_back();
      if (joined && mark == WordOp::kEndIf && !open.empty()) open.pop_back();
      inner_.push_back(inside());
      if (joined && (Opens(mark) || mark == WordOp::kElse)) open.push_back(id);
      if (joined && ClosesLoop(mark) && !open.empty()) open.pop_back();
    }
  }

  /// The mark of the innermost part around the block; none: it stands outside of all.
  [[nodiscard]] BlockId Around(BlockId block) const { return inner_[block.value - first_]; }
  [[nodiscard]] bool Holds(BlockId mark, BlockId block) const {
    for (BlockId at = Around(block); at.Valid(); at = Around(at)) {
      if (at == mark) return true;
    }
    return false;
  }

 private:
  static WordOp MarkOf(const ir::Module& module, const ir::Block& block) {
    for (const ir::WordId id : block.words) {
      if (ir::IsStructureMark(module.words[id].op)) return module.words[id].op;
    }
    return WordOp::kVerbatim;
  }

  std::uint32_t first_;
  std::vector<BlockId> inner_;  // none: outside of all
};

}  // namespace

void CheckJumpsIntoStructures(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  const Nesting nesting(module, program);
  const ir::analysis::LabelTable& labels = subject.graphs.LabelsOf(program);
  for (const BlockId block : module.programs[program].blocks) {
    ForEachTarget(module, module.blocks[block], [&](const TargetUse& use) {
      if (!use.is_jump || !IsWritten(use.target)) return;
      const BlockId to = labels.Find(use.target, block, use.search);
      if (!to.Valid()) return;
      const BlockId mark = nesting.Around(to);
      if (!mark.Valid() || mark == block || nesting.Holds(mark, block)) return;
      const ir::Block& opener = module.blocks[mark];
      diag::Diagnostic& finding =
          sink.Report(diag::Code::kJumpIntoStructure, subject.PlaceOf(block, use.word), TargetText(module, use.target));
      finding.notes.push_back({module.RangeOf(module.blocks[to]), "the jump goes here"});
      finding.notes.push_back({module.RangeOf(opener), "this structure begins here"});
      finding.help = "jump to a block in front of the structure";
    });
  }
}

}  // namespace ncport::check
