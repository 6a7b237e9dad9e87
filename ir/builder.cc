#include "ir/builder.h"

#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/result.h"
#include "ir/block_words.h"

namespace ncport::ir {

namespace {

bool IsTruth(ExprOp op) { return op >= ExprOp::kEqual && op <= ExprOp::kXor; }

Expr Leaf(ExprOp op, Type type, std::uint32_t a, std::uint32_t b = 0) {
  Expr expr;
  expr.op = op;
  expr.type = type;
  expr.a = a;
  expr.b = b;
  return expr;
}

}  // namespace

ExprId ExprBuilder::Number(std::string_view written, Type type) {
  const char* p = written.data();
  const char* const end = p + written.size();
  DecimalText number;
  NCPORT_CHECK(ParseDecimal(p, end, number) && p == end, "'{}' is no decimal number", written);
  Expr expr;
  expr.type = type;
  expr.number = number.value;
  expr.format.int_digits = number.int_digits;
  expr.format.decimals = number.decimals;
  if (number.has_point) expr.format.flags |= NumberFormat::kPoint;
  if (written.front() == '+') expr.format.flags |= NumberFormat::kPlusSign;
  return module_.AddExpr(expr);
}

ExprId ExprBuilder::Literal(double value, Type type) {
  NCPORT_CHECK(std::isfinite(value), "a literal must be finite");
  Expr expr;
  expr.type = type;
  expr.number = value;
  expr.format.flags = NumberFormat::kComputed;
  return module_.AddExpr(expr);
}

ExprId ExprBuilder::Spelled(std::string_view spelling, double value, Type type) {
  NCPORT_CHECK(module_.literal_texts.size() <= std::numeric_limits<std::uint16_t>::max(), "too many spelled literals");
  Expr expr;
  expr.type = type;
  expr.number = value;
  expr.format.flags = NumberFormat::kAsText;
  expr.count = static_cast<std::uint16_t>(module_.literal_texts.size());
  module_.literal_texts.push_back(module_.strings.Intern(spelling));
  return module_.AddExpr(expr);
}

ExprId ExprBuilder::Text(std::string_view text) {
  return module_.AddExpr(Leaf(ExprOp::kText, Type::kString, module_.strings.Intern(text).value));
}

ExprId ExprBuilder::Vacant() { return module_.AddExpr(Leaf(ExprOp::kVacant, Type::kNumber, 0)); }

ExprId ExprBuilder::AxisName(std::uint8_t axis) { return module_.AddExpr(Leaf(ExprOp::kAxisName, Type::kAxis, axis)); }

ExprId ExprBuilder::Variable(VariableId variable) {
  return module_.AddExpr(Leaf(ExprOp::kVariable, module_.variables[variable].type, variable.value));
}

ExprId ExprBuilder::Element(VariableId variable, std::initializer_list<ExprId> indices) {
  return List(ExprOp::kElement, variable.value, module_.variables[variable].type, indices);
}

ExprId ExprBuilder::Cell(SpaceId space, std::uint32_t number) {
  return module_.AddExpr(Leaf(ExprOp::kCell, module_.spaces[space].type, space.value, number));
}

ExprId ExprBuilder::CellAt(SpaceId space, ExprId number) {
  return module_.AddExpr(Leaf(ExprOp::kCellAt, module_.spaces[space].type, number.value, space.value));
}

ExprId ExprBuilder::System(SystemId system, std::initializer_list<ExprId> indices) {
  return List(ExprOp::kSystem, system.value, module_.systems[system].type, indices);
}

ExprId ExprBuilder::Name(std::string_view name, std::initializer_list<ExprId> indices) {
  return List(ExprOp::kName, module_.strings.Intern(name).value, Type::kNone, indices);
}

ExprId ExprBuilder::Convert(ExprId operand, Type type) {
  Expr expr = Leaf(ExprOp::kConvert, type, operand.value);
  expr.flags = Expr::kImplicit;
  return module_.AddExpr(expr);
}

ExprId ExprBuilder::Unary(ExprOp op, ExprId operand) {
  NCPORT_CHECK(OperandsOf(op) == Operands::kUnary && op != ExprOp::kCellAt, "{} is no plain unary operation",
               NameOf(op));
  return module_.AddExpr(Leaf(op, module_.exprs[operand].type, operand.value));
}

ExprId ExprBuilder::Binary(ExprOp op, ExprId left, ExprId right, std::uint8_t flags) {
  NCPORT_CHECK(OperandsOf(op) == Operands::kBinary, "{} is not binary", NameOf(op));
  Expr expr = Leaf(op, IsTruth(op) ? Type::kBool : module_.exprs[left].type, left.value, right.value);
  expr.flags = flags;
  return module_.AddExpr(expr);
}

ExprId ExprBuilder::Function(ir::Function function, std::initializer_list<ExprId> arguments, Type type) {
  return List(ExprOp::kFunction, static_cast<std::uint32_t>(function), type, arguments);
}

ExprId ExprBuilder::List(ExprOp op, std::uint32_t a, Type type, std::initializer_list<ExprId> items) {
  Expr expr = Leaf(op, type, a, static_cast<std::uint32_t>(module_.expr_items.size()));
  expr.count = static_cast<std::uint16_t>(items.size());
  module_.expr_items.insert(module_.expr_items.end(), items.begin(), items.end());
  return module_.AddExpr(expr);
}

BlockBuilder& BlockBuilder::Number(std::uint32_t number) {
  block_.number = number;
  block_.number_digits = 1;
  for (std::uint32_t rest = number / 10; rest != 0; rest /= 10) ++block_.number_digits;
  return *this;
}

BlockBuilder& BlockBuilder::Label(std::string_view label) {
  block_.label = module_.strings.Intern(label);
  return *this;
}

BlockBuilder& BlockBuilder::Skip(std::uint8_t level) {
  block_.skip_level = level;
  return *this;
}

BlockBuilder& BlockBuilder::Indent(std::uint16_t blanks) {
  block_.indent = blanks;
  return *this;
}

BlockBuilder& BlockBuilder::Flags(std::uint8_t flags) {
  block_.flags |= flags;
  return *this;
}

BlockBuilder& BlockBuilder::Comment(std::string_view text, CommentPlace place, std::uint16_t word) {
  ir::Comment comment;
  comment.text = module_.strings.Intern(text);
  comment.place = place;
  comment.word = word;
  comments_.push_back(comment);
  return *this;
}

BlockBuilder& BlockBuilder::Add(const Word& word) {
  words_.push_back(word);
  return *this;
}

BlockBuilder& BlockBuilder::Add(WordOp op, ExprId value, std::uint8_t index, std::uint32_t extra) {
  Word word;
  word.op = op;
  word.index = index;
  word.phase = DefaultPhaseOf(op);
  word.value = value;
  word.extra = extra;
  return Add(word);
}

BlockBuilder& BlockBuilder::Axis(std::uint8_t axis, ExprId value, ValueMode mode) {
  Add(WordOp::kAxis, value, axis);
  Last().mode = mode;
  return *this;
}

BlockBuilder& BlockBuilder::Jump(std::string_view label, Search search, ExprId condition) {
  ir::Jump jump;
  jump.target.label = module_.strings.Intern(label);
  jump.search = search;
  return Add(WordOp::kJump, condition, 0, module_.jumps.Add(jump).value);
}

BlockBuilder& BlockBuilder::JumpToNumber(std::uint32_t number, Search search, ExprId condition) {
  ir::Jump jump;
  jump.target.kind = TargetKind::kNumber;
  jump.target.number = number;
  jump.search = search;
  return Add(WordOp::kJump, condition, 0, module_.jumps.Add(jump).value);
}

BlockBuilder& BlockBuilder::Call(ProgramId program, std::initializer_list<ExprId> arguments, ExprId passes) {
  ir::Call call;
  call.name = module_.programs[program].name;
  call.program = program;
  call.has_brackets = arguments.size() != 0;
  call.passes = passes;
  call.args.begin = static_cast<std::uint32_t>(module_.args.Size());
  for (const ExprId value : arguments) {
    Arg arg;
    arg.value = value;
    arg.position = static_cast<std::uint16_t>(call.args.count++);
    module_.args.Add(arg);
  }
  return Add(WordOp::kCall, {}, 0, module_.calls.Add(call).value);
}

BlockBuilder& BlockBuilder::RepeatPart(std::string_view first, std::string_view last, ExprId count) {
  Part part;
  part.first.label = module_.strings.Intern(first);
  part.has_last = !last.empty();
  if (part.has_last) part.last.label = module_.strings.Intern(last);
  return Add(WordOp::kRepeatPart, count, 0, module_.parts.Add(part).value);
}

BlockBuilder& BlockBuilder::For(ExprId variable, ExprId start, ExprId end, ExprId step) {
  return Add(WordOp::kFor, start, 0, module_.fors.Add({variable, end, step}).value);
}

BlockId BlockBuilder::Finish() {
  SetWords(module_, block_, words_);
  block_.comments = {static_cast<std::uint32_t>(module_.comments.Size()), static_cast<std::uint32_t>(comments_.size())};
  for (const ir::Comment& comment : comments_) module_.comments.Add(comment);
  return module_.blocks.Add(block_);
}

ProgramBuilder::ProgramBuilder(Module& module, std::string_view name, ProgramKind kind, FileId file) : module_(module) {
  Program program;
  program.name = module.strings.Intern(name);
  program.kind = kind;
  program.file = file;
  program.blocks.begin = static_cast<std::uint32_t>(module.blocks.Size());
  program.parameters.begin = static_cast<std::uint32_t>(module.variables.Size());
  id_ = module.programs.Add(program);
}

VariableId ProgramBuilder::Parameter(std::string_view name, Type type, bool by_reference) {
  Program& program = module_.programs[id_];
  NCPORT_CHECK(program.parameters.begin + program.parameters.count == module_.variables.Size(),
               "parameter {} of {} comes after other variables", name, module_.View(program.name));
  const VariableId id = AddVariable(name, type, Scope::kParameter);
  module_.variables[id].by_reference = by_reference;
  ++program.parameters.count;
  return id;
}

VariableId ProgramBuilder::Local(std::string_view name, Type type, std::span<const std::uint32_t> dimensions) {
  NCPORT_CHECK(dimensions.size() <= 3, "{} has more than three dimensions", name);
  const VariableId id = AddVariable(name, type, Scope::kLocal);
  ir::Variable& variable = module_.variables[id];
  for (const std::uint32_t size : dimensions) variable.dimensions[variable.dimension_count++] = size;
  return id;
}

VariableId ProgramBuilder::AddVariable(std::string_view name, Type type, Scope scope) {
  ir::Variable variable;
  variable.name = module_.strings.Intern(name);
  variable.type = type;
  variable.scope = scope;
  variable.owner = id_;
  variable.file = module_.programs[id_].file;
  return module_.variables.Add(variable);
}

BlockBuilder ProgramBuilder::Block(std::uint32_t line) {
  line_ = line == 0 ? line_ + 1 : line;
  return BlockBuilder{module_, AddOrigin(module_, module_.programs[id_].file, line_)};
}

void ProgramBuilder::Finish() {
  IdRange<BlockId>& blocks = module_.programs[id_].blocks;
  blocks.count = static_cast<std::uint32_t>(module_.blocks.Size()) - blocks.begin;
}

FileId AddFile(Module& module, std::string_view name) {
  const StringId text = module.strings.Intern(name);
  for (std::size_t index = 0; index < module.file_names.size(); ++index) {
    if (module.file_names[index] == text) return FileId{index};
  }
  module.file_names.push_back(text);
  return FileId{module.file_names.size() - 1};
}

SpaceId AddSpace(Module& module, std::string_view name, std::uint32_t first, std::uint32_t last, Type type,
                 StartValue start) {
  Space space;
  space.name = module.strings.Intern(name);
  space.first = first;
  space.last = last;
  space.type = type;
  space.start = start;
  return module.spaces.Add(space);
}

SystemId AddSystem(Module& module, std::string_view name, SystemKind kind, Type type) {
  System system;
  system.name = module.strings.Intern(name);
  system.kind = kind;
  system.type = type;
  return module.systems.Add(system);
}

std::uint16_t AddSpelling(Module& module, std::string_view text, std::string_view rule) {
  const StringId text_id = module.strings.Intern(text);
  const StringId rule_id = module.strings.Intern(rule);
  for (std::size_t index = 1; index < module.spellings.size(); ++index) {
    if (module.spellings[index].text == text_id && module.spellings[index].rule == rule_id) {
      return static_cast<std::uint16_t>(index);
    }
  }
  if (module.spellings.size() > std::numeric_limits<std::uint16_t>::max()) return 0;
  module.spellings.push_back({text_id, rule_id});
  return static_cast<std::uint16_t>(module.spellings.size() - 1);
}

OriginId AddOrigin(Module& module, FileId file, std::uint32_t line, OriginId via, std::uint32_t turn,
                   std::string_view pass) {
  Origin origin;
  origin.file = file;
  origin.line = line;
  origin.via = via;
  origin.turn = turn;
  if (!pass.empty()) origin.pass = module.strings.Intern(pass);
  return module.origins.Add(origin);
}

}  // namespace ncport::ir
