// Reasons for which a program may be refused: tests/refusals.txt.
#pragma once

#include <string>
#include <string_view>

#include "base/diag/sink.h"

namespace ncport::tests::random {

/// The number and message of the first error, numbers as `#` and names as `*`: "NC6001 a tool, * and #".
std::string ReasonOf(const diag::Sink& sink);

/// True if a line of the list says this reason.
bool IsListed(std::string_view reason);

}  // namespace ncport::tests::random
