// What the rules look at: the programs, the machine they run on, and what is derived from both, made once.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "dialects/profile.h"
#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/main_programs.h"
#include "ir/analysis/modal_state.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::check {

struct Subject {
  /// `module` with resolved names. `sub_entry`: modal state in which programs start that nothing here calls.
  Subject(const ir::Module& module, const dialects::Profile& profile, const ir::ModalState& sub_entry);

  const ir::Module& module;
  const dialects::Profile& profile;
  ir::Machine machine;
  bool ignore_case;         // names and labels compare without regard to case
  bool has_cycles = false;  // a canned cycle begins in some program
  ir::analysis::FlowGraphs graphs;
  ir::analysis::CallGraph calls;
  ir::analysis::ModalFlow modal;

  /// True if a run starts in the program with nothing given: no tool, no spindle, no feed.
  [[nodiscard]] bool IsMain(ir::ProgramId program) const { return ir::analysis::StartsAsMain(module, program); }

  [[nodiscard]] SourceRange PlaceOf(ir::BlockId block) const;
  [[nodiscard]] SourceRange PlaceOf(ir::BlockId block, const ir::Word& word) const;
  [[nodiscard]] SourceRange PlaceOf(const ir::Variable& variable) const;
  /// The label of the block; the line as a whole where a number or a skip mark stands in front of it.
  [[nodiscard]] SourceRange PlaceOfLabel(ir::BlockId block) const;

  /// The name as names compare: upper case where case does not count.
  [[nodiscard]] std::string KeyOf(std::string_view name) const;
  /// True if a block of the program that was not understood holds the name as a whole word: what it does with it is not
  /// known, and it has its finding.
  [[nodiscard]] bool InRefusedBlock(ir::ProgramId program, std::string_view name) const;

  /// True if such a block holds a word that is spelled nearly so: the name may be meant there.
  [[nodiscard]] bool NearRefusedWord(ir::ProgramId program, std::string_view name) const;

 private:
  std::vector<std::unordered_set<std::string>> refused_words_;  // per program, as KeyOf
};

}  // namespace ncport::check
