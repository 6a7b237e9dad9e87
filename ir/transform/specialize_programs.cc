#include "ir/transform/specialize_programs.h"

#include <fmt/format.h>

#include <algorithm>
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
#include "ir/structure.h"
#include "ir/transform/constant_values.h"
#include "ir/transform/fit_program.h"
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
      FitProgram(module_, machine_, program, analyses, modal.contains(program.value), titles_[program.value]);
    DropParameters();
  }

 private:
  void SplitCalls();
  [[nodiscard]] bool CanFollow(ProgramId program) const;
  [[nodiscard]] Given GivenBy(const Call& call, bool modal) const;
  [[nodiscard]] std::set<std::uint32_t> NamedIn(ProgramId program) const;
  void Bind(ProgramId from, ProgramId program, const Given& given);
  void DropParameters();

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

}  // namespace

void SpecializePrograms(Module& module, const Machine& source, const ModalState& entry) {
  Pass(module, source, entry).Run();
}

}  // namespace ncport::ir::transform
