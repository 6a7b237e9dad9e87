// Targets that stand in the text as constants but are looked for only when a run comes there: jumps to a number or a
// text, returns to a block of the caller, calls of a block of the own program, calls of a program by a text.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "check/expressions.h"
#include "check/rules.h"
#include "check/targets.h"
#include "dialects/finding_alarms.h"
#include "exec/program_name.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ExprId;
using ir::ProgramId;
using ir::Search;
using ir::TargetKind;
using ir::WordOp;

class ConstantTargets {
 public:
  ConstantTargets(const Subject& subject, ProgramId program, diag::Sink& sink)
      : subject_(subject), module_(subject.module), program_(program), sink_(sink) {}

  void Run() {
    for (const BlockId block : module_.programs[program_].blocks) {
      if ((module_.blocks[block].flags & ir::Block::kRefused) != 0) continue;
      ForEachTarget(module_, module_.blocks[block], [&](const TargetUse& use) {
        if (use.quiet || use.target.kind != TargetKind::kExpression || !use.is_jump) return;
        if (Misses(use.target, program_, block, use.search)) Report(block, use.word, use.target);
      });
      for (const ir::WordId id : module_.blocks[block].words) {
        const ir::Word& word = module_.words[id];
        if (word.op == WordOp::kReturn) Return(block, word);
        if (word.op == WordOp::kCall) Call(block, word);
      }
    }
  }

 private:
  /// A constant as the run reads it; empty: the run computes it.
  [[nodiscard]] std::string NameOf(const ir::Target& target) const {
    if (target.kind != TargetKind::kExpression) return IsWritten(target) ? TargetText(module_, target) : std::string();
    if (const std::optional<double> number = LiteralValue(module_, target.expr))
      return fmt::format("N{:.0f}", std::round(*number));
    const ir::Expr& expr = module_.exprs[Plain(module_, target.expr)];
    if (expr.op != ir::ExprOp::kText) return {};
    return std::string(module_.View(StringId{std::size_t{expr.a}}));
  }

  /// True if the target is a constant that the program does not hold.
  [[nodiscard]] bool Misses(const ir::Target& target, ProgramId in, BlockId from, Search search) const {
    const std::string name = NameOf(target);
    if (name.empty() || subject_.InRefusedBlock(in, name)) return false;
    const ir::analysis::LabelTable& labels = subject_.graphs.LabelsOf(in);
    if (target.kind != TargetKind::kExpression) return !labels.Find(target, from, search).Valid();
    const std::optional<double> number = LiteralValue(module_, target.expr);
    if (!number) {
      ir::Target plain = target;
      plain.expr = Plain(module_, target.expr);
      return !labels.Find(plain, from, search).Valid();
    }
    const double whole = std::round(*number);
    return !(whole >= 0 && whole < ir::Block::kNoNumber) ||
           !labels.FindNumber(static_cast<std::uint32_t>(whole), false, from, search).Valid();
  }

  diag::Diagnostic& Report(BlockId block, const ir::Word& word, const ir::Target& target, bool certain = true) {
    const diag::Severity severity = certain ? diag::Severity::kError : diag::Severity::kWarning;
    diag::Diagnostic& finding =
        sink_.ReportAs(severity, diag::Code::kUnknownLabel, subject_.PlaceOf(block, word), NameOf(target));
    finding.control = dialects::AlarmFor(subject_.profile, finding.code);
    return finding;
  }

  /// Looked for in the caller, from its call on; in a main program it is a jump.
  void Return(BlockId block, const ir::Word& word) {
    if (static_cast<ir::ReturnKind>(word.index) != ir::ReturnKind::kToCaller || !word.value.Valid()) return;
    ir::Target target;
    target.kind = TargetKind::kExpression;
    target.expr = word.value;
    if (module_.programs[program_].kind == ir::ProgramKind::kMain) {
      if (subject_.IsMain(program_) && Misses(target, program_, block, Search::kForwardThenFromStart))
        Report(block, word, target);
      return;
    }
    const ir::analysis::CallSite* missing = nullptr;
    bool everywhere = true;
    for (const ir::analysis::CallSite& site : subject_.calls.AllSites()) {
      if (site.callee != program_ || site.modal) continue;
      if (!Misses(target, site.caller, site.block, Search::kForwardThenFromStart)) {
        everywhere = false;
      } else if (missing == nullptr) {
        missing = &site;
      }
    }
    if (missing == nullptr) return;
    diag::Diagnostic& finding = Report(block, word, target, everywhere);
    finding.notes.push_back({subject_.PlaceOf(missing->block), "the program that calls from here does not hold it"});
  }

  void Call(BlockId block, const ir::Word& word) {
    const auto id = word.Extra<ir::CallId>();
    if (!module_.calls.Contains(id)) return;
    const ir::Call& call = module_.calls[id];
    if (call.from_block && call.program.Valid() && call.form != ir::CallForm::kBlockRange) {
      const BlockId start{std::size_t{module_.programs[call.program].blocks.begin}};
      if (Misses(call.from, call.program, start, Search::kForwardThenFromStart)) Report(block, word, call.from);
      return;
    }
    if (call.form != ir::CallForm::kText || call.program.Valid() || !call.name_expr.Valid()) return;
    const ir::Expr& expr = module_.exprs[Plain(module_, call.name_expr)];
    if (expr.op != ir::ExprOp::kText) return;
    const std::string_view name = module_.View(StringId{std::size_t{expr.a}});
    if (name.empty() || module_.FindProgram(exec::PlainName(name), true).Valid()) return;
    // The control may hold it; only a run without it stops.
    sink_.ReportAs(diag::Severity::kWarning, diag::Code::kUnknownProgram, subject_.PlaceOf(block, word), name).help =
        "give its file too: a call by a text is looked for when the run comes here";
  }

  const Subject& subject_;
  const ir::Module& module_;
  ProgramId program_;
  diag::Sink& sink_;
};

}  // namespace

void CheckConstantTargets(const Subject& subject, ProgramId program, diag::Sink& sink) {
  ConstantTargets(subject, program, sink).Run();
}

}  // namespace ncport::check
