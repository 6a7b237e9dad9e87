// ncport_dump_seeds FOLDER FILE...: dumps of SINUMERIK files as seeds for the fuzzing of dumps.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/diag/sink.h"
#include "base/encoding.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
#include "ir/dump.h"
#include "tests/tools/process.h"

int main(int argc, char** argv) {
  using namespace ncport;
  if (argc < 3) {
    std::fprintf(stderr, "usage: ncport_dump_seeds FOLDER FILE...\n");
    return 2;
  }
  const dialects::Profile profile = dialects::BuiltIn("sinumerik-840d-mill");
  std::filesystem::create_directories(argv[1]);
  for (int i = 2; i < argc; ++i) {
    SourceFiles files;
    diag::Sink sink;
    ir::Module module;
    const FileId file = files.Add("seed.mpf", DecodeText(tests::ReadFileOrDie(argv[i])).text);
    // Files with refused blocks are good seeds, too.
    const Status status = frontend::ReadFile(files, file, profile, {}, module, sink);
    static_cast<void>(status);
    for (const bool resolved : {false, true}) {
      if (resolved) frontend::ResolveNames(files, module, profile, sink);
      TextBuffer out;
      ir::Dump(module, out);
      const std::filesystem::path name =
          std::filesystem::path(argv[i]).stem().string() + (resolved ? "-resolved.ir" : "-read.ir");
      std::ofstream(std::filesystem::path(argv[1]) / name, std::ios::binary) << out.View();
    }
  }
  return 0;
}
