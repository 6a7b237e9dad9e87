// Blocks, labels, numbers, comments.
#include <fmt/format.h>

#include "dialects/fanuc/words.h"
#include "dialects/sinumerik/words.h"
#include "tests/random/maker.h"

namespace ncport::tests::random {

namespace {
constexpr std::string_view kComments[] = {"ROUGHING",   "finish cut",   "Tasche 1", "x=10 y=20", "depth 5.5",
                                          "CHECK TOOL", "M30 is below", "a",        "-----"};
}  // namespace

std::string Maker::CommentText() { return std::string(random_.Pick(kComments)); }

ir::BlockBuilder Maker::NewBlock() {
  before_block_ = known_;
  labelled_ = false;
  ir::BlockBuilder block = program_->Block();
  if (waiting_number_ != 0) {
    block.Number(waiting_number_);
    labelled_ = true;
    waiting_number_ = 0;
  } else if (Draw(Feature::kBlockNumber)) {
    block.Number(next_number_);
    next_number_ += 10;
  }
  if (!waiting_label_.empty()) {
    block.Label(waiting_label_);
    labelled_ = true;
    waiting_label_.clear();
  }
  return block;
}

// A label that waits for a block gets one of its own.
void Maker::FlushLabel() {
  if (waiting_label_.empty() && waiting_number_ == 0) return;
  ir::BlockBuilder block = NewBlock();
  Emit(block);
}

// Structure marks stand alone and carry no label.
ir::BlockBuilder Maker::NewMark() {
  FlushLabel();
  return NewBlock();
}

void Maker::Emit(ir::BlockBuilder& block, bool may_skip) {
  if (Draw(Feature::kComment)) block.Comment(CommentText());
  // A thread with a changing lead left in force would take the next F for its change.
  const ir::Motion motion = before_block_.modes.motion;
  const bool changes_lead = motion == ir::Motion::kThreadIncreasing || motion == ir::Motion::kThreadDecreasing;
  if (may_skip && !labelled_ && !changes_lead && Draw(Feature::kSkipLevel)) {
    block.Skip(static_cast<std::uint8_t>(random_.Below(3) + (IsSinumerik() ? 0 : 1)));
    known_.Join(before_block_);
    if (known_.placed != 0 && !Has(Feature::kBlindStep)) known_.placed = 0;
  }
  block.Finish();
  cost_ += times_;
}

// A word of a code table: phase and flags are those of the language.
void Maker::Code(ir::BlockBuilder& block, ir::WordOp op, std::uint8_t index, std::uint32_t extra) {
  block.Add(op, {}, index, extra);
  const dialects::CodeTable& codes = IsSinumerik()
                                         ? dialects::sinumerik::Codes()
                                         : dialects::fanuc::Codes(*dialects::fanuc::SystemOf(*options_.profile));
  const dialects::CodeRow* const row = codes.FindMeaning(op, index, extra);
  if (row == nullptr) {
    // M3 M4 M5 of this language stand in the profile; M5 acts behind the move of its block (fanuc-8.11).
    if (op == ir::WordOp::kSpindle && extra == static_cast<std::uint32_t>(ir::SpindleState::kStop))
      block.Last().phase = ir::Phase::kAfter;
    return;
  }
  block.Last().phase = row->phase;
  block.Last().flags |= row->flags;
}

void Maker::Word(ir::BlockBuilder& block, ir::WordOp op, ir::ExprId value, std::uint8_t index, std::uint32_t extra) {
  block.Add(op, value, index, extra);
  const dialects::sinumerik::AddressRow* const row =
      IsSinumerik() ? dialects::sinumerik::FindAddress(op, index) : nullptr;
  if (row != nullptr) block.Last().phase = row->phase;
}

std::string Maker::NewLabel() { return fmt::format("LAB{}", next_label_++); }

Maker::Pending Maker::NewTarget(bool forward_only) {
  Pending target;
  if (!IsSinumerik() || random_.Percent(25)) {
    target.number = next_number_;
    next_number_ += 10;
  } else if (forward_only && next_label_ > 1 && Draw(Feature::kReusedLabel)) {
    // A name that is used above: a jump forward finds the nearest below. It must not be awaited or jumped back to.
    target.label = fmt::format("DOWN{}", random_.Below(2));
    for (const Frame& frame : frames_) {
      for (const Pending& other : frame.pending) {
        if (other.label == target.label) target.label = NewLabel();
      }
    }
  } else {
    target.label = NewLabel();
  }
  return target;
}

void Maker::PlaceLabel(const Pending& pending) {
  FlushLabel();
  known_.Join(pending.known);
  waiting_label_ = pending.label;
  waiting_number_ = pending.number;
}

}  // namespace ncport::tests::random
