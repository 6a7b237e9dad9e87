#include "ir/analysis/cfg.h"

#include <fmt/format.h>

#include <algorithm>

#include "ir/dump_writer.h"

namespace ncport::ir::analysis {

struct Cfg::Builder {
  const Module& module;
  const LabelTable& labels;
  Cfg& cfg;
  bool calls_may_return_elsewhere;
  struct FullEdge {
    std::uint32_t from;  // index in the program
    Edge edge;
  };
  std::vector<FullEdge> edges = {};
  BlockId here = {};

  void Add(EdgeKind kind, BlockId to = {}) { AddFrom(here, kind, to); }
  void AddFrom(BlockId from, EdgeKind kind, BlockId to = {}) {
    edges.push_back({from.value - cfg.blocks_.begin, {to, kind}});
  }
  void AddNext(BlockId block, EdgeKind kind, BlockId of) {
    const bool last = block.value + 1 == cfg.blocks_.begin + cfg.blocks_.count;
    last ? AddFrom(of, EdgeKind::kTextEnd) : AddFrom(of, kind, BlockId{std::size_t{block.value} + 1});
  }

  void Run() {
    for (const BlockId id : cfg.blocks_) {
      here = id;
      const Block& block = module.blocks[id];
      bool goes_on = true;      // the next word is reached
      bool passes = false;      // the next block is reached although a word before left
      const auto leave = [&] {  // an unconditional way out
        goes_on = false;
      };
      if (block.skip_level != Block::kNoSkip) passes = true;
      for (const WordId word_id : block.words) {
        if (!goes_on) break;
        Word(block, module.words[word_id], passes, leave);
      }
      if (goes_on || passes) AddNext(id, EdgeKind::kNext, id);
    }
  }

  template <class Leave>
  void Word(const Block& block, const ir::Word& word, bool& passes, Leave leave) {
    // A mark that could not be read still holds its structure together.
    const auto mark = static_cast<WordOp>(word.index);
    const bool unread = word.op == WordOp::kVerbatim && IsStructureMark(mark);
    switch (unread ? mark : word.op) {
      case WordOp::kWhen:
      case WordOp::kSkipRest:
        passes = true;
        return;
      case WordOp::kJump:
        if (!module.jumps.Contains(word.Extra<JumpId>())) return;
        if (Jump(module.jumps[word.Extra<JumpId>()], EdgeKind::kJump) && !word.value.Valid()) leave();
        return;
      case WordOp::kSwitch:
        return Switch(word, leave);
      case WordOp::kCall:
        if (calls_may_return_elsewhere) Add(EdgeKind::kComputed);
        return;
      case WordOp::kRepeatPart:
        return Part(word);
      case WordOp::kProgramEnd:
        Add(EdgeKind::kEnd);
        return leave();
      case WordOp::kReturn:
        Add(word.index == static_cast<std::uint8_t>(ReturnKind::kToCaller) ? EdgeKind::kReturnToTarget
                                                                           : EdgeKind::kReturn);
        return leave();
      case WordOp::kRestart:
        Add(EdgeKind::kRestart, cfg.blocks_[0]);
        return leave();
      case WordOp::kAlarm:
        if (word.index == static_cast<std::uint8_t>(AlarmKind::kShows)) return;
        Add(EdgeKind::kAlarm);
        if (word.index == static_cast<std::uint8_t>(AlarmKind::kStops)) leave();
        return;
      case WordOp::kIf:
      case WordOp::kWhile:
      case WordOp::kFor:
      case WordOp::kUntil:
        if (block.link.Valid()) AddNext(block.link, EdgeKind::kFalse, here);
        return;
      case WordOp::kElse:
        if (!block.link.Valid()) return;
        Add(EdgeKind::kThenEnd, block.link);
        return leave();
      case WordOp::kEndWhile:
      case WordOp::kEndLoop:
      case WordOp::kEndFor:
        if (!block.link.Valid()) return;
        Add(EdgeKind::kBack, block.link);
        return leave();
      default:
        return;
    }
  }

