#include "ir/transform/frame_flow.h"

#include <cmath>
#include <optional>

#include "ir/analysis/forward_flow.h"
#include "ir/ops/trigonometry.h"
#include "ir/transform/linear_form.h"

namespace ncport::ir::transform {

namespace {

constexpr double kNoise = 1e-12;
constexpr double kSameLength = 1e-9;

double Clean(double value) {
  const double nearest = std::round(value);
  return std::fabs(value - nearest) < kNoise ? nearest + 0.0 : value;
}

bool Adds(FrameOp op) { return op >= FrameOp::kAddTranslate && op <= FrameOp::kAddMirror; }

}  // namespace

bool FrameMatrix::IsDiagonal() const {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      if (row != column && at[row][column] != 0) return false;
    }
  }
  return true;
}

FrameMatrix FrameMatrix::Times(const FrameMatrix& right) const {
  FrameMatrix product;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += at[row][i] * right.at[i][column];
      product.at[row][column] = Clean(sum);
    }
  }
  return product;
}

FrameMatrix FrameMatrix::Rotated(std::uint8_t axis, double degrees) const {
  const double c = ops::Cos(degrees), s = ops::Sin(degrees);
  const std::size_t u = (axis + 1U) % 3, v = (axis + 2U) % 3;
  FrameMatrix rotation;
  rotation.at[u][u] = c;
  rotation.at[u][v] = -s;
  rotation.at[v][u] = s;
  rotation.at[v][v] = c;
  return Times(rotation);
}

FrameMatrix FrameMatrix::Scaled(std::uint8_t axis, double factor) const {
  FrameMatrix scale;
  scale.at[axis][axis] = factor;
  return Times(scale);
}

std::optional<FrameMatrix> FrameMatrix::Inverse() const {
  const auto minor = [&](std::size_t row, std::size_t column) {
    const std::size_t r0 = (row + 1) % 3, r1 = (row + 2) % 3, c0 = (column + 1) % 3, c1 = (column + 2) % 3;
    return at[r0][c0] * at[r1][c1] - at[r0][c1] * at[r1][c0];
  };
  const double determinant = at[0][0] * minor(0, 0) + at[0][1] * minor(0, 1) + at[0][2] * minor(0, 2);
  if (std::fabs(determinant) < kNoise) return std::nullopt;
  FrameMatrix inverse;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      inverse.at[row][column] = Clean(minor(column, row) / determinant);
  }
  return inverse;
}

std::optional<PlaneImage> ImageOf(const FrameMatrix& matrix, std::uint8_t first, std::uint8_t second) {
  const auto normal = static_cast<std::size_t>(3 - first - second);
  const auto& m = matrix.at;
  if (m[normal][first] != 0 || m[normal][second] != 0 || m[first][normal] != 0 || m[second][normal] != 0)
    return std::nullopt;
  const double first_length = std::hypot(m[first][first], m[second][first]);
  const double second_length = std::hypot(m[first][second], m[second][second]);
  const double dot = m[first][first] * m[first][second] + m[second][first] * m[second][second];
  if (std::fabs(first_length - second_length) > kSameLength * first_length ||
      std::fabs(dot) > kSameLength * first_length * first_length || first_length == 0)
    return std::nullopt;
  const double turn = m[first][first] * m[second][second] - m[second][first] * m[first][second];
  return PlaneImage{turn < 0, Clean(first_length)};
}

/// A shift may be an expression of the program that wrote it: where another program goes on, only no frame at all is
/// the same.
struct FrameFlow::Client {
  using State = FrameState;

  const FrameFlow& flow;
  const std::vector<bool>& restores;
  bool only_matrix;
  std::vector<bool> sets;          // per program: it or a program below has frame words
  std::vector<bool> from_outside;  // per program: its callers are not known

  static FrameState Anything() { return {FrameState::Kind::kUnknown, false, {}}; }
  [[nodiscard]] FrameState Elsewhere(const FrameState& state) const {
    if (only_matrix) return state;
    return state.kind == FrameState::Kind::kKnown && state.untouched ? state : Anything();
  }
  [[nodiscard]] bool Keeps(ProgramId program) const { return !sets[program.value] || restores[program.value]; }

  [[nodiscard]] State Entry(ProgramId program) const {
    return from_outside[program.value] && sets[program.value] ? Anything()
                                                              : FrameState{FrameState::Kind::kKnown, true, {}};
  }
  [[nodiscard]] State Unknown(ProgramId) const { return Anything(); }
  bool Join(BlockId, State& into, const State& from) const {
    if (into.kind == FrameState::Kind::kUnknown || into == from) return false;
    if (from.kind == FrameState::Kind::kUnknown || !(into.matrix == from.matrix)) {
      into = Anything();
      return true;
    }
    if (!into.untouched || from.untouched) return false;
    into.untouched = false;
    return true;
  }
  void Transfer(ProgramId program, BlockId block, State& state) const {
    // What a block that was not understood does to the frame is not known. Translations see none.
    if ((flow.module_.blocks[block].flags & Block::kRefused) != 0) state = Anything();
    if (flow.FrameWord(block) != nullptr) state = flow.Apply(program, block, state, nullptr);
  }
  [[nodiscard]] std::optional<State> Into(const analysis::CallSite&, analysis::CallMoment moment,
                                          const State& at) const {
    if (moment == analysis::CallMoment::kModalStart) return std::nullopt;
    return Elsewhere(at);
  }
  [[nodiscard]] State Back(const analysis::CallSite& site, const State& at, const State& exit) const {
    return site.callee.Valid() && Keeps(site.callee) ? at : Elsewhere(exit);
  }
};

