// Jumps, switches, structures, repeated parts, and the words that end a block.
#include <cmath>
#include <string>

#include "exec/runner.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::BlockId;
using ir::Phase;
using ir::Word;
using ir::WordId;
using ir::WordOp;
namespace ops = ir::ops;

/// True if control left the block: the rest of it is not executed, or later.
bool Runner::Flow(const ir::Block& block) {
  const ir::Module& module = session_.module;
  for (std::uint32_t index = block.words.begin; index < words_end_; ++index) {
    const Word& word = module.words[WordId{std::size_t{index}}];
    if (word.phase != Phase::kFlow) continue;
    session_.word = &word;
    bool left = false;
    switch (word.op) {
      case WordOp::kJump: {
        bool taken = true;
        if (word.value.Valid()) {
          taken = evaluator_.Truth(word.value);
          if (session_.halted) return true;
          Branch(taken);
        }
        left = taken && Jump(word.Extra<ir::JumpId>());
        break;
      }
      case WordOp::kSwitch:
        left = Switch(word);
        break;
      case WordOp::kCall:
        left = Call(word.Extra<ir::CallId>());
        break;
      case WordOp::kModalCall:
        left = StartModal(word);
        break;
      case WordOp::kRepeatPart:
        left = RepeatPart(word);
        break;
      default:
        left = Mark(block, word);
        break;
    }
    if (left || session_.halted) return true;
  }
  return false;
}

/// The target of a jump word; invalid when it is not found, `name` then says what was looked for.
BlockId Runner::FindTarget(const ir::Target& target, ir::ProgramId program, BlockId from, ir::Search search,
                           std::string& name) {
  const ir::Module& module = session_.module;
  const ir::analysis::LabelTable* const labels = session_.linked.LabelsOf(program);
  const std::uint16_t skip = session_.options.skip_levels;
  if (target.kind != ir::TargetKind::kExpression) {
    name = target.kind == ir::TargetKind::kLabel ? std::string(module.View(target.label))
                                                 : fmt::format("N{}", target.number);
    return labels == nullptr ? BlockId{} : labels->Find(target, from, search, skip);
  }
  const Value value = evaluator_.Eval(target.expr);
  if (session_.halted || labels == nullptr) return {};
  const auto number_target = [&](double number, bool main_block) {
    if (!(number >= 0 && number < ir::Block::kNoNumber)) return BlockId{};
    return labels->FindNumber(static_cast<std::uint32_t>(number), main_block, from, search, skip);
  };
  if (!value.IsText()) {
    const double number = ops::Round(value.number);
    name = fmt::format("N{:.0f}", number);
    return number_target(number, false);
  }
  // A text holds a label, or a block number as it is written: N30, 30, :30.
  name = evaluator_.TextOf(value);
  const BlockId found = labels->FindLabel(name, from, search, skip);
  if (found.Valid() || name.empty()) return found;
  const bool main_block = name.front() == ':';
  const std::size_t prefix = main_block || name.front() == 'N' || name.front() == 'n' ? 1 : 0;
  if (name.size() == prefix || name.size() > prefix + 9 ||
      name.find_first_not_of("0123456789", prefix) != std::string::npos)
    return {};
  return number_target(std::stod(name.substr(prefix)), main_block);
}

bool Runner::Jump(ir::JumpId id) {
  const ir::Jump& jump = session_.module.jumps[id];
  const BlockId known = session_.linked.StaticTarget(id);
  const std::uint16_t skip = session_.options.skip_levels;
  if (known.Valid()) {
    const std::uint8_t level = session_.module.blocks[known].skip_level;
    if (skip == 0 || level == ir::Block::kNoSkip || ((skip >> level) & 1U) == 0) return JumpTo(known);
  }
  std::string name;
  const BlockId target = FindTarget(jump.target, facts_.program, session_.block, jump.search, name);
  if (session_.halted) return true;
  if (target.Valid()) return JumpTo(target);
  if (jump.quiet) return false;
  session_.Alarm(ir::AlarmClass::kMissingTarget, fmt::format("jump target {} not found", name));
  return true;
}

