#include "backends/sinumerik/map_frames.h"

#include <optional>
#include <string_view>
#include <vector>

#include "ir/analysis/flow_analyses.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::FrameOp;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

Word FrameWord(FrameOp op) { return ir::MakeWord(WordOp::kFrame, op); }

class Pass {
 public:
  Pass(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input),
        module_(out.module),
        sink_(sink),
        make_(out.module),
        analyses_(input.Analyse(out.module)),
        flow_(analyses_.Modal()) {}

  bool Run() {
    bool shifts = false, rotations = false;
    for (const ir::ProgramId program : module_.programs.Ids()) {
      for (const BlockId id : module_.programs[program].blocks) {
        for (const WordId word_id : module_.blocks[id].words) {
          const Word& word = module_.words[word_id];
          if (word.op != WordOp::kFrame) continue;
          shifts = shifts || Is(word, FrameOp::kLocalShift);
          if (Is(word, FrameOp::kLocalShift)) shifted_ |= ShiftedBy(id);
          rotations = rotations || Is(word, FrameOp::kRotateAbout);
        }
      }
    }
    if (!shifts && !rotations) return true;
    for (const ir::ProgramId program : module_.programs.Ids()) {
      ProgramEditor editor(module_, program, "map_frames");
      for (const BlockId id : module_.programs[program].blocks) {
        const Word* frame = FrameOf(id);
        if (frame == nullptr) continue;
        const Block block = module_.blocks[id];
        if (HasSeveral(id)) {
          Refuse(block, *frame, "several frame words in one block");
        } else if (shifts && rotations) {
          Refuse(block, *frame, "a shift and a rotation that stand beside each other");
        } else if (Is(*frame, FrameOp::kLocalShift)) {
          Shift(id, block, *frame);
        } else if (Is(*frame, FrameOp::kRotateAbout)) {
          Rotation(program, id, block, *frame, editor);
        } else if (Is(*frame, FrameOp::kRotateEnd)) {
          RotationEnd(id, block, *frame, editor);
        }
      }
      editor.Apply();
    }
    return ok_;
  }

