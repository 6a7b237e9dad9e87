// The tables of the languages whose rows are swapped with their neighbours.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/faults/seam.h"

namespace ncport::tests::faults {

struct SeededTable {
  std::string name;   // of the fault: "sinumerik codes: G0 <-> G1 (printed)"
  std::string plain;  // without the count of those that are called the same
  std::string language;
  std::string text_a, text_b;
  TableFault fault;
  std::function<void()> swap;  // exchanges the texts for good; code tables on the side of readers
};

/// Each row with the next one that means something else, for readers and for printers.
std::vector<SeededTable> ListTableFaults();

}  // namespace ncport::tests::faults
