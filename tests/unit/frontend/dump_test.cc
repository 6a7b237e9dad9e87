// What the readers make verifies, and its dump reads back to the same dump: no field of the IR is forgotten there.
#include "ir/dump.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/encoding.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
#include "ir/parse_dump.h"
#include "ir/verify.h"

namespace ncport::frontend {

namespace {

std::string FileText(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return DecodeText(text.str()).text;
}

std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> all;
  if (!std::filesystem::exists(folder)) return all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() && ending != ".expected" && ending != ".md") all.push_back(entry.path());
  }
  return all;
}

std::string TextOf(const ir::Module& module) {
  TextBuffer out;
  ir::Dump(module, out);
  return std::string(out.View());
}

void CheckModule(const ir::Module& module, const std::filesystem::path& path, bool resolved) {
  const auto violation = ir::FindViolation(module, {.names_resolved = resolved, .structure_built = true});
  CHECK_MESSAGE(!violation, path.string() << ": " << violation.value_or(""));
  if (violation) return;
  const std::string text = TextOf(module);
  diag::Sink findings;
  const Result<ir::Module> again = ir::ParseDump(text, findings);
  for (const auto& finding : findings.All()) {
    FAIL_CHECK(path.string() << ": line " << finding.at.line << " of the dump: " << finding.message);
  }
  if (again.Ok()) CHECK_MESSAGE(TextOf(*again) == text, path.string());
}

void CheckFile(const std::filesystem::path& path, const char* profile_name) {
  SourceFiles files;
  const FileId file = files.Add(path.filename().string(), FileText(path));
  const dialects::Profile profile = dialects::BuiltIn(profile_name);
  ir::Module module;
  diag::Sink sink;
  (void)ReadFile(files, file, profile, {}, module, sink);
  CheckModule(module, path, false);
  ResolveNames(files, module, profile, sink);
  CheckModule(module, path, !sink.HasErrors());
}

}  // namespace

TEST_CASE("dumps of SINUMERIK programs read back") {
  const auto vectors = FilesIn(std::filesystem::path(NCPORT_SOURCE_DIR) / "tests/vectors/sinumerik");
  CHECK(vectors.size() > 40);
  for (const auto& path : vectors) CheckFile(path, "sinumerik-840d-mill");
  for (const auto& path : FilesIn(std::filesystem::path(NCPORT_SHARED_DIR) / "corpus/sinumerik")) {
    CheckFile(path, "sinumerik-840d-mill");
  }
}

TEST_CASE("dumps of hostile texts read back: whatever a reader takes is a sound module") {
  // Programs of other languages, read as SINUMERIK: nearly every block is refused.
  for (const char* const folder : {"tests/vectors/fanuc", "tests/vectors/num"}) {
    for (const auto& path : FilesIn(std::filesystem::path(NCPORT_SOURCE_DIR) / folder)) {
      CheckFile(path, "sinumerik-840d-lathe");
    }
  }
}

}  // namespace ncport::frontend
