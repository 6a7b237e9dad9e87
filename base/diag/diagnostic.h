// One finding, as data. Renderers turn it into text, JSON, SARIF or annotations.
#pragma once

#include <string>
#include <vector>

#include "base/diag/codes.h"
#include "base/source_range.h"

namespace ncport::diag {

/// A second place or a reason. The place may be missing.
struct Note {
  SourceRange at;
  std::string text;
};

/// Text that repairs the finding when it replaces the text at `at`.
struct Fix {
  SourceRange at;
  std::string replacement;
};

struct Diagnostic {
  Code code;
  Severity severity;
  SourceRange at;  // invalid: the run as a whole
  std::string message;
  std::vector<Note> notes;
  std::string help;     // the remedy, empty if none is known
  std::string control;  // the alarm of the control with its number, only where it is certain; else empty
  std::vector<Fix> fixes;
};

}  // namespace ncport::diag