/// A jump out of a repeated part ends the repetition: the part cannot come to its end any more.
bool Runner::JumpTo(BlockId target) {
  while (levels_.back().kind == LevelKind::kPart &&
         (target.value < levels_.back().begin || target.value >= levels_.back().end)) {
    PopLevel();
    Activate();
  }
  const Level& level = levels_.back();
  if (level.kind == LevelKind::kRange && (target.value < level.begin || target.value >= level.end)) {
    session_.Refuse(diag::Code::kCannotRun, "a jump out of a called range of blocks");
    return true;
  }
  pc_ = target.value;
  return true;
}

bool Runner::Switch(const Word& word) {
  const ir::Switch& arms = session_.module.switches[word.Extra<ir::SwitchId>()];
  const double value = ops::Round(evaluator_.Number(word.value));  // REAL expressions are rounded (sinumerik-6.2)
  for (std::uint32_t i = 0; i < arms.arm_count && !session_.halted; ++i) {
    const ir::SwitchArm& arm = session_.module.switch_arms[arms.first_arm + i];
    if (!arm.value.Valid() || ops::Round(evaluator_.Number(arm.value)) == value) {
      if (session_.halted) return true;
      Branch(true);
      return Jump(arm.jump);
    }
  }
  Branch(false);
  return session_.halted;
}

bool Runner::Mark(const ir::Block& block, const Word& word) {
  if (!block.link.Valid()) {
    session_.Refuse(diag::Code::kRefusedBlock);
    return true;
  }
  const auto truth = [&] {
    const bool holds = evaluator_.Truth(word.value);
    if (!session_.halted) Branch(holds);
    return holds;
  };
  switch (word.op) {
    case WordOp::kIf:
    case WordOp::kWhile:
      if (!truth() && !session_.halted) pc_ = block.link.value + 1;
      return true;
    case WordOp::kElse:
      pc_ = block.link.value + 1;
      return true;  // the branch before it has run
    case WordOp::kUntil:
      if (!truth() && !session_.halted) pc_ = block.link.value + 1;
      return true;
    case WordOp::kEndWhile:
      pc_ = block.link.value;
      return true;  // the condition is looked at again
    case WordOp::kEndLoop:
      pc_ = block.link.value + 1;
      return true;
    case WordOp::kFor:
      return CountingLoop(block, true, block.link);
    case WordOp::kEndFor:
      return CountingLoop(session_.module.blocks[block.link], false, session_.block);
    default:
      return true;  // EndIf, Loop, Repeat: control falls through
  }
}

/// FOR: the test stands before each pass; after the last one the counter has gone past the end (sinumerik-6.3).
bool Runner::CountingLoop(const ir::Block& opening, bool first, BlockId closing) {
  const ir::Module& module = session_.module;
  const Word* mark = nullptr;
  for (const WordId id : opening.words) {
    if (module.words[id].op == WordOp::kFor) mark = &module.words[id];
  }
  if (mark == nullptr) {
    session_.Refuse(diag::Code::kRefusedBlock);
    return true;
  }
  const auto for_id = mark->Extra<ir::ForId>();
  const ir::For& loop = module.fors[for_id];
  const Memory::Address end_cell = facts_.frame + session_.linked.ForSlot(for_id);
  const double step = loop.step.Valid() ? evaluator_.Number(loop.step) : 1;
  const Place place = evaluator_.PlaceOf(loop.variable);
  if (session_.halted) return true;
  double counter = 0;
  if (first) {
    counter = evaluator_.Number(mark->value);
    if (session_.machine.for_counter_rounds) counter = ops::Round(counter);
  } else {
    counter = evaluator_.ToNumber(evaluator_.Load(place)) + step;
  }
  if (first || !session_.machine.for_end_once) memory_[end_cell] = Value::Real(evaluator_.Number(loop.end));
  if (session_.halted) return true;
  // By the type of the place: the first pass writes it without having read it.
  const bool whole = module.exprs[loop.variable].type == ir::Type::kInt;
  evaluator_.Store(place, whole ? Value::Int(counter) : Value::Real(counter));
  if (session_.halted) return true;
  const double end = memory_[end_cell].number;
  const double tolerance = session_.machine.compare_tolerance;
  const bool runs = step >= 0 ? !ops::Less(end, counter, tolerance) : !ops::Less(counter, end, tolerance);
  if (first) Branch(runs);
  const auto opening_index = static_cast<std::uint32_t>(&opening - module.blocks.All().data());
  pc_ = runs ? opening_index + 1 : closing.value + 1;
  return true;
}

