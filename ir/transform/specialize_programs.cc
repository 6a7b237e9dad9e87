#include "ir/transform/specialize_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "ir/analysis/flow_analyses.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/structure.h"
#include "ir/transform/constant_values.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/transform/word_exprs.h"

namespace ncport::ir::transform {

namespace {

/// The value of each parameter where all is known of it; none: it stays a parameter.
using Given = std::vector<std::optional<double>>;

class Pass {
 public:
  Pass(Module& module, const Machine& machine, const ModalState& entry)
      : module_(module), machine_(machine), entry_(entry), make_(module) {}

  void Run() {
    SplitCalls();
    if (specialized_.empty()) return;
    const analysis::FlowAnalyses analyses(module_, machine_, {machine_.start, entry_});
    std::set<std::uint32_t> modal;
    for (const analysis::CallSite& site : analyses.Calls().AllSites()) {
      if (site.modal && site.callee.Valid() && machine_.modal_call_keeps_locals) modal.insert(site.callee.value);
    }
    for (const ProgramId program : specialized_)
      Fit(program, analyses.Graphs().Of(program), analyses.Modal(), modal.contains(program.value));
    DropParameters();
  }

 private:
  // One program for each set of constants.
  void SplitCalls();
  [[nodiscard]] bool CanFollow(ProgramId program) const;
  [[nodiscard]] Given GivenBy(const Call& call, bool modal) const;
  [[nodiscard]] std::set<std::uint32_t> NamedIn(ProgramId program) const;
  void Bind(ProgramId from, ProgramId program, const Given& given);
  // What is left of one.
  void Fit(ProgramId program, const analysis::Cfg& cfg, const analysis::ModalFlow& flow, bool keeps_locals);
  void DropParameters();
  [[nodiscard]] SystemConstant SystemAt(ProgramId program, const analysis::ModalFlow& flow) const;
  [[nodiscard]] bool Rewrite(BlockId id, const ConstantValues& values, Block& block);
  ExprId Folded(const ConstantValues& values, BlockId block, std::uint32_t word, ExprId root);
  ExprId Simplified(ExprId id);
  void DropUnused(ProgramId program);
  [[nodiscard]] bool IsRemovable(ExprId value) const;
  void Title(ProgramId program);

