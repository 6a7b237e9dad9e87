// System variables that follow from the program itself; all others are asked from the environment.
#include <cmath>
#include <string>

#include "exec/evaluator.h"
#include "ir/length_units.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::Expr;
using ir::SystemKind;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostIndices = 4;
/// Key of user memory that belongs to a numbered variable, beside those of named ones.
constexpr std::uint32_t kNumberedKey = 0xFFFFFFFEU;

/// Spoken code of a state, as GroupCode::index counts it.
std::uint8_t IndexOf(const ir::ModalState& modal, ir::WordOp op) {
  using ir::WordOp;
  switch (op) {
    case WordOp::kMotion:
      return static_cast<std::uint8_t>(modal.motion);
    case WordOp::kPlane:
      return static_cast<std::uint8_t>(modal.plane);
    case WordOp::kDistance:
      return static_cast<std::uint8_t>(modal.distance);
    case WordOp::kUnits:
      return static_cast<std::uint8_t>(modal.units);
    case WordOp::kFeedMode:
      return static_cast<std::uint8_t>(modal.feed_mode);
    case WordOp::kSpeedMode:
      return static_cast<std::uint8_t>(modal.speed_mode);
    case WordOp::kCutterComp:
      return static_cast<std::uint8_t>(modal.comp);
    case WordOp::kDiameter:
      return static_cast<std::uint8_t>(modal.diameter);
    case WordOp::kPathMode:
      return static_cast<std::uint8_t>(modal.path);
    case WordOp::kReturnLevel:
      return static_cast<std::uint8_t>(modal.return_level);
    default:
      return 0;
  }
}

std::uint64_t UserKey(std::uint32_t system, double index) {
  return std::uint64_t{system} << 32U | (index >= 0 && index <= 4e9 ? static_cast<std::uint32_t>(index) : 0xFFFFFFFFU);
}

}  // namespace

Value Evaluator::ModalGroup(double group) const {
  for (const ir::GroupCode& row : machine_.groups) {
    if (row.group != group) continue;
    if (row.op == ir::WordOp::kWorkOffset) {
      if (!channel_.modal.work_offset.known || row.extra != channel_.modal.work_offset.number) continue;
    } else if (row.op != ir::WordOp::kInert && (row.index == 0 || row.index != IndexOf(channel_.modal, row.op))) {
      continue;  // enumerator 0 of every mode is "unknown"
    }
    return Value::Int(row.code);
  }
  return Value::Vacant();
}

Value Evaluator::EvalSystem(const Expr& expr) {
  const ir::System& system = module_.systems[ir::SystemId{std::size_t{expr.a}}];
  const std::string_view name = module_.View(system.name);
  Value indices[kMostIndices];
  const std::size_t count = expr.count < kMostIndices ? expr.count : kMostIndices;
  for (std::size_t i = 0; i < count; ++i) indices[i] = Eval(module_.Item(expr.b + static_cast<std::uint32_t>(i)));
  if (session_.halted) return ZeroOf(system.type);
  return ReadSystem(system, expr.a, name, indices, count);
}

Value Evaluator::ReadSystem(const ir::System& system, std::uint32_t key, std::string_view name, const Value* indices,
                            std::size_t count) {
  const double first = count > 0 ? ir::ops::Round(indices[0].number) : 0;
  const bool inch_lengths = ir::LengthsAreInches(channel_.modal.units);
  const auto unknown = [&] {
    session_.Refuse(diag::Code::kMachineValue, name);
    return ZeroOf(system.type);
  };
  switch (system.kind) {
    case SystemKind::kPi:
      return Value::Real(kPi);
    case SystemKind::kProgrammedPosition: {
      const auto axis = static_cast<std::uint8_t>(first);
      const bool known = first >= 0 && first < ir::kMaxAxes && (channel_.work_known & AxisBit(axis)) != 0 &&
                         (channel_.uncertain & AxisBit(axis)) == 0;
      if (!known) break;  // perhaps the environment knows where the machine stands
      double position = channel_.work[axis];
      const bool diameter = channel_.modal.diameter == ir::Diameter::kDiameter ||
                            channel_.modal.diameter == ir::Diameter::kDiameterAbsolute;
      if (axis == machine_.transverse_axis && diameter && machine_.position_reads_diameter) position *= 2;
      if (inch_lengths && !ir::IsRotary(axis)) position /= ir::kMmPerInch;
      return Value::Real(position);
    }
    case SystemKind::kActiveFeed: {
      if (!channel_.feed_known) return Value::Real(0);
      const bool inch_feed =
          channel_.modal.units == ir::Units::kInch && channel_.feed_mode != ir::FeedMode::kInverseTime;
      return Value::Real(inch_feed ? channel_.feed / ir::kMmPerInch : channel_.feed);
    }
    case SystemKind::kActiveSpeed: {
      const bool valid = first >= 0 && first < kSpindles;
      const Channel::Spindle& spindle =
          channel_.spindles[valid ? Channel::SpindleByNumber(static_cast<std::uint8_t>(first)) : 0];
      if (!valid || !spindle.speed_known) break;
      return Value::Real(spindle.speed);
    }
    case SystemKind::kActiveTool:
      if (!channel_.tool_known || !channel_.tool_name.empty()) break;
      return Value::Int(channel_.tool_number);
    case SystemKind::kProgrammedTool:
      if (!channel_.prepared_known || !channel_.prepared_name.empty()) break;
      return Value::Int(channel_.prepared_number);
    case SystemKind::kActiveEdge:
      if (!channel_.edge_known) break;
      return Value::Int(channel_.edge);
    case SystemKind::kModalGroup: {
      const Value code = ModalGroup(count > 0 ? first : system.number);
      if (code.IsVacant()) break;
      return code;
    }
    case SystemKind::kModalCallActive:
      return Value::Int(facts_.modal_call ? 1 : 0);
    case SystemKind::kPlaneAxis: {
      if (channel_.modal.plane == ir::Plane::kUnknown) break;
      const PlaneAxes axes = AxesOf(channel_.modal.plane);
      return Value::Axis(system.number == 1 ? axes.first : system.number == 2 ? axes.second : axes.normal);
    }
    case SystemKind::kWasProgrammed:
      return Value::Bool(first >= 1 && first <= 64 && ((facts_.given >> static_cast<unsigned>(first - 1)) & 1U) != 0);
    case SystemKind::kProgramLevel:
      return Value::Int(facts_.depth);
    case SystemKind::kUserMemory: {
      if (count == 0 && system.number != 0) {
        const auto numbered = user_cells_.find(UserKey(kNumberedKey, system.number));
        return numbered != user_cells_.end() ? numbered->second : ZeroOf(system.type);
      }
      const auto cell = user_cells_.find(UserKey(key, first));
      return cell != user_cells_.end() ? cell->second : ZeroOf(system.type);  // cleared at reset
    }
    case SystemKind::kEnvironment:
    case SystemKind::kMachinePosition:
      break;
  }
  const std::optional<Value> answer = session_.environment.Read(system, name, indices, count);
  return answer.has_value() ? *answer : unknown();
}

