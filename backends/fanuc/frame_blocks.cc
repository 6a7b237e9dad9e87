#include "backends/fanuc/frame_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "backends/fanuc/change_states.h"
#include "backends/fanuc/text_word.h"
#include "backends/fanuc/tool_words.h"
#include "dialects/fanuc/words.h"
#include "ir/analysis/flow_analyses.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/word_exprs.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordOp;
using ir::transform::ProgramEditor;

constexpr std::string_view kSafeZ = "{safe-z}", kB = "{b}";

Block AddedBlock(Module& module, ProgramEditor& editor, BlockId near, std::string_view text) {
  Block block = editor.MakeBlock(near);
  block.indent = 0;
  block.flags = Block::kAdded;
  Word word = TextWord(module, text);
  word.flags = Word::kAdded;
  editor.SetWords(block, {word});
  return block;
}

/// Lines in front of `at`: a jump to that block runs them, and where it is skipped they are.
void PutLinesInFront(Module& module, ProgramEditor& editor, BlockId at, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    Block made = AddedBlock(module, editor, at, line);
    editor.TakeHead(made, at);
    editor.InsertBefore(at, made);
  }
}

bool HoldsWords(const Module& module, BlockId id) { return !module.blocks[id].words.Empty(); }

/// The block brings a tool in.
bool IsToolChange(const Module& module, BlockId id) {
  for (const ir::WordId word_id : module.blocks[id].words) {
    const Word& word = module.words[word_id];
    if (IsToolCall(module, word) && (word.flags & (Word::kAdded | Word::kKeepsTool)) == 0) return true;
  }
  return false;
}

/// The lines that hold G words alone: those that move, or turn the work, are no modes.
std::string ModesOf(const std::vector<std::string>& lines) {
  std::string modes;
  for (const std::string& line : lines) {
    bool others = false;
    for (std::size_t at = 0; at < line.size(); ++at)
      others = others || ((at == 0 || line[at - 1] == ' ') && line[at] != 'G');
    if (others) continue;
    if (!modes.empty()) modes += ' ';
    modes += line;
  }
  return modes;
}

/// Lines of the profile with its own values in their holes, without words of axes that the machine does not have.
/// NeedFrame has seen to it that the values are known.
std::vector<std::string> Filled(const dialects::Profile& profile, const std::vector<std::string>& lines) {
  const bool has_y = std::find(profile.axes.begin(), profile.axes.end(), "Y") != profile.axes.end();
  std::vector<std::string> filled;
  for (std::string line : lines) {
    const auto fill = [&](std::string_view hole, const dialects::Setting<std::string>& value) {
      const std::size_t at = line.find(hole);
      if (at != std::string::npos) line.replace(at, hole.size(), *value);
    };
    fill(kSafeZ, profile.fanuc.safe_z);
    fill(kB, profile.fanuc.b_position);
    // "G0 G53 X0. Y0." (mazak-lathe-10.3)
    if (const std::size_t y = line.find(" Y0."); !has_y && y != std::string::npos) line.erase(y, 4);
    filled.push_back(std::move(line));
  }
  return filled;
}

