#include "app/diagnostic_pages.h"
#include "app/ncport.h"

namespace ncport {

std::string_view Explain(std::string_view code) {
  // The pages stand one after the other, each under a heading "## NC3001 ...".
  std::string_view rest = app::DiagnosticPages();
  while (true) {
    const std::size_t begin = rest.find("## NC");
    if (begin == std::string_view::npos) return {};
    rest.remove_prefix(begin);
    const std::size_t next = rest.find("\n## NC", 1);
    if (rest.substr(3).starts_with(code) && code.size() == 6)
      return rest.substr(0, next == std::string_view::npos ? next : next + 1);
    if (next == std::string_view::npos) return {};
    rest.remove_prefix(next + 1);
  }
}

std::string_view Version() { return NCPORT_VERSION; }

}  // namespace ncport
