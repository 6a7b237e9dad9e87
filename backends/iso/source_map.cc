#include "backends/iso/source_map.h"

#include <fmt/format.h>

#include <iterator>

#include "base/number_text.h"
#include "base/utf8.h"

namespace ncport::backends::iso {
namespace {

constexpr std::size_t kFlushAt = std::size_t{1} << 16U;

void AppendJsonText(TextBuffer& out, std::string_view text) {
  out.Append('"');
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out.Append('\\');
      out.Append(c);
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out.Append(fmt::format("\\u{:04x}", static_cast<unsigned>(c)));
    } else {
      out.Append(c);
    }
  }
  out.Append('"');
}

}  // namespace

void SourceMapWriter::AppendPlace(ir::BlockId block) {
  const SourceRange range = module_.RangeOf(module_.blocks[block]);
  buffer_.Append("\"file\":");
  AppendJsonText(buffer_, range.file.Valid() ? files_.Name(range.file) : std::string_view{});
  buffer_.Append(",\"line\":");
  AppendInteger(buffer_, range.line);
}

void SourceMapWriter::OnFlatBlock(std::uint64_t line, std::string_view, const FlatOrigin& origin) {
  if (!origin.block.Valid()) return;
  buffer_.Append("{\"version\":1,\"out\":");
  AppendInteger(buffer_, static_cast<std::int64_t>(line));
  buffer_.Append(',');
  AppendPlace(origin.block);
  buffer_.Append(",\"calls\":[");
  const exec::CallFrameView* frames = origin.frames;
  for (std::uint32_t level = 0; frames != nullptr && level < frames->depth; ++level) {
    if (level != 0) buffer_.Append(',');
    buffer_.Append('{');
    AppendPlace(frames->call_blocks[level]);
    buffer_.Append('}');
  }
  buffer_.Append("],\"turns\":[");
  for (std::uint32_t level = 0; frames != nullptr && frames->turns != nullptr && level <= frames->depth; ++level) {
    if (level != 0) buffer_.Append(',');
    AppendInteger(buffer_, frames->turns[level]);
  }
  buffer_.Append("]}\n");
  if (buffer_.size() >= kFlushAt) (void)output_.Flush(buffer_);  // the first failed write sticks, Finish reports it
}

Status SourceMapWriter::Finish() { return output_.Flush(buffer_); }

void SideBySideWriter::OnFlatBlock(std::uint64_t, std::string_view text, const FlatOrigin& origin) {
  std::string left;
  const bool counted = origin.frames != nullptr && origin.frames->turns != nullptr;
  const std::uint32_t turn = counted ? origin.frames->turns[origin.frames->depth] : 0;
  if (origin.block.Valid() && (origin.block != shown_ || turn != shown_turn_)) {
    const SourceRange range = module_.RangeOf(module_.blocks[origin.block]);
    std::string_view source = range.file.Valid() ? files_.Line(range.file, range.line) : std::string_view{};
    while (!source.empty() && (source.front() == ' ' || source.front() == '\t')) source.remove_prefix(1);
    std::string_view file = range.file.Valid() ? files_.Name(range.file) : std::string_view{};
    file = file.substr(file.rfind('/') + 1);
    fmt::format_to(std::back_inserter(left), "{}:{:<5} {}", file, range.line, source);
    for (char& c : left) {
      if (c == '\t') c = ' ';
    }
  }
  shown_ = origin.block;
  shown_turn_ = turn;
  std::size_t width = CountUtf8(left);
  buffer_.Append(left);
  if (width > kWidth) {
    // Too long for the column: it gets a line of its own, nothing is cut.
    buffer_.Append('\n');
    width = 0;
  }
  for (; width < kWidth; ++width) buffer_.Append(' ');
  buffer_.Append(" | ");
  buffer_.Append(text);
  buffer_.Append('\n');
  if (buffer_.size() >= kFlushAt) (void)output_.Flush(buffer_);
}

Status SideBySideWriter::Finish() { return output_.Flush(buffer_); }

}  // namespace ncport::backends::iso
