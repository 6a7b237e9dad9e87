// One flow with two walks, of what programs do to any caller and of what holds in them: a little long, since both share
// the steps through words and calls.
#include "ir/analysis/modal_state.h"

#include <algorithm>
#include <cmath>

namespace ncport::ir::analysis {

namespace {

constexpr std::uint16_t kSame16 = 0xFFFF;
constexpr std::uint16_t kNever16 = 0xFFFE;

// State of modal calls: 0 unknown, none, some active ones, or one that is known (kKnownCall + CallId).
constexpr std::uint32_t kSame32 = 0xFFFFFFFFU;
constexpr std::uint32_t kNever32 = 0xFFFFFFFEU;
constexpr std::uint32_t kNoCall = 1;
constexpr std::uint32_t kMostCalls = 64;
constexpr std::uint32_t kKnownCall = kNoCall + kMostCalls + 1;

enum Group : std::size_t {
  kMotion,
  kPlane,
  kDistance,
  kUnits,
  kFeed,
  kSpeed,
  kComp,
  kDiameter,
  kPath,
  kReturnLevel,
  kNone
};

Group GroupOf(WordOp op) {
  switch (op) {
    case WordOp::kMotion:
      return kMotion;
    case WordOp::kPlane:
      return kPlane;
    case WordOp::kDistance:
      return kDistance;
    case WordOp::kUnits:
      return kUnits;
    case WordOp::kFeedMode:
      return kFeed;
    case WordOp::kSpeedMode:
      return kSpeed;
    case WordOp::kCutterComp:
      return kComp;
    case WordOp::kDiameter:
      return kDiameter;
    case WordOp::kPathMode:
      return kPath;
    case WordOp::kReturnLevel:
      return kReturnLevel;
    default:
      return kNone;
  }
}

}  // namespace

bool IsMotionWord(WordOp op) {
  return (op >= WordOp::kAxis && op <= WordOp::kTurns) || op == WordOp::kPolarRadius || op == WordOp::kPolarAngle ||
         op == WordOp::kContourAngle || op == WordOp::kReference || op == WordOp::kCycleValue;
}

ModalFlow::State ModalFlow::All(std::uint8_t value) {
  State state;
  state.groups.fill(value);
  state.work_offset = value == kSame ? kSame16 : value == kNever ? kNever16 : std::uint16_t{0};
  state.modal_call = value == kSame ? kSame32 : value == kNever ? kNever32 : 0U;
  return state;
}

ModalFlow::State ModalFlow::Join(const State& a, const State& b) {
  if (IsNever(a)) return b;
  if (IsNever(b)) return a;
  State joined = a;
  for (std::size_t i = 0; i < kGroups; ++i) {
    if (a.groups[i] != b.groups[i]) joined.groups[i] = 0;
  }
  if (a.work_offset != b.work_offset) joined.work_offset = 0;
  if (a.modal_call != b.modal_call) joined.modal_call = 0;
  return joined;
}

ModalFlow::State ModalFlow::Apply(const State& change, const State& before) {
  State after = change;
  for (std::size_t i = 0; i < kGroups; ++i) {
    if (change.groups[i] == kSame) after.groups[i] = before.groups[i];
  }
  if (change.work_offset == kSame16) after.work_offset = before.work_offset;
  if (change.modal_call == kSame32) after.modal_call = before.modal_call;
  return after;
}

std::uint16_t ModalFlow::Intern(std::uint32_t number, std::uint32_t extension) {
  if (number > 0xFFFF || extension > 0xFFFF) return 0;
  const auto [entry, added] = work_offset_index_.try_emplace(number << 16U | extension, std::uint16_t{0});
  if (added && work_offsets_.size() < kNever16) {
    entry->second = static_cast<std::uint16_t>(work_offsets_.size());
    work_offsets_.push_back({true, static_cast<std::uint16_t>(number), static_cast<std::uint16_t>(extension)});
  }
  return entry->second;
}

ModalFlow::State ModalFlow::Encode(const ModalState& state) {
  const auto code = [](auto value) { return static_cast<std::uint8_t>(value); };
  State encoded = All(0);
  encoded.groups = {code(state.motion),    code(state.plane),       code(state.distance), code(state.units),
                    code(state.feed_mode), code(state.speed_mode),  code(state.comp),     code(state.diameter),
                    code(state.path),      code(state.return_level)};
  if (state.work_offset.known) encoded.work_offset = Intern(state.work_offset.number, state.work_offset.extension);
  encoded.modal_call = kNoCall;
  return encoded;
}

ModalState ModalFlow::Decode(const State& state) const {
  ModalState decoded;
  if (IsNever(state)) return decoded;
  const auto& groups = state.groups;
  decoded.motion = static_cast<Motion>(groups[kMotion]);
  decoded.plane = static_cast<Plane>(groups[kPlane]);
  decoded.distance = static_cast<Distance>(groups[kDistance]);
  decoded.units = static_cast<Units>(groups[kUnits]);
  decoded.feed_mode = static_cast<FeedMode>(groups[kFeed]);
  decoded.speed_mode = static_cast<SpeedMode>(groups[kSpeed]);
  decoded.comp = static_cast<CutterComp>(groups[kComp]);
  decoded.diameter = static_cast<Diameter>(groups[kDiameter]);
  decoded.path = static_cast<PathMode>(groups[kPath]);
  decoded.return_level = static_cast<ReturnLevel>(groups[kReturnLevel]);
  decoded.work_offset = work_offsets_[state.work_offset];
  return decoded;
}

ModalFlow::ModalFlow(const Module& module, const Machine& machine, const FlowGraphs& graphs, const CallGraph& calls,
                     const ModalOptions& options)
    : module_(module),
      machine_(machine),
      graphs_(graphs),
      calls_(calls),
      before_(module.blocks.Size(), All(kNever)),
      at_(module.blocks.Size(), All(kNever)),
      summaries_(module.programs.Size(), {All(kNever), All(kNever)}),
      entries_(module.programs.Size(), All(kNever)) {
  FindComputedGroups();
  FindModalPrograms();
  // Callees first; programs that call each other in a circle until nothing changes.
  const std::vector<ProgramId>& order = calls.BottomUp();
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && calls.GroupOf(order[end]) == calls.GroupOf(order[begin])) ++end;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = begin; i < end; ++i) changed = Analyse(order[i], All(kSame)) || changed;
    }
    begin = end;
  }
  FindEntries(options);
}

