// One block has many spellings: without blanks, full of blanks, in lower case. All read the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "frontend/common/chars.h"
#include "frontend/sinumerik/token_source.h"
#include "read_helper.h"

namespace ncport::frontend::sinumerik {

namespace {

bool IsWordChar(char c) { return IsLetter(c) || IsDigit(c) || c == '_'; }

enum class Spelling { kCompact, kBlanks, kLower };

std::string Respell(std::string_view line, Spelling spelling) {
  StringPool strings;
  TokenSource source(strings);
  source.Lex(line, {});
  REQUIRE(source.Error() == nullptr);
  std::string out;
  std::string_view before;
  for (const Token& token : source.Tokens()) {
    std::string_view text = line.substr(token.offset, token.length);
    const auto kind = static_cast<TokenKind>(token.kind);
    if (spelling == Spelling::kLower) {
      out += line.substr(out.size(), token.offset - out.size());
      for (const char c : text)
        out += kind == TokenKind::kText || IsDigit(c) ? c : static_cast<char>(IsLetter(c) ? Upper(c) + 32 : c);
      continue;
    }
    if (spelling == Spelling::kBlanks) {
      if (!out.empty()) out += " \t";
      const bool address = text.size() > 1 && IsLetter(text[0]) &&
                           (IsDigit(text[1]) || text[1] == '-' || text[1] == '.') && kind != TokenKind::kName &&
                           kind != TokenKind::kLabel;
      if (address) {
        out += text[0];
        out += "  ";
        text.remove_prefix(1);
      }
      out += text;
      continue;
    }
    // A blank where two words would join: behind an identifier, or digits behind digits.
    if (!before.empty() && IsWordChar(before.back()) && IsWordChar(text[0])) {
      const bool identifier =
          before.size() > 1 && !IsDigit(before[0]) && !IsDigit(before[1]) && before[1] != '-' && before[1] != '.';
      if (identifier || IsDigit(text[0]) || before.size() == 1) out += ' ';
    }
    out += text;
    before = text;
  }
  return out;
}

std::string Folded(std::string text) {
  for (char& c : text) c = Upper(c);
  return text;
}

const std::vector<std::string> kBlocks = {
    "N10 G1 X=R24+R106 F=R9*2",
    "G0 G90 X-10.5 Y=R25 Z.5",
    "N20 G2 X10 Y20 I=AC(5) J-3 TURN=2",
    "CIP X20 Y0 Z0 I1=10 J1=10 K1=0 F100",
    "G3 X0 Y10 CR=-12.5 RND=2",
    "R1=5 R2=R1+1 R[R1+1]=R2*-3",
    "AA_A=1 BB_B=2 CC_C=ABS(AA_A)",
    "IF (AA_A<=1) AND (AA_A>0.001) GOTOF MARK1",
    "IF AA_A==0 GOTOF MARK1 IF AA_A==BB_B GOTOB MARK2",
    "CASE BB_B OF 1 GOTOF MARK1 -2 GOTOB MARK2 DEFAULT GOTO MARK1",
    "MSG(\"LAYER \"<<AA_A+1<<\" of \"<<BB_B)",
    "SETAL(65000,\"Text \"<<(AA_A+1))",
    "TT_T=\"i:\"<<BB_B<<\"/v:\"<<AA_A",
    "T=\"MILL 10\" D1 M6",
    "S2=500 M2=3 LIMS=3000",
    "G4 F2.5",
    "TRANS X10 Y=AA_A",
    "AROT RPL=90",
    "G111 X20 Y10",
    "G1 RP=50 AP=IC(30)",
    "SPOS=DC(90)",
    "WHILE NOT(AA_A==1) OR (BB_B MOD 2<>0)",
    "FOR BB_B=1 TO 10 DIV 3",
    "UP_P(1,,AA_A,\"x\") P=3",
    "L785 P3",
    "MCALL CYCLE82(10,0,2,,15,1.5)",
    "MCALL",
    "REPEAT MARK1 MARK2 P=2",
    "REPEATB MARK1 P=BB_B",
    "FF_F[0]=SET(1,2,,4)",
    "FF_F[1]=REP(7,2)",
    "X=-(R1+2)",
    "R1='H1F' R2=1.5EX-3",
    "M=QU(5)",
    "M30",
};

}  // namespace

TEST_CASE("four spellings of a block read the same") {
  for (const std::string& block : kBlocks) {
    const auto read = [&](const std::string& text) {
      ReadResult result;
      const std::string end = block.starts_with("WHILE") ? "ENDWHILE\n" : block.starts_with("FOR") ? "ENDFOR\n" : "";
      ReadInto(result, text + "\n" + end, {.resolve = false});
      CHECK_MESSAGE(result.sink.Empty(), text, "\n", result.Findings());
      return Folded(result.Dump());
    };
    const std::string as_written = read(block);
    for (const Spelling spelling : {Spelling::kCompact, Spelling::kBlanks, Spelling::kLower}) {
      const std::string respelled = Respell(block, spelling);
      CHECK_MESSAGE(read(respelled) == as_written, block, "\n", respelled);
    }
  }
}

}  // namespace ncport::frontend::sinumerik
