#include "ir/analysis/axis_positions.h"

#include <algorithm>
#include <cmath>

#include "ir/analysis/value_range.h"
#include "ir/length_units.h"
#include "ir/literal_value.h"

namespace ncport::ir::analysis {

namespace {

constexpr std::uint8_t kMostClimbs = 8;  // of a position in a loop, before it counts as unknown

/// Bounds alone: where a value comes from is nobody's question here.
Interval Bounds(const Interval& a) { return a.HasNumber() ? Interval{a.low, a.high, 0} : Interval::Unknown(0); }
Interval Hull(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::max(a.high, b.high), 0}; }
Interval Scaled(const Interval& a, double factor) { return {a.low * factor, a.high * factor, 0}; }

Interval Length(const Interval& a) {
  const double least = a.low > 0 ? a.low : a.high < 0 ? -a.high : 0;
  return {least, std::max(std::fabs(a.low), std::fabs(a.high)), 0};
}

/// What a word does to positions besides what axis words say.
enum class Effect : std::uint8_t {
  kNone,
  kZeroPoint,  // the axes stand elsewhere in the program's coordinates; axis words of the block count in the new ones
  kElsewhere,  // axis words of the block are no end points, or the axes go where no word says
};

Effect EffectOf(WordOp op) {
  switch (op) {
    case WordOp::kWorkOffset:
    case WordOp::kTool:
    case WordOp::kToolChange:
    case WordOp::kEdge:
    case WordOp::kToolOffset:
    case WordOp::kLengthOffset:
    case WordOp::kRadiusOffset:
      return Effect::kZeroPoint;
    case WordOp::kMachineCoords:
    case WordOp::kPolarMode:
    case WordOp::kCycle:
    case WordOp::kComputedG:
    case WordOp::kAxisComputed:
    case WordOp::kOpeningAngle:
    case WordOp::kPolarRadius:
    case WordOp::kPolarAngle:
    case WordOp::kContourAngle:
    case WordOp::kChamfer:  // the next block does not start where this one leads
    case WordOp::kReference:
    case WordOp::kPole:
    case WordOp::kFrame:
    case WordOp::kFrameAngle:
    case WordOp::kFrameFactor:
    case WordOp::kCycleValue:
    case WordOp::kPresetPosition:
    case WordOp::kDataSetting:
    case WordOp::kWorkpiece:
    case WordOp::kVerbatim:
      return Effect::kElsewhere;
    default:
      return Effect::kNone;
  }
}

/// The values of axis words, of all ways into their program together.
class Values final : public RangeObserver {
 public:
  explicit Values(const Module& module, std::map<ExprId, Interval>& values) : module_(module), values_(values) {}

  void Block(const RangeSite& site, RangeLookup& lookup) override {
    for (const WordId id : module_.blocks[site.block].words) {
      const Word& word = module_.words[id];
      if (word.op != WordOp::kAxis) continue;
      const Interval value = lookup.Evaluate(word.value);
      // An empty value may mean that the word is not there.
      const Interval bounds = value.Has(Interval::kVacant) ? Interval::Unknown(0) : Bounds(value);
      const auto [known, first] = values_.try_emplace(word.value, bounds);
      if (!first) known->second = Hull(known->second, bounds);
    }
  }

 private:
  const Module& module_;
  std::map<ExprId, Interval>& values_;
};

}  // namespace

AxisPositions::AxisPositions(const Module& module, const Machine& machine, const FlowAnalyses& analyses)
    : module_(module), machine_(machine), modal_(analyses.Modal()), flow_(analyses.Sources(), *this) {
  Values observer(module, values_);
  const RangeStatistics statistics =
      FindValueRanges(module, machine, analyses.Graphs(), analyses.Calls(), {}, observer);
  if (statistics.given_up != 0) values_.clear();
  flow_.Run();
}

