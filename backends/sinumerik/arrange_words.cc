// ArrangeWords: words that SINUMERIK reads in another way, block by block.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "backends/sinumerik/raise_words.h"
#include "ir/analysis/axis_positions.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

/// What the programs use at all: words that only switch it off are not carried over when nothing does.
struct Uses {
  bool cycles = false, modal_calls = false, polar = false, rotation = false, scaling = false, mirror = false;
};

Uses FindUses(const Module& module) {
  Uses uses;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      for (const WordId word_id : module.blocks[id].words) {
        const Word& word = module.words[word_id];
        const auto frame = static_cast<ir::FrameOp>(word.index);
        switch (word.op) {
          case WordOp::kCycle:
            uses.cycles = uses.cycles || word.index != static_cast<std::uint8_t>(ir::Cycle::kNone);
            break;
          case WordOp::kModalCall:
            uses.modal_calls = uses.modal_calls || word.Extra<ir::CallId>().Valid();
            break;
          case WordOp::kPolarMode:
            uses.polar = uses.polar || word.index != 0;
            break;
          case WordOp::kFrame:
            uses.rotation = uses.rotation || frame == ir::FrameOp::kRotateAbout;
            uses.scaling = uses.scaling || frame == ir::FrameOp::kScaleAbout;
            uses.mirror = uses.mirror || frame == ir::FrameOp::kMirrorAbout;
            break;
          default:
            break;
        }
      }
    }
  }
  return uses;
}

class Pass {
 public:
  Pass(const RaiseInput& input, Translation& out, diag::Sink& sink)
      : input_(input),
        out_(out),
        module_(out.module),
        sink_(sink),
        make_(out.module),
        analyses_(input.Analyse(out.module)),
        flow_(analyses_.Modal()),
        uses_(FindUses(out.module)) {}

  bool Run() {
    // As the blocks stand before they are taken apart.
    if (input_.source_machine->thread_lead_from_feed && HasTaper())
      positions_.emplace(module_, *input_.source_machine, analyses_);
    for (const ir::ProgramId program : module_.programs.Ids()) {
      ProgramEditor editor(module_, program, "arrange_words");
      for (const BlockId id : module_.programs[program].blocks) Arrange(program, id, editor);
      editor.Apply();
    }
    if (input_.source_profile->rapid.Known() && input_.profile->rapid.Known() &&
        *input_.source_profile->rapid != *input_.profile->rapid)
      Assume(
          "rapids of several axes run straight here, on the source control each axis runs on its own (sinumerik-8.2)");
    return ok_;
  }