  Module& module_;
  const Machine& machine_;
  const ModalState& entry_;
  ExprBuilder make_;
  std::vector<ProgramId> specialized_;
  std::unordered_map<std::uint32_t, std::string> titles_;  // ProgramId
};

/// Variables that the blocks of the program name.
std::set<std::uint32_t> Pass::NamedIn(ProgramId program) const {
  std::set<std::uint32_t> named;
  for (const BlockId block : module_.programs[program].blocks) {
    for (const WordId id : module_.blocks[block].words) {
      VisitWordExprs(module_, module_.words[id], [&](ExprId root, bool) {
        VisitReads(module_, root, [&](ExprId node) {
          const Expr& expr = module_.exprs[node];
          if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) named.insert(expr.a);
        });
      });
    }
  }
  return named;
}

/// Parameters that nothing names any more, where their arguments have no effect.
void Pass::DropParameters() {
  for (const ProgramId program : specialized_) {
    const std::set<std::uint32_t> named = NamedIn(program);
    const IdRange<VariableId> old = module_.programs[program].parameters;
    std::vector<std::uint8_t> stays(old.count, 1);
    std::vector<CallId> calls;
    for (std::uint32_t i = 0; i < module_.calls.Size(); ++i) {
      if (module_.calls[CallId{i}].program == program) calls.push_back(CallId{i});
    }
    for (std::uint32_t i = 0; i < old.count; ++i) {
      bool idle = !named.contains(old[i].value);
      for (const CallId id : calls) {
        for (const ArgId arg : module_.calls[id].args) {
          const Arg& given = module_.args[arg];
          idle =
              idle && (given.position != i || !given.value.Valid() || LiteralValue(module_, given.value).has_value());
        }
      }
      stays[i] = idle ? 0 : 1;
    }
    const auto before = [&](std::uint32_t position) {
      return static_cast<std::uint16_t>(std::count(stays.begin(), stays.begin() + position, 1));
    };
    IdRange<VariableId> parameters{static_cast<std::uint32_t>(module_.variables.Size()), before(old.count)};
    if (parameters.count == old.count) continue;
    std::unordered_map<std::uint32_t, VariableId> twins;
    for (std::uint32_t i = 0; i < old.count; ++i) {
      if (stays[i] == 0) continue;
      const Variable copy = module_.variables[old[i]];
      twins[old[i].value] = module_.variables.Add(copy);
    }
    module_.programs[program].parameters = parameters;
    RewriteProgram(module_, program, [&](Module& module, ExprId id) {
      const Expr expr = module.exprs[id];
      if (expr.op != ExprOp::kVariable) return id;
      const auto twin = twins.find(expr.a);
      return twin == twins.end() ? id : ExprBuilder(module).Variable(twin->second);
    });
    for (const CallId id : calls) {
      std::vector<Arg> args;
      for (const ArgId arg : module_.calls[id].args) {
        Arg given = module_.args[arg];
        if (given.position >= old.count || stays[given.position] == 0) continue;
        given.position = before(given.position);
        args.push_back(given);
      }
      module_.calls[id].args = {static_cast<std::uint32_t>(module_.args.Size()),
                                static_cast<std::uint32_t>(args.size())};
      for (const Arg& arg : args) module_.args.Add(arg);
    }
  }
}

/// `modal`: a parameter that the program writes keeps that for the next run, so it is no constant.
Given Pass::GivenBy(const Call& call, bool modal) const {
  const IdRange<VariableId> parameters = module_.programs[call.program].parameters;
  Given given(parameters.count);
  for (std::uint32_t i = 0; i < parameters.count; ++i) {
    const Variable& parameter = module_.variables[parameters[i]];
    ExprId value = parameter.initial;
    for (const ArgId arg : call.args) {
      if (module_.args[arg].position == i && module_.args[arg].value.Valid()) value = module_.args[arg].value;
    }
    given[i] = value.Valid() ? LiteralValue(module_, value) : std::optional(0.0);
    // A whole number that is not one is an alarm or rounds: it stays where that happens.
    if (parameter.type != Type::kReal && given[i] && *given[i] != std::floor(*given[i])) given[i].reset();
  }
  if (!modal || !machine_.modal_call_keeps_locals) return given;
  const analysis::LabelTable labels(module_, call.program);
  const analysis::Cfg cfg(module_, call.program, labels, false);
  for (bool changed = true; changed;) {
    ConstantState entry;
    for (std::uint32_t i = 0; i < parameters.count; ++i) {
      if (given[i]) entry[parameters[i].value] = {module_.variables[parameters[i]].type, *given[i]};
    }
    const ConstantValues values(
        module_, machine_, call.program, cfg, true,
        [](BlockId, const System&, double) -> std::optional<ConstantValue> { return std::nullopt; }, entry);
    const std::set<std::uint32_t> written = values.Written();
    changed = false;
    for (std::uint32_t i = 0; i < parameters.count; ++i) {
      if (!given[i] || !written.contains(parameters[i].value)) continue;
      given[i].reset();
      changed = true;
    }
  }
  return given;
}

/// Scalar numbers by value, no calls, no texts, no parts that run again: what the standard cycles are made of.
bool Pass::CanFollow(ProgramId program) const {
  const Program& record = module_.programs[program];
  for (const VariableId id : record.parameters) {
    const Variable& parameter = module_.variables[id];
    const bool number = parameter.type == Type::kReal || parameter.type == Type::kInt || parameter.type == Type::kBool;
    if (!number || parameter.by_reference || parameter.dimension_count > 0 || parameter.lower_limit.Valid() ||
        parameter.upper_limit.Valid())
      return false;
  }
  for (const BlockId block : record.blocks) {
    if ((module_.blocks[block].flags & Block::kRefused) != 0) return false;
    for (const WordId id : module_.blocks[block].words) {
      const Word& word = module_.words[id];
      switch (word.op) {
        case WordOp::kCall:
        case WordOp::kModalCall:
        case WordOp::kSwitch:
        case WordOp::kRepeatPart:
        case WordOp::kRestart:
        case WordOp::kAssignList:
        case WordOp::kVerbatim:
          return false;
        case WordOp::kJump:
          if (module_.jumps[word.Extra<JumpId>()].target.kind == TargetKind::kExpression) return false;
          break;
        default:
          break;
      }
      bool asks = false;
      VisitWordExprs(module_, word, [&](ExprId root, bool) {
        VisitReads(module_, root, [&](ExprId read) {
          const Expr& expr = module_.exprs[read];
          asks = asks ||
                 (expr.op == ExprOp::kSystem && module_.systems[SystemId{expr.a}].kind == SystemKind::kWasProgrammed);
        });
      });
      if (asks) return false;
    }
  }
  return true;
}

/// `program` becomes `from` with new variables; a parameter with a value is a local that starts with it.
void Pass::Bind(ProgramId from, ProgramId program, const Given& given) {
  const Program source = module_.programs[from];
  std::unordered_map<std::uint32_t, VariableId> twins;
  const auto copy = [&](VariableId id) {
    Variable variable = module_.variables[id];
    variable.owner = program;
    twins[id.value] = module_.variables.Add(variable);
    return twins[id.value];
  };
  IdRange<VariableId> parameters{static_cast<std::uint32_t>(module_.variables.Size()), 0};
  for (std::uint32_t i = 0; i < source.parameters.count; ++i) {
    if (given[i]) continue;
    copy(source.parameters[i]);
    ++parameters.count;
  }
  std::vector<Word> definitions;
  std::string title(module_.View(source.name));
  for (std::uint32_t i = 0; i < source.parameters.count; ++i) {
    const std::string_view name = module_.View(module_.variables[source.parameters[i]].name);
    if (!given[i]) {
      title += fmt::format(" {}=..", name);
      continue;
    }
    if (*given[i] != 0) title += fmt::format(" {}={:g}", name, *given[i]);
    const VariableId id = copy(source.parameters[i]);
    module_.variables[id].scope = Scope::kLocal;
    module_.variables[id].initial = make_.Literal(*given[i], module_.variables[id].type);
    definitions.push_back(MakeWord(WordOp::kDefine, 0, {}, id.value));
  }
  titles_[program.value] = title;
  const std::size_t known = module_.variables.Size();
  for (std::uint32_t i = 0; i < known; ++i) {
    const VariableId id{i};
    if (module_.variables[id].owner == from && module_.variables[id].scope != Scope::kParameter && from != program)
      copy(id);
  }
  // The blocks, with records of their own.
  ProgramEditor editor(module_, from, "specialize_programs");
  std::vector<Block> blocks;
  Block start = editor.MakeBlock(source.blocks[0]);
  start.indent = 0;
  editor.SetWords(start, definitions);
  blocks.push_back(start);
  for (const BlockId id : source.blocks) {
    Block block = module_.blocks[id];
    std::vector<Word> words;
    for (const WordId word_id : block.words) {
      Word word = module_.words[word_id];
      if (word.op == WordOp::kHeader) continue;  // its parameters are others now
      if (word.op == WordOp::kFor) {
        const For loop = module_.fors[word.Extra<ForId>()];
        word.extra = module_.fors.Add(loop).value;
      }
      if (word.op == WordOp::kJump) {
        const Jump jump = module_.jumps[word.Extra<JumpId>()];
        word.extra = module_.jumps.Add(jump).value;
      }
      if (word.op == WordOp::kDefine && twins.contains(word.extra)) word.extra = twins[word.extra].value;
      words.push_back(word);
    }
    editor.SetWords(block, words);
    block.comments = {};
    blocks.push_back(block);
  }
  IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()), static_cast<std::uint32_t>(blocks.size())};
  for (const Block& block : blocks) module_.blocks.Add(block);
  module_.programs[program].blocks = range;
  module_.programs[program].parameters = parameters;
  RewriteProgram(module_, program, [&](Module& module, ExprId id) {
    const Expr expr = module.exprs[id];
    if (expr.op != ExprOp::kVariable && expr.op != ExprOp::kElement) return id;
    const auto twin = twins.find(expr.a);
    if (twin == twins.end()) return id;
    Expr copy_of = expr;
    copy_of.a = twin->second.value;
    return module.AddExpr(copy_of, module.expr_places.Of(id));
  });
  diag::Sink quiet;
  BuildStructure(module_, program, 0, quiet);
}

