// Findings about values, gathered over all ways into a program: each place is reported once, as badly as the worst way
// to it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "ir/analysis/value_range.h"
#include "ir/machine.h"
#include "ir/module.h"

namespace ncport::check {

/// kPossible: the values allow it, but nothing in the program says that it happens (inputs of an operator, arguments of
/// a caller that is not known). kLikely: the program itself lets such a value through. kCertain: whenever control comes
/// here this way.
enum class Certainty : std::uint8_t { kPossible, kLikely, kCertain };

struct ValueRuleOptions {
  const SourceFiles* files = nullptr;  // for texts of expressions
  std::string control;                 // "NAME alarm", put before the number of an alarm; empty: no alarm is named
  std::string domain_alarm;            // of a function outside of its domain, whole; empty: none is certain
  std::string
      test_example;  // how a program of the language tests a value first; {0} is the value, {1} the sign == or <=
  std::vector<ir::analysis::DeclaredRange> declared;
  std::vector<ir::analysis::DeclaredCell> declared_cells;
  bool all = false;  // also kPossible
};

/// What the rules share.
struct ValueRuleInput {
  const ir::Module& module;
  const ir::Machine& machine;
  const ValueRuleOptions& options;
};

struct ValueFinding {
  diag::Code code;
  Certainty certainty = Certainty::kPossible;
  std::string first = {}, second = {}, third = {};  // arguments of the text
  SourceRange at = {};
  std::vector<diag::Note> notes = {};
  std::string help = {};
  std::string control = {};
};

class ValueFindings {
 public:
  explicit ValueFindings(const ValueRuleInput& input) : input_(input) {}

  /// True if a finding of this certainty would be news; `expr` and `part` tell places apart.
  [[nodiscard]] bool IsNews(diag::Code code, ir::ExprId expr, std::uint32_t part, Certainty certainty) const;
  void Add(ir::ExprId expr, std::uint32_t part, ValueFinding finding);
  void Report(diag::Sink& sink) const;

 private:
  const ValueRuleInput& input_;
  std::map<std::tuple<diag::Code, std::uint32_t, std::uint32_t>, ValueFinding> findings_;
};

/// Base of the rules.
class ValueRule : public ir::analysis::RangeObserver {
 public:
  ValueRule(const ValueRuleInput& input, ValueFindings& findings) : input_(input), findings_(findings) {}
  /// After the last block: for rules that look at all ways together.
  virtual void Finish(diag::Sink& /*sink*/) {}

 protected:
  using Site = ir::analysis::RangeSite;
  using Interval = ir::analysis::Interval;
  using Lookup = ir::analysis::RangeLookup;

  [[nodiscard]] SourceRange RangeOf(const Site& site, ir::ExprId expr) const;
  /// As the source writes it, or the name.
  [[nodiscard]] std::string TextOf(const Site& site, ir::ExprId expr) const;
  [[nodiscard]] std::string ControlAlarm(ir::AlarmClass alarm) const;
  /// Why `expr` has its values: what its variables are, and which call brings them.
  [[nodiscard]] std::vector<diag::Note> Reasons(const Site& site, ir::ExprId expr, Lookup& lookup) const;
  /// The value, with nothing around it: no brackets, signs, conversions.
  [[nodiscard]] ir::ExprId Bare(ir::ExprId expr) const;

  const ValueRuleInput& input_;
  ValueFindings& findings_;
};

/// "0", "-1 to 5", "5 or more".
std::string TextOf(const ir::analysis::Interval& values);

/// The program itself sets these bounds: they follow from no input, and no loop without a test or range of a type made
/// them as wide as they are.
bool IsKnown(const ir::analysis::Interval& values);

}  // namespace ncport::check
