// The flow graphs of a module, who calls whom, and the modal state on the way: what most passes ask, made together.
#pragma once

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/modal_state.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

/// What ForwardFlow asks. All of the same module; they outlive it.
struct FlowSources {
  const Module& module;
  const Machine& machine;
  const FlowGraphs& graphs;
  const CallGraph& calls;
  const ModalFlow* modal;  // none: a modal call may run behind any block with motion
};

/// `module` and `machine` outlive it. It holds for the module as it is now: a pass that makes blocks asks for the old
/// ones only.
class FlowAnalyses {
 public:
  FlowAnalyses(const Module& module, const Machine& machine, const ModalOptions& options)
      : module_(module),
        machine_(machine),
        graphs_(module),
        calls_(module),
        modal_(module, machine, graphs_, calls_, options) {}
  // The parts look at each other.
  FlowAnalyses(const FlowAnalyses&) = delete;
  FlowAnalyses& operator=(const FlowAnalyses&) = delete;

  [[nodiscard]] const FlowGraphs& Graphs() const { return graphs_; }
  [[nodiscard]] const CallGraph& Calls() const { return calls_; }
  [[nodiscard]] const ModalFlow& Modal() const { return modal_; }
  [[nodiscard]] FlowSources Sources() const { return {module_, machine_, graphs_, calls_, &modal_}; }

 private:
  const Module& module_;
  const Machine& machine_;
  FlowGraphs graphs_;
  CallGraph calls_;
  ModalFlow modal_;
};

}  // namespace ncport::ir::analysis
