#include "ir/transform/resolve_axes.h"

#include <optional>

#include "ir/plane_axes.h"

namespace ncport::ir::transform {

namespace {

std::optional<std::uint8_t> AxisOf(const Module& module, ExprId id, Plane plane) {
  const Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kGroup:
    case ExprOp::kConvert:
      return AxisOf(module, ExprId{expr.a}, plane);
    case ExprOp::kAxisName:
      return static_cast<std::uint8_t>(expr.a);
    case ExprOp::kSystem: {
      const System& system = module.systems[SystemId{expr.a}];
      if (system.kind != SystemKind::kPlaneAxis || plane == Plane::kUnknown) return std::nullopt;
      const PlaneAxes axes = AxesOf(plane);
      return system.number == 1 ? axes.first : system.number == 2 ? axes.second : axes.normal;
    }
    default:
      return std::nullopt;
  }
}

}  // namespace

void ResolveAxes(Module& module, const analysis::ModalFlow& flow) {
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      for (const WordId word_id : module.blocks[id].words) {
        const Word word = module.words[word_id];
        if (word.op != WordOp::kAxisComputed) continue;
        // Values are taken before the block's own plane holds; a block that changes the plane stays as it is.
        Plane plane = flow.Before(program, id).plane;
        if (plane != flow.At(program, id).plane) plane = Plane::kUnknown;
        const auto axis = AxisOf(module, word.Extra<ExprId>(), plane);
        if (!axis) continue;
        Word& plain = module.words[word_id];
        plain.op = WordOp::kAxis;
        plain.index = *axis;
        plain.extra = Id<void>::kNone;
        plain.spelling = 0;
      }
    }
  }
}

}  // namespace ncport::ir::transform
