// Passes on dumps: text in, pass, text out.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "ir/dump.h"
#include "ir/parse_dump.h"
#include "ir/verify.h"

namespace ncport::ir::test {

/// The blocks of a program as the dump has them, without places, one a line, each without its origin: what stands
/// behind the first " : ". Labels and numbers stay in front of it.
inline std::string BlocksOf(const Module& module) {
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
    if (!line.starts_with("  @")) continue;
    // Origins name the pass and the block it was made near: of no interest here.
    const std::size_t colon = line.find(" : ");
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
                         const std::function<bool(Module&, diag::Sink&)>& pass) {
  Result<Module> module = ParseDump(before, sink);
  REQUIRE(module.Ok());
  const bool done = pass(module.Value(), sink);
  if (done) CHECK(FindViolation(module.Value()).value_or("") == "");
  return BlocksOf(module.Value());
}

}  // namespace ncport::ir::test
