// Writes programs of Fanuc Custom Macro B and its Mazak and Haas variants. Prints one word of the IR as one piece of
// text and decides nothing: raise.cc has made the module one that can be said, and CheckLegal has checked it.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/text_buffer.h"
#include "dialects/profile.h"
#include "ir/module.h"

namespace ncport::backends::fanuc {

/// Which block an output line shows.
struct PrintedLine {
  std::uint32_t line = 0;  // 1-based
  ir::BlockId block;
  bool added = false;  // not from the source (Block::kAdded)
};

/// Comment in front of blocks that the translator added, with their number behind it (contracts section 6).
inline constexpr std::string_view kAddedMark = "NCPORT ADDS BLOCKS: ";

/// The blocks of one program, a line each; added ones have a mark in front. `lines` (may be null) gets a row for each.
void PrintProgram(const ir::Module& module, ir::ProgramId program, const dialects::Profile& profile, TextBuffer& out,
                  std::vector<PrintedLine>* lines);

/// `text` as the inside of a comment or message: capital letters, no brackets, ASCII; what has no such form becomes
/// '.'. `blank`: written for blanks (messages of #3000 take '*').
void AppendCommentText(TextBuffer& out, std::string_view text, char blank = ' ');

}  // namespace ncport::backends::fanuc
