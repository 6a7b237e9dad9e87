// JSON, SARIF and annotations: what other programs read.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "base/diag/github_renderer.h"
#include "base/diag/json_renderer.h"
#include "base/diag/sarif_renderer.h"

namespace ncport::diag {

namespace {

struct Sample {
  SourceFiles files;
  Sink sink;

  Sample() {
    const FileId file = files.Add("sub dir/\xC3\xA4.nc", "(\xC3\xA4) G1 X10\n");
    Diagnostic& finding = sink.Report(Code::kMissingFeed, {file, 1, 8, 11});
    finding.notes.push_back({{file, 1, 5, 7}, "mode is set here"});
    finding.notes.push_back({{}, "50% of \"all\", two\nlines"});
    finding.help = "program F";
    finding.control = "alarm 1";
    finding.fixes.push_back({{file, 1, 11, 11}, " F100"});
    sink.Report(Code::kControlBytes, {}, 2);
  }
};

}  // namespace

TEST_CASE("JSON has the keys of the contract") {
  const Sample sample;
  const auto json = nlohmann::json::parse(RenderJson(sample.sink, sample.files));
  CHECK(json["version"] == 1);
  REQUIRE(json["findings"].size() == 2);
  const auto& finding = json["findings"][0];
  CHECK(finding["file"] == "sub dir/\xC3\xA4.nc");
  CHECK(finding["line"] == 1);
  CHECK(finding["column"] == 8);
  CHECK(finding["endLine"] == 1);
  CHECK(finding["endColumn"] == 11);
  CHECK(finding["severity"] == "error");
  CHECK(finding["code"] == "NC5002");
  CHECK(finding["message"] == "feed move without a feed");
  CHECK(finding["help"] == "program F");
  CHECK(finding["alarm"] == "alarm 1");
  REQUIRE(finding["notes"].size() == 2);
  CHECK(finding["notes"][0]["column"] == 5);
  CHECK(finding["notes"][0]["message"] == "mode is set here");
  CHECK(finding["notes"][1]["line"].is_null());
  REQUIRE(finding["fixes"].size() == 1);
  CHECK(finding["fixes"][0]["column"] == 11);
  CHECK(finding["fixes"][0]["endColumn"] == 11);
  CHECK(finding["fixes"][0]["replacement"] == " F100");
  const auto& other = json["findings"][1];
  CHECK(other["file"].is_null());
  CHECK(other["line"].is_null());
  CHECK(other["severity"] == "info");
  CHECK(other["alarm"].is_null());
  CHECK(other["notes"].is_array());
}

TEST_CASE("JSON without findings, and with a file name that is not UTF-8") {
  SourceFiles files;
  Sink sink;
  CHECK(nlohmann::json::parse(RenderJson(sink, files))["findings"].is_array());
  const FileId file = files.Add("a\xFF.nc", "x");
  sink.Report(Code::kMissingFeed, {file, 1, 0, 1});
  CHECK(nlohmann::json::parse(RenderJson(sink, files))["findings"][0]["file"] == "a\xEF\xBF\xBD.nc");
  CHECK(nlohmann::json::accept(RenderSarif(sink, files, "1")));
}

TEST_CASE("SARIF names rules by index and counts as the schema says") {
  const Sample sample;
  const auto json = nlohmann::json::parse(RenderSarif(sample.sink, sample.files, "9.8.7"));
  CHECK(json["version"] == "2.1.0");
  const auto& run = json["runs"][0];
  const auto& driver = run["tool"]["driver"];
  CHECK(driver["version"] == "9.8.7");
  CHECK(driver["rules"].size() == 2);
  REQUIRE(run["results"].size() == 2);
  const auto& result = run["results"][0];
  CHECK(driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"] == result["ruleId"]);
  CHECK(result["ruleId"] == "NC5002");
  CHECK(result["level"] == "error");
  CHECK(result["message"]["text"] ==
        "feed move without a feed\nnote: 50% of \"all\", two\nlines\nhelp: program F\ncontrol: alarm 1");
  const auto& physical = result["locations"][0]["physicalLocation"];
  CHECK(physical["artifactLocation"]["uri"] == "sub%20dir/%C3%A4.nc");
  CHECK(physical["region"]["startColumn"] == 8);
  CHECK(physical["region"]["endColumn"] == 11);
  CHECK(result["relatedLocations"].size() == 1);
  const auto& replacement = result["fixes"][0]["artifactChanges"][0]["replacements"][0];
  CHECK(replacement["deletedRegion"]["startColumn"] == 11);
  CHECK(replacement["insertedContent"]["text"] == " F100");
  CHECK(run["results"][1]["level"] == "note");
  CHECK_FALSE(run["results"][1].contains("locations"));
}

TEST_CASE("file names as URI references") {
  CHECK(UriOf("a/b.nc") == "a/b.nc");
  CHECK(UriOf("/a b") == "file:///a%20b");
  CHECK(UriOf("C:x#1?") == "C%3Ax%231%3F");
}

TEST_CASE("annotations code what would end them") {
  const Sample sample;
  CHECK(RenderGithub(sample.sink, sample.files) ==
        "::error file=sub dir/\xC3\xA4.nc,line=1,endLine=1,col=8,endColumn=11,title=NC5002::feed move without a feed"
        "%0Anote: sub dir/\xC3\xA4.nc:1:5: mode is set here%0Anote: 50%25 of \"all\", two%0Alines%0Ahelp: program F"
        "%0Acontrol: alarm 1\n"
        "::notice title=NC1018::2 NUL and tape control bytes are not part of the program and were left out\n");
  SourceFiles files;
  Sink sink;
  sink.Report(Code::kMissingFeed, {files.Add("a,b:c.nc", ""), 0, 0, 0});
  CHECK(RenderGithub(sink, files) == "::error file=a%2Cb%3Ac.nc,title=NC5002::feed move without a feed\n");
}

}  // namespace ncport::diag
