// Words of dumps and the records they lead to.
#include "ir/dump_syntax.h"
#include "ir/dump_writer.h"
#include "ir/word_shape.h"

namespace ncport::ir {

namespace {

// Values of modal groups and kinds by the name of their list; empty: not in the list, or no list.
std::string_view IndexName(IndexKind kind, std::uint8_t index) {
  switch (kind) {
    case IndexKind::kMotion:
      return NameOf(static_cast<Motion>(index));
    case IndexKind::kPlane:
      return NameOf(static_cast<Plane>(index));
    case IndexKind::kDistance:
      return NameOf(static_cast<Distance>(index));
    case IndexKind::kUnits:
      return NameOf(static_cast<Units>(index));
    case IndexKind::kFeedMode:
      return NameOf(static_cast<FeedMode>(index));
    case IndexKind::kSpeedMode:
      return NameOf(static_cast<SpeedMode>(index));
    case IndexKind::kCutterComp:
      return NameOf(static_cast<CutterComp>(index));
    case IndexKind::kDiameter:
      return NameOf(static_cast<Diameter>(index));
    case IndexKind::kPathMode:
      return NameOf(static_cast<PathMode>(index));
    case IndexKind::kReturnLevel:
      return NameOf(static_cast<ReturnLevel>(index));
    case IndexKind::kChamfer:
      return NameOf(static_cast<ChamferKind>(index));
    case IndexKind::kReference:
      return NameOf(static_cast<ReferenceKind>(index));
    case IndexKind::kPole:
      return NameOf(static_cast<PoleBase>(index));
    case IndexKind::kFrame:
      return NameOf(static_cast<FrameOp>(index));
    case IndexKind::kAlarm:
      return NameOf(static_cast<AlarmKind>(index));
    case IndexKind::kCycle:
      return NameOf(static_cast<Cycle>(index));
    case IndexKind::kCycleField:
      return NameOf(static_cast<CycleField>(index));
    case IndexKind::kReturn:
      return NameOf(static_cast<ReturnKind>(index));
    case IndexKind::kMark:
      return IsStructureMark(static_cast<WordOp>(index)) ? NameOf(static_cast<WordOp>(index)) : std::string_view{};
    case IndexKind::kCoordinate:
      return index < 3 ? std::string_view("IJK").substr(index, 1) : std::string_view{};
    case IndexKind::kNone:
    case IndexKind::kAxis:
    case IndexKind::kNumber:
      break;
  }
  return {};
}

}  // namespace

void DumpWriter::Word(const ir::Word& word) {
  Known(word.op);
  Index(word);
  if (word.mode != ValueMode::kModal && HasInlineMode(word.op)) {
    Put(' ');
    Known(word.mode);
  }
  Extra(word);
  Optional(" = ", word.value);
  Attributes(word);
}

void DumpWriter::Index(const ir::Word& word) {
  const IndexKind kind = ShapeOf(word.op).index;
  switch (kind) {
    case IndexKind::kNone:
      if (word.index == 0) return;
      break;
    case IndexKind::kMark:
      if (word.index == 0) return;
      Put(" mark");
      break;
    case IndexKind::kAxis:
      Put(' ');
      return AxisRef(word.index);
    case IndexKind::kNumber:
      if (word.index == 0) return;
      Put(' ');
      return Number(word.index);
    default:
      break;
  }
  Put(' ');
  const std::string_view name = IndexName(kind, word.index);
  name.empty() ? Unknown(word.index) : Put(name);
}

void DumpWriter::Extra(const ir::Word& word) {
  const WordShape shape = ShapeOf(word.op);
  const bool missing = word.extra == Id<void>::kNone;
  if (missing && (shape.extra == ExtraKind::kNone || shape.extra_may_be_missing)) return;
  Put(' ');
  if (missing) return Put('-');
  switch (shape.extra) {
    case ExtraKind::kNone:
      return Unknown(word.extra);
    case ExtraKind::kNumber:
      Put('#');  // tells it from the index
      return Number(word.extra);
    case ExtraKind::kSpindleState:
      return word.extra < 256 ? Known(static_cast<SpindleState>(word.extra)) : Unknown(word.extra);
    case ExtraKind::kExpr:
      return Expr(word.Extra<ExprId>());
    case ExtraKind::kVariable:
      return VariableRef(word.Extra<VariableId>());
    case ExtraKind::kProgram:
      return ProgramRef(word.Extra<ProgramId>());
    case ExtraKind::kExtern:
      return Extern(word.Extra<ExternId>());
    case ExtraKind::kAssignList:
      return AssignList(word.Extra<AssignListId>());
    case ExtraKind::kJump:
      return Jump(word.Extra<JumpId>());
    case ExtraKind::kSwitch:
      return Switch(word.Extra<SwitchId>());
    case ExtraKind::kCall:
      return Call(word.Extra<CallId>());
    case ExtraKind::kPart:
      return Part(word.Extra<PartId>());
    case ExtraKind::kFor: {
      const ForId id = word.Extra<ForId>();
      if (!module_.fors.Contains(id)) return Unknown(id.value);
      const For& loop = module_.fors[id];
      Expr(loop.variable);
      Put(" to ");
      Expr(loop.end);
      return Optional(" step ", loop.step);
    }
    case ExtraKind::kString:
      return word.extra < module_.strings.Size() ? Quoted(module_.strings.View(word.Extra<StringId>()))
                                                 : Unknown(word.extra);
  }
}

void DumpWriter::Attributes(const ir::Word& word) {
  bool any = false;
  const auto attribute = [&](std::string_view name) {
    Put(any ? " " : " {");
    any = true;
    Put(name);
  };
  if (options_.spellings && word.spelling != 0) {
    attribute("as ");
    if (word.spelling < module_.spellings.size()) {
      Name(module_.spellings[word.spelling].text);
      Ordinal(spellings_.Of(Id<Spelling>{std::size_t{word.spelling}}));
    } else {
      Unknown(word.spelling);
    }
  }
  if (options_.spellings && word.digits != 0) {
    attribute("digits ");
    Number(word.digits);
  }
  if (word.mode != ValueMode::kModal && !HasInlineMode(word.op)) {
    attribute("mode ");
    Known(word.mode);
  }
  if (word.phase != DefaultPhaseOf(word.op)) {
    attribute("phase ");
    Known(word.phase);
  }
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((word.flags >> bit & 1U) == 0) continue;
    bit < std::size(kWordFlagNames) ? attribute(kWordFlagNames[bit]) : (attribute(""), Unknown(bit));
  }
  if (options_.places && (word.begin != 0 || word.length != 0)) {
    attribute("at ");
    Number(word.begin);
    Put('+');
    Number(word.length);
  }
  if (any) Put('}');
}