  /// False if control may go on behind the jump: nothing is found and the jump is quiet.
  bool Jump(const ir::Jump& jump, EdgeKind kind) {
    if (IsComputed(jump.target)) {
      Add(EdgeKind::kComputed);
      return !jump.quiet;
    }
    // A label in a block that can be skipped may be hidden: then the search goes on to the next one.
    std::uint16_t hidden = 0;
    for (;;) {
      const BlockId target = labels.Find(jump.target, here, jump.search, hidden);
      if (!target.Valid()) {
        if (!jump.quiet) Add(EdgeKind::kMissing);
        return !jump.quiet;
      }
      Add(kind, target);
      const std::uint16_t level = SkipBit(target);
      if (level == 0 || jump.target.kind == TargetKind::kProgramStart) return true;
      hidden |= level;
    }
  }

  [[nodiscard]] std::uint16_t SkipBit(BlockId block) const {
    const std::uint8_t level = module.blocks[block].skip_level;
    return level < 16 ? static_cast<std::uint16_t>(1U << level) : std::uint16_t{0};
  }

  [[nodiscard]] bool IsComputed(const Target& target) const {
    if (target.kind != TargetKind::kExpression || !module.exprs.Contains(target.expr)) return false;
    const ExprOp op = module.exprs[target.expr].op;
    return op != ExprOp::kLiteral && op != ExprOp::kText;
  }

  template <class Leave>
  void Switch(const ir::Word& word, Leave leave) {
    if (!module.switches.Contains(word.Extra<SwitchId>())) return;
    const ir::Switch& record = module.switches[word.Extra<SwitchId>()];
    for (std::uint32_t i = 0; i < record.arm_count; ++i) {
      const SwitchArm& arm = module.switch_arms[record.first_arm + i];
      const bool leaves = Jump(module.jumps[arm.jump], EdgeKind::kArm);
      if (!arm.value.Valid() && leaves) leave();
    }
  }

  void Part(const ir::Word& word) {
    if (!module.parts.Contains(word.Extra<PartId>())) return;
    const ir::Part& part = module.parts[word.Extra<PartId>()];
    if (IsComputed(part.first) || IsComputed(part.last)) {
      cfg.opaque_ = true;
      Add(EdgeKind::kComputed);
      return;
    }
    // As for jumps, with two labels that may be hidden.
    std::vector<std::uint16_t> hidden{0};
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      const auto range = labels.FindPart(part, here, hidden[i]);
      if (!range) {
        Add(EdgeKind::kMissing);
        continue;
      }
      Add(EdgeKind::kPart, range->first);
      AddNext(here, EdgeKind::kPartEnd, range->last);
      if (word.value.Valid()) AddFrom(range->last, EdgeKind::kPart, range->first);  // a further pass
      for (const BlockId end : {range->first, range->last}) {
        const auto more = static_cast<std::uint16_t>(hidden[i] | SkipBit(end));
        if (std::ranges::find(hidden, more) == hidden.end()) hidden.push_back(more);
      }
    }
  }
};

Cfg::Cfg(const Module& module, ProgramId program, const LabelTable& labels, bool calls_may_return_elsewhere)
    : blocks_(module.programs[program].blocks), computed_targets_(labels.Targets()) {
  Builder builder{module, labels, *this, calls_may_return_elsewhere};
  builder.Run();
  // Edges by their start, and once more by their end; each block keeps the order in which its edges were found, but the
  // ways of repeated parts, found at another block, come last.
  const auto count_into = [&](std::vector<std::uint32_t>& starts, auto index_of) {
    starts.assign(std::size_t{blocks_.count} + 1, 0);
    for (const Builder::FullEdge& edge : builder.edges) {
      if (const std::uint32_t index = index_of(edge); index < blocks_.count) ++starts[index + 1];
    }
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  };
  count_into(edge_starts_, [](const auto& edge) { return edge.from; });
  edges_.resize(builder.edges.size());
  std::vector<std::uint32_t> fill(edge_starts_);
  for (const auto& edge : builder.edges) edges_[fill[edge.from]++] = edge.edge;

  const auto target = [&](const Builder::FullEdge& edge) {
    return edge.edge.to.Valid() ? edge.edge.to.value - blocks_.begin : Id<void>::kNone;
  };
  count_into(predecessor_starts_, target);
  predecessors_.resize(predecessor_starts_.back());
  fill = predecessor_starts_;
  for (const auto& edge : builder.edges) {
    const std::uint32_t index = target(edge);
    if (index < blocks_.count) predecessors_[fill[index]++] = blocks_[edge.from];
  }
  FindReachable();
}

