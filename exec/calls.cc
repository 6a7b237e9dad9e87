// Calls: arguments, passes, modal calls, ranges, and the way back.
#include <algorithm>
#include <cmath>
#include <string>

#include "exec/runner.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/text.h"

namespace ncport::exec {

using ir::BlockId;
namespace ops = ir::ops;

namespace {

constexpr std::size_t kMostLevels = 10'000;   // repeated parts nest too, and they have no limit of the control

/// The name in a path or with the marks of a file: "/_N_SPF_DIR/_N_SUB1_SPF" is SUB1 (sinumerik-1.1).
std::string_view PlainName(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
  const auto starts = [&](std::string_view prefix) { return name.size() > prefix.size() && ops::SameName(name.substr(0, prefix.size()), prefix); };
  const auto ends = [&](std::string_view suffix) {
    return name.size() > suffix.size() && ops::SameName(name.substr(name.size() - suffix.size()), suffix);
  };
  if (starts("_N_")) name.remove_prefix(3);
  for (const std::string_view suffix : {"_SPF", "_MPF", "_CPF", ".SPF", ".MPF", ".CPF"}) {
    if (!ends(suffix)) continue;
    name.remove_suffix(suffix.size());
    break;
  }
  return name;
}

}  // namespace

const Runner::Level& Runner::CallLevel() const {
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    if (level->kind != LevelKind::kPart) return *level;
  }
  return levels_.front();
}

ir::ProgramId Runner::Callee(const ir::Call& call) {
  if (call.program.Valid()) return call.program;
  std::string name(session_.module.View(call.name));
  if (call.name_expr.Valid()) {
    const Value value = evaluator_.Eval(call.name_expr);
    if (session_.halted) return {};
    TextBuffer text;
    evaluator_.AppendText(text, value);
    name = text.View();
  }
  const ir::ProgramId found = session_.module.FindProgram(PlainName(name), true);
  if (!found.Valid()) session_.Refuse(diag::Code::kUnknownProgram, name);
  return found;
}

bool Runner::Passes(const ir::Call& call, std::uint32_t& passes) {
  passes = 1;
  if (!call.passes.Valid()) return true;
  const double count = ops::Round(evaluator_.Number(call.passes));
  if (session_.halted) return false;
  if (!(count >= 1 && count <= session_.machine.passes_max)) {
    session_.Alarm(ir::AlarmClass::kRange, fmt::format("{:.0f} passes", count));
    return false;
  }
  passes = static_cast<std::uint32_t>(count);
  return true;
}

bool Runner::Deeper() {
  if (calls_ >= session_.machine.call_depth) {
    session_.Alarm(ir::AlarmClass::kNesting, "calls nested too deep");
    return false;
  }
  return true;
}

/// A fresh set of locals.
void Runner::InitFrame(ir::ProgramId program, Memory::Address frame) {
  const std::span<const Value> values = session_.linked.FrameOf(program);
  for (std::uint32_t i = 0; i < values.size(); ++i) memory_[frame + i] = values[i];
}

/// Values of the arguments while the locals of the caller are still in reach, into arguments_ by parameter.
bool Runner::EvalArguments(const ir::Call& call, ir::ProgramId program, std::uint64_t& given) {
  const ir::Module& module = session_.module;
  const IdRange<ir::VariableId> parameters = module.programs[program].parameters;
  given = 0;
  arguments_.assign(parameters.count, Value::Vacant());
  for (const ir::ArgId id : call.args) {
    const ir::Arg& arg = module.args[id];
    if (arg.letter != 0) {
      arguments_.push_back(arg.value.Valid() ? evaluator_.Eval(arg.value) : Value::Vacant());
      continue;
    }
    if (!arg.value.Valid()) continue;
    if (arg.position >= parameters.count) {
      session_.Alarm(ir::AlarmClass::kOther, fmt::format("{} takes {} arguments", module.View(module.programs[program].name), parameters.count));
      return false;
    }
    const ir::Variable& parameter = module.variables[parameters[arg.position]];
    if (parameter.by_reference) {
      arguments_[arg.position] = evaluator_.ReferenceTo(arg.value);
    } else {
      arguments_[arg.position] = evaluator_.Converted(evaluator_.Eval(arg.value), parameter.type, parameter.string_length);
    }
    if (session_.halted) return false;
    if (arg.position < 64) given |= std::uint64_t{1} << arg.position;
  }
  for (std::uint32_t i = 0; i < parameters.count; ++i) {
    const ir::Variable& parameter = module.variables[parameters[i]];
    if (!arguments_[i].IsVacant() || parameter.by_reference || !parameter.initial.Valid()) continue;
    arguments_[i] = evaluator_.Converted(evaluator_.Eval(parameter.initial), parameter.type, parameter.string_length);
  }
  return !session_.halted;
}