void ModalFlow::FindComputedGroups() {
  computed_ = All(machine_.g_codes.empty() ? std::uint8_t{0} : kSame);
  computed_.modal_call = kSame32;
  for (const CodeMeaning& code : machine_.g_codes) {
    if (const Group group = GroupOf(code.op); group != kNone) computed_.groups[group] = 0;
    if (code.op == WordOp::kWorkOffset) computed_.work_offset = 0;
    if (code.op == WordOp::kSpeedMode && machine_.surface_speed_per_revolution) computed_.groups[kFeed] = 0;
  }
}

void ModalFlow::FindModalPrograms() {
  for (const Word& word : module_.words.All()) {
    if (word.op != WordOp::kModalCall || !module_.calls.Contains(word.Extra<CallId>())) continue;
    modal_calls_ = true;
    const ProgramId program = module_.calls[word.Extra<CallId>()].program;
    if (program.Valid() && std::ranges::find(modal_programs_, program) == modal_programs_.end())
      modal_programs_.push_back(program);
  }
}

bool ModalFlow::Analyse(ProgramId program, const State& start) {
  const Cfg& cfg = graphs_.Of(program);
  const IdRange<BlockId> blocks = cfg.Blocks();
  const Summary old = summaries_[program.value];
  // The second pass is about one entry; what the program does to any caller stays.
  Summary unused = old;
  Summary& summary = absolute_ ? unused : summaries_[program.value];
  if (cfg.Opaque() || blocks.Empty()) {
    for (const BlockId block : blocks) {
      before_[block.value] = All(0);
      at_[block.value] = Through(block, All(0)).at;
    }
    summary.after = blocks.Empty() ? All(kSame) : All(0);
    return !(summary == old);
  }
  std::vector<BlockId> open;
  std::vector<std::uint8_t> waits(blocks.count, 0);
  const auto reach = [&](BlockId block, const State& state) {
    State& before = before_[block.value];
    const State joined = Join(before, state);
    if (joined == before) return;
    before = joined;
    std::uint8_t& waiting = waits[block.value - blocks.begin];
    if (waiting == 0) open.push_back(block);
    waiting = 1;
  };
  State computed = All(kNever);
  reach(blocks[0], start);
  // Circles of programs come here again: what was reached before is walked again, as summaries have grown.
  for (const BlockId block : blocks) {
    if (IsNever(before_[block.value]) || waits[block.value - blocks.begin] != 0) continue;
    waits[block.value - blocks.begin] = 1;
    open.push_back(block);
  }
  // The first block is taken first: programs mostly flow forward.
  std::ranges::reverse(open);
  while (!open.empty()) {
    const BlockId block = open.back();
    open.pop_back();
    waits[block.value - blocks.begin] = 0;
    const Walk walk = Through(block, before_[block.value]);
    at_[block.value] = walk.at;
    for (const Edge& edge : cfg.Successors(block)) {
      switch (edge.kind) {
        case EdgeKind::kEnd:
          if (!machine_.end_in_called_program_returns) break;
          [[fallthrough]];
        case EdgeKind::kReturn:
        case EdgeKind::kTextEnd:
          summary.after = Join(summary.after, walk.state);
          break;
        case EdgeKind::kReturnToTarget:
          summary.elsewhere = Join(summary.elsewhere, walk.state);
          break;
        case EdgeKind::kAlarm:
        case EdgeKind::kMissing:
          break;
        case EdgeKind::kComputed: {
          const State joined = Join(computed, Join(walk.state, walk.elsewhere));
          if (joined == computed) break;
          computed = joined;
          for (const BlockId target : cfg.ComputedTargets()) reach(target, computed);
          break;
        }
        default:
          if (!IsNever(walk.state)) reach(edge.to, walk.state);
          break;
      }
    }
  }
  if (module_.programs[program].saves_modal_state) {
    if (!IsNever(summary.after)) summary.after = All(kSame);
    if (!IsNever(summary.elsewhere)) summary.elsewhere = All(kSame);
  }
  return !(summary == old);
}

