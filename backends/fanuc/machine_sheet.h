// What a machine of the family must have for the programs that are written for it, and what to try on it first.
#pragma once

#include <vector>

#include "backends/common/machine_sheet.h"
#include "backends/translate.h"

namespace ncport::backends::fanuc {

MachineSheet SheetOf(const dialects::Profile& profile, const std::vector<OutputFile>& files);

}  // namespace ncport::backends::fanuc
