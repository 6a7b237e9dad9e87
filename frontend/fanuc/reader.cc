#include "frontend/fanuc/reader.h"

#include <algorithm>

#include "dialects/finding_alarms.h"
#include "frontend/common/add_spaces.h"
#include "frontend/common/block_sink.h"
#include "frontend/common/chars.h"
#include "frontend/common/line_error.h"
#include "frontend/common/module_mark.h"
#include "frontend/common/recipe_source.h"
#include "frontend/common/report_line_error.h"
#include "frontend/common/token_listener.h"
#include "frontend/fanuc/hints.h"
#include "frontend/fanuc/lower.h"
#include "frontend/fanuc/parser.h"
#include "frontend/fanuc/reader_state.h"
#include "frontend/fanuc/token_source.h"
#include "ir/structure.h"

namespace ncport::frontend::fanuc {

namespace {

constexpr std::string_view kTokenNames[] = {
    "None",
#define NCPORT_TOKEN(Name) #Name,
#include "frontend/fanuc/token_kinds.def"
};

using diag::Code;
using ir::WordOp;
using K = TokenKind;

/// Mark that a refused block would have been, so that its partner is not a stray. kMotion: none.
WordOp MarkOf(K structure, std::span<const Token> tokens) {
  const auto has = [&](K kind) {
    return std::ranges::any_of(tokens, [&](const Token& token) { return static_cast<K>(token.kind) == kind; });
  };
  switch (structure) {
    case K::kIf:
      return !tokens.empty() && static_cast<K>(tokens.back().kind) == K::kThen ? WordOp::kIf : WordOp::kMotion;
    case K::kElse:
      return WordOp::kElse;
    case K::kEndIf:
      return WordOp::kEndIf;
    case K::kWhile:
      return WordOp::kWhile;
    case K::kDo:
      return has(K::kWhile) ? WordOp::kWhile : WordOp::kLoop;
    case K::kEnd:
      return WordOp::kEndWhile;
    default:
      return WordOp::kMotion;
  }
}

/// A mark as programs write it.
std::string_view MarkName(WordOp mark) {
  switch (mark) {
    case WordOp::kIf:
      return "IF";
    case WordOp::kElse:
      return "ELSE";
    case WordOp::kEndIf:
      return "ENDIF";
    case WordOp::kWhile:
      return "WHILE";
    case WordOp::kLoop:
      return "DO";
    case WordOp::kEndWhile:
    case WordOp::kEndLoop:
      return "END";
    default:
      return NameOf(mark);
  }
}

class Reader {
 public:
  Reader(const SourceFiles& files, FileId file, const dialects::Profile& profile, dialects::fanuc::System system,
         const ReadOptions& options, ir::Module& module, diag::Sink& sink)
      : files_(files),
        file_(file),
        profile_(profile),
        options_(options),
        module_(module),
        sink_(sink),
        source_(module.strings, profile.fanuc.expression_without_brackets.Or(false)),
        lowering_(module, profile, system, state_),
        recipes_(MakeParser, options.shape_cache),
        blocks_(files, file, module) {}

  void Read() {
    const std::uint32_t lines = files_.LineCount(file_);
    StartProgram(ProgramNameOfFile(files_.Name(file_)));
    for (std::uint32_t line = 1; line <= lines; ++line) {
      const std::string_view text = files_.Line(file_, line);
      if (ReadFileMark(text, line)) continue;
      std::uint32_t begin = 0;
      do {
        begin = ReadBlock(text, line, begin);
      } while (begin < text.size() && !TrimEnd(text.substr(begin)).empty());
    }
    EndProgram();
  }

 private:
  void StartProgram(std::string_view name) {
    EndProgram();
    ir::Program program;
    program.name = module_.strings.Intern(name);
    program.kind = module_.programs.Empty() ? ir::ProgramKind::kMain : ir::ProgramKind::kSub;
    program.file = file_;
    program.library = options_.library;
    program.blocks.begin = static_cast<std::uint32_t>(module_.blocks.Size());
    state_.program = module_.programs.Add(program);
    state_.program_used = false;
    state_.loops.clear();
  }

