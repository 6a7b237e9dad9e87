// Text -> IR; one target for each language (NCPORT_FUZZ_PROFILE). The module verifies whatever the text is; the parser
// alone gives the same IR as the shape cache; the dump reads back to the same dump; resolving names leaves a module
// that verifies too.
#include <string>

#include "base/diag/sink.h"
#include "base/encoding.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
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

const dialects::Profile& Profile() {
  static const dialects::Profile profile = dialects::BuiltIn(NCPORT_FUZZ_PROFILE);
  return profile;
}

void OneInput(std::string_view bytes) {
  const std::string text = DecodeText(std::string(bytes.substr(0, kFuzzBytes))).text;
  std::string dumps[2];
  for (const bool cache : {false, true}) {
    SourceFiles files;
    diag::Sink sink;
    ir::Module module;
    const FileId file = files.Add(NCPORT_FUZZ_FILE, text);
    const Status status = frontend::ReadFile(files, file, Profile(), {.shape_cache = cache}, module, sink);
    NCPORT_CHECK(status.Ok() == !sink.HasErrors(), "reading says {} with {} errors", status.Ok(), sink.ErrorCount());
    ir::Verify(module, "read by the fuzzer", {.structure_built = true});
    dumps[cache ? 1 : 0] = DumpOf(module);
    if (!cache) continue;
    frontend::ResolveNames(files, module, Profile(), sink);
    ir::Verify(module, "resolved by the fuzzer", {.names_resolved = true, .structure_built = true});
    DumpOf(module);
  }
  NCPORT_CHECK(dumps[0] == dumps[1], "the shape cache changes the IR\n{}\nbut with it\n{}", dumps[0], dumps[1]);
}

}  // namespace
}  // namespace ncport::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ncport::tests::OneInput(ncport::tests::AsText(data, size));
  return 0;
}
