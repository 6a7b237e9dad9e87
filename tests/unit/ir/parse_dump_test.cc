#include "ir/parse_dump.h"

#include <doctest/doctest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "ir/dump.h"
#include "ir/verify.h"
#include "tests/unit/ir/dump_samples.h"

using namespace ncport;
using namespace ncport::ir;

namespace {

// "line:column message" of each finding; empty if the dump reads.
std::vector<std::string> Findings(std::string_view text) {
  diag::Sink sink;
  const Result<Module> module = ParseDump(text, sink);
  CHECK(module.Ok() == sink.Empty());
  std::vector<std::string> findings;
  for (const auto& finding : sink.All()) {
    findings.push_back(std::to_string(finding.at.line) + ":" + std::to_string(finding.at.begin) + " " +
                       finding.message);
  }
  return findings;
}

std::vector<std::string> InBlock(std::string_view words) {
  return Findings("ncport-ir 1\nspace R 0..9 real kept all zero\nprogram P main\n@- : " + std::string(words) + "\n");
}

using Texts = std::vector<std::string>;

// True if the text was refused with findings, or read to a module that verifies and dumps to a fixed point.
bool ReadsSafely(std::string_view text) {
  diag::Sink sink;
  const Result<Module> module = ParseDump(text, sink);
  if (!module.Ok()) return !sink.Empty();
  if (FindViolation(*module)) return false;
  TextBuffer first;
  Dump(*module, first);
  diag::Sink again_sink;
  const Result<Module> again = ParseDump(first.View(), again_sink);
  if (!again.Ok()) return false;
  TextBuffer second;
  Dump(*again, second);
  return first.View() == second.View();
}

}  // namespace

TEST_CASE("ir parse_dump: each wrong line is one finding at its place") {
  CHECK(Findings("") == Texts{"1:0 expected ncport-ir 1, found nothing"});
  CHECK(Findings("program P main\n") == Texts{"1:0 expected 'ncport-ir 1', found 'program P main'"});
  CHECK(Findings("ncport-ir 1\nnonsense\n@- : motion linear\n") ==
        Texts{"2:0 expected a record, found 'nonsense'",
              "3:0 expected a program before its blocks, found '@- : motion linear'"});
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- : motion sideways\n@- : axis X\n@- : axis = 5\n") ==
        Texts{"3:12 expected a motion, found 'sideways'", "5:10 expected a name, found '= 5'"});
  CHECK(Findings("ncport-ir 1\nprogram P main extra\n") == Texts{"2:15 expected the end of the line, found 'extra'"});
}

TEST_CASE("ir parse_dump: names must be declared") {
  CHECK(InBlock("assign variable NO = 1") == Texts{"4:21 expected a declared variable, found 'NO = 1'"});
  CHECK(InBlock("assign cell S[1] = 1")[0].find("a declared name, found \'S") != std::string::npos);
  CHECK(InBlock("assign cell R~2[1] = 1")[0].find("a declared name, found \'R") != std::string::npos);
  CHECK(InBlock("assign cell R~0[1] = 1")[0].find("a declared name, found \'R") != std::string::npos);
  CHECK(InBlock("axis Q = 1")[0].find("a declared axis, found \'Q") != std::string::npos);
  CHECK(InBlock("call name A calls A")[0].find("a declared name, found \'A") != std::string::npos);
  CHECK(InBlock("motion rapid {as G0}")[0].find("a declared name, found \'G0") != std::string::npos);
  CHECK(Findings("ncport-ir 1\nprogram P main\n@f:1\n")[0].find("a declared name, found \'f") != std::string::npos);
}

TEST_CASE("ir parse_dump: what would not verify is refused") {
  CHECK(InBlock("axis X")[0].find("word 1 (axis): has no value") != std::string::npos);
  CHECK(InBlock("stop = 5")[0].find("has a value") != std::string::npos);
  CHECK(InBlock("assign 5 = 5")[0].find("cannot be written") != std::string::npos);
  CHECK(InBlock("axis X = call sin(1, 2)")[0].find("2 operands instead of 1 to 1") != std::string::npos);
  CHECK(InBlock("if = 1; stop")[0].find("not alone") != std::string::npos);
  CHECK(InBlock("switch (- => forward label A, 1 => forward label B) = 1")[0].find("default arm") != std::string::npos);
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- link +1\n") ==
        Texts{"3:0 expected a link inside the program, found one that leads out of it"});
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- link +1 : loop\n@- link -1 : end-for\n").size() == 1);
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- link -1\n").size() == 1);
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- link +4294967294\n").size() == 1);
}

