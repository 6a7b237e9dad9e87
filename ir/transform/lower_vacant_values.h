// Makes explicit what an empty (vacant) variable does, for targets whose variables always hold a number: an empty one
// holds 0 from here on, as arithmetic reads it anyway, and where emptiness itself matters (a word that is not there, EQ
// and NE, a copy, an argument) the data flow tells whether the variable is empty. Where it is empty on some ways only,
// a truth value beside the variable says whether it holds a number (space "given": the same numbers as the locals).
//
// Run after ConditionalBlocks and SplitStatements. Afterwards no Vacant node, no kVacantDiffers and no kVanishesVacant
// is left.
#pragma once

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>

#include "base/diag/sink.h"
#include "ir/analysis/vacancy.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::transform {

/// Arg::position of the truth value that belongs to the argument for cell `position - kGivenArgument`.
inline constexpr std::uint16_t kGivenArgument = 1000;
/// Name of the space of truth values.
inline constexpr std::string_view kGivenSpace = "given";

struct VacantValuesResult {
  bool ok = true;
  /// Local cells that a program reads as its caller left them; programs that nothing calls included.
  std::set<std::pair<ProgramId, std::uint32_t>> read_at_entry;
  /// Common cells that are read on some way as they were before the run, declared ones included.
  std::set<std::uint32_t> common_at_entry;
  /// Arguments that were taken for given (VacancyConfig::given).
  std::set<std::pair<ProgramId, std::uint32_t>> taken_for_given;
  /// Common cells that every run of a main program to its end has written.
  std::set<std::uint32_t> written_at_end;
};

/// The whole module. A common variable whose emptiness matters and is not known is a finding (NC6001) at its block.
VacantValuesResult LowerVacantValues(Module& module, const Machine& source, const analysis::VacancyConfig& config,
                                     diag::Sink& sink);

}  // namespace ncport::ir::transform