/// The safety line for profiles that give no header of their own: one word of each group.
std::vector<std::string> SafetyLines(const RaiseInput& input, bool calls_tools) {
  const dialects::Profile& profile = *input.profile;
  const auto system = dialects::fanuc::SystemOf(profile);
  const auto code = [&](WordOp op, std::uint8_t index) -> std::string {
    const dialects::CodeRow* row = dialects::fanuc::Codes(*system).FindMeaning(op, index);
    return row == nullptr ? std::string() : std::string(row->text);
  };
  const ir::ModalState& start = input.source_machine->start;
  std::string line;
  const auto add = [&](const std::string& word) {
    if (word.empty()) return;
    if (!line.empty()) line += ' ';
    line += word;
  };
  add(code(WordOp::kUnits, static_cast<std::uint8_t>(ir::Units::kMm)));
  std::vector<std::string> lines{line};
  line.clear();
  const ir::Plane plane =
      start.plane == ir::Plane::kUnknown ? (profile.IsLathe() ? ir::Plane::kZX : ir::Plane::kXY) : start.plane;
  add(code(WordOp::kPlane, static_cast<std::uint8_t>(plane)));
  add(code(WordOp::kCutterComp, static_cast<std::uint8_t>(ir::CutterComp::kOff)));
  // A program without a tool call works with the length that is in force: that stays.
  if (!profile.IsLathe() && calls_tools) add(profile.words.length_offset_off.Or(""));
  add("G80");
  add(profile.words.absolute.Or(""));
  const ir::FeedMode feed = start.feed_mode == ir::FeedMode::kUnknown
                                ? (profile.IsLathe() ? ir::FeedMode::kPerRevolution : ir::FeedMode::kPerMinute)
                                : start.feed_mode;
  add(feed == ir::FeedMode::kPerMinute ? profile.words.feed_per_minute.Or("")
                                       : profile.words.feed_per_revolution.Or(""));
  add(code(WordOp::kSpeedMode, static_cast<std::uint8_t>(ir::SpeedMode::kRpm)));
  lines.push_back(line);
  return lines;
}

/// What switches off the frames that the programs use, and that M30 may have left on (fanuc-8.4, 8.5). The others need
/// options that this machine may not have.
std::vector<std::string> FramesOff(const dialects::Profile& profile, const Module& module,
                                   const std::vector<std::string>& head) {
  using dialects::fanuc::Special;
  const auto system = *dialects::fanuc::SystemOf(profile);
  bool shift = false, rotation = false;
  std::string axes = profile.IsLathe() ? "XZ" : "XYZ";  // a lathe need not have the Y of its profile
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const bool frame = ir::HasWord(module, module.blocks[id], WordOp::kFrame);
      for (const ir::WordId word : module.blocks[id].words) {
        if (frame && module.words[word].op == WordOp::kAxis && module.words[word].index == 1 && axes == "XZ")
          axes = "XYZ";
        if (module.words[word].op != WordOp::kFrame) continue;
        const auto op = static_cast<ir::FrameOp>(module.words[word].index);
        const bool turns = op == ir::FrameOp::kRotateAbout || op == ir::FrameOp::kRotateEnd;
        rotation = rotation || turns;
        shift = shift || !turns;
      }
    }
  }
  std::vector<std::string> lines;
  const std::string end(dialects::fanuc::TextOf(system, Special::kRotationOff));
  const bool written = std::ranges::any_of(head, [&](const std::string& line) { return HoldsWord(line, end); });
  if (rotation && !written) lines.push_back(end);
  if (shift) {
    std::string line(dialects::fanuc::TextOf(system, Special::kLocalShift));
    for (const char axis : axes) line += fmt::format(" {}0.", axis);
    lines.push_back(line);
  }
  return lines;
}

/// The plane that the programs take over from the start of the source: one that is in force at a motion without a word
/// of theirs. A word of the header that says otherwise becomes that one.
void PlaneOfSource(const RaiseInput& input, const Module& module, std::vector<std::string>& head) {
  const auto system = *dialects::fanuc::SystemOf(*input.profile);
  const ir::ModalState& start = input.source_machine->start;
  const ir::analysis::FlowAnalyses analyses(module, *input.source_machine, {});
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  bool plane = false;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      bool moves = false;
      for (const ir::WordId word : module.blocks[id].words) {
        const WordOp op = module.words[word].op;
        moves = moves || op == WordOp::kAxis || op == WordOp::kCenter || op == WordOp::kRadius;
      }
      if (!moves || !flow.Reached(program, id)) continue;
      plane = plane || flow.At(program, id).plane == ir::Plane::kUnknown;
    }
  }
  const auto code = [&](ir::Plane wanted) {
    return dialects::fanuc::Codes(system).FindMeaning(WordOp::kPlane, static_cast<std::uint8_t>(wanted));
  };
  if (!plane || start.plane == ir::Plane::kUnknown || code(start.plane) == nullptr) return;
  for (std::string& line : head) {
    for (const ir::Plane other : {ir::Plane::kXY, ir::Plane::kZX, ir::Plane::kYZ}) {
      if (other == start.plane || code(other) == nullptr || !HoldsWord(line, code(other)->text)) continue;
      const std::size_t at = (" " + line + " ").find(" " + std::string(code(other)->text) + " ");
      line.replace(at, code(other)->text.size(), code(start.plane)->text);
    }
  }
}

}  // namespace

