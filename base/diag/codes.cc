#include "base/diag/codes.h"

#include <algorithm>
#include <cstddef>

#include "base/result.h"

namespace ncport::diag {

namespace {

constexpr Info kInfos[] = {
#define NCPORT_DIAG(name, number, severity, text) {Code::k##name, number, #name, Severity::severity, text},
#include "base/diag/codes.def"
#undef NCPORT_DIAG
};

consteval bool WellFormed() {
  std::string_view last;
  for (const Info& info : kInfos) {
    if (info.number.size() != 6 || !info.number.starts_with("NC")) return false;
    if (info.number <= last) return false;
    last = info.number;
  }
  return true;
}
static_assert(WellFormed(), "codes.def: numbers are NC and four digits, each once, sorted");

}  // namespace

std::string_view NameOf(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kInfo:
      return "info";
  }
  NCPORT_BUG("severity {}", static_cast<int>(severity));
}

const Info& InfoOf(Code code) { return kInfos[static_cast<std::size_t>(code)]; }

std::span<const Info> AllInfos() { return kInfos; }

std::optional<Code> FindByNumber(std::string_view number) {
  const auto* const found = std::ranges::lower_bound(kInfos, number, {}, &Info::number);
  if (found == std::end(kInfos) || found->number != number) return std::nullopt;
  return found->code;
}

}  // namespace ncport::diag