/// A missing argument by value is the zero of its type, a missing letter stays vacant (hazard 6 of the corrections).
void Runner::PutArguments(const ir::Call& call, ir::ProgramId program, Memory::Address level, Memory::Address frame) {
  const ir::Module& module = session_.module;
  const IdRange<ir::VariableId> parameters = module.programs[program].parameters;
  for (std::uint32_t i = 0; i < parameters.count; ++i) {
    if (!arguments_[i].IsVacant()) memory_[frame + session_.linked.SlotOf(parameters[i]).offset] = arguments_[i];
  }
  std::uint32_t next = parameters.count;
  for (const ir::ArgId id : call.args) {
    const ir::Arg& arg = module.args[id];
    if (arg.letter == 0) continue;
    const Value value = arguments_[next++];
    for (const ir::SpaceId space_id : module.spaces.Ids()) {
      const ir::Space& space = module.spaces[space_id];
      const SpaceSlot& slot = session_.linked.SlotOf(space_id);
      if (!slot.per_level || arg.position < space.first || arg.position > space.last) continue;
      memory_[level + slot.offset + arg.position - space.first] = value;
      break;
    }
  }
}

bool Runner::Call(ir::CallId id) {
  const ir::Call& call = session_.module.calls[id];
  std::uint32_t passes = 1;
  if (!Passes(call, passes)) return true;
  if (call.form == ir::CallForm::kBlockRange) return CallRange(call, passes);
  const ir::ProgramId program = Callee(call);
  std::uint64_t given = 0;
  if (session_.halted || !Deeper() || !EvalArguments(call, program, given)) return true;

  const ir::Program& callee = session_.module.programs[program];
  const std::uint32_t level_cells = call.new_level ? session_.linked.LevelCells() : 0;
  const bool again = passes > 1 && !session_.machine.passes_keep_locals;
  Level level;
  level.kind = LevelKind::kCall;
  level.program = program;
  level.begin = callee.blocks.begin;
  level.end = callee.blocks.begin + callee.blocks.count;
  level.from = session_.block;
  level.finish_block = (session_.linked.UseOf(session_.block) & kUseLast) != 0;
  level.words_end = words_end_;
  level.passes_left = passes - 1;
  level.stack = memory_.Top();
  level.call = id.value;
  level.facts = facts_;
  level.facts.program = program;
  level.facts.given = given;
  level.facts.depth = facts_.depth + 1;
  if (again) {
    level.arguments = memory_.Push(static_cast<std::uint32_t>(arguments_.size()));
    if (level.arguments != Memory::kNoRoom) {
      for (std::uint32_t i = 0; i < arguments_.size(); ++i) memory_[level.arguments + i] = arguments_[i];
    }
  }
  const Memory::Address cells = memory_.Push(level_cells + session_.linked.FrameSize(program));
  if (cells == Memory::kNoRoom || (again && level.arguments == Memory::kNoRoom)) {
    session_.Limit("RunOptions::max_cells", diag::Code::kCellLimit, session_.options.max_cells);
    return true;
  }
  if (call.new_level) level.facts.level = cells;
  level.facts.frame = cells + level_cells;
  InitFrame(program, level.facts.frame);
  PutArguments(call, program, level.facts.level, level.facts.frame);
  if (callee.saves_modal_state) {
    level.saved = static_cast<std::uint32_t>(saves_.size());
    saves_.push_back({channel_.modal, channel_.frame});
  }
  pc_ = level.begin;
  ++calls_;
  Enter(level);
  return true;
}

