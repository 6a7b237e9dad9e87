#include "tests/random/shrink.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ir/structure.h"
#include "ir/verify.h"
#include "tests/random/walk.h"

namespace ncport::tests::random {

namespace {

using ir::BlockId;
using ir::ExprId;

class Shrinker {
 public:
  Shrinker(const ir::Module& module, const StillFails& still_fails, const ShrinkLimits& limits)
      : best_(module), still_fails_(still_fails), tries_(limits.tries) {}

  ir::Module Run() {
    bool smaller = true;
    while (smaller && tries_ > 0) {
      smaller = false;
      for (const ir::ProgramId program : best_.programs.Ids()) smaller = RemoveBlocks(program) || smaller;
      for (const ir::ProgramId program : best_.programs.Ids()) smaller = RemoveMarks(program) || smaller;
      smaller = RemoveWords() || smaller;
      smaller = SimplifyExprs() || smaller;
      smaller = RemoveTrimmings() || smaller;
    }
    return std::move(best_);
  }

 private:
  /// Takes the candidate if it is a program and fails as the first one did.
  bool Take(ir::Module& candidate) {
    if (tries_ == 0) return false;
    if (ir::FindViolation(candidate, {.names_resolved = true, .structure_built = true})) return false;
    --tries_;
    if (!still_fails_(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }

  /// The program with these of its blocks, marks joined anew. False: marks do not fit any more.
  static bool Keep(ir::Module& module, ir::ProgramId program, const std::vector<BlockId>& blocks) {
    const auto begin = static_cast<std::uint32_t>(module.blocks.Size());
    for (const BlockId id : blocks) {
      ir::Block block = module.blocks[id];
      block.link = {};
      module.blocks.Add(block);
    }
    module.programs[program].blocks = {begin, static_cast<std::uint32_t>(blocks.size())};
    diag::Sink sink;
    ir::BuildStructure(module, program, 0, sink);
    return !sink.HasErrors();
  }

  std::vector<BlockId> BlocksOf(ir::ProgramId program) const {
    std::vector<BlockId> blocks;
    for (const BlockId id : best_.programs[program].blocks) blocks.push_back(id);
    return blocks;
  }

  bool TryWithout(ir::ProgramId program, const std::vector<BlockId>& blocks, const std::vector<bool>& out) {
    std::vector<BlockId> kept;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!out[i]) kept.push_back(blocks[i]);
    }
    ir::Module candidate = best_;
    return Keep(candidate, program, kept) && Take(candidate);
  }

  // Longer and longer parts first, so that much goes early.
  bool RemoveBlocks(ir::ProgramId program) {
    bool any = false;
    std::size_t size = std::max<std::size_t>(1, best_.programs[program].blocks.count / 2);
    while (size > 0 && tries_ > 0) {
      std::size_t at = 0;
      while (at < best_.programs[program].blocks.count && tries_ > 0) {
        const std::vector<BlockId> blocks = BlocksOf(program);
        std::vector<bool> out(blocks.size(), false);
        for (std::size_t i = at; i < std::min(blocks.size(), at + size); ++i) out[i] = true;
        CloseOverMarks(blocks, out);
        if (TryWithout(program, blocks, out)) {
          any = true;
        } else {
          at += size;
        }
      }
      size /= 2;
    }
    return any;
  }

  // A mark goes with all that stands up to its partner.
  void CloseOverMarks(const std::vector<BlockId>& blocks, std::vector<bool>& out) const {
    if (blocks.empty()) return;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const BlockId link = best_.blocks[blocks[i]].link;
      if (!out[i] || !link.Valid()) continue;
      const auto other = static_cast<std::size_t>(link.value - blocks.front().value);
      if (other >= blocks.size()) continue;
      for (std::size_t k = std::min(i, other); k <= std::max(i, other); ++k) out[k] = true;
    }
  }

  // IF, ELSE, ENDIF or the ends of a loop go, their bodies stay.
  bool RemoveMarks(ir::ProgramId program) {
    bool any = false;
    for (std::size_t at = 0; at < best_.programs[program].blocks.count && tries_ > 0; ++at) {
      const std::vector<BlockId> blocks = BlocksOf(program);
      if (!best_.blocks[blocks[at]].link.Valid()) continue;
      std::vector<bool> out(blocks.size(), false);
      std::size_t mark = at;
      while (mark < blocks.size() && !out[mark]) {
        out[mark] = true;
        const BlockId link = best_.blocks[blocks[mark]].link;
        if (!link.Valid()) break;
        mark = static_cast<std::size_t>(link.value - blocks.front().value);
      }
      any = TryWithout(program, blocks, out) || any;
    }
    return any;
  }

