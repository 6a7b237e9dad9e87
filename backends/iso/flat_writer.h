// Events to flat blocks (iso card): literal words only, one motion a block, all values absolute and rounded once. What
// flat blocks cannot say is a finding with its place, never a guess; the text is worthless then and must not be used.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/iso/flat_arc.h"
#include "backends/iso/flat_record.h"
#include "backends/iso/tool_map.h"
#include "base/diag/sink.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/config.h"
#include "dialects/profile.h"
#include "dialects/word_template.h"
#include "exec/event.h"
#include "exec/run.h"
#include "ir/length_units.h"
#include "ir/module.h"

namespace ncport::backends::iso {

/// Where a flat block comes from. `frames` is valid during the call only and null for blocks that the writer adds.
struct FlatOrigin {
  ir::BlockId block;
  const exec::CallFrameView* frames = nullptr;
};

/// Hears of each flat block when it is complete: source maps, listings.
class FlatListener {
 public:
  FlatListener() = default;
  FlatListener(const FlatListener&) = delete;
  FlatListener& operator=(const FlatListener&) = delete;
  virtual ~FlatListener() = default;
  /// `line` counts from 1; `text` is without line end.
  virtual void OnFlatBlock(std::uint64_t line, std::string_view text, const FlatOrigin& origin) = 0;
};

struct FlatOptions {
  std::vector<std::string> heading;          // comment lines at the start: source, settings
  const dialects::Config* config = nullptr;  // maps of tools, offsets, M functions
  const exec::Coverage* coverage = nullptr;  // of the same run: which blocks ran. Without it all count as run.
  std::uint64_t max_bytes = std::uint64_t{1} << 30U;
  ir::WorkOffset start_offset;  // in force at the start of the source; unknown or none: nothing is written for it
  bool list_rapids = false;     // those of several axes go to the record
  bool only_listener = false;   // the text goes to the listener alone
};

/// Writes the events of one run to `output`. Call Finish behind the run.
class FlatWriter final : public exec::EventSink {
 public:
  FlatWriter(const ir::Module& module, const SourceFiles& files, const dialects::Profile& target, FlatOptions options,
             OutputSink& output, diag::Sink& sink);

  void SetListener(FlatListener* listener) { listener_ = listener; }
  bool OnEvent(const exec::Event& event) override;
  /// Writes what is left: comments behind the last event, the program end, the footer. Fails if the output could not be
  /// written; refusals are in the sink.
  Status Finish();
  [[nodiscard]] std::uint64_t Lines() const { return line_; }
  [[nodiscard]] const FlatRecord& Record() const { return record_; }

 private:
  // flat_writer.cc: lines, comments, dispatch
  void Dispatch(const exec::Event& event);
  void WriteHeader(const exec::Event& first);
  void BeginLine();
  void Put(std::string_view word);
  void PutTemplate(std::string_view form, std::span<const dialects::TemplateValue> values);
  void EndLine();
  void CloseOpenLine();
  bool FlushIfFull();
  Status Flush();
  void CommentLine(std::string_view prefix, std::string_view text);
  void EnterBlock(ir::BlockId block);
  void WriteNotesBefore(ir::BlockId block);
  void WriteNotes(std::uint32_t first, std::uint32_t end, bool below_ran);
  void WriteCommentLinesOf(ir::BlockId block);
  void WriteOpenComments();
  void AppendOpenComments();
  void WriteLostWordsOf(ir::BlockId id);
  void WriteLeftoverComments();
  [[nodiscard]] bool Executed(ir::BlockId block) const;
  /// Blocks that ran and whose text says more than the events of one run.
  void RefuseWhatRan();
  diag::Diagnostic* Refuse(diag::Code code, std::string_view what, std::string_view more = {});
  [[nodiscard]] SourceRange Place() const;
  void NoteCalls(diag::Diagnostic& diagnostic) const;
  void ListRapid(std::uint16_t axes);

  // flat_motion.cc
  void Straight(const exec::Event& event, ir::Motion motion);
  void Arc(const exec::Event& event);
  void ArcPiece(const exec::Event& event, const ExactArc& arc, const double* end);
  void Thread(const exec::Event& event);
  void AppendModes(const exec::Event& event, bool feed_move);
  void AppendMotion(ir::Motion motion);
  void AppendFeed(const exec::Event& event);
  void AppendAxis(std::uint8_t axis, std::int64_t value);
  void AppendNumber(char letter, std::int64_t increments);
  bool AxesExist(std::uint16_t axes);
  std::int64_t Grid(std::uint8_t axis, double value);
  double Length(double mm) const { return inch_ ? mm / ir::kMmPerInch : mm; }

