#include "backends/fanuc/change_states.h"

#include "ir/literal_value.h"

namespace ncport::backends::fanuc {

using ir::Block;
using ir::BlockId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

ChangeStates::ChangeStates(const RaiseInput& input, const ir::Module& module)
    : module_(module), analyses_(module, *input.source_machine, {}), flow_(analyses_.Sources(), *this) {
  flow_.Run();
}

ChangeStates::State ChangeStates::Before(BlockId block) const {
  const State* state = flow_.Before(block);
  return state == nullptr ? State{} : *state;
}

bool ChangeStates::Join(BlockId, State& into, const State& from) const {
  const State before = into;
  if (into.coolant != from.coolant) into.coolant = Coolant::kMaybe;
  if (into.speed != from.speed) into.speed = SurfaceSpeed::kMaybe;
  return into != before;
}

void ChangeStates::Transfer(ir::ProgramId, BlockId block, State& state) const {
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op == WordOp::kSpeedMode) {
      state.speed = word.index == static_cast<std::uint8_t>(ir::SpeedMode::kConstantSurface) ? SurfaceSpeed::kOn
                                                                                             : SurfaceSpeed::kOff;
    } else if (word.op == WordOp::kAux) {
      const auto number = ir::WholeNumber(module_, word.value);
      if (number == 7U) state.coolant = Coolant::kM7;
      if (number == 8U) state.coolant = Coolant::kM8;
      if (number == 9U) state.coolant = Coolant::kOff;
    }
  }
}

bool ChangeStates::SpeedFollows(ir::ProgramId program, BlockId from) const {
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  ir::Motion motion = analyses_.Modal().At(program, from).motion;
  for (std::uint32_t i = from.value + 1; i < blocks.begin + blocks.count; ++i) {
    const Block& block = module_.blocks[BlockId{std::size_t{i}}];
    if (block.label.Valid() || block.skip_level != Block::kNoSkip) return false;
    bool moves = false;
    for (const WordId id : block.words) {
      const Word& word = module_.words[id];
      if (word.op == WordOp::kSpeedMode) return true;
      if (word.op == WordOp::kProgramEnd) return true;
      if (word.phase == ir::Phase::kFlow || word.phase == ir::Phase::kLast) return false;
      if (word.op == WordOp::kMotion) motion = static_cast<ir::Motion>(word.index);
      moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius;
    }
    if (moves && motion != ir::Motion::kRapid) return false;
  }
  return false;
}

}  // namespace ncport::backends::fanuc
