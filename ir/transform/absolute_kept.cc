// Increments that stay increments (part of absolute_dimensions.h): which of them, by how much the target's rounding can
// move them off, and the distance mode of their blocks where the target has one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ir/analysis/forward_flow.h"
#include "ir/axis_names.h"
#include "ir/make_word.h"
#include "ir/transform/dimension_pass.h"

namespace ncport::ir::transform {

namespace {

/// Words behind which an axis stands at another number than it was moved to, or by another tool.
bool Unsettles(WordOp op) {
  switch (op) {
    case WordOp::kFrame:
    case WordOp::kWorkOffset:
    case WordOp::kPresetPosition:
    case WordOp::kMachineCoords:
    case WordOp::kReference:
    case WordOp::kDataSetting:
    case WordOp::kTool:
    case WordOp::kToolChange:
    case WordOp::kEdge:
    case WordOp::kToolOffset:
    case WordOp::kLengthOffset:
    case WordOp::kAxisComputed:
    case WordOp::kContourAngle:
    case WordOp::kPolarMode:
    case WordOp::kCycle:
    case WordOp::kCycleValue:
    case WordOp::kComputedG:
    case WordOp::kComputedM:
    case WordOp::kVerbatim:
      return true;
    default:
      return false;
  }
}

/// Words that make something else of the axis words of their block than a move to where they say.
bool MeansNoMove(WordOp op) {
  return op == WordOp::kFrame || op == WordOp::kReference || op == WordOp::kPole || op == WordOp::kPresetPosition ||
         op == WordOp::kMachineCoords || op == WordOp::kDataSetting || op == WordOp::kCycle ||
         op == WordOp::kCycleValue || op == WordOp::kPolarMode || op == WordOp::kContourAngle;
}

/// Words that make a point or more moves than one out of the words of their block.
bool ComputesPoints(WordOp op) {
  switch (op) {
    case WordOp::kOpeningAngle:
    case WordOp::kVia:
    case WordOp::kTurns:
    case WordOp::kPolarRadius:
    case WordOp::kPolarAngle:
    case WordOp::kPole:
      return true;
    default:
      return false;
  }
}

template <class Holds>
bool AnyWord(const Module& module, const Block& block, Holds holds) {
  for (const WordId id : block.words) {
    if (holds(module.words[id])) return true;
  }
  return false;
}

bool HasOp(const Module& module, const Block& block, bool (*holds)(WordOp)) {
  return AnyWord(module, block, [&](const Word& word) { return holds(word.op); });
}

/// Which axes stand where a move of theirs put them, in the present coordinates and by the present tool.
class Settled {
 public:
  struct State {
    SlotMask settled = 0;
    SlotMask started = 0;  // where a caller outside of the module stands, on some way
  };
  explicit Settled(const Module& module, const analysis::ModalFlow& modal) : module_(module), modal_(modal) {}

  [[nodiscard]] State Entry(ProgramId program) const {
    if (module_.programs[program].kind == ProgramKind::kMain) return {};
    return {kAxisSlots, kAxisSlots};
  }
  [[nodiscard]] State Unknown(ProgramId) const { return {}; }
  bool Join(BlockId, State& into, const State& from) const {
    const State before = into;
    into.settled &= from.settled;
    into.started = (into.started | from.started) & into.settled;
    return into.settled != before.settled || into.started != before.started;
  }
  void Transfer(ProgramId program, BlockId id, State& state) const {
    const Block& block = module_.blocks[id];
    const ModalState modal = modal_.At(program, id);
    if (HasOp(module_, block, Unsettles)) {
      // A length of a mill counts along the axis of its tool.
      const bool length = !AnyWord(
          module_, block, [](const Word& word) { return Unsettles(word.op) && word.op != WordOp::kLengthOffset; });
      const SlotMask moved = length && modal.plane == Plane::kXY ? MaskOf(2) : kAxisSlots;
      state.settled &= ~moved;
      state.started &= ~moved;
    }
    if (HasOp(module_, block, ComputesPoints) || HasOp(module_, block, MeansNoMove)) return;
    const bool absolute = modal.distance == Distance::kAbsolute;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op != WordOp::kAxis) continue;
      const bool named = word.mode == ValueMode::kModal
                             ? absolute
                             : word.mode == ValueMode::kAbsolute || word.mode == ValueMode::kAbsoluteDiameter ||
                                   word.mode == ValueMode::kAbsoluteRadius;
      // One that vanishes leaves the axis where it is.
      if (!named || (word.flags & Word::kVanishesVacant) != 0) continue;
      state.settled |= MaskOf(word.index);
      state.started &= ~MaskOf(word.index);
    }
  }

