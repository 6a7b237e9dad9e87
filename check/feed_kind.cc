#include <cstdint>

#include "check/expressions.h"
#include "check/motion_words.h"
#include "check/rules.h"
#include "ir/analysis/forward_flow.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::FeedMode;
using ir::ProgramId;
using ir::WordOp;

// Kinds that the last feed on the ways to a block has: a set of these.
constexpr std::uint8_t kNone = 1;  // no feed yet
constexpr std::uint8_t kPerMinute = 2;
constexpr std::uint8_t kPerRevolution = 4;
constexpr std::uint8_t kAnything = 128;

std::uint8_t KindOf(FeedMode mode) {
  if (mode == FeedMode::kPerMinute) return kPerMinute;
  return mode == FeedMode::kPerRevolution ? kPerRevolution : kAnything;
}

class FeedKindFlow {
 public:
  using State = std::uint8_t;

  explicit FeedKindFlow(const Subject& subject) : subject_(subject), module_(subject.module) {}

  State Entry(ProgramId program) const { return subject_.IsMain(program) ? kNone : kAnything; }
  static State Unknown(ProgramId) { return kAnything; }
  static bool Join(BlockId, State& into, const State& from) {
    const State old = into;
    into |= from;
    return into != old;
  }
  void Transfer(ProgramId program, BlockId id, State& state) const {
    const ir::Block& block = module_.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) state |= kAnything;
    for (const ir::WordId word_id : block.words) {
      switch (module_.words[word_id].op) {
        case WordOp::kFeed:
          state = KindOf(subject_.modal.At(program, id).feed_mode);
          break;
        case WordOp::kComputedG:
        case WordOp::kVerbatim:
        case WordOp::kDataSetting:
          state |= kAnything;
          break;
        default:
          break;
      }
    }
  }

 private:
  const Subject& subject_;
  const ir::Module& module_;
};

bool TakesFeed(ir::Motion motion) {
  return motion == ir::Motion::kLinear || motion == ir::Motion::kArcCw || motion == ir::Motion::kArcCcw;
}

bool WritesFeed(const ir::Module& module, const ir::Block& block) {
  for (const ir::WordId id : block.words) {
    if (module.words[id].op == WordOp::kFeed || module.words[id].op == WordOp::kFeedOnce) return true;
  }
  return false;
}

}  // namespace

void CheckFeedKind(const Subject& subject, diag::Sink& sink) {
  if (!subject.machine.feed_needed || !subject.machine.feed_type_change_drops_feed) return;
  const ir::Module& module = subject.module;
  FeedKindFlow client(subject);
  ir::analysis::ForwardFlow<FeedKindFlow> flow({module, subject.machine, subject.graphs, subject.calls, &subject.modal},
                                               client);
  flow.Run();
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const std::uint8_t* kinds = flow.Before(id);
      if (kinds == nullptr || (block.flags & ir::Block::kRefused) != 0 || WritesFeed(module, block)) continue;
      const ir::Word* moving = MovingWord(module, block);
      if (moving == nullptr) continue;
      const ir::ModalState modes = subject.modal.At(program, id);
      const std::uint8_t wanted = KindOf(modes.feed_mode);
      if (!TakesFeed(modes.motion) || wanted == kAnything || (*kinds & (kAnything | wanted)) != 0 || *kinds == kNone)
        continue;
      const bool minutes = wanted == kPerMinute;
      diag::Diagnostic& finding = sink.Report(diag::Code::kMissingFeed, subject.PlaceOf(id, *moving));
      finding.notes.push_back({{},
                               minutes ? "the last F was a feed per revolution, now feeds are per minute"
                                       : "the last F was a feed per minute, now feeds are per revolution"});
      finding.help = "a change of the kind of feed needs a new F";
      break;  // once a program: the next moves lack the same word
    }
  }
}

}  // namespace ncport::check
