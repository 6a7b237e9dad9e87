#include "frontend/sinumerik/token_source.h"

#include "frontend/sinumerik/chars.h"
#include "frontend/sinumerik/word_index.h"

namespace ncport::frontend::sinumerik {

namespace {

using K = TokenKind;
using diag::Code;

/// `GOTO :30` is a jump to a main block, not a label.
bool IsGotoWord(std::string_view text) {
  char buffer[kMaxWord];
  const WordEntry* entry = FindWord(UpperIn(text, buffer));
  return entry != nullptr && entry->kind == K::kGoto;
}

bool IsStructureWord(K kind) {
  switch (kind) {
    case K::kIf:
    case K::kElse:
    case K::kEndIf:
    case K::kWhile:
    case K::kEndWhile:
    case K::kFor:
    case K::kEndFor:
    case K::kLoop:
    case K::kEndLoop:
    case K::kRepeat:
    case K::kUntil:
      return true;
    default:
      return false;
  }
}

}  // namespace

const Token* TokenSource::Refused() const { return refused_ != 0 && !defines_ ? &tokens_[refused_ - 1] : nullptr; }

bool TokenSource::OnlyHead() const {
  for (const Token& token : tokens_) {
    const auto kind = static_cast<K>(token.kind);
    if (kind != K::kSkip && kind != K::kBlockNumber && kind != K::kMainNumber && kind != K::kLabel) return false;
  }
  return true;
}

Token& TokenSource::Push(K kind, const char* from, const char* to) {
  Token& token = tokens_.emplace_back();
  token.kind = static_cast<std::uint16_t>(kind);
  token.offset = OffsetOf(from);
  token.length = in_macro_ != nullptr ? macro_length_ : static_cast<std::uint32_t>(to - from);
  const bool sign =
      kind == K::kMinus || kind == K::kPlus || kind == K::kNot || kind == K::kBitNot || kind == K::kConcat;
  unary_ = sign ? unary_ + 1 : 0;
  return token;
}

void TokenSource::Fail(Code code, const char* from, const char* to, const char* help, const char* detail) {
  if (failed_) return;
  failed_ = true;
  error_ = {.code = code,
            .begin = OffsetOf(from),
            .length = in_macro_ != nullptr ? macro_length_ : static_cast<std::uint32_t>(to - from),
            .help = help,
            .detail = detail};
}

void TokenSource::Lex(std::string_view line, const Macros& macros) {
  tokens_.clear();
  line_ = line.data();
  macros_ = &macros;
  in_macro_ = nullptr;
  comment_ = kNoComment;
  depth_ = 0;
  unary_ = 0;
  refused_ = 0;
  structure_ = K::kNone;
  defines_ = false;
  failed_ = false;

  Cursor c{line.data(), line.data() + line.size()};
  c.at = SkipBlanks(c.at, c.end);
  indent_ = static_cast<std::uint32_t>(c.at - line_);
  if (c.at == c.end) return;
  if (*c.at == ';') {
    comment_ = indent_;
    return;
  }
  LexStart(c);
  LexWords(c);
  if (!failed_ && depth_ != 0 && !defines_) {
    const Open& open = open_[depth_ - 1];
    failed_ = true;
    error_ = {.code = Code::kUnclosedBracket, .begin = open.offset, .length = 1};
  }
}

// `/3 N10 LABEL:` in this order (card 1.3).
void TokenSource::LexStart(Cursor& c) {
  if (*c.at == '/') {
    const char* from = c.at++;
    const bool level = c.at < c.end && IsDigit(*c.at);
    Token& token = Push(K::kSkip, from, level ? c.at + 1 : c.at);
    if (level) {
      token.sub = static_cast<std::uint8_t>(*c.at - '0');
      token.digits = 1;
      ++c.at;
    }
    c.at = SkipBlanks(c.at, c.end);
  }
  if (c.at < c.end && (Upper(*c.at) == 'N' || *c.at == ':')) {
    const K kind = *c.at == ':' ? K::kMainNumber : K::kBlockNumber;
    const char* digits = SkipBlanks(c.at + 1, c.end);
    if (digits < c.end && IsDigit(*digits)) {
      LexNumberedWord(c, kind);
      c.at = SkipBlanks(c.at, c.end);
    }
  }
  if (c.at < c.end && Is(*c.at, kStart)) {
    const char* word_end = SkipIdentifier(c.at, c.end);
    const char* colon = SkipBlanks(word_end, c.end);
    if (colon < c.end && *colon == ':' && word_end - c.at >= 2 &&
        !IsGotoWord({c.at, static_cast<std::size_t>(word_end - c.at)})) {
      const char* from = c.at;
      Token& token = Push(K::kLabel, from, colon + 1);
      token.data = strings_.Intern({from, static_cast<std::size_t>(word_end - from)}).value;
      c.at = colon + 1;
    }
  }
}

void TokenSource::LexWords(Cursor& c) {
  while (!failed_) {
    c.at = SkipBlanks(c.at, c.end);
    if (c.at == c.end) return;
    if (in_macro_ == nullptr && static_cast<std::uint32_t>(c.at - line_) > kMaxLineBytes) {
      Fail(Code::kBlockTooLong, c.at, c.end);
      error_.limit = kMaxLineBytes;
      return;
    }
    if (tokens_.size() > kMaxTokens) {
      Fail(Code::kTooManyWords, c.at, c.end);
      error_.limit = kMaxTokens;
      return;
    }
    if (unary_ > kMaxUnary) {
      Fail(Code::kNestingLimit, c.at, c.at + 1, nullptr, "signs");
      error_.limit = kMaxUnary;
      return;
    }
    const char first = *c.at;
    if (first == ';') {
      if (in_macro_ == nullptr) comment_ = static_cast<std::uint32_t>(c.at - line_);
      return;
    }
    if (Is(first, kStart)) {
      if (!LexLetter(c)) return;
    } else if (IsDigit(first) || (first == '.' && c.at + 1 < c.end && IsDigit(c.at[1]))) {
      LexNumber(c);
    } else if (first == '"') {
      LexText(c);
    } else if (first == '\'') {
      LexBased(c);
    } else if (first == '$') {
      LexSystem(c);
    } else if (static_cast<unsigned char>(first) == 0xC2 && c.at + 1 < c.end &&
               static_cast<unsigned char>(c.at[1]) == 0xA0) {
      c.at += 2;  // a no-break space, pasted from a document
    } else if (!LexOperator(c)) {
      const char* to = c.at + 1;
      while (to < c.end && (static_cast<unsigned char>(*to) & 0xC0U) == 0x80U) ++to;
      Fail(Code::kUnknownCharacter, c.at, to);
    }
  }
}

// Behind GOTO and REPEAT a name is a label, also where it looks like an address (`GOTOF L1`, `GOTOF START`).
bool TokenSource::WantsTarget() const {
  switch (Last()) {
    case K::kGoto:
    case K::kRepeat:
    case K::kRepeatBlock:
      return true;
    case K::kName:
      return tokens_.size() >= 2 && static_cast<K>(tokens_[tokens_.size() - 2].kind) == K::kRepeat;
    default:
      return false;
  }
}

bool TokenSource::LexLetter(Cursor& c) {
  if (WantsTarget()) {
    const char* word_end = SkipIdentifier(c.at, c.end);
    const char* next = SkipBlanks(word_end, c.end);
    const bool number = Upper(*c.at) == 'N' && word_end - c.at > 1 && SkipDigits(c.at + 1, word_end) == word_end;
    const bool other = next < c.end && (*next == '(' || *next == '[' || (*next == '=' && word_end - c.at == 1));
    const bool single = word_end - c.at == 1 || (Upper(*c.at) == 'P' && SkipDigits(c.at + 1, word_end) == word_end);
    if (!number && !other && !single) {
      const char* from = c.at;
      c.at = word_end;
      Push(K::kName, from, word_end).data = strings_.Intern({from, static_cast<std::size_t>(word_end - from)}).value;
      return true;
    }
  }
  if (!macros_->Empty() && !defines_ && LexMacro(c)) return !failed_;
  const char* second = c.at + 1;
  // Card 2.3: two letters or underscores start an identifier, one letter is an address.
  if (*c.at == '_' || (second < c.end && Is(*second, kStart))) {
    LexIdentifier(c, SkipIdentifier(c.at, c.end));
  } else {
    LexAddress(c);
  }
  return !failed_;
}

bool TokenSource::LexMacro(Cursor& c) {
  char buffer[kMaxWord];
  const char* word_end = SkipIdentifier(c.at, c.end);
  const Macros::Macro* macro = macros_->Find(UpperIn({c.at, static_cast<std::size_t>(word_end - c.at)}, buffer));
  if (macro == nullptr && !(c.at + 1 < c.end && Is(c.at[1], kStart))) {
    word_end = SkipDigits(c.at + 1, c.end);  // M06X10: the macro M06
    macro = macros_->Find(UpperIn({c.at, static_cast<std::size_t>(word_end - c.at)}, buffer));
  }
  if (macro == nullptr) return false;
  if (in_macro_ != nullptr) {
    if (macro == in_macro_) return false;  // DEFINE M6 AS M6 T1: the word itself
    Fail(Code::kNestedMacro, c.at, word_end);
    return true;
  }
  in_macro_ = macro;
  macro_offset_ = static_cast<std::uint32_t>(c.at - line_);
  macro_length_ = static_cast<std::uint32_t>(word_end - c.at);
  Cursor inner{macro->text.data(), macro->text.data() + macro->text.size()};
  LexWords(inner);
  in_macro_ = nullptr;
  c.at = word_end;
  return true;
}

void TokenSource::LexIdentifier(Cursor& c, const char* word_end) {
  const char* from = c.at;
  const std::string_view text(from, static_cast<std::size_t>(word_end - from));
  c.at = word_end;
  char buffer[kMaxWord];
  const std::string_view upper = UpperIn(text, buffer);
  const WordEntry* entry = upper.empty() ? nullptr : FindWord(upper);
  if (entry == nullptr) {
    if (upper.size() > 2 && upper.substr(0, 2) == "RG" && SkipDigits(from + 2, word_end) == word_end) {
      Token& token = Push(K::kCell, from, word_end);
      token.sub = 1;
      ReadUnsigned(from + 2, word_end, token);
      return;
    }
    Push(K::kName, from, word_end).data = strings_.Intern(text).value;
    return;
  }
  if (IsStructureWord(entry->kind) && OnlyHead()) structure_ = entry->kind;
  Token& token = Push(entry->kind, from, word_end);
  token.sub = entry->sub;
  token.digits = entry->digits;
  token.data = entry->data;
  switch (entry->kind) {
    case K::kBoolean:
      token.number = entry->sub;
      break;
    case K::kRefused:
      if (refused_ == 0) refused_ = static_cast<std::uint32_t>(tokens_.size());
      break;
    case K::kDefine:
      defines_ = true;
      break;
    case K::kPathCall:
      LexPath(c);
      break;
    case K::kAddress: {
      // A word of two letters or more always has `=` (card 2.2); without it the name is something else.
      const char* next = SkipBlanks(c.at, c.end);
      if (next == c.end || (*next != '=' && *next != '[')) {
        Fail(Code::kMissingValue, from, word_end);
      }
      break;
    }
    default:
      break;
  }
}

void TokenSource::LexSystem(Cursor& c) {
  const char* from = c.at;
  const char* end = SkipIdentifier(from + 1, c.end);
  if (end == from + 1) {
    // `$$..`: the main-run form of synchronized actions.
    Fail(Code::kUnknownCharacter, from, from + 1);
    return;
  }
  c.at = end;
  Push(K::kSystem, from, end).data = strings_.Intern({from + 1, static_cast<std::size_t>(end - from - 1)}).value;
}

// PCALL path: text without quotes up to a blank, a bracket or a comment.
void TokenSource::LexPath(Cursor& c) {
  const char* from = SkipBlanks(c.at, c.end);
  const char* end = from;
  while (end < c.end && !Is(*end, kBlank) && *end != '(' && *end != ';') ++end;
  if (end == from) return;
  c.at = end;
  Push(K::kPath, from, end).data = strings_.Intern({from, static_cast<std::size_t>(end - from)}).value;
}

bool TokenSource::LexOperator(Cursor& c) {
  const char* from = c.at;
  const char next = from + 1 < c.end ? from[1] : '\0';
  K kind = K::kNone;
  std::ptrdiff_t length = 1;
  switch (*from) {
    case '=':
      kind = next == '=' ? K::kEqualTo : K::kEquals;
      length = next == '=' ? 2 : 1;
      break;
    case '<':
      kind = next == '=' ? K::kLessEqual : next == '>' ? K::kNotEqual : next == '<' ? K::kConcat : K::kLess;
      length = kind == K::kLess ? 1 : 2;
      break;
    case '>':
      kind = next == '=' ? K::kGreaterEqual : K::kGreater;
      length = kind == K::kGreater ? 1 : 2;
      break;
    case '+':
      kind = K::kPlus;
      break;
    case '-':
      kind = K::kMinus;
      break;
    case '*':
      kind = K::kStar;
      break;
    case '/':
      kind = K::kSlash;
      break;
    case ',':
      kind = K::kComma;
      break;
    case ':': {
      const char* digits = SkipBlanks(from + 1, c.end);
      if (Last() == K::kGoto && digits < c.end && IsDigit(*digits)) {
        LexNumberedWord(c, K::kMainNumber);
        return true;
      }
      kind = K::kColon;
      break;
    }
    case '(':
    case '[':
      if (depth_ == kMaxDepth) {
        Fail(Code::kNestingLimit, from, from + 1, nullptr, "brackets");
        error_.limit = kMaxDepth;
        return true;
      }
      open_[depth_++] = {OffsetOf(from), *from};
      kind = *from == '(' ? K::kLeftParen : K::kLeftBracket;
      break;
    case ')':
    case ']':
      if (depth_ == 0 || (open_[depth_ - 1].bracket == '(') != (*from == ')')) {
        if (!defines_) {
          Fail(Code::kUnexpectedText, from, from + 1);
          return true;
        }
      } else {
        --depth_;
      }
      kind = *from == ')' ? K::kRightParen : K::kRightBracket;
      break;
    default:
      return false;
  }
  // `= =`, `> =`, `< >`: one operator, torn apart (card 11: pages for small controls print it so).
  const bool tears = kind == K::kEquals || kind == K::kLess || kind == K::kGreater;
  if (tears) {
    const char* after = SkipBlanks(from + 1, c.end);
    if (after > from + 1 && after < c.end && (*after == '=' || (kind == K::kLess && *after == '>'))) {
      Fail(Code::kSplitOperator, from, after + 1);
      return true;
    }
  }
  c.at = from + length;
  Push(kind, from, c.at);
  return true;
}

}  // namespace ncport::frontend::sinumerik