std::span<const Edge> Cfg::Successors(BlockId block) const {
  const std::uint32_t index = block.value - blocks_.begin;
  return {edges_.data() + edge_starts_[index], edges_.data() + edge_starts_[index + 1]};
}

std::span<const BlockId> Cfg::Predecessors(BlockId block) const {
  const std::uint32_t index = block.value - blocks_.begin;
  return {predecessors_.data() + predecessor_starts_[index], predecessors_.data() + predecessor_starts_[index + 1]};
}

void Cfg::FindReachable() {
  reachable_.assign(blocks_.count, opaque_ ? 1 : 0);
  if (opaque_ || blocks_.Empty()) return;
  std::vector<BlockId> open;
  const auto reach = [&](BlockId block) {
    std::uint8_t& seen = reachable_[block.value - blocks_.begin];
    if (seen != 0) return;
    seen = 1;
    open.push_back(block);
  };
  bool computed = false;
  reach(blocks_[0]);
  while (!open.empty()) {
    const BlockId block = open.back();
    open.pop_back();
    for (const Edge& edge : Successors(block)) {
      if (edge.to.Valid()) reach(edge.to);
      if (edge.kind != EdgeKind::kComputed || computed) continue;
      computed = true;
      for (const BlockId target : computed_targets_) reach(target);
    }
  }
}

bool ReturnsToTarget(const Module& module, ProgramId program) {
  for (const BlockId block : module.programs[program].blocks) {
    for (const WordId id : module.blocks[block].words) {
      const Word& word = module.words[id];
      if (word.op == WordOp::kReturn && word.index == static_cast<std::uint8_t>(ReturnKind::kToCaller)) return true;
    }
  }
  return false;
}

FlowGraphs::FlowGraphs(const Module& module, bool ignore_case) {
  for (const ProgramId program : module.programs.Ids()) {
    returns_to_target_.push_back(analysis::ReturnsToTarget(module, program) ? 1 : 0);
    labels_.emplace_back(module, program, ignore_case);
  }
  for (const ProgramId program : module.programs.Ids()) {
    bool elsewhere = false;
    for (const BlockId block : module.programs[program].blocks) {
      for (const WordId id : module.blocks[block].words) {
        const Word& word = module.words[id];
        const bool is_call = word.op == WordOp::kCall || word.op == WordOp::kModalCall;
        if (!is_call || !module.calls.Contains(word.Extra<CallId>())) continue;
        const ProgramId callee = module.calls[word.Extra<CallId>()].program;
        elsewhere = elsewhere || (callee.Valid() && returns_to_target_[callee.value] != 0);
      }
    }
    graphs_.emplace_back(module, program, labels_[program.value], elsewhere);
  }
}

namespace {

constexpr std::string_view NameOf(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::kNext:
      return "next";
    case EdgeKind::kJump:
      return "jump";
    case EdgeKind::kArm:
      return "arm";
    case EdgeKind::kFalse:
      return "false";
    case EdgeKind::kThenEnd:
      return "then-end";
    case EdgeKind::kBack:
      return "back";
    case EdgeKind::kPart:
      return "part";
    case EdgeKind::kPartEnd:
      return "part-end";
    case EdgeKind::kRestart:
      return "restart";
    case EdgeKind::kComputed:
      return "computed";
    case EdgeKind::kEnd:
      return "end";
    case EdgeKind::kReturn:
      return "return";
    case EdgeKind::kReturnToTarget:
      return "return-to-target";
    case EdgeKind::kAlarm:
      return "alarm";
    case EdgeKind::kTextEnd:
      return "text-end";
    case EdgeKind::kMissing:
      return "missing";
  }
  return {};
}

