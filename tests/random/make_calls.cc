// Calls: by name and by text, with arguments of all kinds, missing ones, passes; modal calls; block ranges.
#include <fmt/format.h>

#include <algorithm>

#include "dialects/fanuc/words.h"
#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprId;
using ir::Type;

void Maker::MakeFormals(Subprogram& sub) {
  if (!IsSinumerik()) return MakeLetters(sub);
  struct Kind {
    Range range;
    Type type;
  };
  static constexpr Kind kKinds[] = {{Range::kLength, Type::kReal}, {Range::kPositive, Type::kReal},
                                    {Range::kWhole, Type::kInt},   {Range::kTruth, Type::kBool},
                                    {Range::kAngle, Type::kReal},  {Range::kWhole, Type::kReal},
                                    {Range::kFeed, Type::kReal},   {Range::kText, Type::kString},
                                    {Range::kLength, Type::kReal}, {Range::kAxis, Type::kAxis}};
  const std::uint32_t count = random_.Below(5);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Kind kind = random_.Pick(kKinds);
    if (kind.range == Range::kText && !Has(Feature::kTextFunctions)) continue;
    if (kind.range == Range::kAxis && !Has(Feature::kComputedAxis)) continue;
    Formal formal;
    formal.by_reference =
        kind.range != Range::kAxis && kind.range != Range::kText && Draw(Feature::kReferenceParameter);
    formal.place.variable = program_->Parameter(fmt::format("ARG_{}", i + 1), kind.type, formal.by_reference);
    formal.place.type = kind.type;
    formal.place.range = kind.range;
    if (kind.type == Type::kString) module_.variables[formal.place.variable].string_length = 120;
    const Interval bounds = BoundsOf(kind.range);
    formal.may_miss = !formal.by_reference && kind.range != Range::kAxis && bounds.low <= 0 && bounds.high >= 0;
    if (!formal.by_reference && kind.range != Range::kAxis && kind.range != Range::kText &&
        Draw(Feature::kDefaultArgument)) {
      module_.variables[formal.place.variable].initial =
          kind.type == Type::kBool ? expr_.Literal(random_.Below(2), Type::kBool) : As(Literal(bounds), kind.type);
      formal.may_miss = true;
    }
    places_.push_back(formal.place);
    sub.formals.push_back(formal);
  }
}

// Arguments of G65: each letter fills a cell of the macro's level (fanuc-7.3).
void Maker::MakeLetters(Subprogram& sub) {
  if (!sub.has_level) return;
  static constexpr std::string_view kLetters = "ABCDEHQRUVWXYZ";
  static constexpr Range kKinds[] = {Range::kLength, Range::kLength, Range::kPositive, Range::kWhole,
                                     Range::kAngle,  Range::kTruth,  Range::kFeed};
  const std::uint32_t count = random_.Below(5);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    next += 1 + random_.Below(2);
    Formal formal;
    formal.letter = kLetters[next];
    formal.place.space = local_space_;
    formal.place.first = dialects::fanuc::ArgumentCell(formal.letter);
    formal.place.type = module_.spaces[local_space_].type;
    formal.place.range = random_.Pick(kKinds);
    formal.may_miss = Draw(Feature::kMissingArgument);
    places_.push_back(formal.place);
    sub.formals.push_back(formal);
  }
}

// IF[#1EQ#0]THEN#1=5.: the value of an argument that a call leaves out.
void Maker::WriteMissing(const Subprogram& sub) {
  for (const Formal& formal : sub.formals) {
    if (formal.letter == 0 || !formal.may_miss) continue;
    const ExprId cell = expr_.Cell(formal.place.space, formal.place.first);
    ir::BlockBuilder block = NewBlock();
    Word(block, ir::WordOp::kWhen, expr_.Binary(ir::ExprOp::kEqual, cell, expr_.Vacant()));
    block.Assign(expr_.Cell(formal.place.space, formal.place.first), Literal(BoundsOf(formal.place.range)).id);
    Emit(block);
  }
}

void Maker::WriteHeader(const Subprogram& sub) {
  ir::Program& program = module_.programs[sub.id];
  program.saves_modal_state = sub.saves;
  program.has_header = false;
  if (!IsSinumerik()) return;
  program.has_header = !sub.formals.empty() || sub.saves || !IsSinumerik() || random_.Percent(50);
  if (!program.has_header) return;
  ir::BlockBuilder block = program_->Block();
  Word(block, ir::WordOp::kHeader, {}, 0, sub.id.value);
  if (Draw(Feature::kComment)) block.Comment(CommentText());
  block.Finish();
}