void Pass::SplitCalls() {
  std::map<std::pair<std::uint32_t, std::vector<double>>, ProgramId> known;
  std::map<std::uint32_t, int> copies;
  std::map<std::uint32_t, Given> firsts;  // the first set of a cycle takes the place of its text, once all are copied
  std::vector<std::pair<CallId, Given>> calls;
  for (const ProgramId caller : module_.programs.Ids()) {
    for (const BlockId block : module_.programs[caller].blocks) {
      for (const WordId id : module_.blocks[block].words) {
        const Word& word = module_.words[id];
        if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
        const auto call_id = word.Extra<CallId>();
        if (!call_id.Valid() || !module_.calls[call_id].program.Valid()) continue;
        const Call& call = module_.calls[call_id];
        if (!module_.programs[call.program].library || call.form == CallForm::kBlockRange) continue;
        calls.emplace_back(call_id, GivenBy(call, word.op == WordOp::kModalCall));
      }
    }
  }
  std::map<std::uint32_t, bool> follows;
  for (auto& [call_id, given] : calls) {
    Call call = module_.calls[call_id];
    const ProgramId cycle = call.program;
    const auto [follow, first] = follows.try_emplace(cycle.value, false);
    if (first) follow->second = CanFollow(cycle);
    if (!follow->second) continue;
    std::vector<double> key;
    for (const std::optional<double>& value : given) {
      key.push_back(value ? 1 : 0);
      key.push_back(value.value_or(0));
    }
    const auto [place, added] = known.try_emplace({cycle.value, key});
    if (added) {
      const int number = ++copies[cycle.value];
      place->second = cycle;
      if (number == 1) {
        firsts[cycle.value] = given;
      } else {
        Program record = module_.programs[cycle];
        record.name = module_.strings.Intern(fmt::format("{}_{}", module_.View(record.name), number));
        place->second = module_.programs.Add(record);
        Bind(cycle, place->second, given);
      }
      specialized_.push_back(place->second);
    }
    // The arguments that are left move up.
    std::vector<Arg> args;
    for (const ArgId id : call.args) {
      Arg arg = module_.args[id];
      if (arg.position >= given.size() || given[arg.position]) continue;
      const auto gone = std::count_if(given.begin(), given.begin() + arg.position,
                                      [](const std::optional<double>& value) { return value.has_value(); });
      arg.position = static_cast<std::uint16_t>(arg.position - gone);
      args.push_back(arg);
    }
    call.args = {static_cast<std::uint32_t>(module_.args.Size()), static_cast<std::uint32_t>(args.size())};
    for (const Arg& arg : args) module_.args.Add(arg);
    call.program = place->second;
    call.name = module_.programs[place->second].name;
    module_.calls[call_id] = call;
  }
  for (const auto& [cycle, given] : firsts) Bind(ProgramId{cycle}, ProgramId{cycle}, given);
}

