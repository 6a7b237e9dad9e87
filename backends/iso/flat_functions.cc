// All but motion: spindle, tools and offsets, M functions, dwell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "backends/iso/flat_numbers.h"
#include "backends/iso/flat_writer.h"
#include "base/number_text.h"
#include "dialects/word_template.h"

namespace ncport::backends::iso {
namespace {

// Bits of open_words_.
constexpr std::uint8_t kSense = 1;
constexpr std::uint8_t kSpeed = 2;

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  return text;
}

}  // namespace

void FlatWriter::WriteWords(std::string_view words) {
  BeginLine();
  Put(words);
  EndLine();
}

void FlatWriter::PutTemplate(std::string_view form, std::span<const dialects::TemplateValue> values) {
  if (out_.size() != line_begin_) out_.Append(' ');
  dialects::AppendTemplate(out_, form, values);
}

// --- what waits for the next event

/// Writes what the event before has left open, unless `next` completes it.
void FlatWriter::FlushPending(const exec::Event* next) {
  const bool offset_follows = next != nullptr && next->kind == exec::EventKind::kOffset;
  const bool limit_follows =
      next != nullptr && next->kind == exec::EventKind::kSpindleLimit && next->block == pending_block_;
  if (tool_pending_ && lathe_ && offset_follows) return;  // LatheOffset writes both
  if (surface_pending_ && limit_follows) return;          // the limit must be in force first
  // An offset of the block of G41 is the one that it takes.
  if (comp_pending_ && offset_follows && next->block == pending_block_) return;
  const FlatOrigin origin =
      std::exchange(origin_, FlatOrigin{pending_block_, next == nullptr ? nullptr : next->frames});
  if (std::exchange(tool_pending_, false)) {
    const ToolMap::Answer answer = tools_.Tool();
    if (Report(answer)) WriteTool(answer);
  }
  if (std::exchange(comp_pending_, false)) CompensationOn();
  if (std::exchange(surface_pending_, false)) {
    BeginLine();
    if (AppendSpeed(target_.spindle.css, lathe_ ? "G96 S{speed}" : "", surface_speed_)) {
      speed_is_rpm_ = false;
      feed_mode_ = ir::FeedMode::kUnknown;  // on some controls G96 brings the feed per revolution with it
      EndLine();
    } else {
      out_.Truncate(line_begin_);
    }
  }
  origin_ = origin;
}

// --- spindle

/// Appends the words for a speed; false after a finding.
bool FlatWriter::AppendSpeed(const dialects::Setting<std::string>& form, std::string_view usual, double speed) {
  const std::string_view words = form.Known() ? std::string_view(*form) : usual;
  if (words.empty()) {
    Refuse(diag::Code::kNotExpressible, "constant surface speed or a speed limit");
    return false;
  }
  if (!(std::fabs(speed) < kMaxIncrements)) {
    Refuse(diag::Code::kOutOfRange, fmt::format("speed {}", speed), "what a word can hold");
    return false;
  }
  const std::int64_t whole = RoundToIncrements(speed, 1);
  if (whole <= 0 && speed != 0) {
    Refuse(diag::Code::kWordTooCoarse, fmt::format("speed {}", speed), "0");
    return false;
  }
  const std::string text = fmt::format("{}", whole);
  const dialects::TemplateValue values[] = {{"speed", text}};
  PutTemplate(words, values);
  return true;
}

/// Writes the word of a spindle sense. Which spindle M3 turns depends on the machine: an open setting is refused, never
/// guessed.
bool FlatWriter::PutSense(const dialects::Setting<std::string>& word) {
  if (word.Known()) {
    Put(*word);
    return true;
  }
  if (diag::Diagnostic* finding = Refuse(diag::Code::kOpenKey, target_.name, word.Key()); finding != nullptr) {
    finding->help = fmt::format("add to a profile file: {} = the word of this machine", word.Key());
  }
  return false;
}

