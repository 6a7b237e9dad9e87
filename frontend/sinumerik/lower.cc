#include "frontend/sinumerik/lower.h"

#include "base/result.h"
#include "ir/modes.h"

namespace ncport::frontend::sinumerik {

using ir::WordOp;

Lowering::Lowering(ir::Module& module, const dialects::Profile& profile, ReaderState& state)
    : module_(module), texts_(module), profile_(profile), state_(state) {
  for (const ir::SystemId id : module_.systems.Ids()) systems_.emplace(module_.systems[id].name.value, id);
  code_spellings_.resize(dialects::sinumerik::Codes().Rows().size());
  address_spellings_.resize(dialects::sinumerik::Addresses().size());
}

bool Lowering::Fail(diag::Code code, const Token& token, const char* help, const char* detail) {
  error_ = {.code = code, .begin = token.offset, .length = token.length, .help = help, .detail = detail};
  return false;
}

bool Lowering::Replay(const Recipe& recipe, std::span<const Token> tokens, std::string_view line,
                      std::uint32_t line_number, ir::Block& block) {
  tokens_ = tokens;
  line_ = line;
  line_number_ = line_number;
  block_ = &block;
  first_word_ = static_cast<std::uint32_t>(module_.words.Size());
  mode_ = nullptr;
  dwell_ = nullptr;
  groups_ = 0;
  addresses_ = 0;
  axes_ = 0;
  values_.clear();
  targets_.clear();
  late_ = false;
  only_definitions_ = false;
  for (const Action& action : recipe.actions) {
    if (!Do(action)) return false;
  }
  if (dwell_ != nullptr && !Finish()) return false;
  block.words = {first_word_, static_cast<std::uint32_t>(module_.words.Size()) - first_word_};
  NCPORT_CHECK(values_.empty(), "{} values of a block are left over", values_.size());
  return true;
}

void Lowering::ReplayHead(std::span<const Token> tokens, ir::Block& block) {
  for (const Token& token : tokens) {
    switch (static_cast<TokenKind>(token.kind)) {
      case TokenKind::kSkip:
        block.skip_level = token.digits != 0 ? token.sub : static_cast<std::uint8_t>(profile_.skip.Or(0));
        if (token.digits != 0) block.flags |= ir::Block::kSkipDigit;
        break;
      case TokenKind::kMainNumber:
        block.flags |= ir::Block::kMainBlock;
        [[fallthrough]];
      case TokenKind::kBlockNumber:
        block.number = static_cast<std::uint32_t>(token.number);
        block.number_digits = token.digits;
        break;
      case TokenKind::kLabel:
        block.label = token.Text();
        break;
      default:
        return;
    }
  }
}

bool Lowering::Do(const Action& action) {
  const auto step = static_cast<Step>(action.op);
  if (step <= Step::kMissing) return DoValue(action);
  if (step <= Step::kAssignRepeated) return DoWord(action);
  if (step <= Step::kFor) return DoFlow(action);
  if (step <= Step::kRepeatPart) return DoCall(action);
  return DoDefinition(action);
}

// G4: F and S of its block are the dwell, the feed and speed in force stay (card 8.2).
bool Lowering::Finish() {
  bool dwells = false;
  for (std::uint32_t i = first_word_; i < module_.words.Size(); ++i) {
    ir::Word& word = module_.words[ir::WordId{i}];
    if (word.op == WordOp::kFeed || word.op == WordOp::kSpeed) {
      word.op = word.op == WordOp::kFeed ? WordOp::kDwellSeconds : WordOp::kDwellRevolutions;
      word.phase = ir::Phase::kMotion;
      dwells = true;
    } else if (word.op == WordOp::kAxis || word.op == WordOp::kAxisComputed) {
      return Fail(diag::Code::kNotAlone, *dwell_, "the time stands behind F (seconds) or S (turns of the spindle)");
    }
  }
  return dwells || Fail(diag::Code::kMissingValue, *dwell_, "write the seconds as F or the revolutions as S");
}

}  // namespace ncport::frontend::sinumerik
