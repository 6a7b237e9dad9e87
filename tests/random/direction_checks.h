// The checks behind the table of directions.
#pragma once

#include "tests/random/checks.h"

namespace ncport::tests::random {

/// Verifies, dumps and reads the dump back, runs both; every run must end by itself.
Finding CheckIr(const Subject& subject, const Direction& direction);

/// Prints text of the program's own language and reads it back: it verifies, prints the same text again and does the
/// same.
Finding CheckText(const Subject& subject, const Direction& direction);

/// Translates the program and compares both programs, as `ncport translate --verify` does.
Finding CheckTranslation(const Subject& subject, const Direction& direction);

/// Translates the program, and its translation back; the second way is compared as the first one.
Finding CheckTranslationBack(const Subject& subject, const Direction& direction);

/// Flattens each run, reads the flat blocks back and compares what both do.
Finding CheckFlat(const Subject& subject, const Direction& direction);

/// Changes values, so that runs alarm, and looks whether check announced each alarm of arithmetic, ranges and indices.
Finding CheckAnnounced(const Subject& subject, const Direction& direction);

}  // namespace ncport::tests::random
