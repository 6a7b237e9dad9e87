#include "check/feed_flow.h"

#include "check/expressions.h"
#include "check/motion_words.h"
#include "ir/analysis/main_programs.h"
#include "ir/block_words.h"
#include "ir/motions.h"

namespace ncport::check {

using ir::BlockId;
using ir::Cycle;
using ir::Motion;
using ir::ProgramId;
using ir::WordOp;
using ir::analysis::EdgeKind;

namespace {

/// Holes and cuts that exec knows to go by feed; those that the operator ends by hand have other needs.
std::uint8_t KindOf(Cycle cycle) {
  switch (cycle) {
    case Cycle::kNone:
      return FeedState::kNoCycle;
    case Cycle::kDrill:
    case Cycle::kDrillDwell:
    case Cycle::kPeck:
    case Cycle::kPeckChip:
    case Cycle::kTap:
    case Cycle::kTapLeft:
    case Cycle::kBoreFeed:
    case Cycle::kBoreStop:
    case Cycle::kBoreDwell:
    case Cycle::kFacePeck:
    case Cycle::kFaceTap:
    case Cycle::kFaceBore:
    case Cycle::kCrossPeck:
    case Cycle::kCrossTap:
    case Cycle::kCrossBore:
    case Cycle::kTurn:
    case Cycle::kTurnFace:
      return FeedState::kFeedCycle;
    case Cycle::kTurnThread:
      return FeedState::kThreadCycle;
    default:
      return FeedState::kOtherCycle;
  }
}

bool IsThread(Motion motion) { return motion >= Motion::kThread && motion <= Motion::kThreadDecreasing; }

}  // namespace

FeedFlow::FeedFlow(const ir::analysis::FlowSources& sources, const KnownWays& ways)
    : module_(sources.module), sources_(sources), ways_(ways), uses_(module_.programs.Size()) {
  FindUses();
}

FeedFlow::State FeedFlow::Entry(ProgramId program) const {
  // What nothing here calls may be called with any state.
  if (!ir::analysis::StartsAsMain(module_, program)) return Unknown(program);
  return {.ways = State::kNone, .cycles = State::kNoCycle};
}

FeedFlow::State FeedFlow::Unknown(ProgramId) { return {.ways = State::kUnknown, .cycles = State::kOtherCycle}; }

bool FeedFlow::Join(BlockId, State& into, const State& from) {
  const State old = into;
  into.ways |= from.ways;
  into.cycles |= from.cycles;
  return into.ways != old.ways || into.cycles != old.cycles;
}

/// Where the lead is a centre word, F of a thread whose lead changes is that change (sinumerik-8.4).
bool FeedFlow::ChangesLead(ProgramId program, BlockId id) const {
  if (sources_.machine.thread_lead_from_feed || sources_.modal == nullptr) return false;
  const Motion motion = sources_.modal->At(program, id).motion;
  return motion == Motion::kThreadIncreasing || motion == Motion::kThreadDecreasing;
}

/// A new kind of feed drops the feed, where the machine says so.
void FeedFlow::ChangeKind(ProgramId program, BlockId id, State& state) const {
  if (!sources_.machine.feed_type_change_drops_feed || sources_.modal == nullptr) return;
  if ((state.ways & State::kSet) == 0) return;
  const ir::FeedMode before = sources_.modal->Before(program, id).feed_mode;
  const ir::FeedMode now = sources_.modal->At(program, id).feed_mode;
  if (before == now || now == ir::FeedMode::kUnknown) return;
  if (before == ir::FeedMode::kUnknown) {
    state.ways |= State::kIdle;
  } else {
    state.ways = static_cast<std::uint16_t>((state.ways & ~State::kSet) | State::kChanged);
  }
}

void FeedFlow::Set(ProgramId program, BlockId id, State& state) const {
  const ir::Block& block = module_.blocks[id];
  // A pass and the way into the loop are told apart at its head only.
  state.ways = static_cast<std::uint16_t>((state.ways | state.ways >> State::kPass) & State::kAll);
  if ((block.flags & ir::Block::kRefused) != 0) state = Unknown({});
  ChangeKind(program, id, state);
  for (const ir::WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    switch (word.op) {
      case WordOp::kFeed:
        if (ChangesLead(program, id)) break;
        // F0: a feed of nothing is none (sinumerik-10#49, fanuc-11#8).
        state.ways = LiteralValue(module_, word.value) == 0.0 ? State::kZero : State::kSet;
        break;
      case WordOp::kMotion:
        state.cycles = State::kNoCycle;
        break;
      case WordOp::kCycle:
        state.cycles = KindOf(static_cast<Cycle>(word.index));
        break;
      case WordOp::kComputedG:
      case WordOp::kDataSetting:
      case WordOp::kVerbatim:
        state = Unknown({});
        break;
      default:
        break;
    }
  }
}

void FeedFlow::Transfer(ProgramId program, BlockId id, State& state) const {
  const bool counted = ir::HasWord(module_, module_.blocks[id], WordOp::kFor);
  const bool tested = ir::HasWord(module_, module_.blocks[id], WordOp::kWhile);
  if (counted || tested) return;  // Along asks which way a run came
  Set(program, id, state);
  const NeededFeed needed = NeedOf(program, id, state);
  if (needed.need == FeedNeed::kNothing || !needed.certain) return;
  state.ways &= State::kSet | State::kUnknown;
  if (state.ways == 0) state.ways = State::kUnknown;
}

bool FeedFlow::Along(ProgramId, BlockId id, const ir::analysis::Edge& edge, State& state) const {
  const bool counted = ir::HasWord(module_, module_.blocks[id], WordOp::kFor);
  const bool tested = ir::HasWord(module_, module_.blocks[id], WordOp::kWhile);
  if (edge.kind == EdgeKind::kBack) {
    state.ways = static_cast<std::uint16_t>((state.ways & State::kAll) << State::kPass);
    return true;
  }
  if (!ways_.MayTake(id, edge)) return false;
  if (!counted && !tested) return true;
  auto fresh = static_cast<std::uint16_t>(state.ways & State::kAll);
  if (edge.kind == EdgeKind::kFalse) {
    if (counted && !ways_.MayIdle(id)) {
      fresh = 0;
    } else if ((tested || ways_.MayPass(id)) && (fresh & State::kLacks) != 0) {
      fresh = static_cast<std::uint16_t>((fresh & ~State::kLacks) | State::kIdle);
    }
  }
  state.ways = static_cast<std::uint16_t>(fresh | state.ways >> State::kPass);
  return state.ways != 0;
}

bool FeedFlow::SetsFeed(const ir::Block& block) const {
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kFeedOnce) return true;
    if (word.op == WordOp::kFeed && LiteralValue(module_, word.value) != 0.0) return true;
  }
  return false;
}

