// A raised module as files of the Fanuc family: one text with O numbers, or a file for each program.
#pragma once

#include "backends/translate.h"

namespace ncport::backends::fanuc {

std::vector<OutputFile> Write(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers);

}  // namespace ncport::backends::fanuc
