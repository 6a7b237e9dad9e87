// Which statement comes next.
#include <algorithm>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprId;
using ir::WordOp;

void Maker::Statements(std::uint32_t count) {
  frames_.emplace_back();
  const std::size_t depth = frames_.size();
  const auto place_one = [&](std::size_t index) {
    const Pending pending = frames_.back().pending[index];
    frames_.back().pending.erase(frames_.back().pending.begin() + static_cast<std::ptrdiff_t>(index));
    PlaceLabel(pending);
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!frames_.back().pending.empty() && random_.Percent(50)) place_one(0);
    Statement();
    NCPORT_CHECK(frames_.size() == depth, "the frames of labels do not nest");
  }
  while (!frames_.back().pending.empty()) place_one(0);
  frames_.pop_back();
}

bool Maker::Possible(Feature feature) const {
  switch (feature) {
    case Feature::kCall:
    case Feature::kModalCall:
      return !subs_.empty();
    case Feature::kDiameter:
      return TransverseAxis() != 0xFF;
    case Feature::kDrilling:
      return TransverseAxis() == 0xFF;
    case Feature::kHoleCycle:
      return !library_.empty();
    default:
      return true;
  }
}

void Maker::Statement() {
  if (Exhausted()) return MakeCommentLine();
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    const auto feature = static_cast<Feature>(i);
    if (IsStatement(feature) && Possible(feature)) sum += options_.weights.Of(feature);
  }
  NCPORT_CHECK(sum > 0, "all statements have weight 0");
  std::uint32_t draw = random_.Below(sum);
  for (std::size_t i = 0; i < kFeatures; ++i) {
    const auto feature = static_cast<Feature>(i);
    if (!IsStatement(feature) || !Possible(feature)) continue;
    const std::uint32_t weight = options_.weights.Of(feature);
    if (draw < weight) return Make(feature);
    draw -= weight;
  }
}

void Maker::Make(Feature feature) {
  switch (feature) {
    case Feature::kAssign:
      return MakeAssign();
    case Feature::kAssignList:
      return MakeAssignList();
    case Feature::kRapid:
      return MakeRapid();
    case Feature::kLinear:
      return MakeLinear();
    case Feature::kArcCenter:
      return MakeArcCenter();
    case Feature::kArcRadius:
      return MakeArcRadius();
    case Feature::kArcAngle:
      return MakeArcAngle();
    case Feature::kArcVia:
      return MakeArcVia();
    case Feature::kArcTangent:
      return MakeArcTangent();
    case Feature::kPolar:
      return MakePolar();
    case Feature::kThread:
      return MakeThread();
    case Feature::kTap:
      return MakeTap();
    case Feature::kDwell:
      return MakeDwell();
    case Feature::kPlane:
      return MakePlane();
    case Feature::kDistance:
      return MakeDistance();
    case Feature::kUnits:
      return MakeUnits();
    case Feature::kFeedMode:
      return MakeFeedMode();
    case Feature::kSurfaceSpeed:
      return MakeSurfaceSpeed();
    case Feature::kDiameter:
      return MakeDiameter();
    case Feature::kPathMode:
      return MakePathMode();
    case Feature::kWorkOffset:
      return MakeWorkOffset();
    case Feature::kCutterComp:
      return MakeCutterComp();
    case Feature::kSpindle:
      return MakeSpindle();
    case Feature::kSpindlePosition:
      return MakeSpindlePosition();
    case Feature::kTool:
      return MakeTool();
    case Feature::kAux:
      return MakeAux();
    case Feature::kAuxH:
      return MakeAuxH();
    case Feature::kStop:
      return MakeStop();
    case Feature::kMessage:
      return MakeMessage();
    case Feature::kAlarm:
      return MakeAlarm();
    case Feature::kPreprocessStop:
      return MakePreprocessStop();
    case Feature::kInert:
      return MakeInert();
    case Feature::kFrame:
      return MakeFrame();
    case Feature::kChamfer:
      return MakeChamfer();
    case Feature::kMachineCoords:
      return MakeMachineCoords();
    case Feature::kReference:
      return MakeReference();
    case Feature::kCommentLine:
      return MakeCommentLine();
    case Feature::kIf:
      return MakeIf();
    case Feature::kWhile:
      return MakeWhile();
    case Feature::kFor:
      return MakeFor();
    case Feature::kLoop:
      return MakeLoop();
    case Feature::kRepeat:
      return MakeRepeat();
    case Feature::kCase:
      return MakeCase();
    case Feature::kForwardJump:
      return MakeForwardJump();
    case Feature::kBackwardJump:
      return MakeBackwardJump();
    case Feature::kTangle:
      return MakeTangle();
    case Feature::kRepeatPart:
      return MakeRepeatPart();
    case Feature::kCall:
      return MakeCall();
    case Feature::kModalCall:
      return MakeModalCall();
    case Feature::kBlockRange:
      return MakeBlockRange();
    case Feature::kDrilling:
      return MakeDrilling();
    case Feature::kHoleCycle:
      return MakeHoleCycle();
    case Feature::kLocalShift:
      return MakeLocalShift();
    default:
      NCPORT_BUG("{} is no statement", NameOf(feature));
  }
}

