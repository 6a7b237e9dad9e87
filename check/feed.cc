#include <vector>

#include "check/expressions.h"
#include "check/motion_words.h"
#include "check/rules.h"
#include "dialects/finding_alarms.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ProgramId;
using ir::WordOp;
using ir::analysis::EdgeKind;

/// `F0`: a feed of nothing is none (sinumerik-10#49, fanuc-11#8).
bool IsZero(const ir::Module& module, const ir::Word& feed) { return LiteralValue(module, feed.value) == 0.0; }

/// Where a feed may have been set on some way through programs and calls. What is not known counts as set, so that a
/// finding holds on every way.
class FeedFlow {
 public:
  explicit FeedFlow(const Subject& subject)
      : subject_(subject),
        module_(subject.module),
        may_have_(module_.blocks.Size(), 0),
        entered_(module_.programs.Size(), 0),
        leaves_(module_.programs.Size(), 0) {
    FindSetters();
    FindEntries();
  }

  /// False if no way to the block sets a feed.
  [[nodiscard]] bool MayHave(BlockId block) const { return may_have_[block.value] != 0; }

 private:
  // Programs that set a feed themselves or call one that does, or something that is not known.
  void FindSetters() {
    for (const ProgramId program : subject_.calls.BottomUp()) leaves_[program.value] = Sets(program) ? 1 : 0;
    // Circles of calls: once more is enough, since one setter makes all of its circle setters.
    for (const ProgramId program : subject_.calls.BottomUp()) leaves_[program.value] = Sets(program) ? 1 : 0;
  }

  [[nodiscard]] bool Sets(ProgramId program) const {
    if (leaves_[program.value] != 0) return true;
    if (subject_.graphs.Of(program).Opaque()) return true;
    for (const BlockId id : module_.programs[program].blocks) {
      if (SetsItself(module_.blocks[id])) return true;
    }
    for (const ir::analysis::CallSite& site : subject_.calls.SitesOf(program)) {
      if (!site.callee.Valid() || leaves_[site.callee.value] != 0) return true;
    }
    return false;
  }

  [[nodiscard]] bool SetsItself(const ir::Block& block) const {
    if ((block.flags & ir::Block::kRefused) != 0) return true;
    for (const ir::WordId id : block.words) {
      switch (module_.words[id].op) {
        case WordOp::kFeed:
          if (!IsZero(module_, module_.words[id])) return true;
          break;
        case WordOp::kComputedG:
        case WordOp::kDataSetting:
        case WordOp::kVerbatim:
          return true;
        case WordOp::kCall:
          if (!Callee(module_.words[id]).Valid()) return true;
          break;
        default:
          break;
      }
    }
    return false;
  }

