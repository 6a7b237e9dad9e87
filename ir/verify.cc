// One class, one method a record kind: long, but each method is a list of independent checks.
#include "ir/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/result.h"
#include "base/text_buffer.h"
#include "ir/dump.h"
#include "ir/enum_names.h"
#include "ir/word_shape.h"

namespace ncport::ir {

namespace {

constexpr std::uint64_t kMaxExprNodes = 1U << 20U;  // of one tree; shared nodes count each time

struct Violation {
  std::string text;
  BlockId block;
};

class Verifier {
 public:
  Verifier(const Module& module, const VerifyOptions& options) : m_(module), options_(options) {}

  std::optional<Violation> Run() {
    const bool ok = Tables() && Exprs() && Lists() && Records() && Variables() && Origins() && Programs();
    if (ok) return std::nullopt;
    return violation_;
  }

 private:
  // --- small checks

  /// What is being checked; made into text only when something is wrong.
  void At(std::string_view what, std::uint32_t number = Id<void>::kNone, std::string_view name = {}) {
    what_ = what;
    number_ = number;
    name_ = name;
  }
  std::string Where() const {
    std::string text(what_);
    if (number_ != Id<void>::kNone) text += fmt::format(" {}", number_);
    if (!name_.empty()) text += fmt::format(" ({})", name_);
    return text.empty() ? text : text + ": ";
  }

  template <class... Args>
  bool Fail(fmt::format_string<Args...> format, Args&&... args) {
    if (violation_.text.empty()) {
      violation_ = {Where() + fmt::format(format, std::forward<Args>(args)...), block_};
    }
    return false;
  }
  bool Check(bool condition, std::string_view what) { return condition || Fail("{}", what); }
  bool String(StringId id, std::string_view what, bool may_be_missing = true) {
    if (!id.Valid()) return may_be_missing || Fail("{} is missing", what);
    return id.value < m_.strings.Size() || Fail("{} is string {} of {}", what, id.value, m_.strings.Size());
  }
  bool File(FileId id) {
    if (!id.Valid()) return true;
    return (id.value < m_.file_names.size() && m_.file_names[id.value].Valid()) ||
           Fail("file {} has no name", id.value);
  }
  bool Operand(ExprId id, std::string_view what, bool may_be_missing = true) {
    if (!id.Valid()) return may_be_missing || Fail("{} is missing", what);
    return m_.exprs.Contains(id) || Fail("{} is expression {} of {}", what, id.value, m_.exprs.Size());
  }
  /// Something that can be assigned to.
  bool Place(ExprId id, std::string_view what, bool may_be_missing = true) {
    if (!Operand(id, what, may_be_missing)) return false;
    if (!id.Valid()) return true;
    switch (m_.exprs[id].op) {
      case ExprOp::kVariable:
      case ExprOp::kElement:
      case ExprOp::kCell:
      case ExprOp::kCellAt:
      case ExprOp::kSystem:
      case ExprOp::kName:
        return true;
      default:
        return Fail("{} is {}, which cannot be written", what, NameOf(m_.exprs[id].op));
    }
  }
  bool Range(std::uint64_t begin, std::uint64_t count, std::size_t size, std::string_view what) {
    return count == 0 || begin + count <= size || Fail("{} {} to {} of {}", what, begin, begin + count, size);
  }
  template <class Enum>
  bool Enumerator(Enum value, std::string_view what) {
    return IsKnown(value) || Fail("{} {} is not in its list", what, static_cast<unsigned>(value));
  }
  template <class Store, class IdType>
  bool Record(const Store& store, IdType id, std::string_view what, bool may_be_missing = false) {
    if (!id.Valid()) return may_be_missing || Fail("{} is missing", what);
    return store.Contains(id) || Fail("{} {} of {}", what, id.value, store.Size());
  }
  bool Axis(std::uint64_t axis) {
    return axis < kLetterAxes || (axis < kMaxAxes && axis - kFirstNamedAxis < m_.axis_names.size()) ||
           Fail("axis {} has no name", axis);
  }

  // --- tables