SystemConstant Pass::SystemAt(ProgramId program, const analysis::ModalFlow& flow) const {
  return [this, program, &flow](BlockId block, const System& system, double index) -> std::optional<ConstantValue> {
    const ModalState state = flow.At(program, block);
    switch (system.kind) {
      case SystemKind::kPlaneAxis: {
        if (state.plane == Plane::kUnknown) return std::nullopt;
        const PlaneAxes axes = AxesOf(state.plane);
        const std::uint8_t axis = system.number == 1 ? axes.first : system.number == 2 ? axes.second : axes.normal;
        return ConstantValue{Type::kAxis, static_cast<double>(axis)};
      }
      case SystemKind::kModalCallActive:
        switch (flow.ModalCallBefore(program, block)) {
          case analysis::ModalFlow::ModalCall::kNone:
            return ConstantValue{Type::kInt, 0};
          case analysis::ModalFlow::ModalCall::kActive:
            return ConstantValue{Type::kInt, 1};
          case analysis::ModalFlow::ModalCall::kUnknown:
            return std::nullopt;
        }
        return std::nullopt;
      case SystemKind::kModalGroup: {
        for (const GroupCode& row : machine_.groups) {
          if (row.group != index) continue;
          if (row.op != WordOp::kUnits) return std::nullopt;
          if (row.index != 0 && row.index == static_cast<std::uint8_t>(state.units))
            return ConstantValue{Type::kInt, row.code};
        }
        return std::nullopt;
      }
      default:
        return std::nullopt;
    }
  };
}

