#include "ir/transform/polar_mode.h"

#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

enum class Mode : std::uint8_t { kOff, kOn, kOpen };

/// What holds at a place: the mode, and the last radius and angle (a literal or a local) while nothing else has moved.
struct Polar {
  Mode mode = Mode::kOff;
  ExprId radius, angle;  // none: not known
  bool operator==(const Polar&) const = default;
};

/// The plane words of a block.
struct PlaneWords {
  const Word* radius = nullptr;
  const Word* angle = nullptr;
  [[nodiscard]] bool Any() const { return radius != nullptr || angle != nullptr; }
};

class Pass {
 public:
  Pass(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink)
      : module_(module),
        sink_(sink),
        make_(module),
        analyses_(module, source, {source.start, sub_entry}),
        modal_(analyses_.Modal()),
        flow_(analyses_.Sources(), *this),
        locals_(module.programs.Size()) {}

  bool Run() {
    bool any = false;
    for (const Word& word : module_.words.All()) any = any || (word.op == WordOp::kPolarMode && word.index != 0);
    if (!any) return true;
    flow_.Run();
    for (const ProgramId program : module_.programs.Ids()) {
      ProgramEditor editor(module_, program, "polar_mode");
      for (const BlockId block : module_.programs[program].blocks) Map(program, block, editor);
      if (ok_) editor.Apply();
    }
    return ok_;
  }

  // The client of ForwardFlow. Locals do not travel, and what a callee leaves is another position.
  using State = Polar;
  [[nodiscard]] State Entry(ProgramId) const { return {}; }
  [[nodiscard]] State Unknown(ProgramId) const { return {.mode = Mode::kOpen}; }
  bool Join(BlockId, State& into, const State& from) const {
    const State before = into;
    const auto join = [&](ExprId& a, ExprId b) {
      const auto same = a.Valid() && b.Valid() ? LiteralValue(module_, a) : std::nullopt;
      if (!(a == b) && !(same && same == LiteralValue(module_, b))) a = {};
    };
    if (into.mode != from.mode) into.mode = Mode::kOpen;
    join(into.radius, from.radius);
    join(into.angle, from.angle);
    return into != before;
  }
  void Transfer(ProgramId program, BlockId id, State& state) {
    static_cast<void>(Step(program, id, state));
    // What a later block leaves out is as seen from the zero: a radius of 0 has no angle, one below 0 another.
    const auto radius = state.radius.Valid() ? LiteralValue(module_, state.radius) : std::nullopt;
    if (!radius || *radius <= 0 || MayStay(id)) state.radius = state.angle = {};
  }
  [[nodiscard]] std::optional<State> Into(const analysis::CallSite&, analysis::CallMoment moment,
                                          const State& at) const {
    if (moment == analysis::CallMoment::kModalStart) return std::nullopt;
    return State{.mode = at.mode};
  }
  [[nodiscard]] State Back(const analysis::CallSite&, const State&, const State& exit) const {
    return {.mode = exit.mode};
  }

