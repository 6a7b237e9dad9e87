// Where each flat block comes from, for machines (source map) and for people (side by side).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "backends/iso/flat_writer.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "ir/module.h"

namespace ncport::backends::iso {

/// JSON lines {"version", "out", "file", "line", "calls", "turns"}: line of the output, place of the source block, the
/// calls that led to it from the outermost on, and how often the block of each level had been reached in its call.
/// Blocks that the writer adds (header, end) have no line of theirs.
class SourceMapWriter final : public FlatListener {
 public:
  SourceMapWriter(const ir::Module& module, const SourceFiles& files, OutputSink& output)
      : module_(module), files_(files), output_(output) {}

  void OnFlatBlock(std::uint64_t line, std::string_view text, const FlatOrigin& origin) override;
  /// Writes the rest. Fails when the output could not take all.
  Status Finish();

 private:
  void AppendPlace(ir::BlockId block);

  const ir::Module& module_;
  const SourceFiles& files_;
  OutputSink& output_;
  TextBuffer buffer_;
};

/// The source block in the left column, its flat blocks in the right one, as the basic-block window of a control shows
/// them.
class SideBySideWriter final : public FlatListener {
 public:
  SideBySideWriter(const ir::Module& module, const SourceFiles& files, OutputSink& output)
      : module_(module), files_(files), output_(output) {}

  void OnFlatBlock(std::uint64_t line, std::string_view text, const FlatOrigin& origin) override;
  Status Finish();

 private:
  static constexpr std::size_t kWidth = 64;  // of the left column, in characters

  const ir::Module& module_;
  const SourceFiles& files_;
  OutputSink& output_;
  TextBuffer buffer_;
  ir::BlockId shown_;  // source block that the last line belongs to
  std::uint32_t shown_turn_ = 0;
};

}  // namespace ncport::backends::iso
