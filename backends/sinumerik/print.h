// Prints programs of the IR as SINUMERIK text in normal form: blanks between words, `=` in front of expressions,
// definitions in full. Decides nothing: what stands in the module is printed, with numbers, comments, blank lines,
// indents, block numbers and brackets as they were written. Reading the text gives the same module again.
#pragma once

#include "base/source_range.h"
#include "base/text_buffer.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::backends::sinumerik {

/// Appends all programs of one file. A word that the language does not have is a bug: raise and the legality check
/// stand before.
void PrintFile(const ir::Module& module, FileId file, const dialects::Profile& profile, TextBuffer& out);

/// Appends one expression.
void PrintExpr(const ir::Module& module, ir::ExprId expr, const dialects::Profile& profile, TextBuffer& out);

}  // namespace ncport::backends::sinumerik
