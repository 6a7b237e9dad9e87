#include "base/diag/sarif_renderer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/diag/place.h"

namespace ncport::diag {

namespace {

using Json = nlohmann::ordered_json;

std::string_view LevelOf(Severity severity) { return severity == Severity::kInfo ? "note" : NameOf(severity); }

Json Text(std::string_view text) { return Json{{"text", text}}; }

Json Region(const Place& place) {
  return Json{{"startLine", place.line},
              {"startColumn", place.column},
              {"endLine", place.line},
              {"endColumn", place.end_column}};
}

Json Location(const Place& place) {
  Json physical{{"artifactLocation", {{"uri", UriOf(place.file)}}}};
  if (place.line != 0) physical["region"] = Region(place);
  return Json{{"physicalLocation", std::move(physical)}};
}

/// The codes that were found, in order; results name their place here.
std::vector<Code> CodesOf(const Sink& sink) {
  std::vector<Code> codes;
  for (const Diagnostic& diagnostic : sink.All()) codes.push_back(diagnostic.code);
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

/// "Division by zero" of DivisionByZero.
std::string TitleOf(std::string_view name) {
  std::string title;
  for (const char c : name) {
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital && !title.empty()) title.push_back(' ');
    title.push_back(capital && !title.empty() ? static_cast<char>(c - 'A' + 'a') : c);
  }
  return title;
}

Json Rules(const std::vector<Code>& codes) {
  Json rules = Json::array();
  for (const Code code : codes) {
    const Info& info = InfoOf(code);
    rules.push_back({{"id", info.number},
                     {"name", info.name},
                     {"shortDescription", Text(TitleOf(info.name))},
                     {"defaultConfiguration", {{"level", LevelOf(info.severity)}}}});
  }
  return rules;
}

// SARIF has no place for a remedy or for notes without a location: they follow the message.
std::string MessageOf(const Diagnostic& diagnostic, const SourceFiles& files) {
  std::string text = diagnostic.message;
  for (const Note& note : diagnostic.notes) {
    if (PlaceOf(note.at, files).file.empty()) text += "\nnote: " + note.text;
  }
  if (!diagnostic.help.empty()) text += "\nhelp: " + diagnostic.help;
  if (!diagnostic.control.empty()) text += "\ncontrol: " + diagnostic.control;
  return text;
}

Json Result(const Diagnostic& diagnostic, const SourceFiles& files, const std::vector<Code>& codes) {
  Json result{{"ruleId", InfoOf(diagnostic.code).number},
              {"ruleIndex", std::lower_bound(codes.begin(), codes.end(), diagnostic.code) - codes.begin()},
              {"level", LevelOf(diagnostic.severity)},
              {"message", Text(MessageOf(diagnostic, files))}};
  const Place place = PlaceOf(diagnostic.at, files);
  if (!place.file.empty()) result["locations"] = Json::array({Location(place)});
  Json related = Json::array();
  for (const Note& note : diagnostic.notes) {
    const Place note_place = PlaceOf(note.at, files);
    if (note_place.file.empty()) continue;
    related.push_back(Location(note_place));
    related.back()["message"] = Text(note.text);
  }
  if (!related.empty()) result["relatedLocations"] = std::move(related);
  Json fixes = Json::array();
  for (const Fix& fix : diagnostic.fixes) {
    const Place fix_place = PlaceOf(fix.at, files);
    if (fix_place.file.empty() || fix_place.line == 0) continue;
    Json replacement{{"deletedRegion", Region(fix_place)}, {"insertedContent", Text(fix.replacement)}};
    Json change{{"artifactLocation", {{"uri", UriOf(fix_place.file)}}},
                {"replacements", Json::array({std::move(replacement)})}};
    fixes.push_back({{"artifactChanges", Json::array({std::move(change)})}});
  }
  if (!fixes.empty()) result["fixes"] = std::move(fixes);
  return result;
}

}  // namespace

std::string UriOf(std::string_view file) {
  std::string uri = file.starts_with('/') ? "file://" : "";
  // A colon in the first part of a relative reference would make it a scheme, so it is written as a code too.
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  for (const char c : file) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      fmt::format_to(std::back_inserter(uri), "%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

std::string RenderSarif(const Sink& sink, const SourceFiles& files, std::string_view tool_version) {
  Json results = Json::array();
  const std::vector<Code> codes = CodesOf(sink);
  for (const Diagnostic& diagnostic : sink.All()) results.push_back(Result(diagnostic, files, codes));
  Json driver{{"name", "ncport"}, {"version", tool_version}, {"rules", Rules(codes)}};
  Json run{
      {"tool", {{"driver", std::move(driver)}}}, {"columnKind", "unicodeCodePoints"}, {"results", std::move(results)}};
  const Json root{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                  {"version", "2.1.0"},
                  {"runs", Json::array({std::move(run)})}};
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ncport::diag