/// The expression with its constant parts as numbers, where digits can say them exactly.
ExprId Pass::Folded(const ConstantValues& values, BlockId block, std::uint32_t word, ExprId root) {
  if (!root.Valid()) return root;
  const Expr expr = module_.exprs[root];
  if (expr.op == ExprOp::kLiteral || expr.op == ExprOp::kAxisName || expr.op == ExprOp::kText) return root;
  if (const auto value = values.EvaluateAt(block, word, root)) {
    if (value->type == Type::kAxis) return make_.AxisName(static_cast<std::uint8_t>(value->number));
    // Eight digits are what every control of the targets keeps.
    double read = 0;
    const std::string digits = fmt::format("{:.8g}", value->number);
    std::from_chars(digits.data(), digits.data() + digits.size(), read);
    if (read == value->number && digits.find('e') == std::string::npos) {
      const ExprId literal = make_.Literal(std::fabs(value->number), value->type);
      return value->number < 0 ? make_.Unary(ExprOp::kNegate, literal) : literal;
    }
  }
  // Parts of it; the node itself is made anew only if one of them changed.
  Expr made = expr;
  bool changed = false;
  const auto part = [&](std::uint32_t child) {
    const ExprId folded = Folded(values, block, word, ExprId{child});
    changed = changed || folded.value != child;
    return folded.value;
  };
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return root;
    case Operands::kUnary:
      made.a = part(expr.a);
      break;
    case Operands::kBinary: {
      // A side that does not decide alone leaves the other one.
      const auto truth = [&](std::uint32_t child) { return values.EvaluateAt(block, word, ExprId{child}); };
      if (expr.op == ExprOp::kAnd || expr.op == ExprOp::kOr) {
        const double idle = expr.op == ExprOp::kAnd ? 1 : 0;
        if (const auto left = truth(expr.a); left && left->number == idle)
          return Folded(values, block, word, ExprId{expr.b});
        if (const auto right = truth(expr.b); right && right->number == idle)
          return Folded(values, block, word, ExprId{expr.a});
      }
      made.a = part(expr.a);
      made.b = part(expr.b);
      break;
    }
    case Operands::kList: {
      std::vector<ExprId> items;
      for (std::uint32_t i = 0; i < expr.count; ++i) items.push_back(ExprId{part(module_.Item(expr.b + i).value)});
      if (!changed) break;
      made.b = static_cast<std::uint32_t>(module_.expr_items.size());
      module_.expr_items.insert(module_.expr_items.end(), items.begin(), items.end());
      break;
    }
  }
  return changed ? Simplified(module_.AddExpr(made, module_.expr_places.Of(root))) : root;
}

/// Without the steps that a constant made idle: 0+x, x-0, 1*x, x/1; x-(-c) is x+c, x+(-c) is x-c, -1*x is -x. All of
/// them give the same double.
ExprId Pass::Simplified(ExprId id) {
  const Expr expr = module_.exprs[id];
  if (OperandsOf(expr.op) != Operands::kBinary) return id;
  const ExprId a{expr.a}, b{expr.b};
  const auto left = LiteralValue(module_, a), right = LiteralValue(module_, b);
  // A whole number in a place of a real one counts as real from here on.
  const auto alone = [&](ExprId rest) {
    return module_.exprs[rest].type == expr.type || module_.exprs[rest].type == Type::kReal ? rest : id;
  };
  const auto negated = [&](ExprId rest) { return alone(rest) == rest ? make_.Unary(ExprOp::kNegate, rest) : id; };
  const auto swapped = [&](ExprOp op) {
    Expr made = expr;
    made.op = op;
    made.b = make_.Literal(-*right, module_.exprs[b].type).value;
    return module_.AddExpr(made, module_.expr_places.Of(id));
  };
  switch (expr.op) {
    case ExprOp::kAdd:
      if (left && *left == 0) return alone(b);
      if (right && *right == 0) return alone(a);
      return right && *right < 0 ? swapped(ExprOp::kSubtract) : id;
    case ExprOp::kSubtract:
      if (right && *right == 0) return alone(a);
      return right && *right < 0 ? swapped(ExprOp::kAdd) : id;
    case ExprOp::kMultiply:
      if (left && *left == 1) return alone(b);
      if (right && *right == 1) return alone(a);
      if (left && *left == -1) return negated(b);
      return right && *right == -1 ? negated(a) : id;
    case ExprOp::kDivide:
      return right && *right == 1 ? alone(a) : id;
    default:
      return id;
  }
}