bool NeedFrame(const RaiseInput& input, diag::Sink& sink) {
  const dialects::Profile& profile = *input.profile;
  const SourceRange nowhere{};
  bool known = dialects::Need(profile, profile.words.header, nowhere, sink);
  known = dialects::Need(profile, profile.words.footer, nowhere, sink) && known;
  const auto uses = [&](std::string_view hole) {
    const auto in = [&](const dialects::Setting<std::vector<std::string>>& lines) {
      if (!lines.Known()) return false;
      return std::any_of(lines->begin(), lines->end(),
                         [&](const std::string& line) { return line.find(hole) != std::string::npos; });
    };
    return in(profile.words.header) || in(profile.words.footer) || in(profile.words.home) ||
           in(profile.words.safe_position);
  };
  if (uses(kSafeZ)) known = dialects::Need(profile, profile.fanuc.safe_z, nowhere, sink) && known;
  if (!profile.IsMazakLathe()) return known;
  known = dialects::Need(profile, profile.fanuc.c_axis, nowhere, sink) && known;
  if (!profile.series.Is(dialects::Series::kM)) return known;
  known = dialects::Need(profile, profile.fanuc.b_position, nowhere, sink) && known;
  if (!profile.fanuc.b_position.Or("").empty())
    known = dialects::Need(profile, profile.fanuc.b_blocks, nowhere, sink) && known;
  return known;
}

void FrameMainPrograms(const RaiseInput& input, Translation& out) {
  Module& module = out.module;
  const dialects::Profile& profile = *input.profile;
  std::vector<std::string> head = Filled(profile, *profile.words.header);
  const std::vector<std::string> footer = Filled(profile, *profile.words.footer);
  if (head.empty()) {
    head = SafetyLines(input, !out.tools.empty());
  } else {
    PlaneOfSource(input, module, head);
  }
  // The feed mode that the source starts with, where the head ends in another one (mazak-lathe-10.3: G94 for the way
  // out, then G95).
  const ir::FeedMode feed = input.source_machine->start.feed_mode;
  const std::string minute = profile.words.feed_per_minute.Or("");
  const std::string revolution = profile.words.feed_per_revolution.Or("");
  const bool by_minute = feed == ir::FeedMode::kPerMinute;
  std::string feed_word;
  if (by_minute || feed == ir::FeedMode::kPerRevolution) {
    const std::string& other = by_minute ? revolution : minute;
    const bool differs =
        std::any_of(head.begin(), head.end(), [&](const std::string& line) { return HoldsWord(line, other); });
    if (differs) feed_word = by_minute ? minute : revolution;
  }
  const std::vector<std::string> off = FramesOff(profile, module, head);
  head.insert(head.end(), off.begin(), off.end());
  if (profile.IsMazakLathe()) {
    if (*profile.fanuc.c_axis) head.emplace_back("M202");
    const std::string leave = profile.fanuc.leave_mazatrol.Or("");
    if (!leave.empty()) head.push_back(leave);
  }
  if (!feed_word.empty()) head.push_back(feed_word);
  bool main = false;
  for (const ir::ProgramId program : module.programs.Ids()) {
    if (module.programs[program].kind != ir::ProgramKind::kMain) continue;
    main = true;
    ProgramEditor editor(module, program, "frame");
    const IdRange<BlockId> blocks = module.programs[program].blocks;
    bool any = false;
    for (const BlockId id : blocks) {
      // A jump back to the first block of the source does not run the head again.
      if (HoldsWords(module, id) && !std::exchange(any, true)) {
        for (const std::string& line : head) editor.InsertBefore(id, AddedBlock(module, editor, id, line));
      }
      if (ir::HasWord(module, module.blocks[id], WordOp::kProgramEnd)) PutLinesInFront(module, editor, id, footer);
    }
    editor.Apply();
  }
  if (!main) {
    // All positions are absolute and metric: no word says so where no main program is.
    out.assumptions.push_back(fmt::format("where this program is called these are in force: {}", ModesOf(head)));
    return;
  }
  if (!head.empty())
    out.added.push_back(
        fmt::format("head of the main program: {} blocks, so that no modal state is taken over", head.size()));
  if (!footer.empty()) out.added.push_back("end of the main program: away from the work, spindle off");
}

