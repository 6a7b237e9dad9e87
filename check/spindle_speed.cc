#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>

#include "check/expressions.h"
#include "check/motion_words.h"
#include "check/rules.h"
#include "ir/analysis/forward_flow.h"
#include "ir/analysis/main_programs.h"
#include "ir/motions.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ProgramId;
using ir::WordOp;

// What may hold on the ways to a block: a set of these.
constexpr std::uint8_t kIdle = 1;        // neither a speed nor a start of the spindle yet
constexpr std::uint8_t kOnNoSpeed = 2;   // started, and no speed was ever set
constexpr std::uint8_t kReady = 4;       // runs with a speed
constexpr std::uint8_t kSpeedOnly = 8;   // a speed was set since the start of the program or since the stop
constexpr std::uint8_t kStopped = 16;    // ran before; its speed is still set
constexpr std::uint8_t kAnything = 128;  // something that is not known may have set any of it

struct SpindleFlowState {
  std::uint8_t ways = 0;
  BlockId started;  // of kOnNoSpeed: the first of the text
};

/// Moves each way of the set to where `step` leads.
template <class Step>
void Move(std::uint8_t& ways, Step step) {
  std::uint8_t next = ways & kAnything;
  for (std::uint8_t way = kIdle; way <= kStopped; way = static_cast<std::uint8_t>(way << 1U)) {
    if ((ways & way) != 0) next |= step(way);
  }
  ways = next;
}

std::uint8_t WithSpeed(std::uint8_t way) {
  if (way == kIdle || way == kStopped) return kSpeedOnly;
  return way == kOnNoSpeed ? kReady : way;
}
std::uint8_t Started(std::uint8_t way) {
  if (way == kIdle) return kOnNoSpeed;
  return way == kOnNoSpeed ? way : kReady;
}
std::uint8_t Halted(std::uint8_t way) {
  if (way == kOnNoSpeed) return kIdle;
  return way == kIdle ? way : kStopped;
}

class SpindleFlow {
 public:
  using State = SpindleFlowState;

  explicit SpindleFlow(const ir::Module& module) : module_(module) {}

  State Entry(ProgramId program) const {
    // What nothing here calls is called with any state.
    return {ir::analysis::StartsAsMain(module_, program) ? kIdle : kAnything, {}};
  }
  static State Unknown(ProgramId) { return {kAnything, {}}; }
  static bool Join(BlockId, State& into, const State& from) {
    const State old = into;
    into.ways |= from.ways;
    if (from.started.Valid() && (!into.started.Valid() || from.started.value < into.started.value))
      into.started = from.started;
    return into.ways != old.ways || into.started != old.started;
  }
  void Transfer(ProgramId, BlockId id, State& state) const {
    BeforeMotion(id, state);
    if (Has(id, [](const ir::Word& word) {
          return word.op == WordOp::kSpindlePosition ||
                 (word.op == WordOp::kSpindle && word.extra != static_cast<std::uint32_t>(ir::SpindleState::kCw) &&
                  word.extra != static_cast<std::uint32_t>(ir::SpindleState::kCcw));
        }))
      Move(state.ways, Halted);
    if (Has(id, [](const ir::Word& word) { return word.op == WordOp::kProgramEnd; })) Move(state.ways, Halted);
  }

  /// What the block does to the spindle before it moves.
  void BeforeMotion(BlockId id, State& state) const {
    const ir::Block& block = module_.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0 || Has(id, [this](const ir::Word& word) { return IsUnknown(word); })) {
      state.ways |= kAnything;
      return;
    }
    if (Has(id, [](const ir::Word& word) { return word.op == WordOp::kSpeed; })) Move(state.ways, WithSpeed);
    if (!Has(id, [](const ir::Word& word) { return Starts(word); })) return;
    if ((state.ways & kIdle) != 0) state.started = id;
    Move(state.ways, Started);
  }

  static bool Starts(const ir::Word& word) {
    return word.op == WordOp::kSpindle && (word.extra == static_cast<std::uint32_t>(ir::SpindleState::kCw) ||
                                           word.extra == static_cast<std::uint32_t>(ir::SpindleState::kCcw));
  }

 private:
  template <class Test>
  [[nodiscard]] bool Has(BlockId id, Test test) const {
    for (const ir::WordId word : module_.blocks[id].words) {
      if (test(module_.words[word])) return true;
    }
    return false;
  }

  /// M functions of the builder may start the spindle; coolant does not.
  [[nodiscard]] bool IsUnknown(const ir::Word& word) const {
    switch (word.op) {
      case WordOp::kComputedM:
      case WordOp::kComputedG:
      case WordOp::kVerbatim:
      case WordOp::kDataSetting:
        return true;
      case WordOp::kAux: {
        const std::optional<double> number = LiteralValue(module_, word.value);
        return !number || *number < 7 || *number > 9;
      }
      default:
        return false;
    }
  }

  const ir::Module& module_;
};

/// A second spindle has words of its own, and which one cuts is not known.
bool OneSpindle(const ir::Module& module) {
  return std::ranges::none_of(module.words.All(), [](const ir::Word& word) {
    return (word.op == WordOp::kSpindle || word.op == WordOp::kSpeed || word.op == WordOp::kSpindlePosition) &&
           word.index != 0;
  });
}

}  // namespace

void CheckSpindleSpeed(const Subject& subject, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  if (!OneSpindle(module)) return;
  SpindleFlow client(module);
  ir::analysis::ForwardFlow<SpindleFlow> flow({module, subject.machine, subject.graphs, subject.calls, &subject.modal},
                                              client);
  flow.Run();
  std::set<std::uint32_t> told;  // blocks that start the spindle
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    bool stands = false;
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const SpindleFlowState* before = flow.Before(id);
      if (before == nullptr || (block.flags & ir::Block::kRefused) != 0) continue;
      const ir::Word* moving = MovingWord(module, block);
      if (moving == nullptr || !ir::IsFeedMotion(subject.modal.At(program, id).motion)) continue;
      SpindleFlowState at = *before;
      client.BeforeMotion(id, at);
      if (at.ways == kSpeedOnly && !stands) {
        sink.Report(diag::Code::kSpindleOff, subject.PlaceOf(id, *moving)).help =
            "a speed is set, but no block on the way here starts the spindle with it";
        stands = true;  // the next moves lack the same word
      }
      if (at.ways != kOnNoSpeed || !at.started.Valid() || !told.insert(at.started.value).second) continue;
      const ir::Word* start = nullptr;
      for (const ir::WordId word : module.blocks[at.started].words) {
        if (SpindleFlow::Starts(module.words[word])) start = &module.words[word];
      }
      diag::Diagnostic& finding = sink.Report(diag::Code::kSpindleOff, subject.PlaceOf(at.started, *start));
      finding.notes.push_back({{}, "the spindle is started here without a speed"});
      finding.notes.push_back({subject.PlaceOf(id, *moving), "this move is the first that cuts so"});
      finding.help = "no block on the way to the move sets a speed: write S";
    }
  }
}

}  // namespace ncport::check