  bool Tables() {
    // Ids without a name are of files that hold no program: profiles, settings.
    for (const StringId name : m_.file_names) {
      if (!String(name, "file name")) return false;
    }
    if (!Check(m_.axis_names.size() <= kMaxAxes - kFirstNamedAxis, "too many axis names")) return false;
    for (const StringId name : m_.axis_names) {
      if (!String(name, "axis name", false)) return false;
    }
    if (!Check(!m_.spellings.empty() && m_.spellings.size() <= 0x10000,
               "spellings need entry 0 and at most 65,536 rows")) {
      return false;
    }
    for (std::size_t i = 1; i < m_.spellings.size(); ++i) {
      if (!String(m_.spellings[i].text, "spelling", false) || !String(m_.spellings[i].rule, "rule")) return false;
    }
    for (const Space& space : m_.spaces.All()) {
      const bool ok = String(space.name, "name of a space", false) && Enumerator(space.type, "type") &&
                      Enumerator(space.lifetime, "lifetime") && Enumerator(space.visibility, "visibility") &&
                      Enumerator(space.start, "start value") &&
                      Check(space.first <= space.last, "a space ends before it starts");
      if (!ok) return false;
    }
    for (const System& system : m_.systems.All()) {
      const bool ok = String(system.name, "name of a system variable", false) &&
                      Enumerator(system.kind, "kind of system variable") && Enumerator(system.type, "type");
      if (!ok) return false;
    }
    return true;
  }

  // --- expressions

  bool Exprs() {
    const auto& places = m_.expr_places.All();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!Check(m_.exprs.Contains(places[i].expr), "a place of an expression that is not there")) return false;
      if (!Check(i == 0 || places[i - 1].expr.value < places[i].expr.value, "places of expressions out of order"))
        return false;
    }
    depths_.assign(m_.exprs.Size(), 1);
    nodes_.assign(m_.exprs.Size(), 1);
    for (const ExprId id : m_.exprs.Ids()) {
      At("expression", id.value, NameOf(m_.exprs[id].op));
      if (!Expr(id)) return false;
    }
    At({});
    return true;
  }

  bool Child(ExprId parent, ExprId child) {
    if (!child.Valid()) return Fail("an operand is missing");
    if (child >= parent) return Fail("operand {} does not stand before it", child.value);
    depths_[parent.value] = std::max(depths_[parent.value], depths_[child.value] + 1);
    nodes_[parent.value] += nodes_[child.value];
    return Check(depths_[parent.value] <= kMaxExprDepth, "nested too deep") &&
           Check(nodes_[parent.value] <= kMaxExprNodes, "too many nodes");
  }
  static ExprId Raw(std::uint32_t value) {
    ExprId id;
    id.value = value;
    return id;
  }

  bool Children(ExprId id, const ir::Expr& expr, std::uint32_t least, std::uint32_t most) {
    if (expr.count < least || expr.count > most) {
      return Fail("{} operands instead of {} to {}", expr.count, least, most);
    }
    if (!Range(expr.b, expr.count, m_.expr_items.size(), "list")) return false;
    for (std::uint32_t i = 0; i < expr.count; ++i) {
      if (!Child(id, m_.expr_items[expr.b + i])) return false;
    }
    return true;
  }