ModalFlow::Walk ModalFlow::Through(BlockId id, const State& before) {
  const Block& block = module_.blocks[id];
  Walk walk{before, All(kNever), before};
  if ((block.flags & Block::kRefused) != 0) {
    // Never runs; whatever it should have set is not known.
    const std::uint32_t modal_call = before.modal_call;
    walk.state = All(0);
    walk.state.modal_call = modal_call;
    walk.at = walk.state;
    return walk;
  }
  State unconditional = All(kNever);  // where the rest of the block does not run
  std::uint8_t one_block_motion = 0;
  bool moves = false;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    switch (word.op) {
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        unconditional = Join(unconditional, walk.state);
        break;
      case WordOp::kCall:
      case WordOp::kModalCall:
        break;
      default:
        Change(word, walk.state, one_block_motion);
        break;
    }
    moves = moves || IsMotionWord(word.op);
  }
  walk.at = Join(unconditional, walk.state);
  if (one_block_motion != 0) {
    walk.at.groups[kMotion] = IsNever(unconditional) ? one_block_motion : std::uint8_t{0};
  }
  // Calls act after the settings of their block.
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    if (word.op == WordOp::kModalCall) {
      ChangeModalCall(word, walk.state);
      // A block that starts one and moves runs it behind that move.
      if (!IsNever(walk.at) && walk.at.modal_call != walk.state.modal_call) walk.at.modal_call = 0;
    }
    if (word.op == WordOp::kCall && module_.calls.Contains(word.Extra<CallId>())) {
      ThroughCall(module_.calls[word.Extra<CallId>()], walk);
    }
  }
  if (moves) ThroughModalCall(walk);
  walk.state = Join(walk.state, unconditional);
  if (block.skip_level != Block::kNoSkip) walk.state = Join(walk.state, before);
  return walk;
}

void ModalFlow::Change(const Word& word, State& state, std::uint8_t& one_block_motion) {
  const Group group = GroupOf(word.op);
  if (group != kNone) {
    const auto motion = static_cast<Motion>(word.index);
    if (group == kMotion && (motion == Motion::kTapFloating || motion == Motion::kProbe)) {
      one_block_motion = word.index;
      return;
    }
    state.groups[group] = word.index;
    const bool surface = group == kSpeed && word.index == static_cast<std::uint8_t>(SpeedMode::kConstantSurface);
    if (surface && machine_.surface_speed_per_revolution) {
      state.groups[kFeed] = static_cast<std::uint8_t>(FeedMode::kPerRevolution);
    }
    return;
  }
  if (word.op == WordOp::kWorkOffset) ChangeWorkOffset(word, state);
  if (word.op == WordOp::kComputedG) state = Apply(computed_, state);
}

