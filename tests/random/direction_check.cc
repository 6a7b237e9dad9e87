// What check says against what runs do. Values of the program are changed, so that it divides by zero, leaves domains,
// ranges and arrays: a run that ends in such an alarm must have been announced at its block, and what check is sure of
// must happen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "base/text_buffer.h"
#include "check/value_rules.h"
#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/analysis/modal_state.h"
#include "ir/block_words.h"
#include "ir/dump.h"
#include "tests/random/direction_checks.h"
#include "tests/random/random_source.h"
#include "tests/random/runs.h"

namespace ncport::tests::random {

namespace {

/// Every block gets a line of its own, so that findings tell their block.
void NumberBlocks(ir::Module& module) {
  module.origins = {};
  for (ir::Block& block : module.blocks.All()) {
    ir::Origin origin;
    origin.file = FileId{std::size_t{0}};
    origin.line = static_cast<std::uint32_t>(&block - module.blocks.All().data()) + 1;
    block.origin = module.origins.Add(origin);
  }
}

/// Other numbers in some places: zero, negative, large, a little beside.
void ChangeValues(ir::Module& module, RandomSource& random) {
  std::vector<std::uint32_t> literals;
  for (std::uint32_t i = 0; i < module.exprs.Size(); ++i) {
    const ir::Expr& expr = module.exprs[ir::ExprId{std::size_t{i}}];
    if (expr.op == ir::ExprOp::kLiteral && (expr.type == ir::Type::kInt || expr.type == ir::Type::kReal))
      literals.push_back(i);
  }
  if (literals.empty()) return;
  const std::uint32_t changes = 1 + random.Below(6);
  for (std::uint32_t i = 0; i < changes; ++i) {
    ir::Expr& expr = module.exprs[ir::ExprId{std::size_t{random.PickFrom(literals)}}];
    const double old = expr.number;
    constexpr double kValues[] = {0, 0, 0, -1, 1, 7, 90, -100, 1e6, 2147483647};
    switch (random.Below(4)) {
      case 0:
        expr.number = -old;
        break;
      case 1:
        expr.number = old + (random.Percent(50) ? 1 : -1);
        break;
      default:
        expr.number = random.Pick(kValues);
        break;
    }
    // No language reads an INT beyond its range.
    if (expr.type == ir::Type::kInt) expr.number = std::clamp(expr.number, -2147483647.0, 2147483647.0);
    expr.number += 0.0;
    expr.format = {};
    expr.format.flags = ir::NumberFormat::kComputed;
    expr.count = 0;
  }
}

bool IsOfValues(ir::AlarmClass alarm) {
  return alarm == ir::AlarmClass::kArithmetic || alarm == ir::AlarmClass::kConversion ||
         alarm == ir::AlarmClass::kIndex || alarm == ir::AlarmClass::kRange || alarm == ir::AlarmClass::kMissingFeed;
}

/// Lines with a finding of that class.
std::set<std::uint32_t> Announced(const diag::Sink& sink, ir::AlarmClass alarm) {
  std::set<std::uint32_t> lines;
  for (const diag::Diagnostic& finding : sink.All()) {
    const diag::Code code = finding.code;
    const bool arithmetic =
        code == diag::Code::kDivisionByZero || code == diag::Code::kOutOfDomain || code == diag::Code::kOverflow;
    // Bits of a value that is no 32-bit number are a conversion too, and counts and factors have ranges.
    const bool conversion = code == diag::Code::kOutOfRange;
    const bool index = code == diag::Code::kArrayIndex;
    const bool feed = code == diag::Code::kMissingFeed;
    if ((alarm == ir::AlarmClass::kArithmetic && arithmetic) ||
        ((alarm == ir::AlarmClass::kConversion || alarm == ir::AlarmClass::kRange) && conversion) ||
        (alarm == ir::AlarmClass::kIndex && index) || (alarm == ir::AlarmClass::kMissingFeed && feed))
      lines.insert(finding.at.line);
  }
  return lines;
}

bool IsLibrary(const ir::Module& module, ir::BlockId block) {
  return std::ranges::any_of(module.programs.All(), [&](const ir::Program& program) {
    return program.library && block.value - program.blocks.begin < program.blocks.count;
  });
}

/// A feed that is not above 0 is told where it is written, and the run stops at the move behind it.
bool FeedAnnounced(const diag::Sink& sink, const ir::Module& module) {
  return std::ranges::any_of(sink.All(), [&](const diag::Diagnostic& finding) {
    if (finding.code != diag::Code::kOutOfRange || finding.at.line == 0) return false;
    const ir::Block& block = module.blocks[ir::BlockId{std::size_t{finding.at.line - 1}}];
    return ir::HasWord(module, block, ir::WordOp::kFeed) || ir::HasWord(module, block, ir::WordOp::kFeedOnce);
  });
}

std::string DumpOf(const ir::Module& module) {
  TextBuffer out;
  ir::Dump(module, out);
  return std::string(out.View());
}

diag::Sink CheckAll(const ir::Module& module, const ir::Machine& machine, bool all) {
  const ir::analysis::FlowGraphs graphs(module);
  const ir::analysis::CallGraph calls(module);
  const ir::analysis::ModalFlow modal(module, machine, graphs, calls, {machine.start, {}});
  check::ValueRuleOptions options;
  options.all = all;
  diag::Sink sink(1'000'000);
  (void)check::CheckValues(module, machine, graphs, calls, modal, options, sink);
  return sink;
}

}  // namespace

Finding CheckAnnounced(const Subject& subject, const Direction& /*direction*/) {
  ir::Module module = *subject.module;
  NumberBlocks(module);
  // The same changes for the same program.
  RandomSource random(module.exprs.Size() * 7919 + module.blocks.Size() * 31 + module.words.Size());
  for (int variant = 0; variant < 4; ++variant) {
    if (variant > 0) ChangeValues(module, random);
    Subject changed = subject;
    changed.module = &module;
    changed.max_blocks = 20'000;
    const diag::Sink sink = CheckAll(module, *subject.machine, true);
    const SkipSets skips = SkipSetsOf(module);
    for (std::uint32_t i = 0; i < skips.count; ++i) {
      Run run;
      RunProgram(changed, skips.sets[i], run);
      if (run.outcome != exec::Outcome::kAlarmed || run.trace.Events().empty()) continue;
      const exec::Event& alarm = run.trace.Events().back();
      if (!IsOfValues(alarm.alarm)) continue;
      const std::uint32_t line = alarm.block.value + 1;
      // Cycles of the control test what their words take, unless a change made their own numbers wrong.
      const bool of_word = alarm.alarm == ir::AlarmClass::kRange || alarm.alarm == ir::AlarmClass::kMissingFeed;
      if (of_word && IsLibrary(module, alarm.block)) continue;
      if (Announced(sink, alarm.alarm).contains(line)) continue;
      if (alarm.alarm == ir::AlarmClass::kMissingFeed && FeedAnnounced(sink, module)) continue;
      return {Verdict::kFails, "announce",
              fmt::format("alarm {} at line {} was not announced; findings:\n{}", alarm.text, line, TextOf(sink)),
              DumpOf(module)};
    }
  }
  return {};
}

}  // namespace ncport::tests::random
