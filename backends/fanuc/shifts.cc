#include "backends/fanuc/shifts.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "backends/fanuc/message_text.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/analysis/unwritten_cells.h"
#include "ir/axis_names.h"
#include "ir/builder.h"
#include "ir/length_units.h"
#include "ir/make_word.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::FrameOp;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

constexpr std::uint8_t kLinearAxes = 3;

const Word* FrameWord(const Module& module, BlockId id) {
  for (const WordId word : module.blocks[id].words) {
    if (module.words[word].op == WordOp::kFrame) return &module.words[word];
  }
  return nullptr;
}

bool Adds(const Word& frame) { return frame.index == static_cast<std::uint8_t>(FrameOp::kAddTranslate); }

Word AxisWord(std::uint8_t axis, ExprId value) {
  Word word = ir::MakeWord(WordOp::kAxis, axis, value);
  word.mode = ir::ValueMode::kAbsolute;
  return word;
}

/// The words as they were written; a value that is no number is left out.
std::string Spelled(const Module& module, const Block& block) {
  std::string text;
  for (const WordId id : block.words) {
    const Word& word = module.words[id];
    const std::string_view name = word.op == WordOp::kAxis && word.index < ir::kLetterAxes
                                      ? ir::kAxisLetters.substr(word.index, 1)
                                      : module.View(module.spellings[word.spelling].text);
    text += fmt::format("{}{}", text.empty() ? "" : " ", name);
    const ir::transform::LinearForm value =
        word.value.Valid() ? ir::transform::FormOf(module, word.value) : ir::transform::LinearForm{};
    if (word.value.Valid()) text += value.IsConstant() ? fmt::format("{:.6g}", value.constant) : "..";
  }
  return text;
}

}  // namespace

bool FramesAreWorkedIn(const RaiseInput& input, const Translation& out) {
  const Module& module = out.module;
  bool adds = false;
  std::set<std::uint32_t> holders;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Word* frame = FrameWord(module, id);
      if (frame == nullptr) continue;
      const auto op = static_cast<FrameOp>(frame->index);
      if (op >= FrameOp::kLocalShift) return false;
      holders.insert(program.value);
      adds = adds || Adds(*frame);
      if (op != FrameOp::kTranslate && op != FrameOp::kAddTranslate && op != FrameOp::kReset) return true;
      if (program.value < input.source->programs.Size() && input.source->programs[program].saves_modal_state)
        return true;
      for (const WordId word : module.blocks[id].words) {
        if (module.words[word].op == WordOp::kAxis && module.words[word].index == 0 && input.profile->IsLathe())
          return true;
      }
    }
  }
  return adds && (holders.size() > 1 || module.programs[ProgramId{*holders.begin()}].kind != ir::ProgramKind::kMain);
}

void FramesToComments(Translation& out, bool frames) {
  Module& module = out.module;
  bool any = false;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      Block& block = module.blocks[id];
      const bool frame = frames && FrameWord(module, id) != nullptr;
      bool pole = false;
      for (const WordId word : block.words) pole = pole || module.words[word].op == WordOp::kPole;
      if (!frame && !pole) continue;
      any = any || frame;
      ir::Comment comment;
      comment.text = module.strings.Intern(Spelled(module, block));
      comment.place = block.comments.Empty() ? ir::CommentPlace::kEndOfBlock : ir::CommentPlace::kOwnLine;
      std::vector<ir::Comment> comments{comment};
      for (const ir::CommentId old : block.comments) comments.push_back(module.comments[old]);
      block.comments = {static_cast<std::uint32_t>(module.comments.Size()),
                        static_cast<std::uint32_t>(comments.size())};
      for (const ir::Comment& each : comments) module.comments.Add(each);
    }
  }
  if (any) out.added.emplace_back("no words for the frames of the source: they are worked into the coordinates");
}

