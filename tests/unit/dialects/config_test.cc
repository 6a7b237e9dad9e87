#include "dialects/config.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

namespace ncport::dialects {
namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "ncport_config_XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

struct Reading {
  explicit Reading(const std::string& text) {
    std::ofstream(folder.path / "ncport.toml") << text;
    result = LoadConfig((folder.path / "ncport.toml").string(), files, sink);
    CHECK(result.Ok() == sink.Empty());
  }
  [[nodiscard]] std::string First() const {
    if (sink.Empty()) return "";
    const diag::Diagnostic& first = sink.All().front();
    return std::to_string(first.at.line) + " " + std::string(diag::InfoOf(first.code).number) + " " + first.message +
           (first.help.empty() ? "" : " | " + first.help);
  }
  Folder folder;
  SourceFiles files;
  diag::Sink sink;
  Result<Config> result = Failure{};
};

TEST_CASE("words of several machines stand in one file, by the name of their profile") {
  const Reading reading(R"([tools]
"T1 D1" = { qtn = "T0101", integrex = "T01.01 M6" }
"T2 D1" = "T0202"
)");
  REQUIRE(reading.result.Ok());
  const Config& config = *reading.result;
  CHECK(config.For("shop/qtn.toml").FindTool("T1 D1")->target == "T0101");
  CHECK(config.For("integrex.toml").FindTool("T1 D1")->target == "T01.01 M6");
  CHECK(config.For("mazak-integrex-new").FindTool("T1 D1")->target == "T01.01 M6");
  CHECK(config.For("mazak-qtn").FindTool("T2 D1")->target == "T0202");
  CHECK(config.For("fanuc-lathe-a").FindTool("T1 D1") == nullptr);
  CHECK(config.For("qtn2.toml").FindTool("T1 D1") == nullptr);
  CHECK(Reading("[tools]\nT1 = { qtn = 5 }\n").First() ==
        "2 NC2102 tools.T1.qtn is number 5 where a text, words of that machine, is needed");
}

TEST_CASE("every table of the contract is read") {
  const Reading reading(R"(from = "sinumerik-840d-lathe"
to = "mazak-qtn"
[tools]
"T1 D1" = "T0101"
'T="FINISHING_T35 A"  D1' = "T0303"
[offsets]
"G505" = "G54.1 P1"
[programs]
TURNING_CYCLE = 4001
SPLIT = [4002, "4003"]
[variables]
R10 = "#510"
[mcodes]
M41 = "M41"
M42 = "drop"
[ranges]
"TURNING_CYCLE.EXTD" = [20, 300]
[limits]
spindle = 3500
x = 200
z = [-400, 50.5]
[entry]
distance = "absolute"
work-offset = 54
[check]
fail-on = "warning"
ignore = ["NC2007"]
select = ["NC5"]
)");
  REQUIRE(reading.result.Ok());
  const Config& config = *reading.result;
  CHECK(config.from == "sinumerik-840d-lathe");
  CHECK(config.to == "mazak-qtn");
  CHECK(config.FindTool("T1 D1")->target == "T0101");
  CHECK(config.FindTool("T1")->target == "T0101");  // a call without D also matches its D1 key
  CHECK(config.FindTool("t1  d1")->target == "T0101");
  CHECK(config.FindTool("T1 D2") == nullptr);
  CHECK(config.FindTool("T=\"FINISHING_T35 A\" D1")->target == "T0303");
  CHECK(config.FindTool("T=\"finishing_t35 a\" D1") == nullptr);  // case of tool names counts
  CHECK(config.FindOffset("G505")->target == "G54.1 P1");
  CHECK(config.FindProgram("turning_cycle")->targets == std::vector<std::string>{"4001"});
  CHECK(config.FindProgram("SPLIT")->targets == std::vector<std::string>{"4002", "4003"});
  CHECK(config.FindVariable("R10")->target == "#510");
  CHECK(config.FindVariable("R11") == nullptr);
  REQUIRE(config.mcodes.size() == 2);
  CHECK(config.mcodes[1].target == "drop");
  CHECK(config.ranges[0].most == 300);
  REQUIRE(config.limits.size() == 3);
  CHECK(config.limits[0].most == 3500);
  CHECK(config.limits[1].least == -200);
  CHECK(config.limits[2].least == -400);
  CHECK(config.entry.distance == ir::Distance::kAbsolute);
  CHECK(config.entry.plane == ir::Plane::kUnknown);
  CHECK(config.entry.work_offset.number == 54);
  CHECK(config.fail_on == FailOn::kWarning);
  CHECK(config.ignore == std::vector<std::string>{"NC2007"});
  CHECK(config.select == std::vector<std::string>{"NC5"});
}

TEST_CASE("a profile file is meant from the folder of ncport.toml") {
  const Reading reading("from = \"./mill.toml\"\nto = \"iso-mill\"\n");
  REQUIRE(reading.result.Ok());
  CHECK(reading.result->from == reading.folder.path.string() + "/./mill.toml");
  CHECK(reading.result->to == "iso-mill");
}

TEST_CASE("wrong lines are named with place and remedy") {
  CHECK(Reading("form = \"x\"\n").First() == "1 NC2101 unknown key form | did you mean from?");
  CHECK(Reading("[tols]\n\"T1\" = \"T0101\"\n").First() == "1 NC2101 unknown key tols | did you mean tools?");
  CHECK(Reading("[check]\nfail_on = \"error\"\n").First() ==
        "2 NC2101 unknown key check.fail_on | did you mean fail-on?");
  CHECK(Reading("[check]\nfail-on = \"no\"\n").First() ==
        "2 NC2102 check.fail-on is text \"no\" where one of error | warning | never is needed");
  CHECK(Reading("[check]\nignore = [\"NC0007\"]\n").First() ==
        "2 NC2102 check.ignore is text \"NC0007\" where a code such as \"NC2007\" that exists is needed");
  CHECK(Reading("[ranges]\nR1 = [5, 1]\n").First() == "2 NC2102 ranges.R1 is a list where [least, most] is needed");
  CHECK(
      Reading("[ranges]\nR1 = [5, \"1+R2\"]\n").First() ==
      "2 NC2102 ranges.R1 is a list where [least, most], each a number or another input such as \"EXTD-1\", is needed");
  CHECK(Reading("[limits]\nspindel = 5\n").First() == "2 NC2101 unknown key limits.spindel | did you mean spindle?");
  CHECK(Reading("[limits]\nfeed = -5\n").First() ==
        "2 NC2102 limits.feed is number -5 where a number above 0 is needed");
  CHECK(Reading("[tools]\n\"T1 D1\" = 5\n").First() ==
        "2 NC2102 tools.T1 D1 is number 5 where a text, words of the target, is needed");
  CHECK(Reading("[tools]\n\"T1 D1\" = \"T0101\"\n\"t1 D1\" = \"T0202\"\n").First() ==
        "3 NC2002 tools.t1 D1 is declared twice");
  CHECK(Reading("[mcodes]\nQ1 = \"drop\"\n").First() ==
        "2 NC2101 unknown key mcodes.Q1 | keys are words such as M41, H5 or G187");
  CHECK(Reading("tools = 5\n").First() == "1 NC2102 tools is number 5 where a table [tools] is needed");
}

TEST_CASE("the nearest ncport.toml upwards holds") {
  const Folder folder;
  fs::create_directories(folder.path / "a/b");
  std::ofstream(folder.path / "ncport.toml") << "to = \"mazak-qtn\"\n";
  SourceFiles files;
  diag::Sink sink;
  const Result<Config> far = FindConfig((folder.path / "a/b/part.mpf").string(), files, sink);
  REQUIRE(far.Ok());
  CHECK(far->to == "mazak-qtn");
  CHECK(fs::equivalent(far->folder, folder.path));  // from where ncport was started
  std::ofstream(folder.path / "a/ncport.toml") << "to = \"fanuc-mill\"\n";
  const Result<Config> near = FindConfig((folder.path / "a/b/part.mpf").string(), files, sink);
  REQUIRE(near.Ok());
  CHECK(near->to == "fanuc-mill");
}

}  // namespace
}  // namespace ncport::dialects
