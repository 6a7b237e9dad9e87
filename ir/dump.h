// A module as text, for people, tests and fuzzers. ParseDump (ir/parse_dump.h) reads it back without loss:
//
//   ncport-ir 1
//   file ring.spf
//   spelling G1 rule "sinumerik-8.2"
//   space R 0..299 real kept all zero
//   program RING sub @ring.spf:1 header
//     param ALLOW real parameter initial 0.5:real
//     @ring.spf:1 : header RING
//     @ring.spf:2 N10 label AGAIN : motion linear {as G1}; axis X absolute = add:real(variable:real ALLOW, 10.50:real)
//       ; end-of-block "down to the face"
//     @ring.spf:3 link +4 : if = gt!tolerance:bool(cell:real R[1], 5:real)
//
// One record a line; indentation is for the eye. A block starts with the place it came from. Words follow the colon:
// name, what index and extra mean, `= value`, attributes in braces. Expressions are an operation or a literal as
// written, then flags with
// `!`, the type with `:`, the columns with `@`, the operands. Names stand bare or in quotes; `NAME~2` is the second
// record of that name; `-` is a missing entry. `//` starts a comment. What a module under verification holds by mistake
// prints as
// `?number`, which ParseDump refuses.
#pragma once

#include <string_view>

#include "base/text_buffer.h"
#include "ir/module.h"

namespace ncport::ir {

/// Deepest expression that dumps, parsers of dumps and the verifier accept. Readers of source text stop well before.
inline constexpr unsigned kMaxExprDepth = 1000;
/// Longest chain of Origin::via.
inline constexpr unsigned kMaxOriginDepth = 1000;

struct DumpOptions {
  bool places = true;     // columns of words, expressions and variables; without them the dump is easier to read
  bool spellings = true;  // spelling and written digits of words
  BlockId marked;         // a comment line with `mark` follows this block, or the whole dump if it is in no program
  std::string_view mark = {};
};

/// Appends the dump. Every module can be dumped, also one that does not verify.
void Dump(const Module& module, TextBuffer& out, const DumpOptions& options = {});

}  // namespace ncport::ir
