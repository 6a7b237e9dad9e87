// The events of one run, kept for comparison.
#pragma once

#include <cstddef>
#include <vector>

#include "base/string_pool.h"
#include "exec/event.h"

namespace ncport::prove {

/// Collects events; an arc with additional turns counts as its turns, one circle each, and the rest. Texts are copied,
/// so that they outlive the run. Clear() keeps the memory for the next run.
class RecordedTrace final : public exec::EventSink {
 public:
  /// `max_events`: a run with more is stopped.
  explicit RecordedTrace(std::size_t max_events = 4'000'000) : max_events_(max_events) {}

  bool OnEvent(const exec::Event& event) override;
  void Clear();

  [[nodiscard]] const std::vector<exec::Event>& Events() const { return events_; }
  [[nodiscard]] bool Full() const { return full_; }

 private:
  bool Keep(const exec::Event& event);

  std::size_t max_events_;
  bool full_ = false;
  std::vector<exec::Event> events_;
  StringPool texts_;
};

/// True for events that move an axis.
bool IsMotion(exec::EventKind kind);
/// True for events that cut: the spindle state in force there is compared.
bool IsCutting(exec::EventKind kind);

}  // namespace ncport::prove
