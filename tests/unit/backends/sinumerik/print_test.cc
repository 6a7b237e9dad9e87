// Identity: text -> IR -> text gives the same words, and the same IR again.
#include "backends/sinumerik/print.h"

#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "backends/sinumerik/printer.h"
#include "base/encoding.h"
#include "base/source_files.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
#include "ir/builder.h"
#include "ir/dump.h"
#include "ir/parse_dump.h"

namespace ncport::backends::sinumerik {
namespace {

namespace fs = std::filesystem;

struct ReadBack {
  SourceFiles files;
  diag::Sink sink;
  ir::Module module;
  FileId file;
};

const dialects::Profile& Machine() {
  static const dialects::Profile profile = dialects::BuiltIn("sinumerik-840d-mill");
  return profile;
}

void ReadText(ReadBack& read, const std::string& name, std::string text) {
  read.file = read.files.Add(name, std::move(text));
  (void)frontend::ReadFile(read.files, read.file, Machine(), {}, read.module, read.sink);
}

std::string Print(const ir::Module& module, FileId file) {
  TextBuffer out;
  PrintFile(module, file, Machine(), out);
  return std::string(out.View());
}

std::string DumpOf(const ir::Module& module, bool places) {
  TextBuffer out;
  ir::Dump(module, out, {.places = places});
  return std::string(out.View());
}

/// The words of a text: no blanks outside of texts and comments, letters upper case there, no leading zeros of R cells,
/// lists with SET. What the normal form of the printer is free to choose, and nothing else.
std::string Words(const std::string& text) {
  std::string words;
  std::size_t line_begin = 0;
  char inside = 0;  // '"' or ';'
  for (const char c : text) {
    if (c == '\r') continue;
    if (c == '\n') {
      while (words.size() > line_begin && (words.back() == ' ' || words.back() == '\t')) words.pop_back();
      inside = 0;
      words += c;
      line_begin = words.size();
      continue;
    }
    if (inside == ';') {
      words += c;
      continue;
    }
    if (c == '"') inside = inside == '"' ? 0 : '"';
    if (inside == '"') {
      words += c;
      continue;
    }
    if (c == ';') inside = ';';
    if (c == ' ' || c == '\t' || c == '&') continue;
    words += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return words;
}

/// The first line in which two texts differ.
std::string FirstDifference(const std::string& a, const std::string& b) {
  std::size_t line = 1;
  std::size_t begin = 0;
  while (begin < a.size() || begin < b.size()) {
    const std::size_t end_a = std::min(a.find('\n', begin), a.size());
    const std::string line_a = begin <= a.size() ? a.substr(begin, end_a - begin) : "(end)";
    const std::size_t end_b = std::min(b.find('\n', begin), b.size());
    const std::string line_b = begin <= b.size() ? b.substr(begin, end_b - begin) : "(end)";
    if (line_a != line_b) return std::to_string(line) + ": " + line_a + "  <>  " + line_b;
    begin = end_a + 1;
    ++line;
  }
  return {};
}

std::vector<fs::path> Programs() {
  std::vector<fs::path> programs;
  for (const char* folder : {"/samples", "/tests/vectors/sinumerik", "/tests/samples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(std::string(NCPORT_SOURCE_DIR) + folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending == ".mpf" || ending == ".spf") programs.push_back(entry.path());
    }
  }
  return programs;
}

std::string Load(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return DecodeText(bytes).text;
}

TEST_CASE("every sample and vector prints as it was written and reads back as the same program") {
  const std::vector<fs::path> programs = Programs();
  REQUIRE(programs.size() >= 60);
  for (const fs::path& path : programs) {
    CAPTURE(path.filename().string());
    const std::string text = Load(path);
    ReadBack first;
    ReadText(first, path.filename().string(), text);
    const std::string printed = Print(first.module, first.file);
    // Macros are printed by what they stand for.
    if (text.find("DEFINE") == std::string::npos) CHECK(FirstDifference(Words(text), Words(printed)) == "");

    ReadBack second;
    ReadText(second, path.filename().string(), printed);
    CHECK(FirstDifference(DumpOf(first.module, false), DumpOf(second.module, false)) == "");
    CHECK(first.sink.ErrorCount() == second.sink.ErrorCount());
    // The normal form prints as itself.
    CHECK(Print(second.module, second.file) == printed);
  }
}

TEST_CASE("printing goes through the IR, not through the source: a dump read back prints the same") {
  for (const fs::path& path : Programs()) {
    CAPTURE(path.filename().string());
    ReadBack first;
    ReadText(first, path.filename().string(), Load(path));
    diag::Sink sink;
    const Result<ir::Module> again = ir::ParseDump(DumpOf(first.module, true), sink);
    for (const diag::Diagnostic& finding : sink.All()) FAIL_CHECK(finding.at.line, ": ", finding.message);
    REQUIRE(again.Ok());
    CHECK(FirstDifference(Print(first.module, first.file), Print(*again, FileId{0})) == "");
  }
}

std::string Printed(const std::string& block) {
  ReadBack read;
  ReadText(read, "test.mpf", block + "\n");
  for (const diag::Diagnostic& finding : read.sink.All()) FAIL_CHECK(finding.message);
  std::string text = Print(read.module, read.file);
  if (!text.empty()) text.pop_back();
  return text;
}

TEST_CASE("normal form of single blocks") {
  const std::pair<std::string, std::string> kForms[] = {
      {"n0010g01x-10.50f.5", "N0010 G01 X-10.50 F.5"},
      {"/G0X=R1+5Y=IC(2)", "/G0 X=R1+5 Y=IC(2)"},
      {"/1 :20 AB12: G2 X1 I=AC(3) J-2 TURN=2", "/1 :20 AB12: G2 X1 I=AC(3) J-2 TURN=2"},
      {"S2=500 M2=3 M=5 M03 M8", "S2=500 M2=3 M=5 M03 M8"},
      {"M=QU(10) M[2]=41", "M=QU(10) M2=41"},
      {"LIMS=3000 S[3]=200", "LIMS=3000 S3=200"},
      {"T=\"A'\"'B\" D1", "T=\"A'\"'B\" D1"},
      {"IF (R1==1)AND(R2<>2) GOTOF AB IF R3 GOTOB N20", "IF (R1==1) AND (R2<>2) GOTOF AB IF R3 GOTOB N20"},
      {"CASE R1 OF 1 GOTOF AA -2 GOTOB BB DEFAULT GOTO CC", "CASE R1 OF 1 GOTOF AA -2 GOTOB BB DEFAULT GOTO CC"},
      {"RING(1,,\"X\",)P=R5", "RING(1,,\"X\",) P=R5"},
      {"L10 P3", "L10 P3"},
      {"MCALL CYCLE81(10,0,2,-5)", "MCALL CYCLE81(10,0,2,-5)"},
      {"MCALL", "MCALL"},
      {"CALL \"AB\"<<R1", "CALL \"AB\"<<R1"},
      {"CALL BLOCK AA TO BB", "CALL BLOCK AA TO BB"},
      {"REPEAT AA BB P3", "REPEAT AA BB P=3"},
      {"REPEATB AA", "REPEATB AA"},
      {"LOOP\nFOR R1=1 TO 10\nENDFOR\nENDLOOP", "LOOP\nFOR R1=1 TO 10\nENDFOR\nENDLOOP"},
      {"WHILE R1>1\nREPEAT\nIF R1\nELSE\nENDIF\nUNTIL R2\nENDWHILE",
       "WHILE R1>1\nREPEAT\nIF R1\nELSE\nENDIF\nUNTIL R2\nENDWHILE"},
      {"DEF REAL LLI 0 ULI 10 AB=3,CD[2,4]=(1,2,,4)", "DEF REAL LLI 0 ULI 10 AB=3, CD[2,4]=SET(1,2,,4)"},
      {"DEF STRING[32] TEXT1=\"X\"", "DEF STRING[32] TEXT1=\"X\""},
      {"PROC RING(VAR REAL AA[3],INT BB=4) SAVE DISPLOF", "PROC RING(VAR REAL AA[3], INT BB=4) SAVE DISPLOF"},
      {"EXTERN RING(VAR REAL[3],INT)", "EXTERN RING(VAR REAL[3], INT)"},
      {"R1=-R2*(3+4)DIV 2 MOD R[R3]", "R1=-R2*(3+4) DIV 2 MOD R[R3]"},
      {"R1=NOT R2 B_AND 3", "R1=NOT R2 B_AND 3"},
      {"MSG(\"A\"<<R1<<\"B\")", "MSG(\"A\"<<R1<<\"B\")"},
      {"SETAL(65000,<<(R1+1))", "SETAL(65000,<<(R1+1))"},
      {"R1='HFF' R2=1.5EX-3 R3=+2", "R1='HFF' R2=1.5EX-3 R3=+2"},
      {"AX[R1]=IC(5)", "AX[R1]=IC(5)"},
      {"G4 F2.5", "G4 F2.5"},
      {"X1=5 C=DC(90)", "X1=5 C=DC(90)"},
      {"RET(\"AB\")", "RET(\"AB\")"},
      {"    G1 X1   ; with  gap", "    G1 X1   ; with  gap"},
      {"", ""},
  };
  for (const auto& [written, expected] : kForms) {
    const auto& text = written;  // clang captures no structured bindings
    CAPTURE(text);
    CHECK(Printed(text) == expected);
  }
}

TEST_CASE("made-up expressions get the brackets that their meaning needs") {
  ir::Module module;
  ir::ExprBuilder e(module);
  using ir::ExprOp;
  const ir::SpaceId r = ir::AddSpace(module, "R", 0, 99);
  const auto cell = [&](std::uint32_t n) { return e.Cell(r, n); };
  const auto text = [&](ir::ExprId id) {
    TextBuffer out;
    PrintExpr(module, id, Machine(), out);
    return std::string(out.View());
  };
  const ir::ExprId sum = e.Binary(ExprOp::kAdd, cell(1), cell(2));
  CHECK(text(e.Binary(ExprOp::kMultiply, sum, cell(3))) == "(R1+R2)*R3");
  CHECK(text(e.Binary(ExprOp::kSubtract, cell(3), sum)) == "R3-(R1+R2)");
  CHECK(text(e.Binary(ExprOp::kSubtract, sum, cell(3))) == "R1+R2-R3");
  CHECK(text(e.Unary(ExprOp::kNegate, sum)) == "-(R1+R2)");
  CHECK(text(e.Binary(ExprOp::kSubtract, cell(1), e.Literal(-2.5))) == "R1-(-2.5)");
  CHECK(text(e.Unary(ExprOp::kNegate, e.Literal(-1, ir::Type::kInt))) == "-(-1)");
  // Comparisons bind weakest: without brackets R1==R2 AND R3 would compare R1 with (R2 AND R3).
  const ir::ExprId equal = e.Binary(ExprOp::kEqual, cell(1), cell(2));
  CHECK(text(e.Binary(ExprOp::kAnd, equal, cell(3))) == "(R1==R2) AND R3");
  CHECK(text(e.Unary(ExprOp::kNot, equal)) == "NOT (R1==R2)");
  CHECK(text(e.Function(ir::Function::kToText, {sum}, ir::Type::kString)) == "<<R1+R2");
  CHECK(text(e.Function(ir::Function::kToText, {equal}, ir::Type::kString)) == "<<(R1==R2)");
  // A computed REAL stays one.
  CHECK(text(e.Literal(5)) == "5.");
  CHECK(text(e.Literal(5, ir::Type::kInt)) == "5");
}

TEST_CASE("a dwell that no SINUMERIK text wrote gets its G4") {
  ir::Module module;
  const FileId file = ir::AddFile(module, "d.mpf");
  ir::ExprBuilder e(module);
  ir::ProgramBuilder program(module, "D", ir::ProgramKind::kMain, file);
  program.Block(1).Add(ir::WordOp::kDwellSeconds, e.Number("2.5")).Finish();
  program.Block(2).Add(ir::WordOp::kDwellRevolutions, e.Number("3")).Finish();
  program.Finish();
  CHECK(Print(module, file) == "G4 F2.5\nG4 S3\n");
}

}  // namespace
}  // namespace ncport::backends::sinumerik
