// The report as data, as JSON and as a page.
#include "app/report.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace ncport::app {
namespace {

Report Sample() {
  Report report;
  report.command = "flatten";
  report.version = "0.1.0";
  report.from = "sinumerik-840d-mill";
  report.to = "iso-mill";
  report.sources = {"<b>&\"'.mpf"};
  report.source_hash = "00FF";
  report.required = {"G-code system A"};
  report.tools = {{"T=\"<MILL>\" D1", "T1 H1 D1", ""}};
  ReportEnvelope envelope;
  envelope.tool = "T1";
  envelope.axes = {{"X", -0.0000001, 20.25, std::nullopt, 10.0}};
  envelope.first_approach = ReportPoint{{{"X", 1}, {"Z", 2.5}}, {"a.mpf", 3, 1}};
  envelope.speed = 1000;
  report.envelopes = {envelope};
  report.losses = {{"the message", {"a.mpf", 7, 2}, {"out.nc", 9, 0}}};
  report.assumptions = {{"D1 is active behind M6", "sinumerik-8.8", {"T1 M6", "G0 Z<50"}}};
  return report;
}

TEST_CASE("the JSON form has a version, lists that are always there, and null for what does not exist") {
  const auto json = nlohmann::json::parse(RenderReportJson(Sample()));
  CHECK(json["version"] == 1);
  CHECK(json["sources"][0] == "<b>&\"'.mpf");
  CHECK(json["tools"][0]["target"] == "T1 H1 D1");
  CHECK(json["tools"][0]["note"].is_null());
  CHECK(json["offsets"].is_array());
  CHECK(json["offsets"].empty());
  const auto& envelope = json["envelopes"][0];
  CHECK(envelope["axes"][0]["low"] == 0);
  CHECK_FALSE(std::signbit(envelope["axes"][0]["low"].get<double>()));
  CHECK(envelope["axes"][0]["high"] == 20.25);
  CHECK(envelope["axes"][0]["lowLimit"].is_null());
  CHECK(envelope["firstApproach"]["axes"]["Z"] == 2.5);
  CHECK(envelope["firstApproach"]["source"]["line"] == 3);
  CHECK(envelope["lastApproach"].is_null());
  CHECK(envelope["feed"].is_null());
  CHECK(json["losses"][0]["source"]["line"] == 7);
  CHECK(json["losses"][0]["output"]["line"] == 9);
  CHECK(json["losses"][0]["output"]["column"].is_null());
}

TEST_CASE("bytes that are not UTF-8 do not stop a report") {
  Report report = Sample();
  report.required = {"\xFF\x01"};
  CHECK(nlohmann::json::parse(RenderReportJson(report))["required"][0] == "\xEF\xBF\xBD\x01");
  CHECK(RenderReportHtml(report).find('\xFF') == std::string::npos);
  CHECK(RenderReportHtml(report).find('\x01') == std::string::npos);
}

TEST_CASE("no text of a program is markup in the page") {
  const std::string page = RenderReportHtml(Sample());
  CHECK(page.find("<b>") == std::string::npos);
  CHECK(page.find("<MILL>") == std::string::npos);
  CHECK(page.find("&lt;b&gt;&amp;&quot;&#39;.mpf") != std::string::npos);
  CHECK(page.find("<code>G0 Z&lt;50</code>") != std::string::npos);
  CHECK(page.find("<input type=\"checkbox\">") != std::string::npos);
  CHECK(page.find("<td>a.mpf:7</td><td>out.nc:9</td>") != std::string::npos);
  CHECK(page.find("X1 Z2.5 (a.mpf:3)") != std::string::npos);
}

TEST_CASE("an axis beyond its limit is marked; sections without content are left out") {
  const std::string page = RenderReportHtml(Sample());
  CHECK(page.find("OUTSIDE") != std::string::npos);
  CHECK(page.find("Work offsets") == std::string::npos);
  Report inside = Sample();
  inside.envelopes[0].axes[0].high_limit = 30;
  CHECK(RenderReportHtml(inside).find("OUTSIDE") == std::string::npos);
}

TEST_CASE("the ending of the file names the form") {
  CHECK(ReportFormOf("a/b.json") == ReportForm::kJson);
  CHECK(ReportFormOf("B.HTML") == ReportForm::kHtml);
  CHECK(ReportFormOf("b.htm") == ReportForm::kHtml);
  CHECK_FALSE(ReportFormOf("b.txt"));
  CHECK_FALSE(ReportFormOf("json"));
}

}  // namespace
}  // namespace ncport::app
