// Every behaviour vector and sample is read without a finding, and reads the same with and without the shape cache.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/encoding.h"
#include "dialects/registry.h"
#include "frontend/reader.h"

namespace ncport::frontend {

namespace {

std::string FileText(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return DecodeText(text.str()).text;
}

std::vector<std::filesystem::path> ProgramsIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> all;
  if (!std::filesystem::exists(folder)) return all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".mpf" || ending == ".spf" || ending == ".MPF" || ending == ".SPF") all.push_back(entry.path());
  }
  return all;
}

struct Read {
  ir::Module module;
  diag::Sink sink;
};
void ReadText(const std::string& name, const std::string& text, bool cache, Read& result) {
  SourceFiles files;
  const FileId file = files.Add(name, text);
  const dialects::Profile profile = dialects::BuiltIn("sinumerik-840d-mill");
  (void)ReadFile(files, file, profile, {.shape_cache = cache}, result.module, result.sink);
}

bool SameWords(const ir::Module& a, const ir::Module& b) {
  if (a.words.Size() != b.words.Size() || a.blocks.Size() != b.blocks.Size() || a.exprs.Size() != b.exprs.Size()) {
    return false;
  }
  for (const ir::WordId id : a.words.Ids()) {
    const ir::Word& x = a.words[id];
    const ir::Word& y = b.words[id];
    if (x.op != y.op || x.index != y.index || x.mode != y.mode || x.phase != y.phase || x.flags != y.flags ||
        x.value != y.value || x.extra != y.extra || x.begin != y.begin || x.length != y.length) {
      return false;
    }
  }
  for (const ir::ExprId id : a.exprs.Ids()) {
    const ir::Expr& x = a.exprs[id];
    const ir::Expr& y = b.exprs[id];
    if (x.op != y.op || x.type != y.type || x.flags != y.flags || x.count != y.count || x.a != y.a || x.b != y.b) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("SINUMERIK vectors are read without a finding") {
  const auto programs = ProgramsIn(std::filesystem::path(NCPORT_SOURCE_DIR) / "tests/vectors/sinumerik");
  CHECK(programs.size() > 40);
  for (const auto& path : programs) {
    Read read;
    ReadText(path.filename().string(), FileText(path), true, read);
    CHECK_MESSAGE(read.sink.Empty(), path.string());
  }
}

TEST_CASE("blocks from the shape cache equal those of the parser, also in files that are wrong") {
  auto programs = ProgramsIn(std::filesystem::path(NCPORT_SOURCE_DIR) / "tests/vectors/sinumerik");
  for (auto& path : ProgramsIn(std::filesystem::path(NCPORT_SOURCE_DIR) / "samples")) programs.push_back(path);
  for (auto& path : ProgramsIn(std::filesystem::path(NCPORT_SHARED_DIR) / "corpus/sinumerik")) programs.push_back(path);
  for (const auto& path : programs) {
    Read cached;
    Read parsed;
    ReadText(path.filename().string(), FileText(path), true, cached);
    ReadText(path.filename().string(), FileText(path), false, parsed);
    CHECK_MESSAGE(SameWords(cached.module, parsed.module), path.string());
    CHECK(cached.sink.All().size() == parsed.sink.All().size());
  }
}

}  // namespace ncport::frontend
