// The standard cycles that ncport brings along as SINUMERIK text (cycles/*.spf, compiled in): those whose motion the
// card gives in full (8.12, "Motion from the cycle sources"). Any other cycle of the control is not here, so that a
// call of it is refused by its name.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace ncport::dialects::sinumerik {

/// Text of the standard cycle `name` (any case), a subprogram file with a PROC line; none if ncport does not bring it.
/// Called like a cycle of the control's own folder: without EXTERN, after all programs of the user.
std::optional<std::string_view> LibraryCycle(std::string_view name);

/// Names of all cycles, upper case, sorted.
std::span<const std::string_view> LibraryCycleNames();

/// A parameter whose effect the card does not give: a call may leave it out or give a literal 0, nothing else, because
/// the cycle ignores it. The reader refuses other calls at the argument, with `reason`.
struct LibraryLimit {
  std::string_view cycle;  // upper case
  std::string_view parameter;
  std::uint16_t position;   // from 0
  std::string_view reason;  // "chooses how depths and amounts are meant"
};
std::span<const LibraryLimit> LibraryLimits();

/// True for the cycles that leave their G words in force on older controls (card 8.12, "modal words behind the cycle"):
/// their SAVE follows the profile key `sinumerik.drill-cycles-keep-codes`.
bool LibrarySaveFollowsProfile(std::string_view name);

}  // namespace ncport::dialects::sinumerik
