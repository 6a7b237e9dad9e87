#include "frontend/iso/reader.h"

#include <algorithm>

#include "frontend/common/block_sink.h"
#include "frontend/common/chars.h"
#include "frontend/common/module_mark.h"
#include "frontend/common/recipe_source.h"
#include "frontend/common/report_line_error.h"
#include "frontend/common/token_listener.h"
#include "frontend/iso/lower.h"
#include "frontend/iso/parser.h"
#include "frontend/iso/token_kind.h"
#include "frontend/iso/token_source.h"
#include "ir/builder.h"

namespace ncport::frontend::iso {
namespace {

constexpr std::string_view kTokenNames[] = {
    "None",
#define NCPORT_TOKEN(Name) #Name,
#include "frontend/iso/token_kinds.def"
};

using K = TokenKind;

class Reader {
 public:
  Reader(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
         ir::Module& module, diag::Sink& sink)
      : files_(files),
        file_(file),
        options_(options),
        module_(module),
        sink_(sink),
        source_(profile),
        lowering_(module, profile),
        recipes_(MakeParser, options.shape_cache),
        blocks_(files, file, module) {}

  void Read() {
    ir::Program program;
    program.name = module_.strings.Intern(NameOfFile(files_.Name(file_)));
    program.kind = ir::ProgramKind::kMain;
    program.file = file_;
    program.blocks.begin = static_cast<std::uint32_t>(module_.blocks.Size());
    const std::uint32_t lines = files_.LineCount(file_);
    for (std::uint32_t line = 1; line <= lines; ++line) ReadLine(files_.Line(file_, line), line);
    program.blocks.count = static_cast<std::uint32_t>(module_.blocks.Size()) - program.blocks.begin;
    module_.programs.Add(program);
  }

 private:
  static std::string_view NameOfFile(std::string_view name) {
    const std::size_t folder = name.find_last_of("/\\");
    if (folder != std::string_view::npos) name.remove_prefix(folder + 1);
    const std::size_t dot = name.find_last_of('.');
    return dot == std::string_view::npos || dot == 0 ? name : name.substr(0, dot);
  }

  static constexpr double kMostNumber = 999999999;  // of a block; digits are counted for short numbers only

  void ReadLine(std::string_view text, std::uint32_t line) {
    if (TrimEnd(text) == "%") {
      blocks_.AddFileMark(line, "%", "iso-1");
      return;
    }
    ir::Block block = blocks_.New(line);
    source_.Lex(text);
    if (options_.tokens != nullptr) options_.tokens->OnTokens(file_, line, text, source_.Tokens(), kTokenNames);
    block.indent = static_cast<std::uint16_t>(std::min<std::uint32_t>(source_.Indent(), 0xFFFF));
    const std::span<const Token> tokens = source_.Tokens();
    if (!tokens.empty() && static_cast<K>(tokens[0].kind) == K::kBlockNumber && tokens[0].number <= kMostNumber) {
      block.number = static_cast<std::uint32_t>(tokens[0].number);
      block.number_digits = tokens[0].digits;
    }
    if (const LineError* error = Words(text, block)) {
      ReportLineError(*error, text, {file_, line, 0, 0}, sink_);
      Refuse(text, block);
    } else {
      AddComments(text, tokens, block);
    }
    blocks_.Add(block);
  }

  const LineError* Words(std::string_view text, ir::Block& block) {
    if (source_.Error() != nullptr) return source_.Error();
    const std::span<const Token> tokens = source_.Tokens();
    if (tokens.empty()) return nullptr;
    const Recipe& recipe = recipes_.Of(tokens);
    if (recipe.failed) {
      error_ = ErrorOf(recipe.error, tokens);
      return &error_;
    }
    const ModuleMark mark(module_);
    if (lowering_.Replay(recipe, tokens, text, block)) return nullptr;
    mark.Rollback(module_);
    block.words.count = 0;
    return &lowering_.Error();
  }

  void Refuse(std::string_view text, ir::Block& block) {
    blocks_.KeepRefused(text, block.indent, static_cast<std::uint32_t>(text.size()), ir::WordOp::kMotion, block);
    block.number = ir::Block::kNoNumber;  // it stands in the text
    block.number_digits = 0;
  }

  void AddComments(std::string_view text, std::span<const Token> tokens, ir::Block& block) {
    const auto comments = source_.Comments();
    block.comments.begin = static_cast<std::uint32_t>(module_.comments.Size());
    for (const TokenSource::Comment& found : comments) {
      ir::Comment comment;
      comment.text = module_.strings.Intern(text.substr(found.begin, found.length));
      comment.gap = found.gap;
      comment.place = tokens.empty()                  ? ir::CommentPlace::kOwnLine
                      : found.tokens == tokens.size() ? ir::CommentPlace::kEndOfBlock
                                                      : ir::CommentPlace::kBeforeWord;
      if (comment.place == ir::CommentPlace::kBeforeWord) {
        // Words and tokens differ by the block number and by words of two tokens: the word that begins behind it.
        const std::uint32_t at = tokens[found.tokens].offset;
        for (const ir::WordId id : block.words) {
          if (module_.words[id].begin < at) ++comment.word;
        }
      }
      module_.comments.Add(comment);
    }
    block.comments.count = static_cast<std::uint32_t>(comments.size());
  }

  const SourceFiles& files_;
  FileId file_;
  const ReadOptions& options_;
  ir::Module& module_;
  diag::Sink& sink_;
  TokenSource source_;
  Lowering lowering_;
  RecipeSource recipes_;
  BlockSink blocks_;
  LineError error_;
};

}  // namespace

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink) {
  const std::size_t errors = sink.ErrorCount();
  Reader(files, file, profile, options, module, sink).Read();
  return sink.ErrorCount() == errors ? Status{} : Status{Failure{}};
}

}  // namespace ncport::frontend::iso