bool ShiftsToLocal(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  ir::ExprBuilder make(module);
  bool ok = true;
  std::uint16_t shifted = 0;  // axes
  std::set<std::uint32_t> holders;
  bool adds = false;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Word* frame = FrameWord(module, id);
      if (frame == nullptr) continue;
      holders.insert(program.value);
      adds = adds || Adds(*frame);
      const auto refuse = [&](std::string_view what) {
        ok = false;
        sink.Report(diag::Code::kNotExpressible, module.RangeOf(module.blocks[id], *frame), what, input.profile->name);
      };
      if (static_cast<FrameOp>(frame->index) >= FrameOp::kLocalShift)
        refuse("a rotation, scale or mirror of the coordinates");
      for (const WordId word_id : module.blocks[id].words) {
        const Word& word = module.words[word_id];
        if (word.op != WordOp::kAxis) continue;
        shifted = static_cast<std::uint16_t>(shifted | (1U << word.index));
        if (word.index >= kLinearAxes) refuse("a shift of a rotary or further axis");
      }
    }
  }
  if (!ok || holders.empty()) return ok;
  if (shifted == 0) shifted = input.profile->IsLathe() ? 4 : 7;
  const ProgramId holder{*holders.begin()};
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  std::array<ir::VariableId, kLinearAxes> sums{};
  static constexpr std::array<std::string_view, kLinearAxes> kNames{"SHIFT_X", "SHIFT_Y", "SHIFT_Z"};
  if (adds) {
    for (std::uint8_t axis = 0; axis < kLinearAxes; ++axis) {
      if (shifted >> axis & 1U) sums[axis] = ir::transform::NewLocal(module, holder, kNames[axis], ir::Type::kReal);
    }
  }
  for (const std::uint32_t value : holders) {
    const ProgramId program{value};
    ProgramEditor editor(module, program, "shifts_to_local");
    const IdRange<BlockId> blocks = module.programs[program].blocks;
    bool head = true;
    for (const BlockId id : blocks) {
      const Block block = module.blocks[id];
      if (head && adds && !block.words.Empty()) {
        head = false;
        for (std::uint8_t axis = 0; axis < kLinearAxes; ++axis) {
          if (!sums[axis].Valid()) continue;
          Block start = editor.MakeBlock(id);
          editor.SetWords(start, {ir::MakeAssignment(make.Variable(sums[axis]), make.Literal(0))});
          editor.InsertBefore(id, start);
        }
      }
      const Word* found = FrameWord(module, id);
      if (found == nullptr) {
        // The source forgets its shifts at the end of the program, the target need not.
        bool end = false;
        for (const WordId word : block.words) end = end || module.words[word].op == WordOp::kProgramEnd;
        if (!end || module.programs[program].kind != ir::ProgramKind::kMain) continue;
        Word frame = ir::MakeWord(WordOp::kFrame, FrameOp::kTranslate);
        frame.flags = Word::kAdded;
        std::vector<Word> words{frame};
        for (std::uint8_t axis = 0; axis < kLinearAxes; ++axis) {
          if (shifted >> axis & 1U) words.push_back(AxisWord(axis, make.Literal(0)));
        }
        Block reset = editor.MakeBlock(id);
        reset.flags = Block::kAdded;
        editor.TakeHead(reset, id);
        editor.SetWords(reset, words);
        editor.InsertBefore(id, reset);
        continue;
      }
      Word frame = *found;
      const bool add = Adds(frame);
      const ir::ModalState state = flow.At(program, id);
      const double factor = ir::MmPerLengthUnit(state.units);
      std::array<ExprId, kLinearAxes> values{};
      std::vector<Word> others;
      for (const WordId word_id : block.words) {
        const Word& word = module.words[word_id];
        if (word.op == WordOp::kAxis) values[word.index] = word.value;
        if (word.op != WordOp::kAxis && word.op != WordOp::kFrame) others.push_back(word);
      }
      frame.index = static_cast<std::uint8_t>(FrameOp::kTranslate);
      std::vector<Word> words = others;
      words.push_back(frame);
      for (std::uint8_t axis = 0; axis < kLinearAxes; ++axis) {
        if ((shifted >> axis & 1U) == 0) continue;
        ExprId shift = values[axis];
        if (shift.Valid() && factor != 1)
          shift = ir::transform::ExprOf(module,
                                        ir::transform::Sum(module, {}, ir::transform::FormOf(module, shift), factor));
        if (!adds) {
          words.push_back(AxisWord(axis, shift.Valid() ? shift : make.Literal(0)));
          continue;
        }
        const ExprId sum = make.Variable(sums[axis]);
        words.push_back(AxisWord(axis, sum));
        if (add && !shift.Valid()) continue;
        ExprId sum_value = shift.Valid() ? shift : make.Literal(0);
        if (add)
          sum_value = make.Binary(ir::ExprOp::kAdd, make.Variable(sums[axis]), make.Unary(ir::ExprOp::kGroup, shift));
        editor.PutInFront(id, {ir::MakeAssignment(make.Variable(sums[axis]), sum_value)});
      }
      editor.SetWords(id, words);
    }
    editor.Apply();
  }
  return true;
}

