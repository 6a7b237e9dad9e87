// The checks behind the table of directions.
#pragma once

#include "tests/random/checks.h"

namespace ncport::tests::random {

/// Verifies, dumps and reads the dump back, runs both; every run must end by itself.
Finding CheckIr(const Subject& subject, const Direction& direction);

/// Prints SINUMERIK text and reads it back: it verifies, prints the same text again and does the same.
Finding CheckSinumerikText(const Subject& subject, const Direction& direction);

}  // namespace ncport::tests::random
