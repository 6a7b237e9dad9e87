// The loop and the phases of a block: values and assignments from left to right, settings, functions before the motion,
// the motion, functions behind it, jumps and calls, the end.
#include "exec/run.h"

#include <algorithm>
#include <cmath>

#include "exec/runner.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::BlockId;
using ir::Phase;
using ir::Word;
using ir::WordId;
using ir::WordOp;

RunResult Run(const Linked& linked, const RunOptions& options, Environment& environment, EventSink& events,
              diag::Sink& sink, Coverage* coverage) {
  return Runner(linked, options, environment, events, sink, coverage).Run();
}

RunResult Run(const ir::Module& module, const ir::Machine& machine, const RunOptions& options, Environment& environment,
              EventSink& events, diag::Sink& sink, Coverage* coverage) {
  const Linked linked(module, machine);
  return Run(linked, options, environment, events, sink, coverage);
}

Runner::Runner(const Linked& linked, const RunOptions& options, Environment& environment, EventSink& events,
               diag::Sink& sink, Coverage* coverage)
    : session_(linked, options, environment, sink, coverage),
      texts_(linked.module().strings, options.max_text_bytes),
      memory_(linked.FixedCells(), options.max_cells),
      evaluator_(session_, memory_, texts_, channel_, facts_),
      emitter_(session_, channel_, events),
      kinematics_(session_, channel_, emitter_, evaluator_),
      auxiliary_(session_, channel_, emitter_, evaluator_) {}

bool Runner::Prepare() {
  const ir::Machine& machine = session_.machine;
  const RunOptions& options = session_.options;
  NCPORT_CHECK(session_.module.programs.Contains(options.entry), "no program {} to run", options.entry.value);
  if (!memory_.Ok()) {
    session_.Limit("--max-cells", diag::Code::kCellLimit, options.max_cells);
    return false;
  }
  std::ranges::copy(session_.linked.FixedValues(), memory_.Fixed(session_.linked.NamedCells()).begin());
  values_.resize(session_.linked.LargestBlock());
  if (session_.coverage != nullptr) session_.coverage->blocks.resize(session_.module.blocks.Size());

  channel_.modal = machine.start;
  channel_.shown_comp = machine.start.comp;
  channel_.base_known = static_cast<std::uint16_t>(machine.position_known ? machine.axes : 0);
  std::ranges::copy(machine.start_position, channel_.base);
  if (options.start_position_known) {
    const bool diameter =
        machine.start.diameter == ir::Diameter::kDiameter || machine.start.diameter == ir::Diameter::kDiameterAbsolute;
    channel_.base_known |= options.start_axes;
    for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
      if ((options.start_axes & AxisBit(axis)) == 0) continue;
      channel_.base[axis] = options.start_position[axis] / (axis == machine.transverse_axis && diameter ? 2 : 1);
    }
  }
  std::ranges::copy(channel_.base, channel_.work);
  std::ranges::copy(channel_.base, channel_.step_from);
  channel_.work_known = channel_.base_known;

  const ir::Program& entry = session_.module.programs[options.entry];
  session_.block = entry.blocks.Empty() ? BlockId{} : entry.blocks[0];
  const std::uint32_t size = session_.linked.LevelCells() + session_.linked.FrameSize(options.entry);
  Level main;
  main.program = options.entry;
  main.begin = entry.blocks.begin;
  main.end = entry.blocks.begin + entry.blocks.count;
  main.stack = memory_.Top();
  main.facts.program = options.entry;
  main.facts.main_program = options.entry;
  main.facts.level = memory_.Push(size);
  if (main.facts.level == Memory::kNoRoom) {
    session_.Limit("--max-cells", diag::Code::kCellLimit, options.max_cells);
    return false;
  }
  main.facts.frame = main.facts.level + session_.linked.LevelCells();
  main.facts.main_frame = main.facts.frame;
  InitFrame(options.entry, main.facts.frame);
  pc_ = main.begin;
  Enter(main);
  ApplyStartValues();
  return !session_.halted;
}

RunResult Runner::Run() {
  if (Prepare()) Loop();
  EndRun();
  return {session_.outcome, executed_, emitter_.Moved()};
}