void FlatWriter::Spindle(const exec::Event& event) {
  if (event.spindle != 0) {
    Refuse(diag::Code::kNotExpressible, fmt::format("spindle {}", event.spindle));
    return;
  }
  switch (event.kind) {
    case exec::EventKind::kSpindleSurface:
      surface_pending_ = true;
      pending_block_ = event.block;
      surface_speed_ = inch_ ? event.value / 0.3048 : event.value;
      return;
    case exec::EventKind::kSpindleLimit:
      BeginLine();
      if (AppendSpeed(target_.spindle.limit, "", event.value)) {
        EndLine();
      } else {
        out_.Truncate(line_begin_);
      }
      if (surface_pending_) FlushPending(nullptr);
      return;
    default:
      break;
  }
  const std::uint8_t bit = event.kind == exec::EventKind::kSpindle ? kSense : kSpeed;
  if ((open_words_ & bit) != 0) CloseOpenLine();
  if (open_words_ == 0) BeginLine();
  const std::size_t before = out_.size();
  const std::uint8_t open_before = open_words_;
  if (bit == kSpeed) {
    if (!AppendSpeed(target_.spindle.rpm, lathe_ ? "G97 S{speed}" : "S{speed}", event.value)) {
      out_.Truncate(before);
      open_words_ = open_before;
      return;
    }
    if (lathe_ && !std::exchange(speed_is_rpm_, true)) feed_mode_ = ir::FeedMode::kUnknown;
  } else {
    bool senseless = false;
    switch (event.spindle_state) {
      case ir::SpindleState::kCw:
        senseless = !PutSense(target_.spindle.cw);
        break;
      case ir::SpindleState::kCcw:
        senseless = !PutSense(target_.spindle.ccw);
        break;
      case ir::SpindleState::kStop:
        senseless = !PutSense(target_.spindle.stop);
        break;
      case ir::SpindleState::kPositioned:
      case ir::SpindleState::kUnknown:
        if (open_before == 0) out_.Truncate(line_begin_);
        Refuse(diag::Code::kNotExpressible, "a spindle position");
        return;
    }
    if (senseless) {
      if (open_before == 0) out_.Truncate(line_begin_);
      return;
    }
  }
  open_words_ |= bit;
}

// --- tools and offsets

/// Puts the finding of an answer into the sink. False if there are no words.
bool FlatWriter::Report(const ToolMap::Answer& answer) {
  if (!answer.problem) return true;
  if (!answer.Failed()) {
    if (std::ranges::find(assumed_, answer.source) != assumed_.end()) return true;
    assumed_.push_back(answer.source);
  }
  if (*answer.problem == diag::Code::kUnmappedTool) {
    // The line for the edge that the finding at the tool word shows maps both.
    for (const std::string& tool : unmapped_) {
      if (answer.source.starts_with(tool + " D")) return false;
    }
    unmapped_.push_back(answer.source);
  }
  if (diag::Diagnostic* diagnostic = Refuse(*answer.problem, answer.source, answer.assumed))
    diagnostic->help = answer.help;
  if (!answer.Failed()) {
    record_.assumptions.push_back(
        fmt::format("{} becomes {}: the offset registers with the tool's number", answer.source, answer.assumed));
  }
  return !answer.Failed();
}

/// Words of the target for the report: `T1 H1 D1`, `T0101`.
std::string FlatWriter::WordsOf(const ToolMap::Answer& answer) {
  std::string words = "T" + answer.tool;
  if (answer.length) words += fmt::format(" H{}", *answer.length);
  if (answer.radius) words += fmt::format(" D{}", *answer.radius);
  return words;
}

