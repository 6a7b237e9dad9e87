#include "backends/fanuc/tool_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"

namespace ncport::backends::fanuc {

using ir::Block;
using ir::BlockId;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

int ToolFlow::NameOf(const Word& word) {
  ir::ExprId id = word.value;
  while (id.Valid() && (module_.exprs[id].op == ir::ExprOp::kGroup || module_.exprs[id].op == ir::ExprOp::kConvert)) {
    id = ir::ExprId{module_.exprs[id].a};
  }
  if (!id.Valid()) return kMixed;
  const ir::Expr& value = module_.exprs[id];
  std::string name;
  if (value.op == ir::ExprOp::kText) {
    name = fmt::format("T=\"{}\"", module_.View(StringId{value.a}));
  } else if (value.op == ir::ExprOp::kLiteral && value.number == std::floor(value.number)) {
    name = fmt::format("T{:.0f}", value.number);
  } else {
    return kMixed;
  }
  const auto known = std::find(names_.begin(), names_.end(), name);
  if (known != names_.end()) return static_cast<int>(known - names_.begin()) + 1;
  names_.push_back(name);
  return static_cast<int>(names_.size());
}

int ToolFlow::Through(const Block& block, int before) const {
  int now = before;
  bool conditional = block.skip_level != Block::kNoSkip;
  for (const WordId id : block.words) {
    const Word& word = module_.words[id];
    switch (word.op) {
      case WordOp::kTool:
        now = tools_.at(id);
        break;
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        conditional = true;
        break;
      case WordOp::kVerbatim:
        now = kMixed;
        break;
      case WordOp::kCall:
      case WordOp::kModalCall: {
        const auto call = word.Extra<ir::CallId>();
        if (!call.Valid()) break;
        const ProgramId callee = module_.calls[call].program;
        if (!callee.Valid() || !selects_[callee.value]) break;
        // A modal call runs behind blocks that do not show it.
        now = word.op == WordOp::kModalCall ? kMixed : exit_[callee.value];
        break;
      }
      default:
        break;
    }
  }
  return conditional ? Join(before, now) : now;
}

ToolFlow::ToolFlow(const ir::Module& module) : module_(module) {
  const ir::analysis::FlowGraphs graphs(module);
  const ir::analysis::CallGraph calls(module);
  const std::size_t programs = module.programs.Size();
  entry_.assign(programs, kNever);
  exit_.assign(programs, kNever);
  selects_.assign(programs, false);
  std::vector<bool> called(programs, false);
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      for (const WordId word : module.blocks[id].words) {
        if (module.words[word].op != WordOp::kTool) continue;
        tools_[word] = NameOf(module.words[word]);
        selects_[program.value] = true;
      }
    }
  }
  for (const ProgramId program : calls.BottomUp()) {
    for (const ir::analysis::CallSite& site : calls.SitesOf(program)) {
      if (!site.callee.Valid()) continue;
      called[site.callee.value] = true;
      // Programs that call each other in a circle count as selecting.
      if (selects_[site.callee.value] || calls.Recursive(site.callee)) selects_[program.value] = true;
    }
  }
  for (const ProgramId program : module.programs.Ids()) {
    if (!called[program.value] || module.programs[program].kind == ir::ProgramKind::kMain)
      entry_[program.value] = kNone;
  }
  // Each state only climbs never -> one -> mixed, so this ends.
  for (bool changed = true; changed;) {
    changed = false;
    const auto merge = [&](int& into, int from) {
      const int joined = Join(into, from);
      changed = changed || joined != into;
      into = joined;
    };
    for (const ProgramId program : module.programs.Ids()) {
      const IdRange<BlockId> blocks = module.programs[program].blocks;
      if (blocks.Empty()) {
        merge(exit_[program.value], entry_[program.value]);
        continue;
      }
      const ir::analysis::Cfg& graph = graphs.Of(program);
      const auto at = [&](BlockId id) -> int& { return before_.try_emplace(id, kNever).first->second; };
      merge(at(blocks[0]), graph.Opaque() ? kMixed : entry_[program.value]);
      for (const BlockId id : blocks) {
        const int before = at(id);
        if (before == kNever) continue;
        int tool = before;
        for (const WordId word_id : module.blocks[id].words) {
          const Word& word = module.words[word_id];
          if (word.op == WordOp::kTool) tool = tools_.at(word_id);
          if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
          const auto call = word.Extra<ir::CallId>();
          if (!call.Valid() || !module.calls[call].program.Valid()) continue;
          merge(entry_[module.calls[call].program.value], word.op == WordOp::kModalCall ? kMixed : tool);
        }
        const int after = Through(module.blocks[id], before);
        for (const ir::analysis::Edge& edge : graph.Successors(id)) {
          if (edge.to.Valid()) {
            merge(at(edge.to), after);
          } else if (edge.kind == ir::analysis::EdgeKind::kComputed) {
            for (const BlockId target : graph.ComputedTargets()) merge(at(target), after);
          } else if (edge.kind != ir::analysis::EdgeKind::kAlarm && edge.kind != ir::analysis::EdgeKind::kMissing) {
            merge(exit_[program.value], after);
          }
        }
      }
    }
  }
}

std::string_view ToolFlow::Before(BlockId block) const {
  const auto known = before_.find(block);
  return known == before_.end() || known->second <= kNone ? std::string_view{}
                                                          : names_[static_cast<std::size_t>(known->second - 1)];
}

}  // namespace ncport::backends::fanuc
