#include "app/value_rule_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "base/letter_case.h"
#include "dialects/finding_alarms.h"
#include "dialects/language.h"

namespace ncport::app {

check::ValueRuleOptions ValueRuleOptionsFor(const Context& context, const ProgramSet& set,
                                            const dialects::Config* config) {
  check::ValueRuleOptions options;
  options.files = &context.files;
  options.control = fmt::format("{} alarm", dialects::TitleOf(set.profile.language));
  options.domain_alarm = dialects::AlarmFor(set.profile, diag::Code::kOutOfDomain);
  options.test_example = dialects::TestExampleOf(set.profile.language);
  if (config == nullptr) return options;
  for (const ir::ProgramId program : set.module.programs.Ids()) {
    for (const ir::VariableId parameter : set.module.programs[program].parameters) {
      const std::string name = fmt::format("{}.{}", set.module.View(set.module.programs[program].name),
                                           set.module.View(set.module.variables[parameter].name));
      for (const dialects::ValueRange& range : config->ranges) {
        if (EqualIgnoringCase(range.name, name)) options.declared.push_back({parameter, range.least, range.most});
      }
    }
  }
  return options;
}

}  // namespace ncport::app
