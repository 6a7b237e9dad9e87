#include "frontend/sinumerik/reader.h"

#include <string>

#include "dialects/finding_alarms.h"
#include "frontend/common/add_spaces.h"
#include "frontend/common/block_sink.h"
#include "frontend/common/chars.h"
#include "frontend/common/line_error.h"
#include "frontend/common/module_mark.h"
#include "frontend/common/recipe_source.h"
#include "frontend/common/report_line_error.h"
#include "frontend/common/token_listener.h"
#include "frontend/sinumerik/hints.h"
#include "frontend/sinumerik/lower.h"
#include "frontend/sinumerik/meant_marks.h"
#include "frontend/sinumerik/parser.h"
#include "frontend/sinumerik/reader_state.h"
#include "frontend/sinumerik/token_source.h"
#include "frontend/sinumerik/word_slips.h"
#include "ir/structure.h"

namespace ncport::frontend::sinumerik {

namespace {

constexpr std::string_view kTokenNames[] = {
    "None",
#define NCPORT_TOKEN(Name) #Name,
#include "frontend/sinumerik/token_kinds.def"
};

using diag::Code;
using ir::WordOp;
using K = TokenKind;

bool EndsWithWord(std::string_view text, std::string_view upper) {
  return text.size() > upper.size() && IsWord(text.substr(text.size() - upper.size()), upper);
}

/// Position of the word `upper` in `text`, letters around it not counted as a border; npos = not there.
bool Contains(std::string_view text, std::string_view upper) {
  for (std::size_t i = 0; i + upper.size() <= text.size(); ++i) {
    if (IsWord(text.substr(i, upper.size()), upper)) return true;
  }
  return false;
}

/// Mark that a refused block would have been, so that its partner is not a stray.
WordOp MarkOf(K structure, std::span<const Token> tokens, std::string_view text) {
  switch (structure) {
    case K::kIf:
      return Contains(text, "GOTO") ? WordOp::kMotion : WordOp::kIf;
    case K::kElse:
      return WordOp::kElse;
    case K::kEndIf:
      return WordOp::kEndIf;
    case K::kWhile:
      return WordOp::kWhile;
    case K::kEndWhile:
      return WordOp::kEndWhile;
    case K::kFor:
      return WordOp::kFor;
    case K::kEndFor:
      return WordOp::kEndFor;
    case K::kLoop:
      return WordOp::kLoop;
    case K::kEndLoop:
      return WordOp::kEndLoop;
    case K::kRepeat:
      return !tokens.empty() && static_cast<K>(tokens.back().kind) == K::kRepeat ? WordOp::kRepeat : WordOp::kMotion;
    case K::kUntil:
      return WordOp::kUntil;
    default:
      return WordOp::kMotion;
  }
}

class Reader {
 public:
  Reader(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
         ir::Module& module, diag::Sink& sink)
      : files_(files),
        file_(file),
        profile_(profile),
        options_(options),
        module_(module),
        sink_(sink),
        source_(module.strings),
        lowering_(module, profile, state_),
        recipes_(MakeParser, options.shape_cache),
        blocks_(files, file, module) {}

  void Read() {
    const std::string_view name = files_.Name(file_);
    state_.definition_file = EndsWithWord(name, ".DEF");
    const bool main = EndsWithWord(name, ".MPF") || (!EndsWithWord(name, ".SPF") && !EndsWithWord(name, ".CPF") &&
                                                     !state_.definition_file && module_.programs.Empty());
    const std::uint32_t lines = files_.LineCount(file_);
    for (std::uint32_t line = FirstLine(lines); line <= lines; ++line) {
      const std::string_view text = files_.Line(file_, line);
      if (!text.empty() && text[0] == '%' && ReadFileMark(text, line)) continue;
      if (!state_.program.Valid())
        StartProgram(PlainProgramName(name), main ? ir::ProgramKind::kMain : ir::ProgramKind::kSub);
      ReadLine(text, line);
    }
    EndProgram();
  }

 private:
  /// Empty lines in front of the first header are no program of their own (the leader of a punch tape).
  [[nodiscard]] std::uint32_t FirstLine(std::uint32_t lines) const {
    for (std::uint32_t line = 1; line <= lines; ++line) {
      const std::string_view text = TrimEnd(files_.Line(file_, line));
      if (text.empty()) continue;
      return IsHeader(text) ? line : 1;
    }
    return 1;
  }