  void EndProgram() {
    if (!state_.program.Valid()) return;
    ir::Program& program = module_.programs[state_.program];
    program.blocks.count = static_cast<std::uint32_t>(module_.blocks.Size()) - program.blocks.begin;
    ir::BuildStructure(module_, state_.program, 0, sink_, MarkName);
    state_.program = {};
  }

  // `%` opens and closes the record; text behind the first one is a leader (fanuc-1).
  bool ReadFileMark(std::string_view text, std::uint32_t line) {
    const std::string_view mark = TrimEnd(text);
    if (mark.empty() || mark[0] != '%') return false;
    blocks_.AddFileMark(line, mark, "fanuc-1");
    return true;
  }

  // A head begins the next program; the first head names the one that the file began with.
  void Head(std::span<const Token> tokens, std::uint32_t line) {
    for (const Token& token : tokens) {
      const auto kind = static_cast<K>(token.kind);
      if (kind == K::kSkip || kind == K::kBlockNumber) continue;
      if (kind != K::kProgramNumber && kind != K::kName) return;
      const std::string name = kind == K::kName ? std::string(module_.View(token.Text()))
                                                : ProgramName(static_cast<std::uint32_t>(token.number));
      if (state_.program_used) StartProgram(name);
      ir::Program& program = module_.programs[state_.program];
      program.name = module_.strings.Intern(name);
      program.has_header = true;
      program.header_line = line;
      state_.program_used = true;
      return;
    }
  }

  // Returns the byte where the next block of the line begins.
  std::uint32_t ReadBlock(std::string_view text, std::uint32_t line, std::uint32_t begin) {
    source_.Lex(text, begin);
    if (options_.tokens != nullptr) options_.tokens->OnTokens(file_, line, text, source_.Tokens(), kTokenNames);
    const std::span<const Token> tokens = source_.Tokens();
    if (!tokens.empty()) Head(tokens, line);
    ir::Block block = blocks_.New(line);
    block.indent = static_cast<std::uint16_t>(std::min<std::uint32_t>(source_.Indent(), 0xFFFF));
    std::uint32_t used_comment = Lowering::kNoComment;
    if (!tokens.empty() || source_.Error() != nullptr) {
      state_.program_used = true;
      lowering_.ReplayHead(tokens, block);
      if (const LineError* error = Words(text, block)) {
        ReportLineError(*error, text, {file_, line, 0, 0}, sink_, dialects::AlarmFor(profile_, error->code));
        Refuse(text, block, begin);
      } else {
        used_comment = lowering_.TextComment();
        if (lowering_.Repeated()) {
          const LineError& error = lowering_.Error();
          const SourceRange at{file_, line, error.begin, error.begin + error.length};
          sink_.ReportAs(diag::Severity::kWarning, error.code, at, text.substr(error.begin, error.length)).help =
              error.help;
        }
      }
    }
    AddComments(text, used_comment, block);
    blocks_.Add(block);
    return source_.Next();
  }

  // Words of the block; null = done, else why not. What was added is then taken back.
  const LineError* Words(std::string_view text, ir::Block& block) {
    const std::span<const Token> tokens = source_.Tokens();
    if (source_.Error() != nullptr) {
      error_ = *source_.Error();
      ExplainError(text, error_, help_);
      return &error_;
    }
    if (const Token* refused = source_.Refused()) {
      error_ = {.code = Code::kNotSupported, .begin = refused->offset, .length = refused->length};
      return &error_;
    }
    const Recipe& recipe = recipes_.Of(tokens);
    if (recipe.failed) {
      error_ = ErrorOf(recipe.error, tokens);
      ExplainError(text, error_, help_);
      return &error_;
    }
    const ModuleMark mark(module_);
    if (!lowering_.Replay(recipe, tokens, source_.Comments(), text, block)) {
      mark.Rollback(module_);
      block.words.count = 0;
      error_ = lowering_.Error();
      ExplainError(text, error_, help_);
      return &error_;
    }
    return nullptr;
  }

