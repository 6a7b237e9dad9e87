#include <cstdint>
#include <set>

#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::CallId;
using ir::WordOp;
using ModalCall = ir::analysis::ModalFlow::ModalCall;

/// Axis that stands on the plane, 0 to 2; 3 = not known.
std::uint8_t NormalOf(ir::Plane plane) {
  switch (plane) {
    case ir::Plane::kXY:
      return 2;
    case ir::Plane::kZX:
      return 1;
    case ir::Plane::kYZ:
      return 0;
    default:
      return 3;
  }
}

/// What a block means for a modal call that is in force.
struct Meaning {
  const ir::Word* change = nullptr;     // of the tool
  const ir::Word* away = nullptr;       // a move to a place of the machine
  const ir::Word* tool_axis = nullptr;  // a move of no other axis
};

Meaning MeaningOf(const Subject& subject, const ir::Block& block, ir::Plane plane) {
  Meaning meaning;
  const ir::Word* axis = nullptr;
  bool only_tool_axis = true;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = subject.module.words[id];
    switch (word.op) {
      case WordOp::kToolChange:
        meaning.change = &word;
        break;
      case WordOp::kTool:
        if (subject.machine.tool_word_changes) meaning.change = &word;
        break;
      case WordOp::kMachineCoords:
      case WordOp::kReference:
        meaning.away = &word;
        break;
      case WordOp::kAxis:
        axis = &word;
        only_tool_axis = only_tool_axis && word.index == NormalOf(plane);
        break;
      case WordOp::kAxisComputed:
      case WordOp::kPolarAngle:
      case WordOp::kPolarRadius:
      case WordOp::kCenter:
      case WordOp::kFrame:
      case WordOp::kPole:
      case WordOp::kPresetPosition:
      case WordOp::kWhen:
        only_tool_axis = false;
        break;
      default:
        break;
    }
  }
  if (axis == nullptr) meaning.away = nullptr;
  if (axis != nullptr && only_tool_axis) meaning.tool_axis = axis;
  return meaning;
}

}  // namespace

void CheckModalCalls(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  std::set<std::uint32_t> told;
  for (const BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    if (block.words.Empty() || (block.flags & ir::Block::kRefused) != 0) continue;
    if (subject.modal.ModalCallBefore(program, id) != ModalCall::kActive) continue;
    const CallId call_id = subject.modal.ActiveModalCall(program, id);
    if (!call_id.Valid() || told.contains(call_id.value)) continue;
    const ir::Call& call = module.calls[call_id];
    // Cycles of the control drill where the axes of the plane stand; what a subprogram of the user does is its own.
    const bool cycle = call.program.Valid() && module.programs[call.program].library;
    const Meaning meaning = MeaningOf(subject, block, subject.modal.At(program, id).plane);
    const ir::Word* word = meaning.change;
    if (word == nullptr && cycle) word = meaning.away != nullptr ? meaning.away : meaning.tool_axis;
    if (word == nullptr) continue;
    told.insert(call_id.value);
    diag::Diagnostic& finding =
        sink.Report(diag::Code::kModalCallInForce, subject.PlaceOf(id, *word), module.View(call.name));
    for (const ir::analysis::CallSite& site : subject.calls.AllSites()) {
      if (site.call != call_id) continue;
      finding.notes.push_back({subject.PlaceOf(site.block, module.words[site.word]), "it begins here"});
      break;
    }
    if (word == meaning.change) {
      finding.help = "end it before the tool is changed";
    } else {
      finding.help = word == meaning.away
                         ? "it runs behind this move too: end it before"
                         : "it runs behind this move too, at the place of the last hole: end it before";
    }
  }
}

}  // namespace ncport::check