void ModalFlow::ChangeWorkOffset(const Word& word, State& state) {
  state.work_offset = 0;
  if (!word.value.Valid()) {
    state.work_offset = Intern(word.extra, 0);
    return;
  }
  const Expr& expr = module_.exprs[word.value];
  const bool is_number = expr.op == ExprOp::kLiteral && expr.number >= 0 && expr.number <= 0xFFFF &&
                         std::floor(expr.number) == expr.number;
  if (is_number) state.work_offset = Intern(word.extra, static_cast<std::uint32_t>(expr.number));
}

void ModalFlow::ChangeModalCall(const Word& word, State& state) const {
  if (IsNever(state)) return;
  const std::uint32_t before = state.modal_call;
  // How many are active, as far as that is known; at the entry none, see ThroughCall.
  const bool none = before == kNoCall || before == kSame32;
  const std::uint32_t active = none ? 0 : before >= kKnownCall ? 1 : before - kNoCall;
  const std::uint32_t most = std::clamp<std::uint32_t>(machine_.modal_call_levels, 1, kMostCalls);
  const bool sets = module_.calls.Contains(word.Extra<CallId>());
  if (sets && (none || most == 1)) {
    state.modal_call = kKnownCall + word.extra;
  } else if (before == 0) {
    state.modal_call = !sets && most == 1 ? kNoCall : 0;
  } else if (sets) {
    state.modal_call = kNoCall + std::min(active + 1, most);
  } else {
    state.modal_call = active <= 1 ? kNoCall : kNoCall + active - 1;
  }
}

ProgramId ModalFlow::ProgramOf(std::uint32_t known_call) const {
  CallId call;
  call.value = known_call - kKnownCall;
  return module_.calls[call].program;
}

bool ModalFlow::KeepsModalCall(ProgramId program) const {
  if (!program.Valid()) return true;
  const Summary& summary = summaries_[program.value];
  const auto keeps = [](const State& change) { return IsNever(change) || change.modal_call == kSame32; };
  return keeps(summary.after) && keeps(summary.elsewhere);
}

void ModalFlow::ThroughModalCall(Walk& walk) {
  const std::uint32_t active = walk.state.modal_call;
  if (IsNever(walk.state) || active == kNoCall || active == kSame32) return;
  // Whether the block triggers it is not decided here: both.
  Walk called = walk;
  called.state.modal_call = kNoCall;
  if (active >= kKnownCall) {
    CallId call;
    call.value = active - kKnownCall;
    ThroughCall(module_.calls[call], called);
  } else {
    called.state = All(0);
    State anything = All(0);
    anything.modal_call = kNoCall;
    for (const ProgramId program : modal_programs_) Enter(program, anything);
  }
  if (!IsNever(called.state)) {
    const bool kept =
        active >= kKnownCall
            ? KeepsModalCall(ProgramOf(active))
            : std::ranges::all_of(modal_programs_, [&](ProgramId program) { return KeepsModalCall(program); });
    called.state.modal_call = kept ? active : 0;
  }
  walk.elsewhere = called.elsewhere;
  walk.state = Join(walk.state, called.state);
}

void ModalFlow::ThroughCall(const Call& call, Walk& walk) {
  if (IsNever(walk.state)) return;
  const std::uint32_t modal_call = walk.state.modal_call;
  // What programs do to any caller is found as if no modal call were active when they start. Where one is, its runs in
  // between may change anything, unless its program puts all back. The same holds for programs that are not known and
  // for ranges of blocks.
  bool quiet = modal_call == kNoCall || modal_call == kSame32;
  if (!quiet && modal_call >= kKnownCall && machine_.modal_call_levels <= 1) {
    const ProgramId runs = ProgramOf(modal_call);
    quiet = runs.Valid() && module_.programs[runs].saves_modal_state;
  }
  const bool known = call.program.Valid() && call.form != CallForm::kBlockRange && !call.from_block;
  if (known && quiet) {
    const Summary& summary = summaries_[call.program.value];
    Enter(call.program, walk.state);
    const auto after = [&](const State& change) { return IsNever(change) ? change : Apply(change, walk.state); };
    walk.elsewhere = Join(walk.elsewhere, after(summary.elsewhere));
    walk.state = after(summary.after);
    // A change is the same whatever was before: one pass more leaves what the first one left.
    if (call.passes.Valid() && !IsNever(walk.state)) Enter(call.program, walk.state);
    return;
  }
  State anything = All(0);
  anything.modal_call = modal_call;
  if (call.program.Valid()) Enter(call.program, anything);
  if (!KeepsModalCall(call.program)) anything.modal_call = 0;
  if (call.program.Valid()) walk.elsewhere = Join(walk.elsewhere, anything);
  walk.state = anything;
}

