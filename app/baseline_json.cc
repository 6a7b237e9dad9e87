// The file of a baseline.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/baseline.h"

namespace ncport::app {
namespace {

constexpr int kVersion = 1;

}  // namespace

Result<Baseline> Baseline::Parse(std::string_view json, std::string_view name, diag::Sink& findings) {
  const auto refuse = [&](std::string_view why) -> Result<Baseline> {
    findings.Report(diag::Code::kBadOption, SourceRange{}, std::string("baseline"), fmt::format("{} {}", name, why))
        .help = "`ncport check --write-baseline FILE` writes one";
    return Failure{};
  };
  const nlohmann::json root = nlohmann::json::parse(json, nullptr, false);
  if (!root.is_object() || !root.contains("findings") || !root["findings"].is_array()) return refuse("is no baseline");
  if (root.value("version", nlohmann::json()) != kVersion) return refuse("was written by another version of ncport");
  Baseline baseline;
  for (const nlohmann::json& entry : root["findings"]) {
    const auto text = [&](const char* key) { return entry.is_object() ? entry.value(key, nlohmann::json()) : nullptr; };
    const nlohmann::json file = text("file");
    const nlohmann::json code = text("code");
    const nlohmann::json block = text("block");
    const nlohmann::json count = text("count");
    if (!file.is_string() || !code.is_string() || !block.is_string() || !count.is_number_unsigned())
      return refuse("has an entry without file, code, block and count");
    baseline.counts_[{file.get<std::string>(), code.get<std::string>(), block.get<std::string>()}] +=
        count.get<std::uint32_t>();
  }
  return baseline;
}

std::string Baseline::Render() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [key, count] : counts_) {
    const auto& [file, code, block] = key;
    list.push_back({{"file", file}, {"code", code}, {"block", block}, {"count", count}});
  }
  const nlohmann::ordered_json root = {{"version", kVersion}, {"findings", std::move(list)}};
  return root.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace ncport::app
