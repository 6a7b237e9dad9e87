// What the control takes at most: brackets, structures and calls inside each other, and characters of a block.
// All are keys of the profile, and each finding names its key.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "check/places.h"
#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

/// Brackets inside each other. The one around an index or a whole word is not counted: no source says that it counts
/// (fanuc-4.2).
std::int64_t BracketDepth(const ir::Module& module, ExprId id) {
  const Expr& expr = module.exprs[id];
  std::int64_t inside = 0;
  ForOperands(module, expr, [&](ExprId operand) { inside = std::max(inside, BracketDepth(module, operand)); });
  const bool bracket =
      (expr.op == ExprOp::kGroup || expr.op == ExprOp::kFunction) && (expr.flags & Expr::kImplicit) == 0;
  return inside + (bracket ? 1 : 0);
}

class Limits {
 public:
  Limits(const Subject& subject, ir::ProgramId program, diag::Sink& sink)
      : subject_(subject), module_(subject.module), program_(program), sink_(sink) {}

  void Run() {
    const dialects::NestingLimits& nesting = subject_.profile.nesting;
    const std::int64_t brackets = nesting.brackets.Or(0), loops = nesting.loop.Or(0), branches = nesting.branch.Or(0);
    for (const BlockId id : module_.programs[program_].blocks) {
      const ir::Block& block = module_.blocks[id];
      if ((block.flags & ir::Block::kRefused) != 0) continue;
      for (const ir::WordId word_id : block.words) {
        const ir::Word& word = module_.words[word_id];
        if (brackets > 0) Brackets(block, word, brackets);
        switch (word.op) {
          case WordOp::kWhile:
          case WordOp::kFor:
          case WordOp::kLoop:
          case WordOp::kRepeat:
            if (++loops_ > loops && loops > 0) Report(module_.RangeOf(block, word), "loop", loops, "loop");
            break;
          case WordOp::kEndWhile:
          case WordOp::kEndFor:
          case WordOp::kEndLoop:
          case WordOp::kUntil:
            --loops_;
            break;
          case WordOp::kIf:
            if (++branches_ > branches && branches > 0) Report(module_.RangeOf(block, word), "branch", branches, "if");
            break;
          case WordOp::kEndIf:
            --branches_;
            break;
          default:
            break;
        }
      }
    }
  }

 private:
  void Brackets(const ir::Block& block, const ir::Word& word, std::int64_t most) {
    ForExpressions(module_, word, [&](ExprId value) {
      if (BracketDepth(module_, value) <= most) return;
      Report(module_.RangeOf(block, word), "brackets", most, "brackets");
    });
  }

  void Report(const SourceRange& at, std::string_view what, std::int64_t most, std::string_view key) {
    sink_.Report(diag::Code::kNestingLimit, at, what, most).help =
        fmt::format("this control takes no more; another limit is set in the profile: nesting.{}", key);
  }

  const Subject& subject_;
  const ir::Module& module_;
  ir::ProgramId program_;
  diag::Sink& sink_;
  std::int64_t loops_ = 0, branches_ = 0;
};

/// Characters of a line that is UTF-8 here.
std::size_t CharactersOf(std::string_view line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

void CheckNesting(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  Limits(subject, program, sink).Run();
}

void CheckCallDepth(const Subject& subject, diag::Sink& sink) {
  const std::int64_t most = subject.profile.nesting.call.Or(0);
  if (most <= 0) return;
  for (const ir::ProgramId program : subject.module.programs.Ids()) {
    // Only a main program stands at the first level for sure; circles have their own rule.
    const std::uint32_t depth = subject.calls.DepthOf(program);
    if (!subject.IsMain(program) || depth == ir::analysis::CallGraph::kUnbounded || depth <= most) continue;
    for (const ir::analysis::CallSite& site : subject.calls.SitesOf(program)) {
      if (!site.callee.Valid() || subject.calls.DepthOf(site.callee) + 1 != depth) continue;
      diag::Diagnostic& finding = sink.Report(
          diag::Code::kNestingLimit, subject.PlaceOf(site.block, subject.module.words[site.word]), "call", most);
      finding.help = "this control takes no more; another limit is set in the profile: nesting.call";
      break;
    }
  }
}

void CheckBlockLengths(const Subject& subject, ir::ProgramId program, const SourceFiles& files, diag::Sink& sink) {
  const std::int64_t most = subject.profile.block.max_length.Or(0);
  if (most <= 0) return;
  for (const BlockId id : subject.module.programs[program].blocks) {
    const ir::Block& block = subject.module.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) continue;
    SourceRange at = subject.module.RangeOf(block);
    if (!at.Valid()) continue;
    const std::string_view line = files.Line(at.file, at.line);
    if (line.size() < static_cast<std::size_t>(most)) continue;
    const std::size_t length = CharactersOf(line) + 1;  // with the line end
    if (length <= static_cast<std::size_t>(most)) continue;
    at.end = static_cast<std::uint32_t>(line.size());
    sink.Report(diag::Code::kBlockTooLong, at, length, most).help =
        "comment and line end count; another limit is set in the profile: block.max-length";
  }
}

}  // namespace ncport::check