void ModalFlow::Enter(ProgramId program, const State& state) {
  if (!absolute_) return;
  const State arrives = Join(entries_[program.value], state);
  if (arrives == entries_[program.value]) return;
  entries_[program.value] = arrives;
  entries_changed_ = true;
  entered_anew_ = true;
}

void ModalFlow::FindEntries(const ModalOptions& options) {
  const State main_entry = Encode(options.main_entry);
  const State sub_entry = Encode(options.sub_entry);
  for (const ProgramId program : module_.programs.Ids()) {
    if (module_.programs[program].kind == ProgramKind::kMain) entries_[program.value] = main_entry;
  }
  // Callers first. The flow is walked once more with the states that are now known: ways that differ in what they set
  // may agree in what is in force.
  absolute_ = true;
  std::ranges::fill(before_, All(kNever));
  std::ranges::fill(at_, All(kNever));
  if (modal_programs_.empty()) return EnterAll(&sub_entry);
  // A modal call runs its program also behind moves of programs that are called while it is active: no order of the
  // calls has all callers first.
  do {
    entered_anew_ = false;
    EnterAll(nullptr);
  } while (entered_anew_);
  do {
    entered_anew_ = false;
    EnterAll(&sub_entry);
  } while (entered_anew_);
}

void ModalFlow::EnterAll(const State* sub_entry) {
  const std::vector<ProgramId>& order = calls_.BottomUp();
  for (std::size_t end = order.size(); end > 0;) {
    std::size_t begin = end;
    while (begin > 0 && calls_.GroupOf(order[begin - 1]) == calls_.GroupOf(order[end - 1])) --begin;
    // What nothing calls starts as the user says.
    bool entered = sub_entry == nullptr;
    for (std::size_t i = begin; i < end; ++i) entered = entered || !IsNever(entries_[order[i].value]);
    for (std::size_t i = begin; i < end && !entered; ++i) entries_[order[i].value] = *sub_entry;
    // In a circle an entry may change others before it.
    do {
      entries_changed_ = false;
      for (std::size_t i = begin; i < end; ++i) {
        if (!IsNever(entries_[order[i].value])) Analyse(order[i], entries_[order[i].value]);
      }
    } while (entries_changed_ && calls_.Recursive(order[begin]));
    end = begin;
  }
}

ModalState ModalFlow::Before(ProgramId program, BlockId block) const {
  return Reached(program, block) ? Decode(before_[block.value]) : ModalState{};
}

ModalState ModalFlow::At(ProgramId program, BlockId block) const {
  return Reached(program, block) ? Decode(at_[block.value]) : ModalState{};
}

ModalState ModalFlow::Entry(ProgramId program) const { return Decode(entries_[program.value]); }

bool ModalFlow::ModalCallPossible(ProgramId program, BlockId block) const {
  // A block that only calls from a block on come to is not followed here.
  return modal_calls_ && (!Reached(program, block) || at_[block.value].modal_call != kNoCall);
}

CallId ModalFlow::ActiveModalCall(ProgramId program, BlockId block) const {
  CallId call;
  if (!Reached(program, block)) return call;
  const std::uint32_t active = at_[block.value].modal_call;
  if (active >= kKnownCall && active != kSame32 && active != kNever32) call.value = active - kKnownCall;
  return call;
}

ModalFlow::ModalCall ModalFlow::ModalCallBefore(ProgramId program, BlockId block) const {
  if (modal_programs_.empty() || !Reached(program, block)) return ModalCall::kNone;
  const std::uint32_t active = before_[block.value].modal_call;
  if (active == kNoCall) return ModalCall::kNone;
  return active == 0 || active == kSame32 || active == kNever32 ? ModalCall::kUnknown : ModalCall::kActive;
}

bool ModalFlow::Reached(ProgramId program, BlockId block) const {
  return !IsNever(before_[block.value]) && !IsNever(entries_[program.value]);
}

}  // namespace ncport::ir::analysis
