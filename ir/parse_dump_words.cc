// Words of dumps and the records they lead to.
#include <algorithm>
#include <iterator>

#include "ir/dump_parser.h"
#include "ir/dump_syntax.h"
#include "ir/word_shape.h"

namespace ncport::ir {

namespace {

constexpr std::uint32_t kMaxNumber = 0xFFFFFFFEU;

template <class IdType>
std::uint32_t Raw(IdType id) {
  return id.value;
}

}  // namespace

bool DumpParser::AtOperandEnd() {
  const char c = scan_.Peek();
  return c == '\0' || c == '=' || c == '{' || c == ';';
}

void DumpParser::WordText() {
  Word word;
  word.op = Value<WordOp>("a word");
  if (scan_.Failed()) return;
  word.phase = DefaultPhaseOf(word.op);
  word.index = Index(word.op);
  if (HasInlineMode(word.op)) {
    if (const auto mode = FromName<ValueMode>(scan_.PeekKeyword()); mode && !AtOperandEnd()) {
      scan_.Keyword();
      word.mode = *mode;
    }
  }
  word.extra = Extra(word.op);
  if (scan_.Take("=")) word.value = ExprText();
  Attributes(word);
  module_.words.Add(word);
}

std::uint8_t DumpParser::Index(WordOp op) {
  const auto raw = [](auto value) { return static_cast<std::uint8_t>(value); };
  switch (ShapeOf(op).index) {
    case IndexKind::kNone:
      return 0;
    case IndexKind::kMotion:
      return raw(Value<Motion>("a motion"));
    case IndexKind::kPlane:
      return raw(Value<Plane>("a plane"));
    case IndexKind::kDistance:
      return raw(Value<Distance>("absolute or incremental"));
    case IndexKind::kUnits:
      return raw(Value<Units>("a unit"));
    case IndexKind::kFeedMode:
      return raw(Value<FeedMode>("a feed mode"));
    case IndexKind::kSpeedMode:
      return raw(Value<SpeedMode>("a speed mode"));
    case IndexKind::kCutterComp:
      return raw(Value<CutterComp>("a compensation"));
    case IndexKind::kDiameter:
      return raw(Value<Diameter>("a diameter mode"));
    case IndexKind::kPathMode:
      return raw(Value<PathMode>("a path mode"));
    case IndexKind::kReturnLevel:
      return raw(Value<ReturnLevel>("a return level"));
    case IndexKind::kChamfer:
      return raw(Value<ChamferKind>("a kind of chamfer"));
    case IndexKind::kReference:
      return raw(Value<ReferenceKind>("a kind of reference"));
    case IndexKind::kPole:
      return raw(Value<PoleBase>("a base of the pole"));
    case IndexKind::kFrame:
      return raw(Value<FrameOp>("a frame operation"));
    case IndexKind::kAlarm:
      return raw(Value<AlarmKind>("a kind of alarm"));
    case IndexKind::kCycle:
      return raw(Value<Cycle>("a cycle"));
    case IndexKind::kCycleField:
      return raw(Value<CycleField>("a word of a cycle"));
    case IndexKind::kReturn:
      return raw(Value<ReturnKind>("a kind of return"));
    case IndexKind::kAxis:
      return AxisRef();
    case IndexKind::kCoordinate: {
      const std::string_view name = scan_.Name();
      const std::size_t index = std::string_view("IJK").find(name);
      if (name.size() == 1 && index != std::string_view::npos) return static_cast<std::uint8_t>(index);
      scan_.Fail("I, J or K");
      return 0;
    }
    case IndexKind::kMark: {
      if (!scan_.TakeKeyword("mark")) return 0;
      const auto mark = Value<WordOp>("a structure mark");
      if (!IsStructureMark(mark)) scan_.Fail("a structure mark");
      return raw(mark);
    }
    case IndexKind::kNumber: {
      const char c = scan_.Peek();
      return c >= '0' && c <= '9' ? static_cast<std::uint8_t>(scan_.Number(255)) : std::uint8_t{0};
    }
  }
  return 0;
}

std::uint32_t DumpParser::Extra(WordOp op) {
  const WordShape shape = ShapeOf(op);
  if (shape.extra == ExtraKind::kNone || scan_.Failed()) return Id<void>::kNone;
  if (AtOperandEnd()) {
    if (!shape.extra_may_be_missing) scan_.Fail("an operand");
    return Id<void>::kNone;
  }
  if (!IsNumberAhead() && scan_.Take("-")) return Id<void>::kNone;
  switch (shape.extra) {
    case ExtraKind::kNone:
      break;
    case ExtraKind::kNumber:
      scan_.Need("#");
      return scan_.Number(kMaxNumber);
    case ExtraKind::kSpindleState:
      return static_cast<std::uint32_t>(Value<SpindleState>("a spindle state"));
    case ExtraKind::kExpr:
      return Raw(ExprText());
    case ExtraKind::kVariable:
      return Raw(VariableRef());
    case ExtraKind::kProgram:
      return Raw(ProgramRef());
    case ExtraKind::kExtern:
      return Raw(ExternText());
    case ExtraKind::kAssignList:
      return Raw(AssignListText());
    case ExtraKind::kJump:
      return Raw(JumpText());
    case ExtraKind::kSwitch:
      return Raw(SwitchText());
    case ExtraKind::kCall:
      return Raw(CallText());
    case ExtraKind::kPart:
      return Raw(PartText());
    case ExtraKind::kFor:
      return Raw(ForText());
    case ExtraKind::kString:
      return Raw(module_.strings.Intern(scan_.Text()));
  }
  return Id<void>::kNone;
}

void DumpParser::Attributes(Word& word) {
  if (!scan_.Take("{")) return;
  while (!scan_.Failed() && !scan_.Take("}")) {
    const std::string_view name = scan_.PeekKeyword();
    if (name == "as") {
      scan_.Keyword();
      const auto spelling = Ref(spellings_);
      word.spelling = spelling.Valid() ? static_cast<std::uint16_t>(spelling.value) : std::uint16_t{0};
    } else if (name == "digits") {
      scan_.Keyword();
      word.digits = static_cast<std::uint8_t>(scan_.Number(255));
    } else if (name == "mode") {
      scan_.Keyword();
      word.mode = Value<ValueMode>("a value mode");
    } else if (name == "phase") {
      scan_.Keyword();
      word.phase = Value<Phase>("a phase");
    } else if (name == "at") {
      scan_.Keyword();
      word.begin = scan_.Number(kMaxNumber);
      scan_.Need("+");
      word.length = scan_.Number(kMaxNumber);
    } else {
      const auto* const flag = std::ranges::find(kWordFlagNames, name);
      if (flag == std::end(kWordFlagNames)) return scan_.Fail("an attribute");
      scan_.Keyword();
      word.flags |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(flag - std::begin(kWordFlagNames)));
    }
  }
}

