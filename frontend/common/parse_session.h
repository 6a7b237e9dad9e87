// A generated parser fed with our tokens: kinds only, one block at a time. The first thing that does not fit ends the
// parse; ANTLR's exceptions stay in here.
#pragma once

#include <antlr4-runtime.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "frontend/common/block_parser.h"
#include "frontend/common/token.h"

namespace ncport::frontend {

/// Hands out the kinds of a block, then the end.
class KindSource final : public antlr4::TokenSource {
 public:
  void Reset(std::span<const Token> tokens) {
    tokens_ = tokens;
    next_ = 0;
  }

  std::unique_ptr<antlr4::Token> nextToken() override {
    const std::size_t kind = next_ < tokens_.size() ? tokens_[next_].kind : antlr4::Token::EOF;
    ++next_;
    return std::make_unique<antlr4::CommonToken>(kind, std::string());
  }
  [[nodiscard]] std::size_t getLine() const override { return 1; }
  std::size_t getCharPositionInLine() override { return next_; }
  antlr4::CharStream* getInputStream() override { return nullptr; }
  std::string getSourceName() override { return {}; }
  antlr4::TokenFactory<antlr4::CommonToken>* getTokenFactory() override {
    return antlr4::CommonTokenFactory::DEFAULT.get();
  }

 private:
  std::span<const Token> tokens_;
  std::size_t next_ = 0;
};

/// Stops at the first error and remembers the token and the only kind that would have fitted there (0 = several).
class FirstErrorStrategy final : public antlr4::DefaultErrorStrategy {
 public:
  [[nodiscard]] std::size_t ErrorToken() const { return token_; }
  [[nodiscard]] std::size_t OnlyExpected() const { return expected_; }

  void recover(antlr4::Parser* parser, std::exception_ptr error) override {
    expected_ = 0;
    token_ = parser->getCurrentToken()->getTokenIndex();
    try {
      std::rethrow_exception(error);
    } catch (const antlr4::RecognitionException& e) {
      if (e.getOffendingToken() != nullptr) token_ = e.getOffendingToken()->getTokenIndex();
    } catch (...) {
    }
    throw antlr4::ParseCancellationException();
  }
  antlr4::Token* recoverInline(antlr4::Parser* parser) override {
    token_ = parser->getCurrentToken()->getTokenIndex();
    const antlr4::misc::IntervalSet expected = parser->getExpectedTokens();
    expected_ = expected.size() == 1 ? static_cast<std::size_t>(expected.getMinElement()) : 0;
    throw antlr4::ParseCancellationException();
  }
  void sync(antlr4::Parser*) override {}
  void reportError(antlr4::Parser*, const antlr4::RecognitionException&) override {}

 private:
  std::size_t token_ = 0;
  std::size_t expected_ = 0;
};

/// Members in order of construction = order of life.
template <class Parser>
class ParseSession {
 public:
  ParseSession() : stream_(&source_), strategy_(std::make_shared<FirstErrorStrategy>()), parser_(&stream_) {
    parser_.removeErrorListeners();
    parser_.setErrorHandler(strategy_);
  }

  /// Tree of the block, valid until the next call; null = the tokens are no block, see Strategy().
  typename Parser::BlockContext* Parse(std::span<const Token> tokens) {
    source_.Reset(tokens);
    stream_.setTokenSource(&source_);
    parser_.setTokenStream(&stream_);
    try {
      return parser_.block();
    } catch (const antlr4::ParseCancellationException&) {
      return nullptr;
    }
  }
  [[nodiscard]] const FirstErrorStrategy& Strategy() const { return *strategy_; }

 private:
  KindSource source_;
  antlr4::CommonTokenStream stream_;
  std::shared_ptr<FirstErrorStrategy> strategy_;
  Parser parser_;
};

/// The way of a block to its recipe. A language says how a tree is compiled and how a finding is put.
template <class Parser>
class GrammarParser : public BlockParser {
 public:
  Recipe Parse(std::span<const Token> tokens) final {
    Recipe recipe;
    if (auto* block = session_.Parse(tokens)) {
      Compile(*block, recipe);
      return recipe;
    }
    const FirstErrorStrategy& strategy = session_.Strategy();
    recipe.failed = true;
    recipe.error.token = static_cast<std::uint16_t>(strategy.ErrorToken());
    recipe.error.expected = NameOfKind(strategy.OnlyExpected());
    recipe.error.code = recipe.error.expected != nullptr ? diag::Code::kExpectedText : diag::Code::kUnexpectedText;
    Explain(tokens, strategy.OnlyExpected(), recipe.error);
    return recipe;
  }

 private:
  virtual void Compile(typename Parser::BlockContext& block, Recipe& recipe) = 0;
  /// What a person would call the only kind that fits (0 = several do); null: the finding names what stands there.
  virtual const char* NameOfKind(std::size_t /*kind*/) const { return nullptr; }
  /// Says more of a mistake: another code or place, what helps. `expected`: the only kind that would have fitted.
  virtual void Explain(std::span<const Token> /*tokens*/, std::size_t /*expected*/, ShapeError& /*error*/) const {}

  ParseSession<Parser> session_;
};

}  // namespace ncport::frontend
