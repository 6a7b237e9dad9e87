// Canned cycles that a run refuses: a hole without its level or depth, pecks without a size, a reference move while a
// cycle is in force. What a cycle stores holds for the next hole, until a motion word ends the cycles (fanuc-8.7).
#include <cstdint>
#include <optional>
#include <string_view>

#include "check/expressions.h"
#include "check/value_rules.h"
#include "ir/analysis/forward_flow.h"
#include "ir/analysis/main_programs.h"
#include "ir/block_words.h"
#include "ir/plane_axes.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Cycle;
using ir::ProgramId;
using ir::WordOp;

/// What the ways to a place bring along: sets of these.
struct HoleState {
  std::uint8_t cycles = 0;
  std::uint8_t level = 0;
  std::uint8_t depth = 0;
  std::uint8_t step = 0;
  bool operator==(const HoleState&) const = default;

  static constexpr std::uint8_t kNoCycle = 1;
  static constexpr std::uint8_t kHole = 2;
  static constexpr std::uint8_t kPeck = 4;       // of a mill: needs a size
  static constexpr std::uint8_t kLatheHole = 8;  // without a size in one stroke
  static constexpr std::uint8_t kOther = 16;     // turning
  static constexpr std::uint8_t kAnything = 32;

  static constexpr std::uint8_t kLacks = 1;
  static constexpr std::uint8_t kHas = 2;
};

std::uint8_t KindOf(Cycle cycle) {
  if (cycle == Cycle::kNone) return HoleState::kNoCycle;
  if (cycle == Cycle::kPeck || cycle == Cycle::kPeckChip) return HoleState::kPeck;
  if (cycle >= Cycle::kDrill && cycle <= Cycle::kBoreDwell) return HoleState::kHole;
  const bool rigid = cycle == Cycle::kFaceRigidTap || cycle == Cycle::kCrossRigidTap;
  if (cycle >= Cycle::kFacePeck && cycle <= Cycle::kCrossBore && !rigid) return HoleState::kLatheHole;
  return HoleState::kOther;  // also those whose way depends on the operator
}

/// The trouble that a run would stop with.
struct Trouble {
  const ir::Word* word = nullptr;
  std::string_view alarm;
  std::string_view help;
  bool certain = false;
};

class HoleFlow {
 public:
  using State = HoleState;

  explicit HoleFlow(const ir::analysis::FlowSources& sources) : module_(sources.module), sources_(sources) {}

  State Entry(ProgramId program) const {
    return ir::analysis::StartsAsMain(module_, program) ? None() : Unknown(program);
  }
  static State Unknown(ProgramId) { return {State::kAnything, State::kHas, State::kHas, State::kHas}; }
  static bool Join(BlockId, State& into, const State& from) {
    const State old = into;
    into.cycles |= from.cycles;
    into.level |= from.level;
    into.depth |= from.depth;
    into.step |= from.step;
    return !(into == old);
  }
  void Transfer(ProgramId program, BlockId id, State& state) const {
    Set(program, id, state);
    // The run ends there: behind it nothing lacks any more.
    if (TroubleOf(program, id, state).certain) state = Unknown(program);
  }