/// The section runs `count` more times (sinumerik-6.4), then control is behind this block.
bool Runner::RepeatPart(const Word& word) {
  const ir::Part& part = session_.module.parts[word.Extra<ir::PartId>()];
  double count = 1;
  if (word.value.Valid()) count = ops::Round(evaluator_.Number(word.value));
  if (session_.halted) return true;
  if (!(count >= 0 && count <= session_.machine.passes_max)) {
    session_.Alarm(ir::AlarmClass::kRange, fmt::format("{:.0f} repetitions", count));
    return true;
  }
  const ir::analysis::LabelTable* const labels = session_.linked.LabelsOf(facts_.program);
  const std::uint16_t skip = session_.options.skip_levels;
  const auto found = labels == nullptr ? std::nullopt : labels->FindPart(part, session_.block, skip);
  if (!found.has_value()) {
    const BlockId first = labels == nullptr
                              ? BlockId{}
                              : labels->Find(part.first, session_.block, ir::Search::kBackwardThenForward, skip);
    std::string name(session_.module.View(part.first.label));
    if (first.Valid() && part.has_last) name = session_.module.View(part.last.label);
    session_.Alarm(ir::AlarmClass::kMissingTarget, fmt::format("section {} not found", name));
    return true;
  }
  if (count == 0) return false;
  Level level = levels_.back();
  level.kind = LevelKind::kPart;
  level.begin = found->first.value;
  level.end = found->last.value + 1;
  level.from = session_.block;
  level.finish_block = (session_.linked.UseOf(session_.block) & kUseLast) != 0;
  level.words_end = words_end_;
  level.passes_left = static_cast<std::uint32_t>(count) - 1;
  level.stack = memory_.Top();
  level.arguments = Memory::kNoRoom;
  level.saved = kNotSaved;
  level.modal = kNoModal;
  pc_ = level.begin;
  Enter(level);
  return true;
}

void Runner::Last(const ir::Block& block, std::uint32_t words_end) {
  for (std::uint32_t index = block.words.begin; index < words_end; ++index) {
    const Word& word = session_.module.words[WordId{std::size_t{index}}];
    if (word.phase != Phase::kLast) continue;
    session_.word = &word;
    return LastWord(word);
  }
  for (const Word& word : computed_) {
    if (word.phase == Phase::kLast) return LastWord(word);
  }
}

void Runner::LastWord(const Word& word) {
  const bool called = CallLevel().kind != LevelKind::kMain;
  switch (word.op) {
    case WordOp::kProgramEnd:
      if ((called || session_.options.is_call) && session_.machine.end_in_called_program_returns) return Return();
      done_ = true;
      return;
    case WordOp::kReturn:
      if (static_cast<ir::ReturnKind>(word.index) == ir::ReturnKind::kToCaller && word.value.Valid())
        return ReturnTo(word.value);
      if (!called && session_.machine.return_in_main_restarts && !session_.options.is_call) {
        DropParts();
        pc_ = levels_.back().begin;
        return;
      }
      return Return();
    case WordOp::kRestart:
      DropParts();
      pc_ = levels_.back().begin;
      return;
    default:
      return;
  }
}

}  // namespace ncport::exec