bool MapAlarms(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  ir::ExprBuilder make(module);
  const dialects::Profile& profile = *input.profile;
  std::map<std::uint32_t, std::uint32_t> numbers;
  std::set<std::uint32_t> taken;
  bool ok = true;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Block& block = module.blocks[id];
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        if (word.op != WordOp::kAlarm) continue;
        const SourceRange at = module.RangeOf(block, word);
        const auto refuse = [&](std::string_view what) {
          ok = false;
          sink.Report(diag::Code::kNotExpressible, at, what, profile.name);
        };
        ExprId value = word.value;
        while (module.exprs[value].op == ir::ExprOp::kGroup || module.exprs[value].op == ir::ExprOp::kConvert)
          value = ExprId{module.exprs[value].a};
        if (module.exprs[value].op != ir::ExprOp::kLiteral) {
          refuse("an alarm with a computed number");
          continue;
        }
        const double written = module.exprs[value].number;
        if (!(written >= 0 && written <= std::numeric_limits<std::int32_t>::max())) {
          refuse(fmt::format("alarm {:.0f}", written));
          continue;
        }
        const auto number = static_cast<std::uint32_t>(written);
        bool shows = word.index == static_cast<std::uint8_t>(ir::AlarmKind::kShows);
        if (word.index == static_cast<std::uint8_t>(ir::AlarmKind::kByNumber)) {
          for (const ir::AlarmRange& range : input.source_machine->shown_alarms)
            shows = shows || (number >= range.first && number <= range.last);
        }
        if (shows) {
          refuse("an alarm that only shows a text");
          continue;
        }
        if (!dialects::Need(profile, profile.fanuc.alarms, at, sink)) return false;
        const auto known = numbers.find(number);
        std::uint32_t target = 0;
        if (known != numbers.end()) {
          target = known->second;
        } else {
          // The first number is that of the guards. The last digits stay where they fit, so that the map is stable.
          const std::uint32_t least = profile.fanuc.alarms->first + 1;
          const std::uint32_t count = profile.fanuc.alarms->last - least + 1;
          if (taken.size() >= count) {
            refuse("more alarm numbers than the control has for programs");
            continue;
          }
          target = least + number % 1000 % count;
          while (taken.contains(target)) target = target == profile.fanuc.alarms->last ? least : target + 1;
          taken.insert(target);
          numbers[number] = target;
          out.alarms.push_back({number, target, fmt::format("#3000={}", target)});
        }
        std::string text;
        AppendMessage(module, word.Extra<ExprId>(), text);
        if (text.empty()) text = fmt::format("ALARM {}", number);
        word.value = make.Literal(target, ir::Type::kInt);
        word.extra = make.Text(text).value;
        module.words[word_id] = word;
      }
    }
  }
  return ok;
}

bool RefuseInputs(const RaiseInput& input, const Translation& out, diag::Sink& sink) {
  const Module& module = out.module;
  const ir::analysis::FlowGraphs graphs(module);
  const ir::analysis::CallGraph calls(module);
  bool ok = true;
  for (const ir::analysis::UnwrittenRead& read : ir::analysis::UnwrittenCells(module, graphs, calls)) {
    const ir::Space& space = module.spaces[read.space];
    if (space.visibility == ir::Visibility::kLevel) continue;  // letters of the call, or empty
    const bool computed = read.cell == ir::analysis::UnwrittenRead::kComputed;
    // A computed number may reach any cell of the space: all of it is pinned by its first cell.
    const std::string first = fmt::format("{}{}", module.View(space.name), computed ? space.first : read.cell);
    if (input.config != nullptr && input.config->FindVariable(first) != nullptr) continue;
    const std::string name = computed ? fmt::format("{}[..] with a computed number", module.View(space.name)) : first;
    const Block& block = module.blocks[read.block];
    sink.Report(diag::Code::kMachineValue, module.RangeOf(block, module.words[read.word]),
                fmt::format("{}, which may be read here before the program has written it,", name))
        .help = fmt::format(
        "it is an input of the operator or of another program; name its place in ncport.toml:  [variables]  {} = "
        "\"#500\"",
        first);
    ok = false;
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