namespace {

/// A block behind the tool call `at`, on any way, that cuts although X or Z still stands where the way home left it;
/// none if both are named before on all ways up to calls and the end. A line may name them itself, an arc starts where
/// they stand.
BlockId CutFromHome(const Module& module, const ir::analysis::Cfg& graph, BlockId at) {
  constexpr std::uint32_t kBoth = 1U << 0U | 1U << 2U;
  struct Way {
    BlockId block;
    std::uint32_t named;  // axes since the call
    ir::Motion motion;    // as far as the blocks since the call say
    auto operator<=>(const Way&) const = default;
  };
  std::vector<Way> work;
  std::set<Way> seen;
  const auto go_on = [&](BlockId from, std::uint32_t named, ir::Motion motion) {
    for (const ir::analysis::Edge& edge : graph.Successors(from)) {
      if (edge.to.Valid() && seen.insert({edge.to, named, motion}).second) work.push_back({edge.to, named, motion});
    }
  };
  go_on(at, 0, ir::Motion::kUnknown);
  while (!work.empty()) {
    const Way way = work.back();
    work.pop_back();
    std::uint32_t named = way.named;
    ir::Motion motion = way.motion;
    bool moves = false;
    bool calls = false;
    for (const ir::WordId id : module.blocks[way.block].words) {
      const Word& word = module.words[id];
      calls = calls || word.op == WordOp::kCall || word.op == WordOp::kModalCall;
      if (word.op == WordOp::kMotion) motion = static_cast<ir::Motion>(word.index);
      if (word.op == WordOp::kAxis) named |= 1U << word.index & kBoth;
      moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius;
    }
    const bool line = motion == ir::Motion::kLinear;
    const bool cuts = motion != ir::Motion::kUnknown && motion != ir::Motion::kRapid;
    if (moves && cuts && (line ? named : way.named) != kBoth) return way.block;
    if (!calls && named != kBoth) go_on(way.block, named, motion);
  }
  return {};
}

/// Blocks of a main program at which the axes may have left the place where its head put them: behind a move, a call or
/// another tool change, on any way.
std::set<BlockId> AwayFromHome(const Module& module, const ir::analysis::Cfg& graph) {
  std::set<BlockId> away;
  std::vector<BlockId> work;
  const auto go_on = [&](BlockId from) {
    for (const ir::analysis::Edge& edge : graph.Successors(from)) {
      if (edge.to.Valid() && away.insert(edge.to).second) work.push_back(edge.to);
    }
  };
  for (const BlockId id : graph.Blocks()) {
    bool leaves = IsToolChange(module, id);
    for (const ir::WordId word_id : module.blocks[id].words) {
      const WordOp op = module.words[word_id].op;
      leaves = leaves || op == WordOp::kAxis || op == WordOp::kCenter || op == WordOp::kReference ||
               op == WordOp::kCall || op == WordOp::kModalCall;
    }
    if (leaves) go_on(id);
  }
  while (!work.empty()) {
    const BlockId id = work.back();
    work.pop_back();
    go_on(id);
  }
  return away;
}

/// Coolant off, alone in its block, and the speed fixed before the way home, where constant surface speed would race
/// the spindle (mazak-lathe-4.4, 5.2); the coolant again behind the change. What goes in front of the way
/// home comes into `front`.
bool StopForChange(const ChangeStates& states, ir::ProgramId program, BlockId id, ProgramEditor& editor,
                   const dialects::Profile& profile, Translation& out, diag::Sink& sink,
                   std::vector<std::string>& front) {
  Module& module = out.module;
  using Coolant = ChangeStates::Coolant;
  const ChangeStates::State state = states.Before(id);
  const auto refuse = [&](std::string_view what, std::string_view help) {
    sink.Report(diag::Code::kNotExpressible, module.RangeOf(module.blocks[id]), what, profile.name).help = help;
    return false;
  };
  if (state.coolant == Coolant::kMaybe)
    return refuse("a tool change with coolant that is on only on some ways to it", "write M8 or M9 before the tool");
  static constexpr std::string_view kAdded =
      "tool change: coolant off before the way home and on again behind it, G97 where the speed is chosen again behind "
      "it";
  const bool any = state.coolant != Coolant::kOff ||
                   (state.speed != ChangeStates::SurfaceSpeed::kOff && states.SpeedFollows(program, id));
  if (any && std::ranges::find(out.added, kAdded) == out.added.end()) out.added.emplace_back(kAdded);
  if (state.coolant != Coolant::kOff) {
    front.emplace_back("M9");
    editor.InsertAfter(id, AddedBlock(module, editor, id, state.coolant == Coolant::kM7 ? "M7" : "M8"));
  }
  if (state.speed == ChangeStates::SurfaceSpeed::kOff) return true;
  if (!states.SpeedFollows(program, id)) {
    // Which S to go back to is not one number here, and G97 would stay.
    static constexpr std::string_view kKept =
        "tool change under constant surface speed: the spindle follows X on the way home up to its limit, since no G96 "
        "or G97 stands behind the tool (mazak-lathe-5.2)";
    if (std::ranges::find(out.assumptions, kKept) == out.assumptions.end()) out.assumptions.emplace_back(kKept);
    return true;
  }
  front.emplace_back("G97");
  return true;
}

}  // namespace

