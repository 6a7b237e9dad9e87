#include "backends/fanuc/write.h"

#include "backends/fanuc/print.h"

namespace ncport::backends::fanuc {

namespace {

void Note(OutputFile& file, const std::vector<PrintedLine>& lines) {
  for (const PrintedLine& line : lines) {
    if (file.line_blocks.size() < line.line) file.line_blocks.resize(line.line);
    file.line_blocks[line.line - 1] = line.block;
    if (line.added) file.added_lines.push_back(line.line);
  }
}

void AppendTitle(TextBuffer& out, const ProgramName& name, bool o_word) {
  if (o_word) {
    out.Append('O');
    for (std::size_t i = name.target.size(); i < 4; ++i) out.Append('0');
    out.Append(name.target);
    out.Append(" (");
  } else {
    out.Append("(O");
    out.Append(name.target);
    out.Append(' ');
  }
  AppendCommentText(out, name.source);
  out.Append(")\n");
}

}  // namespace

std::vector<OutputFile> Write(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers) {
  std::vector<OutputFile> files;
  const bool by_file = to.names.program_form.Is(dialects::ProgramNaming::kFileName);
  TextBuffer text;
  std::vector<PrintedLine> lines;
  if (!by_file) text.Append("%\n");
  for (const ProgramName& name : translation.programs) {
    AppendTitle(text, name, !by_file);
    for (const ProgramHeader& header : headers) {
      if (header.program != name.program) continue;
      for (const std::string& line : header.lines) {
        text.Append('(');
        AppendCommentText(text, line);
        text.Append(")\n");
      }
    }
    PrintProgram(translation.module, name.program, to, text, &lines);
    if (!by_file) continue;
    OutputFile& file = files.emplace_back();
    file.name = name.target + ".EIA";
    file.text = text.View();
    Note(file, lines);
    text.Clear();
    lines.clear();
  }
  if (by_file) return files;
  text.Append("%\n");
  OutputFile& file = files.emplace_back();
  file.text = text.View();
  Note(file, lines);
  return files;
}

}  // namespace ncport::backends::fanuc
