#include "dialects/word_template.h"

#include <doctest/doctest.h>

namespace ncport::dialects {
namespace {

std::string Fill(std::string_view pattern, std::initializer_list<TemplateValue> values) {
  TextBuffer buffer;
  AppendTemplate(buffer, pattern, std::span(values.begin(), values.size()));
  return std::string(buffer.View());
}

TEST_CASE("holes are filled, with zeros in front where the hole says so") {
  CHECK(Fill("T{tool:02}{offset:02}", {{"tool", "3"}, {"offset", "12"}}) == "T0312");
  CHECK(Fill("T{tool:02}", {{"tool", "123"}}) == "T123");
  CHECK(Fill("T{tool} M6", {{"tool", "5"}}) == "T5 M6");
  CHECK(Fill("G40", {}) == "G40");
  CHECK(Fill("", {}).empty());
}

TEST_CASE("templates are checked against the holes of their key") {
  CHECK(CheckTemplate("T{tool:02}", "tool offset").empty());
  CHECK(CheckTemplate("G4 X{seconds}", "seconds").empty());
  CHECK(CheckTemplate("T{tol}", "tool offset") == "{tol} is not one of its holes: tool offset");
  CHECK(CheckTemplate("M{x}", "") == "{x}: this key has no holes");
  CHECK(CheckTemplate("T{tool", "tool") == "a hole is written {name} or {name:02}");
  CHECK(CheckTemplate("T{tool:2}", "tool") == "a hole is written {name} or {name:02}");
  CHECK(CheckTemplate("T}", "tool") == "'}' without '{'");
}

TEST_CASE("the width of a hole") {
  CHECK(WidthOf("T{tool:02}{offset:03}", "offset") == 3);
  CHECK(WidthOf("T{tool:02}{offset}", "offset") == 1);
  CHECK(WidthOf("T{tool:02}", "offset") == 0);
}

}  // namespace
}  // namespace ncport::dialects
