// The whole of `ncport translate` on any bytes, with a short comparison: a translation or findings. What is translated
// differs from its source in no run, or the comparison says so.
#include <string>

#include "app/ncport.h"
#include "tests/fuzz/fuzz_target.h"

namespace ncport::tests {
namespace {

struct Direction {
  const char* from;
  const char* to;
};

void OneInput(std::string_view bytes) {
  static constexpr Direction kDirections[] = {
      {"sinumerik-840d-mill", "fanuc-mill"},
      {"sinumerik-840d-lathe", "mazak-qtn"},
      {"sinumerik-840d-mill", "sinumerik-840d-mill"},
  };
  for (const Direction& direction : kDirections) {
    Context context;
    TranslateOptions options;
    options.from = direction.from;
    options.to = direction.to;
    options.verify = true;
    options.runs = 2;
    options.max_blocks = 1000;
    options.max_cells = 1U << 14U;
    options.max_text_bytes = 1U << 16U;
    TranslateResult result;
    const Status done = Translate(context, {{"fuzz.mpf", std::string(bytes.substr(0, kFuzzBytes))}}, options, result);
    NCPORT_CHECK(done.Ok() == !result.files.empty(), "{} to {}: done is {} with {} files", direction.from, direction.to,
                 done.Ok(), result.files.size());
    NCPORT_CHECK(done.Ok() || context.findings.HasErrors(), "{} to {}: nothing is written and nobody says why",
                 direction.from, direction.to);
  }
}

}  // namespace
}  // namespace ncport::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ncport::tests::OneInput(ncport::tests::AsText(data, size));
  return 0;
}
