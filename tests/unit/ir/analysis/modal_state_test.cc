#include "ir/analysis/modal_state.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <string_view>

#include "ir/parse_dump.h"

using namespace ncport;
using namespace ncport::ir;
using namespace ncport::ir::analysis;

namespace {

struct Analysis {
  Module module;
  Machine machine;
  ModalOptions options;
  std::unique_ptr<FlowGraphs> graphs;
  std::unique_ptr<CallGraph> calls;
  std::unique_ptr<ModalFlow> flow;

  explicit Analysis(std::string_view text) {
    diag::Sink sink;
    Result<Module> parsed = ParseDump("ncport-ir 1\nspace R 0..9 real kept all zero\n" + std::string(text), sink);
    for (const auto& finding : sink.All()) FAIL_CHECK(finding.at.line << ": " << finding.message);
    REQUIRE(parsed.Ok());
    module = std::move(*parsed);
    options.main_entry.motion = Motion::kLinear;
    options.main_entry.distance = Distance::kAbsolute;
    options.main_entry.plane = Plane::kXY;
    options.main_entry.work_offset = {true, 54, 0};
    machine.modal_call_levels = 1;
  }
  Analysis& Run() {
    graphs = std::make_unique<FlowGraphs>(module);
    calls = std::make_unique<CallGraph>(module);
    flow = std::make_unique<ModalFlow>(module, machine, *graphs, *calls, options);
    return *this;
  }
  ModalState Before(std::size_t program, std::uint32_t block) const {
    const ProgramId id{program};
    return flow->Before(id, module.programs[id].blocks[block]);
  }
  ModalState At(std::size_t program, std::uint32_t block) const {
    const ProgramId id{program};
    return flow->At(id, module.programs[id].blocks[block]);
  }
  ModalFlow::ModalCall ModalBefore(std::size_t program, std::uint32_t block) const {
    const ProgramId id{program};
    return flow->ModalCallBefore(id, module.programs[id].blocks[block]);
  }
  bool Reached(std::size_t program, std::uint32_t block) const {
    const ProgramId id{program};
    return flow->Reached(id, module.programs[id].blocks[block]);
  }
};

}  // namespace

TEST_CASE("ir modal_state: modes hold from their block on") {
  Analysis a("program P main\n@- : axis X = 1\n@- : motion rapid; plane zx; axis X = 2\n@- : axis X = 3\n");
  a.Run();
  CHECK(a.Before(0, 0).motion == Motion::kLinear);
  CHECK(a.Before(0, 1).motion == Motion::kLinear);
  CHECK(a.At(0, 1).motion == Motion::kRapid);
  CHECK(a.Before(0, 2).motion == Motion::kRapid);
  CHECK(a.Before(0, 2).plane == Plane::kZX);
  CHECK(a.Before(0, 2).distance == Distance::kAbsolute);
  CHECK(a.Before(0, 2).units == Units::kUnknown);
}

TEST_CASE("ir modal_state: every group has its word") {
  Analysis a(
      "program P main\n"
      "@- : motion arc-cw; plane yz; distance incremental; units inch; feed-mode inverse-time; comp left; diameter "
      "diameter; path exact; return-level r-plane; work-offset #541 = 3; speed-mode rpm\n@-\n");
  a.Run();
  ModalState expected;
  expected.motion = Motion::kArcCw;
  expected.plane = Plane::kYZ;
  expected.distance = Distance::kIncremental;
  expected.units = Units::kInch;
  expected.feed_mode = FeedMode::kInverseTime;
  expected.speed_mode = SpeedMode::kRpm;
  expected.comp = CutterComp::kLeft;
  expected.diameter = Diameter::kDiameter;
  expected.path = PathMode::kExact;
  expected.return_level = ReturnLevel::kRPlane;
  expected.work_offset = {true, 541, 3};
  CHECK(a.Before(0, 1) == expected);
}

TEST_CASE("ir modal_state: ways that differ make a group unknown, ways that agree do not") {
  Analysis a(
      "program P main\n@- link +2 : if = 1\n@- : motion rapid; distance absolute\n@- link +2 : else\n"
      "@- : motion rapid; plane yz\n@- link -4 : end-if\n@-\n");
  a.Run();
  CHECK(a.Before(0, 5).motion == Motion::kRapid);
  CHECK(a.Before(0, 5).distance == Distance::kAbsolute);
  CHECK(a.Before(0, 5).plane == Plane::kUnknown);
}

