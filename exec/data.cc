// Assignments, definitions, values from outside, and the variables at the end.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "base/number_text.h"
#include "exec/runner.h"
#include "ir/axis_names.h"
#include "ir/length_units.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

void Runner::Assign(const ir::Word& word, const Value& value) {
  const Place place = evaluator_.PlaceOf(word.Extra<ir::ExprId>());
  if (!session_.halted) evaluator_.Store(place, value);
  if (session_.message_stop) {
    // A numbered variable whose write shows the comment of the block and stops.
    session_.message_stop = false;
    Event& event = emitter_.Begin(EventKind::kMessage);
    event.text = session_.CommentText();
    emitter_.Send(event);
    emitter_.Send(emitter_.Begin(EventKind::kStop));
  }
}

/// Data of the machine are written. None of them shows in traces, but with another work offset nobody knows where the
/// axes stand in the work system, and two programs that write other data differ: the event holds them in mm, by letter.
void Runner::DataSetting(ir::CallId id) {
  const ir::Module& module = session_.module;
  const ir::Call& call = module.calls[id];
  ir::Units units = channel_.modal.units;
  ir::Distance distance = channel_.modal.distance;
  for (const ir::WordId word_id : module.blocks[session_.block].words) {
    const ir::Word& word = module.words[word_id];
    if (word.op == ir::WordOp::kUnits) units = static_cast<ir::Units>(word.index);
    if (word.op == ir::WordOp::kDistance) distance = static_cast<ir::Distance>(word.index);
  }
  const bool inch = ir::LengthsAreInches(units);
  std::map<char, double> written;
  for (const ir::ArgId arg : call.args) {
    const ir::Arg& data = module.args[arg];
    const Value value = evaluator_.Eval(data.value);
    if (session_.halted) return;
    if (value.IsVacant()) continue;
    double number = evaluator_.ToNumber(value);
    if (data.letter == 'L' && (number == 2 || number == 20)) channel_.uncertain |= channel_.base_known;
    const std::optional<std::uint8_t> axis = ir::AxisOf(data.letter);
    const bool length =
        axis ? !ir::IsRotary(*axis) : std::string_view("IJKR").find(data.letter) != std::string_view::npos;
    if (data.increments) number *= length && inch ? session_.machine.increment / 10 : session_.machine.increment;
    written[data.letter] = length ? number * ir::MmPerLengthUnit(units) : number;
  }
  TextBuffer text;
  text.Append(module.View(call.name));
  if (distance == ir::Distance::kIncremental) text.Append(" ADDED");
  for (const auto& [letter, number] : written) {
    constexpr std::uint8_t kDecimals = 6;
    text.Append(' ');
    text.Append(letter);
    AppendTrimmed(text, number, kDecimals);
  }
  Event& event = emitter_.Begin(EventKind::kData);
  event.text = text.View();
  emitter_.Send(event);
}

void Runner::AssignList(ir::AssignListId id) {
  const ir::AssignList& list = session_.module.assign_lists[id];
  const Place first = evaluator_.PlaceOf(list.place);
  if (!session_.halted) FillFrom(first, list);
}

/// Consecutive elements, the last index runs fastest; skipped places stay as they are (sinumerik-3.5).
void Runner::FillFrom(const Place& first, const ir::AssignList& list) {
  const ir::Module& module = session_.module;
  if (first.kind != Place::Kind::kCell)
    return session_.Refuse(diag::Code::kCannotRun, "a list of values for something that is no array");
  if (list.repeat) {
    double count = first.room;
    if (list.count.Valid()) count = ir::ops::Round(evaluator_.Number(list.count));
    const Value value = list.values.Empty() ? Value::Vacant() : evaluator_.Eval(module.Item(list.values.begin));
    if (session_.halted) return;
    if (!(count >= 0 && count <= first.room))
      return session_.Alarm(ir::AlarmClass::kIndex, "more values than elements");
    for (std::uint32_t i = 0; i < count && !session_.halted; ++i) evaluator_.Store(first, value, i);
    return;
  }
  if (list.values.count > first.room) return session_.Alarm(ir::AlarmClass::kIndex, "more values than elements");
  for (std::uint32_t i = 0; i < list.values.count; ++i) {
    const ir::ExprId item = module.Item(list.values.begin + i);
    if (!item.Valid()) continue;
    const Value value = evaluator_.Eval(item);
    if (session_.halted) return;
    evaluator_.Store(first, value, i);
  }
}

