// The words of a block with their values, before anything but assignments and messages takes effect.
#include <algorithm>

#include "exec/runner.h"
#include "ir/length_units.h"
#include "ir/ops/arithmetic.h"

namespace ncport::exec {

using ir::Phase;
using ir::Word;
using ir::WordId;
using ir::WordOp;

/// Values of all words in source order. Assignments and messages act at once.
void Runner::Gather(const ir::Block& block) {
  const ir::Module& module = session_.module;
  for (std::uint32_t index = block.words.begin; index < words_end_; ++index) {
    const Word& word = module.words[WordId{std::size_t{index}}];
    if (word.phase == Phase::kFlow || word.phase == Phase::kLast) continue;
    session_.word = &word;
    // Made where it stays: a value that is put together from its fields and then copied makes the processor wait.
    Value& value = values_[index - block.words.begin];
    value.type = ir::Type::kNone;
    value.text = 0;
    value.number = 0;
    if (word.value.Valid()) {
      const ir::Expr& expr = module.exprs[word.value];
      if (expr.op == ir::ExprOp::kLiteral) {
        value.type = Evaluator::LiteralType(expr);
        value.number = expr.number;
      } else {
        value = evaluator_.Eval(word.value);
      }
      if (session_.halted) return;
      if (value.IsVacant() && (word.flags & Word::kVanishesVacant) != 0) continue;
    }
    switch (word.op) {
      case WordOp::kAssign:
        Assign(word, value);
        break;
      case WordOp::kAssignList:
        AssignList(word.Extra<ir::AssignListId>());
        break;
      case WordOp::kDefine:
        Define(word.Extra<ir::VariableId>());
        break;
      case WordOp::kMessage:
      case WordOp::kPrint:
      case WordOp::kAlarm:
        auxiliary_.Message(word, value);
        break;
      case WordOp::kWhen: {
        const bool holds = evaluator_.ToTruth(value);
        Branch(holds);
        if (!holds) words_end_ = index;
        break;
      }
      case WordOp::kSkipRest:
        if (((session_.options.skip_levels >> word.index) & 1U) != 0) words_end_ = index;
        break;
      case WordOp::kComputedG:
        GatherComputed(word, evaluator_.ToNumber(value), session_.machine.g_codes);
        break;
      case WordOp::kComputedM:
        GatherComputed(word, evaluator_.ToNumber(value), session_.machine.m_codes);
        break;
      case WordOp::kDataSetting:
        DataSetting(word.Extra<ir::CallId>());
        break;
      case WordOp::kVerbatim:
        session_.Refuse(diag::Code::kRefusedBlock);
        break;
      default:
        Collect(word, value);
        break;
    }
    if (session_.halted) return;
  }
}

/// A code whose number was computed means what the table of the machine says.
void Runner::GatherComputed(const Word& word, double code, const std::vector<ir::CodeMeaning>& codes) {
  const double tenths = ir::ops::Round(code * 10);
  const auto found = std::ranges::find_if(codes, [&](const ir::CodeMeaning& row) { return row.tenths == tenths; });
  if (found == codes.end()) {
    if (word.op == WordOp::kComputedM && code >= 0) {  // an M function of the machine builder
      Word aux = word;
      aux.op = WordOp::kAux;
      aux.phase = Phase::kBefore;
      computed_.push_back(aux);
      return;
    }
    return session_.Alarm(ir::AlarmClass::kUnknownCode, fmt::format("code {:g} is not known", code));
  }
  if (found->op == WordOp::kVerbatim)
    return session_.Refuse(diag::Code::kCannotRun, fmt::format("code {:g} by a computed number", code));
  Word made = word;
  made.op = found->op;
  made.index = found->index;
  made.extra = found->extra;
  made.phase = found->phase;
  Collect(made, Value::Vacant());
  computed_.push_back(made);
}

void Runner::Collect(const Word& word, const Value& value) {
  const auto number = [&] { return evaluator_.ToNumber(value); };
  const auto put = [&](double& place, std::uint32_t bit) {
    place = number();
    work_.has |= bit;
    if ((word.flags & Word::kIncrements) != 0) work_.scaled |= bit;
    if ((word.flags & Word::kRoundsValue) != 0) work_.rounded_words |= bit;
  };
  switch (word.op) {
    case WordOp::kAxis:
    case WordOp::kAxisComputed: {
      std::uint8_t axis = word.index;
      if (word.op == WordOp::kAxisComputed) {
        const Value chosen = evaluator_.Eval(word.Extra<ir::ExprId>());
        if (chosen.type != ir::Type::kAxis) return session_.Alarm(ir::AlarmClass::kConversion, "no axis");
        axis = static_cast<std::uint8_t>(chosen.number);
      }
      const std::uint16_t bit = AxisBit(axis);
      if ((session_.machine.axes & bit) == 0 && axis < ir::kLetterAxes) {
        return session_.Alarm(ir::AlarmClass::kOther, fmt::format("axis {} does not exist", evaluator_.AxisName(axis)));
      }
      if ((work_.axes & bit) != 0)
        return session_.Alarm(ir::AlarmClass::kSyntax,
                              fmt::format("axis {} twice in one block", evaluator_.AxisName(axis)));
      work_.axes |= bit;
      work_.axis[axis] = number();
      work_.axis_mode[axis] = word.mode;
      if ((word.flags & Word::kRoundsValue) != 0) work_.rounded |= bit;
      if ((word.flags & Word::kIncrements) != 0) work_.scaled_axes |= bit;
      return;
    }
    case WordOp::kCenter:
      work_.centers |= static_cast<std::uint8_t>(1U << word.index);
      work_.center[word.index] = number();
      work_.center_mode[word.index] = word.mode;
      work_.center_written[word.index] = work_.center[word.index];
      if ((word.flags & Word::kIncrements) != 0) work_.scaled_centers |= static_cast<std::uint8_t>(1U << word.index);
      if ((word.flags & Word::kRoundsValue) != 0) work_.rounded_centers |= static_cast<std::uint8_t>(1U << word.index);
      return;
    case WordOp::kVia:
      work_.vias |= static_cast<std::uint8_t>(1U << word.index);
      work_.via[word.index] = number();
      work_.via_mode[word.index] = word.mode;
      return;
    case WordOp::kRadius:
      return put(work_.radius, BlockWork::kRadius);
    case WordOp::kOpeningAngle:
      return put(work_.opening, BlockWork::kOpening);
    case WordOp::kTurns:
      return put(work_.turns, BlockWork::kTurns);
    case WordOp::kPolarRadius:
      return put(work_.polar_radius, BlockWork::kPolarRadius);
    case WordOp::kPolarAngle:
      work_.polar_angle_mode = word.mode;
      return put(work_.polar_angle, BlockWork::kPolarAngle);
    case WordOp::kChamfer: {
      const auto kind = static_cast<ir::ChamferKind>(word.index);
      if (kind == ir::ChamferKind::kRoundModal) return put(work_.round_modal, BlockWork::kRoundModal);
      work_.chamfer_kind = kind;
      return put(work_.chamfer, BlockWork::kChamfer);
    }
    case WordOp::kContourAngle:
      return put(work_.contour_angle, BlockWork::kContourAngle);
    case WordOp::kStartAngle:
      return put(work_.start_angle, BlockWork::kStartAngle);
    case WordOp::kFeed:
      return put(work_.feed, BlockWork::kFeed);
    case WordOp::kFeedOnce:
      return put(work_.feed_once, BlockWork::kFeedOnce);
    case WordOp::kFrameAngle:
      return put(work_.frame_angle, BlockWork::kFrameAngle);
    case WordOp::kDwellSeconds:
    case WordOp::kDwellRevolutions:
      work_.dwell_revolutions = word.op == WordOp::kDwellRevolutions;
      return put(work_.dwell, BlockWork::kDwell);
    case WordOp::kCycleValue: {
      const std::uint32_t bit = 1U << word.index;
      work_.cycle_fields |= bit;
      work_.cycle_value[word.index] = number();
      if ((word.flags & Word::kIncrements) != 0) work_.cycle_scaled |= bit;
      if ((word.flags & Word::kRoundsValue) != 0 && ir::IsLength(static_cast<ir::CycleField>(word.index)))
        work_.cycle_rounded |= bit;
      return;
    }
    case WordOp::kFrameFactor: {
      const auto bit = static_cast<std::uint8_t>(1U << word.index);
      work_.factors |= bit;
      work_.factor[word.index] = number();
      if ((word.flags & Word::kIncrements) != 0) work_.scaled_factors |= bit;
      return;
    }
    case WordOp::kMachineCoords:
      work_.has |= BlockWork::kMachineCoords;
      return;
    case WordOp::kExactOnce:
      work_.has |= BlockWork::kExactOnce;
      return;
    case WordOp::kPresetPosition:
      work_.has |= BlockWork::kPreset;
      return;
    case WordOp::kReference:
      work_.reference = static_cast<ir::ReferenceKind>(word.index);
      work_.has |= BlockWork::kReference;
      return;
    case WordOp::kInert:
      // Beside a reference move a value numbers the point (FP, P of G30); elsewhere nobody asks for it.
      if (word.value.Valid() && !value.IsText()) put(work_.point, BlockWork::kPoint);
      return;
    case WordOp::kPole:
      work_.pole = static_cast<ir::PoleBase>(word.index);
      work_.has |= BlockWork::kPole;
      return;
    case WordOp::kFrame:
      return CollectFrame(static_cast<ir::FrameOp>(word.index));
    case WordOp::kSpeed:
      work_.has |= BlockWork::kSpeed;
      return;
    case WordOp::kSpeedLimit:
      work_.has |= BlockWork::kSpeedLimit;
      return;
    case WordOp::kFeedMode:
      work_.has |= BlockWork::kFeedMode;
      return;
    case WordOp::kEdge:
      work_.has |= BlockWork::kEdge;
      return;
    default:
      return;
  }
}

/// Each group of a block acts (fanuc-8.1): what ends a layer stands beside the one operation that has values.
void Runner::CollectFrame(ir::FrameOp op) {
  switch (op) {
    case ir::FrameOp::kRotateEnd:
      work_.has |= BlockWork::kRotateEnd;
      return;
    case ir::FrameOp::kScaleEnd:
      work_.has |= BlockWork::kScaleEnd;
      return;
    case ir::FrameOp::kMirrorEnd:
      work_.has |= BlockWork::kMirrorEnd;
      return;
    default:
      if (work_.Has(BlockWork::kFrame))
        return session_.Refuse(diag::Code::kCannotRun, "two frame words with values in one block");
      work_.frame = op;
      work_.has |= BlockWork::kFrame;
      return;
  }
}

}  // namespace ncport::exec
