// Tools of whole programs: from SINUMERIK text to the text of the target.
#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "backends/translate.h"
#include "dialects/machine.h"
#include "dialects/registry.h"
#include "frontend/reader.h"

namespace ncport::backends {
namespace {

struct Port {
  std::string text;      // without comments and the head
  std::string findings;  // messages, one a line
};

Port To(std::string_view target, std::string_view program) {
  SourceFiles files;
  diag::Sink sink;
  ir::Module module;
  dialects::Profile from = dialects::BuiltIn(target == "fanuc-mill" ? "sinumerik-840d-mill" : "sinumerik-840d-lathe");
  const dialects::Profile to = dialects::BuiltIn(target);
  const FileId file = files.Add("main.mpf", std::string(program));
  REQUIRE(frontend::ReadFile(files, file, from, {}, module, sink).Ok());
  frontend::ResolveNames(files, module, from, sink);
  REQUIRE_FALSE(sink.HasErrors());
  dialects::Config config;
  const bool mill = target == "fanuc-mill";
  config.tools = {{"T1 D1", mill ? "T1 M6 H1 D1" : "T0101", {}},
                  {"T2 D1", mill ? "T2 M6 H2 D2" : "T0202", {}},
                  {"T1 D2", mill ? "T1 M6 H11 D11" : "T0111", {}},
                  {"T2 D2", mill ? "T2 M6 H12 D12" : "T0212", {}}};
  const ir::Machine machine = dialects::MachineFor(from);
  TranslateInput input;
  input.source = &module;
  input.from = &from;
  input.source_machine = &machine;
  input.to = &to;
  input.config = &config;
  Translation translation;
  Port port;
  if (Raise(input, translation, sink)) {
    for (const OutputFile& output : Print(to, translation, {})) port.text += output.text;
  }
  for (const diag::Diagnostic& finding : sink.All()) {
    if (finding.severity == diag::Severity::kError) port.findings += finding.message + "\n";
  }
  return port;
}

bool Holds(const Port& port, std::string_view part) {
  INFO(port.text, port.findings);
  return port.text.find(part) != std::string::npos;
}

TEST_CASE("a mill names the length register of the tool in force with the first move of Z") {
  const Port port =
      To("fanuc-mill", "G54 G90 G17\nT1 D1 M6\nS1000 M3\nG0 X0 Y0\nG0 Z10\nG1 Z-1 F100\nT2 D1 M6\nG0 Z10\nM30\n");
  CHECK(Holds(port, "G0 G43 H1 Z10."));
  CHECK(Holds(port, "G0 G43 H2 Z10."));
  CHECK(port.findings.empty());
}

TEST_CASE("a loop that changes the tool: the register at its head would be two") {
  const Port port =
      To("fanuc-mill",
         "G54 G90 G17\nR1=0\nT1 D1 M6\nNEXT:\nG0 Z10\nG1 Z-1 F100\nT2 D1 M6\nR1=R1+1\nIF R1<2 GOTOB NEXT\n"
         "M30\n");
  CHECK(port.findings.find("tool that is not one on every way here") != std::string::npos);
}

TEST_CASE("a branch that changes the tool") {
  const std::string head = "G54 G90 G17\nR1=1\nT1 D1 M6\nIF R1>0\n";
  CHECK(To("fanuc-mill", head + "T2 D1 M6\nENDIF\nG0 Z10\nM30\n").findings.find("not one on every way") !=
        std::string::npos);
  // Moving Z in both ways settles it.
  const Port port = To("fanuc-mill", head + "T2 D1 M6\nG0 Z20\nELSE\nG0 Z20\nENDIF\nG0 Z10\nM30\n");
  CHECK(port.findings.empty());
  CHECK(Holds(port, "G43 H2 Z20."));
  CHECK(Holds(port, "G43 H1 Z20."));
}

TEST_CASE("a subprogram that is called with two tools") {
  const std::string sub = "%_N_CUT_SPF\nG0 Z10\nG1 Z-1 F100\nM17\n";
  const Port port = To("fanuc-mill", "%_N_MAIN_MPF\nG54 G90 G17\nT1 D1 M6\nCUT\nT2 D1 M6\nCUT\nM30\n" + sub);
  CHECK(port.findings.find("not one on every way") != std::string::npos);
  // The caller moves Z first: the length is in force when the subprogram begins.
  const Port settled =
      To("fanuc-mill", "%_N_MAIN_MPF\nG54 G90 G17\nT1 D1 M6\nG0 Z50\nCUT\nT2 D1 M6\nG0 Z50\nCUT\nM30\n" + sub);
  CHECK(settled.findings.empty());
  CHECK(Holds(settled, "G43 H2 Z50."));
}

TEST_CASE("an edge on a lathe belongs to the tool that is in force on every way") {
  const std::string head = "G54 G90 G18 G95\nR1=1\nT1 D1\nG97 S500 M3\nG0 X50 Z5\n";
  CHECK(Holds(To("fanuc-lathe-a", head + "D2\nG0 X40\nM30\n"), "T0111"));
  CHECK(To("fanuc-lathe-a", head + "IF R1>0\nT2 D1\nENDIF\nD2\nG0 X40\nM30\n")
            .findings.find("an edge whose tool is not one on every way here") != std::string::npos);
  CHECK(To("fanuc-lathe-a", "%_N_MAIN_MPF\n" + head + "OTHER\nD2\nG0 X40\nM30\n%_N_OTHER_SPF\nT2 D1\nM17\n")
            .text.find("T0212") != std::string::npos);
}

TEST_CASE("corners become words with a comma between straight moves") {
  const std::string head = "G17 G90 G54 G0 X0 Y0\n";
  CHECK(Holds(To("fanuc-mill", head + "G1 X20 CHR=5 F100\nY20\nM30\n"), "G1 X20. ,C5. F100."));
  CHECK(Holds(To("fanuc-mill", head + "G1 X20 F100 RND=4\nX40 Y30\nM30\n"), ",R4."));
  CHECK(Holds(To("fanuc-mill", head + "G1 X20 F100 CHF=2\nY20\nM30\n"), ",C1.414"));
  CHECK(To("fanuc-mill", head + "G1 X20 F100 CHF=2\nX40 Y20\nM30\n").findings.find("right angle") != std::string::npos);
  CHECK(To("fanuc-mill", head + "G1 X20 F100 CHR=2\nG2 X40 Y20 CR=20\nM30\n").findings.find("two straight moves") !=
        std::string::npos);
  CHECK(To("fanuc-mill", head + "G1 X20 F100 CHR=2\nY20 F50\nM30\n").findings.find("new feed") != std::string::npos);
}

}  // namespace
}  // namespace ncport::backends
