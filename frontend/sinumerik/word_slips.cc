#include "frontend/sinumerik/word_slips.h"

#include <algorithm>
#include <vector>

#include "base/near_name.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"

namespace ncport::frontend::sinumerik {

namespace {

namespace words = dialects::sinumerik;

constexpr ForeignWord kForeignWords[] = {
    {"THEN", "there is no THEN: what depends on the condition stands in the next blocks, up to ENDIF"},
    {"ELSEIF", "there is no ELSEIF: write ELSE and a further IF with its own ENDIF"},
    {"ELSIF", "there is no ELSIF: write ELSE and a further IF with its own ENDIF"},
    {"BREAK", "there is no BREAK: jump behind the loop with GOTOF"},
    {"CONTINUE", "there is no CONTINUE: jump to the end of the loop with GOTOF"},
    {"NEXT", "there is no NEXT: FOR ends with ENDFOR", "ENDFOR"},
    {"WEND", "there is no WEND: WHILE ends with ENDWHILE", "ENDWHILE"},
    {"STEP", "there is no STEP: FOR counts by one; other steps need WHILE"},
    {"ENDREPEAT", "there is no ENDREPEAT: REPEAT ends with UNTIL and a condition", "UNTIL"},
    {"DO", "there is no DO here: the body of a loop begins in the next block"},
    {"DOWNTO", "there is no DOWNTO: FOR counts up by one; other steps need WHILE"},
    {"RETURN", "there is no RETURN: a subprogram ends with RET or M17"},
};

constexpr ForeignOperatorWord kForeignOperators[] = {
    {"EQ", "equal", "=="}, {"NE", "not equal", "<>"},     {"GT", "greater", ">"}, {"GE", "greater or equal", ">="},
    {"LT", "less", "<"},   {"LE", "less or equal", "<="},
};

struct ForeignCode {
  std::string_view text;
  const char* help;
};

// Card 11, the way from Fanuc.
constexpr char kCycles[] =
    "holes are drilled with MCALL CYCLE81(..) to CYCLE89(..), then the positions, and MCALL alone behind the last one";
constexpr ForeignCode kForeignCodes[] = {
    {"G20", "inches are G70, with feeds G700"},
    {"G21", "millimetres are G71, with feeds G710"},
    {"G28", "the reference point is G74 with machine axes, a fixed point G75; a retract may be SUPA with D0"},
    {"G30", "a fixed point is G75 FP=.. with machine axes"},
    {"G43", "there is no G43: the edge D brings the length of its tool"},
    {"G44", "there is no G44: the edge D brings the length of its tool"},
    {"G49", "there is no G49: D0 takes the offsets of the tool away"},
    {"G50", "the limit of the spindle speed is LIMS=.., a shift of the origin TRANS"},
    {"G65", "a subprogram is called by its name, with values in brackets: NAME(1,2)"},
    {"G66", "a modal call is MCALL NAME(..)"},
    {"G67", "a modal call is ended by MCALL alone"},
    {"G68", "a rotation is ROT or AROT with RPL=.."},
    {"G69", "a rotation is taken back by ROT alone"},
    {"G73", kCycles},
    {"G80", "there is no G80: MCALL alone ends a modal cycle"},
    {"G81", kCycles},
    {"G82", kCycles},
    {"G83", kCycles},
    {"G84", kCycles},
    {"G85", kCycles},
    {"G86", kCycles},
    {"G87", kCycles},
    {"G88", kCycles},
    {"G89", kCycles},
    {"G92", "the limit of the spindle speed is LIMS=.., a shift of the origin TRANS"},
    {"G98",
     "there is no G98: the plane of the retract is the first argument of a drilling cycle, the feed per minute G94"},
    {"G99",
     "there is no G99: the plane of the retract is the first argument of a drilling cycle, the feed per turn G95"},
};

/// Words that begin or hold together a block. None that switches offsets off: a guess would move the machine elsewhere.
constexpr std::string_view kStatementWords[] = {
    "DEF",    "DEFINE", "PROC",    "EXTERN", "IF",     "ELSE",   "ENDIF",   "WHILE",  "ENDWHILE", "FOR",
    "ENDFOR", "LOOP",   "ENDLOOP", "UNTIL",  "REPEAT", "GOTOF",  "GOTOB",   "GOTO",   "GOTOC",    "CASE",
    "MSG",    "SETAL",  "MCALL",   "CALL",   "RET",    "TRANS",  "ATRANS",  "MIRROR", "ROT",      "AROT",
    "SCALE",  "SPOS",   "LIMS",    "STOPRE", "PCALL",  "ASCALE", "AMIRROR",
};

constexpr std::string_view kInnerWords[] = {
    "GOTOF", "GOTOB", "GOTO",  "GOTOC", "AND", "OR",   "XOR",   "NOT",  "DIV",     "MOD",  "B_AND",
    "B_OR",  "B_XOR", "B_NOT", "TO",    "OF",  "TRUE", "FALSE", "CASE", "DEFAULT", "TURN",
};

}  // namespace

const ForeignWord* FindForeignWord(std::string_view word) {
  for (const ForeignWord& foreign : kForeignWords) {
    if (IsWord(word, foreign.text)) return &foreign;
  }
  return nullptr;
}

const ForeignOperatorWord* FindForeignOperator(std::string_view word) {
  for (const ForeignOperatorWord& foreign : kForeignOperators) {
    if (IsWord(word, foreign.text)) return &foreign;
  }
  return nullptr;
}

const char* InsteadOfCode(std::string_view code) {
  const std::size_t digits = code.find_first_not_of('0', 1);
  if (code.empty() || digits == std::string_view::npos) return nullptr;
  for (const ForeignCode& foreign : kForeignCodes) {
    if (Upper(code[0]) == foreign.text[0] && code.substr(digits) == foreign.text.substr(1)) return foreign.help;
  }
  return nullptr;
}

std::string_view NearStatementWord(std::string_view word) {
  const std::string_view near = NearName(word, kStatementWords);
  return near.empty() ? NearCodeWord(word) : near;
}

std::string_view NearCodeWord(std::string_view word) {
  std::vector<std::string_view> known;
  for (const auto& row : words::Codes().Rows()) {
    if (row.text.size() > 3 && IsLetter(row.text[1])) known.push_back(row.text);
  }
  return NearName(word, known);
}

std::string_view NearInnerWord(std::string_view word) { return NearName(word, kInnerWords); }

std::string_view NearAddress(std::string_view word) {
  std::vector<std::string_view> known;
  for (const auto& row : words::Addresses()) {
    if (row.text.size() > 1) known.push_back(row.text);
  }
  return NearName(word, known);
}

std::string_view NearValueWord(std::string_view word) {
  std::vector<std::string_view> known{"TRUE", "FALSE"};
  for (const auto& row : words::Functions()) known.push_back(row.text);
  return NearName(word, known);
}

bool LooksLikeNumber(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    const char upper = Upper(c);
    return IsDigit(c) || c == '.' || upper == 'O' || upper == 'I' || upper == 'L';
  });
}

