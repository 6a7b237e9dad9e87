#include "app/diagnostic_pages.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "app/ncport.h"
#include "base/diag/codes.h"

namespace ncport {
namespace {

TEST_CASE("every diagnostic has its page, with a reason, examples and a remedy") {
  for (const diag::Info& info : diag::AllInfos()) {
    CAPTURE(info.number);
    const std::string page(Explain(info.number));
    CHECK(page.starts_with("## " + std::string(info.number) + " " + std::string(info.name) + "\n"));
    CHECK(page.find("\nRemedy: ") != std::string::npos);
    CHECK(page.find("## NC", 1) == std::string::npos);
  }
}

TEST_CASE("there is no page for a code that does not exist") {
  std::set<std::string> known;
  for (const diag::Info& info : diag::AllInfos()) known.insert(std::string(info.number));
  const std::string pages(app::DiagnosticPages());
  for (std::size_t at = pages.find("\n## NC"); at != std::string::npos; at = pages.find("\n## NC", at + 1)) {
    CAPTURE(pages.substr(at + 4, 6));
    CHECK(known.contains(pages.substr(at + 4, 6)));
  }
  CHECK(Explain("NC0000").empty());
  CHECK(Explain("NC").empty());
  CHECK(Explain("").empty());
}

}  // namespace
}  // namespace ncport
