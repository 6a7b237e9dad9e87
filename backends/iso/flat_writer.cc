#include "backends/iso/flat_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "backends/iso/comment_text.h"
#include "backends/iso/flat_numbers.h"
#include "base/number_text.h"
#include "ir/axis_names.h"

namespace ncport::backends::iso {
namespace {

// Bits of marks_.
constexpr std::uint8_t kStart = 1;    // first block of a program
constexpr std::uint8_t kWritten = 2;  // its comments are in the output
constexpr std::uint8_t kRefused = 4;  // has a finding of this writer
constexpr std::uint8_t kListed = 8;   // has a listed loss
constexpr std::uint8_t kFresh = 16;   // comments are written next
constexpr std::uint8_t kRapid = 32;   // is in the list of rapids

/// How many blocks an event looks back for comments: keeps jumps across long programs linear. What lies further comes
/// last.
constexpr std::uint32_t kNotesWalk = 4096;

constexpr std::size_t kFlushAt = std::size_t{1} << 16U;

bool Moves(exec::EventKind kind) { return kind <= exec::EventKind::kProbe; }

bool IsSpindleWord(exec::EventKind kind) {
  return kind == exec::EventKind::kSpindle || kind == exec::EventKind::kSpindleSpeed;
}

}  // namespace

FlatWriter::FlatWriter(const ir::Module& module, const SourceFiles& files, const dialects::Profile& target,
                       FlatOptions options, OutputSink& output, diag::Sink& sink)
    : module_(module),
      files_(files),
      target_(target),
      options_(std::move(options)),
      output_(output),
      sink_(sink),
      tools_(options_.config, target.IsLathe()),
      marks_(module.blocks.Size()) {
  for (const ir::Program& program : module.programs.All()) {
    if (!program.blocks.Empty()) marks_[program.blocks.begin] = kStart;
    // What ncport brings along as text is no part of the source: its comments stay with it.
    for (const ir::BlockId block : program.blocks) {
      if (program.library) marks_[block.value] |= kWritten;
    }
  }
  lathe_ = target.IsLathe();
  inch_ = target.units.Or(dialects::LengthUnit::kMm) == dialects::LengthUnit::kInch;
  decimals_ = static_cast<int>(target.decimals.Or(inch_ ? 4 : 3));
  feed_scale_ = ScaleOf(decimals_);
  circle_tolerance_ = Length(0.01);
  number_step_ = static_cast<std::uint32_t>(target.iso.block_number_step.Or(0));
  const bool diameter = lathe_ && !target.diameter.Is(dialects::DiameterRule::kNo);
  for (std::uint8_t axis = 0; axis < ir::kMaxAxes; ++axis) {
    at_[axis] = kNotWritten;
    scale_[axis] = ScaleOf(decimals_) * (diameter && axis == 0 ? 2 : 1);
  }
  for (const std::string& name : target.axes) {
    if (const auto axis = ir::AxisOf(name)) axes_ = static_cast<std::uint16_t>(axes_ | (1U << *axis));
  }
}

// --- dispatch

bool FlatWriter::OnEvent(const exec::Event& event) {
  if (failed_) return false;
  if (!header_written_) WriteHeader(event);
  if (tool_pending_ || surface_pending_ || comp_pending_) FlushPending(&event);
  if (open_words_ != 0 && (!IsSpindleWord(event.kind) || event.block != origin_.block)) CloseOpenLine();
  origin_ = {event.block, event.frames};
  kind_ = event.kind;
  if (event.block.Valid() && (marks_[event.block.value] & kWritten) == 0) EnterBlock(event.block);
  if (Moves(event.kind)) {
    if (!work_offset_told_) WriteStartOffset(event);
    if (early_edge_) RefuseEarlyEdge();
  }
  Dispatch(event);
  return FlushIfFull();
}

void FlatWriter::Dispatch(const exec::Event& event) {
  using exec::EventKind;
  switch (event.kind) {
    case EventKind::kRapid:
      return Straight(event, ir::Motion::kRapid);
    case EventKind::kLine:
      return Straight(event, ir::Motion::kLinear);
    case EventKind::kArc:
      return Arc(event);
    case EventKind::kThread:
      return Thread(event);
    case EventKind::kTap:
      Refuse(diag::Code::kNotExpressible, "rigid tapping");
      return;
    case EventKind::kRapidMachine:
      Refuse(diag::Code::kNotExpressible, "a move in machine coordinates");
      return;
    case EventKind::kReference:
      Refuse(diag::Code::kNotExpressible, "a move to a reference point");
      return;
    case EventKind::kProbe:
      Refuse(diag::Code::kNotExpressible, "a probing move");
      return;
    case EventKind::kDwell:
      return Dwell(event);
    case EventKind::kSpindle:
    case EventKind::kSpindleSpeed:
    case EventKind::kSpindleSurface:
    case EventKind::kSpindleLimit:
      return Spindle(event);
    case EventKind::kSpindlePosition:
      Refuse(diag::Code::kNotExpressible, "a spindle position");
      return;
    case EventKind::kTool:
      return ToolCall(event);
    case EventKind::kOffset:
      return Offset(event);
    case EventKind::kComp:
      return Compensation(event);
    case EventKind::kWorkOffset:
      return WorkOffset(event);
    case EventKind::kPath:
      if (event.path == ir::PathMode::kUnknown) return;  // the end of an exact stop
      CommentLine("PATH", event.path == ir::PathMode::kExact ? "EXACT" : "CONTINUOUS");
      Refuse(diag::Code::kListedLoss, event.path == ir::PathMode::kExact ? "exact stop" : "continuous path mode");
      return;
    case EventKind::kAux:
      return Aux(event);
    case EventKind::kMessage:
      CommentLine("MSG", event.text);
      // An empty one only clears the display.
      if (!event.text.empty()) Refuse(diag::Code::kListedLoss, "the message");
      return;
    case EventKind::kPrint:
      CommentLine("PRINT", event.text);
      Refuse(diag::Code::kListedLoss, "the printed text");
      return;
    case EventKind::kStop:
    case EventKind::kOptionalStop:
      BeginLine();
      Put(event.kind == EventKind::kStop ? "M0" : "M1");
      return EndLine();
    case EventKind::kAlarm: {
      const std::string what =
          fmt::format("{}{}{}", event.code, event.code.empty() || event.text.empty() ? "" : " ", event.text);
      NoteCalls(sink_.Report(diag::Code::kProgramAlarm, Place(), what));
      return;
    }
    case EventKind::kEnd:
    case EventKind::kSetVariable:
      return;  // Finish writes the end
    case EventKind::kData:
      return;  // refused with the word
  }
}

// --- lines

void FlatWriter::WriteHeader(const exec::Event& first) {
  header_written_ = true;
  for (const std::string& line : options_.heading) CommentLine("", line);
  if (target_.words.header.Known()) {
    for (const std::string& line : *target_.words.header) {
      BeginLine();
      Put(line);
      EndLine();
    }
  }
  // All groups that a flat block relies on, whatever the control was left in (iso card row 5). The plane and the kind
  // of feed are those in force at the first event; a motion that needs others writes them.
  plane_ = first.plane == ir::Plane::kUnknown ? (lathe_ ? ir::Plane::kZX : ir::Plane::kXY) : first.plane;
  feed_mode_ = lathe_ && first.feed_mode == ir::FeedMode::kPerRevolution ? ir::FeedMode::kPerRevolution
                                                                         : ir::FeedMode::kPerMinute;
  BeginLine();
  Put(plane_ == ir::Plane::kXY ? "G17" : plane_ == ir::Plane::kZX ? "G18" : "G19");
  Put(inch_ ? target_.words.inch.Or("G20") : target_.words.mm.Or("G21"));
  Put(target_.words.absolute.Or("G90"));
  Put(feed_mode_ == ir::FeedMode::kPerRevolution ? "G95" : "G94");
  Put("G40");
  EndLine();
}

void FlatWriter::BeginLine() {
  line_begin_ = out_.size();
  if (number_step_ == 0) return;
  out_.Append('N');
  AppendInteger(out_, static_cast<std::int64_t>((line_ + 1) * number_step_));
}

/// A word, or words, behind a blank unless they begin the line.
void FlatWriter::Put(std::string_view word) {
  if (out_.size() != line_begin_) out_.Append(' ');
  out_.Append(word);
}

void FlatWriter::EndLine() {
  open_words_ = 0;
  if (comments_of_.Valid()) AppendOpenComments();
  ++line_;
  if (listener_ != nullptr) listener_->OnFlatBlock(line_, out_.View().substr(line_begin_), origin_);
  out_.Append('\n');
  while (!comments_too_long_.empty()) {
    const ir::CommentId comment = comments_too_long_.back();
    comments_too_long_.pop_back();
    CommentLine("", module_.View(module_.comments[comment].text));
  }
}

void FlatWriter::CloseOpenLine() {
  if (open_words_ != 0) EndLine();
}

bool FlatWriter::FlushIfFull() {
  if (out_.size() < kFlushAt || open_words_ != 0) return true;
  if (output_.Written() + out_.size() > options_.max_bytes) {
    sink_.Report(diag::Code::kOutputLimit, Place(), options_.max_bytes).help = "raise it with --max-output";
    failed_ = true;
    return false;
  }
  failed_ = !Flush().Ok();
  return !failed_;
}

Status FlatWriter::Flush() {
  if (!options_.only_listener) return output_.Flush(out_);
  out_.Clear();
  return {};
}

Status FlatWriter::Finish() {
  if (failed_) return Failure{};
  if (!header_written_) WriteHeader(exec::Event{});
  if (tool_pending_ || surface_pending_ || comp_pending_) FlushPending(nullptr);
  if (early_edge_) RefuseEarlyEdge();
  CloseOpenLine();
  WriteLeftoverComments();
  RefuseWhatRan();
  origin_ = {};
  if (target_.words.footer.Known()) {
    for (const std::string& line : *target_.words.footer) {
      BeginLine();
      Put(line);
      EndLine();
    }
  }
  BeginLine();
  Put(target_.words.end.Or("M30"));
  EndLine();
  return Flush();
}

// --- comments of the source

bool FlatWriter::Executed(ir::BlockId block) const {
  if (options_.coverage == nullptr) return true;
  const auto& blocks = options_.coverage->blocks;
  return block.value < blocks.size() && (blocks[block.value] & 1U) != 0;
}

// The first event of a block: the comments of what ran in front of it without an event of its own (assignments, comment
// lines) become comment lines, its own go to the end of the flat block that follows.
void FlatWriter::EnterBlock(ir::BlockId block) {
  WriteOpenComments();
  WriteNotesBefore(block);
  marks_[block.value] |= kWritten;
  WriteLostWordsOf(block);
  if (!module_.blocks[block].comments.Empty()) comments_of_ = block;
}

void FlatWriter::WriteNotesBefore(ir::BlockId block) {
  std::uint32_t first = block.value;
  const std::uint32_t furthest = first > kNotesWalk ? first - kNotesWalk : 0;
  while (first > furthest && (marks_[first] & kStart) == 0 && (marks_[first - 1] & kWritten) == 0) --first;
  WriteNotes(first, block.value, true);
}

/// Comments of the blocks [first, end) that ran and are not yet written. `below_ran`: the block at `end` ran.
void FlatWriter::WriteNotes(std::uint32_t first, std::uint32_t end, bool below_ran) {
  // A comment line belongs to the block below it. What did not run stays open: it may run in a later turn.
  for (std::uint32_t at = end; at-- > first;) {
    if (!module_.blocks[ir::BlockId{at}].words.Empty()) below_ran = Executed(ir::BlockId{at});
    if (below_ran && (marks_[at] & kWritten) == 0) marks_[at] |= kWritten | kFresh;
  }
  const FlatOrigin origin = origin_;
  for (std::uint32_t at = first; at < end; ++at) {
    if ((marks_[at] & kFresh) == 0) continue;
    marks_[at] = static_cast<std::uint8_t>(marks_[at] & ~kFresh);
    origin_ = {ir::BlockId{at}, nullptr};
    WriteLostWordsOf(origin_.block);
    WriteCommentLinesOf(origin_.block);
  }
  origin_ = origin;
}

void FlatWriter::WriteCommentLinesOf(ir::BlockId block) {
  for (const ir::CommentId comment : module_.blocks[block].comments) {
    CommentLine("", module_.View(module_.comments[comment].text));
  }
}

/// Comments that waited for a flat block of their source block, which did not come.
void FlatWriter::WriteOpenComments() {
  if (!comments_of_.Valid()) return;
  const ir::BlockId block = std::exchange(comments_of_, ir::BlockId{});
  WriteCommentLinesOf(block);
}

/// Words without an event that flat blocks cannot say: they become comments and are listed (contracts section 3; words
/// without any effect on the motion, such as those of acceleration, count with the path mode).
void FlatWriter::WriteLostWordsOf(ir::BlockId id) {
  const ir::Block& block = module_.blocks[id];
  for (const ir::WordId word_id : block.words) {
    const ir::Word& word = module_.words[word_id];
    if (word.op == ir::WordOp::kDataSetting) {
      // Data of the machine (G10): flat blocks have no word for them, and what comes after may stand on them.
      const SourceRange range = module_.RangeOf(block, word);
      NoteCalls(sink_.Report(diag::Code::kNotExpressible, range, "writing data of the machine", target_.name));
      continue;
    }
    const bool inert = word.op == ir::WordOp::kInert && word.phase == ir::Phase::kSetting;  // else part of a dwell
    if (word.op != ir::WordOp::kPreprocessStop && word.op != ir::WordOp::kWorkpiece && !inert) continue;
    const SourceRange range = module_.RangeOf(block, word);
    const std::string_view text = files_.View(range);
    CommentLine("", text);
    record_.losses.push_back({range, std::string(text), line_});
    NoteCalls(sink_.Report(diag::Code::kListedLoss, range, std::string(text), target_.name));
  }
}

void FlatWriter::CommentLine(std::string_view prefix, std::string_view text) {
  BeginLine();
  const std::size_t before = out_.size();
  if (before != line_begin_) out_.Append(' ');
  const std::size_t room = target_.block.max_length.Known() ? static_cast<std::size_t>(*target_.block.max_length) : 0;
  const std::size_t fixed = out_.size() - line_begin_ + prefix.size() + 5;
  std::string_view rest;
  if (room > fixed && text.size() > room - fixed) {
    rest = text.substr(room - fixed);
    text = text.substr(0, room - fixed);
  }
  const std::size_t start = out_.size();
  AppendFlatComment(out_, prefix, text);
  if (out_.size() == start) {
    out_.Truncate(line_begin_);
    return;
  }
  EndLine();
  if (!rest.empty()) CommentLine("", rest);
}

void FlatWriter::AppendOpenComments() {
  const ir::BlockId block = std::exchange(comments_of_, ir::BlockId{});
  for (const ir::CommentId comment : module_.blocks[block].comments) {
    const std::string_view text = module_.View(module_.comments[comment].text);
    const std::size_t length = out_.size() - line_begin_ + text.size() + 4;
    if (target_.block.max_length.Known() && length > static_cast<std::size_t>(*target_.block.max_length)) {
      comments_too_long_.push_back(comment);
      continue;
    }
    const std::size_t before = out_.size();
    out_.Append(' ');
    AppendFlatComment(out_, "", text);
    if (out_.size() == before + 1) out_.Truncate(before);
  }
}

void FlatWriter::WriteLeftoverComments() {
  WriteOpenComments();
  std::size_t left_out = 0;
  SourceRange first_left_out;
  for (const ir::Program& program : module_.programs.All()) {
    if (program.library) continue;
    bool ran = false;
    for (const ir::BlockId block : program.blocks)
      ran = ran || (marks_[block.value] & kWritten) != 0 || (options_.coverage != nullptr && Executed(block));
    if (!ran) continue;
    WriteNotes(program.blocks.begin, program.blocks.begin + program.blocks.count, false);
    for (const ir::BlockId block : program.blocks) {
      if ((marks_[block.value] & kWritten) != 0 || module_.blocks[block].comments.Empty()) continue;
      if (left_out == 0) first_left_out = module_.RangeOf(module_.blocks[block]);
      left_out += module_.blocks[block].comments.count;
    }
  }
  if (left_out != 0) sink_.Report(diag::Code::kCommentsLeftOut, first_left_out, left_out);
}

// --- findings

/// The word of the block that an event of this kind comes from; none: the block as a whole.
bool IsCauseOf(exec::EventKind kind, ir::WordOp op) {
  using exec::EventKind;
  using ir::WordOp;
  switch (kind) {
    case EventKind::kTool:
      return op == WordOp::kTool;
    case EventKind::kOffset:
      return op == WordOp::kEdge || op == WordOp::kToolOffset || op == WordOp::kLengthOffset ||
             op == WordOp::kRadiusOffset;
    case EventKind::kComp:
      return op == WordOp::kCutterComp;
    case EventKind::kWorkOffset:
      return op == WordOp::kWorkOffset;
    case EventKind::kPath:
      return op == WordOp::kPathMode;
    case EventKind::kMessage:
      return op == WordOp::kMessage;
    case EventKind::kPrint:
      return op == WordOp::kPrint;
    case EventKind::kAux:
      return op == WordOp::kAux || op == WordOp::kAuxH || op == WordOp::kComputedM;
    case EventKind::kSpindleSurface:
    case EventKind::kSpindleSpeed:
      return op == WordOp::kSpeed;
    case EventKind::kSpindleLimit:
      return op == WordOp::kSpeedLimit;
    case EventKind::kSpindlePosition:
      return op == WordOp::kSpindlePosition;
    case EventKind::kReference:
      return op == WordOp::kReference;
    case EventKind::kRapidMachine:
      return op == WordOp::kMachineCoords;
    default:
      return false;
  }
}

SourceRange FlatWriter::Place() const {
  if (!origin_.block.Valid()) return {};
  const ir::Block& block = module_.blocks[origin_.block];
  SourceRange whole;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    const SourceRange range = module_.RangeOf(block, word);
    if (IsCauseOf(kind_, word.op)) return range;
    whole = whole.Valid() ? Join(whole, range) : range;
  }
  return whole.Valid() ? whole : module_.RangeOf(block);
}

