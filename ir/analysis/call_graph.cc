#include "ir/analysis/call_graph.h"

#include <algorithm>

namespace ncport::ir::analysis {

namespace {

// Runs of the own text from block to block stay in the program.
bool IsOwnRange(const Module& module, const CallSite& site) {
  return site.callee == site.caller && module.calls[site.call].form == CallForm::kBlockRange;
}

/// Tarjan's strongly connected components, with a stack of its own: chains of calls may be long.
class Components {
 public:
  Components(const Module& module, const CallGraph& graph, std::vector<ProgramId>& order,
             std::vector<std::uint32_t>& groups)
      : module_(module), graph_(graph), order_(order), groups_(groups), nodes_(module.programs.Size()) {}

  void Run() {
    for (const ProgramId program : module_.programs.Ids()) {
      if (nodes_[program.value].index == 0) Visit(program);
    }
  }

 private:
  struct Node {
    std::uint32_t index = 0;  // order of discovery, 0 = not yet
    std::uint32_t low = 0;
    bool on_stack = false;
  };
  struct Frame {
    ProgramId program;
    std::size_t next = 0;
  };

  void Discover(ProgramId program) {
    Node& node = nodes_[program.value];
    node.index = node.low = ++count_;
    node.on_stack = true;
    stack_.push_back(program);
    frames_.push_back({program});
  }

  void Visit(ProgramId root) {
    Discover(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      const auto sites = graph_.SitesOf(frame.program);
      if (frame.next < sites.size()) {
        const ProgramId callee = sites[frame.next++].callee;
        if (!callee.Valid()) continue;
        Node& node = nodes_[frame.program.value];
        const Node& other = nodes_[callee.value];
        if (other.index == 0) {
          Discover(callee);
        } else if (other.on_stack) {
          node.low = std::min(node.low, other.index);
        }
        continue;
      }
      const ProgramId done = frame.program;
      frames_.pop_back();
      if (!frames_.empty()) {
        Node& parent = nodes_[frames_.back().program.value];
        parent.low = std::min(parent.low, nodes_[done.value].low);
      }
      if (nodes_[done.value].low == nodes_[done.value].index) Close(done);
    }
  }

  void Close(ProgramId root) {
    ProgramId member;
    do {
      member = stack_.back();
      stack_.pop_back();
      nodes_[member.value].on_stack = false;
      groups_[member.value] = groups_count_;
      order_.push_back(member);
    } while (member != root);
    ++groups_count_;
  }

  const Module& module_;
  const CallGraph& graph_;
  std::vector<ProgramId>& order_;
  std::vector<std::uint32_t>& groups_;
  std::vector<Node> nodes_;
  std::vector<ProgramId> stack_;
  std::vector<Frame> frames_;
  std::uint32_t count_ = 0;
  std::uint32_t groups_count_ = 0;
};

}  // namespace

CallGraph::CallGraph(const Module& module)
    : groups_(module.programs.Size(), 0), depths_(module.programs.Size(), 0), recursive_(module.programs.Size(), 0) {
  for (const ProgramId program : module.programs.Ids()) {
    starts_.push_back(static_cast<std::uint32_t>(sites_.size()));
    for (const BlockId block : module.programs[program].blocks) {
      for (const WordId id : module.blocks[block].words) {
        const Word& word = module.words[id];
        const bool modal = word.op == WordOp::kModalCall;
        if ((word.op != WordOp::kCall && !modal) || !module.calls.Contains(word.Extra<CallId>())) continue;
        sites_.push_back({program, block, id, word.Extra<CallId>(), module.calls[word.Extra<CallId>()].program, modal});
      }
    }
  }
  starts_.push_back(static_cast<std::uint32_t>(sites_.size()));
  Components{module, *this, bottom_up_, groups_}.Run();

  for (const CallSite& site : sites_) {
    if (!site.callee.Valid() || IsOwnRange(module, site)) continue;
    if (groups_[site.callee.value] == groups_[site.caller.value]) recursive_[site.caller.value] = 1;
  }
  for (const ProgramId program : bottom_up_) {
    std::uint32_t depth = 0;
    for (const CallSite& site : SitesOf(program)) {
      if (!site.callee.Valid() || site.callee == program) continue;
      const std::uint32_t below = depths_[site.callee.value];
      depth = below == kUnbounded ? kUnbounded : std::max(depth, below + 1);
      if (depth == kUnbounded) break;
    }
    depths_[program.value] = recursive_[program.value] != 0 ? kUnbounded : depth;
  }
}

std::span<const CallSite> CallGraph::SitesOf(ProgramId caller) const {
  return {sites_.data() + starts_[caller.value], sites_.data() + starts_[caller.value + 1]};
}

}  // namespace ncport::ir::analysis
