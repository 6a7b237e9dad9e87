// Calls of cycles whose arguments lead into an alarm on every way: planes that contradict each other, a wrong
// direction. A subprogram of the user that tests its values and alarms does what it is there for: only cycles are
// looked at.
#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "check/value_rules.h"

namespace ncport::check {

using ir::BlockId;
using ir::ProgramId;
using ir::WordOp;
using ir::analysis::CallContext;
using ir::analysis::Edge;
using ir::analysis::EdgeKind;

namespace {

class CallAlarms final : public ValueRule {
 public:
  CallAlarms(const ValueRuleInput& input, ValueFindings& findings, const ir::analysis::FlowGraphs& graphs)
      : ValueRule(input, findings), graphs_(graphs) {}

  void Block(const Site& site, Lookup& lookup) override {
    if (!input_.module.programs[site.context->program].library) return;
    for (const ir::WordId id : input_.module.blocks[site.block].words) {
      const ir::Word& word = input_.module.words[id];
      if (word.op != WordOp::kAlarm || site.context->caller == nullptr) continue;
      const Interval number = word.value.Valid() ? lookup.Evaluate(word.value) : Interval::Unknown();
      if (ir::analysis::StopsAlways(word, number, input_.machine))
        alarms_.emplace_back(site.context, SeenAlarm{id, number.IsPoint() ? number.low : -1});
    }
  }

  void Exit(const Site& site, Lookup&) override {
    left_.insert(site.context);
    if (site.context->caller != nullptr) calls_left_.insert(site.context->call.value);
  }

  void StartDone() override {
    for (const auto& [context, alarm] : alarms_) Blame(*context, alarm);
    alarms_.clear();
    left_.clear();
    calls_left_.clear();
  }

  void Finish(diag::Sink& sink) override {
    for (const auto& [call, blamed] : blamed_) Report(blamed, sink);
  }

 private:
  struct SeenAlarm {
    ir::WordId word;
    double number = -1;  // -1: not one number
  };
  struct Blamed {
    SeenAlarm alarm;
    SourceRange at;
  };

  /// The call that gives what leads here: one of the user's programs, that ends so whoever calls its program.
  void Blame(const CallContext& context, const SeenAlarm& alarm) {
    for (const CallContext* callee = &context; EndsInAlarm(*callee); callee = callee->caller) {
      const bool library = input_.module.programs[callee->caller->program].library;
      if (library || calls_left_.contains(callee->call.value)) continue;
      if (const SourceRange at = PlaceOf(*callee); at.Valid())
        blamed_.try_emplace(callee->call.value, Blamed{alarm, at});
      return;
    }
  }

  /// No run that enters this way comes back, though the program has a way back: it alarms because of what it got.
  [[nodiscard]] bool EndsInAlarm(const CallContext& context) {
    return context.caller != nullptr && !context.open && !left_.contains(&context) && HasWayBack(context.program);
  }

  [[nodiscard]] bool HasWayBack(ProgramId program) {
    const auto [known, fresh] = ways_back_.try_emplace(program.value, false);
    if (!fresh) return known->second;
    const ir::analysis::Cfg& graph = graphs_.Of(program);
    const IdRange<BlockId> blocks = graph.Blocks();
    if (blocks.Empty() || graph.Opaque()) return false;
    std::vector<std::uint8_t> seen(blocks.count, 0);
    std::vector<BlockId> waiting{blocks[0]};
    seen[0] = 1;
    while (!waiting.empty()) {
      const BlockId block = waiting.back();
      waiting.pop_back();
      if (HoldsAlarm(block)) continue;
      for (const Edge& edge : graph.Successors(block)) {
        if (!edge.to.Valid()) {
          if (edge.kind != EdgeKind::kAlarm && edge.kind != EdgeKind::kMissing) return known->second = true;
        } else if (std::uint8_t& visited = seen[edge.to.value - blocks.begin]; visited == 0) {
          visited = 1;
          waiting.push_back(edge.to);
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool HoldsAlarm(BlockId block) const {
    for (const ir::WordId id : input_.module.blocks[block].words) {
      const ir::Word& word = input_.module.words[id];
      if (word.op == WordOp::kAlarm && word.index != static_cast<std::uint8_t>(ir::AlarmKind::kShows)) return true;
    }
    return false;
  }

  /// The word of the call, which for a modal one stands in the block that makes it modal.
  [[nodiscard]] SourceRange PlaceOf(const CallContext& callee) const {
    const ir::Block& block = input_.module.blocks[callee.block];
    for (const ir::WordId id : block.words) {
      const ir::Word& word = input_.module.words[id];
      const bool calls = word.op == WordOp::kCall || word.op == WordOp::kModalCall;
      if (calls && word.Extra<ir::CallId>() == callee.call) return input_.module.RangeOf(block, word);
    }
    return input_.module.RangeOf(block);
  }

  void Report(const Blamed& blamed, diag::Sink& sink) const {
    const ir::Word& word = input_.module.words[blamed.alarm.word];
    // Where the card knows no number of a standard cycle, its text here sets one that only users have.
    constexpr double kFirstOfUsers = 65000;
    const bool made_up = blamed.alarm.number >= kFirstOfUsers;
    const bool known = blamed.alarm.number >= 0 && !made_up;
    const std::string number = made_up ? "of the cycle"
                               : known ? fmt::format("{:.0f}", blamed.alarm.number)
                                       : "the program sets";
    diag::Diagnostic& finding = sink.Report(diag::Code::kCallAlarms, blamed.at, number);
    const ir::ExprId text = word.Extra<ir::ExprId>();
    if (text.Valid() && input_.module.exprs[text].op == ir::ExprOp::kText)
      finding.notes.push_back(
          {{}, std::string(input_.module.View(StringId{std::size_t{input_.module.exprs[text].a}}))});
    if (known && !input_.options.control.empty())
      finding.control = fmt::format("{} {}", input_.options.control, number);
  }

  const ir::analysis::FlowGraphs& graphs_;
  // Of the start that is looked at; contexts end with it.
  std::vector<std::pair<const CallContext*, SeenAlarm>> alarms_;
  std::set<const CallContext*> left_;
  std::set<std::uint32_t> calls_left_;
  std::map<std::uint32_t, bool> ways_back_;  // per program
  std::map<std::uint32_t, Blamed> blamed_;   // per call
};

}  // namespace

std::unique_ptr<ValueRule> MakeCallAlarms(const ValueRuleInput& input, ValueFindings& findings,
                                          const ir::analysis::FlowGraphs& graphs) {
  return std::make_unique<CallAlarms>(input, findings, graphs);
}

}  // namespace ncport::check
