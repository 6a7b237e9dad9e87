#include "ir/transform/absolute_dimensions.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "ir/axis_names.h"
#include "ir/block_words.h"
#include "ir/length_units.h"
#include "ir/make_word.h"
#include "ir/transform/dimension_pass.h"

namespace ncport::ir::transform {

namespace {

/// Words that make the axis words of their block something else than a move.
bool AxisWordsAreMoves(const Module& module, const Block& block) {
  for (const WordId id : block.words) {
    switch (module.words[id].op) {
      case WordOp::kFrame:
      case WordOp::kReference:
      case WordOp::kPole:
      case WordOp::kPresetPosition:
      case WordOp::kMachineCoords:
        return false;
      default:
        break;
    }
  }
  return true;
}

}  // namespace

const Word* DimensionPass::WordFor(BlockId block, std::uint8_t axis) const {
  for (const WordId id : module_.blocks[block].words) {
    const Word& word = module_.words[id];
    if (word.op == WordOp::kAxis && word.index == axis) return &word;
  }
  return nullptr;
}

const Word* DimensionPass::WordOf(BlockId block, WordOp op) const {
  for (const WordId id : module_.blocks[block].words) {
    if (module_.words[id].op == op) return &module_.words[id];
  }
  return nullptr;
}

double DimensionPass::UnitFactor(const ModalState& state) { return MmPerLengthUnit(state.units); }

bool DimensionPass::Conditional(const Block& block) const {
  return block.skip_level != Block::kNoSkip || HasWord(module_, block, WordOp::kWhen) ||
         HasWord(module_, block, WordOp::kSkipRest);
}

void DimensionPass::Unknown(BlockId block, const Word& word, std::uint8_t axis) {
  ok_ = false;
  diag::Diagnostic& finding = sink_.Report(diag::Code::kUnknownPosition, module_.RangeOf(module_.blocks[block], word),
                                           std::string(1, kAxisLetters[axis]));
  finding.help = "program the axis once with an absolute word before the increment, on every way that leads here";
  const auto caller = unknown_callers_.find({program_.value, axis});
  if (caller != unknown_callers_.end())
    finding.notes.push_back({module_.RangeOf(module_.blocks[caller->second]), "it is not known at this call"});
}

DimensionPass::Scale DimensionPass::ScaleOf(const Word& word, std::uint8_t axis, const ModalState& state, BlockId block,
                                            bool report) {
  Scale scale;
  // Where no way leads, nothing runs under any mode.
  const bool reached = flow_.Reached(program_, block);
  const auto unknown = [&](std::string_view group) {
    scale.known = false;
    if (!report || !reached) return;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[block], word), group,
                 "the programs that lead here leave it open");
  };
  bool diameter = false;  // the number is a diameter
  const bool transverse = axis == source_.transverse_axis;
  switch (word.mode) {
    case ValueMode::kModal:
      if (state.distance == Distance::kUnknown) unknown("the distance mode (absolute or incremental)");
      scale.incremental = state.distance == Distance::kIncremental;
      break;
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      scale.incremental = true;
      break;
    default:
      break;
  }
  switch (word.mode) {
    case ValueMode::kAbsoluteDiameter:
    case ValueMode::kIncrementalDiameter:
      diameter = true;
      break;
    case ValueMode::kAbsoluteRadius:
    case ValueMode::kIncrementalRadius:
      break;
    default:
      if (!transverse) break;
      if (state.diameter == Diameter::kUnknown) unknown("the diameter mode");
      diameter = state.diameter == Diameter::kDiameter ||
                 (state.diameter == Diameter::kDiameterAbsolute && !scale.incremental);
      break;
  }
  const bool wants_diameter = axis == config_.diameter_axis;
  scale.factor = wants_diameter == diameter ? 1 : wants_diameter ? 2 : 0.5;
  if (!IsRotary(axis)) scale.factor *= UnitFactor(state);
  return scale;
}

Step DimensionPass::StepOf(BlockId id, Slot slot) const {
  for (const WordId word_id : module_.blocks[id].words) {
    const Word& call = module_.words[word_id];
    if ((call.op != WordOp::kCall && call.op != WordOp::kModalCall) || !call.Extra<CallId>().Valid()) continue;
    const ProgramId callee = module_.calls[call.Extra<CallId>()].program;
    if (ReturnedAt(id) >> slot & 1U) return Step::kReturned;
    const SlotMask slots = callee.Valid() ? effects_[callee.value].slots : kAllSlots;
    if (slots >> slot & 1U) return Step::kLost;
  }
  return slot < kMaxAxes ? AxisStep(id, slot) : slot < kShift ? PolarStep(id, slot) : ShiftStep(id, slot);
}

