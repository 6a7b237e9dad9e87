#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "base/letter_case.h"
#include "check/structure_rules.h"

namespace ncport::check {

namespace {

using ir::WordOp;

/// Words that do something. An end word, a stop or a mark that control never comes to is no mistake: programs are
/// written with both, and a stop behind an alarm is the belt to its braces, with or without one of the preprocessing.
bool DoesSomething(const ir::Module& module, const ir::Block& block) {
  const auto does = [&](ir::WordId id) {
    switch (const WordOp op = module.words[id].op; op) {
      case WordOp::kProgramEnd:
      case WordOp::kReturn:
      case WordOp::kRestart:
      case WordOp::kStop:
      case WordOp::kPreprocessStop:
      case WordOp::kFileMark:
      case WordOp::kHeader:
      case WordOp::kDefine:
      case WordOp::kExtern:
      case WordOp::kVerbatim:
      case WordOp::kInert:
      case WordOp::kMessage:
      case WordOp::kJump:
        return false;
      default:
        return !ir::IsStructureMark(op);
    }
  };
  for (const ir::WordId id : block.words) {
    if (does(id)) return true;
  }
  return false;
}

/// Names in texts that calls get, in upper case: "CON_A:CON_E" hands a cycle the blocks between two labels.
std::set<std::string> NamesInTexts(const ir::Module& module) {
  std::set<std::string> names;
  for (const ir::Arg& arg : module.args.All()) {
    if (!arg.value.Valid() || module.exprs[arg.value].op != ir::ExprOp::kText) continue;
    const std::string text = UpperOf(module.View(StringId{std::size_t{module.exprs[arg.value].a}}));
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(':', begin), text.size());
      names.insert(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return names;
}

}  // namespace

void CheckUnreachable(const ir::Module& module, ir::ProgramId program, const ir::analysis::FlowGraphs& graphs,
                      diag::Sink& sink) {
  const ir::analysis::Cfg& graph = graphs.Of(program);
  if (graph.Opaque()) return;
  const IdRange<ir::BlockId> blocks = graph.Blocks();
  // Calls of block ranges and from a block start where no way of the program leads.
  for (const ir::Call& call : module.calls.All()) {
    if (call.form == ir::CallForm::kBlockRange || call.from_block) return;
  }
  // A block that was not understood may be a jump or a call to any block with a name.
  bool refused = false;
  for (const ir::BlockId block : blocks) refused = refused || (module.blocks[block].flags & ir::Block::kRefused) != 0;
  const std::set<std::string> named_in_texts = NamesInTexts(module);
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    if (graph.Reachable(blocks[i])) continue;
    std::uint32_t last = i;
    ir::BlockId first;
    bool unclear = false;
    for (; last < blocks.count && !graph.Reachable(blocks[last]); ++last) {
      const ir::Block& block = module.blocks[blocks[last]];
      // A refused block has its finding, and what it would do is not known.
      if (!first.Valid() && !block.words.Empty() && DoesSomething(module, block)) first = blocks[last];
      const bool named = block.label.Valid() || block.number != ir::Block::kNoNumber;
      unclear = unclear || (block.label.Valid() && named_in_texts.contains(UpperOf(module.View(block.label))));
      unclear = unclear || (block.flags & ir::Block::kRefused) != 0 || (refused && named);
    }
    if (first.Valid() && !unclear) {
      const ir::Block& block = module.blocks[first];
      sink.Report(diag::Code::kUnreachableBlock, module.RangeOf(block, module.words[block.words[0]]));
    }
    i = last;
  }
}

}  // namespace ncport::check
