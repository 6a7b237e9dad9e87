// Arcs by their centre under a scale of its own layer whose factors differ in the plane: the control scales centre and
// end point each by its factor, and they lie on no circle then. An arc by its radius takes the larger factor
// (fanuc-8.6).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "check/expressions.h"
#include "check/motion_words.h"
#include "check/plane_axes.h"
#include "check/rules.h"
#include "ir/analysis/forward_flow.h"
#include "ir/analysis/main_programs.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::FrameOp;
using ir::ProgramId;
using ir::WordOp;

constexpr double kSame = 1e-9;

struct ScaleState {
  bool known = false;  // the same on every way
  std::array<double, 3> factors{1, 1, 1};
  BlockId scaled;  // where they stand
  bool operator==(const ScaleState&) const = default;
};

class ScaleFlow {
 public:
  using State = ScaleState;

  explicit ScaleFlow(const ir::Module& module) : module_(module) {}

  State Entry(ProgramId program) const { return {ir::analysis::StartsAsMain(module_, program), {1, 1, 1}, {}}; }
  static State Unknown(ProgramId) { return {}; }
  static bool Join(BlockId, State& into, const State& from) {
    if (into == from || !into.known) return false;
    into = {};
    return true;
  }
  void Transfer(ProgramId, BlockId id, State& state) const {
    const ir::Block& block = module_.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) state = {};
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = module_.words[word_id];
      if (MayDoAnything(module_, word)) state = {};
      if (word.op != WordOp::kFrame) continue;
      const auto op = static_cast<FrameOp>(word.index);
      if (op == FrameOp::kScaleEnd) state = {true, {1, 1, 1}, {}};
      if (op == FrameOp::kScaleAbout) state = Scaled(id);
    }
  }

 private:
  [[nodiscard]] State Scaled(BlockId id) const {
    State state{true, {1, 1, 1}, id};
    // The word for all axes first: those of single axes win.
    for (const bool single : {false, true}) {
      for (const ir::WordId word_id : module_.blocks[id].words) {
        const ir::Word& word = module_.words[word_id];
        if (word.op != WordOp::kFrameFactor || (word.index != 0) != single) continue;
        const std::optional<double> value = LiteralValue(module_, word.value);
        if (!value || *value == 0) return {};
        const double factor = (word.flags & ir::Word::kIncrements) != 0 ? *value / kUnits : *value;
        if (single)
          state.factors[word.index - 1U] = factor;
        else
          state.factors.fill(factor);
      }
    }
    return state;
  }

  static constexpr double kUnits = 1000;  // a number without point counts thousandths
  const ir::Module& module_;
};

bool HasWord(const ir::Module& module, const ir::Block& block, WordOp op) {
  for (const ir::WordId id : block.words) {
    if (module.words[id].op == op) return true;
  }
  return false;
}

}  // namespace

void CheckScaleArcs(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  if (std::ranges::none_of(module.words.All(), [](const ir::Word& word) { return word.op == WordOp::kFrameFactor; }))
    return;
  ScaleFlow client(module);
  ir::analysis::ForwardFlow<ScaleFlow> flow({module, subject.machine, subject.graphs, subject.calls, &subject.modal},
                                            client);
  flow.Run();
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const ScaleState* before = flow.Before(id);
      if (before == nullptr || !before->known || (block.flags & ir::Block::kRefused) != 0) continue;
      const ir::ModalState modes = subject.modal.At(program, id);
      const ir::Word* arc = ArcWord(module, block, modes.motion);
      const auto axes = AxesOf(modes.plane);
      if (arc == nullptr || !axes || !HasWord(module, block, WordOp::kCenter) ||
          HasWord(module, block, WordOp::kRadius) || HasWord(module, block, WordOp::kFrame))
        continue;
      const double first = std::fabs(before->factors[(*axes)[0]]), second = std::fabs(before->factors[(*axes)[1]]);
      if (std::fabs(first - second) <= kSame * std::fmax(first, second)) continue;
      diag::Diagnostic& finding = sink.Report(diag::Code::kUnequalScales, subject.PlaceOf(id, *arc),
                                              fmt::format("{:.6g}", first), fmt::format("{:.6g}", second));
      for (const ir::WordId word : module.blocks[before->scaled].words) {
        if (module.words[word].op != WordOp::kFrame) continue;
        finding.notes.push_back({subject.PlaceOf(before->scaled, module.words[word]), "the factors stand here"});
      }
      finding.help =
          "an arc by its centre needs one factor for both axes of its plane; by its radius it takes the larger";
      break;  // once a program: the next ones stand under the same factors
    }
  }
}

}  // namespace ncport::check
