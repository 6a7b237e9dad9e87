#include "frontend/reader.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "base/source_files.h"
#include "dialects/registry.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::frontend::fanuc {
namespace {

/// The one block `text`, read as Fanuc, as the dump has it.
std::string Block(std::string_view text, bool resolve = false) {
  SourceFiles files;
  diag::Sink sink;
  ir::Module module;
  const FileId file = files.Add("m.nc", "O1\n" + std::string(text) + "\n");
  const dialects::Profile profile = dialects::BuiltIn("fanuc-mill");
  CHECK(ReadFile(files, file, profile, {}, module, sink).Ok());
  if (resolve) ResolveNames(files, module, profile, sink);
  std::string all = ir::test::BlocksOf(module);
  // Behind the program line and that of its O word.
  all.erase(0, all.find('\n') + 1);
  all.erase(0, all.find('\n') + 1);
  return all;
}

/// The finding on the one block `text`; empty: it is read.
std::string Refusal(std::string_view text, std::string_view profile_name = "fanuc-mill") {
  SourceFiles files;
  diag::Sink sink;
  ir::Module module;
  const FileId file = files.Add("m.nc", "O1\n" + std::string(text) + "\n");
  const dialects::Profile profile = dialects::BuiltIn(profile_name);
  static_cast<void>(ReadFile(files, file, profile, {}, module, sink));
  return sink.Empty() ? "" : sink.All().front().message;
}

TEST_CASE("numbers by the decimal-point rule (fanuc-2.2)") {
  CHECK(Block("N10G0X10Y-10.5Z.5") ==
        "N10 motion rapid; axis X = 10:real {increments}; axis Y = -10.5:real; axis Z = .5:real\n");
  CHECK(Block("G 0 1 X 1 0 .") == Block("G01X10."));
  CHECK(Block("X#04") == Block("X#4"));
}

TEST_CASE("keywords glued to what stands beside them, cut to two letters, or with blanks everywhere (fanuc-2.1)") {
  const std::string jump =
      "jump forward-then-from-start number 9999 = group:bool(eq!vacant-differs:bool("
      "bit-and!operands-to-int!vacant-as-zero:real(cell:number #~2[120], 4:real), 4:real))\n";
  CHECK(Block("IF[#120AND4EQ4]GOTO9999") == jump);
  CHECK(Block("IF [ # 120 AND 4 EQ 4 ] GOTO 9999") == jump);
  CHECK(Block("IF[#120AND4EQ4]GO9999") == jump);
  CHECK(Block("N4#3000=11(TEXT)") == "N4 alarm stops \"TEXT\":string = 11:real\n");
  CHECK(Block("WH[#9LE142]DO1\nEND1") == Block("WHILE [#9 LE 142] DO 1\nEND 1"));
  CHECK(Block("DO1\nN49END1").find("N49 end-loop 1") != std::string::npos);
}

TEST_CASE("a word is an address when one letter stands alone, a keyword when two stand together") {
  CHECK(Block("D01") == "radius-offset = 01:real\n");
  CHECK(Block("DO1\nEND1") == "loop 1\nend-loop 1\n");
}

TEST_CASE("arguments of G65: list I by letters, list II when I J K repeat (fanuc-7.3)") {
  CHECK(Block("G65P9810A1.B2C#3") == "call name O9810 (1 A: 1.:real, 2 B increments: 2:real, 3 C: cell:number #[3])\n");
  CHECK(Block("G65P9810I1.J2.K3.I4.J5.") ==
        "call name O9810 (4 I: 1.:real, 5 J: 2.:real, 6 K: 3.:real, 7 I: 4.:real, 8 J: 5.:real)\n");
}

TEST_CASE("M98: repeats packed in front of four digits, in a word of their own, or none (fanuc-7.2)") {
  CHECK(Block("M98P510001", true) == "call name O1 same-level calls O1 passes literal(51, computed)!implicit:real\n");
  CHECK(Block("M98P2L5") == "call name O2 same-level passes 5:real\n");
  CHECK(Block("M98P0002") == "call name O2 same-level\n");
}

TEST_CASE("axis words beside the stroke check are its limits, beside high-speed modes no move either (fanuc-8.1)") {
  CHECK(Block("G22 X300. Z-5. I-300. K10.") ==
        "data-setting name G22 (0 X: 300.:real, 1 Z: -5.:real, 2 I: -300.:real, 3 K: 10.:real)\n");
  CHECK(Block("G90 G22") == "distance absolute; inert\n");
  CHECK(Refusal("G0 G22 X300.") == "G0 must stand alone in its block");
  CHECK(Refusal("G5.1 Q2 X0 Y0") == "G5.1 must stand alone in its block");
  CHECK(Refusal("G8 P1") == "");
}

TEST_CASE("IF THEN, a slash inside a block, a computed GOTO") {
  CHECK(
      Block("IF[#1EQ#0]THEN#1=5") ==
      "when = group:bool(eq!vacant-differs:bool(cell:number #[1], vacant:number)); assign cell:number #[1] = 5:real\n");
  CHECK(Block("G1X10./M8") == "motion linear; axis X = 10.:real; skip-rest 1; aux = 8:real\n");
  CHECK(Block("/2N15X1.").find("N15 axis X = 1.:real") != std::string::npos);
  CHECK(Block("GOTO#149") == "jump forward-then-from-start expression cell:number #~2[149]\n");
}

TEST_CASE("comments end at the last bracket of the line and may hold anything (real-programs, Fanuc 4)") {
  CHECK(Block("G0(A [B;C] #1 ( X ))") == "motion rapid\n");
  CHECK(Block("(ALONE)") == "-\n");
}

}  // namespace
}  // namespace ncport::frontend::fanuc
