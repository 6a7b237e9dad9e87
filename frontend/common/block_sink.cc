#include "frontend/common/block_sink.h"

#include <algorithm>
#include <cstddef>

#include "frontend/common/chars.h"
#include "ir/builder.h"

namespace ncport::frontend {

BlockSink::BlockSink(const SourceFiles& files, FileId file, ir::Module& module) : file_(file), module_(module) {
  const std::uint32_t lines = files.LineCount(file);
  module.blocks.Reserve(module.blocks.Size() + lines);
  module.origins.Reserve(module.origins.Size() + lines);
  // Arrays of a large program are not copied each time they double. Generous: room that is never touched costs no
  // memory. Many small files grow together.
  constexpr std::size_t kBytesAWord = 6;
  constexpr std::size_t kLarge = std::size_t{1} << 20U;
  const std::size_t bytes = files.Text(file).size();
  if (bytes < kLarge) return;
  module.words.Reserve(module.words.Size() + bytes / kBytesAWord);
  module.exprs.Reserve(module.exprs.Size() + bytes / kBytesAWord);
}

void BlockSink::AddFileMark(std::uint32_t line, std::string_view mark, std::string_view rule) {
  ir::Block block = New(line);
  ir::Word word;
  word.op = ir::WordOp::kFileMark;
  word.length = static_cast<std::uint32_t>(mark.size());
  word.spelling = ir::AddSpelling(module_, mark, rule);
  block.words = {module_.words.Add(word).value, 1};
  Add(block);
}

void BlockSink::KeepRefused(std::string_view line, std::uint32_t begin, std::uint32_t end, ir::WordOp mark,
                            ir::Block& block) {
  while (begin < end && IsSpace(line[begin])) ++begin;
  const std::string_view kept = TrimEnd(line.substr(begin, end - begin));
  ir::Word word;
  word.op = ir::WordOp::kVerbatim;
  word.index = static_cast<std::uint8_t>(mark);
  word.begin = begin;
  word.length = static_cast<std::uint32_t>(kept.size());
  word.extra = module_.strings.Intern(kept).value;
  block.words = {module_.words.Add(word).value, 1};
  block.flags |= ir::Block::kRefused;
}

std::uint16_t GapBefore(std::string_view line, std::uint32_t at) {
  std::uint32_t gap = 0;
  while (gap < at && IsSpace(line[at - gap - 1])) ++gap;
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(gap, 0xFFFF));
}

}  // namespace ncport::frontend
