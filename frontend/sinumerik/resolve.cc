#include "frontend/sinumerik/resolve.h"

#include <algorithm>

#include "base/letter_case.h"
#include "base/near_name.h"
#include "base/result.h"
#include "dialects/finding_alarms.h"
#include "dialects/sinumerik/library.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/reader.h"
#include "frontend/sinumerik/fitted_words.h"
#include "frontend/sinumerik/reader.h"
#include "frontend/sinumerik/resolver.h"
#include "frontend/sinumerik/word_slips.h"
#include "ir/axis_names.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::ExprId;
using ir::Scope;
using ir::Type;
using ir::WordOp;

namespace {

std::string KeyOf(ir::ProgramId owner, std::string_view name) {
  return owner.Valid() ? std::to_string(owner.value) + ":" + UpperOf(name) : ":" + UpperOf(name);
}

}  // namespace

ProgramIndex::ProgramIndex(const ir::Module& module) {
  for (const ir::ProgramId id : module.programs.Ids()) {
    const ir::Program& program = module.programs[id];
    const auto [entry, added] = by_name_.emplace(UpperOf(module.View(program.name)), id);
    if (!added) {
      // Card 7.3: of two programs of one name the subprogram is taken, of the user's before the control's.
      const ir::Program& known = module.programs[entry->second];
      const bool better = (known.library && !program.library) ||
                          (known.kind == ir::ProgramKind::kMain && program.kind == ir::ProgramKind::kSub &&
                           known.library == program.library);
      if (better) entry->second = id;
    }
    if (!program.file.Valid() || program.file.value >= module.file_names.size()) continue;
    const std::string_view file = module.View(module.file_names[program.file.value]);
    by_file_.emplace(UpperOf(PlainProgramName(file)), id);
  }
}

ir::ProgramId ProgramIndex::Find(std::string_view name) const {
  const std::string wanted = UpperOf(PlainProgramName(name));
  if (const auto found = by_name_.find(wanted); found != by_name_.end()) return found->second;
  // PROC names it otherwise; the control looks for the file.
  const auto found = by_file_.find(wanted);
  return found != by_file_.end() ? found->second : ir::ProgramId{};
}

void ResolveNames(SourceFiles& files, ir::Module& module, const dialects::Profile& profile, diag::Sink& sink) {
  Resolver(files, module, profile, sink).Run();
  CheckFittedWords(module, profile, sink);
}

void Resolver::Run() {
  ReadLibrary();
  IndexVariables();
  programs_.emplace(module_);
  for (const ir::ProgramId id : module_.programs.Ids()) Program(id);
  // What is left stands in refused blocks, which nobody looks into. What must be a place is none there.
  const auto clear_place = [this](ExprId& place) {
    using ir::ExprOp;
    if (!place.Valid()) return;
    const ExprOp op = module_.exprs[place].op;
    const bool writable = op == ExprOp::kVariable || op == ExprOp::kElement || op == ExprOp::kCell ||
                          op == ExprOp::kCellAt || op == ExprOp::kSystem;
    if (!writable) place = {};
  };
  for (ir::For& loop : module_.fors.All()) clear_place(loop.variable);
  for (ir::AssignList& list : module_.assign_lists.All()) clear_place(list.place);
  for (ir::Expr& expr : module_.exprs.All()) {
    if (expr.op == ir::ExprOp::kName) expr = ir::Expr();
  }
}

// Standard cycles that are called and that no file of the user holds.
void Resolver::ReadLibrary() {
  // Cycles may call cycles: until nothing is added.
  for (bool added = true; added;) {
    added = false;
    for (const StringId name : UnknownCallees(module_, profile_.language)) {
      const std::string plain = UpperOf(PlainProgramName(module_.View(name)));
      const auto text = dialects::sinumerik::LibraryCycle(plain);
      if (!text) continue;
      const FileId file = files_.Add(LowerOf("<" + plain + ">"), std::string(*text));
      const std::size_t programs = module_.programs.Size();
      NCPORT_CHECK(frontend::ReadFile(files_, file, profile_, {.library = true}, module_, sink_).Ok(),
                   "cycle {} is not read", plain);
      for (std::size_t i = programs; i < module_.programs.Size(); ++i) {
        ir::Program& program = module_.programs[ir::ProgramId{i}];
        program.kind = ir::ProgramKind::kSub;
        if (dialects::sinumerik::LibrarySaveFollowsProfile(plain) &&
            !profile_.sinumerik.drill_cycles_keep_codes.Or(true)) {
          program.saves_modal_state = false;
        }
      }
      added = true;
    }
  }
}

