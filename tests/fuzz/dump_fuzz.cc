// Text of a dump -> module. What parses and verifies dumps to a text that parses again to the same dump; what does not
// is findings. No text crashes the parser of dumps.
#include <string>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "ir/dump.h"
#include "ir/parse_dump.h"
#include "ir/verify.h"
#include "tests/fuzz/fuzz_target.h"

namespace ncport::tests {
namespace {

std::string DumpOf(const ir::Module& module) {
  TextBuffer out;
  ir::Dump(module, out);
  return std::string(out.View());
}

void OneInput(std::string_view text) {
  diag::Sink sink;
  const Result<ir::Module> first = ir::ParseDump(text.substr(0, kFuzzBytes), sink);
  NCPORT_CHECK(first.Ok() == !sink.HasErrors(), "parsing says {} with {} errors", first.Ok(), sink.ErrorCount());
  if (!first.Ok()) return;
  ir::Verify(*first, "parsed by the fuzzer");
  const std::string once = DumpOf(*first);
  diag::Sink again;
  const Result<ir::Module> second = ir::ParseDump(once, again);
  NCPORT_CHECK(second.Ok(), "a dump does not parse: {}\n{}", again.Empty() ? "" : again.All().front().message, once);
  const std::string twice = DumpOf(*second);
  NCPORT_CHECK(once == twice, "a dump changes when it is read back\n{}\nbecomes\n{}", once, twice);
}

}  // namespace
}  // namespace ncport::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ncport::tests::OneInput(ncport::tests::AsText(data, size));
  return 0;
}
