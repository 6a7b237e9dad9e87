// Which language a file is in, by its ending and by words that only one language has. Nothing is weighed: one sure sign
// is enough, two signs for different languages are a contradiction that the user resolves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "base/letter_case.h"
#include "dialects/registry.h"

namespace ncport::dialects {
namespace {

constexpr std::size_t kMaxText = std::size_t{1} << 19U;  // later signs would not change the answer of a sane program

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return (c >= 'A' && c <= 'Z') || c == '_'; }

/// A line in capitals without texts and comments: `(` stays as a mark, what stands in brackets goes.
std::string CodeOf(std::string_view line) {
  std::string code;
  int depth = 0;
  bool text = false;
  for (char c : line) {
    if (c == '"') {
      text = !text;
      continue;
    }
    if (text) continue;
    if (c == ';' && depth == 0) break;
    if (c == '(') {
      if (depth++ == 0) code.push_back('(');
      continue;
    }
    if (c == ')') {
      if (depth > 0) --depth;
      continue;
    }
    if (depth > 0) continue;
    code.push_back(c == '\t' ? ' ' : Upper(c));
  }
  return code;
}

constexpr std::string_view kSinumerikWords[] = {"GOTOF",  "GOTOB",  "GOTOC",     "GOTOS",   "PROC",   "EXTERN",
                                                "MCALL",  "DIAMON", "DIAMOF",    "DIAM90",  "STOPRE", "SETAL",
                                                "ATRANS", "AROT",   "ASCALE",    "AMIRROR", "SUPA",   "ENDLOOP",
                                                "ENDFOR", "LIMS",   "WORKPIECE", "CIP",     "REPEATB"};
constexpr std::string_view kNumWords[] = {"ENDI", "ENDW", "ENDF", "ENDV"};
constexpr std::string_view kLinuxCncWords[] = {"SUB",    "ENDSUB",    "CALL",   "IF",       "ELSEIF",
                                               "ELSE",   "ENDIF",     "WHILE",  "ENDWHILE", "DO",
                                               "REPEAT", "ENDREPEAT", "RETURN", "BREAK",    "CONTINUE"};
constexpr std::string_view kTypes[] = {"INT", "REAL", "BOOL", "CHAR", "STRING", "AXIS", "FRAME"};
constexpr std::string_view kTurningCycles[] = {"CYCLE93", "CYCLE94", "CYCLE95", "CYCLE96", "CYCLE97", "CYCLE98"};

template <std::size_t Count>
bool In(const std::string_view (&words)[Count], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

struct Signs {
  std::array<std::string, kLanguages> text;  // first sign per language, empty: none
  std::string lathe[kLanguages];
};

/// Collects the signs of one line after the other.
class Scanner {
 public:
  explicit Scanner(Signs& signs) : signs_(signs) {}

  void Line(std::string_view line, std::size_t number) {
    number_ = number;
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return;
    code_ = CodeOf(line.substr(begin));
    Head(line.substr(begin));
    for (std::size_t i = 0; i < code_.size();) i = Word(i);
    const auto with = [&](std::string_view word) { return code_.find(word) != std::string::npos; };
    if (HasCode("G50") && with("S")) Lathe(Language::kFanuc, "G50 S");
    if ((HasCode("G71") || HasCode("G72")) && (with("P") || with("U") || with("W"))) Lathe(Language::kFanuc, "G71");
  }

 private:
  void Sign(Language language, std::string_view what) {
    std::string& sign = signs_.text[static_cast<std::size_t>(language)];
    if (sign.empty()) sign = fmt::format("line {}: {}", number_, what);
  }
  void Lathe(Language language, std::string_view what) {
    std::string& sign = signs_.lathe[static_cast<std::size_t>(language)];
    if (sign.empty()) sign = fmt::format("line {}: {}", number_, what);
  }
  [[nodiscard]] char At(std::size_t i) const { return i < code_.size() ? code_[i] : '\0'; }
  [[nodiscard]] std::size_t SkipBlanks(std::size_t i) const {
    while (At(i) == ' ') ++i;
    return i;
  }
  [[nodiscard]] std::size_t SkipDigits(std::size_t i) const {
    while (IsDigit(At(i))) ++i;
    return i;
  }
  /// The code stands in the line as a whole word: G5 is not G54.
  [[nodiscard]] bool HasCode(std::string_view code) const {
    for (std::size_t at = code_.find(code); at != std::string::npos; at = code_.find(code, at + 1)) {
      const char after = At(at + code.size());
      if (!IsDigit(after) && after != '.') return true;
    }
    return false;
  }

  /// What only the start of a line tells: % lines, O words, file names of programs.
  void Head(std::string_view raw) {
    const std::string_view code = code_;
    if (code.starts_with("%_N_") || code.starts_with("%MPF") || code.starts_with("%SPF")) {
      Sign(Language::kSinumerik, "a %_N_ line");
    } else if (code.starts_with('%') && IsDigit(At(1))) {
      Sign(Language::kNum, "% with a program number");
    } else if (raw.starts_with(";$PATH=")) {
      Sign(Language::kSinumerik, ";$PATH=");
    } else if (code.starts_with('<') && code.find('>') != std::string_view::npos) {
      Sign(Language::kFanuc, "a program name in < >");
    } else if (code.starts_with("O<")) {
      Sign(Language::kLinuxCnc, "O word with a name");
    } else if (code.starts_with('O') && IsDigit(At(1))) {
      const std::size_t end = SkipBlanks(SkipDigits(1));
      std::size_t word = end;
      while (IsLetter(At(word))) ++word;
      const bool structured = In(kLinuxCncWords, code.substr(end, word - end));
      Sign(structured ? Language::kLinuxCnc : Language::kFanuc, structured ? "O word before a keyword" : "an O number");
    }
  }

  /// Looks at what starts at `i` and returns where the next piece starts.
  std::size_t Word(std::size_t i) {
    const char c = At(i);
    if (c == '#') return Hash(i);
    if (c == '$' && IsLetter(At(i + 1)) && i > 0) return Dollar(i);
    if (c == '$' && IsLetter(At(i + 1)) && At(i + 2) != ' ' && code_.find('_', i) != std::string::npos)
      return Dollar(i);
    if (c == '\'' && IsLetter(At(i + 1)) && !IsDigit(At(i + 2))) {
      if (At(i + 1) != 'H' && At(i + 1) != 'B') Sign(Language::kNum, "a variable name behind '");
      return i + 2;
    }
    if (!IsLetter(c)) return i + 1;
    std::size_t end = i;
    while (IsLetter(At(end)) || IsDigit(At(end))) ++end;
    std::size_t letters = i;
    while (IsLetter(At(letters))) ++letters;
    return letters - i >= 2 ? Name(i, letters, end) : Address(i);
  }

  std::size_t Hash(std::size_t i) {
    const char next = At(SkipBlanks(i + 1));
    if (next == '<') {
      Sign(Language::kLinuxCnc, "#<name>");
    } else if (IsDigit(next) || next == '[' || next == '#') {
      Sign(Language::kFanuc, "a # variable");
    }
    return i + 1;
  }

  std::size_t Dollar(std::size_t i) {
    std::size_t end = i + 1;
    while (IsLetter(At(end))) ++end;
    const std::string_view name = std::string_view(code_).substr(i, end - i);
    if (name.find('_') != std::string_view::npos) Sign(Language::kSinumerik, name);
    return end;
  }

  /// A word of two letters and more.
  std::size_t Name(std::size_t i, std::size_t letters, std::size_t end) {
    const std::string_view whole = std::string_view(code_).substr(i, end - i);
    const std::string_view name = std::string_view(code_).substr(i, letters - i);
    const char after = At(SkipBlanks(letters));
    if (In(kSinumerikWords, whole)) Sign(Language::kSinumerik, whole);
    if (In(kNumWords, whole)) Sign(Language::kNum, whole);
    if (whole == "DIAMON" || whole == "DIAM90" || whole == "LIMS" || In(kTurningCycles, whole)) {
      Lathe(Language::kSinumerik, whole);
    }
    if (whole == "MSG" && At(SkipBlanks(end)) == '(') Sign(Language::kSinumerik, "MSG(");
    if (name == "CYCLE" && At(SkipBlanks(end)) == '(') Sign(Language::kSinumerik, whole);
    if (whole == "DEF") {
      const std::size_t type = SkipBlanks(end);
      std::size_t type_end = type;
      while (IsLetter(At(type_end))) ++type_end;
      if (In(kTypes, std::string_view(code_).substr(type, type_end - type))) Sign(Language::kSinumerik, "DEF");
    }
    if ((name == "IF" || name == "WHILE" || name == "WH") && after == '[') Sign(Language::kFanuc, name);
    if (name == "GOTO" && (IsDigit(after) || after == '#' || after == '['))
      Sign(Language::kFanuc, "GOTO with a number");
    if (name == "DPRNT" || name == "POPEN" || name == "PCLOS") Sign(Language::kFanuc, name);
    // A keyword may be glued to what follows: look at the rest letter by letter only where digits end it.
    return IsDigit(At(letters)) ? letters : end;
  }

  /// A single letter: an address, R and L variables.
  std::size_t Address(std::size_t i) {
    const char letter = At(i);
    const std::size_t value = SkipBlanks(i + 1);
    const std::size_t end = SkipDigits(value);
    const bool number = end > value;
    const std::string_view word = std::string_view(code_).substr(i, end - i);
    const std::size_t behind = SkipBlanks(end);
    if (letter == 'R' && number && At(behind) == '=' && !InCondition(i)) Sign(Language::kSinumerik, "an R parameter");
    if (letter == 'L' && number && At(behind) == '=' && !InCondition(i)) Sign(Language::kNum, "an L variable");
    const std::size_t inner = At(value) == '-' ? value + 1 : value;
    if (letter != 'L' && letter != 'N' && letter != 'G' && At(inner) == 'L' && IsDigit(At(inner + 1))) {
      Sign(Language::kNum, "an L variable behind an address");
    }
    if (word == "G79" && (At(behind) == 'L' || At(behind) == 'N' || At(behind) == 'E' || At(behind) == '[')) {
      Sign(Language::kNum, "G79 with a condition or a target");
    }
    if (word == "G77" && (At(behind) == 'H' || At(behind) == 'N')) Sign(Language::kNum, "G77 with a call");
    if (word == "G500" || word == "M17") Sign(Language::kSinumerik, word);
    if (word == "M98" || word == "M99" || (word == "G65" && code_.find('P', end) != std::string::npos)) {
      Sign(Language::kFanuc, word);
    }
    if (word == "G96") {
      for (const Language language : {Language::kFanuc, Language::kNum, Language::kSinumerik, Language::kLinuxCnc})
        Lathe(language, word);
    }
    if (word == "G7" && At(end) != '.') Lathe(Language::kLinuxCnc, word);
    if (letter == 'T' && end - value == 4 && !HasCode("M6") && !HasCode("M06")) Lathe(Language::kFanuc, word);
    if (word == "G28" && At(behind) == 'U') Lathe(Language::kFanuc, "G28 U");
    if (word == "G38" || word == "G63" || (word == "G64" && At(behind) == 'N') || (word == "G20" && At(end) != '.')) {
      Lathe(Language::kNum, word);
    }
    return number ? end : i + 1;
  }

  /// `=` in a test is no assignment (NUM: G79 L1 = 5 N20).
  [[nodiscard]] bool InCondition(std::size_t i) const { return code_.rfind("G79", i) != std::string::npos; }

  Signs& signs_;
  std::string code_;
  std::size_t number_ = 0;
};

std::string LowerEnding(std::string_view file_name) {
  const std::size_t slash = file_name.rfind('/');
  if (slash != std::string_view::npos) file_name.remove_prefix(slash + 1);
  const std::size_t point = file_name.rfind('.');
  if (point == std::string_view::npos || point == 0) return {};
  return LowerOf(file_name.substr(point));
}

struct Ending {
  std::string_view text;
  Language language;
};
constexpr Ending kEndings[] = {
    {".mpf", Language::kSinumerik}, {".spf", Language::kSinumerik}, {".cpf", Language::kSinumerik},
    {".def", Language::kSinumerik}, {".eia", Language::kFanuc},     {".xpi", Language::kNum},
    {".ngc", Language::kLinuxCnc},
};

}  // namespace

LanguageGuess GuessLanguage(std::string_view file_name, std::string_view text) {
  Signs signs;
  Scanner scanner(signs);
  text = text.substr(0, kMaxText);
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    ++number;
    scanner.Line(text.substr(0, end), number);
    if (end == std::string_view::npos) break;
    const bool pair = text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n';
    text.remove_prefix(end + (pair ? 2 : 1));
  }
  // LinuxCNC shares # variables and O numbers with Fanuc: beside signs of its own they say nothing.
  std::string& fanuc = signs.text[static_cast<std::size_t>(Language::kFanuc)];
  const std::string ending = LowerEnding(file_name);
  if (!signs.text[static_cast<std::size_t>(Language::kLinuxCnc)].empty() || ending == ".ngc") fanuc.clear();