/// CALL .. BLOCK a TO b: the blocks between two targets, both inclusive, of this or another program. Blocks of this program see
/// its locals.
bool Runner::CallRange(const ir::Call& call, std::uint32_t passes) {
  const bool named = call.program.Valid() || call.name_expr.Valid() || !session_.module.View(call.name).empty();
  const ir::ProgramId program = named ? Callee(call) : facts_.program;
  if (session_.halted || !Deeper()) return true;
  const bool own = program == facts_.program;
  const IdRange<BlockId> blocks = session_.module.programs[program].blocks;
  // From the top: a range is a place of the program, not something near the call.
  const BlockId from = own ? session_.block : BlockId{std::size_t{blocks.begin}};
  std::string name;
  const BlockId first = FindTarget(call.from, program, from, own ? ir::Search::kBackwardThenForward : ir::Search::kForwardThenFromStart, name);
  BlockId last;
  if (first.Valid()) {
    last = FindTarget(call.to, program, first, ir::Search::kForward, name);
    if (!last.Valid()) last = FindTarget(call.to, program, first, ir::Search::kBackward, name);
  }
  if (session_.halted) return true;
  if (!first.Valid() || !last.Valid() || last < first) {
    session_.Alarm(ir::AlarmClass::kMissingTarget, fmt::format("block {} not found", name));
    return true;
  }
  Level level;
  level.kind = LevelKind::kRange;
  level.program = program;
  level.begin = first.value;
  level.end = last.value + 1;
  level.from = session_.block;
  level.finish_block = (session_.linked.UseOf(session_.block) & kUseLast) != 0;
  level.words_end = words_end_;
  level.passes_left = passes - 1;
  level.stack = memory_.Top();
  level.facts = facts_;
  level.facts.program = program;
  level.facts.depth = facts_.depth + 1;
  if (!own) {
    level.facts.frame = memory_.Push(session_.linked.FrameSize(program));
    if (level.facts.frame == Memory::kNoRoom) {
      session_.Limit("RunOptions::max_cells", diag::Code::kCellLimit, session_.options.max_cells);
      return true;
    }
    InitFrame(program, level.facts.frame);
  }
  pc_ = level.begin;
  ++calls_;
  Enter(level);
  return true;
}

/// The block itself runs nothing: program, arguments and locals are kept for the blocks to come (sinumerik-7.1).
bool Runner::StartModal(const ir::Word& word) {
  if (word.extra == ir::CallId::kNone) {
    if (!modals_.empty()) modals_.pop_back();
    facts_.modal_call = !modals_.empty();
    return false;
  }
  const auto id = word.Extra<ir::CallId>();
  const ir::Call& call = session_.module.calls[id];
  Modal modal;
  modal.call = id;
  if (call.form == ir::CallForm::kBlockRange) {
    session_.Refuse(diag::Code::kCannotRun, "a modal call of a block range");
    return true;
  }
  modal.program = Callee(call);
  if (session_.halted || !Passes(call, modal.passes) || !EvalArguments(call, modal.program, modal.given)) return true;
  if (modals_.size() >= session_.machine.modal_call_levels) {
    if (session_.machine.modal_call_levels != 1) {
      session_.Alarm(ir::AlarmClass::kNesting, "modal calls nested too deep");
      return true;
    }
    modals_.clear();  // one at a time: the new one replaces it
  }
  const auto used = [&](std::uint32_t place) {
    return std::ranges::any_of(modals_, [&](const Modal& other) { return other.place == place; }) ||
           std::ranges::any_of(levels_, [&](const Level& level) { return level.kind == LevelKind::kModal && level.modal == place; });
  };
  while (modal.place < session_.linked.ModalPlaces() && used(modal.place)) ++modal.place;
  if (modal.place == session_.linked.ModalPlaces()) {
    session_.Alarm(ir::AlarmClass::kNesting, "modal calls nested too deep");
    return true;
  }
  const Memory::Address cells = session_.linked.ModalPlace(modal.place);
  const Memory::Address frame = cells + session_.linked.LevelCells();
  for (Memory::Address cell = cells; cell < frame; ++cell) memory_[cell] = Value::Vacant();
  InitFrame(modal.program, frame);
  PutArguments(call, modal.program, cells, frame);
  modals_.push_back(modal);
  facts_.modal_call = true;
  return false;
}

