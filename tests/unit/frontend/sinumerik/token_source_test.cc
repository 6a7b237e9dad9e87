// Tokens of hard words (card section 2, real-programs).
#include "frontend/sinumerik/token_source.h"

#include <doctest/doctest.h>

#include <string>

namespace ncport::frontend::sinumerik {

namespace {

std::string_view NameOf(TokenKind kind) {
  switch (kind) {
#define NCPORT_TOKEN(Name) \
  case TokenKind::k##Name: \
    return #Name;
#include "frontend/sinumerik/token_kinds.def"
    case TokenKind::kNone:
      break;
  }
  return "None";
}

/// "Kind:text Kind:text", or "NCxxxx:text" of the error at the end.
std::string Lexed(std::string_view line, const Macros& macros = {}) {
  StringPool strings;
  TokenSource source(strings);
  source.Lex(line, macros);
  std::string all;
  for (const Token& token : source.Tokens()) {
    if (!all.empty()) all += ' ';
    all += std::string(NameOf(static_cast<TokenKind>(token.kind))) + ":" +
           std::string(line.substr(token.offset, token.length));
  }
  if (const LineError* error = source.Error()) {
    all += " !" + std::string(diag::InfoOf(error->code).number) + ":" +
           std::string(line.substr(error->begin, error->length));
  }
  return all;
}

}  // namespace

TEST_CASE("words without blanks") {
  CHECK(Lexed("N10G0G54X-10Y.20Z30.4EX-4T0S100M3H12") ==
        "BlockNumber:N10 Code:G0 Code:G54 AxisValue:X-10 AxisValue:Y.20 AxisValue:Z30.4EX-4 AddressValue:T0 "
        "AddressValue:S100 "
        "Code:M3 AddressValue:H12");
  CHECK(Lexed("G1X=R24+R106F=R9*2") ==
        "Code:G1 Axis:X Equals:= Cell:R24 Plus:+ Cell:R106 Address:F Equals:= Cell:R9 Star:* Number:2");
  CHECK(Lexed("G1Z=ENDPZ") == "Code:G1 Axis:Z Equals:= Name:ENDPZ");
  CHECK(Lexed("G0G90X=R24Y=R25") == "Code:G0 Code:G90 Axis:X Equals:= Cell:R24 Axis:Y Equals:= Cell:R25");
  CHECK(Lexed("G75X0M11F100.") == "Code:G75 AxisValue:X0 Code:M11 AddressValue:F100.");
  CHECK(Lexed("N10REPEAT _LBL") == "BlockNumber:N10 Repeat:REPEAT Name:_LBL");
}

TEST_CASE("blanks between address and value") {
  CHECK(Lexed("N 10 X - 10 G 1 F = 5") == "BlockNumber:N 10 AxisValue:X - 10 Code:G 1 Address:F Equals:= Number:5");
  CHECK(Lexed("X&10\tY\x01"
              "5") ==
        "AxisValue:X&10 AxisValue:Y\x01"
        "5");
}

TEST_CASE("an address, an extension, a name") {
  CHECK(Lexed("X10") == "AxisValue:X10");
  CHECK(Lexed("X1=10") == "Axis:X1 Equals:= Number:10");
  CHECK(Lexed("XA=10") == "Name:XA Equals:= Number:10");
  CHECK(Lexed("I1=3 J1=4 K1=5") ==
        "Address:I1 Equals:= Number:3 Address:J1 Equals:= Number:4 Address:K1 Equals:= Number:5");
  CHECK(Lexed("S2=500 M2=3 LIMS[2]=100") ==
        "Address:S2 Equals:= Number:500 ComputedM:M2 Equals:= Number:3 Address:LIMS LeftBracket:[ Number:2 "
        "RightBracket:] "
        "Equals:= Number:100");
  CHECK(Lexed("A1=AX[C]") == "Axis:A1 Equals:= AxisAt:AX LeftBracket:[ Axis:C RightBracket:]");
}

TEST_CASE("whole words only") {
  CHECK(Lexed("DIVISOR=MODAL+NOTCH") == "Name:DIVISOR Equals:= Name:MODAL Plus:+ Name:NOTCH");
  CHECK(Lexed("GOTOFEND") == "Name:GOTOFEND");
  CHECK(Lexed("IF(A_A>0)AND(B_B>0) GOTOF M1") ==
        "If:IF LeftParen:( Name:A_A Greater:> Number:0 RightParen:) And:AND LeftParen:( Name:B_B Greater:> Number:0 "
        "RightParen:) Goto:GOTOF Name:M1");
}

TEST_CASE("labels and jump targets") {
  CHECK(Lexed("L1:X=5") == "Label:L1: Axis:X Equals:= Number:5");
  CHECK(Lexed("N10 START :G1") == "BlockNumber:N10 Label:START : Code:G1");
  CHECK(Lexed("GOTOF START") == "Goto:GOTOF Name:START");
  CHECK(Lexed("GOTOB N20") == "Goto:GOTOB BlockNumber:N20");
  CHECK(Lexed("GOTO \"LBL\"<<R1") == "Goto:GOTO Text:\"LBL\" Concat:<< Cell:R1");
  CHECK(Lexed("REPEAT L1 L2 P=3") == "Repeat:REPEAT Name:L1 Name:L2 Passes:P Equals:= Number:3");
  CHECK(Lexed(":10 G1") == "MainNumber::10 Code:G1");
  CHECK(Lexed("/3 N5 M0") == "Skip:/3 BlockNumber:N5 Code:M0");
}

TEST_CASE("numbers") {
  CHECK(Lexed("R1='H3C7F'") == "Cell:R1 Equals:= Number:'H3C7F'");
  CHECK(Lexed("R1='B1021'") == "Cell:R1 Equals:= !NC1005:'B1021'");
  CHECK(Lexed("R1=1EX3*.5") == "Cell:R1 Equals:= Number:1EX3 Star:* Number:.5");
  CHECK(Lexed("R1=1E3") == "Cell:R1 Equals:= Number:1 !NC1016:E");
  StringPool strings;
  TokenSource source(strings);
  source.Lex("X-.1EX-3", {});
  CHECK(source.Tokens()[0].number == doctest::Approx(-0.0001));
  source.Lex("R1='HFF'", {});
  CHECK(source.Tokens()[2].number == 255);
}

TEST_CASE("texts and comments") {
  CHECK(Lexed("MSG(\"a;b\") ; c") == "Message:MSG LeftParen:( Text:\"a;b\" RightParen:)");
  StringPool strings;
  TokenSource source(strings);
  source.Lex("MSG(\"a'\"'b\")", {});
  REQUIRE(source.Tokens().size() == 4);
  CHECK(strings.View(source.Tokens()[2].Text()) == "a\"b");
  CHECK(Lexed("MSG(\"open)") == "Message:MSG LeftParen:( !NC1007:\"open)");
}

TEST_CASE("macros") {
  Macros macros;
  CHECK(macros.Add("M06", "L6"));
  CHECK(macros.Add("_OUT", "G0 Z=R1"));
  CHECK_FALSE(macros.Add("_out", "X"));
  CHECK(Lexed("N5 M06 X1", macros) == "BlockNumber:N5 SubName:M06 AxisValue:X1");
  CHECK(Lexed("_OUT+5", macros) == "Code:_OUT Axis:_OUT Equals:_OUT Cell:_OUT Plus:+ Number:5");
  CHECK(macros.Add("_TWO", "_OUT"));
  CHECK(Lexed("_TWO", macros) == " !NC1021:_TWO");
}

TEST_CASE("what makes a line unreadable") {
  CHECK(Lexed("X=(1+2") == "Axis:X Equals:= LeftParen:( Number:1 Plus:+ Number:2 !NC1006:(");
  CHECK(Lexed("X=1)") == "Axis:X Equals:= Number:1 !NC1002:)");
  CHECK(Lexed("IF R1= =2") == "If:IF Cell:R1 !NC1020:= =");
  CHECK(Lexed("G44") == "Code:G44 !NC1015:G44");
  CHECK(Lexed("X10 ?") == "AxisValue:X10 !NC1004:?");
  CHECK(Lexed("CR 5") == "Address:CR !NC1017:CR");
  CHECK(Lexed(std::string(100, '(')).find("!NC9003") != std::string::npos);
  CHECK(Lexed("R1=" + std::string(100, '-') + "1").find("!NC9003") != std::string::npos);
  CHECK(Lexed("R1=" + std::string(5000, '1')).find("!NC1005") != std::string::npos);
  CHECK(Lexed(std::string(5000, ' ') + "X1").find("!NC9006") != std::string::npos);
}

}  // namespace ncport::frontend::sinumerik
