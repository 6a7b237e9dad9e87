// Passes of the SINUMERIK writer on dumps: a Fanuc module in, one pass, text out.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/sinumerik/raise.h"
#include "dialects/machine.h"
#include "dialects/registry.h"
#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::backends::sinumerik::test {

struct Setting {
  bool lathe = false;
  std::vector<std::pair<std::string, std::string>> tools;  // rows of [tools]
  std::function<void(ir::Machine&)> machine;               // changes of what the profile says
};

struct Passed {
  std::string text;
  std::string findings;  // codes
  std::string messages;
  Translation out;
};

using Pass = std::function<bool(const RaiseInput&, Translation&, diag::Sink&)>;

/// Whole programs; R[1] is a cell of a space R.
inline Passed RunAll(std::string_view programs, const Pass& pass, const Setting& setting = {},
                     ir::test::Show show = ir::test::Show::kPlain) {
  const dialects::Profile from = dialects::BuiltIn(setting.lathe ? "fanuc-lathe-a" : "fanuc-mill");
  const dialects::Profile to = dialects::BuiltIn(setting.lathe ? "sinumerik-840d-lathe" : "sinumerik-840d-mill");
  ir::Machine machine = dialects::MachineFor(from);
  if (setting.machine) setting.machine(machine);
  dialects::Config config;
  for (const auto& [source, target] : setting.tools) config.tools.push_back({source, target, {}, {}});
  RaiseInput input;
  input.source_profile = &from;
  input.source_machine = &machine;
  input.profile = &to;
  input.config = &config;
  Passed passed;
  diag::Sink sink;
  const std::string text = ir::test::After(
      "ncport-ir 1\nfile m\nspace R 0..99 real kept all zero\nsystem $P_EP programmed-position real\n" +
          ir::test::WithCells(programs),
      sink,
      [&](ir::Module& module, diag::Sink& findings) {
        passed.out.module = std::move(module);
        const bool done = pass(input, passed.out, findings);
        CHECK(done == !findings.HasErrors());
        module = passed.out.module;
        return done;
      },
      show);
  passed.text = ir::test::Brief(text);
  passed.findings = ir::test::CodesOf(sink);
  for (const diag::Diagnostic& finding : sink.All()) passed.messages += finding.message + "\n";
  return passed;
}

/// Blocks of one main program, without its own line.
inline Passed Run(std::string_view blocks, const Pass& pass, const Setting& setting = {},
                  ir::test::Show show = ir::test::Show::kPlain) {
  Passed passed = RunAll("program M main @m:0\n" + std::string(blocks), pass, setting, show);
  passed.text.erase(0, passed.text.find('\n') + 1);
  return passed;
}

}  // namespace ncport::backends::sinumerik::test