std::string AsDigits(std::string_view word) {
  std::string digits;
  for (const char c : word) {
    const char upper = Upper(c);
    digits += upper == 'O' ? '0' : upper == 'I' || upper == 'L' ? '1' : c;
  }
  return digits;
}

std::string AsNumberWord(std::string_view word) {
  if (word.size() < 2 || !LooksLikeNumber(word.substr(1))) return {};
  const std::string digits = AsDigits(word.substr(1));
  // GO for G0, and more letters only where a digit stands among them.
  const bool digit = word.size() == 2 || std::any_of(word.begin() + 1, word.end(), IsDigit);
  return digit && digits != word.substr(1) ? std::string(1, word[0]) + digits : std::string();
}

std::string AsAddressWithValue(std::string_view word) {
  std::size_t letters = 0;
  while (letters < word.size() && (IsLetter(word[letters]) || word[letters] == '_')) ++letters;
  if (letters < 2 || letters == word.size()) return {};
  for (std::size_t i = letters; i < word.size(); ++i) {
    if (!IsDigit(word[i]) && word[i] != '.' && word[i] != '-') return {};
  }
  for (const auto& row : words::Addresses()) {
    if (IsWord(word.substr(0, letters), row.text))
      return std::string(word.substr(0, letters)) + "=" + std::string(word.substr(letters));
  }
  return {};
}

std::string AsModeWithValue(std::string_view word) {
  std::size_t letters = 0;
  while (letters < word.size() && IsLetter(word[letters])) ++letters;
  if (letters == word.size() || !std::all_of(word.begin() + static_cast<std::ptrdiff_t>(letters), word.end(), IsDigit))
    return {};
  for (const auto& row : words::ValueModes()) {
    if (IsWord(word.substr(0, letters), row.text))
      return std::string(word.substr(0, letters)) + "(" + std::string(word.substr(letters)) + ")";
  }
  return {};
}

