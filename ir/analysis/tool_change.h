// Which word of a program brings a tool into the spindle.
#pragma once

#include <cstdint>

#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::ir::analysis {

enum class ToolChange : std::uint8_t {
  kAtToolWord,         // the machine's setting (turrets; sinumerik-8.8, MD22550=0)
  kAtChangeWord,       // the tool word only makes the tool ready (fanuc-8.11; MD22550=1)
  kAssumedAtToolWord,  // as kAtChangeWord by the setting, but no program has a change word, and edges belong to the
                       // tool that is in: a tool that only stood ready would never be used. To be listed as an
                       // assumption.
};

/// Looks through all programs of the module.
ToolChange WhenToolsChange(const Module& module, const Machine& machine);

}  // namespace ncport::ir::analysis