  // Keeps the text of the block behind its number, without the comments at its end.
  void Refuse(std::string_view text, ir::Block& block, std::uint32_t begin) {
    const std::span<const Token> tokens = source_.Tokens();
    for (const Token& token : tokens) {
      const auto kind = static_cast<K>(token.kind);
      if (kind != K::kSkip && kind != K::kBlockNumber) break;
      begin = token.End();
    }
    std::uint32_t end = source_.End();
    for (const CommentPart& comment : source_.Comments()) {
      if (comment.token == tokens.size() && source_.Error() == nullptr) {
        end = comment.open;
        break;
      }
    }
    WordOp mark = MarkOf(source_.StructureWord(), tokens);
    if (mark == WordOp::kWhile || mark == WordOp::kLoop) state_.loops.push_back({0, mark == WordOp::kLoop});
    if (mark == WordOp::kEndWhile && !state_.loops.empty()) {
      if (state_.loops.back().endless) mark = WordOp::kEndLoop;
      state_.loops.pop_back();
    }
    blocks_.KeepRefused(text, begin, end, mark, block);
  }

  // Comments between words go to the word behind them; the text of an alarm is part of its word.
  void AddComments(std::string_view text, std::uint32_t used, ir::Block& block) {
    const std::span<const Token> tokens = source_.Tokens();
    const std::span<const CommentPart> comments = source_.Comments();
    const bool refused = (block.flags & ir::Block::kRefused) != 0;
    for (std::uint32_t i = 0; i < comments.size(); ++i) {
      if (i == used) continue;
      const CommentPart& part = comments[i];
      ir::Comment comment;
      comment.text = module_.strings.Intern(text.substr(part.begin, part.end - part.begin));
      if (tokens.empty()) {
        comment.place = ir::CommentPlace::kOwnLine;
      } else if (part.token >= tokens.size()) {
        comment.place = ir::CommentPlace::kEndOfBlock;
        comment.gap = GapBefore(text, part.open);
      } else {
        if (refused) continue;  // it stands in the text that was kept
        comment.place = ir::CommentPlace::kBeforeWord;
        std::uint16_t word = 0;
        while (word < block.words.count && module_.words[block.words[word]].begin < part.open) ++word;
        comment.word = word;
      }
      const ir::CommentId id = module_.comments.Add(comment);
      if (block.comments.count == 0) block.comments.begin = id.value;
      ++block.comments.count;
    }
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
  std::string help_;  // of error_
};

}  // namespace

std::string ProgramName(std::uint32_t number) { return "O" + std::to_string(number); }

std::string ProgramNameOfFile(std::string_view name) {
  const std::size_t folder = name.find_last_of("/\\");
  if (folder != std::string_view::npos) name.remove_prefix(folder + 1);
  const std::size_t dot = name.find_last_of('.');
  if (dot != std::string_view::npos && dot != 0) name = name.substr(0, dot);
  std::string_view digits = name;
  if (!digits.empty() && Upper(digits[0]) == 'O') digits.remove_prefix(1);
  std::uint32_t number = 0;
  std::size_t count = 0;
  while (count < digits.size() && count < 9 && IsDigit(digits[count]))
    number = number * 10 + static_cast<std::uint32_t>(digits[count++] - '0');
  const bool ends = count == digits.size() || !(IsLetter(digits[count]) || IsDigit(digits[count]));
  if (count != 0 && count <= 8 && ends && number != 0) return ProgramName(number);
  return std::string(name);
}

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink) {
  const std::size_t errors = sink.ErrorCount();
  const auto system = dialects::fanuc::SystemOf(profile);
  if (!system) {
    dialects::ReportOpenKey(profile, "series", {file, 0, 0, 0}, sink);
    return Failure{};
  }
  AddSpaces(profile, module);
  Reader(files, file, profile, *system, options, module, sink).Read();
  return sink.ErrorCount() == errors ? Status{} : Status{Failure{}};
}

}  // namespace ncport::frontend::fanuc
