#include "tests/random/census.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/random/walk.h"

namespace ncport::tests::random {

namespace {

constexpr std::size_t kWordOps = 0
#define NCPORT_WORD(Name, text, value, phase) +1
#include "ir/nodes.def"
    ;
constexpr std::size_t kExprOps = 0
#define NCPORT_EXPR(Name, text, operands) +1
#include "ir/nodes.def"
    ;
constexpr std::size_t kFunctions = 0
#define NCPORT_FUNCTION(Name, text, min_args, max_args) +1
#include "ir/nodes.def"
    ;

template <class Op>
void PrintGroup(TextBuffer& out, std::string_view title, const std::array<std::uint64_t, 256>& counts,
                std::size_t size) {
  std::vector<std::pair<std::uint64_t, std::string_view>> rows;
  std::string never;
  for (std::size_t i = 0; i < size; ++i) {
    const std::string_view name = ir::NameOf(static_cast<Op>(i));
    if (counts[i] != 0)
      rows.emplace_back(counts[i], name);
    else
      never += (never.empty() ? "" : ", ") + std::string(name);
  }
  std::sort(rows.begin(), rows.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  out.Append(fmt::format("\n{}\n", title));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.Append(
        fmt::format("{:>10} {:<22}{}", rows[i].first, rows[i].second, i % 4 == 3 || i + 1 == rows.size() ? "\n" : ""));
  }
  if (!never.empty()) out.Append(fmt::format("never: {}\n", never));
}

}  // namespace

void Census::Add(const ir::Module& module) {
  for (const ir::Program& program : module.programs.All()) {
    ++programs_;
    for (const ir::BlockId id : program.blocks) {
      ++blocks_;
      for (const ir::WordId word : module.blocks[id].words) ++words_[static_cast<std::size_t>(module.words[word].op)];
    }
  }
  for (const ir::ExprId id : ReachableExprs(module)) {
    const ir::Expr& expr = module.exprs[id];
    ++exprs_[static_cast<std::size_t>(expr.op)];
    if (expr.op == ir::ExprOp::kFunction) ++functions_[expr.a];
  }
}

void Census::Print(TextBuffer& out) const {
  out.Append(fmt::format("{} programs, {} blocks\n", programs_, blocks_));
  PrintGroup<ir::WordOp>(out, "words", words_, kWordOps);
  PrintGroup<ir::ExprOp>(out, "expressions", exprs_, kExprOps);
  PrintGroup<ir::Function>(out, "functions", functions_, kFunctions);
}

}  // namespace ncport::tests::random
