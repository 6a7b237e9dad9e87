// What the readers of all languages do alike with the lines of a file: blocks with their origin, file marks, and texts
// that were not understood.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/source_files.h"
#include "ir/module.h"

namespace ncport::frontend {

class BlockSink {
 public:
  /// Makes room for the blocks, words and expressions of the file.
  BlockSink(const SourceFiles& files, FileId file, ir::Module& module);

  /// An empty block that comes from `line`; it is in the module when Add has it.
  [[nodiscard]] ir::Block New(std::uint32_t line) {
    ir::Block block;
    block.origin = ir::OriginId{module_.origins.Size()};
    ir::Origin& origin = module_.origins.Emplace();
    origin.file = file_;
    origin.line = line;
    block.words.begin = static_cast<std::uint32_t>(module_.words.Size());
    return block;
  }
  void Add(const ir::Block& block) { module_.blocks.Add(block); }

  /// A line that only frames the text: `%`, a program header. `rule`: card row of the mark.
  void AddFileMark(std::uint32_t line, std::string_view mark, std::string_view rule);
  /// Makes `block` a refused one that keeps the bytes from `begin` to `end` of its line, without blanks around them.
  /// `mark`: the structure mark that the block would have been, so that its partner is no stray; kMotion: none.
  void KeepRefused(std::string_view line, std::uint32_t begin, std::uint32_t end, ir::WordOp mark, ir::Block& block);

 private:
  FileId file_;
  ir::Module& module_;
};

/// Blanks in front of the comment at byte `at` of the line, for ir::Comment::gap.
std::uint16_t GapBefore(std::string_view line, std::uint32_t at);

}  // namespace ncport::frontend