TEST_CASE("ir modal_state: loops carry changes back to their start") {
  Analysis a(
      "program P main\n@- link +3 : while = 1\n@- : axis X = 1\n@- : distance incremental\n@- link -3 : "
      "end-while\n@-\n");
  a.Run();
  CHECK(a.Before(0, 1).distance == Distance::kUnknown);
  CHECK(a.Before(0, 4).distance == Distance::kUnknown);
  CHECK(a.Before(0, 1).motion == Motion::kLinear);
}

TEST_CASE("ir modal_state: blocks and words that may not run leave both") {
  Analysis skip("program P main\n@- skip 0 : motion rapid\n@-\n");
  skip.Run();
  CHECK(skip.At(0, 0).motion == Motion::kRapid);
  CHECK(skip.Before(0, 1).motion == Motion::kUnknown);
  Analysis when("program P main\n@- : plane yz; when = 1; motion rapid\n@-\n");
  when.Run();
  CHECK(when.Before(0, 1).motion == Motion::kUnknown);
  CHECK(when.Before(0, 1).plane == Plane::kYZ);
  CHECK(when.At(0, 0).motion == Motion::kUnknown);
}

TEST_CASE("ir modal_state: motions of one block do not last") {
  Analysis a("program P main\n@- : motion probe; axis X = 1\n@- : motion tap-floating\n@- : axis X = 1\n");
  a.Run();
  CHECK(a.At(0, 0).motion == Motion::kProbe);
  CHECK(a.Before(0, 1).motion == Motion::kLinear);
  CHECK(a.At(0, 1).motion == Motion::kTapFloating);
  CHECK(a.Before(0, 2).motion == Motion::kLinear);
}

TEST_CASE("ir modal_state: constant surface speed takes the feed along where the machine says so") {
  Analysis a("program P main\n@- : feed-mode per-minute\n@- : speed-mode constant-surface\n@-\n");
  a.machine.surface_speed_per_revolution = true;
  a.Run();
  CHECK(a.Before(0, 2).feed_mode == FeedMode::kPerRevolution);
  a.machine.surface_speed_per_revolution = false;
  a.Run();
  CHECK(a.Before(0, 2).feed_mode == FeedMode::kPerMinute);
}

TEST_CASE("ir modal_state: work offsets by number are known, computed extensions are not") {
  Analysis a("program P main\n@- : work-offset #55\n@- : work-offset #541 = cell R[1]\n@-\n");
  a.Run();
  CHECK(a.Before(0, 0).work_offset == WorkOffset{true, 54, 0});
  CHECK(a.Before(0, 1).work_offset == WorkOffset{true, 55, 0});
  CHECK_FALSE(a.Before(0, 2).work_offset.known);
}

TEST_CASE("ir modal_state: computed codes make unknown what they may change") {
  Analysis a("program P main\n@- : computed-g = cell R[1]\n@-\n");
  CodeMeaning code;
  code.op = WordOp::kPlane;
  a.machine.g_codes = {code};
  a.Run();
  CHECK(a.Before(0, 1).plane == Plane::kUnknown);
  CHECK(a.Before(0, 1).motion == Motion::kLinear);
  a.machine.g_codes.clear();
  a.Run();
  CHECK(a.Before(0, 1).motion == Motion::kUnknown);
  CHECK_FALSE(a.Before(0, 1).work_offset.known);
}

TEST_CASE("ir modal_state: a call leaves what the callee does not touch") {
  Analysis a(
      "program P main\n@- : motion rapid; call name S calls S\n@- : distance incremental; call name S calls S\n@-\n"
      "program S sub\n@- : axis X = 1\n@- : plane zx\n@- : return plain\n");
  a.Run();
  CHECK(a.Before(0, 1).plane == Plane::kZX);
  CHECK(a.Before(0, 1).motion == Motion::kRapid);
  CHECK(a.Before(0, 2).distance == Distance::kIncremental);
  // The entry joins both calls.
  CHECK(a.Before(1, 0).motion == Motion::kRapid);
  CHECK(a.Before(1, 0).distance == Distance::kUnknown);
  CHECK(a.Before(1, 0).plane == Plane::kUnknown);
  CHECK(a.Before(1, 2).plane == Plane::kZX);
  CHECK(a.flow->Entry(ProgramId{std::size_t{1}}).motion == Motion::kRapid);
}

TEST_CASE("ir modal_state: later passes of a call start with what the first one left") {
  Analysis a(
      "program P main\n@- : plane xy\n@- : call name S calls S passes 2\n@- : call name T calls T\n"
      "program S sub\n@- : axis X = 1\n@- : plane zx\nprogram T sub\n@- : plane yz\n");
  a.Run();
  CHECK(a.Before(1, 0).plane == Plane::kUnknown);
  CHECK(a.Before(2, 0).plane == Plane::kZX);
}

