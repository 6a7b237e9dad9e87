// All that crosses a line of a Fanuc file.
#pragma once

#include <cstdint>
#include <vector>

#include "ir/nodes.h"

namespace ncport::frontend::fanuc {

struct ReaderState {
  ir::ProgramId program;      // that the lines belong to
  bool program_used = false;  // it holds words besides marks of the file
  /// Loops that are open, by their DO number: END does not say whether WHILE stood before DO.
  struct OpenLoop {
    std::uint8_t number = 0;
    bool endless = false;
  };
  std::vector<OpenLoop> loops;
};

}  // namespace ncport::frontend::fanuc