 private:
  static bool Is(const Word& word, FrameOp op) { return word.index == static_cast<std::uint8_t>(op); }
  [[nodiscard]] const Word* FrameOf(BlockId id) const {
    for (const WordId word : module_.blocks[id].words) {
      if (module_.words[word].op == WordOp::kFrame) return &module_.words[word];
    }
    return nullptr;
  }
  [[nodiscard]] bool HasSeveral(BlockId id) const {
    int count = 0;
    for (const WordId word : module_.blocks[id].words) count += module_.words[word].op == WordOp::kFrame ? 1 : 0;
    return count > 1;
  }
  void Refuse(const Block& block, const Word& word, std::string_view what) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block, word), what, input_.profile->name);
  }

  void Replace(BlockId id, const Word& old, const Word& made) {
    for (const WordId word : module_.blocks[id].words) {
      if (&module_.words[word] == &old) {
        module_.words[word] = made;
        return;
      }
    }
  }

  /// Axes of a G52 block that it gives a shift, or may give one: all but zeros.
  [[nodiscard]] std::uint16_t ShiftedBy(BlockId id) const {
    std::uint16_t axes = 0;
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kAxis && ir::LiteralValue(module_, word.value) != 0.0)
        axes = static_cast<std::uint16_t>(axes | (1U << word.index));
    }
    return axes;
  }

  /// TRANS gives every axis that it does not name 0, G52 leaves it: so all G52 must name each axis that one of them
  /// shifts.
  void Shift(BlockId id, const Block& block, const Word& frame) {
    std::uint16_t axes = 0;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kAxis) {
        axes = static_cast<std::uint16_t>(axes | (1U << word.index));
        if (word.mode != ir::ValueMode::kModal && word.mode != ir::ValueMode::kAbsolute)
          return Refuse(block, word, "an increment in a shift");
      } else if (word.op != WordOp::kFrame) {
        return Refuse(block, word, "a word beside a shift");
      }
    }
    if ((shifted_ & ~axes) != 0 || axes == 0)
      return Refuse(block, frame, "a shift that names other axes than another one");
    for (const WordId word_id : block.words) {
      Word& word = module_.words[word_id];
      if (word.op != WordOp::kAxis) continue;
      word.mode = ir::ValueMode::kModal;
      const bool diameter =
          input_.source_machine->frame_shift_in_diameter && word.index == input_.source_machine->transverse_axis;
      // TRANS X is a radius whatever the diameter mode (sinumerik-8.5).
      if (!diameter) continue;
      const ir::Expr value = module_.exprs[word.value];
      word.value = value.op == ExprOp::kLiteral ? make_.Literal(value.number / 2)
                                                : make_.Binary(ExprOp::kDivide, word.value, make_.Number("2"));
    }
    Replace(id, frame, FrameWord(FrameOp::kTranslate));
  }

  /// G69 may stand beside a move (fanuc-8.5), which comes behind it.
  void RotationEnd(BlockId id, const Block& block, const Word& frame, ProgramEditor& editor) {
    std::vector<Word> others;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (&word == &frame) continue;
      // Its values were taken before the rotation ended.
      bool reads = word.op == WordOp::kWhen || word.op == WordOp::kSkipRest;
      const auto look = [&](ExprId value) {
        if (!value.Valid()) return;
        ir::transform::VisitReads(module_, value,
                                  [&](ExprId read) { reads = reads || module_.exprs[read].op == ExprOp::kSystem; });
      };
      look(word.value);
      if (word.op == WordOp::kCall || word.op == WordOp::kModalCall) reads = true;  // and its arguments
      if (reads) return Refuse(block, word, "this word beside the end of a rotation");
      others.push_back(word);
    }
    if (others.empty()) return Replace(id, frame, FrameWord(FrameOp::kTranslate));
    // Frame words stand alone (sinumerik-1.3).
    editor.PutInFront(id, {FrameWord(FrameOp::kTranslate)}, {.comments = true});
    editor.SetWords(id, others);
  }

  /// About a centre: there, turn, and back by the way of the turned axes.
  void Rotation(ir::ProgramId program, BlockId id, const Block& block, const Word& frame, ProgramEditor& editor) {
    const ir::ModalState at = flow_.At(program, id);
    if (at.plane == ir::Plane::kUnknown) return Refuse(block, frame, "a rotation whose plane is not one here");
    const std::uint8_t normal = at.plane == ir::Plane::kXY ? 2 : at.plane == ir::Plane::kZX ? 1 : 0;
    std::vector<Word> modes, there, back;
    const Word* angle = nullptr;
    bool origin = true;
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if (word.op == WordOp::kFrameAngle) {
        angle = &module_.words[word_id];
      } else if (word.op == WordOp::kAxis && word.index < 3 && word.index != normal) {
        Word made = word;
        made.mode = ir::ValueMode::kModal;
        there.push_back(made);
        made.value = make_.Unary(ExprOp::kNegate, make_.Unary(ExprOp::kGroup, word.value));
        back.push_back(made);
        const ir::Expr& value = module_.exprs[word.value];
        origin = origin && value.op == ExprOp::kLiteral && value.number == 0;
      } else if (word.op == WordOp::kPlane || word.op == WordOp::kDistance) {
        modes.push_back(word);
      } else if (word.op != WordOp::kFrame) {
        return Refuse(block, word, "a word beside a rotation");
      }
    }
    if (angle == nullptr) return Refuse(block, frame, "a rotation by the angle of a parameter");
    if (there.size() != 2) return Refuse(block, frame, "a rotation about the present position");
    if (input_.source_machine->rotation_angle_by_distance && at.distance != ir::Distance::kAbsolute)
      return Refuse(block, *angle, "an angle that may add to the one before");
    const Word turn = *angle;
    const auto put = [&](std::vector<Word> words, FrameOp op, bool own) {
      words.insert(words.begin(), FrameWord(op));
      if (own) {
        editor.SetWords(id, words);
      } else {
        editor.PutBehind(id, words);
      }
    };
    if (!modes.empty()) editor.PutInFront(id, modes, {.comments = true});
    if (origin) return put({turn}, FrameOp::kRotate, true);
    put(there, FrameOp::kTranslate, true);
    put({turn}, FrameOp::kAddRotate, false);
    put(back, FrameOp::kAddTranslate, false);
  }

  const RaiseInput& input_;
  Module& module_;
  diag::Sink& sink_;
  ir::ExprBuilder make_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  std::uint16_t shifted_ = 0;  // by some G52
  bool ok_ = true;
};

}  // namespace

bool MapFrames(const RaiseInput& input, Translation& out, diag::Sink& sink) { return Pass(input, out, sink).Run(); }

}  // namespace ncport::backends::sinumerik