void Resolver::IndexVariables() {
  const bool main_visible = profile_.sinumerik.main_variables_visible.Or(false);
  for (const ir::VariableId id : module_.variables.Ids()) {
    const ir::Variable& variable = module_.variables[id];
    const std::string_view name = module_.View(variable.name);
    const bool global = variable.scope == Scope::kChannel || variable.scope == Scope::kGlobal;
    const ir::ProgramId owner = global ? ir::ProgramId{} : variable.owner;
    if (!variables_.emplace(KeyOf(owner, name), id).second) {
      sink_.Report(Code::kDoubleName, {variable.file, variable.line, variable.begin, variable.begin + variable.length},
                   name);
    }
    if (variable.scope == Scope::kProgram && main_visible) variables_.emplace(KeyOf({}, name), id);
  }
}

ir::VariableId Resolver::FindVariable(std::string_view name) const {
  const auto own = variables_.find(KeyOf(program_, name));
  if (own != variables_.end()) return own->second;
  const auto global = variables_.find(KeyOf({}, name));
  return global != variables_.end() ? global->second : ir::VariableId{};
}

bool Resolver::FindAxis(std::string_view name, std::uint8_t& axis) const {
  for (std::size_t i = 0; i < module_.axis_names.size(); ++i) {
    if (IsWord(name, module_.View(module_.axis_names[i]))) {
      axis = static_cast<std::uint8_t>(ir::kFirstNamedAxis + i);
      return true;
    }
  }
  for (const std::string& known : profile_.axes) {
    if (!IsWord(name, known)) continue;
    if (const auto letter = ir::AxisOf(known)) {
      axis = *letter;
      return true;
    }
    if (ir::kFirstNamedAxis + module_.axis_names.size() == ir::kMaxAxes) return false;
    axis = static_cast<std::uint8_t>(ir::kFirstNamedAxis + module_.axis_names.size());
    module_.axis_names.push_back(module_.strings.Intern(known));
    return true;
  }
  return false;
}

bool Resolver::UnknownName(ExprId id, std::string_view name) {
  // The definition has its finding; the blocks that use the name need none.
  const std::string key = UpperOf(name);
  if (refused_names_.contains(key)) return false;
  // One definition is missing, however often the name is used.
  if (const auto known = missing_names_.find(key); known != missing_names_.end()) {
    ++known->second.more;
    return false;
  }
  diag::Diagnostic& finding = sink_.Report(Code::kUnknownName, module_.RangeOf(module_.blocks[block_], id), name);
  std::vector<std::string_view> known;
  for (const auto& [key, variable] : variables_) {
    const ir::Variable& record = module_.variables[variable];
    if (record.owner == program_ || !record.owner.Valid()) known.push_back(module_.View(record.name));
  }
  std::sort(known.begin(), known.end());
  std::string_view near = NearName(name, known);
  const std::string_view address = near.empty() && address_likely_ ? NearAddress(name) : std::string_view();
  if (near.empty()) near = NearValueWord(name);
  const bool is_program = programs_->Find(name).Valid();
  if (is_program || labels_.contains(key)) {
    finding.help = std::string(name) + (is_program ? " is a program" : " is a label") +
                   " here; a name that is handed on is a text and stands in quotes: \"" + std::string(name) + "\"";
  } else if (const auto* system = dialects::sinumerik::FindSystemVariable(key);
             system != nullptr && !dialects::sinumerik::IsUnlistedSystemVariable(key) &&
             !dialects::sinumerik::IsMachineData(key)) {
    finding.help = "did you mean $" + key + "?";
  } else if (const std::string mode = AsModeWithValue(name); !mode.empty()) {
    finding.help = "did you mean " + mode + "?";
  } else if (const std::string split = AsRunTogetherInside(name); !split.empty()) {
    finding.help = "a blank is missing: " + split;
  } else if (!address.empty()) {
    finding.help = "did you mean " + std::string(address) + "? A variable is declared with DEF";
  } else if (!near.empty()) {
    finding.help = "did you mean " + std::string(near) + "?";
  } else if (text_likely_) {
    finding.help = "a text stands in quotes: \"" + std::string(name) + "\"; a variable is declared with DEF";
  } else {
    finding.help = "declare it with DEF, or give the definition file (.DEF) that holds it too";
  }
  missing_names_.emplace(key, Missing{&finding});
  finding.control = dialects::AlarmFor(profile_, finding.code);
  const auto main = std::find_if(variables_.begin(), variables_.end(), [&](const auto& entry) {
    const ir::Variable& record = module_.variables[entry.second];
    return record.scope == Scope::kProgram && IsWord(module_.View(record.name), UpperOf(name));
  });
  if (main != variables_.end()) {
    const ir::Variable& record = module_.variables[main->second];
    finding.notes.push_back({{record.file, record.line, record.begin, record.begin + record.length},
                             "variables of a main program are not visible in its subprograms "
                             "(profile key sinumerik.main-variables-visible, MD11120)"});
  }
  return false;
}

