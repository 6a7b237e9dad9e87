#include "ir/dump.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

#include "app/ncport.h"
#include "app/pipeline.h"
#include "base/diag/place.h"
#include "base/utf8.h"
#include "frontend/common/token_listener.h"
#include "ir/analysis/cfg.h"

namespace ncport {
namespace {

/// `main.mpf:3:1 BlockNumber "N10"`, one token a line.
class TokenDump final : public frontend::TokenListener {
 public:
  TokenDump(const SourceFiles& files, TextBuffer& out) : files_(files), out_(out) {}
  void OnTokens(FileId file, std::uint32_t line, std::string_view text, std::span<const frontend::Token> tokens,
                std::span<const std::string_view> kinds) override {
    for (const frontend::Token& token : tokens) {
      const std::string_view before = text.substr(0, token.offset);
      const std::string_view written = before.size() < token.offset ? std::string_view{} : text.substr(token.offset);
      out_.Append(fmt::format("{}:{}:{} {} \"{}\"\n", files_.Name(file), line, CountUtf8(before) + 1, kinds[token.kind],
                              diag::OneLine(written.substr(0, token.length))));
    }
  }

 private:
  const SourceFiles& files_;
  TextBuffer& out_;
};

}  // namespace

Status Dump(Context& context, std::vector<Input> inputs, const DumpOptions& options, OutputSink& output) {
  app::ProgramSet set;
  TextBuffer text;
  TokenDump tokens(context.files, text);
  const bool wants_tokens = options.stage == DumpStage::kTokens;
  // A program with errors can be looked at too: its refused blocks are marked.
  const Status read = app::ReadSet(context, std::move(inputs), options, app::ProfileNeed::kGuess, set,
                                   wants_tokens ? &tokens : nullptr);
  if (set.module.programs.Empty()) return read;
  if (options.stage == DumpStage::kCfg) {
    ir::analysis::DumpCfg(set.module, text);
  } else if (!wants_tokens) {
    ir::Dump(set.module, text);
  }
  return read & output.Flush(text);
}

}  // namespace ncport
