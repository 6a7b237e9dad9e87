#include "backends/common/word_template.h"

#include <fmt/format.h>

#include "base/result.h"

namespace ncport::backends {
namespace {

void AppendHole(TextBuffer& out, std::string_view form, std::string_view hole, std::span<const Hole> holes) {
  std::size_t width = 0;
  const std::size_t colon = hole.find(':');
  if (colon != std::string_view::npos) {
    for (const char digit : hole.substr(colon + 1)) width = width * 10 + static_cast<std::size_t>(digit - '0');
    hole = hole.substr(0, colon);
  }
  for (const Hole& value : holes) {
    if (value.name != hole) continue;
    if (!value.text.empty()) {
      out.Append(value.text);
    } else {
      const std::string text = fmt::format("{:0{}}", value.number, width);
      out.Append(text);
    }
    return;
  }
  NCPORT_BUG("word template '{}' has a hole '{}' that nothing fills", form, hole);
}

}  // namespace

void AppendTemplate(TextBuffer& out, std::string_view form, std::span<const Hole> holes) {
  std::size_t at = 0;
  while (at < form.size()) {
    const std::size_t open = form.find('{', at);
    if (open == std::string_view::npos) break;
    const std::size_t close = form.find('}', open);
    if (close == std::string_view::npos) break;
    out.Append(form.substr(at, open - at));
    AppendHole(out, form, form.substr(open + 1, close - open - 1), holes);
    at = close + 1;
  }
  out.Append(form.substr(at));
}

}  // namespace ncport::backends
