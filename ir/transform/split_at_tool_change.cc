#include "ir/transform/split_at_tool_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ir/analysis/cfg.h"
#include "ir/analysis/labels.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/structure.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"
#include "ir/word_values.h"

namespace ncport::ir::transform {

namespace {

class Pass {
 public:
  Pass(Module& module, diag::Sink& sink) : module_(module), sink_(sink), make_(module) {}

  SplitResult Run();

 private:
  [[nodiscard]] bool CallsTool(const Block& block) const {
    for (const WordId id : block.words) {
      if (module_.words[id].op == WordOp::kTool) return true;
    }
    return false;
  }
  /// A blank line or a comment that nothing leads to.
  [[nodiscard]] static bool IsText(const Block& block) {
    return block.words.Empty() && !block.label.Valid() && block.number == Block::kNoNumber && block.flags == 0;
  }
  void Refuse(const Block& block, std::string_view what,
              std::string_view help =
                  "take the tool change out of the program, so that the main program calls the parts "
                  "before and behind it") {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, "a machine whose macros call no tools")
        .help = help;
  }
  bool OnStraightPath(ProgramId program, BlockId at);
  bool PartsAreIndependent(ProgramId program, BlockId at, const Block& block, const std::set<std::uint32_t>& needed);
  std::set<std::uint32_t> ReadBeforeSet(ProgramId program, BlockId at);
  void Split(ProgramId program, BlockId at);
  using Twins = std::unordered_map<std::uint32_t, VariableId>;
  Twins CopyVariables(ProgramId program, ProgramId part);
  void CopyDefinitions(const IdRange<BlockId>& head, ProgramId part, const Twins& twins,
                       const std::set<std::uint32_t>& needed);
  bool MayChange(const Call& call, ProgramId caller);

  Module& module_;
  diag::Sink& sink_;
  ExprBuilder make_;
  bool ok_ = true;
  SplitResult result_;
};

/// No structure is open there and no jump leads over it.
bool Pass::OnStraightPath(ProgramId program, BlockId at) {
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  const Block& here = module_.blocks[at];
  int depth = 0;
  for (const BlockId id : blocks) {
    if (id == at) break;
    for (const WordId word : module_.blocks[id].words) {
      switch (module_.words[word].op) {
        case WordOp::kIf:
        case WordOp::kWhile:
        case WordOp::kFor:
        case WordOp::kLoop:
        case WordOp::kRepeat:
          ++depth;
          break;
        case WordOp::kEndIf:
        case WordOp::kEndWhile:
        case WordOp::kEndFor:
        case WordOp::kEndLoop:
        case WordOp::kUntil:
          --depth;
          break;
        default:
          break;
      }
    }
  }
  if (depth != 0 || here.skip_level != Block::kNoSkip) {
    Refuse(here, "a tool change inside a loop, a branch, or a block that may be skipped");
    return false;
  }
  const analysis::FlowGraphs graphs(module_);
  const analysis::LabelTable& labels = graphs.LabelsOf(program);
  for (const BlockId id : blocks) {
    for (const analysis::Edge& edge : graphs.Of(program).Successors(id)) {
      using analysis::EdgeKind;
      const bool leaves =
          edge.kind == EdgeKind::kEnd || edge.kind == EdgeKind::kReturn || edge.kind == EdgeKind::kReturnToTarget;
      // Its caller would go on with the tool change.
      if (leaves && id < at && graphs.Of(program).Reachable(id)) {
        Refuse(here, "a tool change behind a block that may end the program before it");
        return false;
      }
      if (edge.kind == EdgeKind::kComputed) {
        Refuse(here, "a tool change that a jump leads over");
        return false;
      }
    }
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      std::vector<JumpId> jumps;
      if (word.op == WordOp::kJump) jumps.push_back(word.Extra<JumpId>());
      if (word.op == WordOp::kSwitch) {
        const Switch cases = module_.switches[word.Extra<SwitchId>()];
        for (std::uint32_t arm = 0; arm < cases.arm_count; ++arm)
          jumps.push_back(module_.switch_arms[cases.first_arm + arm].jump);
      }
      if (word.op == WordOp::kRepeatPart || word.op == WordOp::kRestart) {
        Refuse(here, "a tool change in a program with repeated parts");
        return false;
      }
      for (const JumpId jump : jumps) {
        const BlockId to = labels.Find(module_.jumps[jump].target, id, module_.jumps[jump].search);
        // A jump from before to the tool change itself stays in the first part: it becomes its end.
        const bool over = id < at ? to > at : to <= at;
        if (to.Valid() && over) {
          Refuse(here, "a tool change that a jump leads over");
          return false;
        }
      }
    }
  }
  return true;
}