 private:
  void Refuse(const Block& block, std::string_view what) {
    ok_ = false;
    if (block.origin.Valid() && !refused_.insert(block.origin.value).second) return;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, "a language without a polar mode");
  }

  ExprId Local(ProgramId program, bool angle) {
    ExprId& local = angle ? locals_[program.value].second : locals_[program.value].first;
    if (!local.Valid()) local = make_.Variable(NewLocal(module_, program, angle ? "U_ANGLE" : "U_RADIUS", Type::kReal));
    return local;
  }

  /// A count of holes stands in the block: with 0 the tool stays where it is.
  [[nodiscard]] bool MayStay(BlockId id) const {
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      const bool count =
          word.op == WordOp::kCycleValue && word.index == static_cast<std::uint8_t>(CycleField::kRepeats);
      if (count || (word.op == WordOp::kCenter && word.index == 2)) return true;
    }
    return false;
  }

  /// A literal, or the local that holds the value.
  ExprId Held(ProgramId program, const Word& word, bool angle) {
    return LiteralValue(module_, word.value) ? word.value : Local(program, angle);
  }

  /// The block's words that are radius and angle; `state` becomes what holds behind it.
  PlaneWords Step(ProgramId program, BlockId id, State& state) {
    const ModalState before = modal_.Before(program, id), at = modal_.At(program, id);
    PlaneWords words;
    bool elsewhere = before.plane != at.plane || before.units != at.units || before.work_offset != at.work_offset;
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      switch (word.op) {
        case WordOp::kPolarMode:
          state = {.mode = word.index != 0 ? Mode::kOn : Mode::kOff};
          break;
        case WordOp::kFrame:
        case WordOp::kMachineCoords:
        case WordOp::kReference:
        case WordOp::kPresetPosition:
          elsewhere = true;
          break;
        case WordOp::kAxis:
          if (word.index == AxesOf(at.plane).first) words.radius = &module_.words[word_id];
          if (word.index == AxesOf(at.plane).second) words.angle = &module_.words[word_id];
          break;
        default:
          break;
      }
    }
    if (elsewhere) {
      // Another zero, or words that are no positions of the program.
      state.radius = state.angle = {};
      for (const WordId word_id : module_.blocks[id].words) {
        const WordOp op = module_.words[word_id].op;
        if (op == WordOp::kFrame || op == WordOp::kMachineCoords || op == WordOp::kReference ||
            op == WordOp::kPresetPosition)
          return {};
      }
    }
    if (state.mode == Mode::kOff || !words.Any()) return state.mode == Mode::kOff ? PlaneWords{} : words;
    if (words.radius != nullptr) state.radius = Held(program, *words.radius, false);
    if (words.angle != nullptr) state.angle = Held(program, *words.angle, true);
    return words;
  }

  void Map(ProgramId program, BlockId id, ProgramEditor& editor) {
    const Block block = module_.blocks[id];
    const Polar* const before = flow_.Before(id);
    Polar state = before != nullptr ? *before : Polar{.mode = Mode::kOpen};
    const PlaneWords plane = Step(program, id, state);
    bool mode = false;
    for (const WordId word : block.words) mode = mode || module_.words[word].op == WordOp::kPolarMode;
    if (plane.Any()) {
      const ModalState at = modal_.At(program, id);
      if (state.mode == Mode::kOpen) return Refuse(block, "a move whose words are polar on some ways only");
      if (at.plane == Plane::kUnknown || at.units == Units::kUnknown || LengthsAreInches(at.units))
        return Refuse(block, "polar words in inches, or whose plane or unit is not known here");
      for (const Word* word : {plane.radius, plane.angle}) {
        const bool absolute = word == nullptr || word->mode == ValueMode::kAbsolute ||
                              (word->mode == ValueMode::kModal && at.distance == Distance::kAbsolute);
        if (!absolute) return Refuse(block, "increments of polar words");
      }
      if (!state.radius.Valid() || !state.angle.Valid())
        return Refuse(block, "polar words whose radius or angle is not one on all ways here");
    }
    if (!plane.Any() && !mode) return;
    Rewrite(program, id, block, plane, state, editor);
  }

  void Rewrite(ProgramId program, BlockId id, const Block& block, const PlaneWords& plane, const Polar& state,
               ProgramEditor& editor) {
    std::vector<std::vector<Word>> first;
    for (const bool angle : {false, true}) {
      const Word* const word = angle ? plane.angle : plane.radius;
      if (word == nullptr || LiteralValue(module_, word->value)) continue;
      first.push_back({MakeAssignment(Local(program, angle), word->value)});
    }
    const PlaneAxes axes = AxesOf(modal_.At(program, id).plane);
    std::vector<Word> words;
    bool placed = false;
    std::vector<WordId> old;
    for (const WordId word_id : block.words) old.push_back(word_id);
    for (const WordId word_id : old) {
      const Word word = module_.words[word_id];
      if (word.op == WordOp::kPolarMode) continue;
      const bool of_plane =
          plane.Any() && word.op == WordOp::kAxis && (word.index == axes.first || word.index == axes.second);
      if (!of_plane) {
        words.push_back(word);
        continue;
      }
      if (std::exchange(placed, true)) continue;
      for (const std::uint8_t axis : {axes.first, axes.second}) {
        const ir::Function function = axis == axes.first ? ir::Function::kCos : ir::Function::kSin;
        Word made = word;
        made.index = axis;
        made.value = make_.Binary(ExprOp::kMultiply, state.radius, make_.Function(function, {state.angle}));
        words.push_back(made);
      }
    }
    for (const std::vector<Word>& assignment : first) editor.PutInFront(id, assignment);
    editor.SetWords(id, words);
    if (words.empty()) editor.Remove(id);
  }

  Module& module_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& modal_;
  analysis::ForwardFlow<Pass> flow_;
  std::vector<std::pair<ExprId, ExprId>> locals_;  // per program: radius, angle
  bool ok_ = true;
  std::set<std::uint32_t> refused_;  // origins of blocks
};

}  // namespace

bool LowerPolarMode(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink) {
  return Pass(module, source, sub_entry, sink).Run();
}

}  // namespace ncport::ir::transform
