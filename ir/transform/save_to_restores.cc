#include "ir/transform/save_to_restores.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "ir/analysis/flow_analyses.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/mode_use.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

/// A modal group: its word and its value in a state (0 = unknown).
struct Group {
  WordOp op;
  std::string_view name;
  std::uint8_t (*value)(const ModalState&);
};
constexpr Group kGroups[] = {
    {WordOp::kMotion, "the motion mode", [](const ModalState& s) { return static_cast<std::uint8_t>(s.motion); }},
    {WordOp::kPlane, "the plane", [](const ModalState& s) { return static_cast<std::uint8_t>(s.plane); }},
    {WordOp::kDistance, "the distance mode", [](const ModalState& s) { return static_cast<std::uint8_t>(s.distance); }},
    {WordOp::kUnits, "the unit", [](const ModalState& s) { return static_cast<std::uint8_t>(s.units); }},
    {WordOp::kFeedMode, "the feed mode", [](const ModalState& s) { return static_cast<std::uint8_t>(s.feed_mode); }},
    {WordOp::kCutterComp, "cutter compensation", [](const ModalState& s) { return static_cast<std::uint8_t>(s.comp); }},
    {WordOp::kDiameter, "the diameter mode", [](const ModalState& s) { return static_cast<std::uint8_t>(s.diameter); }},
    {WordOp::kPathMode, "the path mode", [](const ModalState& s) { return static_cast<std::uint8_t>(s.path); }},
};
/// Bit of the work offset, whose value is a number, behind those of kGroups.
constexpr std::uint32_t kOffsetBit = 1U << std::size(kGroups);
/// The same for the mode of the speed: no word puts it back, since the speed that the spindle then has is not told.
constexpr std::uint32_t kSpeedBit = kOffsetBit << 1U;

std::uint8_t SpeedModeOf(const ModalState& state) { return static_cast<std::uint8_t>(state.speed_mode); }

class Pass {
 public:
  Pass(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink)
      : module_(module),
        source_(source),
        sub_entry_(sub_entry),
        sink_(sink),
        analyses_(module, source, {source.start, sub_entry}),
        flow_(analyses_.Modal()) {}

  bool Run() {
    FindChanges();
    bool any = false;
    for (const Program& program : module_.programs.All()) any = any || program.saves_modal_state;
    if (!any) return true;
    FindModal();
    const bool start_path = PutsStartPathBack();
    for (const ProgramId program : module_.programs.Ids()) {
      Restore(program);
      if (inside_[program.value]) RestoreInside(program);
    }
    // Those that put back what they found themselves still do: later passes may rely on it.
    for (const ProgramId program : module_.programs.Ids())
      module_.programs[program].saves_modal_state = inside_[program.value];
    if (start_path) NameStartPath();
    return ok_;
  }

 private:
  /// Bit per row of kGroups, and kOffsetBit: groups that a program, or one below it that does not put them back, has
  /// words for.
  void FindChanges() {
    changes_.assign(module_.programs.Size(), 0);
    for (bool changed = true; changed;) {
      changed = false;
      for (const ProgramId program : module_.programs.Ids()) {
        std::uint32_t now = changes_[program.value];
        for (const BlockId block : module_.programs[program].blocks) {
          for (const WordId id : module_.blocks[block].words) {
            const Word& word = module_.words[id];
            for (std::size_t group = 0; group < std::size(kGroups); ++group) {
              if (word.op == kGroups[group].op) now |= 1U << group;
            }
            // Constant surface speed changes the feed mode on some controls.
            if (word.op == WordOp::kSpeedMode) now |= 1U << 4U | kSpeedBit;
            if (word.op == WordOp::kWorkOffset) now |= kOffsetBit;
            if (word.op == WordOp::kComputedG || word.op == WordOp::kVerbatim) now = ~0U;
            if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
            const auto call = word.Extra<CallId>();
            if (!call.Valid() || !module_.calls[call].program.Valid()) continue;
            const ProgramId callee = module_.calls[call].program;
            if (!module_.programs[callee].saves_modal_state) now |= changes_[callee.value];
          }
        }
        changed = changed || now != changes_[program.value];
        changes_[program.value] = now;
      }
    }
  }