NeededFeed FeedFlow::NeedOf(ProgramId program, BlockId id, const State& state) const {
  const ir::Block& block = module_.blocks[id];
  if ((block.flags & ir::Block::kRefused) != 0) return {};
  if (const NeededFeed own = OwnNeed(program, id, state); own.need != FeedNeed::kNothing) return own;
  if (module_.programs[program].library) return {};
  const ir::Word* moving = nullptr;
  for (const ir::WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    if (moving == nullptr && ir::analysis::IsMotionWord(word.op)) moving = &word;
    if (word.op != WordOp::kCall || !module_.calls.Contains(word.Extra<ir::CallId>())) continue;
    const ProgramId callee = module_.calls[word.Extra<ir::CallId>()].program;
    const Use use = UseOf(callee);
    if (use.may) return {FeedNeed::kCall, use.must, &word, callee};
  }
  if (moving == nullptr || sources_.modal == nullptr) return {};
  const ir::CallId modal = sources_.modal->ActiveModalCall(program, id);
  if (!module_.calls.Contains(modal)) return {};
  const ProgramId callee = module_.calls[modal].program;
  const Use use = UseOf(callee);
  if (!use.may) return {};
  const bool active = sources_.modal->ModalCallBefore(program, id) == ir::analysis::ModalFlow::ModalCall::kActive;
  return {FeedNeed::kModalCall, use.must && active, moving, callee};
}