  bool Expr(ExprId id) {
    const ir::Expr& expr = m_.exprs[id];
    if (!Enumerator(expr.op, "operation") || !Enumerator(expr.type, "type")) return false;
    if (!Check((expr.flags & 0x80U) == 0, "unknown flag")) return false;
    VariableId variable;
    variable.value = expr.a;
    SystemId system;
    system.value = expr.a;
    SpaceId space;
    space.value = expr.op == ExprOp::kCell ? expr.a : expr.b;
    StringId string;
    string.value = expr.a;
    // An array of strings takes an index for the character besides.
    constexpr std::uint32_t kMostIndices = 4;
    switch (expr.op) {
      case ExprOp::kLiteral:
        return Literal(expr);
      case ExprOp::kText:
        return String(string, "text", false);
      case ExprOp::kVacant:
        return true;
      case ExprOp::kAxisName:
        return Axis(expr.a);
      case ExprOp::kVariable:
        return Record(m_.variables, variable, "variable");
      case ExprOp::kElement:
        return Record(m_.variables, variable, "variable") && Children(id, expr, 1, kMostIndices);
      case ExprOp::kCell:
        return Record(m_.spaces, space, "space");
      case ExprOp::kCellAt:
        return Record(m_.spaces, space, "space") && Child(id, Raw(expr.a));
      case ExprOp::kSystem:
        return Record(m_.systems, system, "system variable") && Children(id, expr, 0, kMostIndices);
      case ExprOp::kName:
        return Check(!options_.names_resolved, "a name is left after resolution") && String(string, "name", false) &&
               Children(id, expr, 0, 0xFFFF);
      case ExprOp::kFunction: {
        if (!Check(expr.a < 256 && IsKnown(static_cast<Function>(expr.a)), "unknown function")) return false;
        const Arity arity = ArityOf(static_cast<Function>(expr.a));
        return Children(id, expr, arity.least, arity.most);
      }
      case ExprOp::kConvert:
        return Check(expr.type != Type::kNone, "conversion to no type") && Child(id, Raw(expr.a));
      default:
        break;
    }
    if (!Child(id, Raw(expr.a))) return false;
    return OperandsOf(expr.op) != Operands::kBinary || Child(id, Raw(expr.b));
  }

  bool Literal(const ir::Expr& expr) {
    if (!Check(std::isfinite(expr.number), "not finite")) return false;
    if (!Check((expr.format.flags & 0xF0U) == 0, "unknown flag of the number format")) return false;
    const bool as_text = (expr.format.flags & NumberFormat::kAsText) != 0;
    if (as_text != (expr.count != 0)) return Fail("spelling and kAsText do not agree");
    if (!as_text) return true;
    if (expr.count >= m_.literal_texts.size()) return Fail("spelling {} of {}", expr.count, m_.literal_texts.size());
    return String(m_.literal_texts[expr.count], "spelling", false);
  }

  // --- records that words lead to

  bool Lists() {
    At("expression lists");
    // Entries of assignment lists may be missing, so only their range is checked here.
    for (const ExprId item : m_.expr_items) {
      if (!Operand(item, "entry")) return false;
    }
    At({});
    return true;
  }

  bool TargetOk(const Target& target) {
    if (!Enumerator(target.kind, "kind of target") || !String(target.label, "label") ||
        !Operand(target.expr, "target")) {
      return false;
    }
    return true;
  }

  bool Records() {
    At("jump");
    for (const Jump& jump : m_.jumps.All()) {
      if (!Enumerator(jump.search, "search") || !TargetOk(jump.target)) return false;
    }
    At("switch");
    for (const Switch& record : m_.switches.All()) {
      if (!Range(record.first_arm, record.arm_count, m_.switch_arms.size(), "arms")) return false;
      for (std::uint32_t i = 0; i < record.arm_count; ++i) {
        const SwitchArm& arm = m_.switch_arms[record.first_arm + i];
        if (!Operand(arm.value, "value of an arm") || !Record(m_.jumps, arm.jump, "jump of an arm")) return false;
        if (!arm.value.Valid() && i + 1 != record.arm_count) return Fail("the default arm is not the last one");
      }
    }
    At("call");
    for (const Call& call : m_.calls.All()) {
      const bool ok = Enumerator(call.form, "form") && String(call.name, "name") &&
                      Record(m_.programs, call.program, "program", true) && Operand(call.name_expr, "name") &&
                      Operand(call.passes, "passes") && TargetOk(call.from) && TargetOk(call.to) &&
                      Range(call.args.begin, call.args.count, m_.args.Size(), "arguments");
      if (!ok) return false;
    }
    for (const Arg& arg : m_.args.All()) {
      if (!Operand(arg.value, "argument")) return false;
    }
    At("part");
    for (const Part& part : m_.parts.All()) {
      if (!TargetOk(part.first) || !TargetOk(part.last)) return false;
      if (!Check(!part.single || !part.has_last, "a single block with an end")) return false;
    }
    At("for");
    for (const For& loop : m_.fors.All()) {
      if (!Place(loop.variable, "variable") || !Operand(loop.end, "end") || !Operand(loop.step, "step")) return false;
    }
    At("extern");
    for (const Extern& record : m_.externs.All()) {
      if (!String(record.name, "name", false) ||
          !Range(record.first_param, record.param_count, m_.extern_params.size(), "parameters")) {
        return false;
      }
    }
    for (const ExternParam& param : m_.extern_params) {
      if (!Enumerator(param.type, "type") || !Dimensions(param.dimension_count, param.dimensions)) return false;
    }
    At("assignment list");
    for (const AssignList& list : m_.assign_lists.All()) {
      if (!Place(list.place, "place") || !Operand(list.count, "count") ||
          !Range(list.values.begin, list.values.count, m_.expr_items.size(), "values")) {
        return false;
      }
    }
    At({});
    return true;
  }