void Maker::WriteExterns() {
  if (!IsSinumerik()) return;
  for (const Subprogram& sub : subs_) {
    if (sub.formals.empty() || random_.Percent(60)) continue;
    ir::Extern declaration;
    declaration.name = module_.strings.Intern(sub.name);
    declaration.first_param = static_cast<std::uint32_t>(module_.extern_params.size());
    for (const Formal& formal : sub.formals) {
      ir::ExternParam param;
      param.type = formal.place.type;
      param.by_reference = formal.by_reference;
      param.string_length = module_.variables[formal.place.variable].string_length;
      module_.extern_params.push_back(param);
      ++declaration.param_count;
    }
    ir::BlockBuilder block = NewBlock();
    Word(block, ir::WordOp::kExtern, {}, 0, module_.externs.Add(declaration).value);
    Emit(block);
  }
}

bool Maker::Callable(const Subprogram& sub, std::uint64_t times) const {
  if (cost_ + times_ * times * sub.cost > budget_) return false;
  for (std::uint8_t axis = 0; axis < ir::kLetterAxes; ++axis) {
    if (!MayDrift(axis, static_cast<double>(times) * sub.drift[axis])) return false;
  }
  // What a loop around here relies on must come out as it went in.
  if (!sub.saves && (sub.touched & frozen_) != 0) return false;
  if ((sub.touched & frozen_ & kFeedGroup) != 0) return false;
  for (const auto& formal : sub.formals) {
    if (!formal.by_reference) continue;
    bool found = false;
    for (const Place& place : places_) {
      found = found || (place.writable && place.range == formal.place.range && place.type == formal.place.type);
    }
    if (!found) return false;
  }
  // Groups that the callee relies on and that are frozen at another value here.
  const std::uint32_t needed = known_.Differences(sub.entry) & ~Unknowns(sub.entry);
  return (needed & frozen_) == 0;
}

// Groups of which `known` says nothing.
std::uint32_t Maker::Unknowns(const Knowledge& known) {
  std::uint32_t mask = 0;
  for (std::uint32_t group = 1; group < kAllGroups; group <<= 1U) {
    Knowledge forgotten = known;
    forgotten.Forget(group);
    if (forgotten.Differences(known) == 0) mask |= group;
  }
  return mask;
}

void Maker::AddArguments(const Subprogram& sub, ir::Call& call) {
  std::vector<ir::Arg> args;
  for (std::size_t i = 0; i < sub.formals.size(); ++i) {
    const Formal& formal = sub.formals[i];
    ir::Arg arg;
    arg.position = static_cast<std::uint16_t>(formal.letter == 0 ? i : formal.place.first);
    arg.letter = formal.letter;
    if (formal.by_reference) {
      std::vector<const Place*> fitting;
      for (const Place& place : places_) {
        if (place.writable && place.range == formal.place.range && place.type == formal.place.type)
          fitting.push_back(&place);
      }
      arg.value = PlaceExpr(*random_.PickFrom(fitting), 0);
    } else if (!formal.may_miss || !Draw(Feature::kMissingArgument)) {
      // Arguments convert: a number of another type is given now and then.
      const bool numeric = formal.place.range != Range::kText && formal.place.range != Range::kAxis;
      if (numeric && random_.Percent(40)) {
        arg.value = As(NumberIn(BoundsOf(formal.place.range), 1), formal.place.type);
      } else {
        arg.value = ValueFor(formal.place.range, formal.place.type, 1);
      }
    }
    if (formal.letter == 0 || arg.value.Valid()) args.push_back(arg);
  }
  // Empty places at the end may be left out.
  while (!args.empty() && !args.back().value.Valid() && random_.Percent(70)) args.pop_back();
  call.args.begin = static_cast<std::uint32_t>(module_.args.Size());
  call.args.count = static_cast<std::uint32_t>(args.size());
  for (const ir::Arg& arg : args) module_.args.Add(arg);
  call.has_brackets = !sub.formals.empty() || random_.Percent(20);
}

// Modal words that the callee relies on.
void Maker::MeetEntry(const Subprogram& sub) { WriteModes(sub.entry, true); }

void Maker::AfterCall(const Subprogram& sub, std::uint64_t times) {
  cost_ += times_ * times * sub.cost;
  for (std::uint8_t axis = 0; axis < ir::kLetterAxes; ++axis) {
    drift_[axis] += static_cast<double>(times_ * times) * sub.drift[axis];
  }
  moved_ |= sub.moved;
  Displace(sub.moved);
  const Knowledge before = known_;
  // F stays as the callee left it, also when modal words are put back.
  known_.Forget(sub.touched);
  Knowledge exit = sub.exit;
  exit.Forget(kAllGroups & ~sub.touched);
  if (sub.saves) {
    const bool feed = before.feed && (sub.touched & kFeedGroup) == 0;
    known_ = before;
    known_.feed = feed;
    Touch(sub.touched & kFeedGroup);
    // The work offset of the caller comes back, the position in it does not.
    if ((sub.touched & kOffsetGroup) != 0) Approach(AllAxes());
    return;
  }
  // Groups that the callee left at one value are known again.
  Adopt(exit, sub.touched);
  Touch(sub.touched);
}

