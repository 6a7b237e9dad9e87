#include "app/value_rule_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "app/bind_inputs.h"
#include "base/letter_case.h"
#include "dialects/argument_letters.h"
#include "dialects/finding_alarms.h"
#include "dialects/language.h"

namespace ncport::app {

namespace {

/// Puts one range after the other where it belongs.
class RangeBinder {
 public:
  RangeBinder(const ProgramSet& set, check::ValueRuleOptions& options, diag::Sink& sink)
      : set_(set), module_(set.module), options_(options), sink_(sink) {}

  void Bind(const dialects::ValueRange& range) {
    const std::string_view name = range.name;
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) return BindCell(range);
    // Another program of the folder may be meant, which is not checked now.
    const ir::ProgramId program = FindByName(module_, name.substr(0, dot));
    if (!program.Valid() || BindArgument(range, program, name.substr(dot + 1))) return;
    sink_.Report(diag::Code::kUnknownKey, range.at, range.name).help =
        fmt::format("{} has no such parameter", name.substr(0, dot));
  }

 private:
  bool BindArgument(const dialects::ValueRange& range, ir::ProgramId program, std::string_view argument) {
    // An end that another input sets says nothing by itself.
    const bool fixed = range.least_of.empty() && range.most_of.empty();
    for (const ir::VariableId parameter : module_.programs[program].parameters) {
      if (!EqualIgnoringCase(module_.View(module_.variables[parameter].name), argument)) continue;
      if (fixed) options_.declared.push_back({parameter, range.least, range.most});
      return true;
    }
    if (argument.size() != 1) return false;
    const char letter = Upper(argument[0]);
    const std::uint32_t cell = dialects::CellOfArgument(set_.profile, letter);
    if (cell == 0) return false;
    for (const ir::SpaceId space : module_.spaces.Ids()) {
      const ir::Space& record = module_.spaces[space];
      if (record.visibility != ir::Visibility::kLevel || cell < record.first || cell > record.last) continue;
      if (fixed) options_.declared_cells.push_back({program, space, cell, range.least, range.most});
    }
    return true;
  }

  /// "#500", "R5". A name may be a variable of a program that is not checked now.
  void BindCell(const dialects::ValueRange& range) {
    const std::string_view name = range.name;
    const std::size_t digits = name.find_first_of("0123456789");
    if (digits == std::string_view::npos) return;
    std::uint32_t cell = 0;
    const auto [end, error] = std::from_chars(name.data() + digits, name.data() + name.size(), cell);
    if (error != std::errc{} || end != name.data() + name.size()) return;
    bool of_space = false;
    bool found = false;
    for (const ir::SpaceId space : module_.spaces.Ids()) {
      const ir::Space& record = module_.spaces[space];
      if (!EqualIgnoringCase(module_.View(record.name), name.substr(0, digits))) continue;
      of_space = true;
      if (cell < record.first || cell > record.last) continue;
      found = true;
      if (range.least_of.empty() && range.most_of.empty())
        options_.declared_cells.push_back({{}, space, cell, range.least, range.most});
    }
    if (of_space && !found)
      sink_.Report(diag::Code::kUnknownKey, range.at, range.name).help = "the machine has no such variable";
  }

  const ProgramSet& set_;
  const ir::Module& module_;
  check::ValueRuleOptions& options_;
  diag::Sink& sink_;
};

}  // namespace

check::ValueRuleOptions ValueRuleOptionsFor(Context& context, const ProgramSet& set, const dialects::Config* config) {
  check::ValueRuleOptions options;
  options.files = &context.files;
  options.control = fmt::format("{} alarm", dialects::TitleOf(set.profile.language));
  options.domain_alarm = dialects::AlarmFor(set.profile, diag::Code::kOutOfDomain);
  options.test_example = dialects::TestExampleOf(set.profile.language);
  if (config == nullptr) return options;
  RangeBinder binder(set, options, context.findings);
  for (const dialects::ValueRange& range : config->ranges) binder.Bind(range);
  return options;
}

}  // namespace ncport::app