/// Words of the block with what is known in them; false: nothing is left of a block that had words.
bool Pass::Rewrite(BlockId id, const ConstantValues& values, Block& block) {
  std::vector<Word> words;
  const IdRange<WordId> old = block.words;
  for (std::uint32_t i = 0; i < old.count; ++i) {
    Word word = module_.words[old[i]];
    if (word.op == WordOp::kDefine) {
      words.push_back(word);
      continue;
    }
    if (word.op == WordOp::kJump && word.value.Valid()) {
      if (const auto holds = values.EvaluateAt(id, i, word.value)) {
        if (holds->number == 0) continue;
        word.value = {};
      }
    }
    word.value = Folded(values, id, i, word.value);
    if (word.op == WordOp::kAxisComputed) {
      const auto axis = values.EvaluateAt(id, i, word.Extra<ExprId>());
      if (axis && axis->type == Type::kAxis) {
        word.op = WordOp::kAxis;
        word.index = static_cast<std::uint8_t>(axis->number);
        word.extra = Id<void>::kNone;
        word.spelling = 0;
      }
    }
    if (word.op == WordOp::kFor) {
      For loop = module_.fors[word.Extra<ForId>()];
      loop.end = Folded(values, id, i, loop.end);
      loop.step = Folded(values, id, i, loop.step);
      module_.fors[word.Extra<ForId>()] = loop;
    }
    words.push_back(word);
  }
  SetWords(module_, block, words);
  return !words.empty() || old.Empty();
}

/// Without effect when it is not worked out: the reads of the standard cycles are of the modal state.
bool Pass::IsRemovable(ExprId value) const {
  const Expr& expr = module_.exprs[value];
  if (expr.op == ExprOp::kDivide || expr.op == ExprOp::kDivideInteger || expr.op == ExprOp::kModulo) return false;
  if (expr.op == ExprOp::kFunction || expr.op == ExprOp::kElement || expr.op == ExprOp::kCellAt) return false;
  if (expr.op == ExprOp::kSystem) {
    const SystemKind kind = module_.systems[SystemId{expr.a}].kind;
    return kind == SystemKind::kActiveFeed || kind == SystemKind::kPlaneAxis || kind == SystemKind::kModalGroup;
  }
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
    case Operands::kList:
      return true;
    case Operands::kUnary:
      return IsRemovable(ExprId{expr.a});
    case Operands::kBinary:
      return IsRemovable(ExprId{expr.a}) && IsRemovable(ExprId{expr.b});
  }
  return false;
}

