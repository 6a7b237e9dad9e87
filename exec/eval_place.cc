// Variables, cells and system variables: where they are, reading and writing them.
#include <algorithm>
#include <cmath>

#include "base/result.h"
#include "exec/evaluator.h"
#include "ir/ops/arithmetic.h"
#include "ir/ops/text.h"

namespace ncport::exec {

using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Type;
namespace ops = ir::ops;

Memory::Address Evaluator::AddressOf(ir::VariableId id, const ir::Variable& variable) {
  const VariableSlot& slot = session_.linked.SlotOf(id);
  if (!slot.in_frame) return slot.offset;
  if (variable.owner == facts_.program) return facts_.frame + slot.offset;
  // A variable of the main program, seen from a program that it called.
  if (variable.owner != facts_.main_program) {
    session_.Refuse(diag::Code::kUnknownName, module_.View(variable.name));
    return facts_.main_frame;
  }
  return facts_.main_frame + slot.offset;
}

Place Evaluator::VariablePlace(ir::VariableId id) {
  const ir::Variable& variable = module_.variables[id];
  Place place;
  place.kind = Place::Kind::kCell;
  place.type = variable.type;
  place.variable = id;
  place.string_length = variable.string_length;
  place.address = AddressOf(id, variable);
  place.room = session_.linked.SlotOf(id).count;
  if (session_.halted) {
    place.kind = Place::Kind::kNone;
    return place;
  }
  if (variable.by_reference) {
    const Value& reference = memory_[place.address];
    if (reference.type != kReference) {
      session_.Alarm(ir::AlarmClass::kOther, "argument by reference is missing");
      place.kind = Place::Kind::kNone;
      return place;
    }
    place.address = static_cast<Memory::Address>(reference.number);
    place.room = reference.text;
    const Type actual = memory_[place.address].type;
    if (actual != Type::kNone) place.type = actual;
  }
  return place;
}

/// An index, rounded as the language rounds REAL (sinumerik-3.5), inside 0..count-1.
std::uint32_t Evaluator::Index(ExprId id, std::uint32_t count, std::string_view name, bool& ok) {
  const double index = ops::Round(Number(id));
  if (index >= 0 && index < count) return static_cast<std::uint32_t>(index);
  ok = false;
  session_.Alarm(ir::AlarmClass::kIndex,
                 fmt::format("index {:.0f} of {} is outside 0 to {}", index, name, count == 0 ? 0 : count - 1));
  return 0;
}

Place Evaluator::ElementPlace(const Expr& expr) {
  const ir::VariableId id{std::size_t{expr.a}};
  const ir::Variable& variable = module_.variables[id];
  Place place = VariablePlace(id);
  if (place.kind == Place::Kind::kNone) return place;
  bool ok = true;
  const std::string_view name = module_.View(variable.name);
  std::uint32_t flat = 0;
  const std::uint32_t dimensions = std::min<std::uint32_t>(variable.dimension_count, expr.count);
  for (std::uint32_t i = 0; i < dimensions; ++i) {
    // An open dimension of a reference parameter is bounded by what was passed.
    const std::uint32_t size = variable.dimensions[i] == 0 ? place.room : variable.dimensions[i];
    flat = flat * size + Index(module_.Item(expr.b + i), size, name, ok);
  }
  if (!ok || flat >= place.room) {
    session_.Alarm(ir::AlarmClass::kIndex, fmt::format("index of {} is outside the array", name));
    place.kind = Place::Kind::kNone;
    return place;
  }
  place.address += flat;
  place.room -= flat;
  if (variable.type == Type::kString && expr.count > variable.dimension_count) {
    const std::uint32_t length = variable.string_length == 0 ? machine_.string_max : variable.string_length;
    place.kind = Place::Kind::kCharacter;
    place.index = Index(module_.Item(expr.b + variable.dimension_count), length, name, ok);
    if (!ok) place.kind = Place::Kind::kNone;
  }
  return place;
}

Place Evaluator::CellPlace(ir::SpaceId id, double number) {
  const ir::Space& space = module_.spaces[id];
  Place place;
  const double rounded = ops::Round(number);
  if (!(rounded >= space.first && rounded <= space.last)) {
    // The number decides what it is: a cell of another space of that name, something of the machine, or nothing.
    for (const ir::SpaceId other : module_.spaces.Ids()) {
      const ir::Space& candidate = module_.spaces[other];
      if (candidate.name == space.name && rounded >= candidate.first && rounded <= candidate.last)
        return CellPlace(other, number);
    }
    for (const ir::NumberedSystem& system : machine_.numbered_systems) {
      if (!(rounded >= system.first && rounded <= system.last)) continue;
      place.kind = Place::Kind::kSystem;
      place.numbered = &system;
      place.number = static_cast<std::uint32_t>(rounded);
      return place;
    }
    if (rounded == 0 && space.type == Type::kNumber) {
      place.kind = Place::Kind::kVacant;
      return place;
    }
    session_.Alarm(ir::AlarmClass::kIndex, fmt::format("{}{:.0f} does not exist", module_.View(space.name), rounded));
    return place;
  }
  const SpaceSlot& slot = session_.linked.SlotOf(id);
  place.kind = Place::Kind::kCell;
  place.type = space.type;
  place.address = (slot.per_level ? facts_.level : 0) + slot.offset + static_cast<std::uint32_t>(rounded) - space.first;
  place.cell_max = machine_.cell_max;
  place.room = space.last - static_cast<std::uint32_t>(rounded) + 1;
  return place;
}

Place Evaluator::PlaceOf(ExprId id) {
  const Expr& expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kVariable:
      return VariablePlace(ir::VariableId{std::size_t{expr.a}});
    case ExprOp::kElement:
      return ElementPlace(expr);
    case ExprOp::kCell:
      return CellPlace(ir::SpaceId{std::size_t{expr.a}}, expr.b);
    case ExprOp::kCellAt:
      return CellPlace(ir::SpaceId{std::size_t{expr.b}}, Number(ExprId{std::size_t{expr.a}}));
    case ExprOp::kGroup:
      return PlaceOf(ExprId{std::size_t{expr.a}});
    case ExprOp::kSystem: {
      Place place;
      place.kind = Place::Kind::kSystem;
      place.expr = id;
      return place;
    }
    case ExprOp::kName:
      session_.Refuse(diag::Code::kUnknownName, module_.View(StringId{std::size_t{expr.a}}));
      return {};
    default:
      session_.Refuse(diag::Code::kReadOnly, ir::NameOf(expr.op));
      return {};
  }
}

