// Calls: names, arguments, passes, ranges of blocks.
#include <algorithm>
#include <cmath>
#include <string>

#include "exec/program_name.h"
#include "exec/runner.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/text.h"

namespace ncport::exec {

using ir::BlockId;
namespace ops = ir::ops;

std::string_view PlainName(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
  const auto starts = [&](std::string_view prefix) {
    return name.size() > prefix.size() && ops::SameName(name.substr(0, prefix.size()), prefix);
  };
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
    if (value.IsText()) {
      name = evaluator_.TextOf(value);
    } else {
      name = fmt::format("{}{:.0f}", session_.machine.program_prefix, ops::Round(evaluator_.ToNumber(value)));
    }
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
      Value value = arg.value.Valid() ? evaluator_.Eval(arg.value) : Value::Vacant();
      if (arg.increments)
        value.number *= kinematics_.Increment(arg.letter == 'A' || arg.letter == 'B' || arg.letter == 'C');
      arguments_.push_back(value);
      continue;
    }
    if (!arg.value.Valid()) continue;
    if (arg.position >= parameters.count) {
      session_.Alarm(ir::AlarmClass::kOther, fmt::format("{} takes {} arguments",
                                                         module.View(module.programs[program].name), parameters.count));
      return false;
    }
    const ir::Variable& parameter = module.variables[parameters[arg.position]];
    if (parameter.by_reference) {
      arguments_[arg.position] = evaluator_.ReferenceTo(arg.value);
    } else {
      arguments_[arg.position] =
          evaluator_.Converted(evaluator_.Eval(arg.value), parameter.type, parameter.string_length);
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

  Level level = CalledLevel(LevelKind::kCall, program, passes);
  if (call.from_block) {
    std::string name;
    const BlockId first =
        FindTarget(call.from, program, BlockId{std::size_t{level.begin}}, ir::Search::kForwardThenFromStart, name);
    if (session_.halted) return true;
    if (!first.Valid()) {
      session_.Alarm(ir::AlarmClass::kMissingTarget, fmt::format("block {} not found", name));
      return true;
    }
    level.begin = first.value;
  }
  const std::uint32_t level_cells = call.new_level ? session_.linked.LevelCells() : 0;
  const bool again = passes > 1 && !session_.machine.passes_keep_locals;
  level.call = id.value;
  level.facts.given = given;
  if (again) {
    level.arguments = memory_.Push(static_cast<std::uint32_t>(arguments_.size()));
    if (level.arguments != Memory::kNoRoom) {
      for (std::uint32_t i = 0; i < arguments_.size(); ++i) memory_[level.arguments + i] = arguments_[i];
    }
  }
  const Memory::Address cells = memory_.Push(level_cells + session_.linked.FrameSize(program));
  if (cells == Memory::kNoRoom || (again && level.arguments == Memory::kNoRoom)) {
    session_.Limit("--max-cells", diag::Code::kCellLimit, session_.options.max_cells);
    return true;
  }
  if (call.new_level) level.facts.level = cells;
  level.facts.frame = cells + level_cells;
  InitFrame(program, level.facts.frame);
  PutArguments(call, program, level.facts.level, level.facts.frame);
  EnterCalled(level);
  return true;
}

/// CALL .. BLOCK a TO b: the blocks between two targets, both inclusive, of this or another program. Blocks of this
/// program see its locals.
bool Runner::CallRange(const ir::Call& call, std::uint32_t passes) {
  const bool named = call.program.Valid() || call.name_expr.Valid() || !session_.module.View(call.name).empty();
  const ir::ProgramId program = named ? Callee(call) : facts_.program;
  if (session_.halted || !Deeper()) return true;
  const bool own = program == facts_.program;
  const IdRange<BlockId> blocks = session_.module.programs[program].blocks;
  // From the top: a range is a place of the program, not something near the call.
  const BlockId from = own ? session_.block : BlockId{std::size_t{blocks.begin}};
  std::string name;
  const BlockId first = FindTarget(call.from, program, from,
                                   own ? ir::Search::kBackwardThenForward : ir::Search::kForwardThenFromStart, name);
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
  Level level = CalledLevel(LevelKind::kRange, program, passes);
  level.begin = first.value;
  level.end = last.value + 1;
  if (!own) {
    level.facts.frame = memory_.Push(session_.linked.FrameSize(program));
    if (level.facts.frame == Memory::kNoRoom) {
      session_.Limit("--max-cells", diag::Code::kCellLimit, session_.options.max_cells);
      return true;
    }
    InitFrame(program, level.facts.frame);
  }
  EnterCalled(level);
  return true;
}

}  // namespace ncport::exec