/// A DEF block is reached: the variable starts anew. Locals that outlive a run (modal subprograms) were made by the
/// first one.
void Runner::Define(ir::VariableId id) {
  const ir::Variable& variable = session_.module.variables[id];
  if (CallLevel().keeps_locals || variable.by_reference) return;
  if (std::ranges::find(preset_, id) != preset_.end()) return;
  const Place place = evaluator_.VariablePlace(id);
  if (session_.halted) return;
  Value start = ZeroOf(variable.type);
  // 0 outside the limits: the nearest limit (sinumerik-3.2).
  if (variable.lower_limit.Valid()) start.number = std::fmax(start.number, evaluator_.Number(variable.lower_limit));
  if (variable.upper_limit.Valid()) start.number = std::fmin(start.number, evaluator_.Number(variable.upper_limit));
  for (std::uint32_t i = 0; i < place.room; ++i) memory_[place.address + i] = start;
  if (variable.initial.Valid()) evaluator_.Store(place, evaluator_.Eval(variable.initial));
  if (variable.initial_list.Valid()) FillFrom(place, session_.module.assign_lists[variable.initial_list]);
}

/// Definitions of the channel, then what the caller of the run gives: start values and arguments of the entry program.
void Runner::ApplyStartValues() {
  const ir::Module& module = session_.module;
  const RunOptions& options = session_.options;
  for (const ir::VariableId id : module.variables.Ids()) {
    if (!session_.linked.SlotOf(id).in_frame && !session_.halted) Define(id);
  }
  const auto value_of = [&](const Value& value, const std::string& text) {
    return value.IsText() ? texts_.Add(text) : value;
  };
  for (const StartValue& start : options.start_values) {
    Place place;
    if (start.variable.Valid()) {
      place = evaluator_.VariablePlace(start.variable);
      preset_.push_back(start.variable);
    } else {
      const ir::Space& space = module.spaces[start.space];
      const SpaceSlot& slot = session_.linked.SlotOf(start.space);
      if (start.cell < space.first || start.cell > space.last) {
        return session_.Alarm(ir::AlarmClass::kIndex,
                              fmt::format("{}{} does not exist", module.View(space.name), start.cell));
      }
      place.kind = Place::Kind::kCell;
      place.type = space.type;
      place.address = (slot.per_level ? facts_.level : 0) + slot.offset + start.cell - space.first;
    }
    if (session_.halted) return;
    evaluator_.Store(place, value_of(start.value, start.text));
  }
  const ir::Program& entry = module.programs[options.entry];
  arguments_.assign(entry.parameters.count, Value::Vacant());
  std::uint64_t given = 0;
  for (const EntryArgument& argument : options.arguments) {
    const Value value = value_of(argument.value, argument.text);
    if (argument.letter != 0) {
      for (const ir::SpaceId id : module.spaces.Ids()) {
        const ir::Space& space = module.spaces[id];
        const SpaceSlot& slot = session_.linked.SlotOf(id);
        if (!slot.per_level || argument.position < space.first || argument.position > space.last) continue;
        memory_[facts_.level + slot.offset + argument.position - space.first] = value;
        break;
      }
    } else if (argument.position < entry.parameters.count && !value.IsVacant()) {
      arguments_[argument.position] = value;
      if (argument.position < 64) given |= std::uint64_t{1} << argument.position;
    }
  }
  for (std::uint32_t i = 0; i < entry.parameters.count && !session_.halted; ++i) {
    const ir::VariableId parameter = entry.parameters[i];
    const ir::Variable& variable = module.variables[parameter];
    const std::uint32_t offset = session_.linked.SlotOf(parameter).offset;
    if (!variable.by_reference) {
      if (!arguments_[i].IsVacant()) {
        memory_[facts_.frame + offset] = evaluator_.Converted(arguments_[i], variable.type, variable.string_length);
      } else if (variable.initial.Valid()) {
        evaluator_.Store(evaluator_.VariablePlace(parameter), evaluator_.Eval(variable.initial));
      }
      continue;
    }
    // Nobody called, so what the reference leads to is made here.
    const std::uint32_t count = session_.linked.SlotOf(parameter).count;
    const Memory::Address cells = memory_.Push(count);
    if (cells == Memory::kNoRoom) return session_.Limit("--max-cells", diag::Code::kCellLimit, options.max_cells);
    for (std::uint32_t k = 0; k < count; ++k) memory_[cells + k] = ZeroOf(variable.type);
    if (!arguments_[i].IsVacant())
      memory_[cells] = evaluator_.Converted(arguments_[i], variable.type, variable.string_length);
    memory_[facts_.frame + offset] = {Evaluator::kReference, count, static_cast<double>(cells)};
  }
  levels_.front().facts.given = given;
  facts_.given = given;
}