void FlatWriter::WriteTool(const ToolMap::Answer& answer) {
  FlatRecord::Add(record_.tools, answer.source, WordsOf(answer));
  if (lathe_) {
    if (answer.offset_in_tool) return WriteWords("T" + answer.tool);
    // A tool without an offset: the register 00 is none.
    return WriteWords(fmt::format("T{:0>2}00", answer.tool));
  }
  // The profile's form may hold the word that changes the tool. In the source that is a word of its own, unless T
  // changes at once.
  const dialects::TemplateValue values[] = {{"tool", answer.tool}};
  std::string_view form =
      target_.words.tool.Known() ? std::string_view(*target_.words.tool) : std::string_view("T{tool} M6");
  while (!form.empty()) {
    const std::size_t blank = form.find(' ');
    const std::string_view word = form.substr(0, blank);
    form = blank == std::string_view::npos ? std::string_view{} : form.substr(blank + 1);
    if (word.empty() || (word[0] == 'M' && !change_with_tool_)) continue;
    BeginLine();
    PutTemplate(word, values);
    EndLine();
  }
}

void FlatWriter::ToolCall(const exec::Event& event) {
  tools_.Select(event.number, event.text);
  change_with_tool_ = !event.tool_waits;
  if (change_with_tool_) ToolIsIn();
  if (event.tool_waits && lathe_) return;  // on a turret T is the change: it has to wait
  tool_pending_ = true;
  pending_block_ = event.block;
}

/// What belonged to the tool before is of no use any more.
void FlatWriter::ToolIsIn() {
  tools_.Take();
  radius_register_.reset();
  early_edge_.reset();
}

/// An edge selected before any tool came in belongs to a tool that the run does not know. It matters once something
/// moves with it.
void FlatWriter::RefuseEarlyEdge() {
  const exec::EventKind kind = std::exchange(kind_, exec::EventKind::kOffset);
  const FlatOrigin origin = std::exchange(origin_, FlatOrigin{early_edge_->block, nullptr});
  (void)Report(tools_.Edge(early_edge_->edge));
  early_edge_.reset();
  origin_ = origin;
  kind_ = kind;
}

void FlatWriter::Offset(const exec::Event& event) { lathe_ ? LatheOffset(event) : MillOffset(event); }

void FlatWriter::LatheOffset(const exec::Event& event) {
  const bool with_tool = std::exchange(tool_pending_, false);
  const std::string what = fmt::format("offset {}", event.number);
  if (event.offset == exec::OffsetKind::kEdge) {
    const ToolMap::Answer answer = tools_.Edge(event.number);
    if (Report(answer)) WriteTool(answer);
    return;
  }
  if (!tools_.Known()) {
    if (event.offset == exec::OffsetKind::kNone) return;  // nothing was in force in this program
    Refuse(diag::Code::kOffsetWithoutTool, what);
    return;
  }
  if (event.offset != exec::OffsetKind::kNumber && event.offset != exec::OffsetKind::kNone) {
    Refuse(diag::Code::kNotExpressible, what);
    return;
  }
  const ToolMap::Answer answer = tools_.Tool();
  if (!Report(answer)) return;
  if (answer.offset_in_tool) {
    // A mapped tool word names its own offset; without it only the tool part of the word is known to be right.
    if (with_tool && event.offset == exec::OffsetKind::kNumber) return WriteTool(answer);
    Refuse(diag::Code::kNotExpressible,
           event.offset == exec::OffsetKind::kNone ? "a mapped tool without its offset" : what);
    return;
  }
  const std::int64_t offset = event.offset == exec::OffsetKind::kNone ? 0 : event.number;
  const std::string tool_text = fmt::format("{}", tools_.Number());
  const std::string offset_text = fmt::format("{}", offset);
  const dialects::TemplateValue values[] = {{"tool", tool_text}, {"offset", offset_text}};
  BeginLine();
  const std::size_t start = out_.size();
  PutTemplate(target_.words.tool.Known() ? std::string_view(*target_.words.tool) : "T{tool:02}{offset:02}", values);
  FlatRecord::Add(record_.tools, fmt::format("T{} offset {}", tools_.Number(), offset),
                  Trimmed(out_.View().substr(start)));
  EndLine();
}

