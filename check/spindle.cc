// A cut before the first start of the spindle, or with a new tool and no new start.
#include "check/motion_words.h"
#include "check/rules.h"
#include "ir/analysis/forward_flow.h"
#include "ir/analysis/main_programs.h"
#include "ir/motions.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::WordOp;

bool Turns(const ir::Word& word) {
  const auto state = static_cast<ir::SpindleState>(word.extra);
  return word.op == WordOp::kSpindle && (state == ir::SpindleState::kCw || state == ir::SpindleState::kCcw);
}

/// What the spindles may do, as bits: one that may turn is enough for a cut.
class SpindleFlow {
 public:
  using State = std::uint8_t;
  /// kStopped: behind a stop a move is one that is meant, a probe or a way out, until another tool comes.
  static constexpr State kStand = 1, kTurn = 2, kStopped = 4, kEither = kStand | kTurn;

  explicit SpindleFlow(const Subject& subject)
      : module_(subject.module),
        flow_({subject.module, subject.machine, subject.graphs, subject.calls, &subject.modal}, *this) {
    flow_.Run();
  }

  /// True if no way to the block starts a spindle.
  [[nodiscard]] bool Stands(BlockId block) const {
    const State* state = flow_.Before(block);
    if (state == nullptr || *state != kStand) return false;
    State own = *state;
    Through(module_.blocks[block], own);
    return own == kStand;
  }

  // For ForwardFlow. What nothing here calls may be called with a spindle that turns.
  State Entry(ir::ProgramId program) const { return ir::analysis::StartsAsMain(module_, program) ? kStand : kEither; }
  static State Unknown(ir::ProgramId) { return kEither; }
  static bool Join(BlockId, State& into, const State& from) {
    const State joined = into | from;
    const bool changed = joined != into;
    into = joined;
    return changed;
  }
  void Transfer(ir::ProgramId, BlockId block, State& state) const { Through(module_.blocks[block], state); }

 private:
  void Through(const ir::Block& block, State& state) const {
    if ((block.flags & ir::Block::kRefused) != 0) state = kEither;
    for (const ir::WordId id : block.words) {
      const ir::Word& word = module_.words[id];
      switch (word.op) {
        case WordOp::kSpindle:
          if (Turns(word))
            state = kTurn;
          else
            state = static_cast<ir::SpindleState>(word.extra) == ir::SpindleState::kStop ? kStopped : kEither;
          break;
        case WordOp::kTool:
        case WordOp::kToolChange:
          if (state == kStopped) state = kStand;
          break;
        case WordOp::kSpeed:  // a speed that nothing starts is told by CheckSpindleSpeed
        case WordOp::kAux:    // the builder's: M13 starts spindle and coolant
        case WordOp::kComputedM:
        case WordOp::kVerbatim:
          state = kEither;
          break;
        default:
          break;
      }
    }
  }

  const ir::Module& module_;
  ir::analysis::ForwardFlow<SpindleFlow> flow_;
};

}  // namespace

void CheckSpindle(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  // A program that never starts a spindle has one that the operator starts, or none.
  bool starts = false;
  for (const ir::Word& word : module.words.All()) starts = starts || Turns(word);
  if (!starts) return;
  const SpindleFlow flow(subject);
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library || subject.graphs.Of(program).Opaque()) continue;
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      if ((block.flags & ir::Block::kRefused) != 0 || !flow.Stands(id)) continue;
      const ir::Word* moving = MovingWord(module, block);
      if (moving == nullptr || !ir::IsFeedMotion(subject.modal.At(program, id).motion)) continue;
      sink.Report(diag::Code::kSpindleOff, subject.PlaceOf(id, *moving)).help =
          "no block on the way here starts the spindle: write M3 or M4 before it";
      break;  // once a program: the next moves lack the same word
    }
  }
}

}  // namespace ncport::check
