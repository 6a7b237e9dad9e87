#include "app/lists_json.h"

#include <nlohmann/json.hpp>

namespace ncport::app {

std::string ListAsJson(std::string_view what, const std::vector<ListEntry>& entries) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ListEntry& entry : entries) {
    nlohmann::ordered_json object;
    for (const auto& [key, value] : entry) object[std::string(key)] = value;
    list.push_back(std::move(object));
  }
  nlohmann::ordered_json root;
  root["version"] = 1;
  root[std::string(what)] = std::move(list);
  return root.dump(2) + "\n";
}

}  // namespace ncport::app
