// The stack of what runs: entering, further passes, and the way back.
#include <string>

#include "exec/runner.h"

namespace ncport::exec {

using ir::BlockId;

namespace {

constexpr std::size_t kMostLevels = 10'000;  // repeated parts nest too, and they have no limit of the control

}  // namespace

void Runner::Enter(Level level) {
  if (levels_.size() >= kMostLevels)
    return session_.Limit("fewer nested repetitions", diag::Code::kNestingLimit, "repetitions", kMostLevels);
  if (level.kind != LevelKind::kMain) call_blocks_.push_back(level.from);
  if (session_.options.count_turns) {
    level.turns = turn_counts_.size();
    turn_counts_.resize(turn_counts_.size() + session_.module.programs[level.program].blocks.count);
    turns_.push_back(0);
  }
  levels_.push_back(level);
  Activate();
}

Runner::Level Runner::CalledLevel(LevelKind kind, ir::ProgramId program, std::uint32_t passes) const {
  const IdRange<BlockId> blocks = session_.module.programs[program].blocks;
  Level level;
  level.kind = kind;
  level.program = program;
  level.begin = blocks.begin;
  level.end = blocks.begin + blocks.count;
  level.from = session_.block;
  level.finish_block = (session_.linked.UseOf(session_.block) & kUseLast) != 0;
  level.words_end = words_end_;
  level.passes_left = passes - 1;
  level.stack = memory_.Top();
  level.facts = facts_;
  level.facts.program = program;
  level.facts.depth = facts_.depth + 1;
  return level;
}

void Runner::EnterCalled(Level level) {
  if (level.kind != LevelKind::kRange && session_.module.programs[level.program].saves_modal_state) {
    level.saved = static_cast<std::uint32_t>(saves_.size());
    saves_.push_back({channel_.modal, channel_.frame});
  }
  pc_ = level.begin;
  ++calls_;
  Enter(level);
}

void Runner::Activate() {
  const bool modal_call = !modals_.empty();
  facts_ = levels_.back().facts;
  facts_.modal_call = modal_call;
  limit_ = levels_.back().end;
  frames_.call_blocks = call_blocks_.data();
  frames_.depth = static_cast<std::uint32_t>(call_blocks_.size());
  frames_.turns = turns_.empty() ? nullptr : turns_.data();
  emitter_.SetFrames(&frames_);
}

void Runner::PopLevel() {
  const Level& level = levels_.back();
  if (level.kind != LevelKind::kPart && level.kind != LevelKind::kMain) --calls_;
  memory_.Pop(level.stack);
  if (level.saved != kNotSaved) {
    const Save save = saves_[level.saved];
    saves_.resize(level.saved);
    kinematics_.Restore(save.modal, save.frame);
  }
  if (session_.options.count_turns) {
    turn_counts_.resize(level.turns);
    turns_.pop_back();
  }
  call_blocks_.pop_back();
  levels_.pop_back();
}

/// The innermost level has come to its end.
void Runner::Leave() {
  Level& level = levels_.back();
  if (level.passes_left == 0) {
    const Level ended = level;
    PopLevel();
    Activate();
    pc_ = ended.from.value + 1;
    if (ended.finish_block) FinishBlock(ended.from, ended.words_end);
    return;
  }
  --level.passes_left;
  pc_ = level.begin;
  if (level.saved != kNotSaved) kinematics_.Restore(saves_[level.saved].modal, saves_[level.saved].frame);
  if (level.kind == LevelKind::kPart || level.kind == LevelKind::kRange) return;
  if (session_.machine.passes_keep_locals ||
      (level.kind == LevelKind::kModal && session_.machine.modal_call_keeps_locals)) {
    level.keeps_locals = true;
    return;
  }
  // Each pass has fresh locals and the arguments as they were passed (sinumerik-7.7).
  const Memory::Address frame = level.facts.frame;
  if (level.kind == LevelKind::kModal) {
    const Memory::Address kept = session_.linked.ModalPlace(level.modal);
    const std::uint32_t size = session_.linked.LevelCells() + session_.linked.FrameSize(level.program);
    for (std::uint32_t i = 0; i < size; ++i) memory_[level.facts.level + i] = memory_[kept + i];
    return;
  }
  const ir::Call& call = session_.module.calls[ir::CallId{std::size_t{level.call}}];
  if (call.new_level) {
    for (std::uint32_t i = 0; i < session_.linked.LevelCells(); ++i) memory_[level.facts.level + i] = Value::Vacant();
  }
  InitFrame(level.program, frame);
  arguments_.clear();
  std::uint32_t letters = 0;
  for (const ir::ArgId id : call.args) letters += session_.module.args[id].letter != 0 ? 1 : 0;
  const std::uint32_t stored = session_.module.programs[level.program].parameters.count + letters;
  for (std::uint32_t i = 0; i < stored; ++i) arguments_.push_back(memory_[level.arguments + i]);
  PutArguments(call, level.program, level.facts.level, frame);
}

void Runner::DropParts() {
  while (levels_.back().kind == LevelKind::kPart) PopLevel();
  Activate();
}

void Runner::Return() {
  DropParts();
  if (levels_.back().kind == LevelKind::kMain) {
    done_ = true;
    return;
  }
  Leave();
}

/// Back to a block of the caller by number or label: RET("label"), M99 P. Passes that are left are given up. In the
/// main program it is a jump.
void Runner::ReturnTo(ir::ExprId target) {
  ir::Target wanted;
  wanted.kind = ir::TargetKind::kExpression;
  wanted.expr = target;
  DropParts();
  // The expression is evaluated with the locals of the program that returns.
  const bool main = levels_.back().kind == LevelKind::kMain;
  const Level& caller = main ? levels_.back() : levels_[levels_.size() - 2];
  const BlockId from = main ? session_.block : levels_.back().from;
  std::string name;
  const BlockId found = FindTarget(wanted, caller.program, from, ir::Search::kForwardThenFromStart, name);
  if (session_.halted) return;
  if (!found.Valid())
    return session_.Alarm(ir::AlarmClass::kMissingTarget, fmt::format("return target {} not found", name));
  if (!main) PopLevel();
  Activate();
  JumpTo(found);
}

}  // namespace ncport::exec
