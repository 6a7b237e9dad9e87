// How far each tool of a run goes, and how fast. Listens to the events on their way.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/report.h"
#include "dialects/config.h"
#include "exec/event.h"
#include "ir/module.h"

namespace ncport::app {

class Envelopes final : public exec::EventSink {
 public:
  /// `next` gets each event after it was looked at; null: nobody.
  Envelopes(const ir::Module& module, exec::EventSink* next) : module_(module), next_(next) {}

  bool OnEvent(const exec::Event& event) override;
  /// One envelope for each tool, in the order of first use. Limits of axes come from `[limits]`.
  [[nodiscard]] std::vector<ReportEnvelope> Result(const SourceFiles& files, const dialects::Config* config) const;

 private:
  struct Point {
    double position[ir::kMaxAxes] = {};
    std::uint16_t known = 0;
    ir::BlockId block;
  };
  struct Tool {
    std::string name;
    std::uint16_t known = 0;
    double low[ir::kMaxAxes] = {};
    double high[ir::kMaxAxes] = {};
    bool approached = false;
    Point first, last;
    double speed = -1, surface_speed = -1, feed = -1, feed_per_revolution = -1;  // < 0: none
  };

  void Select(const std::string& name);
  void Take(Tool& tool, std::uint8_t axis, double value) const;
  void Move(const exec::Event& event);
  void Bulge(Tool& tool, const exec::Event& event) const;

  const ir::Module& module_;
  exec::EventSink* next_;
  std::vector<Tool> tools_{1};  // the first: before any tool
  std::size_t now_ = 0;
  std::string called_;
  Point at_;
  std::uint8_t transverse_axis_ = 0xFF;
  bool rapid_ = true;  // the last motion was none at feed
};

}  // namespace ncport::app
