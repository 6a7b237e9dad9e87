#include "frontend/iso/reader.h"

#include <doctest/doctest.h>

#include <string>

#include "dialects/registry.h"
#include "ir/dump.h"

namespace ncport::frontend::iso {
namespace {

struct ReadText {
  explicit ReadText(std::string text, const char* profile = "iso-mill", bool shape_cache = true) {
    const FileId file = files.Add("flat.nc", std::move(text));
    (void)frontend::ReadFile(files, file, dialects::BuiltIn(profile), {.shape_cache = shape_cache}, module, sink);
  }
  [[nodiscard]] std::string Dump() const {
    TextBuffer out;
    ir::Dump(module, out, {.places = false, .spellings = false});
    return std::string(out.View());
  }
  /// The code of the only finding and the text under its marker.
  [[nodiscard]] std::string Finding() const {
    if (sink.All().size() != 1) return std::to_string(sink.All().size()) + " findings";
    const diag::Diagnostic& finding = sink.All().front();
    return std::string(diag::InfoOf(finding.code).number) + " " + std::string(files.View(finding.at));
  }

  SourceFiles files;
  diag::Sink sink;
  ir::Module module;
};

bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("words of a flat block become words of the IR") {
  const ReadText read(
      "N10 G17 G21 G90 G94 G40\nG1 X10. Y-0.5 F100.\nG2 X1. Y2. I3. J-4.\nG43 H5\nG41 D7\nG4 P2.5\nG54.1 P3\n");
  CHECK(read.sink.Empty());
  const std::string dump = read.Dump();
  CHECK(Has(dump, "plane xy"));
  CHECK_MESSAGE(Has(dump, "axis X = 10.:real"), dump);
  CHECK(Has(dump, "radius-offset = 7:int"));
  CHECK(Has(dump, "dwell-seconds = 2.5:real"));
  CHECK(Has(dump, "N10"));
}

TEST_CASE("a lathe's tool word holds the offset, and S behind the profile's code is the limit") {
  const ReadText read("T0313\nG92 S3200\nG96 S300\n", "iso-lathe");
  CHECK(read.sink.Empty());
  const std::string dump = read.Dump();
  CHECK(Has(dump, "tool = 3:int"));
  CHECK_MESSAGE(Has(dump, "tool-offset = 13:int"), dump);
  CHECK(Has(dump, "speed-limit = 3200:int"));
  CHECK(Has(dump, "speed = 300:int"));
}

TEST_CASE("anything but literal words is a finding, one a block, and the next block is read") {
  const std::pair<std::string, std::string> kWrong[] = {
      {"G1 X#1", "NC1002 #"},        {"X[1+2]", "NC1002 ["},      {"R1=5", "NC1002 ="},
      {"#1=5", "NC1002 #"},          {"G999 X1.", "NC1015 G999"}, {"G91 X1.", "NC1015 G91"},
      {"E5.", "NC1016 E"},           {"X", "NC1017 X"},           {"X1. X2.", "NC1012 X2."},
      {"G0 G1 X1.", "NC1013 G1"},    {"(open", "NC1008 (open"},   {"G4", "NC1002 "},
      {"G4 X2.", "NC1002 X2."},      {"T1.5", "NC1005 T1.5"},     {"X1.2.3", "NC1002 ."},
      {"N10 N20 X1.", "NC1002 N20"}, {"X1. ; text", "NC1002 ;"},  {"GOTO 10", "NC1002 O"},
      {"M98 P1000", "NC1002 P1000"},
  };
  for (const auto& [wrong, finding] : kWrong) {
    const std::string& block = wrong;  // clang captures no structured bindings
    CAPTURE(block);
    const ReadText read(block + "\nG0 X1.\n");
    CHECK(read.Finding() == finding);
    CHECK(read.module.blocks.Size() == 2);
    CHECK((read.module.blocks[ir::BlockId{0}].flags & ir::Block::kRefused) != 0);
    CHECK(read.module.blocks[ir::BlockId{1}].words.count == 2);
  }
}

TEST_CASE("comments keep their places") {
  const ReadText read("(HEAD)\nG0 (BEFORE) X1. (BEHIND)\n");
  REQUIRE(read.module.comments.Size() == 3);
  CHECK(read.module.comments[ir::CommentId{0}].place == ir::CommentPlace::kOwnLine);
  CHECK(read.module.comments[ir::CommentId{1}].place == ir::CommentPlace::kBeforeWord);
  CHECK(read.module.comments[ir::CommentId{1}].word == 1);
  CHECK(read.module.comments[ir::CommentId{2}].place == ir::CommentPlace::kEndOfBlock);
  CHECK(read.module.View(read.module.comments[ir::CommentId{2}].text) == "BEHIND");
}

TEST_CASE("very long blocks are refused before the parser sees them") {
  std::string words;
  for (int i = 0; i < 1200; ++i) words += "X1";
  CHECK(ReadText(words + "\nG0 X1.\n").Finding().starts_with("NC9007 "));
  CHECK(ReadText(std::string(5000, ' ') + "X1.\n").Finding() == "NC9006 X1.");
  std::string comments;
  for (int i = 0; i < 1200; ++i) comments += "()";
  CHECK(ReadText(comments + "X1.\n").Finding().starts_with("NC9007 "));
  CHECK(ReadText("(" + std::string(100000, 'c') + ") G0 X1.\n").sink.Empty());
}

TEST_CASE("the shape cache changes nothing") {
  const std::string text = "G0 X1. Y2.\nG0 X3. Y4.\nG1 X1. F5.\nG1 X2. F6.\nX1 X1\nM8\nM9\n% \n";
  CHECK(ReadText(text).Dump() == ReadText(text, "iso-mill", false).Dump());
}

}  // namespace
}  // namespace ncport::frontend::iso
