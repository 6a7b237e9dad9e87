#include "tests/random/texts.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/fanuc/print.h"
#include "backends/sinumerik/print.h"
#include "base/text_buffer.h"
#include "frontend/reader.h"

namespace ncport::tests::random {

namespace {

bool HasHeader(const ir::Module& module, ir::BlockId block) {
  for (const ir::WordId word : module.blocks[block].words) {
    if (module.words[word].op == ir::WordOp::kHeader) return true;
  }
  return false;
}

/// The module as the FANUC printer takes it: names without O, no word that it writes by itself (the O number, the G4 of
/// a dwell).
ir::Module ForPrinting(const ir::Module& source) {
  ir::Module module = source;
  const auto without_o = [&](StringId id) {
    std::string_view name = module.View(id);
    return name.starts_with('O') ? module.strings.Intern(std::string(name.substr(1))) : id;
  };
  for (ir::Program& program : module.programs.All()) {
    program.name = without_o(program.name);
    for (const ir::BlockId id : program.blocks) {
      ir::Block& block = module.blocks[id];
      bool dwell = false;
      for (const ir::WordId word : block.words) dwell = dwell || module.words[word].op == ir::WordOp::kDwellSeconds;
      const auto begin = static_cast<std::uint32_t>(module.words.Size());
      for (const ir::WordId word_id : block.words) {
        const ir::Word word = module.words[word_id];
        if (word.op == ir::WordOp::kHeader || (dwell && word.op == ir::WordOp::kInert)) continue;
        module.words.Add(word);
      }
      block.words = {begin, static_cast<std::uint32_t>(module.words.Size()) - begin};
    }
    // The line of the O number.
    if (!program.blocks.Empty() && HasHeader(source, program.blocks[0])) {
      ++program.blocks.begin;
      --program.blocks.count;
    }
  }
  for (ir::Call& call : module.calls.All()) {
    if (call.name.Valid()) call.name = without_o(call.name);
  }
  return module;
}

void PrintFanuc(const ir::Module& module, FileId file, const dialects::Profile& profile, TextBuffer& out) {
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (module.programs[program].file != file) continue;
    out.Append('O');
    out.Append(module.View(module.programs[program].name));
    out.Append('\n');
    backends::fanuc::PrintProgram(module, program, profile, out, nullptr);
  }
}

}  // namespace

std::vector<TextFile> PrintAll(const ir::Module& module, const dialects::Profile& profile) {
  const bool fanuc = profile.language == dialects::Language::kFanuc;
  const ir::Module made = fanuc ? ForPrinting(module) : ir::Module{};
  std::vector<TextFile> texts;
  for (std::size_t i = 0; i < module.file_names.size(); ++i) {
    TextBuffer out;
    if (fanuc) {
      PrintFanuc(made, FileId{i}, profile, out);
    } else {
      backends::sinumerik::PrintFile(module, FileId{i}, profile, out);
    }
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
        ir::ProgramId callee = module.calls[call].program;
        const ir::ExprId name = module.calls[call].name_expr;
        if (!callee.Valid() && name.Valid() && module.exprs[name].op == ir::ExprOp::kText)
          callee = module.FindProgram(module.View(StringId{std::size_t{module.exprs[name].a}}), true);
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