void Runner::Loop() {
  const std::uint64_t most = session_.options.max_blocks;
  const std::uint16_t skip_levels = session_.options.skip_levels;
  while (!done_ && !session_.halted) {
    if (pc_ == limit_) {
      AtLimit();
      continue;
    }
    const std::uint32_t index = pc_++;
    const BlockId id{std::size_t{index}};
    session_.block = id;
    session_.word = nullptr;
    if (executed_ == most) {
      session_.Limit("--max-blocks", diag::Code::kBlockLimit, most);
      break;
    }
    ++executed_;
    const std::uint16_t use = session_.linked.UseOf(id);
    if (skip_levels != 0) {
      const std::uint8_t level = session_.module.blocks[id].skip_level;
      if (level != ir::Block::kNoSkip && ((skip_levels >> level) & 1U) != 0) continue;
    }
    if (session_.coverage != nullptr) session_.coverage->blocks[index] |= 1U;
    if (!turn_counts_.empty()) CountTurn(index);
    if (use != 0) ExecuteBlock(index, use);
  }
}

void Runner::ExecuteBlock(std::uint32_t index, std::uint16_t use) {
  const BlockId id{std::size_t{index}};
  const ir::Block& block = session_.module.blocks[id];
  if ((use & (kUseRefused | kUseTooDeep)) != 0) [[unlikely]] {
    if ((use & kUseRefused) != 0) return session_.Refuse(diag::Code::kRefusedBlock);
    return session_.Limit("a simpler expression", diag::Code::kNestingLimit, "expression", 1000);
  }
  words_end_ = block.words.begin + block.words.count;
  bool moved = false;
  if ((use & kUseMark) != 0) {
    Flow(block);
    return;
  }
  if ((use & (kUseImmediate | kUseSetting | kUseBefore | kUseMotion | kUseAfter)) != 0) {
    work_.Clear();
    computed_.clear();
    Gather(block);
    if (session_.halted) return;
    if ((use & kUseSetting) != 0 || work_.has != 0 || work_.centers != 0 || work_.cycle_fields != 0) Settings(block);
    if (session_.halted) return;
    drills_ = kinematics_.Drills(work_);
    if ((use & kUseBefore) != 0 || (drills_ && ((use & kUseAfter) != 0 || !computed_.empty())))
      Actions(block, Phase::kBefore);
    if (session_.halted) return;
    session_.word = nullptr;
    if (work_.axes != 0 || work_.centers != 0 || work_.has != 0 || work_.cycle_fields != 0) {
      moved = kinematics_.Move(work_);
      if (session_.halted) return;
    }
    if ((use & kUseAfter) != 0 || !computed_.empty()) Actions(block, Phase::kAfter);
    if (session_.halted) return;
    if (texts_.WantsCompaction()) CollectGarbage();
  } else {
    computed_.clear();
  }
  if ((use & kUseFlow) != 0 && Flow(block)) return;
  if (moved && !modals_.empty() && TriggerModal()) return;
  if ((use & kUseLast) != 0 || !computed_.empty()) Last(block, words_end_);
}

/// P of the block, read as a word of a cycle until the computed code was known; missing: 1 (fanuc-8.4).
double Runner::TakeOffsetNumber() {
  constexpr auto kField = static_cast<std::size_t>(ir::CycleField::kDwell);
  if (!work_.HasField(ir::CycleField::kDwell)) return 1;
  work_.cycle_fields &= ~(1U << kField);
  work_.cycle_scaled &= ~(1U << kField);
  return ir::ops::Round(work_.cycle_value[kField]);
}

void Runner::Settings(const ir::Block& block) {
  for (std::uint32_t index = block.words.begin; index < words_end_; ++index) {
    const Word& word = session_.module.words[WordId{std::size_t{index}}];
    if (word.phase != Phase::kSetting) continue;
    session_.word = &word;
    const bool extended = word.op == WordOp::kWorkOffset && word.value.Valid();
    kinematics_.Set(word, extended ? evaluator_.ToNumber(values_[index - block.words.begin]) : -1, work_);
    if (session_.halted) return;
  }
  for (const Word& word : computed_) {
    if (word.phase != Phase::kSetting) continue;
    const bool extended = word.op == WordOp::kWorkOffset && word.index != 0;
    kinematics_.Set(word, extended ? TakeOffsetNumber() : -1, work_);
  }
  session_.word = nullptr;
  kinematics_.FinishSettings(work_);
}

/// Functions of a block with a hole act where it lies, all of them in front of it (fanuc-8.7).
Phase Runner::PhaseOf(const Word& word) const {
  const bool function = word.op == WordOp::kAux || word.op == WordOp::kSpindle;
  return drills_ && function && word.phase == Phase::kAfter ? Phase::kBefore : word.phase;
}

