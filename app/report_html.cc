// The report as one page: plain HTML, printable, nothing loaded from elsewhere.
#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "app/report.h"
#include "base/diag/place.h"

namespace ncport::app {
namespace {

constexpr std::string_view kStyle =
    "body{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:.5em 0}th,td{border:1px solid #888;padding:.2em .6em;text-align:left;"
    "vertical-align:top}code{font-family:monospace}td.n{text-align:right}.over{font-weight:bold;color:#a00}"
    "@media print{body{margin:0}}";

/// Text of programs inside an element: nothing of it is markup, and what is not UTF-8 is replaced.
std::string Escaped(std::string_view text) {
  std::string out;
  for (const char c : diag::OneLine(text)) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string Number(double value) {
  std::string text = fmt::format("{:.6f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}
std::string Number(const std::optional<double>& value) { return value ? Number(*value) : std::string(); }

std::string PlaceText(const ReportPlace& place) {
  if (place.file.empty() && place.line == 0) return {};
  std::string text = place.file.empty() ? "line" : place.file;
  if (place.line != 0) text += fmt::format("{}{}", place.file.empty() ? ' ' : ':', place.line);
  return text;
}

class Page {
 public:
  void Head(const Report& report) {
    const std::string title = Escaped(fmt::format("ncport {}: {} to {}", report.command, report.from, report.to));
    out_ = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\""
        "Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n<title>{0}</title>\n"
        "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
        title, kStyle);
  }
  void Section(std::string_view title) { out_ += fmt::format("<h2>{}</h2>\n", Escaped(title)); }
  void Text(std::string_view text) { out_ += fmt::format("<p>{}</p>\n", Escaped(text)); }
  void Lines(std::string_view title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    Section(title);
    out_ += "<ul>\n";
    for (const std::string& line : lines) out_ += fmt::format("<li>{}</li>\n", Escaped(line));
    out_ += "</ul>\n";
  }
  void Begin(std::initializer_list<std::string_view> columns) {
    out_ += "<table>\n<tr>";
    for (const std::string_view column : columns) out_ += fmt::format("<th>{}</th>", Escaped(column));
    out_ += "</tr>\n";
  }
  void Row(std::initializer_list<std::string> cells) {
    out_ += "<tr>";
    for (const std::string& cell : cells) out_ += fmt::format("<td>{}</td>", Escaped(cell));
    out_ += "</tr>\n";
  }
  void End() { out_ += "</table>\n"; }
  void Pairs(std::string_view title, const std::vector<ReportPair>& pairs) {
    if (pairs.empty()) return;
    Section(title);
    Begin({"source", "here", "note"});
    for (const ReportPair& pair : pairs) Row({pair.source, pair.target, pair.note});
    End();
  }
  void Raw(std::string_view markup) { out_ += markup; }
  std::string Take() {
    out_ += "</body>\n</html>\n";
    return std::move(out_);
  }

 private:
  std::string out_;
};

std::string PointText(const std::optional<ReportPoint>& point) {
  if (!point) return {};
  std::string text;
  for (const auto& [name, value] : point->axes) text += (text.empty() ? "" : " ") + name + Number(value);
  const std::string place = PlaceText(point->source);
  return place.empty() ? text : fmt::format("{} ({})", text, place);
}

/// A largest value, with its limit where one is known.
std::string Against(const std::optional<double>& value, const std::optional<double>& limit) {
  if (!value || !limit) return Number(value);
  return fmt::format("{} (limit {}{})", Number(value), Number(limit), *value > *limit ? ": OUTSIDE" : "");
}

std::string LimitText(const ReportAxis& axis) {
  if (!axis.low_limit && !axis.high_limit) return {};
  const bool over = (axis.low_limit && axis.low < *axis.low_limit) || (axis.high_limit && axis.high > *axis.high_limit);
  return fmt::format("{} to {}{}", Number(axis.low_limit), Number(axis.high_limit), over ? ": OUTSIDE" : "");
}

void WriteEnvelopes(Page& page, const Report& report) {
  if (report.envelopes.empty()) return;
  page.Section("Envelope of each tool (mm, degrees; the transverse axis as radius)");
  for (const ReportEnvelope& envelope : report.envelopes) {
    page.Raw(fmt::format("<h3>{}</h3>\n",
                         envelope.tool.empty() ? std::string("before the first tool call") : Escaped(envelope.tool)));
    if (!envelope.axes.empty()) {
      page.Begin({"axis", "smallest", "largest", "limits"});
      for (const ReportAxis& axis : envelope.axes)
        page.Row({axis.name, Number(axis.low), Number(axis.high), LimitText(axis)});
      page.End();
    }
    if (!envelope.first_approach && !envelope.speed && !envelope.surface_speed && !envelope.feed &&
        !envelope.feed_per_revolution) {
      continue;
    }
    page.Begin({"what", "value"});
    if (envelope.first_approach) page.Row({"first approach", PointText(envelope.first_approach)});
    if (envelope.last_approach) page.Row({"last approach", PointText(envelope.last_approach)});
    if (envelope.speed) page.Row({"largest S, 1/min", Against(envelope.speed, envelope.speed_limit)});
    if (envelope.surface_speed) page.Row({"largest S, m/min", Number(envelope.surface_speed)});
    if (envelope.feed) page.Row({"largest F, mm/min", Against(envelope.feed, envelope.feed_limit)});
    if (envelope.feed_per_revolution) page.Row({"largest F, mm per revolution", Number(envelope.feed_per_revolution)});
    page.End();
  }
}

void WriteAssumptions(Page& page, const Report& report) {
  if (report.assumptions.empty()) return;
  page.Section("Assumptions: confirm each at the machine");
  page.Raw("<table>\n<tr><th>ok</th><th>assumed</th><th>rule</th><th>try this</th></tr>\n");
  for (const ReportAssumption& assumption : report.assumptions) {
    std::string test;
    for (const std::string& block : assumption.test)
      test += fmt::format("{}<code>{}</code>", test.empty() ? "" : "<br>", Escaped(block));
    page.Raw(fmt::format("<tr><td><input type=\"checkbox\"></td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                         Escaped(assumption.text), Escaped(assumption.rule), test));
  }
  page.End();
}

}  // namespace

std::string RenderReportHtml(const Report& report) {
  Page page;
  page.Head(report);
  page.Begin({"what", "value"});
  page.Row({"ncport", report.version});
  page.Row({"source profile", report.from});
  page.Row({"target profile", report.to});
  for (const std::string& source : report.sources) page.Row({"source", source});
  if (!report.source_hash.empty()) page.Row({"hash of the sources", report.source_hash});
  page.End();
  page.Lines("Required of the machine", report.required);
  if (!report.parameters.empty()) {
    page.Section("Parameters");
    page.Begin({"program", "letter", "in the source", "unit", "from", "to"});
    for (const ReportParameter& parameter : report.parameters)
      page.Row({parameter.program, parameter.letter, parameter.source, parameter.unit, parameter.low, parameter.high});
    page.End();
  }
  page.Pairs("Programs", report.programs);
  page.Pairs("Variables", report.variables);
  page.Pairs("Tools", report.tools);
  page.Pairs("Work offsets", report.offsets);
  page.Pairs("M and H functions", report.functions);
  page.Pairs("Alarms", report.alarms);
  page.Lines("Comparison", report.comparison);
  WriteEnvelopes(page, report);
  if (!report.rapids.empty()) {
    page.Section("Rapids whose path may differ");
    page.Text("path of a rapid of several axes, source -> target: " + report.rapid_paths);
    page.Begin({"source", "output", "axes"});
    for (const ReportRapid& rapid : report.rapids)
      page.Row({PlaceText(rapid.source), PlaceText(rapid.output), rapid.axes});
    page.End();
  }
  if (!report.losses.empty()) {
    page.Section("Lost");
    page.Begin({"what", "source", "output"});
    for (const ReportLoss& loss : report.losses) page.Row({loss.what, PlaceText(loss.source), PlaceText(loss.output)});
    page.End();
  }
  page.Lines("Added", report.added);
  WriteAssumptions(page, report);
  if (!report.findings.empty()) {
    page.Section("Findings");
    page.Begin({"severity", "code", "place", "text"});
    for (const ReportFinding& finding : report.findings)
      page.Row({finding.severity, finding.code, PlaceText(finding.source), finding.message});
    page.End();
  }
  return page.Take();
}

}  // namespace ncport::app