  void StartProgram(std::string_view name, ir::ProgramKind kind) {
    EndProgram();
    ir::Program program;
    program.name = module_.strings.Intern(name);
    program.kind = kind;
    program.file = file_;
    program.library = options_.library;
    program.blocks.begin = static_cast<std::uint32_t>(module_.blocks.Size());
    state_.program = module_.programs.Add(program);
    state_.macros.Clear();
    state_.named_by_header = false;
    state_.definitions_open = true;
    state_.other_language = false;
    state_.no_program = false;
  }

  void EndProgram() {
    if (!state_.program.Valid()) return;
    ir::Program& program = module_.programs[state_.program];
    program.blocks.count = static_cast<std::uint32_t>(module_.blocks.Size()) - program.blocks.begin;
    TakeMeantEnds(files_, module_, state_.program, blocks_, sink_);
    ir::BuildStructure(module_, state_.program, 0, sink_, MarkName);
    state_.program = {};
  }

  /// `%_N_NAME_MPF` or `%NAME_MPF` starts a program (card 1.1).
  static bool IsHeader(std::string_view mark) {
    if (mark.size() < 5 || mark[0] != '%') return false;
    const std::string_view name = mark.substr(1);
    return IsWord(name.substr(0, 3), "_N_") || EndsWithWord(name, "_MPF") || EndsWithWord(name, "_SPF");
  }

  /// Card 1.1: archives hold data and masks of the operator too, under headers of the same form.
  static bool IsDataHeader(std::string_view name) {
    for (const std::string_view ending : {"_COM", "_INI", "_TEA", "_TOA", "_UFR", "_RPA", "_WPD", "_ARC"}) {
      if (EndsWithWord(name, ending)) return true;
    }
    return false;
  }

  // Any other line with % only frames the text.
  bool ReadFileMark(std::string_view text, std::uint32_t line) {
    const std::string_view mark = TrimEnd(text);
    const std::string_view name = mark.substr(1);
    const bool main = EndsWithWord(name, "_MPF");
    const bool definitions = EndsWithWord(name, "_DEF");
    if (IsHeader(mark)) {
      StartProgram(PlainProgramName(name), main ? ir::ProgramKind::kMain : ir::ProgramKind::kSub);
      state_.named_by_header = true;
      state_.definition_file = definitions;
      if (IsDataHeader(name)) {
        state_.no_program = true;
        sink_.Report(Code::kNotSupported, {file_, line, 0, static_cast<std::uint32_t>(mark.size())}, mark).help =
            "this part of the archive is no program and is not looked at";
      }
    } else if (!state_.program.Valid()) {
      return false;
    } else if (mark.size() > 1) {
      return false;
    }
    blocks_.AddFileMark(line, mark, "sinumerik-1.1");
    return true;
  }

  void ReadLine(std::string_view text, std::uint32_t line) {
    ir::Block block = blocks_.New(line);
    source_.Lex(text, state_.macros);
    if (options_.tokens != nullptr) options_.tokens->OnTokens(file_, line, text, source_.Tokens(), kTokenNames);
    block.indent = static_cast<std::uint16_t>(std::min<std::uint32_t>(source_.Indent(), 0xFFFF));
    const std::span<const Token> tokens = source_.Tokens();
    if (state_.other_language || state_.no_program) {
      block.indent = 0;
      if (!text.empty()) Refuse(text, block, 0, WordOp::kMotion);
      if (Contains(text, "G290")) state_.other_language = false;
      blocks_.Add(block);
      return;
    }
    if (!tokens.empty() || source_.Error() != nullptr) {
      lowering_.ReplayHead(tokens, block);
      if (const LineError* error = Words(text, line, block)) {
        error = ExplainLines(*error, text, line);
        ReportLineError(*error, text, {file_, line, 0, 0}, sink_, AlarmOf(*error, text));
        Refuse(text, block, HeadEnd(tokens, source_.Indent()), MarkOfRefused(*error, text));
      }
    }
    if (source_.Comment() != TokenSource::kNoComment) AddComment(text, tokens.empty(), block);
    blocks_.Add(block);
  }

