// Loops of the structure that never run or never end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "check/endings.h"
#include "check/expressions.h"
#include "check/loop_drift.h"
#include "check/place_changes.h"
#include "check/places.h"
#include "check/value_rules.h"

namespace ncport::check {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;
using ir::analysis::Edge;
using ir::analysis::EdgeKind;

namespace {

class Loops final : public ValueRule {
 public:
  Loops(const ValueRuleInput& input, ValueFindings& findings, const ir::analysis::FlowGraphs& graphs)
      : ValueRule(input, findings), graphs_(graphs) {}

  void Condition(const Site& site, ExprId, const Interval& truth) override { See(site, truth); }
  void CountedLoop(const Site& site, const Interval& start, const Interval& end, const Interval& step) override {
    Interval runs = ir::analysis::Bool(true, true);
    if (step.low >= 0) runs = ir::analysis::Compared(ExprOp::kLessEqual, start, end, input_.machine.compare_tolerance);
    if (step.high < 0)
      runs = ir::analysis::Compared(ExprOp::kGreaterEqual, start, end, input_.machine.compare_tolerance);
    See(site, runs);
    if (runs.HasNumber() && runs.high == 0 && !ranges_.contains(site.block.value))
      ranges_[site.block.value] = fmt::format("{} to {}", check::TextOf(start), check::TextOf(end));
  }

  void Operation(const Site&, ExprId expr, const Interval* operands, std::size_t count, Lookup&) override {
    sums_.Add(input_.module, expr, operands, count);
  }

  void Finish(diag::Sink& sink) override {
    for (const ir::ProgramId program : input_.module.programs.Ids()) {
      if (input_.module.programs[program].library) continue;
      for (const BlockId block : input_.module.programs[program].blocks) Look(program, block, sink);
    }
  }

 private:
  void See(const Site& site, const Interval& truth) {
    Interval& known = truths_.try_emplace(site.block.value, Interval::None()).first->second;
    known = ir::analysis::Join(known, truth);
  }

  [[nodiscard]] std::optional<WordOp> MarkOf(const ir::Block& block) const {
    for (const ir::WordId id : block.words) {
      const WordOp op = input_.module.words[id].op;
      if (ir::IsStructureMark(op)) return op;
    }
    return std::nullopt;
  }

  void Look(ir::ProgramId program, BlockId id, diag::Sink& sink) {
    const ir::Block& block = input_.module.blocks[id];
    if (!block.link.Valid() || (block.flags & ir::Block::kRefused) != 0) return;
    const std::optional<WordOp> mark = MarkOf(block);
    if (!mark) return;
    const ir::analysis::Cfg& graph = graphs_.Of(program);
    if (!graph.Reachable(id)) return;
    const auto truth = truths_.find(id.value);
    const bool seen = truth != truths_.end() && truth->second.HasNumber();
    const SourceRange at = input_.module.RangeOf(block, input_.module.words[block.words[0]]);
    if ((*mark == WordOp::kWhile || *mark == WordOp::kFor) && seen && truth->second.high == 0) {
      diag::Diagnostic& finding = sink.Report(diag::Code::kLoopNeverRuns, at);
      const auto range = ranges_.find(id.value);
      if (range != ranges_.end()) finding.notes.push_back({{}, fmt::format("it would count from {}", range->second)});
      return;
    }
    if (graph.Opaque()) return;
    if (*mark == WordOp::kWhile || *mark == WordOp::kLoop || *mark == WordOp::kUntil) {
      // Each look goes over the body: loops nested without end would take the square of their number.
      looked_ += id.value > block.link.value ? id.value - block.link.value : block.link.value - id.value;
      if (looked_ > kMostLooked) return;
    }
    switch (*mark) {
      case WordOp::kWhile:
        return Test({program, id, block.link, id, seen ? truth->second : Interval::None(), true}, at, sink);
      case WordOp::kLoop:
        if (!LeavesElsewhere(graph, id, block.link) && !StopsInside(input_.module, id, block.link))
          Endless(at, id, false, sink, {});
        return;
      case WordOp::kUntil:
        return Test({program, block.link, id, id, seen ? truth->second : Interval::None(), false}, at, sink);
      default:
        return;
    }
  }