Step DimensionPass::AxisStep(BlockId id, std::uint8_t axis) const {
  const Block& block = module_.blocks[id];
  const Word* word = WordFor(id, axis);
  const PlaneWords& plane = plane_words_[IndexOf(id)];
  if (HasWord(module_, block, WordOp::kAxisComputed) || HasWord(module_, block, WordOp::kContourAngle)) {
    const bool named = word != nullptr && !HasWord(module_, block, WordOp::kContourAngle);
    return named ? Step::kAbsolute : Step::kLost;
  }
  if (frames_.Any() && FrameWord(id) != nullptr && (axis < 3 || word == nullptr))
    return axis < 3 ? Step::kComputed : Step::kNone;
  if (LosesUnderFrame(id, axis)) return Step::kLost;
  if (HasWord(module_, block, WordOp::kFrame) || HasWord(module_, block, WordOp::kWorkOffset) ||
      HasWord(module_, block, WordOp::kPresetPosition)) {
    // The zero point moves: what the axis stands at is another number now.
    if (word == nullptr || !AxisWordsAreMoves(module_, block)) return Step::kLost;
  }
  if (plane.kind == PlaneWords::Kind::kPole) return Step::kNone;
  if ((plane.kind == PlaneWords::Kind::kPolar || plane.kind == PlaneWords::Kind::kOpeningCenter) && plane.HasAxis(axis))
    return Step::kComputed;
  if (word == nullptr) return Step::kNone;
  if (!AxisWordsAreMoves(module_, block)) return Step::kLost;
  switch (word->mode) {
    case ValueMode::kIncremental:
    case ValueMode::kIncrementalDiameter:
    case ValueMode::kIncrementalRadius:
    case ValueMode::kStep:
      return Step::kIncremental;
    case ValueMode::kModal:
      return flow_.At(program_, id).distance == Distance::kIncremental ? Step::kIncremental : Step::kAbsolute;
    default:
      return Step::kAbsolute;
  }
}

ExprId DimensionPass::Scaled(ExprId value, double factor) {
  return factor == 1 ? value : ExprOf(module_, ScaledForm(value, factor));
}

/// From the start point, as radius, mm. None: an absolute one while the position is not known.
std::optional<LinearForm> DimensionPass::CenterForm(BlockId id, const Word& word, const Slots& in) const {
  const ModalState state = flow_.At(program_, id);
  if (word.mode != ValueMode::kAbsolute) return ScaledForm(word.value, UnitFactor(state));
  const std::uint8_t axis = word.index;
  if (!in[axis].Known()) return std::nullopt;
  const bool diameter = axis == source_.transverse_axis && source_.centers_are_diameter_when_absolute &&
                        (state.diameter == Diameter::kDiameter || state.diameter == Diameter::kDiameterAbsolute);
  const LinearForm center = ScaledForm(word.value, (diameter ? 0.5 : 1) * UnitFactor(state));
  return Sum(module_, center, in[axis].form, axis == config_.diameter_axis ? -0.5 : -1);
}

/// Lengths and feeds besides the axis words, in the target's units.
void DimensionPass::RewriteCenter(BlockId id, Word& word, const Slots& in) {
  const ModalState state = flow_.At(program_, id);
  if (word.op == WordOp::kRadius || word.op == WordOp::kChamfer ||
      (word.op == WordOp::kCenter && word.mode != ValueMode::kAbsolute)) {
    word.value = Scaled(word.value, UnitFactor(state));
  } else if (word.op == WordOp::kFeed && state.units == Units::kInch && state.feed_mode != FeedMode::kInverseTime) {
    const bool open = state.feed_mode == FeedMode::kUnknown && inverse_time_;
    if (open) RefuseOpenMode(id, word, "the feed mode (a length or 1/min)");
    word.value = Scaled(word.value, kMmPerInch);
  } else if (word.op == WordOp::kSpeed && state.units == Units::kInch && state.speed_mode == SpeedMode::kUnknown) {
    if (surface_speed_) RefuseOpenMode(id, word, "the speed mode (1/min or surface speed)");
  } else if (word.op == WordOp::kSpeed && state.units == Units::kInch &&
             state.speed_mode == SpeedMode::kConstantSurface) {
    // A number is checked where it is printed; a computed one would be rounded to whole m/min unseen.
    if (!FormOf(module_, word.value).IsConstant()) {
      ok_ = false;
      sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[id], word),
                   "a computed surface speed in ft/min", "whole m/min");
    }
    word.value = Scaled(word.value, kMetersPerFoot);
  } else if (word.op == WordOp::kCenter) {
    // A target's centre words are radius values on every axis.
    const std::optional<LinearForm> center = CenterForm(id, word, in);
    if (!center) return Unknown(id, word, word.index);
    word.value = ExprOf(module_, *center);
    word.mode = ValueMode::kStep;
  }
}

