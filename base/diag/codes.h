// The registry of diagnostics, made from codes.def.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace ncport::diag {

enum class Severity : std::uint8_t { kError, kWarning, kInfo };

/// "error", "warning", "info".
std::string_view NameOf(Severity severity);

/// One enumerator a row of codes.def: Code::kDivisionByZero ...
enum class Code : std::uint16_t {
#define NCPORT_DIAG(name, number, severity, text) k##name,
#include "base/diag/codes.def"
#undef NCPORT_DIAG
};

struct Info {
  Code code;
  std::string_view number;  // "NC3001"
  std::string_view name;    // "DivisionByZero"
  Severity severity;
  std::string_view text;  // fmt format string
};

const Info& InfoOf(Code code);
/// All rows, sorted by number.
std::span<const Info> AllInfos();
/// The code with this number ("NC3001", exact case), if there is one.
std::optional<Code> FindByNumber(std::string_view number);

}  // namespace ncport::diag