NeededFeed FeedFlow::OwnNeed(ProgramId program, BlockId id, const State& state) const {
  const ir::Block& block = module_.blocks[id];
  if (sources_.modal == nullptr) return {};
  if ((state.cycles & ~State::kNoCycle) != 0) return CycleNeed(block, state);
  const ir::ModalState modes = sources_.modal->At(program, id);
  const ir::Word* moving = ir::IsArc(modes.motion) ? ArcWord(module_, block, modes.motion) : nullptr;
  if (moving == nullptr) moving = MovingWord(module_, block);
  if (moving == nullptr) return {};
  if (IsThread(modes.motion) && sources_.machine.thread_lead_from_feed)
    return {.need = FeedNeed::kLead, .word = moving};
  const bool by_feed =
      ir::IsFeedMotion(modes.motion) || modes.motion == Motion::kTapFloating || modes.motion == Motion::kProbe;
  if (!by_feed || ir::HasWord(module_, block, WordOp::kFeedOnce)) return {};
  return {.need = FeedNeed::kMove, .word = moving};
}

/// A block with a place or a level makes a hole, or a cut.
NeededFeed FeedFlow::CycleNeed(const ir::Block& block, const State& state) const {
  if ((state.cycles & (State::kFeedCycle | State::kThreadCycle)) == 0) return {};
  NeededFeed needed;
  needed.certain = state.cycles == State::kFeedCycle || state.cycles == State::kThreadCycle;
  needed.need = (state.cycles & State::kFeedCycle) != 0 ? FeedNeed::kCycle : FeedNeed::kCycleLead;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kAxis:
        if (word.index < 3 && needed.word == nullptr) needed.word = &word;
        break;
      case WordOp::kRadius:
        if (needed.word == nullptr) needed.word = &word;
        break;
      case WordOp::kCycleValue: {
        const auto field = static_cast<ir::CycleField>(word.index);
        if (field == ir::CycleField::kLevel && needed.word == nullptr) needed.word = &word;
        if (field != ir::CycleField::kRepeats) break;
        const std::optional<double> count = LiteralValue(module_, word.value);
        if (count == 0.0) return {};
        needed.certain = needed.certain && count.has_value();
        break;
      }
      case WordOp::kFrame:
      case WordOp::kReference:
      case WordOp::kMachineCoords:
      case WordOp::kPole:
      case WordOp::kPresetPosition:
      case WordOp::kDwellSeconds:
      case WordOp::kDwellRevolutions:
      case WordOp::kDataSetting:
      case WordOp::kWhen:
      case WordOp::kCall:
        return {};
      default:
        break;
    }
  }
  return needed.word != nullptr ? needed : NeededFeed{};
}

FeedFlow::Use FeedFlow::UseOf(ProgramId program) const {
  return program.Valid() && module_.programs[program].library ? uses_[program.value] : Use{};
}

void FeedFlow::FindUses() {
  for (const ProgramId program : sources_.calls.BottomUp()) {
    const ir::analysis::Cfg& graph = sources_.graphs.Of(program);
    const auto blocks = graph.Blocks();
    if (!module_.programs[program].library || blocks.Empty() || graph.Opaque()) continue;
    Use& use = uses_[program.value];
    use.must = true;
    std::vector<std::uint8_t> seen(blocks.count, 0);
    std::vector<BlockId> waiting{blocks[0]};
    seen[0] = 1;
    while (!waiting.empty()) {
      const BlockId id = waiting.back();
      waiting.pop_back();
      const ir::Block& block = module_.blocks[id];
      const bool moves =
          !SetsFeed(block) &&
          OwnNeed(program, id, {.ways = State::kNone, .cycles = State::kNoCycle}).need != FeedNeed::kNothing;
      use.may = use.may || moves;
      if (moves) continue;
      if (SetsFeed(block)) {
        use.must = false;
        continue;
      }
      bool through = true;
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module_.words[word_id];
        if (word.op != WordOp::kCall || !module_.calls.Contains(word.Extra<ir::CallId>())) continue;
        const Use inner = UseOf(module_.calls[word.Extra<ir::CallId>()].program);
        use.may = use.may || inner.may;
        through = through && !inner.must;
      }
      if (!through) continue;
      for (const ir::analysis::Edge& edge : graph.Successors(id)) {
        if (!ways_.MayTake(id, edge)) continue;
        if (!edge.to.Valid()) {
          // An alarm is one without a feed as well.
          use.must = use.must && (edge.kind == EdgeKind::kAlarm || edge.kind == EdgeKind::kMissing);
        } else if (std::uint8_t& visited = seen[edge.to.value - blocks.begin]; visited == 0) {
          visited = 1;
          waiting.push_back(edge.to);
        }
      }
    }
    use.must = use.must && use.may;
  }
}

}  // namespace ncport::check
