// Gives the numbered variables of a call level names, for languages with parameters and local variables: argument cells
// become parameters, cells that a subprogram shares with its caller (M98) parameters by reference, all others locals.
// Numbered variables that all programs see become cells of the target's own space.
//
// Run last before printing. It makes the definitions: PROC, EXTERN and DEF blocks at the head of each program.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/diag/sink.h"
#include "ir/module.h"
#include "ir/transform/names_to_numbers.h"

namespace ncport::ir::transform {

struct NumbersToNamesConfig {
  std::string prefix = "U_";
  /// Letter that reaches a cell as an argument; 0 = none. Cells without one are named by their number.
  std::function<char(std::uint32_t cell)> letter_of;
  std::string space = "R";  // of the target, for common cells
  CellRange cells{0, 99};
  struct Pin {
    std::uint32_t source = 0, target = 0;
  };
  std::vector<Pin> pins;
  /// Common cells from here on take the target's cells from the first one up, in step; others from the last one down.
  std::uint32_t first_in_step = 100;
  /// Local cells that programs read as their caller left them (VacantValuesResult).
  std::set<std::pair<ProgramId, std::uint32_t>> read_at_entry;
  std::set<std::uint32_t> written_at_end;  // common cells whose final values are compared
};

struct NumbersToNamesResult {
  bool ok = true;
  std::vector<CellMapping> map;
};

/// The whole module. What has no form is a finding (NC6001) at its block.
NumbersToNamesResult NumbersToNames(Module& module, const NumbersToNamesConfig& config, diag::Sink& sink);

}  // namespace ncport::ir::transform
