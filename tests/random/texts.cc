#include "tests/random/texts.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/sinumerik/print.h"
#include "base/text_buffer.h"
#include "frontend/reader.h"

namespace ncport::tests::random {

std::vector<TextFile> PrintAll(const ir::Module& module, const dialects::Profile& profile) {
  std::vector<TextFile> texts;
  for (std::size_t i = 0; i < module.file_names.size(); ++i) {
    TextBuffer out;
    backends::sinumerik::PrintFile(module, FileId{i}, profile, out);
    texts.push_back({std::string(module.View(module.file_names[i])), std::string(out.View())});
  }
  return texts;
}

std::vector<TextFile> PrintCalled(const ir::Module& module, ir::ProgramId main, const dialects::Profile& profile) {
  const std::vector<TextFile> all = PrintAll(module, profile);
  std::vector<ir::ProgramId> called{main};
  for (std::size_t i = 0; i < called.size(); ++i) {
    for (const ir::BlockId block : module.programs[called[i]].blocks) {
      for (const ir::WordId id : module.blocks[block].words) {
        const ir::Word& word = module.words[id];
        const auto call = word.Extra<ir::CallId>();
        if ((word.op != ir::WordOp::kCall && word.op != ir::WordOp::kModalCall) || !call.Valid()) continue;
        const ir::ProgramId callee = module.calls[call].program;
        if (callee.Valid() && std::ranges::find(called, callee) == called.end()) called.push_back(callee);
      }
    }
  }
  std::vector<TextFile> texts;
  for (const ir::ProgramId program : called) texts.push_back(all[module.programs[program].file.value]);
  return texts;
}

bool ReadAll(const std::vector<TextFile>& texts, const dialects::Profile& profile, SourceFiles& files,
             ir::Module& module, diag::Sink& sink) {
  for (const TextFile& file : texts) {
    const FileId id = files.Add(file.name, file.text);
    (void)frontend::ReadFile(files, id, profile, {}, module, sink);
  }
  frontend::ResolveNames(files, module, profile, sink);
  return !sink.HasErrors();
}

std::string Listing(const std::vector<TextFile>& texts) {
  std::string all;
  for (const TextFile& file : texts) all += fmt::format("--- {}\n{}", file.name, file.text);
  return all;
}

}  // namespace ncport::tests::random