Target DumpParser::TargetText() {
  Target target;
  target.kind = Value<TargetKind>("a kind of target");
  if (target.kind == TargetKind::kLabel) target.label = Name();
  if (target.kind == TargetKind::kNumber || target.kind == TargetKind::kMainNumber) {
    target.number = scan_.Number(0xFFFFFFFFU);
  }
  if (target.kind == TargetKind::kExpression) target.expr = MaybeExpr();
  while (!scan_.Failed() && scan_.Take("+")) {
    if (scan_.TakeKeyword("label")) {
      target.label = NeedName();
    } else if (scan_.TakeKeyword("number")) {
      target.number = scan_.Number(0xFFFFFFFFU);
    } else if (scan_.TakeKeyword("expr")) {
      target.expr = ExprText();
    } else {
      scan_.Fail("label, number or expr");
    }
  }
  return target;
}

JumpId DumpParser::JumpText() {
  if (scan_.Take("-")) return {};
  Jump jump;
  jump.search = Value<Search>("a search");
  jump.target = TargetText();
  jump.quiet = scan_.TakeKeyword("quiet");
  return module_.jumps.Add(jump);
}

SwitchId DumpParser::SwitchText() {
  std::vector<SwitchArm> arms;
  scan_.Need("(");
  if (!scan_.Take(")")) {
    do {
      SwitchArm arm;
      arm.value = MaybeExpr();
      scan_.Need("=>");
      arm.jump = JumpText();
      arms.push_back(arm);
    } while (!scan_.Failed() && scan_.Take(","));
    scan_.Need(")");
  }
  const Switch record{static_cast<std::uint32_t>(module_.switch_arms.size()), static_cast<std::uint32_t>(arms.size())};
  module_.switch_arms.insert(module_.switch_arms.end(), arms.begin(), arms.end());
  return module_.switches.Add(record);
}

