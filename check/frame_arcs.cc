// Arcs in a plane whose axes the frame scales differently: what it makes of a circle is none (sinumerik-8.7).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "check/motion_words.h"
#include "check/plane_axes.h"
#include "check/rules.h"
#include "ir/transform/frame_flow.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ProgramId;
using ir::transform::FrameFlow;
using ir::transform::FrameFlowOptions;
using ir::transform::FrameMatrix;
using ir::transform::FrameState;

constexpr double kSame = 1e-9;

/// How far the frame stretches the directions of the plane: the axes themselves where they stay at right angles, else
/// the directions with the largest and the least factor. The plane may be tilted.
std::array<double, 2> FactorsOf(const FrameMatrix& matrix, std::size_t first, std::size_t second) {
  double a = 0, b = 0, mixed = 0;  // squares
  for (std::size_t row = 0; row < 3; ++row) {
    a += matrix.at[row][first] * matrix.at[row][first];
    b += matrix.at[row][second] * matrix.at[row][second];
    mixed += matrix.at[row][first] * matrix.at[row][second];
  }
  if (std::fabs(mixed) <= kSame * std::sqrt(a * b)) return {std::sqrt(a), std::sqrt(b)};
  const double middle = (a + b) / 2, spread = std::hypot((a - b) / 2, mixed);
  return {std::sqrt(middle + spread), std::sqrt(std::fmax(middle - spread, 0))};
}

/// The frame word that scales in the program in front of the block, the last of the text; for the note.
const ir::Word* ScaleBefore(const ir::Module& module, ProgramId program, BlockId block, BlockId& place) {
  const ir::Word* found = nullptr;
  for (const BlockId id : module.programs[program].blocks) {
    if (id == block) break;
    for (const ir::WordId word_id : module.blocks[id].words) {
      const ir::Word& word = module.words[word_id];
      if (word.op != ir::WordOp::kFrame) continue;
      const auto op = static_cast<ir::FrameOp>(word.index);
      if (op != ir::FrameOp::kScale && op != ir::FrameOp::kAddScale) continue;
      found = &word;
      place = id;
    }
  }
  return found;
}

}  // namespace

void CheckFrameArcs(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  FrameFlowOptions options;
  options.only_matrix = true;
  for (const ProgramId program : module.programs.Ids())
    options.restores.push_back(module.programs[program].saves_modal_state);
  const FrameFlow frames(module, subject.machine, subject.graphs, subject.calls, subject.modal, options);
  if (!frames.Any()) return;
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      if ((block.flags & ir::Block::kRefused) != 0) continue;
      const ir::ModalState modes = subject.modal.At(program, id);
      // A circle through a point in space has its plane by itself.
      if (modes.motion == ir::Motion::kArcVia) continue;
      const ir::Word* arc = ArcWord(module, block, modes.motion);
      const auto axes = AxesOf(modes.plane);
      if (arc == nullptr || !axes) continue;
      const FrameState frame = frames.Before(id);
      if (frame.kind != FrameState::Kind::kKnown) continue;
      const auto [a, b] = FactorsOf(frame.matrix, (*axes)[0], (*axes)[1]);
      if (std::fabs(a - b) <= kSame * std::fmax(a, b)) continue;
      diag::Diagnostic& finding = sink.Report(diag::Code::kUnequalScales, subject.PlaceOf(id, *arc),
                                              fmt::format("{:.6g}", a), fmt::format("{:.6g}", b));
      BlockId place;
      if (const ir::Word* scale = ScaleBefore(module, program, id, place))
        finding.notes.push_back({subject.PlaceOf(place, *scale), "the factors stand here"});
      finding.help = "an arc needs one factor for both axes of its plane";
      break;  // once a program: the next ones stand under the same factors
    }
  }
}

}  // namespace ncport::check
