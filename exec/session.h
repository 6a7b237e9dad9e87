// What the parts of one run share: the linked module, the outside world, and how the run comes to an early end.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "exec/link.h"
#include "exec/run.h"
#include "ir/ops/result.h"

namespace ncport::exec {

struct Session {
  Session(const Linked& linked_module, const RunOptions& run_options, Environment& outside, diag::Sink& findings,
          Coverage* touched)
      : linked(linked_module),
        module(linked_module.module()),
        machine(linked_module.machine()),
        options(run_options),
        environment(outside),
        sink(findings),
        coverage(touched) {}

  const Linked& linked;
  const ir::Module& module;
  const ir::Machine& machine;
  const RunOptions& options;
  Environment& environment;
  diag::Sink& sink;
  Coverage* coverage;

  ir::BlockId block;               // being executed
  const ir::Word* word = nullptr;  // being evaluated: the place of findings; none = the block

  // The first trouble wins: work on the block goes on with harmless values until the loop looks at `halted`.
  bool halted = false;
  Outcome outcome = Outcome::kEnded;
  ir::AlarmClass alarm = ir::AlarmClass::kOther;
  std::string alarm_code;
  std::string alarm_text;

  bool message_stop = false;  // a write asks for a message and a stop

  /// Text of the first comment of the block: what alarms and messages of numbered variables show.
  [[nodiscard]] std::string_view CommentText() const {
    if (!block.Valid() || module.blocks[block].comments.Empty()) return {};
    return module.View(module.comments[module.blocks[block].comments[0]].text);
  }
  /// The number that the control shows for alarm `number` of the program.
  [[nodiscard]] std::uint32_t ShownAlarm(std::uint32_t number) const {
    for (const ir::AlarmNumbers& range : machine.alarm_numbers) {
      if (number >= range.first && number <= range.last)
        return range.one ? range.shown : range.shown + number - range.first;
    }
    return number;
  }

  /// The program ends in an alarm of the control.
  void Alarm(ir::AlarmClass kind, std::string_view text) {
    if (halted) return;
    halted = true;
    outcome = Outcome::kAlarmed;
    alarm = kind;
    alarm_text = text;
  }
  /// An alarm of arithmetic or conversion; nothing for kNone.
  void Alarm(ir::ops::Error error) {
    if (error == ir::ops::Error::kNone) return;
    Alarm(error == ir::ops::Error::kConversion ? ir::AlarmClass::kConversion : ir::AlarmClass::kArithmetic,
          ir::ops::TextOf(error));
  }
  /// The run cannot go on without guessing: a finding at the present word.
  template <class... Args>
  void Refuse(diag::Code code, const Args&... args) {
    if (halted) return;
    halted = true;
    outcome = Outcome::kRefused;
    sink.Report(code, Place(), args...);
  }
  /// A budget is used up; `option` raises it.
  template <class... Args>
  void Limit(std::string_view option, diag::Code code, const Args&... args) {
    if (halted) return;
    halted = true;
    outcome = Outcome::kLimit;
    sink.Report(code, Place(), args...).help = fmt::format("raise it with {}", option);
  }

  [[nodiscard]] SourceRange Place() const {
    if (!block.Valid()) return {};
    return word != nullptr ? module.RangeOf(module.blocks[block], *word) : module.RangeOf(module.blocks[block]);
  }
};

}  // namespace ncport::exec
