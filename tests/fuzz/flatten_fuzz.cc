// SINUMERIK text -> IR -> run -> flat blocks, with small budgets: every program ends, in flat text or in findings.
#include <string>

#include "backends/iso/flat_writer.h"
#include "base/diag/sink.h"
#include "base/encoding.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/machine.h"
#include "dialects/registry.h"
#include "exec/run.h"
#include "frontend/reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace ncport::tests {
namespace {

void OneInput(std::string_view bytes) {
  static const dialects::Profile source = dialects::BuiltIn("sinumerik-840d-mill");
  static const dialects::Profile target = dialects::BuiltIn("iso-mill");
  static const ir::Machine machine = dialects::MachineFor(source);
  const std::string text = DecodeText(std::string(bytes.substr(0, kFuzzBytes))).text;
  SourceFiles files;
  diag::Sink sink;
  ir::Module module;
  const FileId file = files.Add("fuzz.mpf", text);
  const Status read = frontend::ReadFile(files, file, source, {}, module, sink);
  frontend::ResolveNames(files, module, source, sink);
  static_cast<void>(read);  // what was refused never runs: the run must say so itself
  if (module.programs.Empty()) return;
  exec::RunOptions options;
  options.entry = ir::ProgramId{0U};
  options.max_blocks = 2000;
  options.max_text_bytes = 1U << 16U;
  options.max_cells = 1U << 14U;
  options.report_variables = true;
  exec::NoEnvironment environment;
  std::string flat_text;
  OutputSink output(flat_text);
  backends::iso::FlatOptions flat;
  flat.max_bytes = 1U << 20U;
  backends::iso::FlatWriter writer(module, files, target, flat, output, sink);
  exec::Run(module, machine, options, environment, writer, sink);
  const Status finished = writer.Finish();
  static_cast<void>(finished);
}

}  // namespace
}  // namespace ncport::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ncport::tests::OneInput(ncport::tests::AsText(data, size));
  return 0;
}
