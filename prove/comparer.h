// The comparison of two programs: pairs their events. What a motion has to agree in stands in compare_motion.cc, what
// is in force when it happens in compare_state.cc.
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prove/compare.h"
#include "prove/walk.h"

namespace ncport::prove {

/// "X", or "axis 9" for one without a letter.
std::string AxisName(std::uint8_t axis);

class Comparer {
 public:
  Comparer(const RecordedTrace& source, const RecordedTrace& target, const CompareOptions& options,
           const ir::WorkOffset& target_start, const ir::WorkOffset& source_start)
      : options_(options),
        source_events_(source.Events()),
        target_events_(target.Events()),
        source_(source_events_, options.maps, true, source_start),
        target_(target_events_, options.maps, false, target_start) {}

  Comparison Run();

 private:
  void Fail(const exec::Event* a, const exec::Event* b, std::string what) {
    if (result_.difference) return;
    Difference difference{std::move(what), {}, {}};
    if (a != nullptr) difference.source_block = a->block;
    if (b != nullptr) difference.target_block = b->block;
    result_.difference = std::move(difference);
  }
  [[nodiscard]] bool Failed() const { return result_.difference.has_value(); }

  void ComparePair(const exec::Event& a, const exec::Event& b);
  void CompareEnds(const exec::Event& a, const exec::Event& b);
  void ComparePositions(const exec::Event& a, const exec::Event& b);
  void CompareMotionDetails(const exec::Event& a, const exec::Event& b);
  void CompareCenters(const exec::Event& a, const exec::Event& b);
  void CompareSpindles(const exec::Event& a, const exec::Event& b, const Spindles& source, const Spindles& target);
  void CompareSpindle(const exec::Event& a, const exec::Event& b, const SpindleNow& sa, const SpindleNow& sb);
  [[nodiscard]] bool SamePoint(const exec::Event& a, const exec::Event& b) const;
  void CompareSpindlesNow(const exec::Event& a, const exec::Event& b);
  void CompareSpindlesAtChange(const exec::Event& a, const exec::Event& b);
  void CompareTool(const exec::Event& a, const exec::Event& b);
  void CompareToolState(const exec::Event& a, const exec::Event& b);
  void CompareCompensation(const exec::Event& a, const exec::Event& b);
  void CompareWorkOffset(const exec::Event& a, const exec::Event& b);
  void ComparePath(const exec::Event& a, const exec::Event& b);
  bool SkipSplitRapid(const exec::Event& a);
  void NoteLonely(const exec::Event& event, std::uint16_t axes, std::array<std::optional<double>, ir::kMaxAxes>& seen,
                  std::uint16_t& moving);
  [[nodiscard]] double Allowed(const exec::Event& a, const exec::Event& b, std::uint8_t axis) const;
  void CompareNumber(const exec::Event& a, const exec::Event& b, double x, double y, std::string_view what);
  void CompareSpeed(const exec::Event& a, const exec::Event& b, double x, double y, std::string_view what);

  const CompareOptions& options_;
  const std::vector<exec::Event>& source_events_;
  const std::vector<exec::Event>& target_events_;
  Walk source_, target_;
  Comparison result_;
  // Axes that only one side programs: allowed while they stand at one value.
  std::array<std::optional<double>, ir::kMaxAxes> lonely_source_, lonely_target_;
  std::uint16_t lonely_source_moving_ = 0, lonely_target_moving_ = 0;
  std::uint16_t common_axes_ = 0;
  std::uint16_t source_inch_ = 0, target_inch_ = 0;  // axes that stand where a block in inches sent them
};

}  // namespace ncport::prove