/// Assignments of variables that nothing reads, and definitions of those that nothing names.
void Pass::DropUnused(ProgramId program) {
  for (bool changed = true; changed;) {
    changed = false;
    std::set<std::uint32_t> read, written;
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    for (const BlockId id : blocks) {
      for (const WordId word_id : module_.blocks[id].words) {
        const Word& word = module_.words[word_id];
        VisitWordExprs(module_, word, [&](ExprId root, bool place) {
          VisitReads(module_, root, [&](ExprId node) {
            const Expr& expr = module_.exprs[node];
            if (expr.op != ExprOp::kVariable && expr.op != ExprOp::kElement) return;
            (place && node == root && word.op == WordOp::kAssign ? written : read).insert(expr.a);
          });
        });
      }
    }
    ProgramEditor editor(module_, program, "specialize_programs");
    for (const BlockId id : blocks) {
      Block block = module_.blocks[id];
      std::vector<Word> kept;
      for (const WordId word_id : block.words) {
        const Word word = module_.words[word_id];
        if (word.op == WordOp::kAssign) {
          const Expr& place = module_.exprs[word.Extra<ExprId>()];
          if (place.op == ExprOp::kVariable && module_.variables[VariableId{place.a}].owner == program &&
              !read.contains(place.a) && IsRemovable(word.value))
            continue;
        }
        if (word.op == WordOp::kDefine && !read.contains(word.extra) && !written.contains(word.extra)) continue;
        kept.push_back(word);
      }
      if (kept.size() == block.words.count) continue;
      changed = true;
      if (kept.empty()) {
        editor.Remove(id);
        continue;
      }
      editor.SetWords(block, kept);
      module_.blocks[id].words = block.words;
    }
    editor.Apply();
  }
}

/// What the text was made for, in its first line.
void Pass::Title(ProgramId program) {
  const IdRange<BlockId> old = module_.programs[program].blocks;
  Block first = ProgramEditor(module_, program, "specialize_programs").MakeBlock(old[0]);
  first.indent = 0;
  Comment comment;
  comment.text = module_.strings.Intern(titles_[program.value]);
  comment.place = CommentPlace::kOwnLine;
  first.comments = {static_cast<std::uint32_t>(module_.comments.Size()), 1};
  module_.comments.Add(comment);
  IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()), old.count + 1};
  module_.blocks.Add(first);
  for (const BlockId id : old) {
    const Block copy = module_.blocks[id];
    module_.blocks.Add(copy);
  }
  module_.programs[program].blocks = range;
  diag::Sink quiet;
  BuildStructure(module_, program, 0, quiet);
}

void Pass::Fit(ProgramId program, const analysis::Cfg& cfg, const analysis::ModalFlow& flow, bool keeps_locals) {
  const ConstantValues values(module_, machine_, program, cfg, keeps_locals, SystemAt(program, flow));
  const IdRange<BlockId> old = module_.programs[program].blocks;
  std::vector<Block> blocks;
  std::vector<std::uint8_t> marks_stay;  // per open structure
  for (const BlockId id : old) {
    Block block = module_.blocks[id];
    const bool reached = values.Reached(id);
    const Word* word = block.words.count == 1 ? &module_.words[block.words[0]] : nullptr;
    bool stays = reached;
    if (word != nullptr && IsStructureMark(word->op)) {
      switch (word->op) {
        case WordOp::kIf:
          marks_stay.push_back(
              reached && (block.skip_level != Block::kNoSkip || !values.Evaluate(id, word->value)) ? 1 : 0);
          stays = marks_stay.back() != 0;
          break;
        case WordOp::kWhile:
        case WordOp::kFor:
        case WordOp::kLoop:
        case WordOp::kRepeat:
          marks_stay.push_back(reached ? 1 : 0);
          stays = reached;
          break;
        case WordOp::kElse:
          stays = marks_stay.back() != 0;
          break;
        default:
          stays = marks_stay.back() != 0;
          marks_stay.pop_back();
      }
    }
    if (stays && reached) stays = Rewrite(id, values, block);
    if (!stays) {
      if (!block.label.Valid() && block.number == Block::kNoNumber) continue;
      block.words = {};
    }
    if (block.words.Empty() && !block.label.Valid() && block.number == Block::kNoNumber) continue;
    blocks.push_back(block);
  }
  IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()), static_cast<std::uint32_t>(blocks.size())};
  for (const Block& block : blocks) module_.blocks.Add(block);
  module_.programs[program].blocks = range;
  diag::Sink quiet;
  BuildStructure(module_, program, 0, quiet);
  DropUnused(program);
  if (!module_.programs[program].blocks.Empty()) Title(program);
}

}  // namespace

void SpecializePrograms(Module& module, const Machine& source, const ModalState& entry) {
  Pass(module, source, entry).Run();
}

}  // namespace ncport::ir::transform