FrameFlow::FrameFlow(const Module& module, const Machine& machine, const analysis::FlowGraphs& graphs,
                     const analysis::CallGraph& calls, const analysis::ModalFlow& modes,
                     const FrameFlowOptions& options)
    : module_(module), machine_(machine), modes_(modes) {
  std::vector<bool> restores = options.restores;
  restores.resize(module.programs.Size(), false);
  Client client{*this, restores, options.only_matrix, std::vector<bool>(module.programs.Size(), false),
                std::vector<bool>(module.programs.Size(), false)};
  for (const ProgramId program : module.programs.Ids()) {
    client.from_outside[program.value] = module.programs[program].kind != ProgramKind::kMain;
    for (const BlockId block : module.programs[program].blocks) {
      if (FrameWord(block) != nullptr) client.sets[program.value] = true;
    }
    any_ = any_ || client.sets[program.value];
  }
  if (!any_) return;
  for (bool more = true; more;) {
    more = false;
    for (const analysis::CallSite& site : calls.AllSites()) {
      if (!site.callee.Valid() || client.Keeps(site.callee) || client.sets[site.caller.value]) continue;
      client.sets[site.caller.value] = true;
      more = true;
    }
  }
  analysis::ForwardFlow<Client> flow({module, machine, graphs, calls, &modes}, client);
  flow.Run();
  in_.resize(module.blocks.Size());
  for (const BlockId block : module.blocks.Ids()) {
    if (const FrameState* state = flow.Before(block)) in_[block.value] = *state;
  }
}

const Word* FrameFlow::FrameWord(BlockId block) const {
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op == WordOp::kFrame && word.index < static_cast<std::uint8_t>(FrameOp::kLocalShift)) return &word;
  }
  return nullptr;
}

FrameState FrameFlow::Apply(ProgramId program, BlockId block, FrameState state, std::string_view* trouble) const {
  const Word* frame = FrameWord(block);
  const auto op = static_cast<FrameOp>(frame->index);
  const auto unknown = [&](std::string_view why) {
    if (trouble != nullptr) *trouble = why;
    return FrameState{FrameState::Kind::kUnknown, false, {}};
  };
  bool named[3] = {}, any = false;
  double value[3] = {}, angle = 0;
  bool plane_angle = false;
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op == WordOp::kAxis && word.index >= 3) return unknown("a frame of a rotary or further axis");
    const bool translates = op == FrameOp::kTranslate || op == FrameOp::kAddTranslate;
    if (word.op != WordOp::kFrameAngle && word.op != WordOp::kAxis) continue;
    any = true;
    // The words of a mirror only name axes, those of a shift may be anything.
    if (translates || op == FrameOp::kMirror || op == FrameOp::kAddMirror) {
      named[word.index] = true;
      continue;
    }
    const LinearForm form = FormOf(module_, word.value);
    if (!form.IsConstant()) return unknown("a rotation or scale of the frame by a computed value");
    if (word.op == WordOp::kFrameAngle) {
      plane_angle = true;
      angle = form.constant;
    } else {
      named[word.index] = true;
      value[word.index] = form.constant;
    }
  }
  if (!Adds(op)) state = {FrameState::Kind::kKnown, true, {}};
  if (!any) return state;
  if (state.kind != FrameState::Kind::kKnown) return state;
  state.untouched = false;
  switch (op) {
    case FrameOp::kRotate:
    case FrameOp::kAddRotate: {
      int count = 0;
      for (const std::uint8_t axis : {std::uint8_t{2}, std::uint8_t{1}, std::uint8_t{0}}) {
        if (!named[axis] || value[axis] == 0) continue;
        ++count;
        state.matrix = state.matrix.Rotated(axis, value[axis]);
      }
      if (count > 1 && !machine_.rotation_order_rpy) return unknown("a rotation about several axes of the frame");
      if (plane_angle) {
        const Plane plane = modes_.At(program, block).plane;
        if (plane == Plane::kUnknown) return unknown("a rotation of the frame in a plane that is not known");
        state.matrix = state.matrix.Rotated(plane == Plane::kZX ? 1 : plane == Plane::kYZ ? 0 : 2, angle);
      }
      break;
    }
    case FrameOp::kScale:
    case FrameOp::kAddScale:
    case FrameOp::kMirror:
    case FrameOp::kAddMirror:
      for (std::uint8_t axis = 0; axis < 3; ++axis) {
        if (!named[axis]) continue;
        const double factor = op == FrameOp::kMirror || op == FrameOp::kAddMirror ? -1 : value[axis];
        if (std::fabs(factor) < kNoise) return unknown("a scale of the frame by 0");
        state.matrix = state.matrix.Scaled(axis, factor);
      }
      break;
    default:
      break;
  }
  return state;
}

FrameState FrameFlow::Before(BlockId block) const {
  if (!any_) return {FrameState::Kind::kKnown, true, {}};
  return in_[block.value];
}

FrameState FrameFlow::After(ProgramId program, BlockId block) const {
  const FrameState before = Before(block);
  if (!any_ || FrameWord(block) == nullptr) return before;
  return Apply(program, block, before, nullptr);
}

std::string_view FrameFlow::Trouble(ProgramId program, BlockId block) const {
  std::string_view trouble;
  if (any_ && FrameWord(block) != nullptr) Apply(program, block, Before(block), &trouble);
  return trouble;
}

}  // namespace ncport::ir::transform
