#include "base/diag/text_renderer.h"

#include <doctest/doctest.h>

#include <string>

#include "base/utf8.h"

namespace ncport::diag {

namespace {

// The two lines with source and marker, of a finding at bytes [begin, end) of `line`.
std::string Marked(const std::string& line, std::uint32_t begin, std::uint32_t end, TextOptions options = {}) {
  SourceFiles files;
  const FileId file = files.Add("a.nc", line);
  Sink sink;
  sink.Report(Code::kMissingFeed, {file, 1, begin, end});
  const std::string text = RenderText(sink, files, options);
  return text.substr(text.find('\n') + 1);
}

}  // namespace

TEST_CASE("the form of the contract") {
  SourceFiles files;
  const FileId file = files.Add("samples/x.spf", std::string(11, '\n') + "LAYER_C=ALLOW DIV RALL\n");
  Sink sink;
  Diagnostic& finding = sink.Report(Code::kDivisionByZero, {file, 12, 14, 22}, "RALL can be 0 here");
  finding.notes.push_back({{}, "RALL is parameter 4 of TURNING_CYCLE; the call in main.mpf:9 passes 0"});
  finding.help = "test it first, for example a block IF RALL<=0, a block SETAL(65000), a block ENDIF";
  finding.control = "SINUMERIK alarm 14051";
  CHECK(RenderText(sink, files) ==
        "samples/x.spf:12:15: error[NC3001]: division by zero: RALL can be 0 here\n"
        "   12 | LAYER_C=ALLOW DIV RALL\n"
        "      |               ^^^^^^^^\n"
        "   note: RALL is parameter 4 of TURNING_CYCLE; the call in main.mpf:9 passes 0\n"
        "   help: test it first, for example a block IF RALL<=0, a block SETAL(65000), a block ENDIF\n"
        "   control: SINUMERIK alarm 14051\n");
}

TEST_CASE("columns and carets count characters") {
  CHECK(Marked("(\xC3\xBC\xE2\x82\xAC) G9", 8, 10) == "    1 | (\xC3\xBC\xE2\x82\xAC) G9\n      |      ^^\n");
  SourceFiles files;
  const FileId file = files.Add("a.nc", "(\xC3\xBC) G9");
  Sink sink;
  sink.Report(Code::kMissingFeed, {file, 1, 5, 7});
  CHECK(RenderText(sink, files).starts_with("a.nc:1:5: error"));
}

TEST_CASE("tabs are expanded in both lines") {
  CHECK(Marked("\tG1\tX", 4, 5, {.tab_width = 4}) == "    1 |     G1  X\n      |         ^\n");
  CHECK(Marked("G1\tX", 2, 3, {.tab_width = 4}) == "    1 | G1  X\n      |   ^^\n");
}

TEST_CASE("an empty range and one behind the line have one caret") {
  CHECK(Marked("G1", 0, 0) == "    1 | G1\n      | ^\n");
  CHECK(Marked("G1", 2, 2) == "    1 | G1\n      |   ^\n");
  CHECK(Marked("G1", 50, 60) == "    1 | G1\n      |   ^\n");
  CHECK(Marked("", 0, 0) == "    1 |\n      | ^\n");
  CHECK(Marked("\n", 0, 0) == "    1 |\n      | ^\n");
  CHECK(Marked("G1  ", 3, 4) == "    1 | G1\n      |    ^\n");
}

TEST_CASE("a long line is cut around the place") {
  std::string line;
  for (int i = 0; i < 1000; ++i) line += std::to_string(i % 10);
  line.replace(500, 3, "XYZ");
  const std::string text = Marked(line, 500, 503, {.max_width = 40});
  CHECK(text ==
        "    1 | ...7890123456789XYZ345678901234567890123456...\n"
        "      |                 ^^^\n");
  CHECK(Marked(line, 0, 2, {.max_width = 20}) == "    1 | 01234567890123456789...\n      | ^^\n");
  CHECK(Marked(line, 999, 1000, {.max_width = 20}) ==
        "    1 | ...01234567890123456789\n      |                       ^\n");
  CHECK(Marked(line, 0, 1000, {.max_width = 20}) == "    1 | 01234567890123456789...\n      | ^^^^^^^^^^^^^^^^^^^^\n");
  CHECK(Marked(line, 1000, 1000, {.max_width = 20}) ==
        "    1 | ...01234567890123456789\n      |                        ^\n");
}

TEST_CASE("nothing reaches the terminal that could change it") {
  const std::string text = Marked("G1\x1B[2J \x80 \xE2\x80\xAE X", 0, 2);
  CHECK(text.find('\x1B') == std::string::npos);
  CHECK(text.find("\xE2\x80\xAE") == std::string::npos);
  CHECK(IsValidUtf8(text));
  SourceFiles files;
  Sink sink;
  sink.Report(Code::kUnknownWord, {}, "a\r\nb\x07").help = "one\ntwo";
  CHECK(RenderText(sink, files) == "error[NC1014]: unknown word a b\xEF\xBF\xBD\n   help: one two\n");
}

TEST_CASE("places of files, of notes, and large line numbers") {
  SourceFiles files;
  const FileId file = files.Add("a.nc", std::string(123455, '\n') + "G1");
  Sink sink;
  sink.Report(Code::kFileTooLarge, {file, 0, 0, 0}, 10, 5).notes.push_back({{file, 123456, 0, 2}, "here"});
  sink.Report(Code::kMissingFeed, {file, 123456, 0, 2});
  CHECK(RenderText(sink, files) ==
        "a.nc: error[NC9002]: file of 10 bytes is longer than 5\n"
        "   note: a.nc:123456:1: here\n"
        "a.nc:123456:1: error[NC5002]: feed move without a feed\n"
        "123456 | G1\n"
        "       | ^^\n");
}

TEST_CASE("a very long line is shown like a long one") {
  const std::string around(300, 'x');
  std::string near_text = around + "\xC3\xA4?" + around;
  const std::string shown = Marked(near_text, 302, 303);
  const std::string far_text = std::string(30000, 'x') + "\xC3\xA4?" + std::string(30000, 'x');
  CHECK(Marked(far_text, 30002, 30003) == shown);
  // At its start and behind its end.
  CHECK(Marked("?" + far_text, 0, 1) == Marked("?" + near_text, 0, 1));
  const auto end = static_cast<std::uint32_t>(far_text.size());
  CHECK(Marked(far_text, end, end) == Marked(near_text, 603, 603));
  // Many characters of several bytes.
  std::string wide;
  for (int i = 0; i < 20000; ++i) wide += "\xE2\x82\xAC";
  CHECK(IsValidUtf8(Marked(wide, 30000, 30003)));
  CHECK(IsValidUtf8(Marked(wide, 30001, 30002)));
}

}  // namespace ncport::diag
