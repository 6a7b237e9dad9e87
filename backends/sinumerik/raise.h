// Rewrites a module into one that SINUMERIK can say. The list of passes in raise.cc is the documentation of what the
// target cannot say.
#pragma once

#include <cstdint>

#include "backends/common/translation.h"
#include "base/diag/sink.h"
#include "dialects/config.h"
#include "dialects/profile.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/machine.h"

namespace ncport::backends::sinumerik {

struct RaiseInput {
  const ir::Module* source = nullptr;
  const dialects::Profile* source_profile = nullptr;
  const ir::Machine* source_machine = nullptr;
  const dialects::Profile* profile = nullptr;  // of the target
  const dialects::Config* config = nullptr;
  /// Letter by which calls of the source reach a local cell; 0 = none reaches it. Null: the source has no letters.
  char (*argument_letter)(std::uint32_t cell) = nullptr;

  /// The modal state that [entry] declares for programs that nothing here calls.
  [[nodiscard]] ir::ModalState SubEntry() const { return config != nullptr ? config->entry : ir::ModalState{}; }
  /// Flow and modes of the module, on the machine of the source.
  [[nodiscard]] ir::analysis::FlowAnalyses Analyse(const ir::Module& module) const {
    return {module, *source_machine, {source_machine->start, SubEntry()}};
  }
};

/// What cannot be said is a finding (NC6xxx) at its place, several per run; returns false then.
bool Raise(const RaiseInput& input, Translation& out, diag::Sink& sink);

}  // namespace ncport::backends::sinumerik
