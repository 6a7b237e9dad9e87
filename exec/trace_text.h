// Events as the trace text of contracts 5, or as JSON lines.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/text_buffer.h"
#include "exec/event.h"

namespace ncport::exec {

enum class TraceFormat : std::uint8_t { kText, kJson };

/// One event as a line of text, with its line end.
void AppendTraceLine(TextBuffer& buffer, const Event& event, const ir::Module& module);
/// The same event as a JSON object in a line: kind, numbers of the text form, and `file` and `line` of the block.
void AppendTraceJson(TextBuffer& buffer, const Event& event, const ir::Module& module);

/// Writes each event to an output. JSON: an object `{"version": 1, "events": [...]}`, closed by Finish.
class TraceWriter final : public EventSink {
 public:
  TraceWriter(OutputSink& output, const ir::Module& module, TraceFormat format = TraceFormat::kText);

  bool OnEvent(const Event& event) override;
  /// Call once behind the run: writes what is left. Fails when the output could not take it all.
  Status Finish();

 private:
  OutputSink& output_;
  const ir::Module& module_;
  TraceFormat format_;
  TextBuffer buffer_;
  bool first_ = true;
};

}  // namespace ncport::exec
