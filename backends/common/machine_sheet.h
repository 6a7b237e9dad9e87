// What the sheet of a translation says of the machine, whatever the program is.
#pragma once

#include <string>
#include <vector>

namespace ncport::backends {

/// An assumption that only the machine can confirm, with blocks to try in MDI.
struct MachineTest {
  std::string text;
  std::string rule;  // card row and profile key
  std::vector<std::string> blocks;
};

struct MachineSheet {
  std::vector<std::string> required;  // G-code system, options, memory
  std::vector<MachineTest> tests;     // those that words of the output rest on
};

}  // namespace ncport::backends
