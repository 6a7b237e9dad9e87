// What the words of one block do to each other, and limits of their values (card 8.3, 8.6, 8.7, 8.9).
#include <optional>
#include <string_view>

#include "frontend/sinumerik/resolver.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

namespace {

/// The number that stands in the text, also with a sign or in brackets; nothing for what is computed.
std::optional<double> Literal(const ir::Module& module, ExprId id) {
  double sign = 1;
  while (id.Valid()) {
    const ir::Expr& expr = module.exprs[id];
    switch (expr.op) {
      case ExprOp::kLiteral:
        return sign * expr.number;
      case ExprOp::kNegate:
        sign = -sign;
        break;
      case ExprOp::kPlus:
      case ExprOp::kGroup:
      case ExprOp::kConvert:
        break;
      default:
        return std::nullopt;
    }
    id = ExprId{std::size_t{expr.a}};
  }
  return std::nullopt;
}

}  // namespace

bool Resolver::BlockRules(const ir::Block& block) {
  bool ok = OwnBlock(block) && PolarBesideAxis(block);
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kOpeningAngle) ok = ok && Limit(word, 0, 360, "0 to 360");
    if (word.op == WordOp::kChamfer) ok = ok && Limit(word, 0, 1e300, "0 and above");
    if (word.op == WordOp::kPolarRadius) ok = ok && Limit(word, 0, 1e300, "0 and above");
  }
  return ok;
}

bool Resolver::Limit(const ir::Word& word, double low, double high, std::string_view range) {
  const std::optional<double> value = Literal(module_, word.value);
  if (!value || (*value >= low && *value <= high)) return true;
  sink_.Report(Code::kOutOfRange, module_.RangeOf(module_.blocks[block_], word.value), *value, range);
  return false;
}

// Card 8.7: TRANS and its kin take the axis words of their block, so a motion word has nothing to move.
bool Resolver::OwnBlock(const ir::Block& block) {
  const ir::Word* frame = nullptr;
  const ir::Word* motion = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kFrame) frame = &word;
    if (word.op == WordOp::kMotion) motion = &word;
  }
  if (frame == nullptr || motion == nullptr) return true;
  const std::string_view text = frame->spelling < module_.spellings.size()
                                    ? module_.View(module_.spellings[frame->spelling].text)
                                    : std::string_view("the frame word");
  sink_.Report(Code::kNotAlone, module_.RangeOf(block, *frame), text).help =
      "the axis words of this block belong to the frame: the motion has a block of its own";
  return false;
}

// Card 8.6: only AP and RP describe the point in the plane.
bool Resolver::PolarBesideAxis(const ir::Block& block) {
  const ir::Word* polar = nullptr;
  std::uint32_t axes = 0;
  const ir::Word* axis = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius) polar = &word;
    if (word.op != WordOp::kAxis || word.index > 2) continue;
    ++axes;
    axis = &word;
  }
  // One of X, Y, Z may stand on the plane; two of them never do.
  if (polar == nullptr || axes < 2) return true;
  const SourceRange at = module_.RangeOf(block, *axis);
  const SourceRange other = module_.RangeOf(block, *polar);
  const std::string_view line = files_.Line(at.file, at.line);
  const auto slice = [&](const SourceRange& range) { return line.substr(range.begin, range.end - range.begin); };
  sink_.Report(Code::kWordConflict, at, slice(other), slice(at)).help =
      "AP and RP alone describe the point in the plane; only the third axis may stand beside them";
  return false;
}

}  // namespace ncport::frontend::sinumerik