  bool Dimensions(std::uint8_t count, const std::uint32_t (&dimensions)[3]) {
    if (!Check(count <= 3, "more than three dimensions")) return false;
    for (std::uint32_t i = count; i < 3; ++i) {
      if (!Check(dimensions[i] == 0, "size of a dimension that is not there")) return false;
    }
    return true;
  }

  bool Variables() {
    for (const VariableId id : m_.variables.Ids()) {
      const Variable& variable = m_.variables[id];
      At("variable", id.value);
      const bool ok =
          String(variable.name, "name", false) && Enumerator(variable.type, "type") &&
          Enumerator(variable.scope, "scope") && Dimensions(variable.dimension_count, variable.dimensions) &&
          Record(m_.programs, variable.owner, "owner", true) && Operand(variable.initial, "initial value") &&
          Record(m_.assign_lists, variable.initial_list, "initial list", true) &&
          Operand(variable.lower_limit, "lower limit") && Operand(variable.upper_limit, "upper limit") &&
          File(variable.file);
      if (!ok) return false;
      const bool needs_owner = variable.scope == Scope::kLocal || variable.scope == Scope::kParameter;
      if (!Check(variable.owner.Valid() || !needs_owner, "a local of no program")) return false;
    }
    At({});
    return true;
  }

  bool Origins() {
    std::vector<std::uint32_t> depths(m_.origins.Size(), 1);
    for (const OriginId id : m_.origins.Ids()) {
      const Origin& origin = m_.origins[id];
      At("origin", id.value);
      if (!File(origin.file) || !String(origin.pass, "pass")) return false;
      if (!origin.via.Valid()) continue;
      if (!Check(origin.via < id, "leads to one that does not stand before it")) return false;
      depths[id.value] = depths[origin.via.value] + 1;
      if (!Check(depths[id.value] <= kMaxOriginDepth, "chain too long")) return false;
    }
    At({});
    return true;
  }

  // --- programs, blocks, words

  bool Programs() {
    std::vector<IdRange<BlockId>> ranges;
    for (const ProgramId id : m_.programs.Ids()) {
      const Program& program = m_.programs[id];
      At("program", id.value);
      const bool ok = String(program.name, "name", false) && Enumerator(program.kind, "kind") && File(program.file) &&
                      Range(program.blocks.begin, program.blocks.count, m_.blocks.Size(), "blocks") &&
                      Range(program.parameters.begin, program.parameters.count, m_.variables.Size(), "parameters");
      if (!ok) return false;
      for (const VariableId parameter : program.parameters) {
        if (!Check(m_.variables[parameter].owner == id, "a parameter belongs to another program")) return false;
      }
      if (!program.blocks.Empty()) ranges.push_back(program.blocks);
      for (const BlockId block : program.blocks) {
        if (!BlockOk(block, program)) return false;
      }
      block_ = {};
      if (!Structure(program)) return false;
      block_ = {};
    }
    At({});
    std::ranges::sort(ranges, {}, [](const IdRange<BlockId>& range) { return range.begin; });
    for (std::size_t i = 1; i < ranges.size(); ++i) {
      if (!Check(ranges[i - 1].begin + ranges[i - 1].count <= ranges[i].begin, "two programs share blocks"))
        return false;
    }
    return true;
  }