/// Lists a rapid of several axes, each source block once.
void FlatWriter::ListRapid(std::uint16_t axes) {
  if (origin_.block.Valid()) {
    std::uint8_t& marks = marks_[origin_.block.value];
    if ((marks & kRapid) != 0) return;
    marks |= kRapid;
  }
  record_.rapids.push_back({origin_.block, line_, axes});
}

/// One finding of a code for each source block, however often it runs. Null when there was one.
diag::Diagnostic* FlatWriter::Refuse(diag::Code code, std::string_view what, std::string_view more) {
  const std::uint8_t mark = code == diag::Code::kListedLoss || code == diag::Code::kAssumedOffset ? kListed : kRefused;
  if (origin_.block.Valid()) {
    std::uint8_t& marks = marks_[origin_.block.value];
    if ((marks & mark) != 0) return nullptr;
    marks |= mark;
  }
  if (code == diag::Code::kListedLoss) record_.losses.push_back({Place(), std::string(what), line_});
  const std::string second(more.empty() ? std::string_view(target_.name) : more);
  diag::Diagnostic& diagnostic = sink_.Report(code, Place(), std::string(what), second);
  NoteCalls(diagnostic);
  return &diagnostic;
}

void FlatWriter::NoteCalls(diag::Diagnostic& diagnostic) const {
  if (origin_.frames == nullptr) return;
  for (std::uint32_t level = origin_.frames->depth; level-- > 0;) {
    const ir::BlockId call = origin_.frames->call_blocks[level];
    if (call.Valid()) diagnostic.notes.push_back({module_.RangeOf(module_.blocks[call]), "called from here"});
  }
}

}  // namespace ncport::backends::iso
