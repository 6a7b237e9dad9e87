// All that crosses a line of a SINUMERIK file.
#pragma once

#include <string>

#include "frontend/sinumerik/macros.h"
#include "ir/nodes.h"

namespace ncport::frontend::sinumerik {

struct ReaderState {
  ir::ProgramId program;         // that the lines belong to
  Macros macros;                 // DEFINE of this program
  bool named_by_header = false;  // the program has a %_N_ line: a PROC word does not rename it
  bool definitions_open = true;  // no executable block yet
  bool definition_file = false;  // .DEF: DEF NCK, DEF CHAN
  bool other_language = false;   // behind G291, up to G290
  bool no_program = false;       // data or masks in an archive
};

}  // namespace ncport::frontend::sinumerik
