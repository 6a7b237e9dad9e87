// SettleArcs: the words of arcs, where it is known which of them are there.
#include <algorithm>
#include <vector>

#include "backends/sinumerik/raise_words.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;

class Pass {
 public:
  Pass(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input),
        module_(out.module),
        sink_(sink),
        analyses_(input.Analyse(out.module)),
        flow_(analyses_.Modal()) {}

  bool Run() {
    for (const ir::ProgramId program : module_.programs.Ids()) {
      ir::transform::ProgramEditor editor(module_, program, "settle_arcs");
      for (const BlockId id : module_.programs[program].blocks) Settle(program, id, editor);
      editor.Apply();
    }
    return ok_;
  }

 private:
  void Settle(ir::ProgramId program, BlockId id, ir::transform::ProgramEditor& editor) {
    Block block = module_.blocks[id];
    bool center = false, radius = false;
    for (const WordId word : block.words) {
      center = center || module_.words[word].op == WordOp::kCenter;
      radius = radius || module_.words[word].op == WordOp::kRadius;
    }
    if ((!center && !radius) || !flow_.Reached(program, id)) return;
    const ir::ModalState at = flow_.At(program, id);
    std::vector<Word> words;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kCenter || word.op == WordOp::kRadius) {
        if (!TakesCenter(at.motion))
          return Refuse(block, word, "a centre or radius word where no arc is certain to be in force");
        if (word.op == WordOp::kCenter && radius && input_.source_machine->arc_radius_beats_center) continue;
        if (word.op == WordOp::kRadius && !CheckRadius(block, word, at)) continue;
      }
      words.push_back(word);
    }
    if (words.size() == block.words.count) return;
    editor.SetWords(id, words);
  }

  /// Arcs, helices and threads (exec: MoveByMode); beside a straight move these words are something else on lathes, and
  /// here an alarm.
  static bool TakesCenter(ir::Motion motion) { return motion >= ir::Motion::kArcCw && motion <= ir::Motion::kTapOut; }

  /// A radius without another end point is no motion at all there, an alarm here (fanuc-8.3, sinumerik-8.3). False: the
  /// word goes, and with it the motion.
  bool CheckRadius(const Block& block, const Word& word, const ir::ModalState& at) {
    if (!input_.source_machine->arc_radius_without_end_stays || at.plane == ir::Plane::kUnknown) return true;
    bool in_plane = false, any = false;
    for (const WordId word_id : block.words) {
      const Word& axis = module_.words[word_id];
      if (axis.op != WordOp::kAxis) continue;
      any = true;
      const std::uint8_t normal = at.plane == ir::Plane::kXY ? 2 : at.plane == ir::Plane::kZX ? 1 : 0;
      in_plane = in_plane || (axis.index < 3 && axis.index != normal);
    }
    if (!in_plane && any) Refuse(block, word, "an arc by its radius without an end point");
    return any;
  }

  void Refuse(const Block& block, const Word& word, std::string_view what) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block, word), what, input_.profile->name);
  }

  const RaiseInput& input_;
  Module& module_;
  diag::Sink& sink_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  bool ok_ = true;
};

}  // namespace

bool SettleArcs(const RaiseInput& input, Translation& out, diag::Sink& sink) { return Pass(input, out, sink).Run(); }

}  // namespace ncport::backends::sinumerik
