// What both forms of the report share.
#include "app/report.h"

#include "base/diag/place.h"
#include "base/letter_case.h"

namespace ncport::app {

std::optional<ReportForm> ReportFormOf(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string ending = LowerOf(file_name.substr(dot + 1));
  if (ending == "json") return ReportForm::kJson;
  if (ending == "html" || ending == "htm") return ReportForm::kHtml;
  return std::nullopt;
}

std::string RenderReport(const Report& report, ReportForm form) {
  return form == ReportForm::kJson ? RenderReportJson(report) : RenderReportHtml(report);
}

ReportPlace PlaceForReport(const SourceRange& at, const SourceFiles& files) {
  const diag::Place place = diag::PlaceOf(at, files);
  return {std::string(place.file), place.line, static_cast<std::uint32_t>(place.column)};
}

void AddFindings(Report& report, const diag::Sink& sink, const SourceFiles& files) {
  for (const diag::Diagnostic& finding : sink.All()) {
    if (finding.severity == diag::Severity::kError) continue;
    report.findings.push_back({std::string(diag::NameOf(finding.severity)),
                               std::string(diag::InfoOf(finding.code).number), finding.message,
                               PlaceForReport(finding.at, files)});
  }
}

}  // namespace ncport::app