/// Nothing but the arguments crosses the cut. `needed`: variables that the part behind may read before it sets them.
bool Pass::PartsAreIndependent(ProgramId program, BlockId at, const Block& block,
                               const std::set<std::uint32_t>& needed) {
  const auto own = [&](const Expr& expr) {
    return (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) &&
           module_.variables[VariableId{std::size_t{expr.a}}].owner == program;
  };
  bool names_own = false;
  for (const WordId word : block.words) {
    VisitValues(module_, module_.words[word], [&](ExprId value) {
      VisitReads(module_, value, [&](ExprId node) { names_own = names_own || own(module_.exprs[node]); });
    });
  }
  if (names_own) {
    Refuse(block, "a tool change whose words read variables of the program");
    return false;
  }
  std::set<std::uint32_t> written;
  const auto write = [&](ExprId place) {
    if (own(module_.exprs[place])) written.insert(module_.exprs[place].a);
  };
  for (const BlockId id : module_.programs[program].blocks) {
    if (id >= at) break;
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      VisitPlaces(module_, word, write);
      VisitReferences(module_, word, write);
      if (word.op != WordOp::kDefine) continue;
      // A start value that is computed may be another one in the second part.
      VisitValues(module_, word, [&](ExprId initial) {
        VisitReads(module_, initial, [&](ExprId node) {
          const Expr& read = module_.exprs[node];
          if (!own(read) || written.contains(read.a)) written.insert(word.extra);
        });
      });
    }
  }
  for (const std::uint32_t variable : needed) {
    const Variable& record = module_.variables[VariableId{std::size_t{variable}}];
    if (record.by_reference) {
      Refuse(block, fmt::format("a tool change in a program with the reference {}", module_.View(record.name)));
      return false;
    }
    // A local that nobody set holds its start value in both parts.
    if (!written.contains(variable)) continue;
    Refuse(block, fmt::format("a tool change between the block that sets {} and one that reads it",
                              module_.View(record.name)));
    return false;
  }
  return true;
}

/// Variables of the program that the blocks behind `at` may read before they set them, by the flow from there on; an
/// element is never known to be set.
std::set<std::uint32_t> Pass::ReadBeforeSet(ProgramId program, BlockId at) {
  const analysis::FlowGraphs graphs(module_);
  const analysis::Cfg& graph = graphs.Of(program);
  const IdRange<BlockId> all = module_.programs[program].blocks;
  const std::uint32_t first = at.value + 1, end = all.begin + all.count;
  const std::size_t variables = module_.variables.Size();
  using Set = std::vector<bool>;                    // by variable: set on every way
  std::vector<std::optional<Set>> in(end - first);  // none: no way leads there
  if (first == end) return {};
  in[0] = Set(variables, false);
  std::set<std::uint32_t> needed;
  const auto through = [&](BlockId id, Set set) {
    const Block& block = module_.blocks[id];
    bool sure = block.skip_level == Block::kNoSkip;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      const auto own = [&](std::uint32_t variable) {
        return module_.variables[VariableId{std::size_t{variable}}].owner == program;
      };
      VisitValues(module_, word, [&](ExprId value) {
        VisitReads(module_, value, [&](ExprId node) {
          const Expr& read = module_.exprs[node];
          if (read.op != ExprOp::kVariable && read.op != ExprOp::kElement) return;
          if (own(read.a) && (read.op == ExprOp::kElement || !set[read.a])) needed.insert(read.a);
        });
      });
      if (word.op == WordOp::kWhen || word.op == WordOp::kSkipRest) sure = false;
      if (!sure) continue;
      if (word.op == WordOp::kDefine) set[word.extra] = true;
      VisitPlaces(module_, word, [&](ExprId place) {
        if (module_.exprs[place].op == ExprOp::kVariable) set[module_.exprs[place].a] = true;
      });
    }
    return set;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = first; i < end; ++i) {
      if (!in[i - first]) continue;
      const Set out = through(BlockId{std::size_t{i}}, *in[i - first]);
      for (const analysis::Edge& edge : graph.Successors(BlockId{std::size_t{i}})) {
        if (!edge.to.Valid() || edge.to.value < first) continue;
        std::optional<Set>& to = in[edge.to.value - first];
        Set joined = to ? *to : out;
        if (to) {
          for (std::size_t v = 0; v < variables; ++v) joined[v] = joined[v] && out[v];
        }
        if (to && *to == joined) continue;
        to = std::move(joined);
        changed = true;
      }
    }
  }
  return needed;
}