  /// The settings of the block, and what it stores.
  void Set(ProgramId program, BlockId id, State& state) const {
    const ir::Block& block = module_.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) state = Unknown(program);
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = module_.words[word_id];
      if (word.op == WordOp::kMotion) state = None();
      if (word.op == WordOp::kCycle) Begin(static_cast<Cycle>(word.index), state);
      if (word.op == WordOp::kComputedG || word.op == WordOp::kVerbatim) state = Unknown(program);
    }
    const Places places = PlacesOf(program, id, state);
    if (!places.hole) return;
    if (places.level) state.level = State::kHas;
    if (places.depth) state.depth = State::kHas;
    if (places.step) state.step = *places.step;
  }

  [[nodiscard]] Trouble TroubleOf(ProgramId program, BlockId id, const State& state) const {
    const ir::Block& block = module_.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0 || ir::HasWord(module_, block, WordOp::kWhen)) return {};
    constexpr std::uint8_t kCycles = State::kHole | State::kPeck | State::kLatheHole | State::kOther;
    const ir::Word* reference = ir::FindWord(module_, block, WordOp::kReference);
    if (reference != nullptr) {
      if ((state.cycles & kCycles) == 0 || ir::HasWord(module_, block, WordOp::kMachineCoords)) return {};
      return {reference, "reference move while a cycle is active", "end the cycle first, with G80",
              (state.cycles & ~kCycles) == 0};
    }
    const Places places = PlacesOf(program, id, state);
    if (!places.hole || places.none) return {};
    constexpr std::uint8_t kHoles = State::kHole | State::kPeck | State::kLatheHole;
    const bool hole = (state.cycles & ~kHoles) == 0 && places.once;
    if (((state.level | state.depth) & State::kLacks) != 0) {
      return {places.hole, "a cycle without level or depth",
              "R is the level where the feed begins, and the word of the tool's axis the depth",
              hole && (state.level == State::kLacks || state.depth == State::kLacks)};
    }
    // Where another cycle is in force on some way, the size may lack on that way only.
    if ((state.cycles & kHoles) != State::kPeck || (state.step & State::kLacks) == 0) return {};
    return {places.hole, "peck drilling without a depth of cut", "Q is the size of a peck, above 0",
            hole && state.cycles == State::kPeck && state.step == State::kLacks};
  }

 private:
  /// What the words of a block say of a hole.
  struct Places {
    const ir::Word* hole = nullptr;  // that makes one here
    bool level = false;
    bool depth = false;
    std::optional<std::uint8_t> step;
    bool none = false;  // no repetition: stored only
    bool once = true;   // at least one, for sure
  };

  /// Without a cycle nothing is stored, and nothing lacks.
  static State None() { return {State::kNoCycle, 0, 0, 0}; }

  /// What ways with a cycle of the same family have stored stays.
  static void Begin(Cycle cycle, State& state) {
    const std::uint8_t kind = KindOf(cycle);
    constexpr std::uint8_t kMill = State::kHole | State::kPeck;
    const std::uint8_t family = (kind & kMill) != 0 ? kMill : kind == State::kLatheHole ? kind : 0;
    const auto kept = static_cast<std::uint8_t>(state.cycles & (family | State::kAnything));
    if (kept == 0) state = {0, 0, 0, 0};
    if (kept != state.cycles || kept == 0) {
      state.level |= State::kLacks;
      state.depth |= State::kLacks;
      state.step |= State::kLacks;
    }
    state.cycles = kind;
  }

  [[nodiscard]] Places PlacesOf(ProgramId program, BlockId id, const State& state) const {
    Places places;
    constexpr std::uint8_t kHoles = State::kHole | State::kPeck | State::kLatheHole;
    if ((state.cycles & kHoles) == 0 || sources_.modal == nullptr) return places;
    const ir::Plane plane = sources_.modal->At(program, id).plane;
    const bool lathe = (state.cycles & State::kLatheHole) != 0;
    for (const ir::WordId word_id : module_.blocks[id].words) {
      const ir::Word& word = module_.words[word_id];
      switch (word.op) {
        case WordOp::kAxis:
          if (word.index > 2) break;
          if (places.hole == nullptr) places.hole = &word;
          // Which axis a lathe drills along is in the cycle, and a plane may be unknown.
          places.depth =
              places.depth || lathe || plane == ir::Plane::kUnknown || word.index == ir::AxesOf(plane).normal;
          break;
        case WordOp::kRadius:
          if (places.hole == nullptr) places.hole = &word;
          places.level = true;
          break;
        case WordOp::kCenter:
          // I, J and K beside a hole are sizes of pecks that shrink (fanuc-13).
          places.step = State::kHas;
          break;
        case WordOp::kCycleValue:
          Value(word, places);
          break;
        case WordOp::kFrame:
        case WordOp::kMachineCoords:
        case WordOp::kPole:
        case WordOp::kPresetPosition:
        case WordOp::kReference:
        case WordOp::kDwellSeconds:
        case WordOp::kDwellRevolutions:
        case WordOp::kDataSetting:
        case WordOp::kCall:
          return {};
        default:
          break;
      }
    }
    return places;
  }

  void Value(const ir::Word& word, Places& places) const {
    const std::optional<double> number = LiteralValue(module_, word.value);
    switch (static_cast<ir::CycleField>(word.index)) {
      case ir::CycleField::kLevel:
        if (places.hole == nullptr) places.hole = &word;
        places.level = true;
        break;
      case ir::CycleField::kStep:
        places.step = number == 0.0 ? State::kLacks : State::kHas;
        break;
      case ir::CycleField::kRepeats:
        places.none = number == 0.0;
        places.once = number.has_value();
        break;
      default:
        break;
    }
  }

  const ir::Module& module_;
  const ir::analysis::FlowSources& sources_;
};

class CycleWords final : public ValueRule {
 public:
  CycleWords(const ValueRuleInput& input, ValueFindings& findings, const ir::analysis::FlowSources& sources)
      : ValueRule(input, findings), sources_(sources) {}

  void Finish(diag::Sink& sink) override {
    bool any = false;
    for (const ir::Word& word : input_.module.words.All()) any = any || word.op == WordOp::kCycle;
    if (!any) return;
    HoleFlow client(sources_);
    ir::analysis::ForwardFlow<HoleFlow> flow(sources_, client);
    flow.Run();
    for (const ProgramId program : input_.module.programs.Ids()) {
      if (input_.module.programs[program].library) continue;
      for (const BlockId id : input_.module.programs[program].blocks) {
        const HoleState* before = flow.Before(id);
        if (before == nullptr) continue;
        HoleState state = *before;
        client.Set(program, id, state);
        const Trouble trouble = client.TroubleOf(program, id, state);
        if (trouble.word == nullptr) continue;
        const auto severity = trouble.certain ? diag::Severity::kError : diag::Severity::kWarning;
        diag::Diagnostic& finding =
            sink.ReportAs(severity, diag::Code::kProgramAlarm,
                          input_.module.RangeOf(input_.module.blocks[id], *trouble.word), trouble.alarm);
        finding.help = trouble.help;
      }
    }
  }

 private:
  ir::analysis::FlowSources sources_;
};

}  // namespace

std::unique_ptr<ValueRule> MakeCycleWords(const ValueRuleInput& input, ValueFindings& findings,
                                          const ir::analysis::FlowSources& sources) {
  return std::make_unique<CycleWords>(input, findings, sources);
}

}  // namespace ncport::check
