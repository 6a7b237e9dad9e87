#include "ir/transform/split_at_tool_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>

#include "ir/analysis/labels.h"
#include "ir/builder.h"
#include "ir/structure.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"

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
  void Refuse(const Block& block, std::string_view what) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, "a machine whose macros call no tools")
        .help =
        "take the tool change out of the program, so that the main program calls the parts before and behind it";
  }
  bool OnStraightPath(ProgramId program, BlockId at);
  bool PartsAreIndependent(ProgramId program, BlockId at, const Block& block);
  void Split(ProgramId program, BlockId at);
  ProgramId CopyParameters(ProgramId program, ProgramId part);

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
  const analysis::LabelTable labels(module_, program);
  for (const BlockId id : blocks) {
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
        const bool computed = module_.jumps[jump].target.kind == TargetKind::kExpression;
        // A jump from before to the tool change itself stays in the first part: it becomes its end.
        if (computed || (to.Valid() && (id < at) != (to < at) && to != at)) {
          Refuse(here, "a tool change that a jump leads over");
          return false;
        }
      }
    }
  }
  return true;
}

/// Nothing but the arguments crosses the cut.
bool Pass::PartsAreIndependent(ProgramId program, BlockId at, const Block& block) {
  std::unordered_map<std::uint32_t, int> written_before, read_behind;
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  std::vector<std::uint32_t> set_behind;
  const auto own = [&](const Expr& expr) {
    return (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement) &&
           module_.variables[VariableId{expr.a}].owner == program;
  };
  for (const BlockId id : blocks) {
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kMessage || word.op == WordOp::kDefine) continue;
      const bool before = id < at;
      const auto read = [&](ExprId expr) {
        VisitReads(module_, expr, [&](ExprId node) {
          const Expr& place = module_.exprs[node];
          if (own(place) && !before && std::find(set_behind.begin(), set_behind.end(), place.a) == set_behind.end())
            ++read_behind[place.a];
        });
      };
      read(word.value);
      if (word.op == WordOp::kCall && word.Extra<CallId>().Valid()) {
        for (const ArgId arg : module_.calls[word.Extra<CallId>()].args) read(module_.args[arg].value);
      }
      if (word.op == WordOp::kFor) {
        const For& loop = module_.fors[word.Extra<ForId>()];
        read(loop.end);
        const Expr& counter = module_.exprs[loop.variable];
        if (own(counter) && before) ++written_before[counter.a];
        if (own(counter) && !before) set_behind.push_back(counter.a);
      }
      if (word.op != WordOp::kAssign) continue;
      const Expr& place = module_.exprs[word.Extra<ExprId>()];
      if (!own(place)) continue;
      if (before) {
        ++written_before[place.a];
      } else if (place.op == ExprOp::kVariable) {
        set_behind.push_back(place.a);
      }
    }
  }
  for (const auto& [variable, count] : read_behind) {
    const Variable& record = module_.variables[VariableId{variable}];
    if (record.by_reference) {
      Refuse(block, fmt::format("a tool change in a program with the reference {}", module_.View(record.name)));
      return false;
    }
    // A local that nobody set holds its start value in both parts.
    if (!written_before.contains(variable)) continue;
    Refuse(block, fmt::format("a tool change between the block that sets {} and one that reads it",
                              module_.View(record.name)));
    return false;
  }
  return true;
}

/// The part gets variables of its own for all of the program's; its blocks are rewritten to them.
ProgramId Pass::CopyParameters(ProgramId program, ProgramId part) {
  std::unordered_map<std::uint32_t, VariableId> twins;
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
  return part;
}

void Pass::Split(ProgramId program, BlockId at) {
  const Block tool = module_.blocks[at];
  if (!OnStraightPath(program, at) || !PartsAreIndependent(program, at, tool)) return;
  // Definitions of the second part: locals start anew there.
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  Program part = module_.programs[program];
  part.name = module_.strings.Intern(fmt::format("{}_{}", module_.View(part.name), result_.programs.size() + 2));
  part.blocks = {at.value + 1, blocks.begin + blocks.count - at.value - 1};
  const ProgramId part_id = module_.programs.Add(part);
  CopyParameters(program, part_id);

  // The first part ends where the tool change stood; a jump to the tool change ends there too.
  ProgramEditor editor(module_, program, "split_at_tool_change");
  Word ret;
  ret.op = WordOp::kReturn;
  ret.phase = DefaultPhaseOf(WordOp::kReturn);
  ret.index = static_cast<std::uint8_t>(ReturnKind::kPlain);
  Block end = editor.MakeBlock(at);
  end.label = tool.label;
  end.number = tool.number;
  end.number_digits = tool.number_digits;
  editor.SetWords(end, {ret});
  const IdRange<BlockId> head{blocks.begin, at.value - blocks.begin};
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
        const Call call = module_.calls[word.Extra<CallId>()];
        if (call.passes.Valid()) {
          Refuse(tool, "a tool change in a program that is called with a number of passes");
          continue;
        }
        for (const ArgId arg : call.args) {
          bool reads = false;
          VisitReads(module_, module_.args[arg].value, [&](ExprId node) {
            const ExprOp op = module_.exprs[node].op;
            reads = reads || op == ExprOp::kCell || op == ExprOp::kCellAt || op == ExprOp::kSystem;
          });
          if (reads) Refuse(tool, "a tool change in a program whose arguments may change before its second part runs");
        }
        Block change = calls.MakeBlock(at);
        change.words = tool.words;
        change.comments = tool.comments;
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
        calls.SetWords(next, {again});
        calls.InsertAfter(id, next);
      }
    }
    calls.Apply();
  }
  const auto known = std::find_if(result_.programs.begin(), result_.programs.end(), [&](const SplitProgram& split) {
    return std::find(split.parts.begin(), split.parts.end(), program) != split.parts.end();
  });
  if (known == result_.programs.end()) {
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
