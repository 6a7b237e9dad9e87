#include "ir/transform/expand_cycles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/plane_axes.h"
#include "ir/transform/drilling_flow.h"
#include "ir/transform/hole_moves.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

class Pass {
 public:
  Pass(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink)
      : module_(module),
        config_(config),
        sink_(sink),
        make_(module),
        analyses_(module, source, {source.start, config.sub_entry}),
        flow_(analyses_.Modal()),
        drilling_(module, analyses_),
        moves_(module, source, config.most_pecks) {}

  bool Run() {
    bool any = false;
    for (const ProgramId program : module_.programs.Ids()) any = UsesHoles(program) || any;
    if (!any) return true;
    for (const analysis::CallSite& site : analyses_.Calls().AllSites()) {
      if (site.callee.Valid()) called_.insert(site.callee.value);
    }
    drilling_.Run();
    for (const ProgramId program : module_.programs.Ids()) Expand(program);
    return ok_;
  }

 private:
  [[nodiscard]] bool UsesHoles(ProgramId program) const {
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId id : module_.blocks[block].words) {
        if (module_.words[id].op == WordOp::kCycle && IsHole(module_.words[id].index)) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool NamesHole(const Block& block) const {
    for (const WordId id : block.words) {
      if (IsHoleWord(module_.words[id])) return true;
    }
    return false;
  }

  void Refuse(const Block& block, std::string_view what) {
    ok_ = false;
    // Passes before this one may have made several blocks of one: one finding for it.
    if (block.origin.Valid() && !refused_.insert(block.origin.value).second) return;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, "a language without drilling modes");
  }

  void Expand(ProgramId program) {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    for (const BlockId id : blocks) {
      if (called_.contains(program.value) && LeavesUnderCycle(program, id))
        Refuse(module_.blocks[id], "a return while a drilling cycle is in force");
    }
    program_ = program;
    ProgramEditor editor(module_, program, "expand_cycles");
    for (const BlockId id : blocks) {
      if (const Drilling* before = drilling_.Before(id)) {
        MapBlock(id, *before, editor);
      } else if (NamesHole(module_.blocks[id])) {
        Refuse(module_.blocks[id], "a drilling cycle that no run comes to");
      }
    }
    // A refusal may have come in the middle of a block's moves.
    if (ok_) editor.Apply();
  }

  [[nodiscard]] bool LeavesUnderCycle(ProgramId program, BlockId id) {
    const Drilling* before = drilling_.Before(id);
    if (before == nullptr) return false;
    Drilling state = *before;
    drilling_.Transfer(program, id, state);
    if (analysis::WaysOf(module_, module_.blocks[id]).conditional) drilling_.Join({}, state, *before);
    if (state.cycle == Drilling::kNoCycle || state.cycle == Drilling::kCallers) return false;
    for (const analysis::Edge& edge : analyses_.Graphs().Of(program).Successors(id)) {
      if (edge.kind == analysis::EdgeKind::kReturn || edge.kind == analysis::EdgeKind::kReturnToTarget ||
          edge.kind == analysis::EdgeKind::kTextEnd)
        return true;
    }
    return false;
  }

  static bool IsHoleWord(const Word& word) {
    return word.op == WordOp::kCycle || word.op == WordOp::kCycleValue || word.op == WordOp::kReturnLevel;
  }

  void MapBlock(BlockId id, const Drilling& before, ProgramEditor& editor) {
    const Block block = module_.blocks[id];
    const ModalState at = flow_.At(program_, id);
    const std::uint8_t normal = AxesOf(at.plane).normal;
    const bool open = before.cycle == Drilling::kOpen || before.cycle == Drilling::kCallers;
    const DrillingWords parts = drilling_.WordsOf(id, normal, IsHole(before.cycle));
    bool moves = false, says = false;
    const bool ends = parts.motion || parts.cycle == Drilling::kNoCycle;
    const bool under = (IsHole(before.cycle) || before.cycle == Drilling::kOpen) && !ends;
    if (under && flow_.Before(program_, id).units != at.units)
      return Refuse(block, "a change of the unit while a drilling cycle is in force");
    for (const WordId word_id : block.words) {
      const Word& word = module_.words[word_id];
      if ((under || IsHole(parts.cycle)) && word.op == WordOp::kWorkOffset && at.return_level != ReturnLevel::kRPlane &&
          flow_.Before(program_, id).work_offset != at.work_offset)
        return Refuse(block, "a change of the work offset in a cycle that goes back to its start level");
      moves = moves || word.op == WordOp::kAxis;
      says = says || IsHoleWord(word);
      const bool call = word.op == WordOp::kCall || word.op == WordOp::kModalCall;
      const bool elsewhere =
          word.op == WordOp::kReference || word.op == WordOp::kMachineCoords || word.op == WordOp::kFrame;
      if ((call && parts.cycle != Drilling::kUnset && IsHole(parts.cycle)) ||
          ((call || elsewhere) && IsHole(before.cycle)))
        return Refuse(block, "a call, shift or reference move while a drilling cycle is in force");
    }
    // A subprogram that begins with moves relies on its callers to have no cycle in force; so does this one.
    if (open && parts.cycle == Drilling::kUnset && !parts.motion && moves)
      return Refuse(block, "a move under a cycle of the caller");
    Drilling state = before;
    std::vector<std::pair<ExprId, ExprId>> assigns;
    drilling_.Store(program_, parts, at.distance == Distance::kIncremental, state, &assigns);
    if (!IsHole(state.cycle)) {
      if (!says) return;
      return EndCycle(id, block, before, at, editor);
    }
    Holes(id, block, parts, state, assigns, at, normal, editor);
  }

