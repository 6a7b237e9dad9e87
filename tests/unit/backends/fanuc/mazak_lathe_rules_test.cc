#include "backends/fanuc/mazak_lathe_rules.h"

#include <doctest/doctest.h>

#include "dialects/machine.h"
#include "dialects/registry.h"
#include "ir/parse_dump.h"

namespace ncport::backends::fanuc {
namespace {

/// The findings on a raised module, one a line.
std::string Findings(const std::string& text, std::string_view profile_name = "mazak-qtn",
                     const std::vector<ToolUse>& tools = {}) {
  diag::Sink sink;
  Result<ir::Module> module = ir::ParseDump("ncport-ir 1\nfile m\n" + text, sink);
  REQUIRE(module.Ok());
  const dialects::Profile profile = dialects::BuiltIn(profile_name);
  const ir::Machine machine = dialects::MachineFor(dialects::BuiltIn("sinumerik-840d-lathe"));
  Translation out;
  out.module = *std::move(module);
  out.tools = tools;
  RaiseInput input;
  input.source = &out.module;
  input.source_machine = &machine;
  input.profile = &profile;
  const bool ok = CheckMazakLathe(input, out, sink);
  std::string lines;
  for (const diag::Diagnostic& finding : sink.All()) lines += finding.message + "\n";
  CHECK(ok == lines.empty());
  return lines;
}

const std::string kSpellings =
    "spelling G21 rule -\n"
    "spelling \"G18 G40 G80 G67 G99\" rule -\n"
    "spelling G97 rule -\n"
    "spelling G90 rule -\n"
    "spelling T0303 rule -\n"
    "spelling G53.5 rule -\n"
    "spelling G112 rule -\n"
    "spelling G98 rule -\n";
const std::string kMain = kSpellings + "program M main @m:0\n";
const std::string kHead =
    "  @- added : inert {as G21}\n"
    "  @- added : inert {as \"G18 G40 G80 G67 G99\"}\n"
    "  @- added : inert {as G97}\n";
const std::string kEnd = "  @m:9 : program-end #30\n";

TEST_CASE("a program that keeps all rules has no finding (mazak-lathe-10.4)") {
  CHECK(Findings(kMain + kHead + "  @m:1 : speed-limit = 3000\n  @m:2 : speed-mode constant-surface; speed = 200\n" +
                 kEnd)
            .empty());
}

TEST_CASE("row 1: words of the other series") {
  CHECK(Findings(kMain + kHead + "  @m:1 : inert {as G90}\n" + kEnd) ==
        "G90 (a turning cycle here) has no equivalent in mazak-qtn\n");
  CHECK(Findings(kMain + kHead + "  @m:1 : inert {as G98}\n" + kEnd).empty());
  CHECK(Findings(kMain + kHead + "  @m:1 : inert {as G98}\n" + kEnd, "mazak-integrex-new")
            .find("G98 (a return level here)") != std::string::npos);
}

TEST_CASE("row 3: constant surface speed needs a limit on every way") {
  const std::string css = "  @m:5 label CSS : speed-mode constant-surface; speed = 200\n";
  CHECK(Findings(kMain + kHead + css + kEnd) ==
        "constant surface speed without a speed limit before it has no equivalent in mazak-qtn\n");
  CHECK(Findings(kMain + kHead + "  @m:1 : jump forward label CSS = gt:bool(1, 0)\n  @m:2 : speed-limit = 3000\n" +
                 css + kEnd) ==
        "constant surface speed without a speed limit before it has no equivalent in mazak-qtn\n");
  // A called program counts.
  CHECK(Findings(kMain + kHead + "  @m:1 : call name L1 calls L1\n" + css + kEnd +
                 "program L1 sub @m:20 header\n  @m:21 : speed-limit = 3000\n  @m:22 : return plain\n")
            .empty());
  // A modal call runs behind moves: with the limit of there.
  const std::string sub =
      "program L1 sub @m:20 header\n  @m:21 : speed-mode constant-surface; speed = 200\n  @m:22 : return plain\n";
  const std::string modal = kMain + kHead + "  @m:1 : modal-call name L1 calls L1\n";
  CHECK(Findings(modal + "  @m:2 : axis X = 1\n  @m:3 : speed-limit = 3000\n" + kEnd + sub) ==
        "constant surface speed without a speed limit before it has no equivalent in mazak-qtn\n");
  CHECK(Findings(modal + "  @m:2 : speed-limit = 3000\n  @m:3 : axis X = 1\n" + kEnd + sub).empty());
  // A limit behind a condition may not be set.
  CHECK(Findings(kMain + kHead + "  @m:1 : when = 1; speed-limit = 3000\n" + css + kEnd) ==
        "constant surface speed without a speed limit before it has no equivalent in mazak-qtn\n");
}

TEST_CASE("row 6: U, V and W of an INTEGREX are axes") {
  CHECK(Findings(kMain + kHead + "  @m:1 : axis U absolute = 5\n" + kEnd, "mazak-integrex-new")
            .find("a U, V or W axis") != std::string::npos);
}

TEST_CASE("row 10: a tool change inside a macro") {
  ToolUse use;
  use.target_words = "T0303";
  const std::string sub = "program L1 sub @m:20 header\n  @m:21 : inert {as T0303}\n  @m:22 : return plain\n";
  CHECK(Findings(kMain + kHead + kEnd + sub, "mazak-qtn", {use}) ==
        "a tool change inside a macro has no equivalent in mazak-qtn\n");
  CHECK(Findings(kMain + kHead + "  @m:1 : inert {as T0303}\n" + kEnd, "mazak-qtn", {use}).empty());
}

TEST_CASE("row 11: a head writes every group") {
  CHECK(Findings(kMain + "  @- added : inert {as G21}\n  @- added : inert {as G97}\n  @m:1 : axis X = 1\n" + kEnd) ==
        "a main program whose head leaves out G17 or G18 or G19 has no equivalent in mazak-qtn\n"
        "a main program whose head leaves out G40 has no equivalent in mazak-qtn\n"
        "a main program whose head leaves out G80 has no equivalent in mazak-qtn\n"
        "a main program whose head leaves out G67 has no equivalent in mazak-qtn\n"
        "a main program whose head leaves out G98 or G99 or G94 or G95 has no equivalent in mazak-qtn\n");
}

TEST_CASE("row 12: ends of programs") {
  CHECK(Findings(kMain + kHead + "  @m:1 : axis X = 1\n") ==
        "a main program without an end word has no equivalent in mazak-qtn\n");
  CHECK(Findings(kMain + kHead + "  @m:1 : return plain\n") ==
        "a main program that ends as a subprogram (M99 repeats it for ever) has no equivalent in mazak-qtn\n");
  CHECK(Findings(kMain + kHead + kEnd + "program L1 sub @m:20 header\n  @m:21 : axis X = 1\n") ==
        "a subprogram without a return has no equivalent in mazak-qtn\n");
}

TEST_CASE("rows 14 and 16: MAZATROL coordinates, orders to the other system") {
  CHECK(Findings(kMain + kHead + "  @m:1 : inert {as G53.5}\n" + kEnd).find("G53.5") != std::string::npos);
  CHECK(Findings(kMain + kHead + "  @m:1 : inert {as G112}\n" + kEnd).find("G112") != std::string::npos);
}

}  // namespace
}  // namespace ncport::backends::fanuc