void Resolver::CollectLabels(ir::ProgramId program) {
  labels_.clear();
  for (const ir::BlockId id : module_.programs[program].blocks) {
    const StringId label = module_.blocks[id].label;
    if (label.Valid()) labels_.insert(UpperOf(module_.View(label)));
  }
  jump_names_.clear();
  const auto add = [this](const ir::Target& target) {
    if (target.kind != ir::TargetKind::kLabel || !target.label.Valid()) return;
    const std::string name = UpperOf(module_.View(target.label));
    if (!labels_.contains(name)) jump_names_.insert(name);
  };
  for (const ir::BlockId id : module_.programs[program].blocks) {
    for (const ir::WordId word_id : module_.blocks[id].words) {
      const ir::Word& word = module_.words[word_id];
      if (word.op == WordOp::kJump) add(module_.jumps[word.Extra<ir::JumpId>()].target);
      if (word.op == WordOp::kRepeatPart) add(module_.parts[word.Extra<ir::PartId>()].first);
      if (word.op != WordOp::kSwitch) continue;
      const ir::Switch& record = module_.switches[word.Extra<ir::SwitchId>()];
      for (std::uint32_t i = 0; i < record.arm_count; ++i)
        add(module_.jumps[module_.switch_arms[record.first_arm + i].jump].target);
    }
  }
}

// Names that a refused DEF or PROC may have declared.
void Resolver::CollectRefusedNames(ir::ProgramId program) {
  refused_names_.clear();
  for (const ir::BlockId id : module_.programs[program].blocks) {
    const ir::Block& block = module_.blocks[id];
    if (block.words.Empty() || module_.words[block.words[0]].op != WordOp::kVerbatim) continue;
    const std::string text = UpperOf(module_.View(module_.words[block.words[0]].Extra<StringId>()));
    // Also the second line of a list of parameters that was broken in two.
    bool declares = text.starts_with("DEF") || text.starts_with("PROC");
    for (const auto& row : dialects::sinumerik::Types()) declares = declares || text.starts_with(row.text);
    if (!declares) continue;
    std::string name;
    for (const char c : text + " ") {
      if (IsLetter(c) || IsDigit(c) || c == '_') {
        name += c;
      } else if (!name.empty()) {
        refused_names_.insert(std::move(name));
        name.clear();
      }
    }
  }
}

void Resolver::Program(ir::ProgramId program) {
  program_ = program;
  CollectLabels(program);
  CollectRefusedNames(program);
  missing_names_.clear();
  externs_.clear();
  for (const ir::BlockId id : module_.programs[program].blocks) {
    if (!module_.blocks[id].words.Empty()) Block(id);
  }
  CountMissingNames();
}

void Resolver::CountMissingNames() {
  for (const auto& [name, missing] : missing_names_) {
    if (missing.more == 0) continue;
    const bool one = missing.more == 1;
    missing.finding->notes.push_back(
        {{}, std::to_string(missing.more) + (one ? " more block uses it" : " more blocks use it")});
  }
}

void Resolver::Block(ir::BlockId id) {
  block_ = id;
  bool ok = true;
  for (const ir::WordId word_id : module_.blocks[id].words) {
    // The store may grow while a word is resolved, so a copy is worked on.
    ir::Word word = module_.words[word_id];
    ok = Word(word);
    module_.words[word_id] = word;
    if (!ok) break;
  }
  ok = ok && (module_.programs[program_].library || BlockRules(module_.blocks[id]));
  if (!ok) Refuse(module_.blocks[id]);
}