  bool BlockOk(BlockId id, const Program& program) {
    const Block& block = m_.blocks[id];
    block_ = id;
    At("block");
    const bool ok = Record(m_.origins, block.origin, "origin", true) && String(block.label, "label") &&
                    Range(block.words.begin, block.words.count, m_.words.Size(), "words") &&
                    Range(block.comments.begin, block.comments.count, m_.comments.Size(), "comments") &&
                    Check((block.flags & 0xF0U) == 0, "unknown flag") &&
                    Check(block.skip_level < 16 || block.skip_level == Block::kNoSkip, "skip level over 15") &&
                    Check(!block.link.Valid() || (block.link.value >= program.blocks.begin &&
                                                  block.link.value - program.blocks.begin < program.blocks.count),
                          "link out of the program");
    if (!ok) return false;
    for (const CommentId comment_id : block.comments) {
      const Comment& comment = m_.comments[comment_id];
      if (!Enumerator(comment.place, "place of a comment") || !String(comment.text, "comment", false)) return false;
      const bool before_word = comment.place == CommentPlace::kBeforeWord;
      if (!Check(!before_word || comment.word <= block.words.count, "a comment before a word that is not there")) {
        return false;
      }
    }
    const bool refused = (block.flags & Block::kRefused) != 0;
    for (std::uint32_t i = 0; i < block.words.count; ++i) {
      const Word& word = m_.words[block.words[i]];
      At("word", i + 1, NameOf(word.op));
      if (!WordOk(word, refused)) return false;
      if (!refused && IsStructureMark(word.op) && block.words.count != 1) return Fail("not alone in its block");
    }
    return true;
  }

  bool WordOk(const Word& word, bool refused) {
    const bool ok = Enumerator(word.op, "word") && Enumerator(word.phase, "phase") && Enumerator(word.mode, "mode") &&
                    Check((word.flags & 0x80U) == 0, "unknown flag") &&
                    Check(word.spelling < m_.spellings.size(), "unknown spelling") && Operand(word.value, "value");
    if (!ok) return false;
    const ValueUse use = ValueUseOf(word.op);
    if (!Check(use != ValueUse::kNever || !word.value.Valid(), "has a value")) return false;
    if (!Check(use != ValueUse::kMust || word.value.Valid() || refused, "has no value")) return false;
    return Index(word) && Extra(word, refused);
  }

  bool Index(const Word& word) {
    const std::uint8_t index = word.index;
    switch (ShapeOf(word.op).index) {
      case IndexKind::kNone:
        return index == 0 || Fail("index {} has no meaning", index);
      case IndexKind::kNumber:
        return true;
      case IndexKind::kMotion:
        return Enumerator(static_cast<Motion>(index), "motion");
      case IndexKind::kPlane:
        return Enumerator(static_cast<Plane>(index), "plane");
      case IndexKind::kDistance:
        return Enumerator(static_cast<Distance>(index), "distance");
      case IndexKind::kUnits:
        return Enumerator(static_cast<Units>(index), "units");
      case IndexKind::kFeedMode:
        return Enumerator(static_cast<FeedMode>(index), "feed mode");
      case IndexKind::kSpeedMode:
        return Enumerator(static_cast<SpeedMode>(index), "speed mode");
      case IndexKind::kCutterComp:
        return Enumerator(static_cast<CutterComp>(index), "compensation");
      case IndexKind::kDiameter:
        return Enumerator(static_cast<Diameter>(index), "diameter mode");
      case IndexKind::kPathMode:
        return Enumerator(static_cast<PathMode>(index), "path mode");
      case IndexKind::kReturnLevel:
        return Enumerator(static_cast<ReturnLevel>(index), "return level");
      case IndexKind::kAxis:
        return Axis(index);
      case IndexKind::kCoordinate:
        return index < 3 || Fail("coordinate {}", index);
      case IndexKind::kChamfer:
        return Enumerator(static_cast<ChamferKind>(index), "kind of chamfer");
      case IndexKind::kReference:
        return Enumerator(static_cast<ReferenceKind>(index), "kind of reference");
      case IndexKind::kPole:
        return Enumerator(static_cast<PoleBase>(index), "base of the pole");
      case IndexKind::kFrame:
        return Enumerator(static_cast<FrameOp>(index), "frame operation");
      case IndexKind::kAlarm:
        return Enumerator(static_cast<AlarmKind>(index), "kind of alarm");
      case IndexKind::kCycle:
        return Enumerator(static_cast<Cycle>(index), "cycle");
      case IndexKind::kCycleField:
        return Enumerator(static_cast<CycleField>(index), "word of a cycle");
      case IndexKind::kReturn:
        return Enumerator(static_cast<ReturnKind>(index), "kind of return");
      case IndexKind::kMark:
        return index == 0 || IsStructureMark(static_cast<WordOp>(index)) || Fail("index {} is no mark", index);
    }
    return true;
  }

