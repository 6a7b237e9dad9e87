#include "base/diag/github_renderer.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "base/diag/place.h"

namespace ncport::diag {

namespace {

// Percent and line ends are coded everywhere, colon and comma also inside a property.
std::string Coded(std::string_view text, std::string_view special) {
  std::string coded;
  for (const char c : text) {
    if (special.find(c) == std::string_view::npos) {
      coded += c;
    } else {
      fmt::format_to(std::back_inserter(coded), "%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return coded;
}

constexpr std::string_view kInText = "%\r\n";
constexpr std::string_view kInProperty = "%\r\n:,";

std::string_view CommandOf(Severity severity) { return severity == Severity::kInfo ? "notice" : NameOf(severity); }

}  // namespace

std::string RenderGithub(const Sink& sink, const SourceFiles& files) {
  std::string text;
  for (const Diagnostic& diagnostic : sink.All()) {
    const Place place = PlaceOf(diagnostic.at, files);
    fmt::format_to(std::back_inserter(text), "::{} ", CommandOf(diagnostic.severity));
    if (!place.file.empty()) fmt::format_to(std::back_inserter(text), "file={},", Coded(place.file, kInProperty));
    if (place.line != 0) {
      fmt::format_to(std::back_inserter(text), "line={0},endLine={0},col={1},endColumn={2},", place.line, place.column,
                     place.end_column);
    }
    std::string message = diagnostic.message;
    for (const Note& note : diagnostic.notes) {
      const std::string note_place = PlaceText(PlaceOf(note.at, files));
      message += "\nnote: " + note_place + (note_place.empty() ? "" : ": ") + note.text;
    }
    if (!diagnostic.help.empty()) message += "\nhelp: " + diagnostic.help;
    if (!diagnostic.control.empty()) message += "\ncontrol: " + diagnostic.control;
    fmt::format_to(std::back_inserter(text), "title={}::{}\n", InfoOf(diagnostic.code).number, Coded(message, kInText));
  }
  return text;
}

}  // namespace ncport::diag
