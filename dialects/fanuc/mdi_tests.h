// What a port to a MAZAK turning machine rests on and only the machine can confirm: the profile setting, the card's
// row, and a test of two blocks in MDI (mazak-lathe-11). For the assumption sheet of the report.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dialects/fanuc/words.h"

namespace ncport::dialects::fanuc {

struct MdiTest {
  std::string_view id;             // "SP1"
  std::string_view key;            // of the profile: "spindle.cw"
  std::string_view question;       // what is assumed
  std::string_view first, second;  // the blocks; second may be empty
  std::string_view result;         // what the machine's answer means
  std::string_view marker;         // text of the output that rests on it; empty: every output does
  bool series_t = true, series_m = true;
};

/// In the order of the card. All of MAZAK turning machines.
std::span<const MdiTest> MdiTests();

}  // namespace ncport::dialects::fanuc