void Runner::ReportCell(std::string_view name, const Value& value) {
  TextBuffer text;
  switch (value.type) {
    case ir::Type::kNone:
      text.Append("vacant");
      break;
    case ir::Type::kString:
      text.Append('"');
      text.Append(evaluator_.TextOf(value));
      text.Append('"');
      break;
    case ir::Type::kAxis:
      text.Append(evaluator_.AxisName(static_cast<std::uint8_t>(value.number)));
      break;
    default:
      AppendTrimmed(text, value.number, 6);
      break;
  }
  Event& event = emitter_.Begin(EventKind::kSetVariable);
  event.text = name;
  event.code = text.View();
  event.value = value.number;
  emitter_.SendNow(event);
}

/// Variables of the entry program and the channel, then the cells that the run has touched.
void Runner::ReportVariables() {
  const ir::Module& module = session_.module;
  const CallFacts& main = levels_.front().facts;
  TextBuffer name;
  for (const ir::VariableId id : module.variables.Ids()) {
    const ir::Variable& variable = module.variables[id];
    const VariableSlot& slot = session_.linked.SlotOf(id);
    if (slot.in_frame && variable.owner != main.program) continue;
    Memory::Address address = (slot.in_frame ? main.frame : 0) + slot.offset;
    if (variable.by_reference) {
      if (memory_[address].type != Evaluator::kReference) continue;
      address = static_cast<Memory::Address>(memory_[address].number);
    }
    for (std::uint32_t element = 0; element < slot.count; ++element) {
      name.Clear();
      name.Append(module.View(variable.name));
      if (variable.dimension_count > 0) {
        name.Append('[');
        std::uint32_t below = slot.count;
        std::uint32_t rest = element;
        for (int i = 0; i < variable.dimension_count; ++i) {
          below /= std::max(1U, variable.dimensions[i]);
          if (i > 0) name.Append(',');
          AppendInteger(name, rest / below);
          rest %= below;
        }
        name.Append(']');
      }
      ReportCell(name.View(), memory_[address + element]);
      if (session_.outcome == Outcome::kStopped) return;
    }
  }
  for (const ir::SpaceId id : module.spaces.Ids()) {
    const ir::Space& space = module.spaces[id];
    const SpaceSlot& slot = session_.linked.SlotOf(id);
    const Memory::Address first = (slot.per_level ? main.level : 0) + slot.offset;
    for (std::uint32_t i = 0; i <= space.last - space.first; ++i) {
      const Value& value = memory_[first + i];
      if (value.IsVacant() && value.text != Memory::kWrittenVacant) continue;
      name.Clear();
      name.Append(module.View(space.name));
      AppendInteger(name, space.first + i);
      ReportCell(name.View(), value);
      if (session_.outcome == Outcome::kStopped) return;
    }
  }
}

}  // namespace ncport::exec
