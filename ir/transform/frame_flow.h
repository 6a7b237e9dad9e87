// The programmable frame as data flow, for passes that work it into the coordinates: its matrix as numbers. The shift
// beside it may be any expression and is followed by who uses it.
//
// A point w of the program stands at shift + matrix * w. Words that add act in the system that the earlier ones made:
// they multiply from the right (sinumerik-8.7).
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/modal_state.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// Rows are axes X Y Z of the workpiece, columns those of the program.
struct FrameMatrix {
  std::array<std::array<double, 3>, 3> at{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  bool operator==(const FrameMatrix&) const = default;
  [[nodiscard]] bool IsIdentity() const { return *this == FrameMatrix{}; }
  [[nodiscard]] bool IsDiagonal() const;
  /// Counter-clockwise seen against the axis.
  [[nodiscard]] FrameMatrix Rotated(std::uint8_t axis, double degrees) const;
  [[nodiscard]] FrameMatrix Scaled(std::uint8_t axis, double factor) const;
  [[nodiscard]] std::optional<FrameMatrix> Inverse() const;
  [[nodiscard]] FrameMatrix Times(const FrameMatrix& right) const;
};

/// What a frame does to a plane that it maps into itself.
struct PlaneImage {
  bool mirrored = false;  // clockwise becomes counter-clockwise
  double scale = 1;
};
/// None: the plane does not stay a plane of the machine, or circles do not stay circles.
std::optional<PlaneImage> ImageOf(const FrameMatrix& matrix, std::uint8_t first, std::uint8_t second);

struct FrameState {
  enum class Kind : std::uint8_t { kNoWay, kKnown, kUnknown };
  Kind kind = Kind::kNoWay;
  bool untouched = true;  // no frame at all: the shift is 0 too
  FrameMatrix matrix;
  bool operator==(const FrameState&) const = default;
};

struct FrameFlowOptions {
  /// Programs that put the frame of their caller back, by number.
  std::vector<bool> restores;
  /// The matrix is all that is asked for: it is the same in a called program, where an expression of the shift is not.
  bool only_matrix = false;
};

class FrameFlow {
 public:
  FrameFlow(const Module& module, const Machine& machine, const analysis::FlowGraphs& graphs,
            const analysis::CallGraph& calls, const analysis::ModalFlow& modes, const FrameFlowOptions& options);

  /// Some program has a word of the frame (with FrameOps that replace or add; no layers).
  [[nodiscard]] bool Any() const { return any_; }
  [[nodiscard]] FrameState Before(BlockId block) const;
  [[nodiscard]] FrameState After(ProgramId program, BlockId block) const;
  /// Why the frame behind this block is not known although it was before; empty if it is.
  [[nodiscard]] std::string_view Trouble(ProgramId program, BlockId block) const;

 private:
  struct Client;

  [[nodiscard]] const Word* FrameWord(BlockId block) const;
  FrameState Apply(ProgramId program, BlockId block, FrameState state, std::string_view* trouble) const;

  const Module& module_;
  const Machine& machine_;
  const analysis::ModalFlow& modes_;
  bool any_ = false;
  std::vector<FrameState> in_;  // per block
};

}  // namespace ncport::ir::transform