  [[nodiscard]] bool TakesAway(const ir::Block& block) const {
    bool takes = false;
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      takes = takes || (word.op == WordOp::kFeed && IsZero(module_, word));
    }
    return takes && block.skip_level == ir::Block::kNoSkip;
  }

  [[nodiscard]] ProgramId Callee(const ir::Word& word) const {
    const auto call = word.Extra<ir::CallId>();
    return module_.calls.Contains(call) ? module_.calls[call].program : ProgramId{};
  }

  /// A feed may be in force behind the block.
  [[nodiscard]] bool Behind(const ir::Block& block, bool before) const {
    if (SetsItself(block)) return true;
    if (before && !TakesAway(block)) return true;
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
      const ProgramId callee = Callee(word);
      // A modal call runs behind later blocks.
      if (callee.Valid() && leaves_[callee.value] != 0) return true;
    }
    return false;
  }

  void FindEntries() {
    std::vector<std::uint8_t> called(module_.programs.Size(), 0);
    for (const ir::analysis::CallSite& site : subject_.calls.AllSites()) {
      if (site.callee.Valid()) called[site.callee.value] = 1;
    }
    std::vector<ProgramId> open;
    for (const ProgramId program : module_.programs.Ids()) {
      const bool main = subject_.IsMain(program);
      // What nothing here calls may be called with any state.
      if (!main && called[program.value] == 0) entered_[program.value] = 1;
      open.push_back(program);
    }
    while (!open.empty()) {
      const ProgramId program = open.back();
      open.pop_back();
      Flow(program);
      for (const ir::analysis::CallSite& site : subject_.calls.SitesOf(program)) {
        if (!site.callee.Valid() || entered_[site.callee.value] != 0) continue;
        if (!Behind(module_.blocks[site.block], MayHave(site.block)) && !site.modal) continue;
        entered_[site.callee.value] = 1;
        open.push_back(site.callee);
      }
    }
  }

  void Flow(ProgramId program) {
    const ir::analysis::Cfg& graph = subject_.graphs.Of(program);
    const auto blocks = graph.Blocks();
    if (blocks.Empty()) return;
    std::vector<BlockId> open;
    const auto set = [&](BlockId block) {
      if (may_have_[block.value] != 0) return;
      may_have_[block.value] = 1;
      open.push_back(block);
    };
    if (graph.Opaque()) {
      for (const BlockId block : blocks) set(block);
    }
    if (entered_[program.value] != 0) set(blocks[0]);
    for (const BlockId block : blocks) {
      if (!graph.Reachable(block) || !Behind(module_.blocks[block], false)) continue;
      Follow(graph, block, set);
    }
    while (!open.empty()) {
      const BlockId block = open.back();
      open.pop_back();
      if (Behind(module_.blocks[block], true)) Follow(graph, block, set);
    }
  }

  template <class Set>
  static void Follow(const ir::analysis::Cfg& graph, BlockId block, Set set) {
    for (const ir::analysis::Edge& edge : graph.Successors(block)) {
      if (edge.to.Valid()) set(edge.to);
      if (edge.kind != EdgeKind::kComputed) continue;
      for (const BlockId target : graph.ComputedTargets()) set(target);
    }
  }

  const Subject& subject_;
  const ir::Module& module_;
  std::vector<std::uint8_t> may_have_;  // per block, on arrival
  std::vector<std::uint8_t> entered_;   // per program: a caller may have set a feed
  std::vector<std::uint8_t> leaves_;    // per program: a feed may be set when it returns
};

/// The feed of the block, or null.
const ir::Word* FeedOf(const ir::Module& module, const ir::Block& block) {
  const ir::Word* feed = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module.words[id];
    if (word.op == WordOp::kFeed || word.op == WordOp::kFeedOnce) feed = &word;
  }
  return feed;
}

}  // namespace

void CheckFeed(const Subject& subject, diag::Sink& sink) {
  if (!subject.machine.feed_needed) return;
  const ir::Module& module = subject.module;
  const FeedFlow flow(subject);
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    const ir::analysis::Cfg& graph = subject.graphs.Of(program);
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const ir::Word* feed = FeedOf(module, block);
      const bool zero = feed != nullptr && feed->op == WordOp::kFeed && IsZero(module, *feed);
      if (!graph.Reachable(id) || (flow.MayHave(id) && !zero) || (block.flags & ir::Block::kRefused) != 0) continue;
      const ir::Word* moving = MovingWord(module, block);
      if (moving == nullptr || (feed != nullptr && !zero)) continue;
      const ir::ModalState modes = subject.modal.At(program, id);
      if (!IsFeedMotion(modes.motion) || modes.feed_mode == ir::FeedMode::kInverseTime) continue;
      diag::Diagnostic& finding = sink.Report(diag::Code::kMissingFeed, subject.PlaceOf(id, *moving));
      finding.help = zero ? "F0 is no feed" : "no block on the way here sets a feed: write F in this block";
      finding.control = dialects::AlarmFor(subject.profile, finding.code);
      break;  // once a program: the next moves lack the same word
    }
  }
}

}  // namespace ncport::check