TEST_CASE("ir modal_state: SAVE gives the caller its modes back") {
  Analysis a(
      "program P main\n@- : call name S calls S\n@-\nprogram S sub saves-modal-state\n@- : plane zx; motion rapid\n");
  a.Run();
  CHECK(a.Before(0, 1).plane == Plane::kXY);
  CHECK(a.Before(0, 1).motion == Motion::kLinear);
}

TEST_CASE("ir modal_state: end words return from called programs only where the machine says so") {
  Analysis a("program P main\n@- : call name S calls S\n@-\nprogram S sub\n@- : plane zx; program-end #30\n");
  a.Run();
  CHECK(a.Before(0, 1).plane == Plane::kZX);
  a.machine.end_in_called_program_returns = false;
  a.Run();
  CHECK_FALSE(a.Reached(0, 1));
}

TEST_CASE("ir modal_state: calls that are not found and block ranges make everything unknown") {
  Analysis a("program P main\n@- : call name GONE\n@-\n");
  a.Run();
  CHECK(a.Before(0, 1) == ModalState{});
  Analysis from(
      "program P main\n@- : call name - from-block calls P from number 1\n@-\n@- : program-end\n"
      "@- N1 : distance incremental\n@- : return plain\n");
  from.Run();
  CHECK(from.flow->Reached(ProgramId{std::size_t{0}}, BlockId{std::size_t{1}}));
  CHECK(from.Before(0, 1) == ModalState{});
  Analysis range("program P main\n@- N1 : axis X = 1\n@- : call block-range P calls P from number 1 to number 1\n@-\n");
  range.Run();
  CHECK(range.Before(0, 2) == ModalState{});
}

TEST_CASE("ir modal_state: subprograms that nothing calls start as declared") {
  Analysis a("program S sub\n@- : axis X = 1\n");
  a.options.sub_entry.distance = Distance::kAbsolute;
  a.Run();
  CHECK(a.Before(0, 0).distance == Distance::kAbsolute);
  CHECK(a.Before(0, 0).motion == Motion::kUnknown);
  CHECK(a.Reached(0, 0));
}

TEST_CASE("ir modal_state: recursion ends, and the way out is followed") {
  Analysis a(
      "program P main\n@- : call name S calls S\n@-\n"
      "program S sub\n@- link +3 : if = 1\n@- : plane yz\n@- : call name S calls S\n@- link -3 : end-if\n@- : motion "
      "rapid\n");
  a.Run();
  CHECK(a.Before(0, 1).motion == Motion::kRapid);
  CHECK(a.Before(0, 1).plane == Plane::kUnknown);
  CHECK(a.Before(0, 1).distance == Distance::kAbsolute);
  CHECK(a.Before(1, 0).motion == Motion::kLinear);
  CHECK(a.Before(1, 0).plane == Plane::kUnknown);
}

TEST_CASE("ir modal_state: a callee that always stops leaves nothing behind") {
  Analysis a("program P main\n@- : call name S calls S\n@-\nprogram S sub\n@- : alarm stops = 1\n");
  a.Run();
  CHECK(a.Reached(0, 0));
  CHECK_FALSE(a.Reached(0, 1));
}

TEST_CASE("ir modal_state: modal calls run after motion blocks, between set and cancel") {
  Analysis a(
      "program P main\n@- : modal-call name S calls S\n@- : feed = 5\n@- : axis X = 1\n@- : plane xy; motion linear\n"
      "@- : modal-call\n@- : axis X = 2\n@-\nprogram S sub\n@- : plane zx; motion rapid\n");
  a.Run();
  CHECK(a.Before(0, 2).plane == Plane::kXY);
  // The block may or may not run the call.
  CHECK(a.Before(0, 3).plane == Plane::kUnknown);
  CHECK(a.Before(0, 3).distance == Distance::kAbsolute);
  CHECK(a.Before(0, 5).plane == Plane::kXY);
  CHECK(a.Before(0, 6).plane == Plane::kXY);
  // One motion block ran it, under G1.
  CHECK(a.Before(1, 0).motion == Motion::kLinear);
  CHECK(a.Before(1, 0).distance == Distance::kAbsolute);
}