bool FrameToolChanges(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const dialects::Profile& profile = *input.profile;
  if (!profile.IsLathe()) return true;
  Module& module = out.module;
  const std::vector<std::string> home =
      Filled(profile, profile.words.safe_position.Known() ? *profile.words.safe_position : profile.words.home.Or({}));
  std::vector<std::string> behind;
  if (profile.series.Is(dialects::Series::kM) && !out.tools.empty()) {
    // M6 cancels offsets and may leave X a radius; B stands where the last tool had it (mazak-lathe-3.2, 4.2, 10.3).
    if (const std::string diameter = profile.words.diameter_on.Or(""); !diameter.empty()) behind.push_back(diameter);
    if (!profile.fanuc.b_position.Or("").empty()) {
      const std::vector<std::string> turn = Filled(profile, *profile.fanuc.b_blocks);
      behind.insert(behind.end(), turn.begin(), turn.end());
    }
  }
  bool any = false;
  bool ok = true;
  const ir::analysis::FlowGraphs graphs(module);
  const ChangeStates states(input, module);
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "frame");
    const bool main = module.programs[program].kind == ir::ProgramKind::kMain;
    const std::set<BlockId> away = main ? AwayFromHome(module, graphs.Of(program)) : std::set<BlockId>{};
    for (const BlockId id : module.programs[program].blocks) {
      if (!IsToolChange(module, id)) continue;
      if (!main || away.contains(id)) {
        std::vector<std::string> front;
        if (profile.IsMazakLathe()) ok = StopForChange(states, program, id, editor, profile, out, sink, front) && ok;
        front.insert(front.end(), home.begin(), home.end());
        PutLinesInFront(module, editor, id, front);
        any = true;
        const BlockId cut = home.empty() ? BlockId{} : CutFromHome(module, graphs.Of(program), id);
        if (cut.Valid()) {
          ok = false;
          sink.Report(diag::Code::kNotExpressible, module.RangeOf(module.blocks[cut]),
                      "a cut behind a tool change before X and Z were both programmed again", profile.name)
              .help = "the tool comes from its change position: move both axes to the work first";
        }
      }
      for (const std::string& line : behind) {
        Block made = AddedBlock(module, editor, id, line);
        made.skip_level = module.blocks[id].skip_level;
        editor.InsertAfter(id, made);
      }
    }
    editor.Apply();
  }
  if (!behind.empty())
    out.added.emplace_back("behind each tool change: X as a diameter, B in the position for turning");
  if (any) out.added.push_back("tool change: away from the work in front of it, work offset again behind it");
  return ok;
}

