// Cutter compensation that begins while no tool and no radius has been named: the control has none to keep off by.
#include "check/comp_tool.h"

#include <cstdint>
#include <optional>

#include "check/comp_flow.h"
#include "check/expressions.h"
#include "check/motion_words.h"
#include "dialects/radius_registers.h"
#include "ir/analysis/forward_flow.h"
#include "ir/analysis/main_programs.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::ProgramId;
using ir::WordOp;

// What was named last on the ways to a block: a set of these.
constexpr std::uint8_t kNothing = 1;
constexpr std::uint8_t kNoRadius = 2;  // D0
constexpr std::uint8_t kTool = 4;      // with its radius; or something that may have named one
constexpr std::uint8_t kToolOnly = 8;  // and no register for its radius

class ToolFlow {
 public:
  using State = std::uint8_t;

  explicit ToolFlow(const Subject& subject)
      : module_(subject.module), registers_(dialects::RadiusInRegister(subject.profile)) {}

  State Entry(ProgramId program) const {
    // What nothing here calls is called with a tool.
    return ir::analysis::StartsAsMain(module_, program) ? kNothing : kTool;
  }
  static State Unknown(ProgramId) { return kTool; }
  static bool Join(BlockId, State& into, const State& from) {
    const State old = into;
    into |= from;
    return into != old;
  }
  void Transfer(ProgramId, BlockId id, State& state) const {
    const ir::Block& block = module_.blocks[id];
    if ((block.flags & ir::Block::kRefused) != 0) state = kTool;
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = module_.words[word_id];
      switch (word.op) {
        case WordOp::kTool:
        case WordOp::kToolChange:
          NameTool(state);
          break;
        case WordOp::kLengthOffset:
          // Without a value it only switches an offset on or off.
          if (word.value.Valid()) NameTool(state);
          break;
        case WordOp::kEdge:
        case WordOp::kRadiusOffset:
          state = LiteralValue(module_, word.value) == 0.0 ? kNoRadius : kTool;
          break;
        case WordOp::kToolOffset:
        case WordOp::kDataSetting:
          state = kTool;
          break;
        case WordOp::kAssign:
          // Values of the control: a program may set the tool's data by them.
          if (WritesSystem(word)) state = kTool;
          break;
        default:
          if (MayDoAnything(module_, word)) state = kTool;
          break;
      }
    }
  }

 private:
  /// A tool brings its radius with it, but not where the radius stands in registers of their own.
  void NameTool(State& state) const {
    if (!registers_)
      state = kTool;
    else if ((state & kNothing) != 0)
      state = static_cast<State>((state & ~kNothing) | kToolOnly);
  }

  [[nodiscard]] bool WritesSystem(const ir::Word& word) const {
    const auto place = word.Extra<ir::ExprId>();
    return !place.Valid() || module_.exprs[place].op == ir::ExprOp::kSystem;
  }

  const ir::Module& module_;
  bool registers_;  // D names the register of the radius, whatever the tool
};

struct Wording {
  const char* how;
  const char* help;
};
Wording WordingOf(std::uint8_t named) {
  if (named == kNoRadius) return {"without a radius", "D0 is in force on every way here: select the tool's D"};
  if ((named & kToolOnly) != 0)
    return {"without a radius", "no block on the way here names the register of the tool's radius: write D"};
  return {"without a tool", "no block on the way here names a tool or its D: write them in front of it"};
}

}  // namespace

void CheckCompTool(const Subject& subject, const CompFlow& comp, diag::Sink& sink) {
  const ir::Module& module = subject.module;
  ToolFlow client(subject);
  ir::analysis::ForwardFlow<ToolFlow> flow({module, subject.machine, subject.graphs, subject.calls, &subject.modal},
                                           client);
  flow.Run();
  for (const ProgramId program : module.programs.Ids()) {
    if (module.programs[program].library) continue;
    for (const BlockId id : module.programs[program].blocks) {
      const CompState* before = comp.Before(id);
      const std::uint8_t* named = flow.Before(id);
      if (before == nullptr || named == nullptr || (module.blocks[id].flags & ir::Block::kRefused) != 0) continue;
      const CompState at = comp.At(id, *before);
      if (at.ways != CompState::kSwitchedOn || !comp.MovesInPlane(program, id)) continue;
      std::uint8_t tool = *named;
      client.Transfer(program, id, tool);
      if ((tool & kTool) != 0) continue;
      const Wording wording = WordingOf(tool);
      sink.Report(diag::Code::kCompensationWithoutTool, subject.PlaceOf(at.switched, *comp.Switch(at.switched)),
                  wording.how)
          .help = wording.help;
      break;  // once a program: the next ones lack the same word
    }
  }
}

}  // namespace ncport::check
