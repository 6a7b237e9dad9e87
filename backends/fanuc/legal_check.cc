#include "backends/fanuc/legal_check.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "backends/fanuc/references.h"
#include "backends/fanuc/text_word.h"
#include "dialects/fanuc/words.h"
#include "ir/enum_names.h"
#include "ir/transform/linear_form.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Module;
using ir::Word;
using ir::WordOp;
using ir::transform::VisitReads;

/// Without brackets and conversions that change nothing.
ir::ExprId BareValue(const Module& module, ir::ExprId id) {
  while (module.exprs[id].op == ir::ExprOp::kGroup || module.exprs[id].op == ir::ExprOp::kPlus ||
         module.exprs[id].op == ir::ExprOp::kConvert)
    id = ir::ExprId{module.exprs[id].a};
  return id;
}

}  // namespace

bool CheckLegal(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  const auto system = *dialects::fanuc::SystemOf(profile);
  bool ok = true;
  std::set<std::string> asked;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      const auto refuse = [&](const Word& word, std::string_view what) -> diag::Diagnostic& {
        ok = false;
        return sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), what, profile.name);
      };
      // A setting that the profile leaves open is named once.
      const auto need = [&](const auto& setting, const Word& word) {
        if (setting.Known()) return;
        ok = false;
        if (asked.insert(std::string(setting.Key())).second)
          static_cast<void>(dialects::Need(profile, setting, module.RangeOf(block, word), sink));
      };
      if ((block.flags & ir::Block::kRefused) != 0) {
        ok = false;
        continue;  // has its finding already
      }
      for (const ir::WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        const auto values = [&](ir::ExprId value) {
          VisitReads(module, value, [&](ir::ExprId read) {
            const ir::Expr& expr = module.exprs[read];
            if (expr.op != ir::ExprOp::kSystem) return;
            const ir::System& system = module.systems[ir::SystemId{expr.a}];
            diag::Diagnostic& finding = refuse(word, module.View(system.name));
            if (system.kind == ir::SystemKind::kActiveFeed)
              finding.help = "where F is one number on every way to this block, that number stands for it";
          });
        };
        values(word.value);
        if (word.op == WordOp::kAssign) values(word.Extra<ir::ExprId>());
        if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<ir::CallId>().Valid()) {
          values(module.calls[word.Extra<ir::CallId>()].passes);
          for (const ir::ArgId arg : module.calls[word.Extra<ir::CallId>()].args) values(module.args[arg].value);
        }
        const bool whole_only = word.op == WordOp::kSpeed || word.op == WordOp::kRadiusOffset ||
                                word.op == WordOp::kLengthOffset || word.op == WordOp::kAux;
        if (whole_only && word.value.Valid()) {
          const ir::Expr& value = module.exprs[BareValue(module, word.value)];
          if (value.op == ir::ExprOp::kLiteral && value.number != std::floor(value.number)) {
            ok = false;
            sink.Report(diag::Code::kWordTooCoarse, module.RangeOf(block, word), fmt::format("{:g}", value.number),
                        "whole number");
          }
        }
        const auto named = [&] {
          if (word.op == WordOp::kMotion && word.spelling == 0)
            return fmt::format("the motion mode {}", ir::NameOf(static_cast<ir::Motion>(word.index)));
          return word.spelling != 0 ? std::string(module.View(module.spellings[word.spelling].text))
                                    : std::string(ir::NameOf(word.op));
        };
        switch (word.op) {
          case WordOp::kAssign:
          case WordOp::kWhile:
          case WordOp::kEndWhile:
          case WordOp::kJump:
          case WordOp::kWhen:
          case WordOp::kAlarm:
          case WordOp::kCenter:
          case WordOp::kRadius:
          case WordOp::kFeed:
          case WordOp::kStartAngle:
          case WordOp::kSpeed:
          case WordOp::kRadiusOffset:
          case WordOp::kAux:
          case WordOp::kChamfer:  // MapCorners left those only that the target has
            break;
          case WordOp::kSpeedLimit:
            need(profile.spindle.limit, word);
            break;
          case WordOp::kProgramEnd:
            need(profile.words.end, word);
            break;
          case WordOp::kFrame:  // G52, G68, G69; all others were refused
          case WordOp::kFrameAngle:
            break;
          case WordOp::kReturn:
            need(profile.words.sub_end, word);
            if (word.value.Valid()) refuse(word, "a return to a label of the caller");
            break;
          case WordOp::kInert:
            // Made by a pass of this target, or a word of the source that has no effect here: that one is not carried
            // over.
            if (IsTextWord(module, word)) break;
            refuse(word, named());
            break;
          case WordOp::kAxis:
            if (word.index >= ir::kLetterAxes) {
              refuse(word, "an axis with a name of its own");
            } else if (word.mode == ir::ValueMode::kIncremental && !HasIncrementLetter(profile, word.index)) {
              refuse(word, "an increment of one axis");
            }
            break;
          case WordOp::kCall:
          case WordOp::kModalCall: {
            const auto call = word.Extra<ir::CallId>();
            if (!call.Valid()) break;
            if (module.calls[call].program.Valid()) break;
            const ir::ExprId name = module.calls[call].name_expr;
            const bool text = name.Valid() && module.exprs[name].op == ir::ExprOp::kText;
            ok = false;
            sink.Report(diag::Code::kUnknownProgram, module.RangeOf(block, word),
                        module.View(text ? StringId{std::size_t{module.exprs[name].a}} : module.calls[call].name));
            break;
          }
          case WordOp::kSpindle:
            if (word.extra == static_cast<std::uint32_t>(ir::SpindleState::kPositioned)) {
              refuse(word, named());
            } else {
              const auto state = static_cast<ir::SpindleState>(word.extra);
              const auto& words = profile.spindle;
              need(state == ir::SpindleState::kCw    ? words.cw
                   : state == ir::SpindleState::kCcw ? words.ccw
                                                     : words.stop,
                   word);
            }
            break;
          case WordOp::kDwellSeconds:
            need(profile.words.dwell, word);
            break;
          default: {
            const std::uint32_t extra = word.op == WordOp::kWorkOffset ? word.extra : Id<void>::kNone;
            if (dialects::fanuc::Codes(system).FindMeaning(word.op, word.index, extra) == nullptr)
              refuse(word, named());
          }
        }
      }
    }
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