// One to three assignments, from left to right.
void Maker::MakeAssign() {
  const std::uint32_t count = random_.Percent(70) ? 1 : 2 + random_.Below(2);
  ir::BlockBuilder block = NewBlock();
  bool any = false;
  for (std::uint32_t i = 0; i < (IsSinumerik() ? count : 1); ++i) {
    const Place* const place = PickWritable();
    if (place == nullptr) break;
    const Place copy = *place;
    const ExprId target = PlaceExpr(copy, 1);
    if (!IsSinumerik() && random_.Percent(20)) Word(block, WordOp::kWhen, Comparison(1));
    const bool rounded = !IsSinumerik() && BoundsOf(copy.range).whole && random_.Percent(30);
    const ExprId value = rounded ? Call(ir::Function::kRound,
                                        {NumberIn({BoundsOf(copy.range).low, BoundsOf(copy.range).high, false}, 2)},
                                        ir::Type::kReal, BoundsOf(copy.range))
                                       .id
                                 : ValueFor(copy.range, copy.type, 3);
    block.Assign(target, value);
    any = true;
  }
  if (!any) block.Comment(CommentText(), ir::CommentPlace::kOwnLine);
  Emit(block, true);
}

// SET or REP into an array: values for elements from one on, some left as they are.
void Maker::MakeAssignList() {
  const Place* array = nullptr;
  std::uint32_t seen = 0;
  for (const Place& place : places_) {
    if (place.is_array && random_.Below(++seen) == 0) array = &place;
  }
  if (array == nullptr) return MakeAssign();
  const Place place = *array;
  const ir::Variable variable = module_.variables[place.variable];
  std::uint32_t elements = 1;
  for (std::uint8_t i = 0; i < variable.dimension_count; ++i) elements *= variable.dimensions[i];
  const std::uint32_t start = random_.Below(elements);
  const auto at = [&](std::uint32_t index) { return expr_.Literal(index, ir::Type::kInt); };
  ir::AssignList list;
  list.place =
      variable.dimension_count == 1
          ? expr_.Element(place.variable, {at(start)})
          : expr_.Element(place.variable, {at(start / variable.dimensions[1]), at(start % variable.dimensions[1])});
  std::vector<ExprId> values;
  list.repeat = random_.Percent(40);
  const std::uint32_t count = 1 + random_.Below(elements - start);
  if (list.repeat) {
    values.push_back(ValueFor(place.range, place.type, 2));
    if (random_.Percent(60)) list.count = expr_.Number(std::to_string(count), ir::Type::kInt);
  } else {
    for (std::uint32_t i = 0; i < count; ++i) {
      values.push_back(i > 0 && i + 1 < count && random_.Percent(20) ? ExprId{} : ValueFor(place.range, place.type, 1));
    }
  }
  list.values.begin = static_cast<std::uint32_t>(module_.expr_items.size());
  list.values.count = static_cast<std::uint32_t>(values.size());
  module_.expr_items.insert(module_.expr_items.end(), values.begin(), values.end());
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kAssignList, {}, 0, module_.assign_lists.Add(list).value);
  Emit(block);
}

}  // namespace ncport::tests::random
