#include "dialects/fanuc/system_variables.h"

#include <doctest/doctest.h>

#include "dialects/registry.h"

namespace ncport::dialects::fanuc {
namespace {

TEST_CASE("ranges of one maker and machine do not overlap") {
  for (const SystemRange& a : SystemVariables()) {
    CHECK(a.first <= a.last);
    CHECK(a.base <= a.first);
    for (const SystemRange& b : SystemVariables()) {
      if (&a == &b || (a.makers & b.makers) == 0 || (a.machines & b.machines) == 0) continue;
      CAPTURE(a.first);
      CAPTURE(b.first);
      CHECK((a.last < b.first || b.last < a.first));
    }
  }
}

TEST_CASE("variables are found by number, also those that are reached by arithmetic") {
  const Profile mill = BuiltIn("fanuc-mill");
  const Profile lathe = BuiltIn("fanuc-lathe-a");
  CHECK(FindSystemVariable(mill, 5003)->kind == ir::SystemKind::kProgrammedPosition);
  CHECK(5003 - FindSystemVariable(mill, 5003)->base == 3);
  CHECK(FindSystemVariable(mill, 5043)->kind == ir::SystemKind::kEnvironment);
  CHECK(FindSystemVariable(mill, 4012)->kind == ir::SystemKind::kModalGroup);
  CHECK(4012 - FindSystemVariable(mill, 4012)->base == 12);
  CHECK(FindSystemVariable(mill, 3000)->control == Control::kAlarm);
  CHECK_FALSE(FindSystemVariable(mill, 3000)->readable);
  CHECK(FindSystemVariable(mill, 3006)->control == Control::kMessageStop);
  CHECK(FindSystemVariable(mill, 4120)->kind == ir::SystemKind::kProgrammedTool);
  CHECK_FALSE(FindSystemVariable(mill, 5001)->writable);
  CHECK(FindSystemVariable(mill, 5221)->writable);
  CHECK(FindSystemVariable(mill, 1050) == nullptr);
  CHECK(FindSystemVariable(lathe, 15001) != nullptr);
  CHECK(FindSystemVariable(lathe, 15001)->name == "tool offsets");
  CHECK(FindSystemVariable(mill, 15001)->name == "extended work offsets");
  CHECK(FindSystemVariable(BuiltIn("mazak-qtn"), 3020)->name == "index of the tool data");
  CHECK(FindSystemVariable(mill, 3020) == nullptr);
  CHECK(FindSystemVariable(BuiltIn("haas-mill"), 3026) != nullptr);
}

TEST_CASE("system variables keep out of the spaces of the profile") {
  for (const char* name : {"fanuc-mill", "fanuc-lathe-a", "mazak-mill", "mazak-qtn", "mazak-integrex-new"}) {
    const Profile profile = BuiltIn(name);
    for (const VariableSpace& space : profile.variables) {
      CHECK(FindSystemVariable(profile, space.range.first) == nullptr);
      CHECK(FindSystemVariable(profile, space.range.last) == nullptr);
    }
  }
}

TEST_CASE("names of the 30i stand for numbers") {
  CHECK(FindSystemName("_ABSOT")->base + 2 == 5042);
  CHECK(FindSystemName("_DATE")->base == 3011);
  CHECK_FALSE(FindSystemName("_DATE")->indexed);
  CHECK(FindSystemName("_NONE") == nullptr);
}

}  // namespace
}  // namespace ncport::dialects::fanuc