  // flat_functions.cc: spindle, tool, offsets, M functions, stops
  void Spindle(const exec::Event& event);
  bool AppendSpeed(const dialects::Setting<std::string>& form, std::string_view usual, double speed);
  bool PutSense(const dialects::Setting<std::string>& word);
  void FlushPending(const exec::Event* next);
  void ToolCall(const exec::Event& event);
  void ToolIsIn();
  void RefuseEarlyEdge();
  void Offset(const exec::Event& event);
  void LatheOffset(const exec::Event& event);
  void MillOffset(const exec::Event& event);
  void EdgeOffset(std::uint32_t edge);
  void Compensation(const exec::Event& event);
  void CompensationOn();
  void WorkOffset(const exec::Event& event);
  void WriteOffset(std::string_view source, std::string_view form, std::uint32_t number);
  void WriteStartOffset(const exec::Event& motion);
  void Aux(const exec::Event& event);
  void Dwell(const exec::Event& event);
  bool Report(const ToolMap::Answer& answer);
  [[nodiscard]] static std::string WordsOf(const ToolMap::Answer& answer);
  void WriteTool(const ToolMap::Answer& answer);
  void WriteWords(std::string_view words);

  const ir::Module& module_;
  const SourceFiles& files_;
  const dialects::Profile& target_;
  FlatOptions options_;
  OutputSink& output_;
  diag::Sink& sink_;
  FlatListener* listener_ = nullptr;
  ToolMap tools_;
  FlatRecord record_;

  TextBuffer out_;
  std::size_t line_begin_ = 0;  // in out_
  std::uint64_t line_ = 0;      // lines ended so far
  std::uint32_t number_step_ = 0;
  bool header_written_ = false;
  bool failed_ = false;  // the output cannot take more

  // The block that the present event belongs to, and the kind of the event.
  FlatOrigin origin_;
  exec::EventKind kind_ = exec::EventKind::kEnd;
  std::vector<std::uint8_t> marks_;  // per block: kStart, kWalked, kRefused ...
  ir::BlockId comments_of_;          // comments that wait for the first flat block of this one
  std::vector<ir::CommentId> comments_too_long_;

  // What the flat text has put in force. Values in increments.
  static constexpr std::int64_t kNotWritten = INT64_MIN;
  std::int64_t at_[ir::kMaxAxes];  // last written position
  double scale_[ir::kMaxAxes];     // increments per mm (inch) or degree; twice that for a diameter
  int decimals_ = 3;
  double feed_scale_ = 1000;
  bool inch_ = false;
  bool lathe_ = false;
  std::uint16_t axes_ = 0;  // that the target has
  ir::Motion motion_ = ir::Motion::kUnknown;
  ir::Plane plane_ = ir::Plane::kUnknown;
  ir::FeedMode feed_mode_ = ir::FeedMode::kUnknown;
  std::int64_t feed_ = kNotWritten;
  ir::CutterComp comp_ = ir::CutterComp::kOff;
  double circle_tolerance_ = 0.01;  // mm or inch, as written

  // Words that wait for the next event: a tool call for its offset, surface speed for its limit.
  bool tool_pending_ = false;
  bool change_with_tool_ = false;  // the tool word of the source changes the tool: M6 goes with it
  struct EarlyEdge {
    ir::BlockId block;
    std::uint32_t edge = 0;
  };
  std::optional<EarlyEdge> early_edge_;  // selected before any tool came in
  bool work_offset_told_ = false;        // the text has selected one, or needs none
  bool surface_pending_ = false;
  bool comp_pending_ = false;
  ir::CutterComp side_ = ir::CutterComp::kOff;  // of the pending word
  double surface_speed_ = 0;                    // m/min
  ir::BlockId pending_block_;
  bool speed_is_rpm_ = false;  // lathe: the text says that S is a speed, not a surface speed
  std::optional<std::int64_t> radius_register_;
  std::vector<std::string> assumed_;   // tools with edge whose registers were assumed: one warning each
  std::vector<std::string> unmapped_;  // tools without words: one error each
  // Spindle words of one source block share a flat block.
  std::uint8_t open_words_ = 0;  // bits of the words in the open line; 0 = none open
};

}  // namespace ncport::backends::iso