 private:
  void Refuse(const Block& block, const Word& word, std::string_view what, std::string_view help = {}) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block, word), what, input_.profile->name).help = help;
  }

  void Assume(std::string_view what) {
    if (std::find(out_.assumptions.begin(), out_.assumptions.end(), what) == out_.assumptions.end())
      out_.assumptions.emplace_back(what);
  }

  /// A word that switches off what nothing here switches on. A main program starts with all of it off; a subprogram
  /// alone relies on its callers for it.
  [[nodiscard]] bool SwitchesNothing(const Word& word) const {
    switch (word.op) {
      case WordOp::kCycle:
      case WordOp::kReturnLevel:
        return !uses_.cycles;
      case WordOp::kPolarMode:
        return !uses_.polar;
      case WordOp::kModalCall:
        return !word.Extra<ir::CallId>().Valid() && !uses_.modal_calls;
      case WordOp::kFrame:
        switch (static_cast<ir::FrameOp>(word.index)) {
          case ir::FrameOp::kRotateEnd:
            return !uses_.rotation;
          case ir::FrameOp::kScaleEnd:
            return !uses_.scaling;
          case ir::FrameOp::kMirrorEnd:
            return !uses_.mirror;
          default:
            return false;
        }
      default:
        return false;
    }
  }

  void Arrange(ir::ProgramId program, BlockId id, ProgramEditor& editor) {
    const Block block = module_.blocks[id];
    const ir::ModalState before = flow_.Before(program, id), at = flow_.At(program, id);
    std::vector<Word> words, dwell;
    bool feed = false;
    for (const WordId word_id : block.words) {
      if (module_.words[word_id].op == WordOp::kReference) return Reference(id, block, at, editor);
    }
    for (const WordId word_id : block.words) {
      feed = feed || module_.words[word_id].op == WordOp::kFeed;
    }
    for (const WordId word_id : block.words) {
      Word word = module_.words[word_id];
      // Where no program calls a tool: the offset that the machine starts with ends all the same (sinumerik-8.8).
      if (word.op == WordOp::kLengthOffset && word.index == 0 && !word.value.Valid()) {
        words.push_back(ir::MakeWord(WordOp::kEdge, 0, make_.Literal(0, ir::Type::kInt)));
        continue;
      }
      if (SwitchesNothing(word)) continue;
      switch (word.op) {
        case WordOp::kReturn:
          // RET takes the block as text (sinumerik-7.5).
          if (word.value.Valid()) word.value = make_.Text(fmt::format("N{:.0f}", module_.exprs[word.value].number));
          // RET stands alone, M17 may share its block (sinumerik-1.2).
          if (block.words.count == 1) break;
          if (word.value.Valid()) Refuse(block, word, "other words beside a return to a block");
          word.index = static_cast<std::uint8_t>(ir::ReturnKind::kAuxiliary);
          break;
        case WordOp::kCutterComp:
          if (word.index == static_cast<std::uint8_t>(ir::CutterComp::kOff)) break;
          Assume(
              "G41 and G42: the programmed path was compared, approach and feed at the contour differ between controls "
              "(sinumerik-8.8)");
          break;
        case WordOp::kMachineCoords:
          Assume("SUPA moves to machine coordinates of the source machine: check each of them on the new one");
          break;
        case WordOp::kMotion:
          // The last of one group counts in the source (fanuc-1); SINUMERIK refuses two in one block.
          std::erase_if(words, [](const Word& other) { return other.op == WordOp::kMotion; });
          break;
        case WordOp::kDwellSeconds:
          dwell.push_back(word);
          continue;
        case WordOp::kFeedMode:
          if (!FeedMode(program, id, block, word, before, feed)) continue;
          break;
        case WordOp::kSpeedMode:
          if (!SpeedMode(block, word, before, at)) continue;
          break;
        default:
          break;
      }
      words.push_back(word);
    }
    ThreadLead(program, id, block, at, words);
    SetWords(id, words, dwell, editor);
  }

  /// G28 goes by way of the point that its axis words name, and leaves the motion mode alone (fanuc-8.1). The reference
  /// points of the source are the fixed points 1 and 2 of the target, which the machine builder sets.
  void Reference(BlockId id, const Block& block, const ir::ModalState& at, ProgramEditor& editor) {
    std::vector<Word> via, point, other, behind;
    ir::ReferenceKind kind = ir::ReferenceKind::kFromReference;
    for (const WordId word_id : block.words) {
      const Word word = module_.words[word_id];
      if (SwitchesNothing(word)) continue;
      if (word.op == WordOp::kReference) {
        kind = static_cast<ir::ReferenceKind>(word.index);
        if (kind != ir::ReferenceKind::kReference) {
          // The number of the fixed point has no place in a comparison, so the second one stays refused.
          return Refuse(block, word, "a move to another point than the first reference point");
        }
      } else if (word.op == WordOp::kAxis) {
        via.push_back(word);
        Word axis = word;
        axis.mode = ir::ValueMode::kModal;
        axis.value = make_.Number("0");
        point.push_back(axis);
      } else if (word.op == WordOp::kDistance) {
        other.push_back(word);
      } else if (word.op == WordOp::kSpindle || word.op == WordOp::kSpeed || word.op == WordOp::kFeed ||
                 word.op == WordOp::kAux) {
        // M5 and M9 act when the axes are there, M3 when they start.
        const bool waits = word.phase == ir::Phase::kAfter || word.phase == ir::Phase::kLast;
        (waits ? behind : other).push_back(word);
      } else {
        return Refuse(block, word, "a word beside a move to the reference point");
      }
    }
    if (via.empty() || at.motion == ir::Motion::kUnknown || block.skip_level != Block::kNoSkip) {
      return Refuse(block, module_.words[block.words[0]], "this move to the reference point");
    }
    // `G91 G28 Z0`: the way is nothing, also from a place that is not known, where a step by nothing could not be run.
    const bool stays = std::ranges::all_of(via, [&](const Word& word) {
      const bool step = word.mode == ir::ValueMode::kModal ? at.distance == ir::Distance::kIncremental
                                                           : word.mode == ir::ValueMode::kIncremental;
      return step && ir::LiteralValue(module_, word.value) == 0.0;
    });
    std::vector<Word> first = other;
    if (!stays) {
      first.push_back(ir::MakeWord(WordOp::kMotion, ir::Motion::kRapid));
      first.insert(first.end(), via.begin(), via.end());
    }
    Word number = ir::MakeWord(WordOp::kInert);
    number.spelling = ir::AddSpelling(module_, "FP", "sinumerik-8.2");
    number.value = make_.Number("1", ir::Type::kInt);
    point.insert(point.begin(), {ir::MakeWord(WordOp::kReference, ir::ReferenceKind::kFixedPoint), number});
    if (first.empty()) {
      editor.SetWords(id, point);
    } else {
      editor.SetWords(id, first);
      editor.PutBehind(id, point);
    }
    if (!behind.empty()) editor.PutBehind(id, behind);
    if (!stays && at.motion != ir::Motion::kRapid) editor.PutBehind(id, {ir::MakeWord(WordOp::kMotion, at.motion)});
    Assume("G75 goes to fixed point 1, which must be the reference point of the source machine (sinumerik-8.2)");
  }

  void SetWords(BlockId id, std::vector<Word>& words, const std::vector<Word>& dwell, ProgramEditor& editor) {
    if (dwell.empty() || words.empty()) {
      editor.SetWords(id, dwell.empty() ? words : dwell);
      return;
    }
    // G4 stands alone (sinumerik-8.2); what acts behind the motion comes behind it.
    std::vector<Word> first, last;
    for (const Word& word : words) {
      const bool behind = word.phase == ir::Phase::kAfter || word.phase == ir::Phase::kLast;
      (behind ? last : first).push_back(word);
    }
    for (const std::vector<Word>* part : {&std::as_const(first), &dwell, &std::as_const(last)}) {
      if (!part->empty()) editor.PutInFront(id, *part, {.comments = true});
    }
    editor.Remove(id);
  }

  /// Group 15 holds G94, G95 with G96, G97: a feed word under constant surface speed would end it (sinumerik-8.1).
  /// False: the word goes, it changes nothing.
  bool FeedMode(ir::ProgramId program, BlockId id, const Block& block, const Word& word, const ir::ModalState& before,
                bool feed) {
    const auto mode = static_cast<ir::FeedMode>(word.index);
    if (before.feed_mode == mode) return false;
    if (before.speed_mode != ir::SpeedMode::kRpm) {
      Refuse(block, word, "a change of the feed's unit where constant surface speed may be in force");
    } else if (!feed && !input_.source_machine->feed_type_change_drops_feed && !FeedFollows(program, id)) {
      Refuse(block, word, "a change of the feed's unit that keeps the number F");  // sinumerik-8.8
    }
    return true;
  }

  /// Some jump of the module may go to a block of this number.
  [[nodiscard]] bool IsTarget(std::uint32_t number) const {
    if (number == Block::kNoNumber) return false;
    return std::any_of(module_.jumps.All().begin(), module_.jumps.All().end(), [&](const ir::Jump& jump) {
      return jump.target.kind == ir::TargetKind::kExpression || jump.target.number == number;
    });
  }

  /// An F word comes before anything that moves at feed or leaves the straight way down.
  [[nodiscard]] bool FeedFollows(ir::ProgramId program, BlockId from) const {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    for (std::uint32_t i = from.value + 1; i < blocks.begin + blocks.count; ++i) {
      const BlockId id{std::size_t{i}};
      const Block& block = module_.blocks[id];
      bool moves = false;
      for (const WordId word_id : block.words) {
        const Word& word = module_.words[word_id];
        if (word.op == WordOp::kFeed) return block.skip_level == Block::kNoSkip;
        if (word.op == WordOp::kProgramEnd) return true;
        if (word.phase == ir::Phase::kFlow || word.phase == ir::Phase::kLast) return false;
        moves = moves || word.phase == ir::Phase::kMotion;
      }
      if (block.label.Valid() || IsTarget(block.number)) return false;
      if (moves && flow_.At(program, id).motion != ir::Motion::kRapid) return false;
    }
    return false;
  }

  /// G96 and G97 go with feed per revolution (sinumerik-8.8).
  bool SpeedMode(const Block& block, const Word& word, const ir::ModalState& before, const ir::ModalState& at) {
    const auto mode = static_cast<ir::SpeedMode>(word.index);
    if (mode == ir::SpeedMode::kRpm && before.speed_mode == mode) return false;
    if (at.feed_mode != ir::FeedMode::kPerRevolution)
      Refuse(block, word, "a change of the spindle mode where the feed may be per minute");
    return true;
  }

  /// The lead is F there, the centre word of the axis here (fanuc-8.1, sinumerik-8.4).
  void ThreadLead(ir::ProgramId program, BlockId id, const Block& block, const ir::ModalState& at,
                  std::vector<Word>& words) {
    if (!input_.source_machine->thread_lead_from_feed) return;
    // No way need lead here: a word of the block itself counts all the same.
    ir::Motion motion = at.motion;
    for (const Word& word : words) {
      if (word.op == WordOp::kMotion) motion = static_cast<ir::Motion>(word.index);
    }
    if (motion == ir::Motion::kThreadIncreasing) {
      for (const Word& word : words) {
        if (word.op == WordOp::kAxis) return Refuse(block, word, "a thread with a changing lead");
      }
    }
    if (motion != ir::Motion::kThread) return;
    std::vector<const Word*> axes;
    const Word* feed = nullptr;
    for (const Word& word : words) {
      if (word.op == WordOp::kAxis) axes.push_back(&word);
      if (word.op == WordOp::kFeed) feed = &word;
    }
    if (axes.empty()) return;
    if (feed == nullptr) return Refuse(block, *axes[0], "a thread whose lead stands in another block");
    for (const Word* axis : axes) {
      if (axis->index > 2) return Refuse(block, *axis, "a thread along this axis");
    }
    const std::optional<std::uint8_t> along = axes.size() == 1 ? axes[0]->index : LongerSide(program, id, block, axes);
    if (!along) return;
    Word lead = *feed;
    lead.op = WordOp::kCenter;
    lead.index = *along;
    lead.mode = ir::ValueMode::kStep;
    lead.phase = ir::DefaultPhaseOf(WordOp::kCenter);
    lead.spelling = 0;
    words.push_back(lead);
  }

  /// Axis of the longer way of a taper thread, whose letter the lead gets; none after a finding. In doubt between ways
  /// of one length it is the last axis: Z.
  std::optional<std::uint8_t> LongerSide(ir::ProgramId program, BlockId id, const Block& block,
                                         const std::vector<const Word*>& axes) {
    constexpr double kSame = 1e-9;  // mm
    if (axes.size() != 2 || axes[0]->index == axes[1]->index) {
      Refuse(block, *axes[2 < axes.size() ? 2 : 1], "a thread along more than two axes");
      return std::nullopt;
    }
    if (uses_.rotation || uses_.scaling) {
      Refuse(block, *axes[1], "a taper thread in a program that rotates or scales coordinates");
      return std::nullopt;
    }
    const std::uint8_t first = std::min(axes[0]->index, axes[1]->index);
    const std::uint8_t last = std::max(axes[0]->index, axes[1]->index);
    const ir::analysis::Interval first_way = positions_->WayOf(program, id, first);
    const ir::analysis::Interval last_way = positions_->WayOf(program, id, last);
    if (last_way.low >= first_way.high - kSame) return last;
    if (first_way.low >= last_way.high - kSame) return first;
    const bool known = first_way.IsBounded() && last_way.IsBounded();
    Refuse(block, *axes[1],
           known ? "a taper thread whose longer side is not the same in every run"
                 : "a taper thread between points that are not known here",
           known ? "" : "name both axes in absolute numbers in the block before it: the lead goes by the longer side");
    return std::nullopt;
  }

  [[nodiscard]] bool HasTaper() const {
    for (const ir::ProgramId program : module_.programs.Ids()) {
      for (const BlockId id : module_.programs[program].blocks) {
        int axes = 0;
        for (const WordId word : module_.blocks[id].words) axes += module_.words[word].op == WordOp::kAxis ? 1 : 0;
        const Word* motion = ir::FindWord(module_, module_.blocks[id], WordOp::kMotion);
        const auto own = motion == nullptr ? flow_.At(program, id).motion : static_cast<ir::Motion>(motion->index);
        if (axes > 1 && own == ir::Motion::kThread) return true;
      }
    }
    return false;
  }

  const RaiseInput& input_;
  Translation& out_;
  Module& module_;
  diag::Sink& sink_;
  ir::ExprBuilder make_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  Uses uses_;
  std::optional<ir::analysis::AxisPositions> positions_;  // where a thread is a taper
  bool ok_ = true;
};

}  // namespace

bool ArrangeWords(const RaiseInput& input, Translation& out, diag::Sink& sink) { return Pass(input, out, sink).Run(); }

}  // namespace ncport::backends::sinumerik
