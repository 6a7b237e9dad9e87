#include "backends/translate.h"

#include <fmt/format.h>

#include "backends/fanuc/argument_letter.h"
#include "backends/fanuc/machine_sheet.h"
#include "backends/fanuc/raise.h"
#include "backends/fanuc/write.h"
#include "backends/sinumerik/raise.h"
#include "backends/sinumerik/write.h"
#include "base/result.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/verify.h"

namespace ncport::backends {

namespace {

/// What of the word only the run knows; empty: nothing.
std::string_view OfTheRun(const ir::Module& module, const ir::Word& word) {
  switch (word.op) {
    case ir::WordOp::kAssign:
      return "a variable";
    case ir::WordOp::kJump:
    case ir::WordOp::kSwitch:
      return "a jump";
    case ir::WordOp::kCall:
    case ir::WordOp::kModalCall:
      return "a call";
    case ir::WordOp::kRepeatPart:
      return "a repeated part";
    default:
      break;
  }
  if (ir::IsStructureMark(word.op)) return "a branch or loop";
  if (!word.value.Valid()) return {};
  ir::ExprId id = word.value;
  while (module.exprs[id].op == ir::ExprOp::kGroup || module.exprs[id].op == ir::ExprOp::kConvert ||
         module.exprs[id].op == ir::ExprOp::kNegate || module.exprs[id].op == ir::ExprOp::kPlus)
    id = ir::ExprId{std::size_t{module.exprs[id].a}};
  const ir::ExprOp op = module.exprs[id].op;
  return op == ir::ExprOp::kCell || op == ir::ExprOp::kCellAt || op == ir::ExprOp::kVariable ||
                 op == ir::ExprOp::kElement
             ? "a variable"
             : std::string_view{};
}

/// The first place that a program of literal words cannot say.
void ReportFirstOfTheRun(const ir::Module& module, std::string_view target, diag::Sink& sink) {
  for (const ir::Program& program : module.programs.All()) {
    if (program.library) continue;
    for (const ir::BlockId block : program.blocks) {
      for (const ir::WordId id : module.blocks[block].words) {
        const std::string_view what = OfTheRun(module, module.words[id]);
        if (what.empty()) continue;
        sink.Report(diag::Code::kLiteralOnly, module.RangeOf(module.blocks[block], module.words[id]), what, target);
        return;
      }
    }
  }
}

bool RaiseFor(const TranslateInput& input, Translation& translation, diag::Sink& sink) {
  switch (input.to->language) {
    case dialects::Language::kFanuc:
      return fanuc::Raise(
          {input.source, input.source_machine, input.to, input.config, input.from, input.keep_increments}, translation,
          sink);
    case dialects::Language::kSinumerik:
      return sinumerik::Raise({input.source, input.from, input.source_machine, input.to, input.config,
                               input.from->language == dialects::Language::kFanuc ? fanuc::ArgumentLetter : nullptr},
                              translation, sink);
    default:
      break;
  }
  ReportFirstOfTheRun(*input.source, input.to->name, sink);
  sink.Report(diag::Code::kNotExpressible, SourceRange{}, "a program with loops, calls and variables", input.to->name)
      .help = "ncport flatten writes programs of literal blocks";
  return false;
}

}  // namespace

bool Raise(const TranslateInput& input, Translation& translation, diag::Sink& sink) {
  const bool done = RaiseFor(input, translation, sink);
  // A pass that refused may have left its work half done.
  if (done) ir::Verify(translation.module, "after raising", {.names_resolved = true, .structure_built = true});
  return done;
}

MachineSheet SheetOf(const dialects::Profile& to, const std::vector<OutputFile>& files) {
  return to.language == dialects::Language::kFanuc ? fanuc::SheetOf(to, files) : MachineSheet{};
}

dialects::Profile ForReading(const dialects::Profile& to) {
  dialects::Profile profile = to;
  // Angles are brought between -180 and 180 behind each function that yields them (fanuc-14, rows 32 and 33).
  if (!profile.fanuc.atan_range.Known()) profile.fanuc.atan_range.Set(dialects::FanucSettings::AtanRange::kPositive);
  return profile;
}

std::vector<ir::Word> StopWords(const dialects::Profile& to, ir::Module& module) {
  if (to.language == dialects::Language::kFanuc) {
    // As text: what follows keeps the modes of the source, as if the block had done nothing.
    const std::uint32_t number = to.fanuc.alarms.Known() ? to.fanuc.alarms->last : 999;
    ir::Word word = ir::MakeWord(ir::WordOp::kInert);
    word.spelling = ir::AddSpelling(module, fmt::format("#3000={}(NOT*TRANSLATED)", number), "");
    return {word};
  }
  const ir::ExprId alarm = ir::ExprBuilder(module).Literal(kStopAlarm, ir::Type::kInt);
  return {ir::MakeWord(ir::WordOp::kAlarm, ir::AlarmKind::kStops, alarm), ir::MakeWord(ir::WordOp::kStop)};
}

std::vector<OutputFile> Print(const dialects::Profile& to, const Translation& translation,
                              const std::vector<ProgramHeader>& headers) {
  switch (to.language) {
    case dialects::Language::kFanuc:
      return fanuc::Write(to, translation, headers);
    case dialects::Language::kSinumerik:
      return sinumerik::Write(to, translation, headers);
    default:
      NCPORT_BUG("a module for {} reached the printers", to.name);
  }
}

}  // namespace ncport::backends