Value Evaluator::Load(const Place& place) {
  if (place.kind == Place::Kind::kNone) return ZeroOf(place.type);
  if (place.kind == Place::Kind::kVacant) return Value::Vacant();
  if (place.kind == Place::Kind::kSystem) return place.numbered != nullptr ? ReadNumbered(place) : Eval(place.expr);
  Value& cell = memory_[place.address];
  if (place.kind == Place::Kind::kCharacter) {
    const std::string_view text = texts_.View(cell);
    const std::size_t offset = ops::OffsetOf(text, place.index);
    return Value::Char(offset < text.size() ? ops::CharacterAt(text, offset).code : 0);
  }
  if (!cell.IsVacant()) [[likely]]
    return cell;
  if (place.variable.Valid())
    return place.type == Type::kNumber || place.type == Type::kAny ? cell : ZeroOf(place.type);
  // A cell of a space that holds nothing: never written, or written as vacant.
  if (cell.text == Memory::kWrittenVacant) return Value::Vacant();
  const auto space_at = [&]() -> const ir::Space& {
    for (const ir::SpaceId id : module_.spaces.Ids()) {
      const SpaceSlot& slot = session_.linked.SlotOf(id);
      const ir::Space& space = module_.spaces[id];
      const std::uint32_t base = (slot.per_level ? facts_.level : 0) + slot.offset;
      if (place.address >= base && place.address - base <= space.last - space.first) return space;
    }
    NCPORT_BUG("cell at {} belongs to no space", place.address);
  };
  const ir::Space& space = space_at();
  if (cell.text == Memory::kUntouched && session_.coverage != nullptr && space.visibility != ir::Visibility::kLevel) {
    cell.text = Memory::kReadFirst;
    const auto index = static_cast<std::uint32_t>(&space - module_.spaces.All().data());
    const std::uint32_t number =
        place.address - session_.linked.SlotOf(ir::SpaceId{std::size_t{index}}).offset + space.first;
    session_.coverage->cells_read_before_written.push_back(index << 24U | number);
  }
  switch (space.start) {
    case ir::StartValue::kVacant:
      return Value::Vacant();
    case ir::StartValue::kUnknown:
      session_.Refuse(diag::Code::kUnsetCell, module_.View(space.name));
      return ZeroOf(space.type);
    default:
      return ZeroOf(space.type == Type::kNumber ? Type::kReal : space.type);
  }
}