void DumpWriter::Target(const ir::Target& target) {
  Known(target.kind);
  const bool label = target.kind == TargetKind::kLabel;
  const bool number = target.kind == TargetKind::kNumber || target.kind == TargetKind::kMainNumber;
  const bool expression = target.kind == TargetKind::kExpression;
  if (label) Put(' '), Name(target.label);
  if (number) Put(' '), Number(target.number);
  if (expression) Put(' '), Expr(target.expr);
  // What a frontend kept besides.
  if (!label && target.label.Valid()) Put(" +label "), Name(target.label);
  if (!number && target.number != 0) Put(" +number "), Number(target.number);
  if (!expression) Optional(" +expr ", target.expr);
}

void DumpWriter::Jump(JumpId id) {
  if (!id.Valid()) return Put('-');
  if (!module_.jumps.Contains(id)) return Unknown(id.value);
  const ir::Jump& jump = module_.jumps[id];
  Known(jump.search);
  Put(' ');
  Target(jump.target);
  if (jump.quiet) Put(" quiet");
}

void DumpWriter::Switch(SwitchId id) {
  if (!module_.switches.Contains(id)) return Unknown(id.value);
  const ir::Switch& record = module_.switches[id];
  Put('(');
  for (std::uint32_t i = 0; i < record.arm_count; ++i) {
    if (i != 0) Put(", ");
    const std::uint64_t arm = std::uint64_t{record.first_arm} + i;
    if (arm >= module_.switch_arms.size()) {
      Unknown(arm);
      break;
    }
    Expr(module_.switch_arms[arm].value);
    Put(" => ");
    Jump(module_.switch_arms[arm].jump);
  }
  Put(')');
}