void Runner::Actions(const ir::Block& block, Phase phase) {
  const bool edge = work_.Has(BlockWork::kEdge);
  // A speed limit must be in force before the speed that it limits, the change word brings in the tool that its block
  // names (fanuc-8.11: order free), and an offset belongs to the tool that the block changes to, wherever they stand in
  // it: speed limits and a tool behind its change word, everything else, offsets.
  bool change = false;
  bool late_tool = false;
  for (std::uint32_t index = block.words.begin; index < words_end_; ++index) {
    const WordOp op = session_.module.words[WordId{std::size_t{index}}].op;
    change = change || op == WordOp::kToolChange;
    late_tool = late_tool || (change && op == WordOp::kTool);
    if (op == WordOp::kLengthOffset) auxiliary_.TakeLengthSign(session_.module.words[WordId{std::size_t{index}}]);
  }
  const auto round_of = [&](WordOp op) {
    if (op == WordOp::kSpeedLimit && phase == Phase::kBefore) return 0;
    if (op == WordOp::kTool && late_tool) return 0;
    const bool offset = op == WordOp::kEdge || op == WordOp::kLengthOffset || op == WordOp::kRadiusOffset;
    return change && offset ? 2 : 1;
  };
  const int last = change ? 2 : 1;
  const bool early = late_tool || work_.Has(BlockWork::kSpeedLimit);
  for (int round = phase == Phase::kBefore && early ? 0 : 1; round <= last; ++round) {
    for (std::uint32_t index = block.words.begin; index < words_end_; ++index) {
      const Word& word = session_.module.words[WordId{std::size_t{index}}];
      if (PhaseOf(word) != phase || round_of(word.op) != round) continue;
      const Value& value = values_[index - block.words.begin];
      if (word.value.Valid() && value.IsVacant() && (word.flags & Word::kVanishesVacant) != 0) continue;
      session_.word = &word;
      auxiliary_.Act(word, value, edge);
      if (session_.halted) return;
    }
  }
  for (const Word& word : computed_) {
    if (PhaseOf(word) == phase)
      auxiliary_.Act(word, word.value.Valid() ? evaluator_.Eval(word.value) : Value::Vacant(), edge);
  }
}

void Runner::FinishBlock(BlockId id, std::uint32_t words_end) {
  session_.block = id;
  session_.word = nullptr;
  computed_.clear();
  Last(session_.module.blocks[id], words_end);
}

/// The innermost level has run its last block.
void Runner::AtLimit() {
  const Level& level = levels_.back();
  if (level.kind == LevelKind::kPart || level.kind == LevelKind::kRange) return Leave();
  if (!session_.machine.file_end_is_end) {
    return session_.Alarm(
        ir::AlarmClass::kProgramEnd,
        fmt::format("program {} has no end", session_.module.View(session_.module.programs[level.program].name)));
  }
  if (level.kind == LevelKind::kMain) {
    done_ = true;
    return;
  }
  Return();
}

void Runner::EndRun() {
  session_.word = nullptr;
  if (!session_.halted) kinematics_.Finish();
  Report();
  if (session_.options.report_variables &&
      (session_.outcome == Outcome::kEnded || session_.outcome == Outcome::kAlarmed))
    ReportVariables();
}

/// The last event of a run.
void Runner::Report() {
  if (session_.outcome == Outcome::kEnded) {
    emitter_.Send(emitter_.Begin(EventKind::kEnd));
    return;
  }
  if (session_.outcome != Outcome::kAlarmed) return;
  kinematics_.Abandon();
  emitter_.Release();
  const ir::Machine::Alarm& row = session_.machine.alarms[static_cast<std::size_t>(session_.alarm)];
  Event& event = emitter_.Begin(EventKind::kAlarm);
  event.alarm = session_.alarm;
  event.code = !session_.alarm_code.empty() ? std::string_view{session_.alarm_code} : std::string_view{row.code};
  event.text = !session_.alarm_text.empty() ? std::string_view{session_.alarm_text} : std::string_view{row.text};
  emitter_.SendNow(event);
}

void Runner::CollectGarbage() {
  const std::span<Value> roots[] = {memory_.Fixed(session_.linked.NamedCells()), memory_.Stack()};
  texts_.Compact(roots);
}

void Runner::Cover(std::uint8_t bits) {
  if (session_.coverage != nullptr) session_.coverage->blocks[session_.block.value] |= bits;
}

void Runner::CountTurn(std::uint32_t index) {
  const Level& level = levels_.back();
  const IdRange<BlockId> blocks = session_.module.programs[level.program].blocks;
  turns_.back() = ++turn_counts_[level.turns + index - blocks.begin];
}

}  // namespace ncport::exec
