#include "frontend/fanuc/lower.h"

#include <cmath>

#include "base/result.h"
#include "ir/axis_names.h"
namespace ncport::frontend::fanuc {

using ir::WordOp;
namespace words = dialects::fanuc;

Lowering::Lowering(ir::Module& module, const dialects::Profile& profile, words::System system, ReaderState& state)
    : module_(module), texts_(module), profile_(profile), system_(system), state_(state), codes_(profile, system) {
  for (const std::string& axis : profile.axes) {
    const auto letter = ir::AxisOf(axis);
    if (!letter) continue;
    axes_ |= static_cast<std::uint16_t>(1U << *letter);
    axis_order_.push_back(*letter);
  }
  increments_ = profile.point.Or(dialects::PointRule::kIncrement) == dialects::PointRule::kIncrement;
  for (const ir::SystemId id : module_.systems.Ids()) systems_.emplace(module_.systems[id].number, id);
}

bool Lowering::Fail(diag::Code code, const Token& token, const char* help, const char* detail) {
  error_ = {.code = code, .begin = token.offset, .length = token.length, .help = help, .detail = detail};
  return false;
}

bool Lowering::Fail(diag::Code code, const Pending& pending, const char* help, const char* detail) {
  const std::uint32_t begin = At(pending.first).offset;
  error_ = {.code = code, .begin = begin, .length = At(pending.last).End() - begin, .help = help, .detail = detail};
  return false;
}

bool Lowering::Replay(const Recipe& recipe, std::span<const Token> tokens, std::span<const CommentPart> comments,
                      std::string_view line, ir::Block& block) {
  tokens_ = tokens;
  comments_ = comments;
  line_ = line;
  block_ = &block;
  first_word_ = static_cast<std::uint32_t>(module_.words.Size());
  text_comment_ = kNoComment;
  values_.clear();
  pending_.clear();
  statement_ = nullptr;
  macro_block_ = false;
  index_depth_ = 0;
  word_ = nullptr;
  skips_ = false;
  repeated_ = false;
  for (const Token& token : tokens) {
    if (static_cast<TokenKind>(token.kind) != TokenKind::kWordValue || token.sub != 'G') continue;
    const double tenths = std::floor(token.number * 10 + 0.5);  // any number of digits may stand there
    macro_block_ |= tenths == 650 || tenths == 660 || tenths == 661;
  }
  for (const Action& action : recipe.actions) {
    if (!Do(action)) return false;
  }
  NCPORT_CHECK(values_.empty(), "{} values of a block are left over", values_.size());
  if (!pending_.empty() && !Finish()) return false;
  block.words = {first_word_, static_cast<std::uint32_t>(module_.words.Size()) - first_word_};
  return true;
}

void Lowering::ReplayHead(std::span<const Token> tokens, ir::Block& block) {
  for (const Token& token : tokens) {
    switch (static_cast<TokenKind>(token.kind)) {
      case TokenKind::kSkip:
        block.skip_level = token.digits != 0 ? token.sub : static_cast<std::uint8_t>(profile_.skip.Or(1));
        if (token.digits != 0) block.flags |= ir::Block::kSkipDigit;
        break;
      case TokenKind::kBlockNumber:
        block.number = static_cast<std::uint32_t>(token.number);
        block.number_digits = token.digits;
        break;
      default:
        return;
    }
  }
}

bool Lowering::Do(const Action& action) {
  const auto step = static_cast<Step>(action.op);
  if (step <= Step::kFunction) return DoValue(action);
  return DoStatement(action);
}

bool Lowering::Finish() {
  if (statement_ != nullptr) {
    // Card 5: a block is a macro statement or NC words.
    return Fail(diag::Code::kNotAlone, *statement_, "give the statement a block of its own");
  }
  DropRepeated();
  Context context;
  if (!Scan(context)) return false;
  if (context.call != nullptr) return MacroCall(context);
  if (context.data != nullptr) return DataSetting(context);
  for (const Pending& pending : pending_) {
    if (!AddPending(pending, context)) return false;
  }
  return !(context.subprogram || context.local_call) || Subprogram(context);
}

}  // namespace ncport::frontend::fanuc