void GuardMacros(const RaiseInput& input, Translation& out) {
  Module& module = out.module;
  ir::ExprBuilder make(module);
  const std::uint32_t alarm = input.profile->fanuc.alarms.Known() ? input.profile->fanuc.alarms->first : 21;
  bool any = false;
  for (const ir::ProgramId program : module.programs.Ids()) {
    std::vector<std::uint32_t> cells;
    ir::SpaceId space;
    for (const ir::transform::CellMapping& mapping : out.cells) {
      if (mapping.program == program && mapping.letter != 0) cells.push_back(mapping.first);
    }
    for (std::uint32_t i = 0; i < module.spaces.Size(); ++i) {
      if (module.View(module.spaces[ir::SpaceId{i}].name) == "#") space = ir::SpaceId{i};
    }
    const IdRange<BlockId> blocks = module.programs[program].blocks;
    // A letter that no block reads may be missing.
    std::set<std::uint32_t> read;
    for (const BlockId id : blocks) {
      for (const ir::WordId word : module.blocks[id].words) {
        ir::transform::VisitWordExprs(module, module.words[word], [&](ir::ExprId root, bool place) {
          ir::transform::VisitReads(module, root, [&](ir::ExprId node) {
            const ir::Expr& expr = module.exprs[node];
            if (expr.op == ir::ExprOp::kCell && expr.a == space.value && !(place && node == root)) read.insert(expr.b);
          });
        });
      }
    }
    std::erase_if(cells, [&](std::uint32_t cell) { return !read.contains(cell); });
    if (cells.empty() || blocks.Empty()) continue;
    std::set<std::uint32_t> numbers;
    for (const BlockId id : blocks) numbers.insert(module.blocks[id].number);
    std::uint32_t number = 9001;
    while (numbers.contains(number)) ++number;
    BlockId first = blocks[0];
    for (const BlockId id : blocks) {
      first = id;
      if (HoldsWords(module, id)) break;
    }
    ProgramEditor editor(module, program, "guard");
    for (const std::uint32_t cell : cells) {
      ir::Jump jump;
      jump.target.kind = ir::TargetKind::kNumber;
      jump.target.number = number;
      jump.search = ir::Search::kForwardThenFromStart;
      Word word = ir::MakeWord(WordOp::kJump, 0, make.Binary(ir::ExprOp::kEqual, make.Cell(space, cell), make.Vacant()),
                               module.jumps.Add(jump).value);
      word.flags = Word::kAdded;
      Block block = editor.MakeBlock(first);
      block.flags = Block::kAdded;
      block.indent = 0;
      editor.SetWords(block, {word});
      editor.InsertBefore(first, block);
    }
    const BlockId last = blocks[blocks.count - 1];
    const ir::ExprId shown = make.Text("ARGUMENT MISSING");
    Word raise = ir::MakeWord(WordOp::kAlarm, 0, make.Literal(alarm, ir::Type::kInt), shown.value);
    raise.flags = Word::kAdded;
    Block block = editor.MakeBlock(last);
    block.flags = Block::kAdded;
    block.indent = 0;
    block.number = number;
    editor.SetWords(block, {raise});
    editor.InsertAfter(last, block);
    editor.Apply();
    any = true;
  }
  if (any)
    out.added.push_back(fmt::format(
        "guards of the macros: a letter that is missing is an alarm (#3000={}), never an empty word", alarm));
}

}  // namespace ncport::backends::fanuc