  bool RemoveWords() {
    bool any = false;
    for (const ir::ProgramId program : best_.programs.Ids()) {
      for (std::uint32_t b = 0; b < best_.programs[program].blocks.count; ++b) {
        for (std::uint32_t w = 0; tries_ > 0;) {
          const BlockId id = best_.programs[program].blocks[b];
          const IdRange<ir::WordId> words = best_.blocks[id].words;
          if (w >= words.count || words.count < 2) break;
          ir::Module candidate = best_;
          const auto begin = static_cast<std::uint32_t>(candidate.words.Size());
          for (std::uint32_t i = 0; i < words.count; ++i) {
            if (i == w) continue;
            const ir::Word word = candidate.words[words[i]];
            candidate.words.Add(word);
          }
          candidate.blocks[id].words = {begin, words.count - 1};
          // Places of comments between words are no use any more.
          for (const ir::CommentId comment : candidate.blocks[id].comments)
            candidate.comments[comment].place = ir::CommentPlace::kEndOfBlock;
          if (Take(candidate)) {
            any = true;
          } else {
            ++w;
          }
        }
      }
    }
    return any;
  }

  // An operation becomes one of its operands or a plain number.
  bool SimplifyExprs() {
    bool any = false;
    const std::vector<ExprId> reachable = ReachableExprs(best_);
    for (auto it = reachable.rbegin(); it != reachable.rend() && tries_ > 0; ++it) {
      const ir::Expr expr = best_.exprs[*it];
      std::vector<ir::Expr> simpler;
      const auto number = [&](double value) {
        ir::Expr literal;
        literal.type = expr.type == ir::Type::kNone ? ir::Type::kReal : expr.type;
        literal.number = value;
        literal.format.int_digits = 1;
        simpler.push_back(literal);
      };
      const bool numeric = expr.type == ir::Type::kReal || expr.type == ir::Type::kInt ||
                           expr.type == ir::Type::kBool || expr.type == ir::Type::kNumber;
      if (numeric && expr.op != ir::ExprOp::kLiteral) {
        number(0);
        number(1);
      } else if (expr.op == ir::ExprOp::kLiteral && expr.number != 0 && expr.number != 1) {
        number(0);
        number(1);
        if (std::trunc(expr.number) != expr.number) number(std::trunc(expr.number));
      }
      const auto operand = [&](ExprId id) {
        if (id.Valid() && best_.exprs[id].type == expr.type) simpler.push_back(best_.exprs[id]);
      };
      switch (ir::OperandsOf(expr.op)) {
        case ir::Operands::kLeaf:
          break;
        case ir::Operands::kUnary:
          if (expr.op != ir::ExprOp::kCellAt) operand(ExprId{expr.a});
          break;
        case ir::Operands::kBinary:
          operand(ExprId{expr.a});
          operand(ExprId{expr.b});
          break;
        case ir::Operands::kList:
          if (expr.op == ir::ExprOp::kFunction) {
            for (std::uint32_t i = 0; i < expr.count; ++i) operand(best_.Item(expr.b + i));
          }
          break;
      }
      for (const ir::Expr& replacement : simpler) {
        ir::Module candidate = best_;
        candidate.exprs[*it] = replacement;
        if (Take(candidate)) {
          any = true;
          break;
        }
      }
    }
    return any;
  }

  // Comments, numbers, labels, skip levels, arguments.
  bool RemoveTrimmings() {
    bool any = false;
    for (const ir::ProgramId program : best_.programs.Ids()) {
      for (std::uint32_t b = 0; b < best_.programs[program].blocks.count && tries_ > 0; ++b) {
        const BlockId id = best_.programs[program].blocks[b];
        const auto change = [&](auto edit) {
          ir::Module candidate = best_;
          edit(candidate.blocks[id]);
          any = Take(candidate) || any;
        };
        if (!best_.blocks[id].comments.Empty()) change([](ir::Block& block) { block.comments = {}; });
        if (best_.blocks[id].number != ir::Block::kNoNumber) {
          change([](ir::Block& block) {
            block.number = ir::Block::kNoNumber;
            block.number_digits = 0;
          });
        }
        if (best_.blocks[id].label.Valid()) change([](ir::Block& block) { block.label = {}; });
        if (best_.blocks[id].skip_level != ir::Block::kNoSkip)
          change([](ir::Block& block) { block.skip_level = ir::Block::kNoSkip; });
      }
    }
    return any;
  }

  ir::Module best_;
  const StillFails& still_fails_;
  std::size_t tries_;
};

}  // namespace

ir::Module Shrink(const ir::Module& module, const StillFails& still_fails, const ShrinkLimits& limits) {
  return Shrinker(module, still_fails, limits).Run();
}

std::size_t SizeOf(const ir::Module& module) {
  std::size_t size = 0;
  for (const ir::Program& program : module.programs.All()) {
    for (const BlockId block : program.blocks) size += 1 + module.blocks[block].words.count;
  }
  return size;
}

}  // namespace ncport::tests::random
