// Syntax errors that tell their cause: what a typing error at this place mostly is. Nothing here decides whether a
// block is right; it is asked only about blocks that are wrong.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "frontend/common/line_error.h"
#include "frontend/common/token.h"

namespace ncport::frontend::sinumerik {

/// A block that the parser did not take: `at` is the first token that does not fit, tokens.size() = the end of the
/// block. Moves `error` to the word that is wrong where that is another one, and sets its help; `help` keeps the text.
void ExplainSyntax(std::span<const Token> tokens, std::size_t at, std::string_view line, LineError& error,
                   std::string& help);

/// `G0TOF`, `G0T0B`: a jump word with zeros for its letters O falls apart into G0 and what follows. True if that is so:
/// the error is moved to the word and names the jump.
bool ExplainJumpWithZeros(std::string_view line, LineError& error, std::string& help);

/// A character or word that the tokens do not know.
void ExplainWord(std::string_view line, LineError& error, std::string& help);

/// `$P_UIFR[1,X,TX]`: a part of a settable frame that does not exist.
void ExplainFramePart(std::string_view line, LineError& error, std::string& help);

/// `FINISH CUT`: a block of words alone, at least two of three letters, is a comment whose sign is missing.
void ExplainComment(std::span<const Token> tokens, std::string_view line, LineError& error, std::string& help);

/// Card 1.2: a word at the place of a new name, in DEF or behind a type of PROC, that cannot be a name: an address, a
/// number, an R parameter, other signs. True if that is so; the error is then the whole word.
bool ExplainNewName(std::span<const Token> tokens, std::string_view line, LineError& error, std::string& help);

/// Card 8.7: frames are chained with `:`. If another operator stands beside a function that makes a frame, it becomes
/// the finding; `word` is the first word of the control that ncport does not translate.
void ExplainFrameSign(std::string_view line, std::uint32_t word, LineError& error, std::string& help);

/// True if the line stops in the middle of a list or an expression in brackets, as texts do that were printed in a
/// narrow column: there is no continuation line.
bool GoesOn(std::string_view line);

/// The line behind such a one, which starts in the middle. A parameter that both lines together declare twice becomes
/// the finding.
void ExplainSecondLine(std::string_view before, std::uint32_t line_before, std::string_view line, LineError& error,
                       std::string& help);

}  // namespace ncport::frontend::sinumerik
