#include "backends/sinumerik/write.h"

#include <algorithm>

#include "backends/sinumerik/printer.h"

namespace ncport::backends::sinumerik {

namespace {

/// One file on its way: blocks become lines.
class FileWriter {
 public:
  FileWriter(const dialects::Profile& to, const ir::Module& module) : module_(module), printer_(module, to, text_) {}

  void Comment(std::string_view line) {
    text_.Append("; ");
    // `;` runs to the end of the line, so no character needs care but the end of line itself.
    for (const char c : line) text_.Append(c == '\n' || c == '\r' ? ' ' : c);
    text_.Append('\n');
    ++lines_;
  }
  void Block(ir::BlockId id) {
    const ir::Block& block = module_.blocks[id];
    printer_.Block(block);
    file_.line_blocks.resize(++lines_);
    file_.line_blocks.back() = id;
    if ((block.flags & ir::Block::kAdded) != 0) file_.added_lines.push_back(lines_);
  }
  OutputFile Finish(std::string name) {
    file_.name = std::move(name);
    file_.text = text_.View();
    return std::move(file_);
  }

 private:
  const ir::Module& module_;
  TextBuffer text_;
  Printer printer_;
  OutputFile file_;
  std::uint32_t lines_ = 0;
};

const ProgramHeader* FindHeader(const std::vector<ProgramHeader>& headers, ir::ProgramId program) {
  const auto found = std::find_if(headers.begin(), headers.end(),
                                  [&](const ProgramHeader& header) { return header.program == program; });
  return found == headers.end() ? nullptr : &*found;
}

/// The mark that begins a program on a punch tape, and the path line directly below it (sinumerik-1.1).
bool BeginsFile(const ir::Module& module, const ir::Block& block) {
  for (const ir::WordId word : block.words) {
    if (module.words[word].op == ir::WordOp::kFileMark) return true;
  }
  return block.words.Empty() && block.comments.count == 1 &&
         module.View(module.comments[block.comments[0]].text).starts_with("$PATH");
}

void WriteProgram(const Translation& translation, const ProgramName& name, const std::vector<ProgramHeader>& headers,
                  FileWriter& writer) {
  const ir::Module& module = translation.module;
  const ProgramHeader* header = FindHeader(headers, name.program);
  const IdRange<ir::BlockId> blocks = module.programs[name.program].blocks;
  std::uint32_t next = 0;
  while (next < blocks.count && BeginsFile(module, module.blocks[blocks[next]])) writer.Block(blocks[next++]);
  if (header != nullptr) {
    for (const std::string& line : header->lines) writer.Comment(line);
  }
  for (; next < blocks.count; ++next) writer.Block(blocks[next]);
}

std::string BaseName(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}

}  // namespace

std::vector<OutputFile> Write(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers) {
  const ir::Module& module = translation.module;
  std::vector<OutputFile> files;
  if (translation.keeps_files) {
    for (const ir::ProgramId program : module.programs.Ids()) {
      const FileId file = module.programs[program].file;
      const auto same_file = [&](const ProgramName& name) { return module.programs[name.program].file == file; };
      const auto first = std::find_if(translation.programs.begin(), translation.programs.end(), same_file);
      if (first == translation.programs.end()) continue;
      bool earlier = false;  // each file once, where its first program stands
      for (std::uint32_t i = 0; i < program.value; ++i)
        earlier = earlier || module.programs[ir::ProgramId{std::size_t{i}}].file == file;
      if (earlier) continue;
      FileWriter writer(to, module);
      for (const ir::ProgramId other : module.programs.Ids()) {
        const auto name = std::find_if(translation.programs.begin(), translation.programs.end(),
                                       [&](const ProgramName& known) { return known.program == other; });
        if (module.programs[other].file == file && name != translation.programs.end())
          WriteProgram(translation, *name, headers, writer);
      }
      files.push_back(writer.Finish(BaseName(module.View(module.file_names[file.value]))));
    }
  } else {
    for (const ProgramName& name : translation.programs) {
      FileWriter writer(to, module);
      WriteProgram(translation, name, headers, writer);
      files.push_back(writer.Finish(name.target + (name.main ? ".MPF" : ".SPF")));
    }
  }
  // One file may have any name; it is read back under its own.
  if (files.size() == 1) {
    files.front().reads_as = std::move(files.front().name);
    files.front().name.clear();
  }
  return files;
}

}  // namespace ncport::backends::sinumerik
