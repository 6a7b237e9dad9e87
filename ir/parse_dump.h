// Reads the text of ir/dump.h back. Lossless: the dump of the result is the dump that was read.
#pragma once

#include <string_view>

#include "base/diag/sink.h"
#include "base/result.h"
#include "ir/module.h"

namespace ncport::ir {

/// The module of a dump. What does not read, or would not verify, is a finding with its place in the dump (of `file`),
/// one a line, and the result fails. The text may be hostile: depths, sizes and references are checked.
Result<Module> ParseDump(std::string_view text, diag::Sink& sink, FileId file = {});

}  // namespace ncport::ir
