#include "tests/random/texts.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/fanuc/print.h"
#include "backends/fanuc/print_expr.h"
#include "backends/sinumerik/print.h"
#include "base/text_buffer.h"
#include "dialects/fanuc/words.h"
#include "frontend/reader.h"
#include "ir/builder.h"

namespace ncport::tests::random {

namespace {

bool HasHeader(const ir::Module& module, ir::BlockId block) {
  for (const ir::WordId word : module.blocks[block].words) {
    if (module.words[word].op == ir::WordOp::kHeader) return true;
  }
  return false;
}

/// Words that the FANUC printer has no form for, since no translation makes them: as the text that they are.
/// Empty: it has one.
std::string TextOf(const ir::Module& module, const ir::Word& word, const dialects::Profile& profile) {
  using ir::WordOp;
  namespace words = dialects::fanuc;
  const words::System system = *words::SystemOf(profile);
  const auto value = [&](std::string_view letter, bool whole) {
    TextBuffer out;
    out.Append(letter);
    backends::fanuc::ExprPrinter(module, profile, out)
        .WordValue(word.value, whole ? backends::fanuc::NumberPlace::kInteger : backends::fanuc::NumberPlace::kWord);
    return std::string(out.View());
  };
  const bool whole = (word.flags & ir::Word::kIncrements) != 0;
  switch (word.op) {
    case WordOp::kCycle: {
      if (word.index == static_cast<std::uint8_t>(ir::Cycle::kNone)) return "G80";
      for (const words::CycleRow& row : words::Cycles()) {
        if (row.cycle == static_cast<ir::Cycle>(word.index) && (row.systems >> static_cast<unsigned>(system) & 1U) != 0)
          return std::string(row.text);
      }
      return {};
    }
    case WordOp::kCycleValue:
      return value(module.View(module.spellings[word.spelling].text),
                   whole || word.index == static_cast<std::uint8_t>(ir::CycleField::kRepeats));
    case WordOp::kCenter:
      return whole ? value("K", true) : std::string();
    case WordOp::kPolarMode:
      return word.index != 0 ? "G16" : "G15";
    default:
      return {};
  }
}

/// The module as the FANUC printer takes it: names without O, no word that it writes by itself (the O number, the G4 of
/// a dwell).
ir::Module ForPrinting(const ir::Module& source, const dialects::Profile& profile) {
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
        ir::Word word = module.words[word_id];
        if (word.op == ir::WordOp::kHeader || (dwell && word.op == ir::WordOp::kInert)) continue;
        if (const std::string text = TextOf(module, word, profile); !text.empty()) {
          const ir::Phase phase = word.phase;
          word = {};
          word.op = ir::WordOp::kInert;
          word.phase = phase;
          word.spelling = ir::AddSpelling(module, text, "");
        }
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

namespace {
/// Cycles that ncport brings along are no text of the user.
bool IsLibrary(const ir::Module& module, FileId file) {
  return std::ranges::any_of(module.programs.All(),
                             [&](const ir::Program& program) { return program.library && program.file == file; });
}
}  // namespace

std::vector<TextFile> PrintAll(const ir::Module& module, const dialects::Profile& profile) {
  const bool fanuc = profile.language == dialects::Language::kFanuc;
  const ir::Module made = fanuc ? ForPrinting(module, profile) : ir::Module{};
  std::vector<TextFile> texts;
  for (std::size_t i = 0; i < module.file_names.size(); ++i) {
    if (IsLibrary(module, FileId{i})) continue;
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
  for (const ir::ProgramId program : called) {
    if (module.programs[program].library) continue;
    const std::string_view name = module.View(module.file_names[module.programs[program].file.value]);
    texts.push_back(*std::ranges::find(all, name, &TextFile::name));
  }
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
