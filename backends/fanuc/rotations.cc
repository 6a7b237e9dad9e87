#include "backends/fanuc/rotations.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "dialects/fanuc/words.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/make_word.h"
#include "ir/motions.h"
#include "ir/transform/frame_flow.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::FrameOp;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::FrameState;
using ir::transform::ProgramEditor;

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr std::uint8_t kZ = 2;

/// The flows that both the test and the rewriting look at.
struct Flows {
  Flows(const RaiseInput& input, const Module& module)
      : analyses(input.Analyse(module)),
        modes(analyses.Modal()),
        frames(module, *input.source_machine, analyses.Graphs(), analyses.Calls(), modes, {}) {}

  ir::analysis::FlowAnalyses analyses;
  const ir::analysis::ModalFlow& modes;
  ir::transform::FrameFlow frames;
};

FrameOp OpOf(const Word& frame) { return static_cast<FrameOp>(frame.index); }

double Rounded(double degrees) { return std::round(degrees * 1e6) / 1e6; }

bool Rotates(FrameOp op) { return op == FrameOp::kRotate || op == FrameOp::kAddRotate; }
bool Shifts(FrameOp op) { return op == FrameOp::kTranslate || op == FrameOp::kAddTranslate; }

/// A rotation may be in force.
bool MayTurn(const FrameState& state) { return state.kind == FrameState::Kind::kUnknown || !state.matrix.IsIdentity(); }

/// Of a known frame, degrees.
double AngleOf(const FrameState& state) { return std::atan2(state.matrix.at[1][0], state.matrix.at[0][0]) * kDegrees; }

/// Values of the frame word: shift in mm by axis, angle.
struct Values {
  std::array<ExprId, 3> shift{};
  ExprId angle;
};

std::optional<Values> ValuesOf(const Module& module, const Block& block, FrameOp op) {
  Values values;
  for (const WordId id : block.words) {
    const Word& word = module.words[id];
    if (word.op == WordOp::kFrameAngle) {
      if (values.angle.Valid()) return std::nullopt;
      values.angle = word.value;
    } else if (word.op == WordOp::kAxis && Rotates(op)) {
      if (word.index != kZ || values.angle.Valid()) return std::nullopt;
      values.angle = word.value;
    } else if (word.op == WordOp::kAxis) {
      if (word.index > kZ) return std::nullopt;
      values.shift[word.index] = word.value;
    } else if (word.op != WordOp::kFrame) {
      return std::nullopt;
    }
  }
  return values;
}

Word MadeWord(WordOp op, std::uint8_t index, ExprId value, std::uint8_t flags = 0) {
  Word word = ir::MakeWord(op, index, value);
  word.flags = flags;
  if (op == WordOp::kAxis) word.mode = ir::ValueMode::kAbsolute;
  return word;
}

Word FrameOf(FrameOp op) { return MadeWord(WordOp::kFrame, static_cast<std::uint8_t>(op), {}); }

Word Assignment(ExprId place, ExprId value) {
  Word word = MadeWord(WordOp::kAssign, 0, value);
  word.extra = place.value;
  return word;
}

}  // namespace

bool RotationsAreNative(const RaiseInput& input, const Translation& out) {
  const Module& module = out.module;
  const auto system = *dialects::fanuc::SystemOf(*input.profile);
  if (input.profile->IsLathe() || dialects::fanuc::TextOf(system, dialects::fanuc::Special::kRotationOn).empty())
    return false;
  const Flows flows(input, module);
  if (!flows.frames.Any()) return false;
  bool turns = false, needed = false;
  ProgramId holder;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Block& block = module.blocks[id];
      const FrameState before = flows.frames.Before(id);
      const ir::ModalState state = flows.modes.At(program, id);
      if (const Word* frame = ir::FindWord(module, block, WordOp::kFrame)) {
        const FrameOp op = OpOf(*frame);
        if (!Shifts(op) && !Rotates(op) && op != FrameOp::kReset) return false;
        if ((holder.Valid() && holder != program) || module.programs[program].kind != ir::ProgramKind::kMain)
          return false;
        holder = program;
        if (!ValuesOf(module, block, op) || block.skip_level != Block::kNoSkip) return false;
        if (state.plane != ir::Plane::kXY || state.comp != ir::CutterComp::kOff) return false;
        turns = turns || Rotates(op);
        needed = needed || !flows.frames.Trouble(program, id).empty();
        const double angle = AngleOf(flows.frames.After(program, id)) * 1000;
        if (std::fabs(angle - std::round(angle)) > 1e-6) return false;  // the word has three decimals
        continue;
      }
      bool moves = false;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kPolarAngle ||
                word.op == WordOp::kPolarRadius;
        switch (word.op) {
          case WordOp::kPlane:
            if (word.index != static_cast<std::uint8_t>(ir::Plane::kXY)) return false;
            break;
          // Not while the coordinates are turned (fanuc-8.5).
          case WordOp::kMachineCoords:
          case WordOp::kReference:
          case WordOp::kWorkOffset:
          case WordOp::kPresetPosition:
          case WordOp::kTool:
          case WordOp::kToolChange:
          case WordOp::kProgramEnd:
            if (MayTurn(before) && word.op != WordOp::kProgramEnd) return false;
            break;
          default:
            break;
        }
      }
      if (moves && MayTurn(before)) {
        const bool straight =
            state.motion == ir::Motion::kRapid || state.motion == ir::Motion::kLinear || ir::IsPlaneArc(state.motion);
        if (!straight) return false;
      }
      needed = needed || (moves && before.kind == FrameState::Kind::kUnknown);
    }
  }
  if (!holder.Valid() || input.source->programs[holder].saves_modal_state) return false;
  for (const ir::analysis::CallSite& site : flows.analyses.Calls().AllSites()) {
    if (site.callee == holder) return false;
  }
  return turns && needed;
}

