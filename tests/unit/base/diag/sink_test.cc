#include "base/diag/sink.h"

#include <doctest/doctest.h>

#include <cctype>
#include <set>
#include <string>

namespace ncport::diag {

TEST_CASE("the registry can be read by code and by number") {
  CHECK(FindByNumber("NC3001") == Code::kDivisionByZero);
  CHECK_FALSE(FindByNumber("NC0000").has_value());
  CHECK_FALSE(FindByNumber("NC9999").has_value());
  CHECK_FALSE(FindByNumber("nc3001").has_value());
  CHECK_FALSE(FindByNumber("").has_value());
  std::set<std::string_view> names;
  for (const Info& info : AllInfos()) {
    CAPTURE(info.number);
    CHECK(FindByNumber(info.number) == info.code);
    CHECK(&InfoOf(info.code) == &info);
    CHECK(names.insert(info.name).second);
  }
}

TEST_CASE("registry texts keep the rules of wording") {
  for (const Info& info : AllInfos()) {
    CAPTURE(info.number);
    CHECK_FALSE(info.text.empty());
    CHECK_FALSE(info.text.ends_with('.'));
    CHECK_FALSE((std::isupper(static_cast<unsigned char>(info.text[0])) != 0 &&
                 std::islower(static_cast<unsigned char>(info.text[1])) != 0));
  }
}

TEST_CASE("a finding takes its text from the registry") {
  Sink sink;
  const SourceRange at{FileId{0}, 3, 1, 4};
  Diagnostic& finding = sink.Report(Code::kArrayIndex, at, 7, std::string_view("TAB"), std::size_t{4});
  finding.help = "count from 0";
  CHECK(sink.All().front().message == "index 7 of TAB is outside 0 to 4");
  CHECK(sink.All().front().help == "count from 0");
  CHECK(sink.All().front().severity == Severity::kError);
  CHECK(sink.All().front().at == at);
  sink.Report(Code::kArcRadius, at, 1.5, 2.0);
  CHECK(sink.All().back().message == "radius at the start of the arc is 1.5, at its end 2");
}

TEST_CASE("counts go by severity") {
  Sink sink;
  CHECK(sink.Empty());
  CHECK_FALSE(sink.HasErrors());
  sink.Report(Code::kUnreachableBlock, {});
  CHECK_FALSE(sink.HasErrors());
  sink.Report(Code::kMissingFeed, {});
  sink.Report(Code::kMissingFeed, {});
  sink.Report(Code::kControlBytes, {}, 3);
  CHECK(sink.ErrorCount() == 2);
  CHECK(sink.WarningCount() == 1);
  CHECK(sink.Remove([](const Diagnostic& finding) { return finding.code == Code::kMissingFeed; }) == 2);
  CHECK_FALSE(sink.HasErrors());
  CHECK(sink.All().size() == 2);
}

TEST_CASE("references stay valid while more is reported") {
  Sink sink;
  Diagnostic& first = sink.Report(Code::kMissingFeed, {});
  for (int i = 0; i < 1000; ++i) sink.Report(Code::kMissingFeed, {});
  first.help = "program F";
  CHECK(sink.All().front().help == "program F");
}

TEST_CASE("findings over the cap are counted and named once") {
  Sink sink(3);
  for (int i = 0; i < 10; ++i) sink.Report(Code::kUnknownCode, {}, i).notes.push_back({{}, "note"});
  CHECK(sink.ErrorCount() == 10);
  REQUIRE(sink.All().size() == 4);
  CHECK(sink.All().back().code == Code::kTooManyFindings);
  CHECK(sink.All().back().message == "further findings suppressed after 3");
  CHECK(sink.All().back().notes.empty());
}

TEST_CASE("findings are sorted by place; equal places keep their order; no place comes last") {
  Sink sink;
  sink.Report(Code::kUnknownCode, {}, "g");
  sink.Report(Code::kUnknownCode, {FileId{1}, 1, 0, 1}, "f");
  sink.Report(Code::kUnknownCode, {FileId{0}, 2, 5, 6}, "d");
  sink.Report(Code::kUnknownCode, {FileId{0}, 2, 5, 9}, "e");
  sink.Report(Code::kUnknownCode, {FileId{0}, 2, 3, 9}, "c");
  sink.Report(Code::kUnknownCode, {FileId{0}, 1, 7, 9}, "b");
  sink.Report(Code::kUnknownCode, {FileId{0}, 0, 0, 0}, "a");
  sink.SortByPlace();
  std::string order;
  for (const Diagnostic& finding : sink.All()) order += finding.message.back();
  CHECK(order == "abcdefg");
}

}  // namespace ncport::diag
