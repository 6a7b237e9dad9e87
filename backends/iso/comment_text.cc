#include "backends/iso/comment_text.h"

namespace ncport::backends::iso {
namespace {

char Fit(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (c == '(') return '[';
  if (c == ')') return ']';
  if (c == '\t') return ' ';
  if (c >= 'a' && c <= 'z') return static_cast<char>(c - 'a' + 'A');
  return byte < 0x20 || byte == 0x7F || byte >= 0x80 ? '?' : c;
}

}  // namespace

void AppendFlatComment(TextBuffer& out, std::string_view prefix, std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  if (prefix.empty() && text.empty()) return;
  out.Append('(');
  out.Append(prefix);
  if (!prefix.empty() && !text.empty()) out.Append(' ');
  for (const char c : text) {
    // One mark for each character, not for each of its bytes.
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) continue;
    out.Append(Fit(c));
  }
  out.Append(')');
}

}  // namespace ncport::backends::iso