/// A number that is scaled in one mode and not in another.
void DimensionPass::RefuseOpenMode(BlockId id, const Word& word, std::string_view group) {
  if (!flow_.Reached(program_, id)) return;
  ok_ = false;
  sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(module_.blocks[id], word), group,
               "the programs that lead here leave it open");
}

/// Machine coordinates are absolute whatever the distance mode; their unit and diameters are those of the block.
void DimensionPass::RewriteMachineWords(BlockId id) {
  const ModalState state = flow_.At(program_, id);
  std::vector<Word> words;
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op == WordOp::kAxis) {
      const Scale scale = ScaleOf(word, word.index, state, id, true);
      if (scale.known && scale.incremental) Unknown(id, word, word.index);
      if (scale.known && !scale.incremental) {
        word.value = Scaled(word.value, scale.factor);
        word.mode = ValueMode::kAbsolute;
      }
    }
    words.push_back(word);
  }
  rewritten_.emplace_back(id, std::move(words));
}

/// True where some program switches to it: a mode that is not one on every way may then be that.
bool DimensionPass::Occurs(WordOp op, std::uint8_t value) const {
  return std::ranges::any_of(module_.words.All(),
                             [&](const Word& word) { return word.op == op && word.index == value; });
}

void DimensionPass::FindModesThatOccur() {
  const auto occurs = [&](WordOp op, auto value, auto start, auto sub_entry) {
    return start == value || sub_entry == value || Occurs(op, static_cast<std::uint8_t>(value));
  };
  const ModalState& start = source_.start;
  const ModalState& entry = config_.sub_entry;
  for (const Units units : {Units::kInch, Units::kInchGeometry}) {
    inches_ = inches_ || occurs(WordOp::kUnits, units, start.units, entry.units);
  }
  inverse_time_ = occurs(WordOp::kFeedMode, FeedMode::kInverseTime, start.feed_mode, entry.feed_mode);
  surface_speed_ = occurs(WordOp::kSpeedMode, SpeedMode::kConstantSurface, start.speed_mode, entry.speed_mode);
}

void DimensionPass::RefuseOpenUnits(BlockId id) {
  const ModalState state = flow_.At(program_, id);
  if (!inches_ || state.units != Units::kUnknown || !flow_.Reached(program_, id)) return;
  const Block& block = module_.blocks[id];
  if (HasWord(module_, block, WordOp::kReference)) return;
  const Word* const frame = FrameWord(id);
  const bool turns = frame != nullptr && frame->index != static_cast<std::uint8_t>(FrameOp::kTranslate) &&
                     frame->index != static_cast<std::uint8_t>(FrameOp::kAddTranslate);
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    bool length = false;
    switch (word.op) {
      case WordOp::kAxis:
        length = !IsRotary(word.index) && !turns;
        break;
      case WordOp::kCenter:
      case WordOp::kRadius:
      case WordOp::kVia:
      case WordOp::kChamfer:
      case WordOp::kPolarRadius:
        length = true;
        break;
      case WordOp::kFeed:
      case WordOp::kFeedOnce:
        length = state.feed_mode != FeedMode::kInverseTime;
        break;
      case WordOp::kSpeed:
        length = state.speed_mode == SpeedMode::kConstantSurface;
        break;
      default:
        break;
    }
    if (!length) continue;
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, module_.RangeOf(block, word), "the unit of lengths (mm or inch)",
                 "the programs that lead here leave it open");
    return;
  }
}

