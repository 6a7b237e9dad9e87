// The sheet that goes to the machine with a program that ncport wrote: what is required, what stands
// for what, how far each tool goes, what was lost and what was assumed. Plain data; two renderers, one per file ending.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "base/source_files.h"

namespace ncport::app {

/// A place in a source or an output file. `line` counts from 1; 0: none is known.
struct ReportPlace {
  std::string file;
  std::uint64_t line = 0;
  std::uint32_t column = 0;
};

/// A line of a map: words of the source and what stands for them.
struct ReportPair {
  std::string source;
  std::string target;
  std::string note;  // unit, range, lifetime; may be empty
};

/// A parameter of a program that callers give.
struct ReportParameter {
  std::string program;    // of the target
  std::string letter;     // A, B ... or the variable's name
  std::string source;     // name in the source
  std::string unit;       // mm, degrees ... empty: unknown
  std::string low, high;  // "20", or by another parameter: "EXTD-1"; empty: not declared
};

struct ReportLoss {
  std::string what;
  ReportPlace source;
  ReportPlace output;  // of the comment that stands for it
};

/// How far one axis goes with a tool. mm or degrees, the transverse axis as radius.
struct ReportAxis {
  std::string name;
  double low = 0, high = 0;
  std::optional<double> low_limit, high_limit;  // of the profile or [limits]
};

/// A position of the axes that are known there.
struct ReportPoint {
  std::vector<std::pair<std::string, double>> axes;
  ReportPlace source;
};

/// What one tool does from its call to the next one's.
struct ReportEnvelope {
  std::string tool;                               // words of the source; empty: before the first tool call
  std::vector<ReportAxis> axes;                   // of the ends of all moves and the bulge of arcs
  std::optional<ReportPoint> first_approach;      // where the first feed move behind a rapid begins
  std::optional<ReportPoint> last_approach;       // where the last one does
  std::optional<double> speed;                    // largest S, 1/min
  std::optional<double> surface_speed;            // largest S under constant surface speed, m/min
  std::optional<double> feed;                     // largest F, mm/min
  std::optional<double> feed_per_revolution;      // mm
  std::optional<double> speed_limit, feed_limit;  // 1/min, mm/min; of [limits]
};

/// A rapid of several axes whose path may differ between the two machines.
struct ReportRapid {
  ReportPlace source;
  ReportPlace output;
  std::string axes;  // "XZ"
};

/// Something the output rests on that only the machine can confirm.
struct ReportAssumption {
  std::string text;
  std::string rule;               // card row or profile key; may be empty
  std::vector<std::string> test;  // blocks to try, for example two in MDI
};

struct ReportFinding {
  std::string severity, code, message;
  ReportPlace source;
};

/// Sections that are empty are left out of the HTML page and are empty lists in JSON.
struct Report {
  std::string command;               // "flatten", "translate"
  std::string version;               // of ncport
  std::string from, to;              // profiles
  std::vector<std::string> sources;  // file names
  std::string source_hash;           // 16 hexadecimal digits
  std::vector<std::string> required;
  std::vector<ReportParameter> parameters;
  std::vector<ReportPair> programs, variables, tools, offsets, functions, alarms;
  std::vector<std::string> comparison;  // result, a sentence each
  std::vector<ReportEnvelope> envelopes;
  std::vector<ReportRapid> rapids;
  std::string rapid_paths;  // "straight -> unknown"; empty: both machines are known to go the same way
  std::vector<ReportLoss> losses;
  std::vector<std::string> added;  // blocks that the source does not have, with the reason
  std::vector<ReportAssumption> assumptions;
  std::vector<ReportFinding> findings;
};

/// An object with `version` and the fields of Report; what does not exist is null or an empty list.
std::string RenderReportJson(const Report& report);
/// One page without scripts, style sheets or pictures from elsewhere. Each assumption has a box to tick.
std::string RenderReportHtml(const Report& report);

enum class ReportForm : std::uint8_t { kJson, kHtml };
/// By the ending of the file name: `.json`, `.html`, `.htm`, in any case. Nothing: another ending.
std::optional<ReportForm> ReportFormOf(std::string_view file_name);
std::string RenderReport(const Report& report, ReportForm form);

ReportPlace PlaceForReport(const SourceRange& at, const SourceFiles& files);
/// All findings of the sink that are no errors.
void AddFindings(Report& report, const diag::Sink& sink, const SourceFiles& files);

}  // namespace ncport::app