void FlatWriter::MillOffset(const exec::Event& event) {
  switch (event.offset) {
    case exec::OffsetKind::kEdge:
      return EdgeOffset(event.number);
    case exec::OffsetKind::kLength:
      if (event.length_minus) {
        Refuse(diag::Code::kNotExpressible, "a length offset that counts downward");
        return;
      }
      return WriteWords(fmt::format("G43 H{}", event.number));
    case exec::OffsetKind::kNone:
      radius_register_.reset();
      early_edge_.reset();
      return WriteWords(target_.words.length_offset_off.Or("G49"));
    case exec::OffsetKind::kRadius:
      break;
    case exec::OffsetKind::kNumber:
      Refuse(diag::Code::kNotExpressible, fmt::format("offset {}", event.number));
      return;
  }
  radius_register_ = event.number;
  if (comp_ != ir::CutterComp::kOff) WriteWords(fmt::format("D{}", event.number));
}

/// All offsets of an edge at once: its length under H, its radius for the next G41 or G42.
void FlatWriter::EdgeOffset(std::uint32_t edge) {
  if (!tools_.Known()) {
    early_edge_ = {origin_.block, edge};
    return;
  }
  const ToolMap::Answer answer = tools_.Edge(edge);
  if (!Report(answer)) return;
  if (!answer.length) {
    Refuse(diag::Code::kUnmappedTool, answer.source);
    return;
  }
  FlatRecord::Add(record_.tools, answer.source, WordsOf(answer));
  WriteWords(fmt::format("G43 H{}", *answer.length));
  const auto before = std::exchange(radius_register_, answer.radius);
  if (comp_ != ir::CutterComp::kOff && before != radius_register_ && radius_register_)
    WriteWords(fmt::format("D{}", *radius_register_));
}

void FlatWriter::Compensation(const exec::Event& event) {
  side_ = event.comp;
  if (event.comp != ir::CutterComp::kOff && !lathe_) {
    comp_pending_ = true;
    pending_block_ = event.block;
    return;
  }
  comp_ = event.comp;
  if (event.comp == ir::CutterComp::kOff) return WriteWords("G40");
  WriteWords(event.comp == ir::CutterComp::kLeft ? "G41" : "G42");  // the register stands in the tool word
}

void FlatWriter::CompensationOn() {
  comp_ = side_;
  const std::string_view side = side_ == ir::CutterComp::kLeft ? "G41" : "G42";
  if (!radius_register_) {
    Refuse(diag::Code::kOffsetWithoutTool, side);
    return;
  }
  WriteWords(fmt::format("{} D{}", side, *radius_register_));
}

/// The source moves in the offset that its control starts with: the flat program says so, whatever its control was left
/// in.
void FlatWriter::WriteStartOffset(const exec::Event& motion) {
  const ir::WorkOffset& start = options_.start_offset;
  if (start.known && start.number != 0) {
    exec::Event event = motion;
    event.number = start.number;
    event.extension = start.extension;
    const exec::EventKind kind = std::exchange(kind_, exec::EventKind::kWorkOffset);
    const FlatOrigin origin = std::exchange(origin_, FlatOrigin{});
    const ir::BlockId comments = std::exchange(comments_of_, ir::BlockId{});
    WorkOffset(event);
    comments_of_ = comments;
    origin_ = origin;
    kind_ = kind;
  }
  work_offset_told_ = true;
}

void FlatWriter::WorkOffset(const exec::Event& event) {
  work_offset_told_ = true;
  const std::string source = event.number == 0      ? std::string("none")
                             : event.extension != 0 ? fmt::format("G{}.1 P{}", event.number, event.extension)
                                                    : fmt::format("G{}", event.number);
  if (options_.config != nullptr) {
    if (const dialects::WordMapping* mapping = options_.config->FindOffset(event.number == 0 ? "G500" : source)) {
      FlatRecord::Add(record_.offsets, source, mapping->target);
      return WriteWords(mapping->target);
    }
  }
  const dialects::WriterWords& words = target_.words;
  if (event.extension == 0 && event.number >= 54 && event.number <= 59) {
    return WriteOffset(source, words.work_offset.Known() ? std::string_view(*words.work_offset) : "G{number}",
                       event.number);
  }
  // An extended offset in the target's own form; the first one is P1 wherever there are any (fanuc-8.4).
  if (event.extension != 0 && words.work_offset_extended.Known() && !words.work_offset_extended->empty())
    return WriteOffset(source, *words.work_offset_extended, event.extension);
  if (diag::Diagnostic* diagnostic = Refuse(diag::Code::kUnmappedOffset, source)) {
    diagnostic->help =
        fmt::format("add to [offsets] in ncport.toml: \"{}\" = \"G54\", with the offset that stands for it here",
                    event.number == 0 ? "G500" : source);
  }
}

