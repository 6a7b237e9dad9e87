// Gives every variable a numbered cell of the target, for languages without names: parameters to the cells of argument
// letters, locals to the free cells of a level, cells of the source's spaces to common cells. By-reference parameters
// travel through common cells, copied in before the call and out behind it. The map is the result: it stands in the
// output's header.
//
// Run last before printing: after it no Variable or Element node is left, and no cell of a space of the source.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/diag/sink.h"
#include "ir/module.h"

namespace ncport::ir::transform {

struct CellRange {
  std::uint32_t first = 0, last = 0;
};

/// An argument letter and the local cell that its value arrives in.
struct ArgumentLetter {
  char letter = 0;
  std::uint32_t cell = 0;
};

/// A variable of the source with its place in the target.
struct CellMapping {
  ProgramId program;        // owner; invalid = common
  std::string source;       // "EXTD", "R10", "VEC[0] to VEC[4]"
  std::string target;       // "#101", or a name ("U_A", "R10")
  VariableId variable;      // named variables
  std::uint32_t first = 0;  // cell
  std::uint32_t count = 1;
  char letter = 0;        // parameters
  bool common = false;    // lives outside of the calls
  bool outlives = false;  // kept by the source when the program ends: final values are compared
  SpaceId source_space;   // cells
  std::uint32_t source_cell = 0;
};

struct NamesToNumbersConfig {
  std::string space = "#";
  CellRange cells{0, 999};                       // that exist
  CellRange locals{1, 33};                       // one set for each call level
  std::vector<std::uint32_t> free_locals_first;  // taken before others: cells that no letter uses
  std::vector<ArgumentLetter> letters;           // in the order of use
  ArgumentLetter feed_letter;                    // for the parameter that is a feed; letter 0 = none
  std::vector<CellRange> scratch;                // common cells that translated programs may use
  struct Pin {
    std::string source;  // "R10", "GLOBAL_NAME", "PROG.NAME"
    std::uint32_t cell = 0;
  };
  std::vector<Pin> pins;
  /// Programs that were cut from one: the same parameter has the same letter in all of them, and each gets only the
  /// letters that it reads.
  std::vector<std::vector<ProgramId>> parts;
  bool ignore_case = true;
  /// Locals of the source's modal subprograms keep their values between runs, and their definitions do not run again.
  bool modal_keeps_locals = false;
};

struct NamesToNumbersResult {
  bool ok = false;
  std::vector<CellMapping> map;
};

/// The whole module. What cannot travel (text variables, aliases of references, too many arguments) is a finding at its
/// place.
NamesToNumbersResult NamesToNumbers(Module& module, const NamesToNumbersConfig& config, diag::Sink& sink);

}  // namespace ncport::ir::transform
