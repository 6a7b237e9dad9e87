// Parameters of standard cycles: rows that agree with each other and with the cycles that ncport brings along.
#include "dialects/sinumerik/cycle_parameters.h"

#include <doctest/doctest.h>

#include <string>

#include "dialects/sinumerik/library.h"
#include "dialects/sinumerik/words.h"

namespace ncport::dialects::sinumerik {

TEST_CASE("values and texts belong to parameters of their cycle") {
  CHECK(!CycleValueRows().empty());
  for (const CycleValues& row : CycleValueRows()) {
    INFO(std::string(row.cycle), " ", std::string(row.parameter));
    const CycleParameters* cycle = FindCycleParameters(row.cycle);
    REQUIRE(cycle != nullptr);
    bool found = false;
    for (std::uint32_t i = 0; i < CountOf(*cycle); ++i) found = found || ParameterAt(*cycle, i) == row.parameter;
    CHECK(found);
    CHECK(row.range_count > 0);
    for (std::uint8_t i = 0; i < row.range_count; ++i) CHECK(row.ranges[i].low <= row.ranges[i].high);
  }
}

TEST_CASE("parameters of a cycle by position") {
  const CycleParameters* cycle = FindCycleParameters("cycle95");
  REQUIRE(cycle != nullptr);
  CHECK(CountOf(*cycle) == 12);
  CHECK(ParameterAt(*cycle, 0) == "NPP");
  CHECK(ParameterAt(*cycle, 8) == "VARI");
  CHECK(ParameterAt(*cycle, 11) == "_VRT");
  CHECK(ParameterAt(*cycle, 12).empty());
  CHECK(IsTextParameter(*cycle, "NPP"));
  CHECK(!IsTextParameter(*cycle, "MID"));
  CHECK(FindCycleParameters("CYCLE1") == nullptr);
  CHECK(IsReserved("CYCLE95"));
}

TEST_CASE("the cycles that ncport brings along have the parameters of the list") {
  for (const std::string_view name : LibraryCycleNames()) {
    const CycleParameters* cycle = FindCycleParameters(name);
    if (cycle == nullptr) continue;
    const std::string_view text = *LibraryCycle(name);
    const std::string_view header = text.substr(text.find("PROC "), text.find('\n', text.find("PROC ")));
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < CountOf(*cycle); ++i) {
      INFO(std::string(name), " ", std::string(ParameterAt(*cycle, i)));
      at = header.find(" " + std::string(ParameterAt(*cycle, i)), at);
      CHECK(at != std::string_view::npos);
    }
  }
}

}  // namespace ncport::dialects::sinumerik