CallId DumpParser::CallText() {
  Call call;
  call.form = Value<CallForm>("a form of call");
  call.name = Name();
  call.has_brackets = scan_.TakeKeyword("brackets");
  call.new_level = !scan_.TakeKeyword("same-level");
  call.from_block = scan_.TakeKeyword("from-block");
  if (scan_.TakeKeyword("calls")) call.program = ProgramRef();
  call.name_expr = Optional("by");
  call.args.begin = static_cast<std::uint32_t>(module_.args.Size());
  if (scan_.Take("(")) {
    do {
      Arg arg;
      arg.position = static_cast<std::uint16_t>(scan_.Number(0xFFFF));
      if (scan_.AtName()) {
        const std::string_view letter = scan_.Name();
        if (letter.size() != 1) scan_.Fail("a letter");
        if (!letter.empty()) arg.letter = letter.front();
      }
      arg.increments = scan_.TakeKeyword("increments");
      scan_.Need(":");
      arg.value = MaybeExpr();
      module_.args.Add(arg);
    } while (!scan_.Failed() && scan_.Take(","));
    scan_.Need(")");
  }
  call.args.count = static_cast<std::uint32_t>(module_.args.Size()) - call.args.begin;
  call.passes = Optional("passes");
  if (scan_.TakeKeyword("from")) call.from = TargetText();
  if (scan_.TakeKeyword("to")) call.to = TargetText();
  return module_.calls.Add(call);
}

PartId DumpParser::PartText() {
  Part part;
  if (!scan_.TakeKeyword("first")) scan_.Fail("first");
  part.first = TargetText();
  part.has_last = scan_.TakeKeyword("last");
  if (part.has_last || scan_.TakeKeyword("or-end")) part.last = TargetText();
  part.single = scan_.TakeKeyword("single");
  return module_.parts.Add(part);
}

ForId DumpParser::ForText() {
  For loop;
  loop.variable = MaybeExpr();
  if (!scan_.TakeKeyword("to")) scan_.Fail("to");
  loop.end = MaybeExpr();
  loop.step = Optional("step");
  return module_.fors.Add(loop);
}

void DumpParser::Shape(std::uint8_t& dimension_count, std::uint32_t (&dimensions)[3], std::uint32_t& string_length) {
  if (scan_.TakeKeyword("length")) string_length = scan_.Number(0xFFFFFFFFU);
  if (!scan_.TakeKeyword("dims")) return;
  for (char c = scan_.Peek(); c >= '0' && c <= '9'; c = scan_.Peek()) {
    if (dimension_count == 3) return scan_.Fail("at most three dimensions");
    dimensions[dimension_count++] = scan_.Number(0xFFFFFFFFU);
  }
}

ExternId DumpParser::ExternText() {
  Extern record;
  record.name = Name();
  record.first_param = static_cast<std::uint32_t>(module_.extern_params.size());
  scan_.Need("(");
  if (!scan_.Take(")")) {
    do {
      ExternParam param;
      param.type = Value<Type>("a type");
      param.by_reference = scan_.TakeKeyword("ref");
      Shape(param.dimension_count, param.dimensions, param.string_length);
      module_.extern_params.push_back(param);
      ++record.param_count;
    } while (!scan_.Failed() && scan_.Take(","));
    scan_.Need(")");
  }
  return module_.externs.Add(record);
}

AssignListId DumpParser::AssignListText() {
  AssignList list;
  list.place = Optional("place");
  std::vector<ExprId> items;
  scan_.Need("(");
  if (!scan_.Take(")")) {
    do {
      items.push_back(MaybeExpr());
    } while (!scan_.Failed() && scan_.Take(","));
    scan_.Need(")");
  }
  list.values = AddItems(items);
  list.repeat = scan_.TakeKeyword("repeat");
  list.count = Optional("count");
  return module_.assign_lists.Add(list);
}

}  // namespace ncport::ir
