#include "base/diag/json_renderer.h"

#include <nlohmann/json.hpp>

#include "base/diag/place.h"

namespace ncport::diag {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

Json PlaceJson(const SourceRange& at, const SourceFiles& files) {
  const Place place = PlaceOf(at, files);
  Json json{{"file", nullptr}, {"line", nullptr}, {"column", nullptr}, {"endLine", nullptr}, {"endColumn", nullptr}};
  if (!place.file.empty()) json["file"] = place.file;
  if (place.line != 0) {
    json["line"] = place.line;
    json["column"] = place.column;
    json["endLine"] = place.line;
    json["endColumn"] = place.end_column;
  }
  return json;
}

Json TextOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json FindingJson(const Diagnostic& diagnostic, const SourceFiles& files) {
  Json json = PlaceJson(diagnostic.at, files);
  json["severity"] = NameOf(diagnostic.severity);
  json["code"] = InfoOf(diagnostic.code).number;
  json["message"] = diagnostic.message;
  Json notes = Json::array();
  for (const Note& note : diagnostic.notes) {
    notes.push_back(PlaceJson(note.at, files));
    notes.back()["message"] = note.text;
  }
  json["notes"] = std::move(notes);
  json["help"] = TextOrNull(diagnostic.help);
  Json fixes = Json::array();
  for (const Fix& fix : diagnostic.fixes) {
    fixes.push_back(PlaceJson(fix.at, files));
    fixes.back()["replacement"] = fix.replacement;
  }
  json["fixes"] = std::move(fixes);
  json["alarm"] = TextOrNull(diagnostic.control);
  return json;
}

}  // namespace

std::string RenderJson(const Sink& sink, const SourceFiles& files) {
  Json findings = Json::array();
  for (const Diagnostic& diagnostic : sink.All()) findings.push_back(FindingJson(diagnostic, files));
  const Json root{{"version", kVersion}, {"findings", std::move(findings)}};
  // File names may hold bytes that are not UTF-8: they are replaced, not a reason to stop.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ncport::diag