  /// A loop with a condition in its first or last block.
  struct Tested {
    ir::ProgramId program;
    BlockId first, last, test;
    Interval truth;  // of the condition; none: no run comes there
    bool goes_on;    // the truth with which the loop goes on
  };

  void Test(const Tested& loop, const SourceRange& at, diag::Sink& sink) {
    const ir::Block& block = input_.module.blocks[loop.test];
    const bool seen = loop.truth.HasNumber();
    if (LeavesElsewhere(graphs_.Of(loop.program), loop.first, loop.last)) return;
    const bool always = seen && loop.truth.IsPoint() && (loop.truth.low == 1) == loop.goes_on;
    if (always && IsConstant(block)) {
      if (!StopsInside(input_.module, loop.first, loop.last)) Endless(at, loop.test, false, sink, {});
      return;
    }
    if (Frozen(loop.program, loop.first, loop.last, loop.test)) return Endless(at, loop.test, true, sink, {});
    const ir::Word& word = input_.module.words[block.words[0]];
    const bool may_go_on = seen && (loop.goes_on ? loop.truth.high == 1 : loop.truth.low == 0);
    if (may_go_on && word.value.Valid()) {
      LoopDrift drift(input_.module, changes_, sums_, {loop.program, loop.first, loop.last});
      if (drift.Of(word.value, loop.goes_on) == Course::kDrifts) {
        drift.Explain(sink.Report(diag::Code::kEndlessLoop, at), loop.goes_on);
        return;
      }
    }
    if (always && !MayEndInside(input_.module, loop.first, loop.last)) {
      sink.Report(diag::Code::kEndlessLoop, at)
          .notes.push_back({{}, fmt::format("the condition is {} in each pass", loop.goes_on ? "true" : "false")});
      return;
    }
    const std::string missed =
        Missed(loop.program, loop.first, loop.last, loop.test, loop.goes_on ? ExprOp::kNotEqual : ExprOp::kEqual);
    if (!missed.empty()) Endless(at, loop.test, false, sink, missed);
  }

  /// A condition that reads nothing. Values that a division or a root let through keep others true as well, but such a
  /// loop ends in an alarm.
  [[nodiscard]] bool IsConstant(const ir::Block& block) const {
    const ExprId condition = input_.module.words[block.words[0]].value;
    return condition.Valid() && !ReadsAnything(condition);
  }

  [[nodiscard]] bool ReadsAnything(ExprId id) const {
    const Expr& expr = input_.module.exprs[id];
    if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kElement || expr.op == ExprOp::kCell ||
        expr.op == ExprOp::kCellAt || expr.op == ExprOp::kSystem || expr.op == ExprOp::kName)
      return true;
    bool reads = false;
    ForOperands(expr, [&](ExprId operand) { reads = reads || ReadsAnything(operand); });
    return reads;
  }

  void Endless(const SourceRange& at, BlockId id, bool frozen, diag::Sink& sink, const std::string& missed) {
    diag::Diagnostic& finding = sink.Report(diag::Code::kEndlessLoop, at);
    if (!missed.empty()) {
      finding.notes.push_back({{}, missed});
      finding.help = "compare with <= or >= (in WHILE > or <), so that it ends behind that value too";
    }
    if (!frozen) return;
    const ir::Word& word = input_.module.words[input_.module.blocks[id].words[0]];
    std::set<std::string> names;
    Site site;
    site.block = id;
    CollectNames(site, word.value, names);
    std::string list;
    for (const std::string& name : names) list += list.empty() ? name : ", " + name;
    finding.notes.push_back({{}, fmt::format("nothing in it changes {}", list)});
  }