bool Evaluator::WithinLimits(const ir::Variable& variable, const Value& value) {
  if (!variable.lower_limit.Valid() && !variable.upper_limit.Valid()) return true;
  const bool low = variable.lower_limit.Valid() && value.number < Number(variable.lower_limit);
  const bool high = variable.upper_limit.Valid() && value.number > Number(variable.upper_limit);
  if (!low && !high) return true;
  session_.Alarm(ir::AlarmClass::kRange,
                 fmt::format("value of {} is {} its limit", module_.View(variable.name), low ? "below" : "above"));
  return false;
}

void Evaluator::Store(const Place& place, const Value& value, std::uint32_t offset) {
  if (session_.halted) return;
  switch (place.kind) {
    case Place::Kind::kNone:
      return;
    case Place::Kind::kVacant:
      session_.Alarm(ir::AlarmClass::kIndex, "variable 0 cannot be written");
      return;
    case Place::Kind::kSystem:
      place.numbered != nullptr ? StoreNumbered(place, value) : StoreSystem(place, value);
      return;
    case Place::Kind::kCharacter:
      StoreCharacter(place, value);
      return;
    case Place::Kind::kCell:
      break;
  }
  if (value.IsVacant()) {
    Value vacant;
    vacant.text = Memory::kWrittenVacant;
    memory_[place.address + offset] = vacant;
    return;
  }
  Value converted = Converted(value, place.type, place.string_length);
  if (session_.halted) return;
  if (place.variable.Valid() && !WithinLimits(module_.variables[place.variable], converted)) return;
  if (machine_.numeric_model == ir::NumericModel::kNum8 && converted.type == Type::kReal) {
    const ops::Number stored = ops::Store(converted.number, machine_.numeric_model);
    session_.Alarm(stored.error);
    if (!stored.Ok()) return;
    converted.number = stored.value;
  }
  if (place.cell_max > 0 && std::fabs(converted.number) > place.cell_max) {
    session_.Alarm(ops::Error::kOverflow);
    return;
  }
  memory_[place.address + offset] = converted;
}

/// One character of a text. Code 0 ends the text there (sinumerik-2.5).
void Evaluator::StoreCharacter(const Place& place, const Value& value) {
  double code = value.number;
  if (value.IsText()) {
    const std::string_view text = texts_.View(value);
    if (ops::Length(text) != 1) {
      session_.Alarm(ir::AlarmClass::kConversion, "one character is needed");
      return;
    }
    code = ops::CharacterAt(text, 0).code;
  }
  const std::string_view old = texts_.View(memory_[place.address]);
  const std::size_t offset = ops::OffsetOf(old, place.index);
  if (offset == old.size() && place.index > ops::Length(old)) {
    session_.Alarm(ir::AlarmClass::kIndex, "character behind the end of the text");
    return;
  }
  TextBuffer text;
  text.Append(old.substr(0, offset));
  ops::AppendCharacter(text, code);
  if (code != 0 && offset < old.size()) text.Append(old.substr(offset + ops::CharacterAt(old, offset).bytes));
  memory_[place.address] = NewText(text.View());
}

Value Evaluator::ReferenceTo(ExprId id) {
  const Place place = PlaceOf(id);
  if (place.kind != Place::Kind::kCell) {
    session_.Alarm(ir::AlarmClass::kOther, "a variable is needed as argument by reference");
    return Value::Vacant();
  }
  // A cell that was never written gets its start value now: the callee asks the cell for its type.
  Value& cell = memory_[place.address];
  if (cell.IsVacant() && cell.text != Memory::kWrittenVacant) cell = Load(place);
  return {kReference, place.room, static_cast<double>(place.address)};
}

}  // namespace ncport::exec