Interval AxisPositions::WayOf(ProgramId program, BlockId block, std::uint8_t axis) const {
  const State* before = flow_.Before(block);
  const Word* named = nullptr;
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (EffectOf(word.op) != Effect::kNone) return {0, kInfinity, 0};
    if (word.op == WordOp::kAxis && word.index == axis) named = &word;
  }
  if (named == nullptr) return {0, 0, 0};
  if (before == nullptr) return {0, kInfinity, 0};
  const Step step = StepOf(*named, modal_.At(program, block));
  return Length(step.incremental ? step.value : Difference(step.value, before->at[axis]));
}

bool AxisPositions::Join(BlockId, State& into, const State& from) const {
  bool changed = from.cycle && !into.cycle;
  into.cycle = into.cycle || from.cycle;
  bool climbed = false;
  for (std::uint8_t axis = 0; axis < kAxes; ++axis) {
    const Interval joined = Hull(into.at[axis], from.at[axis]);
    if (joined.low == into.at[axis].low && joined.high == into.at[axis].high) continue;
    into.at[axis] = into.climbs >= kMostClimbs ? Interval::Unknown(0) : joined;
    climbed = true;
  }
  if (climbed && into.climbs < kMostClimbs) ++into.climbs;
  return changed || climbed;
}

void AxisPositions::Transfer(ProgramId program, BlockId id, State& state) const {
  const ModalState at = modal_.At(program, id);
  Effect effect = at.motion == Motion::kProbe ? Effect::kElsewhere : Effect::kNone;  // it ends where it touches
  bool moves = false;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    effect = std::max(effect, EffectOf(word.op));
    moves = moves || word.op == WordOp::kAxis;
    if (word.op == WordOp::kMotion) state.cycle = false;
    if (word.op == WordOp::kCycle) state.cycle = word.index != static_cast<std::uint8_t>(Cycle::kNone);
    if (word.op == WordOp::kComputedG) state.cycle = true;
  }
  if (state.cycle && moves) effect = Effect::kElsewhere;
  if (effect != Effect::kNone) state.at = {};
  if (effect == Effect::kElsewhere) return;
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& word = module_.words[word_id];
    if (word.op != WordOp::kAxis || word.index >= kAxes) continue;
    const Step step = StepOf(word, at);
    state.at[word.index] = step.incremental ? Bounds(Sum(state.at[word.index], step.value)) : step.value;
  }
}

AxisPositions::Step AxisPositions::StepOf(const Word& word, const ModalState& at) const {
  Step step;
  bool known = at.units != Units::kUnknown;
  switch (word.mode) {
    case ValueMode::kModal:
      known = known && at.distance != Distance::kUnknown;
      step.incremental = at.distance == Distance::kIncremental;
      break;
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      step.incremental = true;
      break;
    default:
      break;
  }
  bool diameter = word.mode == ValueMode::kAbsoluteDiameter || word.mode == ValueMode::kIncrementalDiameter;
  const bool modal =
      word.mode == ValueMode::kModal || word.mode == ValueMode::kAbsolute || word.mode == ValueMode::kIncremental;
  if (modal && word.index == machine_.transverse_axis) {
    known = known && at.diameter != Diameter::kUnknown;
    diameter = at.diameter == Diameter::kDiameter || (at.diameter == Diameter::kDiameterAbsolute && !step.incremental);
  }
  if (!known) return {Interval::Unknown(0), step.incremental};
  if (const auto literal = LiteralValue(module_, word.value)) {
    step.value = {*literal, *literal, 0};
  } else if (const auto value = values_.find(word.value); value != values_.end()) {
    // Within the increment to which the control rounds a computed word.
    step.value = {value->second.low - machine_.increment, value->second.high + machine_.increment, 0};
  } else {
    step.value = Interval::Unknown(0);
  }
  step.value = Scaled(step.value, MmPerLengthUnit(at.units) * (diameter ? 0.5 : 1));
  return step;
}

}  // namespace ncport::ir::analysis
