#include "tests/random/shop.h"

#include <fmt/format.h>

#include <string>

#include "dialects/registry.h"

namespace ncport::tests::random {

dialects::Config ShopDataFor(const dialects::Profile& target) {
  dialects::Config config;
  for (unsigned tool = 1; tool <= 14; ++tool) {
    const std::string name = tool == 13 ? "T=\"MILL_10\"" : tool == 14 ? "T=\"Drill 5\"" : fmt::format("T{}", tool);
    for (unsigned edge = 1; edge <= 3; ++edge) {
      const unsigned registers = tool + 20 * edge;
      config.tools.push_back({fmt::format("{} D{}", name, edge),
                              target.IsLathe() ? fmt::format("T{:02}{:02}", tool, registers)
                                               : fmt::format("T{} M6 H{} D{}", tool, registers, registers + 100),
                              {}});
    }
  }
  config.offsets.push_back({"G0", "G59", {}});  // none (G500)
  config.offsets.push_back({"G505", "G54.1 P1", {}});
  config.offsets.push_back({"G523", "G54.1 P19", {}});
  // The operator's cells stay in one row: a subprogram that nobody calls here reads them unwritten.
  for (unsigned cell = 0; cell < 100; ++cell)
    config.variables.push_back({fmt::format("R{}", cell), fmt::format("#{}", 500 + cell), {}});
  return config;
}

dialects::Profile AnsweredProfile(std::string_view name) {
  dialects::Profile profile = dialects::BuiltIn(name);
  if (!profile.fanuc.c_axis.Known()) profile.fanuc.c_axis = true;
  if (!profile.fanuc.dwell.Known()) profile.fanuc.dwell = dialects::FanucSettings::Dwell::kTime;
  if (!profile.fanuc.atan_range.Known()) profile.fanuc.atan_range = dialects::FanucSettings::AtanRange::kPositive;
  return profile;
}

}  // namespace ncport::tests::random