  /// G80: the motion mode is again what it was before the cycle, whatever the expanded moves left.
  void EndCycle(BlockId id, const Block& block, const Drilling& before, const ModalState& at, ProgramEditor& editor) {
    std::vector<Word> words;
    bool motion = false;
    for (const WordId word_id : block.words) motion = motion || module_.words[word_id].op == WordOp::kMotion;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (!IsHoleWord(word)) {
        words.push_back(word);
        continue;
      }
      if (word.op != WordOp::kCycle) continue;
      if (word.index != static_cast<std::uint8_t>(Cycle::kNone)) {
        words.push_back(word);  // no hole: another pass, or refused
      } else if (!motion && before.cycle != Drilling::kNoCycle) {
        if (at.motion == Motion::kUnknown) return Refuse(block, "the end of a cycle behind an unknown motion mode");
        words.push_back(MotionWord(at.motion));
      }
    }
    editor.SetWords(id, words);
    if (words.empty()) editor.Remove(id);
  }

  static Word MotionWord(Motion motion) { return MakeWord(WordOp::kMotion, motion); }

  void Holes(BlockId id, const Block& block, const DrillingWords& parts, const Drilling& state,
             const std::vector<std::pair<ExprId, ExprId>>& assigns, const ModalState& at, std::uint8_t normal,
             ProgramEditor& editor) {
    if (at.plane == Plane::kUnknown || at.distance == Distance::kUnknown)
      return Refuse(block, "a drilling cycle whose plane or distance mode is not one here");
    std::vector<Word> functions, first, last;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      const bool of_hole = IsHoleWord(word) || word.op == WordOp::kAxis || word.op == WordOp::kRadius ||
                           (word.op == WordOp::kCenter && word.index == 2);
      // The code of the cycle is of the same group: the one that counts is the hole (fanuc-1).
      if (of_hole || (word.op == WordOp::kMotion && parts.Drills())) continue;
      if (word.op == WordOp::kCenter) return Refuse(block, "centre words in a cycle");
      if (word.op == WordOp::kDwellSeconds && parts.Drills()) return Refuse(block, "a dwell beside a hole");
      const bool behind = word.phase == Phase::kAfter || word.phase == Phase::kLast;
      // Behind a move anywhere else, beside a hole they act where it lies, in front of it.
      const bool at_place = parts.Drills() && (word.op == WordOp::kAux || word.op == WordOp::kSpindle);
      (!behind ? first : at_place ? functions : last).push_back(word);
    }
    bool start = true;
    const auto put = [&](const std::vector<Word>& words) {
      start = false;
      editor.PutInFront(id, words, {.comments = true});
    };
    const auto finish = [&] {
      if (!last.empty()) put(last);
      if (start) put({});
      editor.Remove(id);
    };
    if (!functions.empty()) put(functions);
    // The level at which the cycle begins is read in the unit of the block.
    const bool settles = std::ranges::any_of(first, [](const Word& word) { return word.op == WordOp::kUnits; });
    if (settles && !assigns.empty()) {
      put(first);
      first.clear();
    }
    for (const auto& [local, value] : assigns) {
      const ExprId now = value.Valid() ? value : make_.System(config_.position, {make_.AxisName(normal)});
      put({MakeAssignment(local, now)});
    }
    if (!parts.Drills()) {
      if (!parts.place.empty()) {
        first.push_back(MotionWord(Motion::kRapid));
        first.insert(first.end(), parts.place.begin(), parts.place.end());
      }
      if (!first.empty()) put(first);
      return finish();
    }
    double repeats = 1;
    if (parts.repeats != nullptr) {
      const auto count = drilling_.LiteralOf(parts.repeats->value);
      if (!count || *count < 0 || *count > 9999) return Refuse(block, "a computed number of repetitions");
      repeats = std::round(*count);
    }
    const auto& fields = state.fields;
    if (fields[Drilling::kLevel] >= Drilling::kOpen || fields[Drilling::kDepth] >= Drilling::kOpen)
      return Refuse(block, "a drilling cycle whose level or depth is not one on all ways here");
    for (const std::uint8_t field : {Drilling::kStep, Drilling::kDwell}) {
      if (fields[field] == Drilling::kOpen && DrillingFlow::Uses(state.cycle, field))
        return Refuse(block, "a drilling cycle whose step or dwell is not one on all ways here");
    }
    if (at.return_level == ReturnLevel::kUnknown)
      return Refuse(block, "a drilling cycle whose return level is not known");
    if (at.units == Units::kUnknown) return Refuse(block, "a drilling cycle whose unit of lengths is not known");
    const bool counts = at.distance == Distance::kIncremental && parts.values[Drilling::kLevel] != nullptr;
    if (state.start == Drilling::Start::kOpen && (counts || at.return_level == ReturnLevel::kInitial))
      return Refuse(block, "a drilling cycle whose start level is not one on all ways here");
    if (repeats == 0) {
      if (!first.empty()) put(first);
      return finish();
    }
    const SpindleState spindle = drilling_.SpindleAt(id);
    const auto hole = [&] { return MakeHole(block, parts, state, at, normal, spindle, first, put); };
    if (repeats > 1 && block.skip_level != Block::kNoSkip) {
      // No loop can be skipped: its marks stand alone.
      if (repeats > config_.most_pecks) return Refuse(block, "many repetitions of a cycle in a skipped block");
      for (int turn = 0; turn < static_cast<int>(repeats); ++turn) {
        if (!hole()) return;
        first.clear();
      }
    } else if (repeats > 1) {
      if (!first.empty()) put(first);
      first.clear();
      const ExprId turn = make_.Variable(NewLocal(module_, program_, "U_TURN", Type::kReal));
      put({MakeAssignment(turn, make_.Number("0"))});
      Expr less = module_.exprs[make_.Binary(ExprOp::kLess, turn, make_.Literal(repeats, Type::kInt))];
      less.flags |= Expr::kTolerance;  // whole numbers
      put({MakeWord(WordOp::kWhile, 0, module_.AddExpr(less))});
      if (!hole()) return;
      put({MakeAssignment(turn, make_.Binary(ExprOp::kAdd, turn, make_.Number("1")))});
      put({MakeWord(WordOp::kEndWhile)});
    } else if (!hole()) {
      return;
    }
    finish();
  }

  /// One hole, from its place on.
  template <class Put>
  bool MakeHole(const Block& block, const DrillingWords& parts, const Drilling& state, const ModalState& at,
                std::uint8_t normal, SpindleState spindle, std::vector<Word> first, const Put& put) {
    const auto field = [&](Drilling::Field which) {
      return state.fields[which] >= Drilling::kOpen ? ExprId{} : ExprId{state.fields[which]};
    };
    Hole hole;
    hole.cycle = static_cast<Cycle>(state.cycle);
    hole.level = field(Drilling::kLevel);
    hole.depth = field(Drilling::kDepth);
    hole.step = field(Drilling::kStep);
    hole.dwell = field(Drilling::kDwell);
    hole.back = at.return_level == ReturnLevel::kInitial ? drilling_.Initial(program_) : hole.level;
    hole.normal = normal;
    hole.incremental = at.distance == Distance::kIncremental;
    hole.skipped = block.skip_level != Block::kNoSkip;
    hole.units = at.units;
    hole.spindle = spindle;
    if (!parts.place.empty()) {
      first.push_back(MotionWord(Motion::kRapid));
      first.insert(first.end(), parts.place.begin(), parts.place.end());
    }
    if (!first.empty()) put(first);
    const std::string_view wrong = moves_.Make(program_, hole, put);
    if (!wrong.empty()) Refuse(block, wrong);
    return wrong.empty();
  }

  Module& module_;
  const ExpandCyclesConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& flow_;
  DrillingFlow drilling_;
  HoleMoves moves_;
  std::set<std::uint32_t> called_;  // programs
  ProgramId program_;
  bool ok_ = true;
  std::set<std::uint32_t> refused_;  // origins of blocks
};

}  // namespace

bool ExpandCycles(Module& module, const Machine& source, const ExpandCyclesConfig& config, diag::Sink& sink) {
  return Pass(module, source, config, sink).Run();
}

}  // namespace ncport::ir::transform
