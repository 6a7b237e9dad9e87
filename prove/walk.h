// One program as the comparison walks through it: what is selected and in force there, and which of its events take
// part in the comparison.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prove/compare.h"

namespace ncport::prove {

/// Speed words in force on one side.
struct SpindleNow {
  ir::SpindleState sense = ir::SpindleState::kUnknown;
  bool surface = false;
  double speed = -1;  // < 0: not programmed
  double limit = -1;
  bool operator==(const SpindleNow&) const = default;
};
using Spindles = std::array<SpindleNow, exec::kSpindles>;

/// What was selected on one side so far; each change is an event, a repetition is none.
struct Selected {
  // Tool of the last tool word, and the one that is in.
  std::uint32_t called = 0;
  std::string_view called_name;
  bool called_known = false;
  bool tool_known = false;
  std::uint32_t tool = 0;
  std::string_view tool_name;
  std::uint32_t loaded = 0;  // the tool that the last change word brought in; 0 = none yet
  bool offset_known = false;
  exec::OffsetKind offset_kind = exec::OffsetKind::kNone;
  std::uint32_t offset = 0;
  std::uint32_t length = 0, radius = 0;  // registers by kind
  bool length_minus = false;             // the length is taken off
  bool wcs_known = false;
  std::uint32_t wcs = 0, wcs_extension = 0;
  ir::CutterComp comp = ir::CutterComp::kUnknown;
  ir::PathMode path = ir::PathMode::kUnknown;
  ir::PathMode path_before = ir::PathMode::kUnknown;  // the exact stop of one block

  void TakeTool() {
    tool_known = called_known;
    tool = called;
    tool_name = called_name;
  }
};

/// One side as it is walked through.
class Walk {
 public:
  Walk(const std::vector<exec::Event>& events, const Maps& maps, bool source, const ir::WorkOffset& start)
      : events_(events), maps_(maps), source_(source) {
    now_.wcs_known = start.known;
    now_.wcs = start.number;
    now_.wcs_extension = start.extension;
    for (const exec::Event& event : events_) {
      motions_left_ += IsMotion(event.kind) && !event.added ? 1U : 0U;
      if (IsMotion(event.kind) || event.kind == exec::EventKind::kTool) last_ = &event;
    }
  }

  /// Next event that takes part in the comparison, after all states before it were taken in; none at the end.
  const exec::Event* Next();
  void Advance() { ++index_; }

  [[nodiscard]] const Spindles& SpindlesNow() const { return spindles_; }
  [[nodiscard]] const Spindles& SpindlesWithoutAdded() const { return own_spindles_; }
  /// The same, as it was where the block of the last spindle word began: words of one block act at once.
  [[nodiscard]] const Spindles& SpindlesBefore(ir::BlockId block) const {
    return spindle_block_ == block ? before_block_ : own_spindles_;
  }
  [[nodiscard]] const Selected& Now() const { return now_; }
  [[nodiscard]] const Selected& WithoutAdded() const { return own_; }
  /// The path mode that an added block names before the program selects one; unknown: there is none.
  [[nodiscard]] ir::PathMode StartPath() const { return start_path_.value_or(ir::PathMode::kUnknown); }
  [[nodiscard]] std::uint16_t Dirty() const { return dirty_; }
  [[nodiscard]] const std::optional<std::string>& Complaint() const { return complaint_; }
  void MotionDone(const exec::Event& event) {
    --motions_left_;
    ++motions_done_;
    tool_since_motion_ = false;
    dirty_ = static_cast<std::uint16_t>(dirty_ & ~event.moved_axes);
  }
  [[nodiscard]] std::size_t MotionsDone() const { return motions_done_; }

 private:
  static void TakeSpindle(const exec::Event& event, Spindles& spindles);
  bool TakeState(const exec::Event& event);
  void TakeAdded(const exec::Event& event);
  [[nodiscard]] bool ToolAhead() const;
  [[nodiscard]] bool IsStepOfNothing(std::size_t index) const;

  const std::vector<exec::Event>& events_;
  const Maps& maps_;
  bool source_;
  std::size_t index_ = 0;
  std::size_t motions_left_ = 0, motions_done_ = 0;
  bool tool_since_motion_ = false;
  const exec::Event* last_ = nullptr;
  Spindles spindles_, own_spindles_, before_block_;
  ir::BlockId spindle_block_;  // of the last spindle word of the program itself
  Selected now_, own_;
  std::optional<ir::PathMode> start_path_;
  std::uint16_t dirty_ = 0;  // axes that added blocks moved and the program has not named since
  std::optional<std::string> complaint_;
};

}  // namespace ncport::prove