  /// Programs that are called modally run behind blocks whose text says nothing of them: they put back what they found
  /// themselves.
  void FindModal() {
    inside_.assign(module_.programs.Size(), false);
    for (const analysis::CallSite& site : analyses_.Calls().AllSites()) {
      if (site.modal && site.callee.Valid() && module_.programs[site.callee].saves_modal_state)
        inside_[site.callee.value] = true;
    }
  }

  /// Words that put the changed groups back to `before`; a group that is not one value is a finding at `at`. `call`:
  /// the block behind which they will stand, invalid inside the callee; a mode that nothing behind it uses stays as it
  /// is.
  std::vector<Word> WordsFor(ProgramId callee, const ModalState& before, const SourceRange& at, ProgramId caller,
                             BlockId call) {
    std::vector<Word> words;
    for (std::size_t group = 0; group < std::size(kGroups); ++group) {
      if ((changes_[callee.value] >> group & 1U) == 0) continue;
      if (call.Valid() && IsSilent(kGroups[group].op) &&
          !ModeIsUsedBehind(module_, analyses_.Graphs(), caller, call, kGroups[group].op))
        continue;
      const std::uint8_t value = kGroups[group].value(before);
      if (value == 0) {
        Unknown(kGroups[group].name, at);
        continue;
      }
      if (kGroups[group].op == WordOp::kMotion && LeavesAs(callee, kGroups[group].value, value)) continue;
      words.push_back(WordOf(kGroups[group].op, value));
    }
    const std::uint8_t speed = SpeedModeOf(before);
    if ((changes_[callee.value] & kSpeedBit) != 0 && (speed == 0 || !LeavesAs(callee, SpeedModeOf, speed))) {
      ok_ = false;
      sink_.Report(diag::Code::kUnknownModalState, at, "the speed of the spindle",
                   "the called program puts back (SAVE) whether it is a surface speed");
    }
    if ((changes_[callee.value] & kOffsetBit) == 0) return words;
    if (before.work_offset.known) {
      Word made = WordOf(WordOp::kWorkOffset, 0);
      made.extra = before.work_offset.number;
      if (before.work_offset.extension != 0)
        made.value = ExprBuilder(module_).Literal(before.work_offset.extension, Type::kInt);
      words.push_back(made);
    } else if (!call.Valid() || ModeIsUsedBehind(module_, analyses_.Graphs(), caller, call, WordOp::kWorkOffset)) {
      Unknown("the work offset", at);
    }
    return words;
  }

  /// The output says of a path word that the translation chose it: the source may leave it to the machine.
  static void MarkPath(Block& block, const std::vector<Word>& words) {
    for (const Word& word : words) {
      if (word.op == WordOp::kPathMode) block.flags |= Block::kAdded;
    }
  }

  static Word WordOf(WordOp op, std::uint8_t index) {
    Word made = MakeWord(op, index);
    made.flags = Word::kAdded;
    return made;
  }

  void Unknown(std::string_view group, const SourceRange& at) {
    ok_ = false;
    sink_.Report(diag::Code::kUnknownModalState, at, group,
                 "the called program puts it back (SAVE), and what it was is not one value here");
  }

  /// True if a program puts back a path mode that no word chose: the one that the machine starts with.
  [[nodiscard]] bool PutsStartPathBack() const {
    constexpr std::uint32_t kPathBit = 1U << (std::size(kGroups) - 1);
    static_assert(kGroups[std::size(kGroups) - 1].op == WordOp::kPathMode);
    ModalState start = source_.start;
    if (start.path == PathMode::kUnknown) return false;
    start.path = PathMode::kUnknown;
    const analysis::ModalFlow chosen(module_, source_, analyses_.Graphs(), analyses_.Calls(), {start, sub_entry_});
    for (const analysis::CallSite& site : analyses_.Calls().AllSites()) {
      if (!site.callee.Valid() || !module_.programs[site.callee].saves_modal_state) continue;
      if ((changes_[site.callee.value] & kPathBit) == 0) continue;
      const PathMode before = site.modal ? chosen.Entry(site.callee).path : chosen.At(site.caller, site.block).path;
      if (before == PathMode::kUnknown) return true;
    }
    return false;
  }

