// The report as JSON.
#include <nlohmann/json.hpp>

#include <cmath>

#include "app/report.h"

namespace ncport::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

/// As traces round: six decimals, no negative zero.
double Rounded(double value) {
  const double rounded = std::round(value * 1e6) / 1e6;
  return rounded == 0 ? 0 : rounded;
}

Json NumberJson(const std::optional<double>& value) { return value ? Json(Rounded(*value)) : Json(nullptr); }
Json TextJson(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json PlaceJson(const ReportPlace& place) {
  if (place.file.empty() && place.line == 0) return nullptr;
  Json json{{"file", TextJson(place.file)}, {"line", nullptr}, {"column", nullptr}};
  if (place.line != 0) json["line"] = place.line;
  if (place.column != 0) json["column"] = place.column;
  return json;
}

template <class Items, class Make>
Json ListJson(const Items& items, Make make) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(make(item));
  return list;
}

Json PairJson(const ReportPair& pair) {
  return {{"source", pair.source}, {"target", pair.target}, {"note", TextJson(pair.note)}};
}

Json PointJson(const std::optional<ReportPoint>& point) {
  if (!point) return nullptr;
  Json axes = Json::object();
  for (const auto& [name, value] : point->axes) axes[name] = Rounded(value);
  return {{"axes", std::move(axes)}, {"source", PlaceJson(point->source)}};
}

Json EnvelopeJson(const ReportEnvelope& envelope) {
  return {{"tool", TextJson(envelope.tool)},
          {"axes", ListJson(envelope.axes,
                            [](const ReportAxis& axis) -> Json {
                              return {{"axis", axis.name},
                                      {"low", Rounded(axis.low)},
                                      {"high", Rounded(axis.high)},
                                      {"lowLimit", NumberJson(axis.low_limit)},
                                      {"highLimit", NumberJson(axis.high_limit)}};
                            })},
          {"firstApproach", PointJson(envelope.first_approach)},
          {"lastApproach", PointJson(envelope.last_approach)},
          {"speed", NumberJson(envelope.speed)},
          {"surfaceSpeed", NumberJson(envelope.surface_speed)},
          {"feed", NumberJson(envelope.feed)},
          {"feedPerRevolution", NumberJson(envelope.feed_per_revolution)},
          {"speedLimit", NumberJson(envelope.speed_limit)},
          {"feedLimit", NumberJson(envelope.feed_limit)}};
}

}  // namespace

std::string RenderReportJson(const Report& report) {
  const auto text = [](const std::string& line) { return Json(line); };
  Json root{{"version", kVersion}, {"command", report.command}};
  root["ncport"] = report.version;
  root["from"] = report.from;
  root["to"] = report.to;
  root["sources"] = ListJson(report.sources, text);
  root["sourceHash"] = TextJson(report.source_hash);
  root["required"] = ListJson(report.required, text);
  root["parameters"] = ListJson(report.parameters, [](const ReportParameter& parameter) -> Json {
    return {{"program", parameter.program},     {"letter", parameter.letter},     {"source", parameter.source},
            {"unit", TextJson(parameter.unit)}, {"low", TextJson(parameter.low)}, {"high", TextJson(parameter.high)}};
  });
  root["programs"] = ListJson(report.programs, PairJson);
  root["variables"] = ListJson(report.variables, PairJson);
  root["tools"] = ListJson(report.tools, PairJson);
  root["offsets"] = ListJson(report.offsets, PairJson);
  root["functions"] = ListJson(report.functions, PairJson);
  root["alarms"] = ListJson(report.alarms, PairJson);
  root["comparison"] = ListJson(report.comparison, text);
  root["envelopes"] = ListJson(report.envelopes, EnvelopeJson);
  root["rapidPaths"] = TextJson(report.rapid_paths);
  root["rapids"] = ListJson(report.rapids, [](const ReportRapid& rapid) -> Json {
    return {{"axes", rapid.axes}, {"source", PlaceJson(rapid.source)}, {"output", PlaceJson(rapid.output)}};
  });
  root["losses"] = ListJson(report.losses, [](const ReportLoss& loss) -> Json {
    return {{"what", loss.what}, {"source", PlaceJson(loss.source)}, {"output", PlaceJson(loss.output)}};
  });
  root["added"] = ListJson(report.added, text);
  root["assumptions"] = ListJson(report.assumptions, [&](const ReportAssumption& assumption) -> Json {
    return {{"text", assumption.text}, {"rule", TextJson(assumption.rule)}, {"test", ListJson(assumption.test, text)}};
  });
  root["findings"] = ListJson(report.findings, [](const ReportFinding& finding) -> Json {
    return {{"severity", finding.severity},
            {"code", finding.code},
            {"message", finding.message},
            {"source", PlaceJson(finding.source)}};
  });
  // Texts of programs may hold bytes that are not UTF-8: they are replaced, not a reason to stop.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ncport::app