TEST_CASE("ir modal_state: nested modal calls are not tracked by name, only counted") {
  Analysis a(
      "program P main\n@- : modal-call name S calls S\n@- : modal-call name S calls S\n@- : modal-call\n@- : axis X = "
      "1\n"
      "@- : plane xy\n@- : modal-call\n@- : axis X = 1\n@-\nprogram S sub\n@- : axis Y = 1\n");
  a.machine.modal_call_levels = 4;
  a.Run();
  CHECK(a.Before(0, 3).plane == Plane::kXY);
  CHECK(a.Before(0, 4).plane == Plane::kUnknown);
  CHECK(a.Before(0, 7).plane == Plane::kXY);
}

TEST_CASE("ir modal_state: a program that ends a modal call leaves it unknown, whether called or run by it") {
  Analysis called(
      "program P main\n@- : modal-call name S calls S\n@- : call name E calls E\n@- : axis X = 1\n"
      "program S sub\n@- : feed = 5\nprogram E sub\n@- : modal-call\n");
  called.Run();
  CHECK(called.ModalBefore(0, 1) == ModalFlow::ModalCall::kActive);
  CHECK(called.ModalBefore(0, 2) == ModalFlow::ModalCall::kUnknown);
  Analysis run(
      "program P main\n@- : modal-call name S calls S\n@- : axis X = 1\n@- : axis X = 2\n"
      "program S sub\n@- : call name E calls E\nprogram E sub\n@- : modal-call\n");
  run.Run();
  CHECK(run.ModalBefore(0, 1) == ModalFlow::ModalCall::kActive);
  CHECK(run.ModalBefore(0, 2) == ModalFlow::ModalCall::kUnknown);
  Analysis kept(
      "program P main\n@- : modal-call name S calls S\n@- : call name S calls S\n@- : axis X = 1\n@- : axis X = 2\n"
      "program S sub\n@- : feed = 5\n");
  kept.Run();
  CHECK(kept.ModalBefore(0, 3) == ModalFlow::ModalCall::kActive);
}

TEST_CASE("ir modal_state: returns to a target of the caller carry their modes there") {
  Analysis a(
      "program P main\n@- : call name S calls S\n@- : program-end\n@- N10\n"
      "program S sub\n@- : plane zx\n@- : return to-caller = 10\n");
  a.Run();
  CHECK_FALSE(a.Reached(0, 1));
  REQUIRE(a.Reached(0, 2));
  CHECK(a.Before(0, 2).plane == Plane::kZX);
  CHECK(a.Before(0, 2).motion == Motion::kLinear);
}

TEST_CASE("ir modal_state: computed jumps meet at all labels") {
  Analysis a(
      "program P main\n@- link +1 : if = 1\n@- link -1 : end-if\n@- : plane zx; jump forward expression cell R[1]\n"
      "@- : program-end\n@- N10\n@- : motion rapid; jump forward expression cell R[2]\n@- N20\n");
  a.Run();
  CHECK(a.Before(0, 4).plane == Plane::kZX);
  CHECK(a.Before(0, 4).motion == Motion::kUnknown);
  CHECK(a.Before(0, 6).plane == Plane::kZX);
  CHECK_FALSE(a.Reached(0, 3));
}

TEST_CASE("ir modal_state: refused blocks may have set anything") {
  Analysis a("program P main\n@- refused : verbatim \"G?\"\n@- : motion rapid\n@-\n");
  a.Run();
  CHECK(a.Before(0, 1) == ModalState{});
  CHECK(a.Before(0, 2).motion == Motion::kRapid);
}

TEST_CASE("ir modal_state: a part with computed ends makes its program unknown, and what that calls") {
  Analysis a(
      "program P main\n@- : repeat-part first expression cell R[1]\n@- : call name S calls S\n@- : plane zx\n@-\n"
      "program S sub\n@- : axis X = 1\n");
  a.Run();
  CHECK(a.Before(0, 0) == ModalState{});
  CHECK(a.At(0, 2).plane == Plane::kZX);
  CHECK(a.Before(0, 3) == ModalState{});
  CHECK(a.Reached(1, 0));
  CHECK(a.Before(1, 0) == ModalState{});
}

TEST_CASE("ir modal_state: work grows with the text") {
  // 100,000 labels and jumps: a quadratic flow would not come back.
  std::string text = "program P main\n";
  for (int i = 0; i < 50000; ++i) {
    text += "@- N" + std::to_string(i) + " : " + (i % 2 == 0 ? "motion rapid" : "motion linear") + "; axis X = 1\n";
    text += "@- : jump forward expression cell R[1] = cell R[2]\n";
  }
  Analysis a(text);
  a.Run();
  CHECK(a.Before(0, 0).motion == Motion::kUnknown);
  CHECK(a.Before(0, 99999).motion == Motion::kLinear);
}