  bool Extra(const Word& word, bool refused) {
    const WordShape shape = ShapeOf(word.op);
    const bool missing = word.extra == Id<void>::kNone;
    if (shape.extra == ExtraKind::kNone) return missing || Fail("extra {} has no meaning", word.extra);
    if (missing) return shape.extra_may_be_missing || refused || Fail("extra is missing");
    switch (shape.extra) {
      case ExtraKind::kNone:
      case ExtraKind::kNumber:
        return true;
      case ExtraKind::kSpindleState:
        return word.extra < 256 ? Enumerator(static_cast<SpindleState>(word.extra), "spindle state")
                                : Fail("spindle state {}", word.extra);
      case ExtraKind::kExpr:
        return word.op == WordOp::kAssign ? Place(word.Extra<ExprId>(), "what is written")
                                          : Operand(word.Extra<ExprId>(), "extra");
      case ExtraKind::kVariable:
        return Record(m_.variables, word.Extra<VariableId>(), "variable");
      case ExtraKind::kProgram:
        return Record(m_.programs, word.Extra<ProgramId>(), "program");
      case ExtraKind::kExtern:
        return Record(m_.externs, word.Extra<ExternId>(), "extern");
      case ExtraKind::kAssignList:
        return Record(m_.assign_lists, word.Extra<AssignListId>(), "assignment list");
      case ExtraKind::kJump:
        return Record(m_.jumps, word.Extra<JumpId>(), "jump");
      case ExtraKind::kSwitch:
        return Record(m_.switches, word.Extra<SwitchId>(), "switch");
      case ExtraKind::kCall:
        return Record(m_.calls, word.Extra<CallId>(), "call");
      case ExtraKind::kPart:
        return Record(m_.parts, word.Extra<PartId>(), "part");
      case ExtraKind::kFor:
        return Record(m_.fors, word.Extra<ForId>(), "for");
      case ExtraKind::kString:
        return String(word.Extra<StringId>(), "text", false);
    }
    return true;
  }

  // --- structure links

  /// The mark of a block; kVerbatim if it has none.
  WordOp MarkOf(const Block& block) const {
    for (const WordId id : block.words) {
      const Word& word = m_.words[id];
      const WordOp op = word.op == WordOp::kVerbatim ? static_cast<WordOp>(word.index) : word.op;
      if (IsStructureMark(op)) return op;
    }
    return WordOp::kVerbatim;
  }

  static bool IsOpener(WordOp op) {
    return op == WordOp::kIf || op == WordOp::kWhile || op == WordOp::kLoop || op == WordOp::kRepeat ||
           op == WordOp::kFor;
  }
  static bool Closes(WordOp opener, WordOp closer) {
    switch (opener) {
      case WordOp::kIf:
        return closer == WordOp::kEndIf;
      case WordOp::kWhile:
        return closer == WordOp::kEndWhile;
      case WordOp::kLoop:
        return closer == WordOp::kEndLoop;
      case WordOp::kRepeat:
        return closer == WordOp::kUntil;
      case WordOp::kFor:
        return closer == WordOp::kEndFor;
      default:
        return false;
    }
  }