  LanguageGuess guess;
  for (std::size_t i = 0; i < kLanguages; ++i) {
    const auto language = static_cast<Language>(i);
    std::string reason;
    for (const Ending& known : kEndings) {
      if (known.text == ending && known.language == language) reason = fmt::format("ending {}", ending);
    }
    if (!signs.text[i].empty()) reason += reason.empty() ? signs.text[i] : ", " + signs.text[i];
    if (reason.empty()) continue;
    guess.languages.push_back(language);
    guess.reasons.push_back(std::move(reason));
  }
  if (guess.Certain()) {
    guess.lathe_reason = signs.lathe[static_cast<std::size_t>(guess.languages.front())];
    guess.lathe = !guess.lathe_reason.empty();
  }
  return guess;
}

Result<Language> NeedLanguage(const LanguageGuess& guess, std::string_view file_name, const SourceRange& at,
                              diag::Sink& sink) {
  if (guess.Certain()) return guess.languages.front();
  std::string signs;
  for (std::size_t i = 0; i < guess.languages.size(); ++i) {
    signs += fmt::format("{}{} ({})", i == 0 ? "" : ", ", NameOf(guess.languages[i]), guess.reasons[i]);
  }
  if (signs.empty()) signs = "neither its ending nor a word in it speaks for one";
  sink.Report(diag::Code::kUnclearLanguage, at, file_name, signs).help =
      "name the machine with --from, or `from` in ncport.toml; `ncport list profiles` shows them";
  return Failure{};
}

}  // namespace ncport::dialects
