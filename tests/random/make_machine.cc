// Spindle, tools, M functions, messages, stops, comments.
#include <fmt/format.h>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::WordOp;

void Maker::MakeSpindle() {
  ir::BlockBuilder block = NewBlock();
  static constexpr ir::SpindleState kStates[] = {ir::SpindleState::kCw, ir::SpindleState::kCcw, ir::SpindleState::kCw,
                                                 ir::SpindleState::kStop};
  const ir::SpindleState state = random_.Pick(kStates);
  // A speed in m/min or 1/min, whichever is in force: both are plain numbers.
  const bool open = known_.modes.speed_mode == ir::SpeedMode::kUnknown;
  if (state != ir::SpindleState::kStop && random_.Percent(60) && (!open || Draw(Feature::kOpenSpeedMode))) {
    Word(block, WordOp::kSpeed, NumberIn({60, 300, !Draw(Feature::kFractionalSpeed)}, 2).id);
  }
  Code(block, WordOp::kSpindle, 0, static_cast<std::uint32_t>(state));
  Emit(block, true);
}

void Maker::MakeSpindlePosition() {
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kSpindlePosition, NumberIn({0, 359, false}, 2).id);
  Emit(block);
}

void Maker::MakeTool() {
  // Translated programs change tools where one is in force on every way.
  if (!Has(Feature::kComputedTool) && (depth_ > 0 || !in_main_)) return MakeAux();
  // Between two tools a lathe may drive home: from a position that is known.
  if (TransverseAxis() != 0xFF && !Has(Feature::kBlindStep) && position_known_) Approach(AllAxes());
  ir::BlockBuilder block = NewBlock();
  const bool named = IsSinumerik() && random_.Percent(20);
  Word(block, WordOp::kTool,
       named ? expr_.Text(random_.Percent(50) ? "MILL_10" : "Drill 5")
             : As(Draw(Feature::kComputedTool) ? NumberIn({1, 12, true}, 1) : Literal({1, 12, true}), ir::Type::kInt));
  const bool lathe = TransverseAxis() != 0xFF;
  const bool edge = random_.Percent(80);
  const bool early = lathe || Draw(Feature::kEdgeBeforeChange);
  const auto name_edge = [&](ir::BlockBuilder& in) {
    Word(in, WordOp::kEdge, As(Literal({1, 3, true}), ir::Type::kInt));
  };
  if (edge && early) name_edge(block);
  Emit(block);
  if (lathe) return;
  ir::BlockBuilder change = NewBlock();
  Code(change, WordOp::kToolChange);
  if (edge && !early) name_edge(change);
  Emit(change);
}

void Maker::MakeAux() {
  ir::BlockBuilder block = NewBlock();
  static constexpr std::uint32_t kCodes[] = {7, 8, 9, 8, 9};
  AddAux(block, random_.Pick(kCodes));
  Emit(block, true);
}

void Maker::AddAux(ir::BlockBuilder& block, std::uint32_t code) {
  // M9 acts behind the motion and has a row of its own.
  Code(block, WordOp::kAux, 0, code == 9 ? 9 : Id<void>::kNone);
  block.Last().extra = Id<void>::kNone;
  block.Last().value = expr_.Number(fmt::format("{}", code), ir::Type::kInt);
  if (code != 9) block.Last().phase = ir::Phase::kBefore;
}

void Maker::MakeAuxH() {
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kAuxH, NumberIn({0, 90, true}, 1).id);
  Emit(block, true);
}

void Maker::MakeStop() {
  ir::BlockBuilder block = NewBlock();
  Code(block, random_.Percent(50) ? WordOp::kStop : WordOp::kOptionalStop);
  Emit(block, true);
}

void Maker::MakeMessage() {
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kMessage, random_.Percent(20) ? ir::ExprId{} : TextValue(2));
  Emit(block, true);
}

// An alarm that ends the run stands where few runs come by; one that only shows may stand anywhere.
void Maker::MakeAlarm() {
  const bool stops = !Draw(Feature::kShownAlarm);
  const std::uint32_t number = stops ? 65000 + random_.Below(100) : 67000 + random_.Below(100);
  const auto alarm = [&] {
    ir::BlockBuilder block = NewBlock();
    // A comment behind #3000 would be its text.
    const ir::ExprId text = random_.Percent(50) || !IsSinumerik() ? expr_.Text("CHECK PART") : ir::ExprId{};
    Word(block, WordOp::kAlarm,
         expr_.Number(fmt::format("{}", IsSinumerik() ? number : random_.Below(200)), ir::Type::kInt),
         static_cast<std::uint8_t>(stops ? ir::AlarmKind::kStops : ir::AlarmKind::kShows), text.value);
    Emit(block);
  };
  if (!stops) return alarm();
  if (Deep()) return MakeCommentLine();
  // Jumped over by one condition or either of two.
  Pending over = NewTarget(false);
  over.known = known_;
  EmitJump(over, Truth(1), true);
  if (random_.Percent(50)) EmitJump(over, Truth(1), true);
  alarm();
  PlaceLabel(over);
}

void Maker::MakePreprocessStop() {
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kPreprocessStop, {});
  Emit(block);
}

void Maker::MakeInert() {
  static constexpr std::string_view kWords[] = {"CFC", "NORM", "G450", "BRISK", "SOFT", "FFWOF", "G601"};
  ir::BlockBuilder block = NewBlock();
  Word(block, WordOp::kInert, {});
  block.Last().spelling = ir::AddSpelling(module_, random_.Pick(kWords), "sinumerik-8.1");
  Emit(block, true);
}

void Maker::MakeCommentLine() {
  ir::BlockBuilder block = program_->Block();
  if (random_.Percent(85)) block.Comment(CommentText(), ir::CommentPlace::kOwnLine);
  block.Finish();
}

// A word that may stand beside others: an M function, a spindle word.
void Maker::AddBeside(ir::BlockBuilder& block) {
  if (!Draw(Feature::kWordsBeside)) return;
  if (Has(Feature::kAux) && random_.Percent(50)) {
    AddAux(block, random_.Percent(50) ? 8 : 9);
  } else if (Has(Feature::kSpindle)) {
    Code(block, WordOp::kSpindle, 0,
         static_cast<std::uint32_t>(random_.Percent(50) ? ir::SpindleState::kCw : ir::SpindleState::kStop));
  }
}

}  // namespace ncport::tests::random
