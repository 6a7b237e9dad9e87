#include "base/source_files.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace ncport {

namespace {

std::vector<std::string> Lines(const std::string& text) {
  SourceFiles files;
  const FileId file = files.Add("a.nc", text);
  std::vector<std::string> lines;
  for (std::uint32_t line = 1; line <= files.LineCount(file); ++line) lines.emplace_back(files.Line(file, line));
  return lines;
}

using Expected = std::vector<std::string>;

}  // namespace

TEST_CASE("lines end with LF, CRLF or CR, the last one may lack an end") {
  CHECK(Lines("") == Expected{});
  CHECK(Lines("a") == Expected{"a"});
  CHECK(Lines("a\n") == Expected{"a"});
  CHECK(Lines("a\nb") == Expected{"a", "b"});
  CHECK(Lines("\n\n") == Expected{"", ""});
  CHECK(Lines("a\r\nb\rc\nd") == Expected{"a", "b", "c", "d"});
  CHECK(Lines("a\r\r\nb\n\rc\r") == Expected{"a", "", "b", "", "c"});
  CHECK(Lines("\r") == Expected{""});
}

TEST_CASE("line ends are known as they were written and lines add up to the text") {
  const std::string text = "a\r\nb\rc\n\r\n\nd";
  SourceFiles files;
  const FileId file = files.Add("a.nc", text);
  CHECK(files.LineEnd(file, 1) == "\r\n");
  CHECK(files.LineEnd(file, 2) == "\r");
  CHECK(files.LineEnd(file, 3) == "\n");
  CHECK(files.LineEnd(file, 6).empty());
  std::string sum;
  for (std::uint32_t line = 1; line <= files.LineCount(file); ++line) {
    sum.append(files.Line(file, line)).append(files.LineEnd(file, line));
  }
  CHECK(sum == text);
}

TEST_CASE("views survive more files; names are found") {
  SourceFiles files;
  const FileId first = files.Add("a.nc", "G0");
  const std::string_view line = files.Line(first, 1);
  for (int i = 0; i < 100; ++i) files.Add("b" + std::to_string(i), "M30\n");
  CHECK(files.Line(first, 1).data() == line.data());
  CHECK(files.Name(files.Find("b7")) == "b7");
  CHECK_FALSE(files.Find("c").Valid());
  CHECK(files.Size() == 101);
}

TEST_CASE("places outside the text give nothing") {
  SourceFiles files;
  const FileId file = files.Add("a.nc", "G1 X10\n");
  CHECK(files.View({file, 1, 3, 6}) == "X10");
  CHECK(files.View({file, 1, 3, 99}) == "X10");
  CHECK(files.View({file, 1, 6, 7}).empty());
  CHECK(files.View({file, 1, 4, 4}).empty());
  CHECK(files.View({file, 2, 0, 1}).empty());
  CHECK(files.View({FileId{}, 1, 0, 1}).empty());
  CHECK(files.Line(file, 0).empty());
  CHECK(files.Line(file, 2).empty());
}

TEST_CASE("ranges join within a line only") {
  const FileId file{0};
  CHECK(Join({file, 1, 5, 7}, {file, 1, 9, 12}) == SourceRange{file, 1, 5, 12});
  CHECK(Join({file, 1, 9, 12}, {file, 1, 5, 7}) == SourceRange{file, 1, 5, 12});
  CHECK(Join({file, 1, 5, 7}, {file, 2, 0, 3}) == SourceRange{file, 1, 5, 7});
}

}  // namespace ncport