void Evaluator::StoreSystem(const Place& place, const Value& value) {
  const Expr& expr = module_.exprs[place.expr];
  const ir::SystemId id{std::size_t{expr.a}};
  const ir::System& system = module_.systems[id];
  const std::string_view name = module_.View(system.name);
  Value indices[kMostIndices];
  const std::size_t count = expr.count < kMostIndices ? expr.count : kMostIndices;
  for (std::size_t i = 0; i < count; ++i) indices[i] = Eval(module_.Item(expr.b + static_cast<std::uint32_t>(i)));
  if (session_.halted) return;
  if (system.kind == SystemKind::kUserMemory) {
    constexpr std::size_t kMostCells = 100'000;
    const Value converted = Converted(value, system.type);
    if (count == 0 && system.number != 0) {
      user_cells_[UserKey(kNumberedKey, system.number)] = converted;
      return;
    }
    const double index = count > 0 ? ir::ops::Round(indices[0].number) : 0;
    if (!(index >= 0 && index <= 4e9) || user_cells_.size() >= kMostCells) {
      session_.Alarm(ir::AlarmClass::kIndex, fmt::format("index {:.0f} of {}", index, name));
      return;
    }
    user_cells_[UserKey(id.value, index)] = converted;
    return;
  }
  if (!system.writable) {
    session_.Refuse(diag::Code::kReadOnly, name);
    return;
  }
  if (!session_.environment.Write(system, name, indices, count, value))
    session_.Refuse(diag::Code::kMachineValue, name);
}

namespace {

ir::System SystemOf(const Place& place) {
  ir::System system;
  system.kind = place.numbered->kind;
  system.writable = place.numbered->writable;
  system.number = place.number;
  return system;
}

}  // namespace

Value Evaluator::ReadNumbered(const Place& place) {
  const ir::System system = SystemOf(place);
  const std::string name = fmt::format("#{}", place.number);
  if (!place.numbered->readable) {
    session_.Alarm(ir::AlarmClass::kIndex, fmt::format("{} cannot be read", name));
    return Value::Real(0);
  }
  const std::uint32_t index = place.number - place.numbered->base;
  if (system.kind == SystemKind::kProgrammedPosition || system.kind == SystemKind::kMachinePosition) {
    if (index == 0 || index > machine_.position_axes.size()) {
      session_.Alarm(ir::AlarmClass::kIndex, fmt::format("{}: the machine has no axis {}", name, index));
      return Value::Real(0);
    }
    const Value axis = Value::Axis(machine_.position_axes[index - 1]);
    return ReadSystem(system, kNumberedKey, name, &axis, 1);
  }
  if (system.kind == SystemKind::kModalGroup) {
    const Value group = Value::Int(index);
    return ReadSystem(system, kNumberedKey, name, &group, 1);
  }
  if (system.kind == SystemKind::kUserMemory) {
    const Value number = Value::Int(place.number);
    return ReadSystem(system, kNumberedKey, name, &number, 1);
  }
  return ReadSystem(system, kNumberedKey, name, nullptr, 0);
}

void Evaluator::StoreNumbered(const Place& place, const Value& value) {
  const std::string name = fmt::format("#{}", place.number);
  switch (place.numbered->effect) {
    case ir::WriteEffect::kAlarm: {
      const double number = ir::ops::Round(ToNumber(value));
      session_.Alarm(ir::AlarmClass::kUser, session_.CommentText());
      session_.alarm_code = std::to_string(session_.ShownAlarm(number >= 0 ? static_cast<std::uint32_t>(number) : 0));
      return;
    }
    case ir::WriteEffect::kMessageStop:
      session_.message_stop = true;
      return;
    case ir::WriteEffect::kNone:
      break;
  }
  const ir::System system = SystemOf(place);
  if (system.kind == SystemKind::kUserMemory) {
    user_cells_[UserKey(kNumberedKey, place.number)] = value;
    return;
  }
  if (!system.writable) {
    session_.Alarm(ir::AlarmClass::kIndex, fmt::format("{} cannot be written", name));
    return;
  }
  if (!session_.environment.Write(system, name, nullptr, 0, value)) session_.Refuse(diag::Code::kMachineValue, name);
}

}  // namespace ncport::exec
