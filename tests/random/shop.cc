#include "tests/random/shop.h"

#include <fmt/format.h>

#include <string>

#include "dialects/registry.h"

namespace ncport::tests::random {

namespace {

constexpr unsigned kTools = 14, kEdges = 3;
std::string_view NameOfTool(unsigned tool) { return tool == 13 ? "MILL_10" : tool == 14 ? "Drill 5" : ""; }
unsigned LengthOf(unsigned tool, unsigned edge) { return tool + 20 * edge; }
unsigned RadiusOf(unsigned tool, unsigned edge) { return LengthOf(tool, edge) + 100; }

}  // namespace

dialects::Config ShopDataFor(const dialects::Profile& target) {
  if (target.language == dialects::Language::kSinumerik) {
    dialects::Config config = ShopDataBack(target);
    config.offsets.push_back({"G58", "G507", {}, {}});
    return config;
  }
  dialects::Config config;
  for (unsigned tool = 1; tool <= kTools; ++tool) {
    const std::string name =
        NameOfTool(tool).empty() ? fmt::format("T{}", tool) : fmt::format("T=\"{}\"", NameOfTool(tool));
    for (unsigned edge = 1; edge <= kEdges; ++edge) {
      const unsigned registers = LengthOf(tool, edge);
      config.tools.push_back({fmt::format("{} D{}", name, edge),
                              target.IsLathe() ? fmt::format("T{:02}{:02}", tool, registers)
                                               : fmt::format("T{} M6 H{} D{}", tool, registers, RadiusOf(tool, edge)),
                              {}});
    }
  }
  config.offsets.push_back({"G0", "G59", {}});  // none (G500)
  config.offsets.push_back({"G500", "G59", {}});
  config.offsets.push_back({"G505", "G54.1 P1", {}});
  config.offsets.push_back({"G523", "G54.1 P19", {}});
  // The operator's cells stay in one row: a subprogram that nobody calls here reads them unwritten.
  for (unsigned cell = 0; cell < 100; ++cell)
    config.variables.push_back({fmt::format("R{}", cell), fmt::format("#{}", 500 + cell), {}});
  return config;
}

dialects::Config ShopDataBack(const dialects::Profile& from) {
  dialects::Config config;
  config.offsets = {{"G59", "G500", {}, {}}, {"G54.1 P1", "G505", {}, {}}, {"G54.1 P19", "G523", {}, {}}};
  for (unsigned tool = 1; tool <= kTools; ++tool) {
    for (unsigned edge = 1; edge <= kEdges; ++edge) {
      const unsigned registers = LengthOf(tool, edge);
      const std::string words = NameOfTool(tool).empty() ? fmt::format("T{} D{}", tool, edge)
                                                         : fmt::format("T=\"{}\" D{}", NameOfTool(tool), edge);
      if (from.IsLathe()) {
        config.tools.push_back({fmt::format("T{:02}{:02}", tool, registers), words, {}});
        continue;
      }
      config.tools.push_back({fmt::format("T{} H{} D{}", tool, registers, RadiusOf(tool, edge)), words, {}});
      config.tools.push_back({fmt::format("T{} H{}", tool, registers), words, {}});
    }
  }
  return config;
}

prove::Maps ShopMapsFor(const dialects::Profile& target) {
  prove::Maps maps;
  for (unsigned tool = 1; tool <= kTools; ++tool) {
    for (unsigned edge = 1; edge <= kEdges; ++edge) {
      prove::ToolPair pair;
      pair.source_name = NameOfTool(tool);
      pair.source_tool = pair.source_name.empty() ? tool : 0;
      pair.source_edge = edge;
      pair.target_tool = tool;
      pair.target_offset = LengthOf(tool, edge);
      if (!target.IsLathe()) pair.target_radius = RadiusOf(tool, edge);
      maps.tools.push_back(pair);
    }
  }
  maps.tools_mapped = true;
  maps.separate_registers = !target.IsLathe();
  maps.work_offsets = {{0, 59, 0, 0}, {505, 54, 0, 1}, {523, 54, 0, 19}};
  maps.messages_lost = maps.path_lost = true;
  return maps;
}

dialects::Profile AnsweredProfile(std::string_view name) {
  dialects::Profile profile = dialects::BuiltIn(name);
  if (!profile.fanuc.c_axis.Known()) profile.fanuc.c_axis = true;
  if (!profile.fanuc.dwell.Known()) profile.fanuc.dwell = dialects::FanucSettings::Dwell::kTime;
  if (!profile.fanuc.atan_range.Known()) profile.fanuc.atan_range = dialects::FanucSettings::AtanRange::kPositive;
  return profile;
}

}  // namespace ncport::tests::random