  void CollectNames(const Site& site, ExprId id, std::set<std::string>& names) const {
    const Expr& expr = input_.module.exprs[id];
    if (expr.op == ExprOp::kVariable || expr.op == ExprOp::kCell) names.insert(TextOf(site, id));
    ForOperands(expr, [&](ExprId operand) { CollectNames(site, operand, names); });
  }

  template <class Visit>
  void ForOperands(const Expr& expr, Visit visit) const {
    switch (ir::OperandsOf(expr.op)) {
      case ir::Operands::kLeaf:
        return;
      case ir::Operands::kUnary:
        return visit(ExprId{std::size_t{expr.a}});
      case ir::Operands::kBinary:
        visit(ExprId{std::size_t{expr.a}});
        return visit(ExprId{std::size_t{expr.b}});
      case ir::Operands::kList:
        for (std::uint32_t i = 0; i < expr.count; ++i) visit(input_.module.Item(expr.b + i));
        return;
    }
  }

  /// A way out of the blocks from `first` to `last` other than their own test.
  [[nodiscard]] bool LeavesElsewhere(const ir::analysis::Cfg& graph, BlockId first, BlockId last) const {
    for (std::uint32_t i = first.value; i <= last.value; ++i) {
      const BlockId block{std::size_t{i}};
      const bool own_test = block == first || block == last;
      for (const Edge& edge : graph.Successors(block)) {
        if (!edge.to.Valid()) {
          // The text may end behind the loop.
          if (edge.kind != EdgeKind::kTextEnd && edge.kind != EdgeKind::kMissing) return true;
          continue;
        }
        const bool inside = edge.to.value >= first.value && edge.to.value <= last.value;
        const bool test = own_test && (edge.kind == EdgeKind::kFalse || edge.kind == EdgeKind::kNext);
        if (!inside && !test) return true;
      }
      // Something that was not understood may leave.
      if ((input_.module.blocks[block].flags & ir::Block::kRefused) != 0) return true;
    }
    return false;
  }

  /// Nothing in the blocks can change the truth of the condition of `test`.
  [[nodiscard]] bool Frozen(ir::ProgramId program, BlockId first, BlockId last, BlockId test) const {
    const ir::Word& word = input_.module.words[input_.module.blocks[test].words[0]];
    if (!word.value.Valid()) return false;
    const PlacesRead read = changes_.ReadsOf(program, word.value);
    return read.known && !read.places.empty() && !changes_.AnyChanges(first, last, read);
  }

  /// The literal, also with a sign or in brackets.
  [[nodiscard]] std::optional<double> Literal(ExprId id) const {
    const Expr& expr = input_.module.exprs[id];
    switch (expr.op) {
      case ExprOp::kLiteral:
        return expr.number;
      case ExprOp::kNegate: {
        const std::optional<double> value = Literal(ExprId{std::size_t{expr.a}});
        return value ? std::optional(-*value) : std::nullopt;
      }
      case ExprOp::kPlus:
      case ExprOp::kGroup:
      case ExprOp::kConvert:
        return Literal(ExprId{std::size_t{expr.a}});
      default:
        return std::nullopt;
    }
  }

  [[nodiscard]] bool SamePlace(const Expr& a, const Expr& b) const {
    if (a.op != b.op || a.a != b.a) return false;
    return a.op == ExprOp::kVariable || (a.op == ExprOp::kCell && a.b == b.b);
  }

