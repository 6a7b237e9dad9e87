// What the events of one run do not show: a block that the operator may switch off, a tap that a plain move would
// break.
#include "backends/iso/flat_writer.h"
#include "ir/block_words.h"

namespace ncport::backends::iso {

void FlatWriter::RefuseWhatRan() {
  for (const ir::Program& program : module_.programs.All()) {
    for (const ir::BlockId id : program.blocks) {
      if (!Executed(id)) continue;
      const ir::Block& block = module_.blocks[id];
      origin_ = {id, nullptr};
      if (block.skip_level != ir::Block::kNoSkip) {
        if (diag::Diagnostic* finding = Refuse(diag::Code::kNotExpressible, "a block that the operator can skip"))
          finding->help = "flat blocks hold one run: flatten it without the /, and once more without the block";
      }
      const ir::Word* motion = ir::FindWord(module_, block, ir::WordOp::kMotion);
      // Under a feed override, or without the spindle in step, G1 breaks the tap (sinumerik-8.4).
      if (motion != nullptr && motion->index == static_cast<std::uint8_t>(ir::Motion::kTapFloating))
        Refuse(diag::Code::kNotExpressible, "tapping with a compensating chuck");
    }
  }
}

}  // namespace ncport::backends::iso