void DumpWriter::Call(CallId id) {
  if (!module_.calls.Contains(id)) return Unknown(id.value);
  const ir::Call& call = module_.calls[id];
  Known(call.form);
  Put(' ');
  Name(call.name);
  if (call.has_brackets) Put(" brackets");
  if (!call.new_level) Put(" same-level");
  if (call.from_block) Put(" from-block");
  if (call.program.Valid()) Put(" calls "), ProgramRef(call.program);
  Optional(" by ", call.name_expr);
  if (!call.args.Empty()) {
    Put(" (");
    for (std::uint32_t i = 0; i < call.args.count; ++i) {
      if (i != 0) Put(", ");
      if (std::uint64_t{call.args.begin} + i >= module_.args.Size()) {
        Unknown(std::uint64_t{call.args.begin} + i);
        break;
      }
      const Arg& arg = module_.args[call.args[i]];
      Number(arg.position);
      if (arg.letter != 0) Put(' '), BareOrQuoted(std::string_view{&arg.letter, 1});
      if (arg.increments) Put(" increments");
      Put(": ");
      Expr(arg.value);
    }
    Put(')');
  }
  Optional(" passes ", call.passes);
  const auto is_set = [](const ir::Target& target) {
    return target.kind != TargetKind::kLabel || target.label.Valid() || target.number != 0 || target.expr.Valid();
  };
  if (is_set(call.from)) Put(" from "), Target(call.from);
  if (is_set(call.to)) Put(" to "), Target(call.to);
}

void DumpWriter::Part(PartId id) {
  if (!module_.parts.Contains(id)) return Unknown(id.value);
  const ir::Part& part = module_.parts[id];
  Put("first ");
  Target(part.first);
  if (part.has_last || part.last.kind != TargetKind::kLabel || part.last.label.Valid() || part.last.number != 0 ||
      part.last.expr.Valid()) {
    Put(part.has_last ? " last " : " or-end ");
    Target(part.last);
  }
  if (part.single) Put(" single");
}

void DumpWriter::Extern(ExternId id) {
  if (!module_.externs.Contains(id)) return Unknown(id.value);
  const ir::Extern& record = module_.externs[id];
  Name(record.name);
  Put(" (");
  for (std::uint32_t i = 0; i < record.param_count; ++i) {
    if (i != 0) Put(", ");
    const std::uint64_t index = std::uint64_t{record.first_param} + i;
    if (index >= module_.extern_params.size()) {
      Unknown(index);
      break;
    }
    const ExternParam& param = module_.extern_params[index];
    Known(param.type);
    if (param.by_reference) Put(" ref");
    if (param.string_length != 0) Put(" length "), Number(param.string_length);
    if (param.dimension_count != 0) {
      Put(" dims");
      for (unsigned d = 0; d < param.dimension_count && d < 3; ++d) Put(' '), Number(param.dimensions[d]);
    }
  }
  Put(')');
}

void DumpWriter::AssignList(AssignListId id) {
  if (!module_.assign_lists.Contains(id)) return Unknown(id.value);
  const ir::AssignList& list = module_.assign_lists[id];
  if (list.place.Valid()) Put("place "), Expr(list.place), Put(' ');
  Put('(');
  for (std::uint32_t i = 0; i < list.values.count; ++i) {
    if (i != 0) Put(", ");
    const std::uint64_t item = std::uint64_t{list.values.begin} + i;
    if (item >= module_.expr_items.size()) {
      Unknown(item);
      break;
    }
    Expr(module_.expr_items[item]);
  }
  Put(')');
  if (list.repeat) Put(" repeat");
  Optional(" count ", list.count);
}

}  // namespace ncport::ir