void RotationsToNative(const RaiseInput& input, Translation& out) {
  Module& module = out.module;
  const Flows flows(input, module);
  ProgramId holder;
  bool adds_shift = false;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Word* frame = ir::FindWord(module, module.blocks[id], WordOp::kFrame);
      if (frame == nullptr) continue;
      holder = program;
      adds_shift = adds_shift || OpOf(*frame) == FrameOp::kAddTranslate;
    }
  }
  // Numbers that the flow knows everywhere need no local.
  bool held_angle = false;
  for (const BlockId id : module.programs[holder].blocks) {
    if (ir::FindWord(module, module.blocks[id], WordOp::kFrame) != nullptr)
      held_angle = held_angle || flows.frames.After(holder, id).kind != FrameState::Kind::kKnown;
  }
  ir::ExprBuilder make(module);
  ExprId angle;
  std::array<ExprId, 3> shift{};
  if (held_angle) angle = make.Variable(ir::transform::NewLocal(module, holder, "FRAME_ANGLE", ir::Type::kReal));
  static constexpr std::array<std::string_view, 3> kNames{"SHIFT_X", "SHIFT_Y", "SHIFT_Z"};
  for (std::uint8_t axis = 0; axis < 3 && adds_shift; ++axis)
    shift[axis] = make.Variable(ir::transform::NewLocal(module, holder, kNames[axis], ir::Type::kReal));

  ProgramEditor editor(module, holder, "rotations_to_native");
  bool head = true;
  for (const BlockId id : module.programs[holder].blocks) {
    const Block block = module.blocks[id];
    const FrameState before = flows.frames.Before(id);
    if (head && !block.words.Empty()) {
      head = false;
      // Once: a jump back to the block does not run it again.
      const auto put = [&](const Word& word, std::uint8_t flags) {
        Block made = editor.MakeBlock(id);
        made.flags = flags;
        editor.SetWords(made, {word});
        editor.InsertBefore(id, made);
      };
      Word off = FrameOf(FrameOp::kRotateEnd);
      off.flags = Word::kAdded;
      put(off, Block::kAdded);  // nothing is taken over from the program before
      if (held_angle) put(Assignment(angle, make.Literal(0)), 0);
      for (const ExprId each : shift) {
        if (each.Valid()) put(Assignment(each, make.Literal(0)), 0);
      }
    }
    const auto local_shift = [&](const std::array<ExprId, 3>& values) {
      std::vector<Word> words{FrameOf(FrameOp::kTranslate)};
      for (std::uint8_t axis = 0; axis < 3; ++axis)
        words.push_back(MadeWord(WordOp::kAxis, axis, values[axis].Valid() ? values[axis] : make.Literal(0)));
      return words;
    };
    const Word* found = ir::FindWord(module, block, WordOp::kFrame);
    if (found == nullptr) {
      std::vector<std::vector<Word>> ends;
      // The source forgets its frames at the end of the program, the target need not.
      if (ir::FindWord(module, block, WordOp::kProgramEnd) != nullptr) {
        ends.push_back({FrameOf(FrameOp::kRotateEnd)});
        ends.push_back(local_shift({}));
      }
      for (std::vector<Word>& words : ends) {
        words[0].flags = Word::kAdded;
        Block made = editor.MakeBlock(id);
        made.flags = Block::kAdded;
        editor.TakeHead(made, id);
        editor.SetWords(made, words);
        editor.InsertBefore(id, made);
      }
      continue;
    }
    std::vector<std::vector<Word>> pieces;  // of what becomes of the block, one block each
    const FrameOp op = OpOf(*found);
    const FrameState after = flows.frames.After(holder, id);
    Values values = *ValuesOf(module, block, op);
    const ir::ModalState state = flows.modes.At(holder, id);
    const bool inch = ir::LengthsAreInches(state.units);
    for (ExprId& value : values.shift) {
      if (value.Valid() && inch)
        value = ir::transform::ExprOf(
            module, ir::transform::Sum(module, {}, ir::transform::FormOf(module, value), ir::kMmPerInch));
    }
    const auto group = [&](ExprId value) { return make.Unary(ExprOp::kGroup, value); };
    const bool was_turned = MayTurn(before), is_turned = MayTurn(after);
    std::array<ExprId, 3> now = values.shift;
    bool shifts = true;
    if (op == FrameOp::kAddTranslate) {
      // The words count in the turned system.
      for (std::uint8_t axis = 0; axis < 2 && was_turned; ++axis) {
        const ExprId turn = held_angle ? angle : make.Literal(Rounded(AngleOf(before)));
        const auto part = [&](ExprId value, ir::Function function) {
          return make.Binary(ExprOp::kMultiply, group(value), make.Function(function, {turn}));
        };
        const ExprId along = values.shift[axis], across = values.shift[1 - axis];
        ExprId sum;
        if (along.Valid()) sum = part(along, ir::Function::kCos);
        if (across.Valid()) {
          const ExprId other = part(across, ir::Function::kSin);
          const ExprOp sign = axis == 0 ? ExprOp::kSubtract : ExprOp::kAdd;
          sum = sum.Valid() ? make.Binary(sign, sum, other) : axis == 0 ? make.Unary(ExprOp::kNegate, other) : other;
        }
        now[axis] = sum;
      }
      // All sums are taken before one of them is written: the values do not read the sums.
      for (std::uint8_t axis = 0; axis < 3; ++axis) {
        if (now[axis].Valid())
          pieces.push_back({Assignment(shift[axis], make.Binary(ExprOp::kAdd, shift[axis], group(now[axis])))});
      }
      now = shift;
    } else if (op == FrameOp::kAddRotate) {
      shifts = false;
    } else if (adds_shift) {
      for (std::uint8_t axis = 0; axis < 3; ++axis)
        pieces.push_back({Assignment(shift[axis], now[axis].Valid() ? now[axis] : make.Literal(0))});
      now = shift;
    }
    if (held_angle && Rotates(op) && values.angle.Valid()) {
      ExprId sum = op == FrameOp::kAddRotate ? make.Binary(ExprOp::kAdd, angle, group(values.angle)) : values.angle;
      pieces.push_back({Assignment(angle, sum)});
      // The word takes -360 to 360 degrees.
      const ExprId turns =
          make.Function(ir::Function::kTruncate, {make.Binary(ExprOp::kDivide, angle, make.Literal(360))});
      pieces.push_back({Assignment(
          angle, make.Binary(ExprOp::kSubtract, angle, make.Binary(ExprOp::kMultiply, make.Literal(360), turns)))});
    } else if (held_angle && op != FrameOp::kAddRotate && op != FrameOp::kAddTranslate) {
      pieces.push_back({Assignment(angle, make.Literal(0))});
    }
    if (was_turned) pieces.push_back({FrameOf(FrameOp::kRotateEnd)});
    if (shifts) pieces.push_back(local_shift(now));
    if (is_turned) {
      const ExprId turn = held_angle ? angle : make.Literal(Rounded(AngleOf(after)));
      pieces.push_back(std::vector<Word>{FrameOf(FrameOp::kRotateAbout), MadeWord(WordOp::kAxis, 0, make.Literal(0)),
                                         MadeWord(WordOp::kAxis, 1, make.Literal(0)),
                                         MadeWord(WordOp::kFrameAngle, 0, turn)});
    }
    // The last piece is the block itself; the first one is where jumps go to.
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) editor.PutInFront(id, pieces[i]);
    editor.SetWords(id, pieces.empty() ? std::vector<Word>{} : pieces.back());
  }
  editor.Apply();
  out.required.emplace_back("coordinate rotation G68, G69");
  out.added.emplace_back("G69 at the head, G69 and G52 before the end: no rotation or shift is taken over or left");
}

}  // namespace ncport::backends::fanuc