void Maker::Adopt(const Knowledge& from, std::uint32_t groups) {
  if ((groups & kMotionGroup) != 0) known_.modes.motion = from.modes.motion;
  if ((groups & kPlaneGroup) != 0) known_.modes.plane = from.modes.plane;
  if ((groups & kDistanceGroup) != 0) known_.modes.distance = from.modes.distance;
  if ((groups & kUnitsGroup) != 0) known_.modes.units = from.modes.units;
  if ((groups & kFeedGroup) != 0) {
    known_.modes.feed_mode = from.modes.feed_mode;
    known_.modes.speed_mode = from.modes.speed_mode;
    known_.feed = from.feed;
  }
  if ((groups & kDiameterGroup) != 0) known_.modes.diameter = from.modes.diameter;
  if ((groups & kFrameGroup) != 0) {
    known_.turned = from.turned;
    known_.frame_clear = from.frame_clear;
  }
  if ((groups & kPathGroup) != 0) known_.modes.path = from.modes.path;
  if ((groups & kOffsetGroup) != 0) known_.modes.work_offset = from.modes.work_offset;
}

void Maker::MakeCall() {
  if (subs_.empty()) return MakeAssign();
  const Subprogram& sub = random_.PickFrom(subs_);
  std::uint64_t times = 1;
  // A second pass starts where the first one ended.
  const bool again = (sub.saves ? (sub.touched & kFeedGroup & ~Unknowns(sub.entry)) == 0
                                : (sub.touched & ~Unknowns(sub.entry) & sub.entry.Differences(sub.exit)) == 0);
  // Modal words that come back take the position along with the work offset.
  const bool lost = sub.saves && (sub.touched & kOffsetGroup) != 0;
  if (again && !lost && Draw(Feature::kPasses)) times = 1 + random_.Below(3);
  if (!Callable(sub, times)) return MakeAssign();
  MeetEntry(sub);
  ir::Call call;
  call.name = module_.strings.Intern(sub.name);
  call.program = sub.id;
  AddArguments(sub, call);
  if (!sub.has_level) call.new_level = random_.Percent(40);
  if (sub.formals.empty() && Draw(Feature::kCallByText)) {
    call.form = ir::CallForm::kText;
    call.has_brackets = false;
    call.name_expr = expr_.Text(sub.name);
    call.name = {};
    call.program = {};
  } else if (times > 1 || (Has(Feature::kPasses) && random_.Percent(5))) {
    call.passes = As(Literal(Interval::Point(static_cast<double>(times))), Type::kInt);
  }
  const std::uint64_t passes = call.passes.Valid() ? times : 1;
  ir::BlockBuilder block = NewBlock();
  Word(block, ir::WordOp::kCall, {}, 0, module_.calls.Add(call).value);
  Emit(block);
  AfterCall(sub, passes);
}

// MCALL SUB(..), a few moves, MCALL.
void Maker::MakeModalCall() {
  std::vector<const Subprogram*> fitting;
  for (const Subprogram& sub : subs_) {
    // It runs behind moves under whatever they have set: it must not rely on more than it leaves.
    const bool neutral = sub.saves ? (sub.touched & kFeedGroup) == 0 : sub.touched == 0;
    if ((sub.touched & kOffsetGroup) == 0 && (neutral || (sub.touched & ~Unknowns(sub.entry)) == 0) && Callable(sub, 3))
      fitting.push_back(&sub);
  }
  if (fitting.empty()) return MakeCall();
  const Subprogram& sub = *random_.PickFrom(fitting);
  MeetEntry(sub);
  ir::Call call;
  call.name = module_.strings.Intern(sub.name);
  call.program = sub.id;
  AddArguments(sub, call);
  ir::BlockBuilder on = NewBlock();
  Word(on, ir::WordOp::kModalCall, {}, 0, module_.calls.Add(call).value);
  Emit(on);
  const std::uint32_t moves = 1 + random_.Below(3);
  for (std::uint32_t i = 0; i < moves; ++i) {
    // The words that a move needs stand in its own block: a block between them may be a run of its own on some
    // controls.
    ir::BlockBuilder move = NewBlock();
    NeedUnits(move);
    SetMotion(move, ir::Motion::kRapid);
    for (const std::uint8_t axis : SomeAxes(false)) AxisWord(move, axis, true, 1);
    Emit(move);
    AfterCall(sub, 1);
  }
  ir::BlockBuilder off = NewBlock();
  Word(off, ir::WordOp::kModalCall, {});
  Emit(off);
}

}  // namespace ncport::tests::random
