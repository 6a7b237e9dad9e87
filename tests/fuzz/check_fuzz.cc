// The whole of `ncport check` on any bytes, as each language: findings or none, and a report in every format.
#include <string>

#include "app/ncport.h"
#include "base/diag/github_renderer.h"
#include "base/diag/json_renderer.h"
#include "base/diag/sarif_renderer.h"
#include "base/diag/text_renderer.h"
#include "tests/fuzz/fuzz_target.h"

namespace ncport::tests {
namespace {

void OneInput(std::string_view bytes) {
  static constexpr const char* kProfiles[] = {"sinumerik-840d-mill", "fanuc-mill", "fanuc-lathe-a", "iso-mill"};
  for (const char* profile : kProfiles) {
    Context context;
    CheckOptions options;
    options.from = profile;
    const Status checked = Check(context, {{"fuzz.nc", std::string(bytes.substr(0, kFuzzBytes))}}, options);
    NCPORT_CHECK(checked.Ok() == !context.findings.HasErrors(), "check says {} with {} errors", checked.Ok(),
                 context.findings.ErrorCount());
    context.findings.SortByPlace();
    (void)diag::RenderText(context.findings, context.files);
    (void)diag::RenderJson(context.findings, context.files);
    (void)diag::RenderSarif(context.findings, context.files, Version());
    (void)diag::RenderGithub(context.findings, context.files);
  }
}

}  // namespace
}  // namespace ncport::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ncport::tests::OneInput(ncport::tests::AsText(data, size));
  return 0;
}