/// The part gets variables of its own for all of the program's; its blocks are rewritten to them. Returns them by the
/// program's.
Pass::Twins Pass::CopyVariables(ProgramId program, ProgramId part) {
  Twins twins;
  const IdRange<VariableId> parameters = module_.programs[program].parameters;
  IdRange<VariableId> copied{static_cast<std::uint32_t>(module_.variables.Size()), parameters.count};
  for (const VariableId id : parameters) {
    Variable variable = module_.variables[id];
    variable.owner = part;
    twins[id.value] = module_.variables.Add(variable);
  }
  module_.programs[part].parameters = copied;
  const std::size_t known = module_.variables.Size();
  for (std::uint32_t i = 0; i < known; ++i) {
    Variable variable = module_.variables[VariableId{i}];
    if (variable.owner != program || variable.scope == Scope::kParameter) continue;
    variable.owner = part;
    twins[i] = module_.variables.Add(variable);
  }
  RewriteProgram(module_, part, [&](Module& module, ExprId id) {
    const Expr expr = module.exprs[id];
    if (expr.op != ExprOp::kVariable && expr.op != ExprOp::kElement) return id;
    const auto twin = twins.find(expr.a);
    if (twin == twins.end()) return id;
    Expr copy = expr;
    copy.a = twin->second.value;
    return module.AddExpr(copy, module.expr_places.Of(id));
  });
  return twins;
}

/// Definitions of variables that the part reads as they start: it begins with them.
void Pass::CopyDefinitions(const IdRange<BlockId>& head, ProgramId part, const Twins& twins,
                           const std::set<std::uint32_t>& needed) {
  if (module_.programs[part].blocks.Empty()) return;
  ProgramEditor editor(module_, part, "split_at_tool_change");
  for (const BlockId id : head) {
    std::vector<Word> words;
    for (const WordId word_id : module_.blocks[id].words) {
      Word word = module_.words[word_id];
      if (word.op != WordOp::kDefine || !needed.contains(word.extra)) continue;
      word.extra = twins.at(word.extra).value;
      words.push_back(word);
    }
    if (words.empty()) continue;
    Block made = editor.MakeBlock(id);
    editor.SetWords(made, words);
    editor.InsertBefore(module_.programs[part].blocks[0], made);
  }
  editor.Apply();
}

/// The arguments of the call may be others when they are passed again behind the first part.
bool Pass::MayChange(const Call& call, ProgramId caller) {
  std::set<std::uint32_t> references;
  const IdRange<VariableId> parameters = module_.programs[call.program].parameters;
  for (const ArgId id : call.args) {
    const Arg& arg = module_.args[id];
    if (!arg.value.Valid() || arg.position >= parameters.count) continue;
    if (!module_.variables[parameters[arg.position]].by_reference) continue;
    const Expr& place = module_.exprs[arg.value];
    if (place.op == ExprOp::kVariable || place.op == ExprOp::kElement) references.insert(place.a);
  }
  bool may_change = false;
  for (const ArgId id : call.args) {
    const Arg& arg = module_.args[id];
    if (!arg.value.Valid()) continue;
    const bool by_reference =
        arg.position < parameters.count && module_.variables[parameters[arg.position]].by_reference;
    VisitReads(module_, arg.value, [&](ExprId node) {
      const Expr& read = module_.exprs[node];
      if (read.op != ExprOp::kVariable && read.op != ExprOp::kElement) {
        may_change = true;
        return;
      }
      if (by_reference && node == arg.value) return;
      const Variable& variable = module_.variables[VariableId{std::size_t{read.a}}];
      const bool of_caller = variable.owner == caller && !variable.by_reference &&
                             (variable.scope == Scope::kLocal || variable.scope == Scope::kParameter);
      may_change = may_change || !of_caller || references.contains(read.a);
    });
  }
  return may_change;
}

