#include "frontend/iso/lower.h"

#include "base/result.h"
#include "dialects/iso/words.h"
#include "dialects/word_template.h"
#include "frontend/common/chars.h"
#include "frontend/iso/token_kind.h"
#include "ir/builder.h"

namespace ncport::frontend::iso {

using diag::Code;
using ir::WordOp;
using K = TokenKind;

namespace {

/// Letter of the hole in a form such as "G4 X{seconds}".
char LetterOfHole(const dialects::Setting<std::string>& form, char usual) {
  if (!form.Known()) return usual;
  const std::size_t hole = form->find('{');
  return hole == std::string::npos || hole == 0 ? usual : (*form)[hole - 1];
}

}  // namespace

Lowering::Lowering(ir::Module& module, const dialects::Profile& profile)
    : module_(module),
      lathe_(profile.IsLathe()),
      tool_holds_offset_(profile.words.tool.Known() && dialects::WidthOf(*profile.words.tool, "offset") != 0),
      dwell_letter_(LetterOfHole(profile.words.dwell, 'P')) {
  code_spellings_.resize(dialects::iso::Codes().Rows().size());
}

bool Lowering::Fail(Code code, const Token& token, const char* help) {
  error_ = {.code = code, .begin = token.offset, .length = token.length, .help = help};
  return false;
}

bool Lowering::Replay(const Recipe& recipe, std::span<const Token> tokens, std::string_view line, ir::Block& block) {
  tokens_ = tokens;
  line_ = line;
  letters_ = 0;
  groups_ = 0;
  const auto first = static_cast<std::uint32_t>(module_.words.Size());
  for (const Action& action : recipe.actions) {
    if (!Do(action)) return false;
  }
  block.words = {first, static_cast<std::uint32_t>(module_.words.Size()) - first};
  return true;
}

ir::Word& Lowering::Add(WordOp op, const Action& action, ir::ExprId value, std::uint8_t index) {
  ir::Word& word = module_.words.Emplace();
  word.op = op;
  word.phase = ir::DefaultPhaseOf(op);
  word.value = value;
  word.index = index;
  word.begin = tokens_[action.first].offset;
  word.length = tokens_[action.last].End() - word.begin;
  return word;
}

ir::ExprId Lowering::Literal(const Token& token) {
  ir::Expr& expr = module_.EmplaceExpr();
  expr.op = ir::ExprOp::kLiteral;
  expr.type = (token.format.flags & ir::NumberFormat::kPoint) != 0 ? ir::Type::kReal : ir::Type::kInt;
  expr.format = token.format;
  expr.number = token.number;
  return module_.LastExpr();
}

ir::ExprId Lowering::Whole(double number, const Token& token) {
  Token part = token;
  part.number = number;
  part.format = {.int_digits = static_cast<std::uint8_t>(number >= 10 ? 2 : 1)};
  return Literal(part);
}

bool Lowering::Once(char letter, const Token& token) {
  const std::uint32_t bit = 1U << (letter - 'A');
  if ((letters_ & bit) != 0) return Fail(Code::kDoubleWord, token);
  letters_ |= bit;
  return true;
}

bool Lowering::Do(const Action& action) {
  const Token& token = tokens_[action.first];
  const char letter = Upper(line_[token.offset]);
  const auto kind = static_cast<K>(action.op);
  if (kind == K::kCode) return AddCode(action);
  if (kind == K::kAuxiliary) {
    ir::Word& word = Add(WordOp::kAux, action, Literal(token));
    word.phase = dialects::iso::AuxiliaryCode().phase;
    if (token.number == 9) word.phase = ir::Phase::kAfter;
    return true;
  }
  if (kind == K::kExtendedOffset) return AddExtendedOffset(action);
  if (!Once(letter, token)) return false;
  switch (kind) {
    case K::kProgramNumber:
      Add(WordOp::kFileMark, action).spelling =
          ir::AddSpelling(module_, line_.substr(token.offset, token.length), "iso-1");
      return true;
    case K::kAxis:
      Add(WordOp::kAxis, action, Literal(token), token.sub);
      return true;
    case K::kCenter:
      Add(WordOp::kCenter, action, Literal(token), token.sub).mode = ir::ValueMode::kStep;
      return true;
    case K::kRadius:
      Add(WordOp::kRadius, action, Literal(token));
      return true;
    case K::kFeed:
      Add(WordOp::kFeed, action, Literal(token));
      return true;
    case K::kSpeed:
      Add(WordOp::kSpeed, action, Literal(token));
      return true;
    case K::kTool:
      return AddTool(action);
    case K::kLength:
      Add(WordOp::kLengthOffset, action, Literal(token));
      return true;
    case K::kOffset:
      Add(WordOp::kRadiusOffset, action, Literal(token));
      return true;
    case K::kDwell:
      return AddDwell(action);
    case K::kLimit:
      Add(WordOp::kSpeedLimit, action, Literal(tokens_[action.last]));
      return true;
    default:
      NCPORT_BUG("token kind {} is no word of a flat block", action.op);
  }
}

bool Lowering::AddCode(const Action& action) {
  const Token& token = tokens_[action.first];
  const auto& row = dialects::iso::Codes().Rows()[token.data];
  if (row.group != 0) {
    const std::uint64_t bit = std::uint64_t{1} << row.group;
    if ((groups_ & bit) != 0) {
      for (const Token& other : tokens_) {
        if (other.kind != token.kind || dialects::iso::Codes().Rows()[other.data].group != row.group) continue;
        Fail(Code::kWordConflict, token);
        error_.other_begin = other.offset;
        error_.other_length = other.length;
        return false;
      }
    }
    groups_ |= bit;
  }
  std::uint16_t& spelling = code_spellings_[token.data];
  if (spelling == 0) spelling = ir::AddSpelling(module_, row.text, row.rule);
  ir::Word& word = Add(row.op, action, {}, row.index);
  word.extra = row.extra;
  word.phase = row.phase;
  word.flags = row.flags;
  word.spelling = spelling;
  if (token.digits != 0 && token.digits + 1U != row.text.size()) word.digits = token.digits;
  return true;
}

// T3 on a mill; on a lathe the last two digits are the offset: T0313.
bool Lowering::AddTool(const Action& action) {
  const Token& token = tokens_[action.first];
  if (!tool_holds_offset_) {
    Add(WordOp::kTool, action, Literal(token));
    return true;
  }
  // Of very long numbers the digits are not counted.
  if (token.digits > 4 || token.number > 9999) return Fail(Code::kOutOfRange, token);
  const auto number = static_cast<std::uint32_t>(token.number);
  const ir::ExprId tool = Whole(number / 100, token);
  Add(WordOp::kTool, action, tool);
  const ir::ExprId offset = Whole(number % 100, token);
  Add(WordOp::kToolOffset, action, offset);
  return true;
}

bool Lowering::AddExtendedOffset(const Action& action) {
  const Token& number = tokens_[action.last];
  if (!(number.number >= 1 && number.number <= 65535) ||
      number.number != static_cast<double>(static_cast<std::uint16_t>(number.number))) {
    return Fail(Code::kBadNumber, number, "the number of a work offset is whole");
  }
  Add(WordOp::kWorkOffset, action, Literal(number)).extra = 54;
  return true;
}

bool Lowering::AddDwell(const Action& action) {
  const Token& time = tokens_[action.last];
  if (Upper(line_[time.offset]) != dwell_letter_) {
    return Fail(Code::kUnexpectedText, time, "the profile gives the seconds of a dwell another letter (words.dwell)");
  }
  Add(WordOp::kDwellSeconds, action, Literal(time));
  return true;
}

}  // namespace ncport::frontend::iso
