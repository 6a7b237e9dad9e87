// The program as text of its own language: printed, read back, run, printed again.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "backends/sinumerik/print.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "frontend/reader.h"
#include "ir/verify.h"
#include "tests/random/direction_checks.h"
#include "tests/random/runs.h"

namespace ncport::tests::random {

namespace {

struct TextFile {
  std::string name;
  std::string text;
};

std::vector<TextFile> PrintAll(const ir::Module& module, const dialects::Profile& profile) {
  std::vector<TextFile> texts;
  for (std::size_t i = 0; i < module.file_names.size(); ++i) {
    TextBuffer out;
    backends::sinumerik::PrintFile(module, FileId{i}, profile, out);
    texts.push_back({std::string(module.View(module.file_names[i])), std::string(out.View())});
  }
  return texts;
}

std::string Listing(const std::vector<TextFile>& texts) {
  std::string all;
  for (const TextFile& file : texts) all += fmt::format("--- {}\n{}", file.name, file.text);
  return all;
}

}  // namespace

Finding CheckSinumerikText(const Subject& subject, const Direction& /*direction*/) {
  const ir::Module& module = *subject.module;
  const std::vector<TextFile> texts = PrintAll(module, *subject.profile);

  SourceFiles files;
  ir::Module read;
  diag::Sink sink;
  for (const TextFile& file : texts) {
    const FileId id = files.Add(file.name, file.text);
    (void)frontend::ReadFile(files, id, *subject.profile, {}, read, sink);
  }
  frontend::ResolveNames(files, read, *subject.profile, sink);
  if (sink.HasErrors()) return {Verdict::kFails, "read back, " + FirstError(sink), TextOf(sink), Listing(texts)};
  if (const auto violation = ir::FindViolation(read, {.names_resolved = true, .structure_built = true})) {
    return {Verdict::kFails, "verify what was read", *violation, Listing(texts)};
  }
  const std::vector<TextFile> again = PrintAll(read, *subject.profile);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (again.size() <= i || again[i].text != texts[i].text) {
      return {Verdict::kFails, "print again", FirstDifference(texts[i].text, again.size() <= i ? "" : again[i].text),
              Listing(texts)};
    }
  }

  const Subject other{&read, read.FindProgram(module.View(module.programs[subject.main].name), true), subject.profile,
                      subject.machine, subject.max_blocks};
  if (!other.main.Valid()) return {Verdict::kFails, "main program lost", "no program of that name", Listing(texts)};
  const SkipSets skips = SkipSetsOf(module);
  for (std::uint32_t i = 0; i < skips.count; ++i) {
    Run first;
    RunProgram(subject, skips.sets[i], first);
    Run second;
    RunProgram(other, skips.sets[i], second);
    if (first.text != second.text || first.outcome != second.outcome) {
      return {Verdict::kFails, "trace, " + KindOfDifference(first.text, second.text),
              FirstDifference(first.text, second.text) + second.findings, Listing(texts)};
    }
  }
  return {};
}

}  // namespace ncport::tests::random
