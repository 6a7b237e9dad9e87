#include "backends/fanuc/corners.h"

#include <cmath>
#include <optional>
#include <string_view>

#include "ir/analysis/flow_analyses.h"
#include "ir/builder.h"
#include "ir/length_units.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ChamferKind;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

/// Axes of a straight move in the plane; none: the block is, or does, something else.
struct Side {
  std::uint16_t axes = 0;
  bool feed = false;
};

class Mapper {
 public:
  Mapper(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input), module_(out.module), sink_(sink), analyses_(input.Analyse(module_)), flow_(analyses_.Modal()) {}

  bool Run() {
    for (const ProgramId program : module_.programs.Ids()) {
      const IdRange<BlockId> blocks = module_.programs[program].blocks;
      for (std::uint32_t i = 0; i < blocks.count; ++i) {
        for (const WordId id : module_.blocks[blocks[i]].words) {
          if (module_.words[id].op == WordOp::kChamfer) Map(program, i, id);
        }
      }
    }
    return ok_;
  }

 private:
  void Refuse(const Block& block, const Word& word, std::string_view what, std::string_view help) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block, word), what, input_.profile->name).help = help;
  }

  [[nodiscard]] std::optional<Side> SideOf(ProgramId program, BlockId id) const {
    const ir::ModalState state = flow_.At(program, id);
    const Block& block = module_.blocks[id];
    if (state.motion != ir::Motion::kLinear || block.skip_level != Block::kNoSkip) return std::nullopt;
    Side side;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      switch (word.op) {
        case WordOp::kAxis:
          side.axes = static_cast<std::uint16_t>(side.axes | (1U << word.index));
          break;
        case WordOp::kFeed:
          side.feed = true;
          break;
        case WordOp::kMotion:
        case WordOp::kDistance:
        case WordOp::kChamfer:
          break;
        default:
          return std::nullopt;
      }
    }
    const std::uint16_t plane = state.plane == ir::Plane::kXY   ? 3
                                : state.plane == ir::Plane::kZX ? 5
                                : state.plane == ir::Plane::kYZ ? 6
                                                                : 0;
    if (side.axes == 0 || (side.axes & ~plane) != 0) return std::nullopt;
    return side;
  }

  void Map(ProgramId program, std::uint32_t index, WordId id) {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    const Block block = module_.blocks[blocks[index]];
    const Word word = module_.words[id];
    const auto kind = static_cast<ChamferKind>(word.index);
    if (kind == ChamferKind::kRoundModal)
      return Refuse(block, word, "a rounding of all corners (RNDM)", "write RND at each corner");
    const ir::Units units = flow_.At(program, blocks[index]).units;
    if (ir::LengthsAreInches(units) || units == ir::Units::kUnknown)
      return Refuse(block, word, "a chamfer or rounding in inches", "write it in mm");
    const std::optional<Side> first = SideOf(program, blocks[index]);
    std::optional<Side> second;
    for (std::uint32_t next = index + 1; next < blocks.count; ++next) {
      if (module_.blocks[blocks[next]].words.Empty()) continue;
      second = SideOf(program, blocks[next]);
      break;
    }
    if (!first || !second)
      return Refuse(block, word, "a corner that is not between two straight moves in the plane, one behind the other",
                    "write the corner as moves of its own");
    if (second->feed)
      return Refuse(block, word, "a corner in front of a new feed: whose feed it has differs between controls",
                    "write F in the block of the corner or later");
    if (kind != ChamferKind::kLength || CornersToMoves(*input_.profile) != Corners::kNone) return;
    // The length of a chamfer is the hypotenuse: its legs follow where the sides stand at right angles (sinumerik-8.9).
    const auto one_axis = [](std::uint16_t axes) { return (axes & (axes - 1)) == 0; };
    if (!one_axis(first->axes) || !one_axis(second->axes) || first->axes == second->axes)
      return Refuse(block, word, "CHF at a corner that may not be a right angle", "write CHR, the leg of the chamfer");
    ir::ExprBuilder make(module_);
    const ir::Expr value = module_.exprs[word.value];
    const ir::ExprId leg =
        value.op == ir::ExprOp::kLiteral
            ? make.Literal(value.number / std::sqrt(2.0))
            : make.Binary(ir::ExprOp::kMultiply, make.Unary(ir::ExprOp::kGroup, word.value), make.Literal(0.70710678));
    module_.words[id].value = leg;
    module_.words[id].index = static_cast<std::uint8_t>(ChamferKind::kLeg);
  }

  const RaiseInput& input_;
  Module& module_;
  diag::Sink& sink_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  bool ok_ = true;
};

}  // namespace

Corners CornersToMoves(const dialects::Profile& profile) {
  const bool words =
      !profile.IsMazakLathe() && profile.fanuc.corner_words.Is(dialects::FanucSettings::CornerWords::kComma);
  return !words ? Corners::kAll : profile.IsLathe() ? Corners::kByLength : Corners::kNone;
}

bool MapCorners(const RaiseInput& input, Translation& out, diag::Sink& sink) { return Mapper(input, out, sink).Run(); }

}  // namespace ncport::backends::fanuc
