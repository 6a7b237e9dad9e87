// One fuzz target: any bytes in, no crash, no bug message, no endless run. Built twice: with libFuzzer by
// tests/fuzz/run, and as a plain test over seeds (driver.cc).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Returns 0. Whatever must hold and does not is an NCPORT_BUG, which ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ncport::tests {
/// Longest input that targets look at: longer ones only repeat.
inline constexpr std::size_t kFuzzBytes = 4096;

inline std::string_view AsText(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}
}  // namespace ncport::tests