TEST_CASE("ir parse_dump: numbers outside their field are refused") {
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- N4294967295\n").size() == 1);
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- N4294967294\n").empty());
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- indent 65536\n").size() == 1);
  CHECK(Findings("ncport-ir 1\nprogram P main\n@- skip 16\n").size() == 1);
  CHECK(InBlock("speed 256 = 1").size() == 1);
  CHECK(InBlock("axis X = literal(1e999)").size() == 1);
  CHECK(InBlock("axis X = literal(nan)").size() == 1);
  CHECK(InBlock("axis X = 1" + std::string(400, '0')).size() == 1);
  CHECK(InBlock("axis X = ?5").size() == 1);
}

TEST_CASE("ir parse_dump: texts end in their line and know three escapes") {
  CHECK(InBlock("message = \"a")[0].find("a text that ends in its line") != std::string::npos);
  CHECK(InBlock("message = \"a\\n\"")[0].find("an escape") != std::string::npos);
  CHECK(InBlock("message = \"a\\x4\"")[0].find("an escape") != std::string::npos);
  CHECK(InBlock("message = \"\\x00\\xfF\\\\ // no comment\" // comment").empty());
  CHECK_FALSE(InBlock(std::string_view("message\0 = 1", 12)).empty());
}

TEST_CASE("ir parse_dump: depth is limited, length is not") {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "negate(";
  CHECK(InBlock("axis X = " + deep)[0].find("less than 1000 levels") != std::string::npos);
  const auto nested = [](int levels) {
    std::string text;
    for (int i = 1; i < levels; ++i) text += "negate(";
    text += "1";
    for (int i = 1; i < levels; ++i) text += ")";
    return text;
  };
  CHECK(InBlock("axis X = " + nested(1000)).empty());
  CHECK_FALSE(InBlock("axis X = " + nested(1001)).empty());
  std::string chain = "ncport-ir 1\nprogram P main\n@-:0";
  for (int i = 0; i < 2000; ++i) chain += " via @-:0";
  CHECK(Findings(chain + "\n")[0].find("a shorter chain of origins") != std::string::npos);
  std::string names = "ncport-ir 1\n";
  for (int i = 0; i < 20; ++i) names += "axis A\n";
  CHECK_FALSE(Findings(names).empty());
  std::string list = "name F(1";
  for (int i = 0; i < 70000; ++i) list += ",1";
  CHECK(InBlock("axis X = " + list + ")")[0].find("fewer operands") != std::string::npos);
}

TEST_CASE("ir parse_dump: parameters stand together") {
  CHECK(Findings("ncport-ir 1\nprogram P main\nparam A real parameter\nvar B real local\nparam C real parameter\n")
            .size() == 1);
  CHECK(Findings("ncport-ir 1\nparam A real parameter\n").size() == 1);
  CHECK(Findings("ncport-ir 1\nvar A real local\n").size() == 1);  // a local of no program
}

TEST_CASE("ir parse_dump: findings name the file they are asked for") {
  diag::Sink sink;
  const FileId file{std::size_t{3}};
  CHECK_FALSE(ParseDump("nothing", sink, file).Ok());
  REQUIRE(sink.All().size() == 1);
  CHECK(sink.All()[0].at.file == file);
}

TEST_CASE("ir parse_dump: mutated dumps are read or refused, never followed into the void") {
  // Deterministic: a failure names its seed and round.
  const std::string_view original = test::kEverything;
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
  int read = 0;
  for (int round = 0; round < 600; ++round) {
    std::string text(original);
    const std::size_t edits = 1 + below(3);
    for (std::size_t edit = 0; edit < edits; ++edit) {
      const std::size_t at = below(text.size());
      switch (below(5)) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, 1 + below(6));
          break;
        case 2:
          text.insert(at, text.substr(below(text.size()), 1 + below(20)));
          break;
        case 3:
          text[at] = "0123456789~-+@:;,()[]{}\"\\/ \n"[below(28)];
          break;
        default: {  // a line elsewhere
          const std::size_t begin = text.rfind('\n', at) + 1;
          const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
          const std::string line = text.substr(begin, end - begin);
          text.erase(begin, end - begin);
          text.insert(text.find('\n', below(text.size())) + 1, line);
          break;
        }
      }
    }
    diag::Sink sink;
    if (ParseDump(text, sink).Ok()) ++read;
    CHECK_MESSAGE(ReadsSafely(text), "round " << round << ":\n" << text);
  }
  // Both ways are walked.
  CHECK(read > 30);
  CHECK(read < 570);
}
