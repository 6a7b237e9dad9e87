// Moves that need a feed where none is in force: on every way, or on some.
#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>

#include "check/feed_flow.h"
#include "check/value_rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ProgramId;

class Feed final : public ValueRule {
 public:
  Feed(const ValueRuleInput& input, ValueFindings& findings, const ir::analysis::FlowSources& sources)
      : ValueRule(input, findings), sources_(sources), ways_(input.module) {}

  void Condition(const Site& site, ir::ExprId condition, const Interval& truth) override {
    ways_.Condition(site.block, condition, truth);
  }
  void CountedLoop(const Site& site, const Interval& start, const Interval& end, const Interval& step) override {
    ways_.CountedLoop(site.block, start, end, step);
  }

  void Finish(diag::Sink& sink) override {
    if (!input_.machine.feed_needed) return;
    FeedFlow client(sources_, ways_);
    ir::analysis::ForwardFlow<FeedFlow> flow(sources_, client);
    flow.Run();
    for (const ProgramId program : input_.module.programs.Ids()) {
      if (input_.module.programs[program].library) continue;
      for (const BlockId id : input_.module.programs[program].blocks) {
        const FeedState* before = flow.Before(id);
        if (before == nullptr) continue;
        FeedState state = *before;
        client.Set(program, id, state);
        const NeededFeed needed = client.NeedOf(program, id, state);
        if (needed.need != FeedNeed::kNothing) Judge(program, id, state, needed, sink);
      }
    }
  }

 private:
  void Judge(ProgramId program, BlockId id, const FeedState& state, const NeededFeed& needed, diag::Sink& sink) const {
    const bool lacks = (state.ways & FeedState::kLacks) != 0;
    const bool idle = (state.ways & FeedState::kIdle) != 0;
    if (!lacks && !(idle && input_.options.all)) return;
    const bool certain = (state.ways & ~FeedState::kLacks) == 0 && needed.certain;
    diag::Diagnostic& finding =
        sink.ReportAs(certain ? diag::Severity::kError : diag::Severity::kWarning, diag::Code::kMissingFeed,
                      input_.module.RangeOf(input_.module.blocks[id], *needed.word));
    if (std::string note = NoteOf(needed); !note.empty()) finding.notes.push_back({{}, std::move(note)});
    if ((state.ways & ~FeedState::kZero) == 0) {
      finding.help = "F0 is no feed: write F above 0";
    } else if ((state.ways & ~FeedState::kChanged) == 0) {
      finding.notes.push_back(
          {{},
           fmt::format("the kind of feed has changed since the last F, which dropped it: feeds are {} here",
                       KindOf(sources_.modal->At(program, id).feed_mode))});
      finding.help = "a change of the kind of feed needs a new F";
    } else if (certain) {
      finding.help = "no block on the way here sets a feed: write F in this block";
    } else {
      finding.help = "on a way here no feed is set: write F in this block, or where every way comes by";
    }
    const bool lead = needed.need == FeedNeed::kLead || needed.need == FeedNeed::kCycleLead;
    finding.control = ControlAlarm(lead ? ir::AlarmClass::kGeometry : ir::AlarmClass::kMissingFeed);
  }

  static std::string_view KindOf(ir::FeedMode mode) {
    switch (mode) {
      case ir::FeedMode::kPerRevolution:
        return "per revolution";
      case ir::FeedMode::kInverseTime:
        return "inverse times";
      default:
        return "per minute";
    }
  }

  [[nodiscard]] std::string NoteOf(const NeededFeed& needed) const {
    switch (needed.need) {
      case FeedNeed::kLead:
      case FeedNeed::kCycleLead:
        return "F is the lead of the thread";
      case FeedNeed::kCycle:
        return "the cycle in force here moves by feed";
      case FeedNeed::kCall:
        return fmt::format("{} moves by feed", NameOf(needed.program));
      case FeedNeed::kModalCall:
        return fmt::format("{} runs behind this block, and moves by feed", NameOf(needed.program));
      default:
        return {};
    }
  }

  [[nodiscard]] std::string_view NameOf(ProgramId program) const {
    return input_.module.View(input_.module.programs[program].name);
  }

  ir::analysis::FlowSources sources_;
  KnownWays ways_;
};

}  // namespace

std::unique_ptr<ValueRule> MakeFeed(const ValueRuleInput& input, ValueFindings& findings,
                                    const ir::analysis::FlowSources& sources) {
  return std::make_unique<Feed>(input, findings, sources);
}

}  // namespace ncport::check
