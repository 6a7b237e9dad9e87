#include "ir/transform/frame_flow.h"

#include <cmath>
#include <set>

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

FrameFlow::FrameFlow(const Module& module, const Machine& machine, const analysis::FlowGraphs& graphs,
                     const analysis::CallGraph& calls, const analysis::ModalFlow& modes,
                     const FrameFlowOptions& options)
    : module_(module), machine_(machine), graphs_(graphs), modes_(modes), options_(options) {
  sets_.assign(module.programs.Size(), 0);
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId block : module.programs[program].blocks) {
      if (FrameWord(block) != nullptr) sets_[program.value] = 1;
    }
    any_ = any_ || sets_[program.value] != 0;
  }
  if (!any_) return;
  options_.restores.resize(module.programs.Size(), false);
  std::vector<bool> called(module.programs.Size(), false), modal(module.programs.Size(), false);
  for (bool more = true; more;) {
    more = false;
    for (const analysis::CallSite& site : calls.AllSites()) {
      if (!site.callee.Valid()) continue;
      called[site.callee.value] = true;
      modal[site.callee.value] = modal[site.callee.value] || site.modal;
      if (sets_[site.callee.value] != 0 && !options_.restores[site.callee.value] && sets_[site.caller.value] == 0) {
        sets_[site.caller.value] = 1;
        more = true;
      }
    }
  }
  entries_.assign(module.programs.Size(), {});
  exits_.assign(module.programs.Size(), {});
  in_.resize(module.programs.Size());
  for (const ProgramId program : module.programs.Ids()) {
    in_[program.value].assign(module.programs[program].blocks.count, {});
    FrameState& entry = entries_[program.value];
    const bool main = module.programs[program].kind == ProgramKind::kMain;
    if (modal[program.value] || (!called[program.value] && !main && sets_[program.value] != 0)) {
      // After any block with a move, or from a caller that nobody knows.
      entry = {FrameState::Kind::kUnknown, false, {}};
    } else if (!called[program.value] || main) {
      entry.kind = FrameState::Kind::kKnown;
    }
  }
  do {
    changed_ = false;
    for (const ProgramId program : module.programs.Ids()) Follow(program);
  } while (changed_);
}

bool FrameFlow::Join(FrameState& at, const FrameState& from) {
  if (from.kind == FrameState::Kind::kNoWay || at.kind == FrameState::Kind::kUnknown || at == from) return false;
  if (at.kind == FrameState::Kind::kNoWay) {
    at = from;
  } else if (from.kind == FrameState::Kind::kUnknown || !(at.matrix == from.matrix)) {
    at = {FrameState::Kind::kUnknown, false, {}};
  } else if (at.untouched && !from.untouched) {
    at.untouched = false;
  } else {
    return false;
  }
  return true;
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

FrameState FrameFlow::Through(ProgramId program, BlockId block, const FrameState& state, bool note) {
  FrameState now = state;
  if (FrameWord(block) != nullptr) {
    now = Apply(program, block, state, nullptr);
    bool conditional = module_.blocks[block].skip_level != Block::kNoSkip;
    for (const WordId id : module_.blocks[block].words) {
      const WordOp op = module_.words[id].op;
      conditional = conditional || op == WordOp::kWhen || op == WordOp::kSkipRest;
    }
    if (conditional) {
      FrameState both = state;
      Join(both, now);
      now = both;
    }
  }
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
    if (!word.Extra<CallId>().Valid()) continue;
    const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
    if (!callee.Valid()) {
      now = {FrameState::Kind::kUnknown, false, {}};
      continue;
    }
    if (word.op == WordOp::kModalCall) continue;
    // A shift may be an expression of the caller: only no frame at all is the same in the program that is called.
    FrameState given = now;
    if (given.kind == FrameState::Kind::kKnown && !given.untouched) given = {FrameState::Kind::kUnknown, false, {}};
    if (note && Join(entries_[callee.value], given)) changed_ = true;
    if (sets_[callee.value] == 0 || options_.restores[callee.value]) continue;
    const FrameState& exit = exits_[callee.value];
    if (exit.kind == FrameState::Kind::kKnown && exit.untouched) {
      now = exit;
    } else if (exit.kind == FrameState::Kind::kNoWay) {
      now = {};
    } else {
      now = {FrameState::Kind::kUnknown, false, {}};
    }
  }
  return now;
}

void FrameFlow::Follow(ProgramId program) {
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  std::vector<FrameState>& in = in_[program.value];
  if (blocks.count == 0) {
    if (Join(exits_[program.value], entries_[program.value])) changed_ = true;
    return;
  }
  std::set<std::uint32_t> work;
  if (Join(in[0], entries_[program.value])) changed_ = true;
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    if (in[i].kind != FrameState::Kind::kNoWay) work.insert(i);
  }
  const analysis::Cfg& graph = graphs_.Of(program);
  if (graph.Opaque() && sets_[program.value] != 0) {
    for (FrameState& state : in) changed_ = Join(state, {FrameState::Kind::kUnknown, false, {}}) || changed_;
    changed_ = Join(exits_[program.value], {FrameState::Kind::kUnknown, false, {}}) || changed_;
  }
  while (!work.empty()) {
    const std::uint32_t index = *work.begin();
    work.erase(work.begin());
    const FrameState out = Through(program, blocks[index], in[index], true);
    const auto give = [&](BlockId to) {
      const std::uint32_t place = to.value - blocks.begin;
      if (!Join(in[place], out)) return;
      changed_ = true;
      work.insert(place);
    };
    for (const analysis::Edge& edge : graph.Successors(blocks[index])) {
      if (edge.to.Valid()) {
        give(edge.to);
      } else if (edge.kind == analysis::EdgeKind::kComputed) {
        for (const BlockId target : graph.ComputedTargets()) give(target);
      } else if (edge.kind != analysis::EdgeKind::kAlarm && edge.kind != analysis::EdgeKind::kMissing) {
        changed_ = Join(exits_[program.value], out) || changed_;
      }
    }
  }
}

FrameState FrameFlow::Before(ProgramId program, BlockId block) const {
  if (!any_) return {FrameState::Kind::kKnown, true, {}};
  return in_[program.value][block.value - module_.programs[program].blocks.begin];
}

FrameState FrameFlow::After(ProgramId program, BlockId block) const {
  const FrameState before = Before(program, block);
  if (!any_ || FrameWord(block) == nullptr) return before;
  return Apply(program, block, before, nullptr);
}

std::string_view FrameFlow::Trouble(ProgramId program, BlockId block) const {
  std::string_view trouble;
  if (any_ && FrameWord(block) != nullptr) Apply(program, block, Before(program, block), &trouble);
  return trouble;
}

}  // namespace ncport::ir::transform