  /// Links as BuildStructure sets them: pairs that nest, ELSE between.
  bool Structure(const Program& program) {
    struct Open {
      BlockId block;
      WordOp op;
      BlockId middle;
    };
    std::vector<Open> open;
    for (const BlockId id : program.blocks) {
      const Block& block = m_.blocks[id];
      const WordOp op = MarkOf(block);
      block_ = id;
      At("block");
      if (op == WordOp::kVerbatim) {
        if (!Check(!block.link.Valid(), "a link without structure mark")) return false;
        continue;
      }
      At(NameOf(op));
      if (!block.link.Valid()) {
        const bool refused = (block.flags & Block::kRefused) != 0;
        if (!Check(refused || !options_.structure_built, "has no link")) return false;
        continue;
      }
      if (IsOpener(op)) {
        if (!Check(block.link > id, "link leads back")) return false;
        open.push_back({id, op, {}});
        continue;
      }
      if (!Check(!open.empty(), "links to no open structure")) return false;
      Open& top = open.back();
      if (op == WordOp::kElse) {
        const bool ok = Check(top.op == WordOp::kIf && !top.middle.Valid(), "stands in no IF") &&
                        Check(m_.blocks[top.block].link == id, "its IF does not link to it") &&
                        Check(block.link > id, "link leads back");
        if (!ok) return false;
        top.middle = id;
        continue;
      }
      const BlockId before = top.middle.Valid() ? top.middle : top.block;
      const bool ok = Check(Closes(top.op, op), "closes another structure") &&
                      Check(block.link == top.block, "does not link to its opener") &&
                      Check(m_.blocks[before].link == id, "its partner does not link to it");
      if (!ok) return false;
      open.pop_back();
    }
    if (open.empty()) return true;
    block_ = open.back().block;
    At(NameOf(open.back().op));
    return Fail("links to no end");
  }

  const Module& m_;
  const VerifyOptions& options_;
  Violation violation_;
  std::string_view what_;
  std::uint32_t number_ = Id<void>::kNone;
  std::string_view name_;
  BlockId block_;
  std::vector<std::uint32_t> depths_;
  std::vector<std::uint64_t> nodes_;
};

std::string PlaceOf(const Module& module, BlockId block) {
  if (!block.Valid() || !module.blocks.Contains(block) || !module.origins.Contains(module.blocks[block].origin))
    return {};
  const Origin& origin = module.origins[module.blocks[block].origin];
  std::string_view name = "-";
  if (origin.file.value < module.file_names.size()) {
    const StringId text = module.file_names[origin.file.value];
    if (text.value < module.strings.Size()) name = module.strings.View(text);
  }
  return fmt::format("{}:{}: ", name, origin.line);
}

}  // namespace

std::optional<std::string> FindViolation(const Module& module, const VerifyOptions& options) {
  const std::optional<Violation> violation = Verifier{module, options}.Run();
  if (!violation) return std::nullopt;
  return PlaceOf(module, violation->block) + violation->text;
}

bool Verify(const Module& module, std::string_view when, const VerifyOptions& options) {
  const std::optional<Violation> violation = Verifier{module, options}.Run();
  if (!violation) return true;
  TextBuffer dump;
  DumpOptions dump_options;
  dump_options.marked = violation->block;
  dump_options.mark = violation->text;
  Dump(module, dump, dump_options);
  // The lines around the mark tell more than the whole of a large module.
  constexpr std::size_t kAround = 4000;
  std::string_view shown = dump.View();
  const std::size_t mark = violation->block.Valid() ? shown.find("\n  // ^ ") : std::string_view::npos;
  const std::size_t middle = mark == std::string_view::npos ? 0 : mark;
  const std::size_t begin = middle > kAround ? shown.rfind('\n', middle - kAround) + 1 : 0;
  shown = shown.substr(begin, middle - begin + kAround);
  fmt::print(stderr, "{}\n", shown);
  NCPORT_BUG("the program in neutral form is broken {}: {}{}", when, PlaceOf(module, violation->block),
             violation->text);
}

}  // namespace ncport::ir