  /// `place = place + step`, also with minus, in the loop of these blocks.
  [[nodiscard]] std::optional<double> StepOf(const ir::Word& word, const Expr& place, ir::ProgramId program,
                                             BlockId first_block, BlockId last_block) const {
    const Expr& sum = input_.module.exprs[Bare(word.value)];
    if (sum.op != ExprOp::kAdd && sum.op != ExprOp::kSubtract) return std::nullopt;
    const ExprId left{std::size_t{sum.a}};
    const ExprId right{std::size_t{sum.b}};
    const bool first = SamePlace(input_.module.exprs[Bare(left)], place);
    if (!first && (sum.op == ExprOp::kSubtract || !SamePlace(input_.module.exprs[Bare(right)], place)))
      return std::nullopt;
    const ExprId operand = Bare(first ? right : left);
    std::optional<double> step = Literal(first ? right : left);
    const Expr& bare = input_.module.exprs[operand];
    if (!step && (bare.op == ExprOp::kVariable || bare.op == ExprOp::kCell) &&
        changes_.Unchanged(program, operand, first_block, last_block))
      step = SetBefore(bare, first_block);
    return step && sum.op == ExprOp::kSubtract ? std::optional(-*step) : step;
  }

  /// The literal that the blocks right before `block` give the place; nothing where a way may come in between.
  [[nodiscard]] std::optional<double> SetBefore(const Expr& place, BlockId block) const {
    constexpr std::uint32_t kMostBlocks = 100;
    for (std::uint32_t i = block.value, looked = 0; i > 0 && looked < kMostBlocks; --i, ++looked) {
      const ir::Block& before = input_.module.blocks[BlockId{std::size_t{i - 1}}];
      if ((before.flags & ir::Block::kRefused) != 0 || before.skip_level != ir::Block::kNoSkip) return std::nullopt;
      for (std::uint32_t w = before.words.count; w > 0; --w) {
        const ir::Word& word = input_.module.words[before.words[w - 1]];
        if (word.op == WordOp::kAssign && SamePlace(input_.module.exprs[word.Extra<ExprId>()], place))
          return Literal(word.value);
        if (word.op == WordOp::kDefine && place.op == ExprOp::kVariable && word.extra == place.a) {
          const ExprId initial = input_.module.variables[ir::VariableId{std::size_t{place.a}}].initial;
          return initial.Valid() ? Literal(initial) : std::nullopt;
        }
        if (word.phase == ir::Phase::kFlow || word.phase == ir::Phase::kLast || word.op == WordOp::kWhen ||
            word.op == WordOp::kSkipRest || word.op == WordOp::kAssignList || word.op == WordOp::kVerbatim)
          return std::nullopt;
        // Behind a move a modal call may run, which writes what all see.
        if (changes_.HasModalCalls() && word.phase == ir::Phase::kMotion) return std::nullopt;
      }
      // A jump may come to here.
      if (before.label.Valid() || before.number != ir::Block::kNoNumber) {
        if (!StraightTo(BlockId{std::size_t{i - 1}})) return std::nullopt;
      }
    }
    return std::nullopt;
  }

  /// No jump, call or computed target comes to the block: only the one before it does.
  [[nodiscard]] bool StraightTo(BlockId block) const {
    for (const ir::ProgramId program : input_.module.programs.Ids()) {
      const auto& blocks = input_.module.programs[program].blocks;
      if (block.value < blocks.begin || block.value >= blocks.begin + blocks.count) continue;
      const ir::analysis::Cfg& graph = graphs_.Of(program);
      const auto ways = graph.Predecessors(block);
      const bool computed =
          std::ranges::any_of(graph.ComputedTargets(), [&](BlockId target) { return target == block; });
      return !graph.Opaque() && !computed && ways.size() == 1 && ways[0].value + 1 == block.value;
    }
    return false;
  }