/// After a block with motion. Inside a modal subprogram only those that were started before it run.
bool Runner::TriggerModal() {
  std::size_t count = modals_.size();
  for (const Level& level : levels_) {
    if (level.kind != LevelKind::kModal) continue;
    const auto running = std::ranges::find_if(modals_, [&](const Modal& modal) { return modal.place == level.modal; });
    count = std::min(count, static_cast<std::size_t>(running == modals_.end() ? 0 : running - modals_.begin()));
  }
  if (count == 0) return false;
  if (!Deeper()) return true;
  Modal& modal = modals_[count - 1];
  const ir::Program& callee = session_.module.programs[modal.program];
  Level level;
  level.kind = LevelKind::kModal;
  level.program = modal.program;
  level.begin = callee.blocks.begin;
  level.end = callee.blocks.begin + callee.blocks.count;
  level.from = session_.block;
  level.finish_block = (session_.linked.UseOf(session_.block) & kUseLast) != 0;
  level.words_end = words_end_;
  level.passes_left = modal.passes - 1;
  level.stack = memory_.Top();
  level.modal = modal.place;
  level.keeps_locals = modal.started && session_.machine.modal_call_keeps_locals;
  level.facts = facts_;
  level.facts.program = modal.program;
  level.facts.given = modal.given;
  level.facts.depth = facts_.depth + 1;
  const Memory::Address kept = session_.linked.ModalPlace(modal.place);
  Memory::Address cells = kept;
  if (!session_.machine.modal_call_keeps_locals) {
    const std::uint32_t size = session_.linked.LevelCells() + session_.linked.FrameSize(modal.program);
    cells = memory_.Push(size);
    if (cells == Memory::kNoRoom) {
      session_.Limit("RunOptions::max_cells", diag::Code::kCellLimit, session_.options.max_cells);
      return true;
    }
    for (std::uint32_t i = 0; i < size; ++i) memory_[cells + i] = memory_[kept + i];
  }
  level.facts.level = cells;
  level.facts.frame = cells + session_.linked.LevelCells();
  modal.started = true;
  if (callee.saves_modal_state) {
    level.saved = static_cast<std::uint32_t>(saves_.size());
    saves_.push_back({channel_.modal, channel_.frame});
  }
  pc_ = level.begin;
  ++calls_;
  Enter(level);
  return true;
}

void Runner::Enter(Level level) {
  if (levels_.size() >= kMostLevels) return session_.Limit("fewer nested repetitions", diag::Code::kNestingLimit, "repetitions", kMostLevels);
  if (level.kind != LevelKind::kMain) call_blocks_.push_back(level.from);
  if (session_.options.count_turns) {
    level.turns = turn_counts_.size();
    turn_counts_.resize(turn_counts_.size() + session_.module.programs[level.program].blocks.count);
    turns_.push_back(0);
  }
  levels_.push_back(level);
  Activate();
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
  if (session_.machine.passes_keep_locals || (level.kind == LevelKind::kModal && session_.machine.modal_call_keeps_locals)) {
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

/// Back to a block of the caller by number or label: RET("label"), M99 P. Passes that are left are given up. In the main program
/// it is a jump.
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
  if (!found.Valid()) return session_.Alarm(ir::AlarmClass::kMissingTarget, fmt::format("return target {} not found", name));
  if (!main) PopLevel();
  Activate();
  JumpTo(found);
}

}  // namespace ncport::exec