  /// The path mode that the machine starts with, at the head of main programs: what is put back is then what was in
  /// force before.
  void NameStartPath() {
    for (const ProgramId program : module_.programs.Ids()) {
      if (module_.programs[program].kind != ProgramKind::kMain) continue;
      for (const BlockId id : module_.programs[program].blocks) {
        if (module_.blocks[id].words.Empty()) continue;
        const WordOp op = module_.words[WordId{std::size_t{module_.blocks[id].words.begin}}].op;
        if (op == WordOp::kDefine || op == WordOp::kExtern || op == WordOp::kHeader) continue;
        ProgramEditor editor(module_, program, "save_to_restores");
        Block made = editor.MakeBlock(id);
        made.flags |= Block::kAdded;
        editor.SetWords(made, {WordOf(WordOp::kPathMode, static_cast<std::uint8_t>(source_.start.path))});
        editor.InsertBefore(id, made);
        editor.Apply();
        break;
      }
    }
  }

  /// At each of its returns the group has this value anyway.
  bool LeavesAs(ProgramId program, std::uint8_t (*value_of)(const ModalState&), std::uint8_t value) const {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    bool returned = false;
    for (const BlockId id : blocks) {
      returned = false;
      for (const WordId word_id : module_.blocks[id].words) {
        const Word& word = module_.words[word_id];
        const bool leaves = word.op == WordOp::kReturn || word.op == WordOp::kProgramEnd;
        returned = returned || leaves;
        if (leaves && flow_.Reached(program, id) && value_of(flow_.At(program, id)) != value) return false;
      }
    }
    return returned;  // the text ends with one
  }

  /// Groups whose words by themselves make the machine do nothing.
  static bool IsSilent(WordOp op) {
    return op == WordOp::kMotion || op == WordOp::kPlane || op == WordOp::kDistance || op == WordOp::kDiameter;
  }

  /// The words that put back stand in front of each return of the program.
  void RestoreInside(ProgramId program) {
    const IdRange<BlockId> blocks = module_.programs[program].blocks;
    if (blocks.Empty()) return;
    const std::vector<Word> words =
        WordsFor(program, flow_.Entry(program), module_.RangeOf(module_.blocks[blocks[0]]), {}, {});
    if (words.empty()) return;
    ProgramEditor editor(module_, program, "save_to_restores");
    for (const BlockId id : blocks) {
      const Block block = module_.blocks[id];
      std::vector<Word> rest, returns;
      for (const WordId word_id : block.words) {
        const Word& word = module_.words[word_id];
        const bool leaves = word.op == WordOp::kReturn || word.op == WordOp::kProgramEnd;
        (leaves ? returns : rest).push_back(word);
      }
      if (returns.empty()) continue;
      // The block's own words first, then what puts back, then the return.
      Block back = editor.MakeBlock(id);
      back.skip_level = block.skip_level;
      MarkPath(back, words);
      editor.SetWords(back, words);
      if (rest.empty()) {
        editor.TakeHead(back, id);
        editor.InsertBefore(id, back);
        continue;
      }
      Block leave = editor.MakeBlock(id);
      leave.skip_level = block.skip_level;
      editor.SetWords(leave, returns);
      editor.SetWords(id, rest);
      editor.InsertAfter(id, back);
      editor.InsertAfter(id, leave);
    }
    editor.Apply();
  }

  void Restore(ProgramId program) {
    ProgramEditor editor(module_, program, "save_to_restores");
    for (const BlockId id : module_.programs[program].blocks) {
      const Block block = module_.blocks[id];
      for (const WordId word_id : block.words) {
        const Word word = module_.words[word_id];
        if (word.op != WordOp::kCall || !word.Extra<CallId>().Valid()) continue;
        const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
        if (!callee.Valid() || !module_.programs[callee].saves_modal_state) continue;
        if (inside_[callee.value]) continue;
        const std::vector<Word> words =
            WordsFor(callee, flow_.At(program, id), module_.RangeOf(block, word), program, id);
        if (words.empty()) continue;
        Block made = editor.MakeBlock(id);
        made.skip_level = block.skip_level;
        MarkPath(made, words);
        editor.SetWords(made, words);
        editor.InsertAfter(id, made);
      }
    }
    editor.Apply();
  }

  Module& module_;
  const Machine& source_;
  const ModalState& sub_entry_;
  diag::Sink& sink_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& flow_;
  std::vector<std::uint32_t> changes_;
  std::vector<bool> inside_;  // per program: puts back what it found before it returns
  bool ok_ = true;
};

}  // namespace

bool SaveToRestores(Module& module, const Machine& source, const ModalState& sub_entry, diag::Sink& sink) {
  return Pass(module, source, sub_entry, sink).Run();
}

}  // namespace ncport::ir::transform
