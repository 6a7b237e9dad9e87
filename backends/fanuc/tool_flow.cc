#include "backends/fanuc/tool_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ncport::backends::fanuc {

using ir::BlockId;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

int ToolFlow::NameOf(const ir::Module& module, const Word& word) {
  ir::ExprId id = word.value;
  while (id.Valid() && (module.exprs[id].op == ir::ExprOp::kGroup || module.exprs[id].op == ir::ExprOp::kConvert)) {
    id = ir::ExprId{module.exprs[id].a};
  }
  if (!id.Valid()) return kMixed;
  const ir::Expr& value = module.exprs[id];
  std::string name;
  if (value.op == ir::ExprOp::kText) {
    name = fmt::format("T=\"{}\"", module.View(StringId{value.a}));
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

struct ToolFlow::Client {
  using State = int;

  const ir::Module& module;
  const ToolFlow& flow;
  std::vector<bool> selects;  // per program: it, or one that it calls, has a tool word

  State Entry(ProgramId) const { return kNone; }
  State Unknown(ProgramId) const { return kMixed; }
  bool Join(BlockId, State& into, State from) const {
    const State before = into;
    if (into != from) into = kMixed;
    return into != before;
  }
  void Transfer(ProgramId, BlockId block, State& state) const {
    for (const WordId id : module.blocks[block].words) {
      const WordOp op = module.words[id].op;
      if (op == WordOp::kTool) state = flow.tools_.at(id);
      if (op == WordOp::kVerbatim) state = kMixed;
    }
  }
  /// A program without tool words leaves each caller its own tool.
  State Back(const ir::analysis::CallSite& site, State at, State exit) const {
    return !site.callee.Valid() || selects[site.callee.value] ? exit : at;
  }
};

ToolFlow::ToolFlow(const ir::analysis::FlowSources& sources) {
  const ir::Module& module = sources.module;
  Client client{module, *this, std::vector<bool>(module.programs.Size(), false)};
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      for (const WordId word : module.blocks[id].words) {
        const WordOp op = module.words[word].op;
        if (op == WordOp::kTool) tools_[word] = NameOf(module, module.words[word]);
        if (op == WordOp::kTool || op == WordOp::kVerbatim) client.selects[program.value] = true;
      }
    }
  }
  for (const ProgramId program : sources.calls.BottomUp()) {
    for (const ir::analysis::CallSite& site : sources.calls.SitesOf(program)) {
      // Programs that call each other in a circle count as selecting, and those that are not known.
      if (!site.callee.Valid() || client.selects[site.callee.value] || sources.calls.Recursive(site.callee))
        client.selects[program.value] = true;
    }
  }
  ir::analysis::ForwardFlow<Client> flow(sources, client);
  flow.Run();
  for (const BlockId block : module.blocks.Ids()) {
    if (const int* tool = flow.Before(block)) before_[block] = *tool;
  }
}

std::string_view ToolFlow::Before(BlockId block) const {
  const auto known = before_.find(block);
  return known == before_.end() || known->second <= kNone ? std::string_view{}
                                                          : names_[static_cast<std::size_t>(known->second - 1)];
}

}  // namespace ncport::backends::fanuc
