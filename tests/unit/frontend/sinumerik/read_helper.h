// Reads a text as SINUMERIK programs and shows what came of it.
#pragma once

#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
#include "ir/dump.h"
#include "ir/verify.h"

namespace ncport::frontend::sinumerik {

struct ReadResult {
  SourceFiles files;
  FileId file;
  ir::Module module;
  diag::Sink sink;

  /// "NC2001 1:5 message" of each finding, in the order found.
  [[nodiscard]] std::string Findings() const {
    std::string all;
    for (const diag::Diagnostic& finding : sink.All()) {
      all += std::string(diag::InfoOf(finding.code).number) + " " + std::to_string(finding.at.line) + ":" +
             std::to_string(finding.at.begin + 1) + " " + finding.message + "\n";
    }
    return all;
  }
  [[nodiscard]] std::string Dump() const {
    TextBuffer text;
    ir::Dump(module, text, {.places = false});
    return std::string(text.View());
  }
  /// Word `index` of the block in `line` of the input.
  [[nodiscard]] const ir::Word& WordAt(std::uint32_t line, std::uint32_t index = 0) const {
    const ir::Block& block = BlockAt(line);
    REQUIRE(index < block.words.count);
    return module.words[block.words[index]];
  }
  [[nodiscard]] const ir::Block& BlockAt(std::uint32_t line) const {
    for (const ir::Block& block : module.blocks.All()) {
      const ir::Origin& origin = module.origins[block.origin];
      if (origin.file == file && origin.line == line) return block;
    }
    FAIL("no block in line ", line);
    return module.blocks.All().front();
  }
  [[nodiscard]] const ir::Expr& ExprOf(ir::ExprId id) const {
    REQUIRE(id.Valid());
    return module.exprs[id];
  }
};

struct ReadWith {
  std::string_view profile = "sinumerik-840d-mill";
  std::string_view name = "TEST.MPF";
  bool resolve = true;
  bool cache = true;
};

inline void ReadInto(ReadResult& result, std::string_view text, const ReadWith& with = {}) {
  result.file = result.files.Add(std::string(with.name), std::string(text));
  const dialects::Profile profile = dialects::BuiltIn(with.profile);
  (void)ReadFile(result.files, result.file, profile, {.shape_cache = with.cache}, result.module, result.sink);
  if (with.resolve) ResolveNames(result.files, result.module, profile, result.sink);
  const auto violation = ir::FindViolation(result.module, {.names_resolved = with.resolve, .structure_built = false});
  CHECK_MESSAGE(!violation, *violation);
}

}  // namespace ncport::frontend::sinumerik