void DimensionPass::RewriteWords(BlockId id, const Slots& in) {
  RefuseOpenUnits(id);
  if (HasWord(module_, module_.blocks[id], WordOp::kMachineCoords)) return RewriteMachineWords(id);
  if (plane_words_[IndexOf(id)].kind == PlaneWords::Kind::kPole) return RemovePole(id, in);
  if (config_.work_frames_in && FrameWord(id) != nullptr) return RemoveFrame(id);
  if (!AxisWordsAreMoves(module_, module_.blocks[id])) return;
  const ModalState state = flow_.At(program_, id);
  std::vector<Word> words;
  for (const WordId word_id : module_.blocks[id].words) {
    Word word = module_.words[word_id];
    if (word.op == WordOp::kAxis) {
      const Scale scale = ScaleOf(word, word.index, state, id, true);
      if (scale.known && (!scale.incremental || KeptAt(id, word.index))) {
        word.value = Scaled(word.value, scale.factor);
      } else if (scale.known && in[word.index].Known()) {
        word.value = ExprOf(module_, Sum(module_, in[word.index].form, ScaledForm(word.value, scale.factor)));
      } else if (scale.known) {
        Unknown(id, word, word.index);
      }
    } else {
      RewriteCenter(id, word, in);
    }
    words.push_back(word);
    if (word.op != WordOp::kAxis) continue;
    words.back().mode = ValueMode::kAbsolute;
    if (KeptAt(id, word.index)) words.back().mode = ValueMode::kIncremental;
  }
  if (plane_words_[IndexOf(id)].Moves() && !LowerPlaneWords(id, in, words)) return;
  if (cut_.contains(id.value) && WordOf(id, WordOp::kMotion) == nullptr) {
    // the corner in front may be an arc
    words.insert(words.begin(), MakeWord(WordOp::kMotion, Motion::kLinear));
  }
  std::vector<std::vector<Word>> before, after;
  if (HasWord(module_, module_.blocks[id], WordOp::kTurns) && !LowerTurns(id, in, words, before)) return;
  if (CornerMoves(id) && !LowerCorner(id, in, words, after)) return;
  if (config_.work_frames_in && frames_.Any()) {
    for (auto* pieces : {&before, &after}) {
      for (std::vector<Word>& piece : *pieces) {
        if (!ApplyFrame(id, in, piece)) return;
      }
    }
    if (!ApplyFrame(id, in, words)) return;
  }
  for (const std::vector<Word>& piece : before) Insert(id, piece, true);
  for (const std::vector<Word>& piece : after) Insert(id, piece, false);
  rewritten_.emplace_back(id, std::move(words));
}

void DimensionPass::DropModeWords() {
  ProgramEditor editor(module_, program_, "absolute_dimensions");
  for (const BlockId id : module_.programs[program_].blocks) {
    Block& block = module_.blocks[id];
    std::vector<Word> kept;
    bool dropped = false;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kDistance || word.op == WordOp::kDiameter || word.op == WordOp::kUnits) {
        dropped = true;
      } else {
        kept.push_back(word);
      }
    }
    if (!dropped) continue;
    editor.SetWords(id, kept);
    if (kept.empty() && !block.label.Valid() && block.number == Block::kNoNumber && block.comments.Empty())
      editor.Remove(id);
  }
  editor.Apply();
}

void DimensionPass::Enter(ProgramId program) {
  program_ = program;
  blocks_ = module_.programs[program].blocks;
  carried_.assign(blocks_.count, 0);
  FindPlaneWords();
  FindSenses();
}

bool DimensionPass::RunProgram(ProgramId program) {
  Enter(program);
  FindLive();
  Flow();
  editor_.emplace(module_, program, "absolute_dimensions");
  rewritten_.clear();
  cut_.clear();
  if (blocks_.count != 0) {
    Slots entry = EntrySlots();
    SaveEntry(entry, true);
  }
  for (std::uint32_t i = 0; i < blocks_.count; ++i) {
    Slots slots = in_[i];
    // Where no way leads, the increments are those of dead text. They are taken from the modes as they stand.
    if (slots[0].kind == SlotValue::Kind::kNoWay) {
      RewriteWords(blocks_[i], slots);
    } else {
      Through(blocks_[i], slots, true);
    }
  }
  for (const auto& [id, words] : rewritten_) {
    Block& block = module_.blocks[id];
    if (words.empty() && !block.words.Empty() && !block.label.Valid() && block.number == Block::kNoNumber &&
        block.comments.Empty()) {
      editor_->Remove(id);
    } else if (words.size() == block.words.count) {
      for (std::uint32_t i = 0; i < words.size(); ++i) module_.words[block.words[i]] = words[i];
    } else {
      editor_->SetWords(block, words);
    }
  }
  editor_->Apply();
  return ok_;
}

bool DimensionPass::Run() {
  FindModesThatOccur();
  FindRanges();
  FindEffects();
  FindKept();
  FindCallPositions();
  for (const ProgramId program : module_.programs.Ids()) RunProgram(program);
  if (!ok_) return false;
  for (const ProgramId program : module_.programs.Ids()) {
    program_ = program;
    DropModeWords();
    if (config_.keep == KeepIncrements::kBlocks && !kept_axes_.empty()) WriteDistanceModes();
  }
  return true;
}

bool AbsoluteDimensions(Module& module, const Machine& source, const AbsoluteDimensionsConfig& config, diag::Sink& sink,
                        CarriedPositions* carried, KeptIncrements* kept) {
  DimensionPass pass(module, source, config, sink);
  const bool ok = pass.Run();
  if (carried != nullptr) *carried = pass.Carried();
  if (kept != nullptr) *kept = pass.Kept();
  return ok;
}

}  // namespace ncport::ir::transform