void FlatWriter::WriteOffset(std::string_view source, std::string_view form, std::uint32_t number) {
  const std::string digits = fmt::format("{}", number);
  const dialects::TemplateValue values[] = {{"number", digits}};
  BeginLine();
  const std::size_t start = out_.size();
  PutTemplate(form, values);
  FlatRecord::Add(record_.offsets, source, Trimmed(out_.View().substr(start)));
  EndLine();
}

// --- M functions, dwell

void FlatWriter::Aux(const exec::Event& event) {
  if (event.tool_change) {
    ToolIsIn();
    tool_pending_ = lathe_;
    pending_block_ = event.block;
  }
  const bool h = event.text == "H";
  const std::string address =
      event.extension == 0 ? std::string(h ? "H" : "M") : fmt::format("{}{}=", h ? "H" : "M", event.extension);
  const std::string word = fmt::format("{}{}", address, event.number);
  const auto find = [&](const std::vector<dialects::MCodeRule>& rules) -> const dialects::MCodeRule* {
    for (const dialects::MCodeRule& rule : rules) {
      if (rule.source == word) return &rule;
    }
    return nullptr;
  };
  const dialects::MCodeRule* rule = options_.config == nullptr ? nullptr : find(options_.config->mcodes);
  if (rule == nullptr) rule = find(target_.mcodes);
  if (rule != nullptr) {
    if (rule->target != "drop") {
      FlatRecord::Add(record_.functions, word, rule->target);
      return WriteWords(rule->target);
    }
    FlatRecord::Add(record_.functions, word, "");
    CommentLine("", word + " left out");
    return;
  }
  const bool common =
      !h && (event.number == 7 || event.number == 8 || event.number == 9 || (event.number == 6 && !lathe_));
  if (common && event.extension == 0) return WriteWords(word);
  if (diag::Diagnostic* diagnostic = Refuse(diag::Code::kUnmappedCode, word)) {
    diagnostic->help = fmt::format("if the target has it, add to [mcodes] in ncport.toml: {0} = \"{0}\"", word);
  }
}

void FlatWriter::Dwell(const exec::Event& event) {
  const bool turns = event.per_revolution;
  const dialects::Setting<std::string>& form = turns ? target_.words.dwell_revolutions : target_.words.dwell;
  const std::string_view words = form.Known() ? std::string_view(*form)
                                 : turns      ? std::string_view{}
                                              : std::string_view("G4 P{seconds}");
  if (words.empty()) {
    Refuse(diag::Code::kNotExpressible, "a dwell in revolutions");
    return;
  }
  if (!(std::fabs(event.value) * 1000 < kMaxIncrements)) {
    Refuse(diag::Code::kOutOfRange, fmt::format("dwell {}", event.value), "what a word can hold");
    return;
  }
  const std::int64_t thousandths = RoundToIncrements(event.value, 1000);
  if (thousandths == 0 && event.value != 0) {
    Refuse(diag::Code::kWordTooCoarse, fmt::format("dwell {}", event.value), "3");
    return;
  }
  TextBuffer number;
  AppendWord(number, ' ', thousandths, 3);
  const std::string_view text = number.View().substr(1);
  const dialects::TemplateValue values[] = {{turns ? "revolutions" : "seconds", text}};
  BeginLine();
  PutTemplate(words, values);
  EndLine();
}

}  // namespace ncport::backends::iso
