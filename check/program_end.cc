#include <fmt/format.h>

#include <algorithm>

#include "check/rules.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::WordOp;

/// Words that do nothing when the program runs: programs of these alone hold definitions and have no end.
bool OnlyDeclares(WordOp op) {
  return op == WordOp::kDefine || op == WordOp::kExtern || op == WordOp::kHeader || op == WordOp::kFileMark ||
         op == WordOp::kInert;
}

}  // namespace

void CheckProgramEnd(const Subject& subject, ir::ProgramId program, diag::Sink& sink) {
  if (subject.machine.file_end_is_end) return;
  const ir::Module& module = subject.module;
  const ir::Program& record = module.programs[program];
  const ir::analysis::Cfg& graph = subject.graphs.Of(program);
  BlockId last;  // that holds something besides file marks
  bool runs = false;
  bool falls_out = false;
  for (const BlockId id : record.blocks) {
    const ir::Block& block = module.blocks[id];
    for (const ir::WordId word : block.words) {
      if (module.words[word].op != WordOp::kFileMark) last = id;
      runs = runs || !OnlyDeclares(module.words[word].op);
    }
    if (!graph.Reachable(id)) continue;
    falls_out = falls_out || std::ranges::any_of(graph.Successors(id), [](const ir::analysis::Edge& edge) {
                  return edge.kind == ir::analysis::EdgeKind::kTextEnd;
                });
  }
  // A last block that was not understood may hold the end.
  if (!runs || !falls_out || (module.blocks[last].flags & ir::Block::kRefused) != 0) return;
  diag::Diagnostic& finding = sink.Report(diag::Code::kMissingEnd, subject.PlaceOf(last), module.View(record.name));
  const bool main = record.kind == ir::ProgramKind::kMain;
  const std::string word = main ? subject.profile.words.end.Or("") : subject.profile.words.sub_end.Or("");
  if (!word.empty()) finding.help = fmt::format("write {} in a last block", word);
}

}  // namespace ncport::check
