// Passes on dumps: text in, pass, text out.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <regex>
#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "ir/dump.h"
#include "ir/parse_dump.h"
#include "ir/verify.h"

namespace ncport::ir::test {

/// What BlocksOf writes besides words, labels and numbers.
enum class Show : std::uint8_t {
  kPlain,
  kMarks  // also skip levels, flags of blocks, and the comments below each block
};

/// The blocks of a program as the dump has them, without places, one a line, each without its origin: what stands
/// behind the first " : ". Labels and numbers stay in front of it.
inline std::string BlocksOf(const Module& module, Show show = Show::kPlain) {
  TextBuffer out;
  DumpOptions options;
  options.places = options.spellings = false;
  Dump(module, out, options);
  std::string blocks;
  std::string_view text = out.View();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with("program ")) blocks += std::string(line.substr(0, line.find(" @"))) + "\n";
    if (show == Show::kMarks && line.starts_with("    ; ")) blocks += std::string(line) + "\n";
    if (!line.starts_with("  @")) continue;
    // Origins name the pass and the block it was made near: of no interest here.
    const std::size_t colon = line.find(" : ");
    if (show == Show::kMarks) {
      const std::string_view head = line.substr(0, colon);
      const std::size_t skip = head.find(" skip ");
      if (skip != std::string_view::npos) {
        blocks += std::string(head.substr(skip + 1, head.find(' ', skip + 6) - skip - 1)) + " ";
      }
      for (const std::string_view flag : {" main-block", " skip-digit", " added", " refused"}) {
        if (head.find(flag) != std::string_view::npos) blocks += std::string(flag.substr(1)) + " ";
      }
    }
    for (const std::string_view key : {" label ", " N"}) {
      const std::size_t at = line.find(key);
      if (at != std::string_view::npos && at < colon) {
        const std::size_t from = at + 1;
        const std::size_t to = line.find(' ', key == " label " ? at + key.size() : from);
        blocks += std::string(line.substr(from, std::min(to, line.size()) - from)) + " ";
      }
    }
    blocks += colon == std::string_view::npos ? std::string("-") : std::string(line.substr(colon + 3));
    blocks += '\n';
  }
  return blocks;
}

/// `before`, a dump, after `pass`; the pass may leave findings in `sink`.
inline std::string After(std::string_view before, diag::Sink& sink,
                         const std::function<bool(Module&, diag::Sink&)>& pass, Show show = Show::kPlain) {
  Result<Module> module = ParseDump(before, sink);
  REQUIRE_MESSAGE(module.Ok(), (sink.Empty() ? "" : sink.All().front().message));
  const bool done = pass(module.Value(), sink);
  if (done) CHECK(FindViolation(module.Value()).value_or("") == "");
  return BlocksOf(module.Value(), show);
}

/// `blocks` without the types of expressions and the remark that a number was computed: easier to read where neither
/// matters.
inline std::string WithoutTypes(const std::string& blocks) {
  const std::string numbers = std::regex_replace(blocks, std::regex("literal\\(([-0-9.e+]+), computed\\)"), "$1");
  return std::regex_replace(numbers, std::regex(":(real|int|bool|number|string|any)\\b"), "");
}

/// `blocks` with R[1] for the cell 1 of a space R, as dumps want it.
inline std::string WithCells(std::string_view blocks) {
  const std::string cells = std::regex_replace(std::string(blocks), std::regex("R\\["), "cell:real R[");
  return std::regex_replace(cells, std::regex("cell-at cell:real R"), "cell-at:real R");
}
/// The other way round, and WithoutTypes.
inline std::string Brief(const std::string& blocks) {
  return std::regex_replace(WithoutTypes(blocks), std::regex("cell R\\["), "R[");
}

/// The codes of all findings, in their order: "NC5001 NC5006".
inline std::string CodesOf(const diag::Sink& sink) {
  std::string codes;
  for (const diag::Diagnostic& finding : sink.All()) {
    if (!codes.empty()) codes += ' ';
    codes += diag::InfoOf(finding.code).number;
  }
  return codes;
}

}  // namespace ncport::ir::test
