// What the codes of flat blocks mean, as data. Card: docs/languages/iso.md.
#pragma once

#include "dialects/code_table.h"

namespace ncport::dialects::iso {

/// G and M codes that are complete in themselves. Those that need words beside them (G4, G54.1, the speed limit) are
/// known by the reader: their form is the profile's. Any other G code is an error.
const CodeTable& Codes();

/// M functions without a row: whatever the machine's builder gave them. Word::value is the number.
const CodeRow& AuxiliaryCode();

}  // namespace ncport::dialects::iso