void Pass::Split(ProgramId program, BlockId at) {
  const Block tool = module_.blocks[at];
  if (!OnStraightPath(program, at)) return;
  const std::set<std::uint32_t> needed = ReadBeforeSet(program, at);
  if (!PartsAreIndependent(program, at, tool, needed)) return;
  // Definitions of the second part: locals start anew there.
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  Program part = module_.programs[program];
  const auto known = std::find_if(result_.programs.begin(), result_.programs.end(), [&](const SplitProgram& split) {
    return std::find(split.parts.begin(), split.parts.end(), program) != split.parts.end();
  });
  const bool first_cut = known == result_.programs.end();
  const ProgramId whole = first_cut ? program : known->whole;
  part.name = module_.strings.Intern(
      fmt::format("{}_{}", module_.View(module_.programs[whole].name), first_cut ? 2 : known->parts.size() + 1));
  // Comments and blank lines above the tool change speak of what comes behind it.
  BlockId first_of_head = at;
  while (first_of_head.value > blocks.begin && IsText(module_.blocks[BlockId{std::size_t{first_of_head.value} - 1}]))
    first_of_head = BlockId{std::size_t{first_of_head.value} - 1};
  part.blocks = {static_cast<std::uint32_t>(module_.blocks.Size()), 0};
  for (std::uint32_t i = first_of_head.value; i < blocks.begin + blocks.count; ++i) {
    if (i == at.value) continue;
    const Block copy = module_.blocks[BlockId{std::size_t{i}}];
    module_.blocks.Add(copy);
    ++part.blocks.count;
  }
  const ProgramId part_id = module_.programs.Add(part);
  const Twins twins = CopyVariables(program, part_id);
  const IdRange<BlockId> head{blocks.begin, first_of_head.value - blocks.begin};
  CopyDefinitions(head, part_id, twins, needed);

  // The first part ends where the tool change stood; a jump to the tool change ends there too.
  ProgramEditor editor(module_, program, "split_at_tool_change");
  Word ret = MakeWord(WordOp::kReturn, ReturnKind::kPlain);
  Block end = editor.MakeBlock(at);
  editor.TakeHead(end, at);
  editor.SetWords(end, {ret});
  IdRange<BlockId> cut{static_cast<std::uint32_t>(module_.blocks.Size()), head.count + 1};
  for (const BlockId id : head) {
    const Block copy = module_.blocks[id];
    module_.blocks.Add(copy);
  }
  module_.blocks.Add(end);
  module_.programs[program].blocks = cut;
  diag::Sink quiet;
  BuildStructure(module_, program, 0, quiet);
  BuildStructure(module_, part_id, 0, quiet);

  // Callers: first part, the tool words, second part.
  bool called = false;
  for (const ProgramId caller : module_.programs.Ids()) {
    ProgramEditor calls(module_, caller, "split_at_tool_change");
    for (const BlockId id : module_.programs[caller].blocks) {
      const Block block = module_.blocks[id];
      for (const WordId word_id : block.words) {
        const Word word = module_.words[word_id];
        if (word.op == WordOp::kModalCall && word.Extra<CallId>().Valid() &&
            module_.calls[word.Extra<CallId>()].program == program) {
          Refuse(tool, "a tool change in a program that is called modally");
        }
        if (word.op != WordOp::kCall || module_.calls[word.Extra<CallId>()].program != program) continue;
        called = true;
        const Call call = module_.calls[word.Extra<CallId>()];
        if (call.passes.Valid()) {
          Refuse(tool, "a tool change in a program that is called with a number of passes");
          continue;
        }
        if (MayChange(call, caller))
          Refuse(tool, "a tool change in a program whose arguments may change before its second part runs");
        Block change = calls.MakeBlock(at);
        std::vector<Word> words;
        for (const WordId tool_word : tool.words) words.push_back(module_.words[tool_word]);
        calls.SetWords(change, words);
        change.comments = tool.comments;
        change.skip_level = block.skip_level;
        change.flags = block.flags;
        calls.InsertAfter(id, change);
        Call second = call;
        second.program = part_id;
        second.name = module_.programs[part_id].name;
        second.args = {static_cast<std::uint32_t>(module_.args.Size()), call.args.count};
        for (const ArgId arg : call.args) {
          const Arg copy = module_.args[arg];
          module_.args.Add(copy);
        }
        Word again = word;
        again.extra = module_.calls.Add(second).value;
        Block next = calls.MakeBlock(id);
        next.skip_level = block.skip_level;
        next.flags = block.flags;
        calls.SetWords(next, {again});
        calls.InsertAfter(id, next);
      }
    }
    calls.Apply();
  }
  // The tool words would stand nowhere.
  if (!called && ok_) {
    Refuse(tool, "a tool change in a program that nothing here calls",
           "translate it together with the programs that call it: the tool change moves to them");
  }
  if (first_cut) {
    result_.programs.push_back({program, {program, part_id}});
  } else {
    known->parts.push_back(part_id);
  }
}

SplitResult Pass::Run() {
  // A second part may hold the next tool change: programs are added while this goes on.
  for (std::uint32_t i = 0; ok_ && i < module_.programs.Size(); ++i) {
    const ProgramId program{i};
    if (module_.programs[program].kind == ProgramKind::kMain) continue;
    for (const BlockId id : module_.programs[program].blocks) {
      if (!CallsTool(module_.blocks[id])) continue;
      Split(program, id);
      break;
    }
  }
  result_.ok = ok_;
  return std::move(result_);
}

}  // namespace

SplitResult SplitAtToolChange(Module& module, diag::Sink& sink) { return Pass(module, sink).Run(); }

}  // namespace ncport::ir::transform