// The block becomes its text; names in it lead nowhere.
void Resolver::Refuse(ir::Block& block) {
  const ir::Origin& origin = module_.origins[block.origin];
  const std::string_view line = files_.Line(origin.file, origin.line);
  const ir::Word& first = module_.words[block.words[0]];
  const ir::Word& last = module_.words[block.words[block.words.count - 1]];
  ir::Word word;
  word.op = WordOp::kVerbatim;
  word.index = ir::IsStructureMark(first.op) ? static_cast<std::uint8_t>(first.op) : 0;
  word.begin = first.begin;
  word.length = last.begin + last.length - first.begin;
  word.extra = module_.strings.Intern(line.substr(word.begin, word.length)).value;
  block.words = {module_.words.Add(word).value, 1};
  block.flags |= ir::Block::kRefused;
}

bool Resolver::Word(ir::Word& word) {
  switch (word.op) {
    case WordOp::kAssign: {
      const ExprId place = word.Extra<ExprId>();
      const ir::Expr& expr = module_.exprs[place];
      std::uint8_t axis = 0;
      // An axis that only the machine's list knows by its name: `AX1=10`.
      if (expr.op == ir::ExprOp::kName && expr.count == 0) {
        const std::string_view name = module_.View(StringId{std::size_t{expr.a}});
        if (!FindVariable(name).Valid() && FindAxis(name, axis)) {
          module_.exprs[place].op = ir::ExprOp::kAxisName;
          module_.exprs[place].type = Type::kAxis;
          module_.exprs[place].a = axis;
          word.op = WordOp::kAxis;
          word.index = axis;
          word.extra = Id<void>::kNone;
          word.phase = ir::DefaultPhaseOf(WordOp::kAxis);
          return Number(word.value);
        }
      }
      address_likely_ = true;
      const bool known = Place(place);
      address_likely_ = false;
      return known && Converted(word.value, module_.exprs[place].type);
    }
    case WordOp::kAssignList:
      return List(word.Extra<ir::AssignListId>(), module_.assign_lists[word.Extra<ir::AssignListId>()].place, {});
    case WordOp::kExtern:
      externs_.insert(UpperOf(module_.View(module_.externs[word.Extra<ir::ExternId>()].name)));
      return true;
    case WordOp::kDefine:
      return Define(word.Extra<ir::VariableId>());
    case WordOp::kHeader:
      return Parameters(word.Extra<ir::ProgramId>());
    case WordOp::kAxisComputed: {
      const ExprId axis = word.Extra<ExprId>();
      if (!Scalar(axis)) return false;
      const Type type = module_.exprs[axis].type;
      if (type == Type::kString || type == Type::kFrame) return Mismatch(axis, "a text", "an axis");
      return Number(word.value);
    }
    case WordOp::kMessage: {
      const ExprId mode = word.Extra<ExprId>();
      return (!word.value.Valid() || ScalarOrText(word.value)) && (!mode.Valid() || Scalar(mode));
    }
    case WordOp::kAlarm: {
      const ExprId text = word.Extra<ExprId>();
      return Converted(word.value, Type::kInt) && (!text.Valid() || Scalar(text));
    }
    case WordOp::kJump:
      return (!word.value.Valid() || Condition(word.value)) && Jump(word.Extra<ir::JumpId>());
    case WordOp::kSwitch:
      return Converted(word.value, Type::kInt) && Switch(word.Extra<ir::SwitchId>());
    case WordOp::kCall:
    case WordOp::kModalCall:
    case WordOp::kWorkpiece:
      return !word.Extra<ir::CallId>().Valid() || Call(word);
    case WordOp::kRepeatPart:
      return (!word.value.Valid() || Converted(word.value, Type::kInt)) && Part(word.Extra<ir::PartId>());
    case WordOp::kReturn:
      return !word.value.Valid() || Scalar(word.value);
    case WordOp::kIf:
    case WordOp::kWhile:
    case WordOp::kUntil:
    case WordOp::kWhen:
      return Condition(word.value);
    case WordOp::kFor: {
      ir::For record = module_.fors[word.Extra<ir::ForId>()];
      const bool ok =
          Place(record.variable) && Converted(word.value, module_.exprs[record.variable].type) && Number(record.end);
      module_.fors[word.Extra<ir::ForId>()] = record;
      return ok;
    }
    case WordOp::kTool:
      if (!ScalarOrText(word.value)) return false;
      return module_.exprs[word.value].type == Type::kString || Fits(word.value, Type::kInt);
    case WordOp::kEdge:
    case WordOp::kComputedM:
    case WordOp::kComputedG:
    case WordOp::kTurns:
      return Converted(word.value, Type::kInt);
    default:
      return !word.value.Valid() || Number(word.value);
  }
}