  // Words of the block; null = done, else why not. What was added is then taken back.
  const LineError* Words(std::string_view text, std::uint32_t line, ir::Block& block) {
    const std::span<const Token> tokens = source_.Tokens();
    if (source_.Error() != nullptr) {
      error_ = *source_.Error();
      if (error_.code == Code::kUnknownCode && IsFrameOf802S(text.substr(error_.begin, error_.length))) {
        error_.code = Code::kNotSupported;
        return &error_;
      }
      if (ExplainNewName(tokens, text, error_, help_)) return &error_;
      // `DEF REAL RND`: an address of several letters without `=`, where it was to be a name.
      if (error_.code == Code::kMissingValue && error_.length > 1 && !tokens.empty() &&
          static_cast<K>(tokens.front().kind) == K::kDef)
        error_ = {.code = Code::kReservedName, .begin = error_.begin, .length = error_.length};
      ExplainWord(text, error_, help_);
      if (help_.empty() && error_.help == nullptr) ExplainComment(tokens, text, error_, help_);
      return &error_;
    }
    if (const Token* refused = source_.Refused()) {
      error_ = {.begin = refused->offset, .length = refused->length};
      if (ExplainNewName(tokens, text, error_, help_)) return &error_;
      const bool other_language = IsWord(text.substr(refused->offset, refused->length), "G291");
      state_.other_language = other_language;
      // A word of the control where a definition wants a new name.
      const bool named = tokens.size() > 1 && static_cast<K>(tokens.front().kind) == K::kDef;
      error_ = {.code = other_language ? Code::kOtherLanguage
                        : named        ? Code::kReservedName
                                       : Code::kNotSupported,
                .begin = refused->offset,
                .length = refused->length};
      ExplainRefused(text.substr(refused->offset, refused->length));
      ExplainFrameSign(text, refused->offset, error_, help_);
      ExplainFramePart(text, error_, help_);
      return &error_;
    }
    const Recipe& recipe = recipes_.Of(tokens);
    if (recipe.failed) {
      error_ = ErrorOf(recipe.error, tokens);
      if (ExplainNewName(tokens, text, error_, help_)) return &error_;
      if (IsOldCall(tokens, recipe.error.token)) {
        error_.code = Code::kNotSupported;
        error_.help = "a call of old cycles behind its R parameters: give it a block of its own";
        return &error_;
      }
      if (error_.help == nullptr || error_.code == Code::kNotAlone) {
        ExplainSyntax(tokens, recipe.error.token, text, error_, help_);
      }
      return &error_;
    }
    const ModuleMark mark(module_);
    if (!lowering_.Replay(recipe, tokens, text, line, block)) {
      mark.Rollback(module_);
      block.words.count = 0;
      return &lowering_.Error();
    }
    if (const LineError* late = lowering_.Warning()) {
      ReportLineError(*late, text, {file_, line, 0, 0}, sink_);
      block.flags |= ir::Block::kRefused;
    }
    if (state_.definitions_open && !lowering_.OnlyDefinitions()) CloseDefinitions(block);
    return nullptr;
  }

  /// `R01=1 R02=0. L903`: the row in which old programs hand a cycle its values, which their controls run.
  [[nodiscard]] static bool IsOldCall(std::span<const Token> tokens, std::size_t call) {
    const auto kind = [&](std::size_t token) { return static_cast<K>(tokens[token].kind); };
    if (call + 1 != tokens.size() || kind(call) != K::kSubName) return false;
    std::size_t at = 0;
    if (kind(at) == K::kBlockNumber) ++at;
    if (at == call) return false;
    while (at < call) {
      if (at + 2 >= call || kind(at) != K::kCell || kind(at + 1) != K::kEquals) return false;
      at += 2;
      if (kind(at) == K::kMinus && at + 1 < call) ++at;
      if (kind(at++) != K::kNumber) return false;
    }
    return true;
  }

  /// G5 I1 J1 K1 and the frames of the smallest control (card 11).
  [[nodiscard]] bool IsFrameOf802S(std::string_view code) const {
    if (!profile_.sinumerik.family.Is(dialects::SinumerikSettings::Family::k802S)) return false;
    return IsWord(code, "G5") || IsWord(code, "G158") || IsWord(code, "G258") || IsWord(code, "G259");
  }

  /// A word of the control that is more likely a slip: `Rl` for R1, DO behind WHILE.
  void ExplainRefused(std::string_view word) {
    const bool mixed = Upper(word[0]) == word[0] && word.size() > 1 && Upper(word[1]) != word[1];
    if (const std::string number = AsNumberWord(word); mixed && !number.empty()) {
      help_ = "did you mean " + number + "?";
    } else if (source_.StructureWord() == K::kFor && IsWord(word, "DO")) {
      error_.code = Code::kExpectedText;
      error_.detail = "TO";
      return;
    } else if (const ForeignWord* foreign = FindForeignWord(word);
               foreign != nullptr && source_.StructureWord() != K::kNone) {
      help_ = foreign->help;
    } else {
      return;
    }
    error_.code = Code::kUnknownWord;
    error_.help = help_.c_str();
  }

  /// The alarm that the control raises. It has one of its own for G codes; M codes go to the builder's part.
  [[nodiscard]] std::string_view AlarmOf(const LineError& error, std::string_view text) const {
    if (error.code == Code::kUnknownCode && (error.begin >= text.size() || Upper(text[error.begin]) != 'G')) return {};
    return dialects::AlarmFor(profile_, error.code);
  }