std::string AsWordAndAxis(std::string_view word) {
  for (const std::string_view first : kStatementWords) {
    if (word.size() < first.size() + 2 || !IsWord(word.substr(0, first.size()), first)) continue;
    const std::string_view rest = word.substr(first.size());
    if (IsLetter(rest[0]) && std::all_of(rest.begin() + 1, rest.end(), IsDigit))
      return std::string(word.substr(0, first.size())) + " " + std::string(rest);
  }
  return {};
}

namespace {

/// `R1`, `G0`, `X10`, `N30`.
bool IsAddressAndNumber(std::string_view word) {
  return word.size() > 1 && IsLetter(word[0]) && std::all_of(word.begin() + 1, word.end(), IsDigit);
}

bool IsType(std::string_view word) {
  return std::ranges::any_of(words::Types(), [&](const auto& row) { return IsWord(word, row.text); });
}

std::string Split(std::string_view word, std::size_t at) {
  return std::string(word.substr(0, at)) + " " + std::string(word.substr(at));
}

}  // namespace

std::string AsRunTogether(std::string_view word, Behind behind) {
  struct First {
    std::string_view text;
    Behind behind;      // with which any name may have run into it
    bool with_address;  // an address and its number show the slip, whatever follows
  };
  // Longer words stand in front of those that they begin with. Words that labels begin with (LOOP, FOR, IF) need more.
  static constexpr First kFirst[] = {
      {"ENDWHILE", Behind::kAnything, true}, {"ENDLOOP", Behind::kAnything, true}, {"ENDFOR", Behind::kAnything, true},
      {"ENDIF", Behind::kAnything, true},    {"ELSE", Behind::kAnything, true},    {"STOPRE", Behind::kAnything, true},
      {"SUPA", Behind::kAnything, true},     {"ATRANS", Behind::kAnything, true},  {"TRANS", Behind::kAnything, true},
      {"AMIRROR", Behind::kAnything, true},  {"MIRROR", Behind::kAnything, true},  {"ASCALE", Behind::kAnything, true},
      {"SCALE", Behind::kAnything, true},    {"AROT", Behind::kAnything, true},    {"WHILE", Behind::kComparison, true},
      {"UNTIL", Behind::kComparison, true},  {"IF", Behind::kComparison, false},   {"FOR", Behind::kTo, false},
      {"CASE", Behind::kOf, true},           {"PROC", Behind::kType, false},       {"EXTERN", Behind::kType, false},
  };
  if (IsWord(word.substr(0, 3), "DEF") && IsType(word.substr(std::min<std::size_t>(3, word.size()))))
    return Split(word, 3);
  for (const First& first : kFirst) {
    if (word.size() < first.text.size() + 2 || !IsWord(word.substr(0, first.text.size()), first.text)) continue;
    const bool any = behind != Behind::kAnything && behind == first.behind;
    if (any || (first.with_address && IsAddressAndNumber(word.substr(first.text.size()))))
      return Split(word, first.text.size());
  }
  return {};
}

std::string AsRunTogetherInside(std::string_view word) {
  for (const std::string_view first :
       {"B_AND", "B_XOR", "B_OR", "B_NOT", "AND", "XOR", "NOT", "MOD", "DIV", "OR", "TO", "OF"}) {
    if (word.size() <= first.size() || !IsWord(word.substr(0, first.size()), first)) continue;
    const std::string_view rest = word.substr(first.size());
    if (IsAddressAndNumber(rest) || std::all_of(rest.begin(), rest.end(), IsDigit)) return Split(word, first.size());
  }
  return {};
}

std::string AsTypeAndName(std::string_view word) {
  // Types of other languages are one word.
  for (const std::string_view type : {"INTEGER", "BOOLEAN", "CHARACTER"}) {
    if (IsWord(word, type)) return {};
  }
  for (const auto& row : words::Types()) {
    const std::string_view type = row.text;
    if (word.size() >= type.size() + 2 && IsWord(word.substr(0, type.size()), type) && IsLetter(word[type.size()]))
      return Split(word, type.size());
  }
  return {};
}

std::string AsJumpAndLabel(std::string_view word) {
  std::string jumps;
  for (const std::string_view jump : {"GOTOF", "GOTOB", "GOTOC", "GOTO"}) {
    if (word.size() < jump.size() + 2 || !IsWord(word.substr(0, jump.size()), jump)) continue;
    jumps += (jumps.empty() ? "" : " or ") + Split(word, jump.size());
  }
  return jumps;
}

}  // namespace ncport::frontend::sinumerik
