#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "check/expressions.h"
#include "check/rules.h"
#include "ir/plane_axes.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::CallId;
using ir::WordOp;
using ModalCall = ir::analysis::ModalFlow::ModalCall;

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
        only_tool_axis = only_tool_axis && plane != ir::Plane::kUnknown && word.index == ir::AxesOf(plane).normal;
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

/// Whether the expression asks if a modal call is in force.
bool AsksForModalCall(const ir::Module& module, ir::ExprId id) {
  if (!id.Valid()) return false;
  const ir::Expr& expr = module.exprs[id];
  if (expr.op == ir::ExprOp::kSystem)
    return module.systems[ir::SystemId{std::size_t{expr.a}}].kind == ir::SystemKind::kModalCallActive;
  if (ir::OperandsOf(expr.op) != ir::Operands::kBinary) return false;
  return AsksForModalCall(module, ir::ExprId{std::size_t{expr.a}}) ||
         AsksForModalCall(module, ir::ExprId{std::size_t{expr.b}});
}

/// The alarm of a cycle that only moves from place to place and wants a modal call to do something there.
std::optional<double> AlarmWithoutModalCall(const ir::Module& module, ir::ProgramId cycle) {
  bool asked = false;
  for (const BlockId id : module.programs[cycle].blocks) {
    for (const ir::WordId word_id : module.blocks[id].words) {
      const ir::Word& word = module.words[word_id];
      if (asked && word.op == WordOp::kAlarm) return LiteralValue(module, word.value);
      if (word.op == WordOp::kIf) asked = AsksForModalCall(module, word.value);
    }
  }
  return std::nullopt;
}

/// Calls of such cycles where no modal call is in force on any way: they go to their places and do nothing there.
void CheckCallsWithoutModalCall(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  // A subprogram may be called with a modal call of programs that are not here.
  if (!subject.IsMain(program)) return;
  std::map<std::uint32_t, std::optional<double>> alarms;  // per cycle
  for (const BlockId id : module.programs[program].blocks) {
    const ir::Block& block = module.blocks[id];
    // A block that was not understood may hold the modal call.
    if ((block.flags & ir::Block::kRefused) != 0) return;
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = module.words[word_id];
      if (word.op != WordOp::kCall || !word.Extra<CallId>().Valid()) continue;
      const ir::ProgramId cycle = module.calls[word.Extra<CallId>()].program;
      if (!cycle.Valid() || !module.programs[cycle].library || !subject.modal.Reached(program, id) ||
          subject.modal.ModalCallBefore(program, id) != ModalCall::kNone)
        continue;
      const auto [known, fresh] = alarms.try_emplace(cycle.value);
      if (fresh) known->second = AlarmWithoutModalCall(module, cycle);
      if (!known->second) continue;
      diag::Diagnostic& finding = sink.ReportAs(diag::Severity::kWarning, diag::Code::kCallAlarms,
                                                subject.PlaceOf(id, word), fmt::format("{:.0f}", *known->second));
      finding.notes.push_back({{}, "no modal call is in force here"});
      finding.help = "it only goes from place to place: make the cycle that works there modal in front of it";
    }
  }
}

/// The word that makes the call modal; `otherwise` where it is not found.
SourceRange BeginOf(const Subject& subject, CallId call, const SourceRange& otherwise) {
  for (const ir::analysis::CallSite& site : subject.calls.AllSites()) {
    if (site.call == call) return subject.PlaceOf(site.block, subject.module.words[site.word]);
  }
  return otherwise;
}

}  // namespace

void CheckModalCalls(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  CheckCallsWithoutModalCall(subject, program, sink);
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
    const SourceRange here = subject.PlaceOf(id, *word);
    const bool changes = word == meaning.change;
    const bool away = word == meaning.away;
    // Where the missing end belongs is for the programmer to say: it is told where the call begins.
    diag::Diagnostic& finding =
        sink.Report(diag::Code::kModalCallInForce, BeginOf(subject, call_id, here), module.View(call.name),
                    changes ? "the tool changes"
                    : away  ? "the axes go to a place of the machine"
                            : "the tool moves by its own axis alone");
    finding.notes.push_back({here, changes ? "here"
                                   : away  ? "it runs behind this move too"
                                           : "it runs behind this move too, at the place of the last hole"});
    finding.help = "end it behind the last place that it is for";
  }
}

}  // namespace ncport::check