class GraphDumper {
 public:
  GraphDumper(const Module& module, TextBuffer& out)
      : module_(module), out_(out), writer_(module, out, options_), graphs_(module) {}

  void Run() {
    for (const ProgramId program : module_.programs.Ids()) Program(program);
  }

 private:
  void Program(ProgramId program) {
    const Cfg& cfg = graphs_.Of(program);
    out_.Append("program ");
    writer_.ProgramRef(program);
    out_.Append(cfg.Opaque() ? " opaque\n" : "\n");
    const IdRange<BlockId> blocks = cfg.Blocks();
    std::vector<std::uint32_t> nodes(blocks.count, 0);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < blocks.count; ++i) {
      if (i == 0 || StartsNode(cfg, blocks[i])) ++count;
      nodes[i] = count;
    }
    for (std::uint32_t first = 0; first < blocks.count;) {
      std::uint32_t last = first;
      while (last + 1 < blocks.count && nodes[last + 1] == nodes[first]) ++last;
      Node(cfg, nodes, blocks, first, last);
      first = last + 1;
    }
  }

  // A block joins the one before if that is the only way to it and the only way out of that.
  [[nodiscard]] bool StartsNode(const Cfg& cfg, BlockId block) const {
    const BlockId before{std::size_t{block.value} - 1};
    const auto ways_out = cfg.Successors(before);
    const auto ways_in = cfg.Predecessors(block);
    const bool joined = ways_out.size() == 1 && ways_out[0] == Edge{block, EdgeKind::kNext} && ways_in.size() == 1 &&
                        cfg.Reachable(before) == cfg.Reachable(block);
    return !joined;
  }

  void Node(const Cfg& cfg, const std::vector<std::uint32_t>& nodes, IdRange<BlockId> blocks, std::uint32_t first,
            std::uint32_t last) {
    out_.Append(fmt::format("  {} ", nodes[first]));
    Place(blocks[first]);
    if (last != first) {
      out_.Append(" to ");
      Place(blocks[last]);
    }
    if (!cfg.Reachable(blocks[first])) out_.Append(" unreachable");
    out_.Append('\n');
    for (std::uint32_t i = first; i <= last; ++i) Calls(blocks[i]);
    for (const Edge& edge : cfg.Successors(blocks[last])) {
      out_.Append("    ");
      out_.Append(NameOf(edge.kind));
      if (edge.to.Valid()) out_.Append(fmt::format(" {}", nodes[edge.to.value - blocks.begin]));
      out_.Append('\n');
    }
  }

  void Place(BlockId id) {
    const Block& block = module_.blocks[id];
    if (!module_.origins.Contains(block.origin)) return out_.Append("@-");
    const Origin& origin = module_.origins[block.origin];
    writer_.Place(origin.file, origin.line);
  }

  void Calls(BlockId id) {
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
      if (!module_.calls.Contains(word.Extra<CallId>())) continue;
      const Call& call = module_.calls[word.Extra<CallId>()];
      out_.Append("    ");
      out_.Append(ir::NameOf(word.op));
      out_.Append(' ');
      call.program.Valid() ? writer_.ProgramRef(call.program) : writer_.Name(call.name);
      out_.Append(call.program.Valid() ? "\n" : " unknown\n");
    }
  }

  const Module& module_;
  TextBuffer& out_;
  DumpOptions options_;
  DumpWriter writer_;
  FlowGraphs graphs_;
};

}  // namespace

void DumpCfg(const Module& module, TextBuffer& out) { GraphDumper{module, out}.Run(); }

}  // namespace ncport::ir::analysis