  /// A loop that ends by one value alone, whose counter starts at a number that stands in the text and goes in steps of
  /// one size past that value: the note that says so; else empty. Sums of halves, quarters and so on are exact.
  [[nodiscard]] std::string Missed(ir::ProgramId program, BlockId first, BlockId last, BlockId test,
                                   ExprOp ends_by) const {
    const ir::Word& condition = input_.module.words[input_.module.blocks[test].words[0]];
    if (!condition.value.Valid()) return {};
    const Expr& compared = input_.module.exprs[Bare(condition.value)];
    if (compared.op != ends_by) return {};
    ExprId counter = Bare(ExprId{std::size_t{compared.a}});
    std::optional<double> end = Literal(ExprId{std::size_t{compared.b}});
    if (!end) {
      counter = Bare(ExprId{std::size_t{compared.b}});
      end = Literal(ExprId{std::size_t{compared.a}});
    }
    const Expr& place = input_.module.exprs[counter];
    if (!end || (place.op != ExprOp::kVariable && place.op != ExprOp::kCell)) return {};
    const PlacesRead read = changes_.ReadsOf(program, counter);
    if (!read.known || read.places.empty()) return {};
    std::optional<double> step;
    for (std::uint32_t i = first.value; i <= last.value; ++i) {
      for (const ir::WordId id : input_.module.blocks[BlockId{std::size_t{i}}].words) {
        const ir::Word& word = input_.module.words[id];
        if (!changes_.Changes(word, read)) continue;
        if (word.op != WordOp::kAssign || !SamePlace(input_.module.exprs[word.Extra<ExprId>()], place)) return {};
        const std::optional<double> this_step = StepOf(word, place, program, first, last);
        if (!this_step || (step && *step != *this_step)) return {};
        step = this_step;
      }
    }
    const std::optional<double> start = SetBefore(place, first);
    if (!step || !start || !StraightInto(first, last)) return {};
    constexpr double kPart = 1024;
    constexpr double kMost = 1e9;
    for (const double number : {*start, *step, *end}) {
      if (std::fabs(number) > kMost || number * kPart != std::trunc(number * kPart)) return {};
    }
    if (*step == 0) return {};
    if (place.op == ExprOp::kVariable) {
      // An INT rounds each sum.
      const ir::Type type = input_.module.variables[ir::VariableId{std::size_t{place.a}}].type;
      const bool whole = *start == std::trunc(*start) && *step == std::trunc(*step);
      if (type != ir::Type::kReal && (type != ir::Type::kInt || !whole)) return {};
    }
    const double steps = (*end - *start) / *step;
    if (steps >= 0 && steps == std::trunc(steps)) return {};
    return fmt::format("it counts {:.10g}, {:.10g}, {:.10g} and so on, never exactly {:.10g}", *start, *start + *step,
                       *start + 2 * *step, *end);
  }

  /// The first block of the loop is come to from the block before it and from inside of the loop only.
  [[nodiscard]] bool StraightInto(BlockId first, BlockId last) const {
    for (const ir::ProgramId program : input_.module.programs.Ids()) {
      const auto& blocks = input_.module.programs[program].blocks;
      if (first.value < blocks.begin || first.value >= blocks.begin + blocks.count) continue;
      const ir::analysis::Cfg& graph = graphs_.Of(program);
      for (std::uint32_t i = first.value; i <= last.value; ++i) {
        for (const BlockId from : graph.Predecessors(BlockId{std::size_t{i}})) {
          const bool inside = from.value >= first.value && from.value <= last.value;
          if (!inside && (i != first.value || from.value + 1 != first.value)) return false;
        }
      }
      return std::ranges::none_of(graph.ComputedTargets(), [&](BlockId target) {
        return target.value >= first.value && target.value <= last.value;
      });
    }
    return false;
  }

  const ir::analysis::FlowGraphs& graphs_;
  static constexpr std::uint64_t kMostLooked = 20'000'000;  // blocks of bodies, all loops of the module together
  std::uint64_t looked_ = 0;
  std::map<std::uint32_t, Interval> truths_;
  std::map<std::uint32_t, std::string> ranges_;
  PlaceChanges changes_{input_.module};
  SumOperands sums_;
};

}  // namespace

std::unique_ptr<ValueRule> MakeLoops(const ValueRuleInput& input, ValueFindings& findings,
                                     const ir::analysis::FlowGraphs& graphs) {
  return std::make_unique<Loops>(input, findings, graphs);
}

}  // namespace ncport::check
