// Subprograms that run after each block with motion.
#include <algorithm>

#include "exec/runner.h"

namespace ncport::exec {

/// The block itself runs nothing: program, arguments and locals are kept for the blocks to come (sinumerik-7.1).
bool Runner::StartModal(const ir::Word& word) {
  if (word.extra == ir::CallId::kNone) {
    if (!modals_.empty()) modals_.pop_back();
    facts_.modal_call = !modals_.empty();
    return false;
  }
  const auto id = word.Extra<ir::CallId>();
  const ir::Call& call = session_.module.calls[id];
  Modal modal;
  modal.call = id;
  if (call.form == ir::CallForm::kBlockRange) {
    session_.Refuse(diag::Code::kCannotRun, "a modal call of a block range");
    return true;
  }
  modal.program = Callee(call);
  if (session_.halted || !Passes(call, modal.passes) || !EvalArguments(call, modal.program, modal.given)) return true;
  if (modals_.size() >= session_.machine.modal_call_levels) {
    if (session_.machine.modal_call_levels != 1) {
      session_.Alarm(ir::AlarmClass::kNesting, "modal calls nested too deep");
      return true;
    }
    modals_.clear();  // one at a time: the new one replaces it
  }
  const auto used = [&](std::uint32_t place) {
    return std::ranges::any_of(modals_, [&](const Modal& other) { return other.place == place; }) ||
           std::ranges::any_of(
               levels_, [&](const Level& level) { return level.kind == LevelKind::kModal && level.modal == place; });
  };
  while (modal.place < session_.linked.ModalPlaces() && used(modal.place)) ++modal.place;
  if (modal.place == session_.linked.ModalPlaces()) {
    session_.Alarm(ir::AlarmClass::kNesting, "modal calls nested too deep");
    return true;
  }
  const Memory::Address cells = session_.linked.ModalPlace(modal.place);
  const Memory::Address frame = cells + session_.linked.LevelCells();
  for (Memory::Address cell = cells; cell < frame; ++cell) memory_[cell] = Value::Vacant();
  InitFrame(modal.program, frame);
  PutArguments(call, modal.program, cells, frame);
  modals_.push_back(modal);
  facts_.modal_call = true;
  return false;
}

/// After a block with motion. Inside a modal subprogram only those that were started before it run.
bool Runner::TriggerModal() {
  std::size_t count = modals_.size();
  for (const Level& level : levels_) {
    if (level.kind != LevelKind::kModal) continue;
    const auto running = std::ranges::find_if(modals_, [&](const Modal& modal) { return modal.place == level.modal; });
    count = std::min(count, static_cast<std::size_t>(running == modals_.end() ? 0 : running - modals_.begin()));
  }
  if (count == 0) return false;
  if (!Deeper()) return true;
  Modal& modal = modals_[count - 1];
  Level level = CalledLevel(LevelKind::kModal, modal.program, modal.passes);
  level.modal = modal.place;
  level.keeps_locals = modal.started && session_.machine.modal_call_keeps_locals;
  level.facts.given = modal.given;
  const Memory::Address kept = session_.linked.ModalPlace(modal.place);
  Memory::Address cells = kept;
  if (!session_.machine.modal_call_keeps_locals) {
    const std::uint32_t size = session_.linked.LevelCells() + session_.linked.FrameSize(modal.program);
    cells = memory_.Push(size);
    if (cells == Memory::kNoRoom) {
      session_.Limit("--max-cells", diag::Code::kCellLimit, session_.options.max_cells);
      return true;
    }
    for (std::uint32_t i = 0; i < size; ++i) memory_[cells + i] = memory_[kept + i];
  }
  level.facts.level = cells;
  level.facts.frame = cells + session_.linked.LevelCells();
  modal.started = true;
  EnterCalled(level);
  return true;
}

}  // namespace ncport::exec
