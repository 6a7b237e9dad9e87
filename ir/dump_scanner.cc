#include "ir/dump_scanner.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include "ir/dump_syntax.h"

namespace ncport::ir {

namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsKeywordChar(char c) { return (c >= 'a' && c <= 'z') || IsDigit(c) || c == '-'; }

int HexDigit(char c) {
  if (IsDigit(c)) return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

}  // namespace

void DumpScanner::Start(std::string_view line) {
  line_ = line;
  at_ = 0;
  failed_ = false;
}

std::string DumpScanner::Found() const {
  constexpr std::size_t kLongest = 24;
  if (at_ >= line_.size()) return "the end of the line";
  std::string found = "'";
  for (const char c : line_.substr(at_, kLongest)) found += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  return found + "'";
}

void DumpScanner::Fail(std::string expected) {
  if (failed_) return;
  failed_ = true;
  expected_ = std::move(expected);
}

char DumpScanner::Peek() {
  if (failed_) return '\0';
  while (at_ < line_.size() && (line_[at_] == ' ' || line_[at_] == '\t' || line_[at_] == '\r')) ++at_;
  if (at_ >= line_.size()) return '\0';
  if (line_.substr(at_, 2) == "//") {
    at_ = line_.size();
    return '\0';
  }
  // A NUL in the text is no end: it must fail as the unexpected character that it is.
  return line_[at_] == '\0' ? '\1' : line_[at_];
}

bool DumpScanner::Take(std::string_view symbol) {
  Peek();
  if (failed_ || line_.substr(at_, symbol.size()) != symbol) return false;
  at_ += symbol.size();
  return true;
}

void DumpScanner::Need(std::string_view symbol) {
  if (!Take(symbol)) Fail("'" + std::string(symbol) + "'");
}

std::string_view DumpScanner::PeekKeyword() {
  Peek();
  if (failed_) return {};
  std::size_t end = at_;
  while (end < line_.size() && IsKeywordChar(line_[end])) ++end;
  return line_.substr(at_, end - at_);
}

std::string_view DumpScanner::Keyword() {
  const std::string_view keyword = PeekKeyword();
  at_ += keyword.size();
  return keyword;
}

bool DumpScanner::TakeKeyword(std::string_view keyword) {
  if (PeekKeyword() != keyword) return false;
  at_ += keyword.size();
  return true;
}

std::uint32_t DumpScanner::Number(std::uint32_t max) {
  Peek();
  if (failed_) return 0;
  std::uint32_t value = 0;
  const char* const begin = line_.data() + at_;
  const auto [end, error] = std::from_chars(begin, line_.data() + line_.size(), value);
  if (error != std::errc{} || value > max) {
    Fail("a whole number up to " + std::to_string(max));
    return 0;
  }
  at_ += static_cast<std::size_t>(end - begin);
  return value;
}

double DumpScanner::Double() {
  Peek();
  if (failed_) return 0;
  double value = 0;
  const char* const begin = line_.data() + at_;
  const auto [end, error] = std::from_chars(begin, line_.data() + line_.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) {
    Fail("a number");
    return 0;
  }
  at_ += static_cast<std::size_t>(end - begin);
  return value;
}

bool DumpScanner::AtName() {
  const char c = Peek();
  return c == '"' || IsNameStart(c);
}

std::string_view DumpScanner::Name() {
  const char c = Peek();
  if (failed_) return {};
  if (c == '"') return Text();
  if (!IsNameStart(c)) {
    Fail("a name");
    return {};
  }
  std::size_t end = at_;
  while (end < line_.size() && IsNameChar(line_[end])) ++end;
  const std::string_view name = line_.substr(at_, end - at_);
  at_ = end;
  return name;
}

std::string_view DumpScanner::Text() {
  if (Peek() != '"') {
    Fail("a text in quotes");
    return {};
  }
  text_.clear();
  std::size_t at = at_ + 1;
  while (at < line_.size() && line_[at] != '"') {
    if (line_[at] != '\\') {
      text_ += line_[at++];
      continue;
    }
    const char kind = at + 1 < line_.size() ? line_[at + 1] : '\0';
    if (kind == '"' || kind == '\\') {
      text_ += kind;
      at += 2;
      continue;
    }
    const int high = kind == 'x' && at + 3 < line_.size() ? HexDigit(line_[at + 2]) : -1;
    const int low = high >= 0 ? HexDigit(line_[at + 3]) : -1;
    if (low < 0) {
      at_ = at;
      Fail("an escape \\\" \\\\ or \\xHH");
      return {};
    }
    text_ += static_cast<char>(high * 16 + low);
    at += 4;
  }
  if (at >= line_.size()) {
    Fail("a text that ends in its line");
    return {};
  }
  at_ = at + 1;
  return text_;
}

std::uint32_t DumpScanner::Ordinal() {
  if (failed_ || at_ >= line_.size() || line_[at_] != '~') return 1;
  ++at_;
  return Number(0xFFFFFFFEU);
}

std::string_view DumpScanner::Rest() {
  Peek();
  return failed_ ? std::string_view{} : line_.substr(at_);
}

}  // namespace ncport::ir
