// A raised module as SINUMERIK files: one a program, or the files of the source where the language stays.
#pragma once

#include "backends/translate.h"

namespace ncport::backends::sinumerik {

std::vector<OutputFile> Write(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers);

}  // namespace ncport::backends::sinumerik