bool Resolver::Define(ir::VariableId id) {
  ir::Variable variable = module_.variables[id];
  const Type type = variable.type;
  bool ok = true;
  defined_ = id;
  if (variable.initial.Valid()) ok = Converted(variable.initial, type);
  if (ok && variable.lower_limit.Valid()) ok = Number(variable.lower_limit);
  if (ok && variable.upper_limit.Valid()) ok = Number(variable.upper_limit);
  module_.variables[id] = variable;
  ok = ok && (!variable.initial_list.Valid() || List(variable.initial_list, {}, id));
  if (ok && variable.initial_list.Valid()) Surplus(variable);
  defined_ = {};
  return ok;
}

// Card 3.5: what the control does with more values than elements is not certain.
void Resolver::Surplus(const ir::Variable& variable) {
  const ir::AssignList& list = module_.assign_lists[variable.initial_list];
  std::uint64_t elements = 1;
  for (std::uint8_t i = 0; i < variable.dimension_count; ++i) elements *= variable.dimensions[i];
  if (list.repeat || elements == 0 || list.values.count <= elements) return;
  const ExprId first = module_.expr_items[list.values.begin + elements];
  if (!first.Valid()) return;
  sink_
      .ReportAs(diag::Severity::kWarning, Code::kArrayIndex, module_.RangeOf(module_.blocks[block_], first), elements,
                module_.View(variable.name), elements - 1)
      .help = "the array has " + std::to_string(elements) + (elements == 1 ? " element, " : " elements, ") +
              std::to_string(list.values.count) + " values are given";
}

bool Resolver::Parameters(ir::ProgramId program) {
  for (const ir::VariableId id : module_.programs[program].parameters) {
    if (!Define(id)) return false;
  }
  return true;
}

bool Resolver::List(ir::AssignListId id, ExprId place, ir::VariableId whole) {
  ir::AssignList list = module_.assign_lists[id];
  Type type = whole.Valid() ? module_.variables[whole].type : Type::kAny;
  if (place.Valid()) {
    if (!Place(place)) return false;
    type = module_.exprs[place].type;
  }
  for (const ir::ExprItemId item : list.values) {
    ExprId value = module_.expr_items[item.value];
    if (!value.Valid()) continue;
    if (!Converted(value, type)) return false;
    module_.expr_items[item.value] = value;
  }
  if (list.count.Valid() && !Converted(list.count, Type::kInt)) return false;
  module_.assign_lists[id] = list;
  return true;
}

bool Resolver::Jump(ir::JumpId id) {
  ir::Target target = module_.jumps[id].target;
  const bool ok = Target(target, true);
  module_.jumps[id].target = target;
  return ok;
}

// A name that is no label but a STRING variable holds the target (card 6.1).
bool Resolver::Target(ir::Target& target, bool own_program) {
  if (target.kind == ir::TargetKind::kExpression) return Scalar(target.expr);
  if (target.kind != ir::TargetKind::kLabel || !target.label.Valid()) return true;
  const std::string_view name = module_.View(target.label);
  if (own_program && labels_.contains(UpperOf(name))) return true;
  const ir::VariableId variable = FindVariable(name);
  if (!variable.Valid() || module_.variables[variable].type != Type::kString) return true;
  ir::Expr expr;
  expr.op = ir::ExprOp::kVariable;
  expr.type = Type::kString;
  expr.a = variable.value;
  expr.b = Id<void>::kNone;
  target.kind = ir::TargetKind::kExpression;
  target.expr = module_.AddExpr(expr);
  target.label = {};
  return true;
}

bool Resolver::Part(ir::PartId id) {
  ir::Part part = module_.parts[id];
  const bool ok = Target(part.first, true) && (!part.has_last || Target(part.last, true));
  module_.parts[id] = part;
  return ok;
}

bool Resolver::Switch(ir::SwitchId id) {
  const ir::Switch record = module_.switches[id];
  for (std::uint32_t i = 0; i < record.arm_count; ++i) {
    ir::SwitchArm arm = module_.switch_arms[record.first_arm + i];
    if (arm.value.Valid() && !Converted(arm.value, Type::kInt)) return false;
    module_.switch_arms[record.first_arm + i] = arm;
    if (!Jump(arm.jump)) return false;
  }
  return true;
}

}  // namespace ncport::frontend::sinumerik