 private:
  const Module& module_;
  const analysis::ModalFlow& modal_;
};

double WordErrorOf(WordError error, double increment) {
  return error == WordError::kNone ? 0 : error == WordError::kRound ? increment / 2 : increment;
}

}  // namespace

/// The axes of the block whose increments stay. `settled`: of the axes on arrival.
SlotMask DimensionPass::KeptOf(ProgramId program, BlockId id, SlotMask settled) const {
  const Block& block = module_.blocks[id];
  if (HasOp(module_, block, Unsettles) || HasOp(module_, block, ComputesPoints)) return 0;
  const bool blocks = config_.keep == KeepIncrements::kBlocks;
  const analysis::BlockWays ways = analysis::WaysOf(module_, block);
  if (ways.calls || (blocks && (ways.branches || TriggersModal(program, id)))) return 0;
  // A part of the block that may be left out would leave the mode.
  const bool cut = AnyWord(module_, block,
                           [](const Word& word) { return word.op == WordOp::kWhen || word.op == WordOp::kSkipRest; });
  if (blocks && cut) return 0;
  if (frames_.Any() && !frames_.Before(id).untouched) return 0;
  SlotMask kept = 0;
  bool all = true;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    if (word.op != WordOp::kAxis) continue;
    const bool has_word = blocks || (config_.keep_axes >> word.index & 1U) != 0;
    const bool named_once = (kept >> word.index & 1U) == 0;
    if (has_word && named_once && (settled >> word.index & 1U) != 0 && AxisStep(id, word.index) == Step::kIncremental) {
      kept |= MaskOf(word.index);
    } else {
      all = false;
    }
  }
  return blocks && !all ? 0 : kept;
}

/// The target makes of every value of the word what the source makes of it.
bool DimensionPass::StaysExact(ProgramId program, BlockId block, const Word& word, double factor,
                               analysis::NumberKinds& kinds) const {
  const double unit = config_.increment;
  if (config_.word_error == WordError::kNone || unit <= 0) return true;
  // A source that rounds its words drifts as the target does.
  const bool same = (word.flags & Word::kRoundsValue) != 0 && source_.word_error == config_.word_error &&
                    source_.increment == unit && factor == 1;
  if (same) return true;
  const auto multiple = [unit](double value) {
    const double steps = value / unit;
    return std::fabs(steps - std::round(steps)) < 1e-6;
  };
  const LinearForm form = ScaledForm(word.value, factor);
  return multiple(form.constant) && std::ranges::all_of(form.terms, [&](const LinearForm::Term& term) {
           return multiple(term.coefficient) && kinds.At(program, block, term.atom) == analysis::NumberKind::kWhole;
         });
}

void DimensionPass::SayDrift(BlockId block, const Word& word, bool diameter) {
  const std::string axis(1, kAxisLetters[word.index]);
  const double error = WordErrorOf(config_.word_error, config_.increment);
  sink_
      .Report(diag::Code::kIncrementDrifts, module_.RangeOf(module_.blocks[block], word), axis,
              fmt::format("{:g} {}{}", error, word.index >= 3 && word.index <= 5 ? "degrees" : "mm",
                          diameter ? " of the diameter" : ""))
      .help = "--increments=exact writes the position instead; --verify tells whether the runs differ";
}

