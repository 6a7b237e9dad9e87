#include "app/run_arguments.h"

#include <doctest/doctest.h>

#include <string>

#include "dialects/registry.h"
#include "ir/builder.h"

namespace ncport::app {
namespace {

struct Programs {
  Programs() {
    ir::ProgramBuilder main(module, "MAIN");
    count = main.Local("COUNT", ir::Type::kInt);
    main.Block(1).Finish();
    main.Finish();
    ir::ProgramBuilder ring(module, "RING", ir::ProgramKind::kSub);
    ring.Parameter("RADIUS");
    ring.Parameter("TURNS", ir::Type::kInt);
    ring.Parameter("NAME", ir::Type::kString);
    ring.Parameter("ALONG", ir::Type::kAxis);
    ring.Parameter("DEEP", ir::Type::kBool);
    ring.Block(1).Finish();
    ring.Finish();
    space = ir::AddSpace(module, "R", 0, 99);
    options.entry = ir::ProgramId{0};
  }
  [[nodiscard]] std::string Message() const { return sink.Empty() ? "" : sink.All().front().message; }

  dialects::Profile profile = dialects::BuiltIn("sinumerik-840d-mill");
  ir::Module module;
  ir::VariableId count;
  ir::SpaceId space;
  exec::RunOptions options;
  diag::Sink sink;
};

TEST_CASE("--call: positional constants in the types of the parameters, empty is missing") {
  Programs p;
  REQUIRE(ApplyCall(" ring( 10,,\"A,B\",z,1)", p.module, p.profile, p.options, p.sink).Ok());
  CHECK(p.options.entry == ir::ProgramId{1});
  CHECK(p.options.is_call);
  REQUIRE(p.options.arguments.size() == 5);
  CHECK(p.options.arguments[0].value.type == ir::Type::kReal);
  CHECK(p.options.arguments[0].value.number == 10);
  CHECK(p.options.arguments[1].value.IsVacant());
  CHECK(p.options.arguments[2].text == "A,B");
  CHECK(p.options.arguments[3].value.number == 2);
  CHECK(p.options.arguments[4].value.type == ir::Type::kBool);
}

TEST_CASE("--call: the name alone, and no arguments") {
  for (const char* call : {"RING", "RING()", "RING( )"}) {
    Programs p;
    CHECK(ApplyCall(call, p.module, p.profile, p.options, p.sink).Ok());
    CHECK(p.options.arguments.empty());
  }
}

TEST_CASE("--call: letters fill the local variables that the language gives them") {
  Programs p;
  p.profile = dialects::BuiltIn("fanuc-mill");
  REQUIRE(ApplyCall("MAIN(R=1.5,b=-2)", p.module, p.profile, p.options, p.sink).Ok());
  REQUIRE(p.options.arguments.size() == 2);
  CHECK(p.options.arguments[0].letter == 'R');
  CHECK(p.options.arguments[0].position == 18);
  CHECK(p.options.arguments[0].value.number == 1.5);
  CHECK(p.options.arguments[1].letter == 'B');
  CHECK(p.options.arguments[1].position == 2);
  CHECK(p.options.arguments[1].value.number == -2);
  CHECK(p.options.arguments[1].value.type == ir::Type::kReal);

  Programs other;
  other.profile = dialects::BuiltIn("fanuc-mill");
  CHECK(!ApplyCall("MAIN(G=1)", other.module, other.profile, other.options, other.sink).Ok());
  CHECK(other.Message() == "--call: G is no letter that a call of MAIN can have");
}

TEST_CASE("--call: what does not fit is said") {
  const std::pair<std::string, std::string> kWrong[] = {
      {"NONE(1)", "--call: there is no program NONE"},
      {"RING(1", "--call: RING(1 has no closing bracket"},
      {"RING(1,2,3)", "--call: 3 is not a constant for argument 3 of RING"},
      {"RING(1,2,\"A\",X,1,6)", "--call: RING takes 5 arguments"},
      {"RING(R1)", "--call: R1 is not a constant for argument 1 of RING"},
      {"RING(1e5)", "--call: 1e5 is not a constant for argument 1 of RING"},
  };
  for (const auto& [call, message] : kWrong) {
    Programs p;
    CHECK(!ApplyCall(call, p.module, p.profile, p.options, p.sink).Ok());
    CHECK(p.Message() == message);
  }
}

TEST_CASE("--set: variables of the entry program and cells") {
  Programs p;
  REQUIRE(ApplySet("count = 2.6", p.module, true, p.options, p.sink).Ok());
  REQUIRE(ApplySet("R10=-1.5", p.module, true, p.options, p.sink).Ok());
  REQUIRE(p.options.start_values.size() == 2);
  CHECK(p.options.start_values[0].variable == p.count);
  CHECK(p.options.start_values[0].value.type == ir::Type::kInt);
  CHECK(p.options.start_values[0].value.number == 3);  // an INT takes the rounded value, as an assignment does
  CHECK(p.options.start_values[1].space == p.space);
  CHECK(p.options.start_values[1].cell == 10);
  CHECK(p.options.start_values[1].value.number == -1.5);
  for (const char* wrong :
       {"R10", "R100=1", "RADIUS=1", "NONE=1", "R1=\"A\"", "R1=", "R1=2x", "R=1", "R12345678901=1"}) {
    CAPTURE(wrong);
    CHECK(!ApplySet(wrong, p.module, true, p.options, p.sink).Ok());
  }
}

TEST_CASE("--start: axes with numbers, in the unit of the profile") {
  Programs p;
  dialects::Profile profile = dialects::BuiltIn("sinumerik-840d-mill");
  REQUIRE(ApplyStart("X0Y-1.5 z100.", profile, p.options, p.sink).Ok());
  CHECK(p.options.start_position_known);
  CHECK(p.options.start_axes == 0b111);
  CHECK(p.options.start_position[1] == -1.5);
  CHECK(p.options.start_position[2] == 100);
  exec::RunOptions inch;
  profile.units.Set(dialects::LengthUnit::kInch);
  REQUIRE(ApplyStart("X1A90", profile, inch, p.sink).Ok());
  CHECK(inch.start_position[0] == 25.4);
  CHECK(inch.start_position[3] == 90);
  for (const char* wrong : {"", "X", "X1X2", "Q5", "X1,Y2", "5"}) {
    CAPTURE(wrong);
    exec::RunOptions options;
    CHECK(!ApplyStart(wrong, profile, options, p.sink).Ok());
  }
}

}  // namespace
}  // namespace ncport::app
