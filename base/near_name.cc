#include "base/near_name.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/letter_case.h"

namespace ncport {
namespace {

constexpr std::size_t kMaxLength = 64;

/// Edit distance with swaps of neighbours; three rows are enough.
std::size_t Distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, kMaxLength + 1>;
  Row before{};
  Row last{};
  Row now{};
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t cost = Lower(a[i - 1]) == Lower(b[j - 1]) ? 0 : 1;
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + cost});
      const bool swapped = i > 1 && j > 1 && Lower(a[i - 1]) == Lower(b[j - 2]) && Lower(a[i - 2]) == Lower(b[j - 1]);
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

/// Letters in front that are the same.
std::size_t SameStart(std::string_view a, std::string_view b) {
  std::size_t same = 0;
  while (same < std::min(a.size(), b.size()) && Lower(a[same]) == Lower(b[same])) ++same;
  return same;
}

/// True if the first letters that differ lie side by side on the keyboard, so that a finger may have missed.
bool Beside(std::string_view a, std::string_view b) {
  constexpr std::string_view kRows[] = {"1234567890", "qwertyuiop", "asdfghjkl", "zxcvbnm"};
  const std::size_t at = SameStart(a, b);
  if (at >= std::min(a.size(), b.size())) return false;
  for (const std::string_view row : kRows) {
    const std::size_t first = row.find(Lower(a[at]));
    const std::size_t second = row.find(Lower(b[at]));
    if (first == std::string_view::npos || second == std::string_view::npos) continue;
    return first + 1 == second || second + 1 == first;
  }
  return false;
}

/// Of two names that are as near, the one that starts longer alike; then the one whose key lies beside.
bool Likelier(std::string_view name, std::string_view candidate, std::string_view known) {
  const std::size_t same = SameStart(name, candidate);
  const std::size_t same_known = SameStart(name, known);
  if (same != same_known) return same > same_known;
  return Beside(name, candidate) && !Beside(name, known);
}

}  // namespace

std::string_view NearName(std::string_view name, std::span<const std::string_view> candidates) {
  if (name.empty() || name.size() > kMaxLength) return {};
  const std::size_t most = std::max<std::size_t>(1, name.size() / 3);
  std::size_t best = most + 1;
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kMaxLength) continue;
    const std::size_t distance = Distance(name, candidate);
    if (distance < best || (distance == best && !found.empty() && Likelier(name, candidate, found))) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

}  // namespace ncport