void DimensionPass::FindKept() {
  if (config_.keep == KeepIncrements::kNo || (config_.work_frames_in && frames_.Any())) return;
  // A corner that becomes a move ends on the next one: that one starts elsewhere.
  const bool corners =
      std::ranges::any_of(module_.words.All(), [](const Word& word) { return word.op == WordOp::kChamfer; });
  if (corners && config_.corners_to_moves != AbsoluteDimensionsConfig::Corners::kNone) return;
  Settled client(module_, flow_);
  analysis::ForwardFlow<Settled> settled({module_, source_, analyses_.Graphs(), analyses_.Calls(), &flow_}, client);
  settled.Run();
  analysis::NumberKinds kinds(module_, analyses_.Calls(), source_.for_counter_rounds);
  std::vector<SlotMask> masks(module_.blocks.Size(), 0);
  for (const ProgramId program : module_.programs.Ids()) {
    Enter(program);
    kinds.Prepare(program);
    bool started = false;
    for (const BlockId id : blocks_) {
      const Settled::State* at = settled.Before(id);
      if (at == nullptr) continue;
      SlotMask kept = KeptOf(program, id, at->settled);
      for (const WordId word_id : module_.blocks[id].words) {
        const Word& word = module_.words[word_id];
        if (word.op != WordOp::kAxis || (kept >> word.index & 1U) == 0) continue;
        const Scale scale = ScaleOf(word, word.index, flow_.At(program, id), id, false);
        // A sum of a vacant value is no vacant value.
        if (!scale.known || (scale.factor != 1 && (word.flags & Word::kVanishesVacant) != 0)) kept = 0;
      }
      for (const WordId word_id : module_.blocks[id].words) {
        const Word word = module_.words[word_id];
        if (word.op != WordOp::kAxis || (kept >> word.index & 1U) == 0) continue;
        ++kept_.words;
        const Scale scale = ScaleOf(word, word.index, flow_.At(program, id), id, false);
        if (StaysExact(program, id, word, scale.factor, kinds)) continue;
        ++kept_.drifting;
        SayDrift(id, word, word.index == config_.diameter_axis);
      }
      masks[id.value] = kept;
      started = started || (at->started & kept) != 0;
    }
    if (started) kept_.started.push_back(program);
  }
  kept_axes_ = std::move(masks);
}

void DimensionPass::WriteDistanceModes() {
  ProgramEditor editor(module_, program_, "absolute_dimensions");
  const auto mode = [](Distance distance) { return MakeWord(WordOp::kDistance, distance); };
  const auto prepend = [&](BlockId id, const Word& first) {
    std::vector<Word> words{first};
    for (const WordId word_id : module_.blocks[id].words) words.push_back(module_.words[word_id]);
    editor.SetWords(id, words);
  };
  const auto is_kept = [&](BlockId id) {
    return AnyWord(module_, module_.blocks[id],
                   [](const Word& word) { return word.op == WordOp::kAxis && word.mode == ValueMode::kIncremental; });
  };
  const IdRange<BlockId> blocks = module_.programs[program_].blocks;
  bool told = false;  // the block in front has said the mode, on every way to this one
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    const BlockId id = blocks[i];
    if (!is_kept(id)) continue;
    const Block& block = module_.blocks[id];
    // Jumps come to labels and numbers under the absolute mode, and what may be skipped says nothing.
    told = told && !block.label.Valid() && block.number == Block::kNoNumber;
    for (const WordId word : block.words) {
      if (module_.words[word].op == WordOp::kAxis) module_.words[word].mode = ValueMode::kModal;
    }
    if (!told) prepend(id, mode(Distance::kIncremental));
    const Block* next = i + 1 == blocks.count ? nullptr : &module_.blocks[blocks[i + 1]];
    if (next != nullptr && is_kept(blocks[i + 1])) {
      told = told || module_.blocks[id].skip_level == Block::kNoSkip;
      continue;
    }
    told = false;
    const analysis::BlockWays ways = next != nullptr ? analysis::WaysOf(module_, *next) : analysis::BlockWays{};
    // A word of the mode would mean something to words that name no end of a move (a point on the way to the
    // reference).
    const bool takes =
        ways.moves && !ways.calls && !ways.branches && !ways.conditional && !HasOp(module_, *next, MeansNoMove);
    if (takes) {
      prepend(blocks[i + 1], mode(Distance::kAbsolute));
      continue;
    }
    Block made = editor.MakeBlock(id);
    editor.SetWords(made, {mode(Distance::kAbsolute)});
    editor.InsertAfter(id, made);
  }
  editor.Apply();
}

}  // namespace ncport::ir::transform
