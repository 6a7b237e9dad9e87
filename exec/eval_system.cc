// System variables that follow from the program itself; all others are asked from the environment.
#include <cmath>

#include "exec/evaluator.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::Expr;
using ir::SystemKind;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostIndices = 4;

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
  const double first = count > 0 ? ir::ops::Round(indices[0].number) : 0;
  const bool inch_lengths =
      channel_.modal.units == ir::Units::kInch || channel_.modal.units == ir::Units::kInchGeometry;
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
      if (inch_lengths && !ir::IsRotary(axis)) position /= 25.4;
      return Value::Real(position);
    }
    case SystemKind::kActiveFeed: {
      if (!channel_.feed_known) return Value::Real(0);
      const bool inch_feed =
          channel_.modal.units == ir::Units::kInch && channel_.feed_mode != ir::FeedMode::kInverseTime;
      return Value::Real(inch_feed ? channel_.feed / 25.4 : channel_.feed);
    }
    case SystemKind::kActiveSpeed: {
      const bool valid = first >= 0 && first < Channel::kSpindles;
      const Channel::Spindle& spindle = channel_.spindles[valid ? static_cast<std::size_t>(first) : 0];
      if (!valid || !spindle.speed_known) break;
      return Value::Real(spindle.speed);
    }
    case SystemKind::kActiveTool:
      if (!channel_.tool_known || !channel_.tool_name.empty()) break;
      return Value::Int(channel_.tool_number);
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
      const auto cell = user_cells_.find(UserKey(expr.a, first));
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

}  // namespace ncport::exec