  /// Lines that belong together but cannot: there is no continuation line.
  const LineError* ExplainLines(const LineError& error, std::string_view text, std::uint32_t line) {
    const bool second = broken_line_ != 0 && broken_line_ + 1 == line;
    const bool goes_on = GoesOn(text);
    if (!second && !goes_on) return &error;
    error_ = error;
    if (second) {
      ExplainSecondLine(files_.Line(file_, broken_line_), broken_line_, text, error_, help_);
    } else {
      help_ = "a block ends with its line: write what stands in the next line behind it";
      error_.help = help_.c_str();
    }
    broken_line_ = goes_on ? line : 0;
    return &error_;
  }

  // Words that only tell the editor or the simulation something may stand before definitions.
  void CloseDefinitions(const ir::Block& block) {
    for (const ir::WordId id : block.words) {
      const WordOp op = module_.words[id].op;
      if (op != WordOp::kInert && op != WordOp::kWorkpiece) state_.definitions_open = false;
    }
  }

  static std::uint32_t HeadEnd(std::span<const Token> tokens, std::uint32_t indent) {
    std::uint32_t end = indent;
    for (const Token& token : tokens) {
      const auto kind = static_cast<K>(token.kind);
      if (kind != K::kSkip && kind != K::kBlockNumber && kind != K::kMainNumber && kind != K::kLabel) break;
      end = token.End();
      if (kind == K::kLabel) break;
    }
    return end;
  }

  /// The mark that the block in `text` would have been.
  [[nodiscard]] WordOp MarkOfRefused(const LineError& error, std::string_view text) const {
    const WordOp mark = MarkOf(source_.StructureWord(), source_.Tokens(), TrimEnd(text));
    if (mark != WordOp::kMotion || error.code != Code::kUnknownWord) return mark;
    const std::size_t first = TrimEnd(text.substr(0, error.begin)).size();
    if (first > HeadEnd(source_.Tokens(), source_.Indent())) return WordOp::kMotion;
    const WordOp meant = MeantMark(text.substr(error.begin, error.length));
    return meant == WordOp::kIf && Contains(text, "GOTO") ? WordOp::kMotion : meant;
  }

  // Keeps the text of the block behind its number and label. `mark`: what it would have been in a structure.
  void Refuse(std::string_view text, ir::Block& block, std::uint32_t begin, WordOp mark) {
    const std::uint32_t end =
        source_.Comment() != TokenSource::kNoComment && !state_.other_language && !state_.no_program
            ? source_.Comment()
            : static_cast<std::uint32_t>(text.size());
    blocks_.KeepRefused(text, begin, end, mark, block);
  }

  void AddComment(std::string_view text, bool own_line, ir::Block& block) {
    const std::uint32_t at = source_.Comment();
    ir::Comment comment;
    comment.text = module_.strings.Intern(TrimEnd(text.substr(at + 1)));
    if (!own_line) {
      comment.place = ir::CommentPlace::kEndOfBlock;
      comment.gap = GapBefore(text, at);
    }
    block.comments = {module_.comments.Add(comment).value, 1};
  }

  const SourceFiles& files_;
  FileId file_;
  const dialects::Profile& profile_;
  const ReadOptions& options_;
  ir::Module& module_;
  diag::Sink& sink_;
  ReaderState state_;
  TokenSource source_;
  Lowering lowering_;
  RecipeSource recipes_;
  BlockSink blocks_;
  LineError error_;
  std::string help_;               // of error_
  std::uint32_t broken_line_ = 0;  // line that went on in the next one; 0 = none
};

}  // namespace

std::string_view PlainProgramName(std::string_view name) {
  const std::size_t folder = name.find_last_of("/\\");
  if (folder != std::string_view::npos) name.remove_prefix(folder + 1);
  const std::size_t dot = name.find_last_of('.');
  if (dot != std::string_view::npos && dot != 0) name = name.substr(0, dot);
  if (name.size() > 3 && IsWord(name.substr(0, 3), "_N_")) name.remove_prefix(3);
  for (const std::string_view ending : {"_MPF", "_SPF", "_CPF", "_DEF"}) {
    if (EndsWithWord(name, ending)) {
      name.remove_suffix(ending.size());
      break;
    }
  }
  return name;
}

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink) {
  const std::size_t errors = sink.ErrorCount();
  AddSpaces(profile, module);
  Reader(files, file, profile, options, module, sink).Read();
  return sink.ErrorCount() == errors ? Status{} : Status{Failure{}};
}

}  // namespace ncport::frontend::sinumerik
