#include "backends/translate.h"

#include "backends/fanuc/argument_letter.h"
#include "backends/fanuc/raise.h"
#include "backends/fanuc/write.h"
#include "backends/sinumerik/raise.h"
#include "backends/sinumerik/write.h"
#include "base/result.h"

namespace ncport::backends {

bool Raise(const TranslateInput& input, Translation& translation, diag::Sink& sink) {
  switch (input.to->language) {
    case dialects::Language::kFanuc:
      return fanuc::Raise({input.source, input.source_machine, input.to, input.config, input.from}, translation, sink);
    case dialects::Language::kSinumerik:
      return sinumerik::Raise({input.source, input.from, input.source_machine, input.to, input.config,
                               input.from->language == dialects::Language::kFanuc ? fanuc::ArgumentLetter : nullptr},
                              translation, sink);
    default:
      break;
  }
  sink.Report(diag::Code::kNotExpressible, SourceRange{}, "a program with loops, calls and variables", input.to->name)
      .help = "ncport flatten writes programs of literal blocks";
  return false;
}

dialects::Profile ForReading(const dialects::Profile& to) {
  dialects::Profile profile = to;
  // Angles are brought between -180 and 180 behind each function that yields them (fanuc-14, rows 32 and 33).
  if (!profile.fanuc.atan_range.Known()) profile.fanuc.atan_range.Set(dialects::FanucSettings::AtanRange::kPositive);
  return profile;
}

std::vector<OutputFile> Print(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers) {
  switch (to.language) {
    case dialects::Language::kFanuc:
      return fanuc::Write(to, translation, headers);
    case dialects::Language::kSinumerik:
      return sinumerik::Write(to, translation, headers);
    default:
      NCPORT_BUG("a module for {} reached the printers", to.name);
  }
}

}  // namespace ncport::backends
