#include "backends/fanuc/mazak_lathe_rules.h"

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/analysis/forward_flow.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

/// Words that mean something else in this series, or that a port never needs (rows 1, 14, 16).
struct Forbidden {
  std::string_view word;
  std::string_view why;
};
constexpr Forbidden kSeriesT[] = {
    {"G90", "a turning cycle here"},  {"G91", "no word of series T"}, {"G92", "a threading cycle here"},
    {"G93", "no word of series T"},   {"G94", "a facing cycle here"}, {"G95", "no word of series T"},
    {"G43", "no word of series T"},   {"G49", "no word of series T"}, {"G69", "no word of series T"},
    {"G61.1", "no word of series T"},
};
constexpr Forbidden kSeriesM[] = {
    {"G50", "scaling off here"},      {"G98", "a return level here"},   {"G99", "a return level here"},
    {"G70", "no turning cycle here"}, {"G71", "no turning cycle here"}, {"G72", "no turning cycle here"},
    {"G73", "a milling cycle here"},  {"G74", "a milling cycle here"},  {"G75", "a milling cycle here"},
    {"G76", "a milling cycle here"},
};
constexpr Forbidden kAlways[] = {
    {"G53.5", "the MAZATROL coordinate system"},
    {"G112", "an order to the other system here"},
    {"G113", "an order to the other system here"},
};

std::vector<std::string_view> Split(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end != 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

/// Is a speed limit set on every way to a block? (row 3)
struct SpeedLimits {
  using State = bool;

  const Module& module;

  /// A program that is called from elsewhere relies on its caller; a main program starts without a limit.
  [[nodiscard]] State Entry(ProgramId program) const { return module.programs[program].kind != ir::ProgramKind::kMain; }
  [[nodiscard]] State Unknown(ProgramId) const { return false; }
  bool Join(BlockId, State& into, State from) const {
    const bool before = into;
    into = into && from;
    return into != before;
  }
  void Transfer(ProgramId, BlockId block, State& set) const {
    for (const WordId id : module.blocks[block].words) set = set || module.words[id].op == WordOp::kSpeedLimit;
  }
  /// Nothing takes a limit away.
  [[nodiscard]] State Back(const ir::analysis::CallSite&, State at, State exit) const { return at || exit; }
};

class Check {
 public:
  Check(const RaiseInput& input, const Translation& out, diag::Sink& sink)
      : profile_(*input.profile), machine_(*input.source_machine), out_(out), module_(out.module), sink_(sink) {}

  bool Run() {
    const ir::analysis::FlowAnalyses analyses(module_, machine_, {});
    SpeedLimits client{module_};
    ir::analysis::ForwardFlow<SpeedLimits> limits(analyses.Sources(), client);
    limits.Run();
    for (const ProgramId program : module_.programs.Ids()) {
      const bool main = module_.programs[program].kind == ir::ProgramKind::kMain;
      bool ends = false;
      for (const BlockId id : module_.programs[program].blocks) {
        const Block& block = module_.blocks[id];
        const bool* arrival = limits.Before(id);
        bool limit = arrival == nullptr || *arrival;
        for (const WordId word_id : block.words) {
          const Word& word = module_.words[word_id];
          switch (word.op) {
            case WordOp::kSpeedLimit:
              limit = true;
              break;
            case WordOp::kSpeedMode:
              if (word.index == static_cast<std::uint8_t>(ir::SpeedMode::kConstantSurface) && !limit)
                Refuse(block, "constant surface speed without a speed limit before it",
                       "write LIMS with G96 or before it: without one the spindle runs up as the tool nears the axis");
              break;
            case WordOp::kAxis:
              if (IsIntegrex() && word.index >= 6 && word.index < ir::kLetterAxes)
                Refuse(block, "a U, V or W axis", "");
              break;
            case WordOp::kProgramEnd:
              ends = ends || main;
              break;
            case WordOp::kReturn:
              if (main)
                Refuse(block, "a main program that ends as a subprogram (M99 repeats it for ever)", "end it with M30");
              ends = true;
              break;
            case WordOp::kInert:
              if (word.spelling != 0) CheckText(block, module_.View(module_.spellings[word.spelling].text), main);
              break;
            default:
              break;
          }
        }
      }
      if (!ends && !module_.programs[program].blocks.Empty()) {
        const IdRange<BlockId> blocks = module_.programs[program].blocks;
        Refuse(module_.blocks[blocks[blocks.count - 1]],
               main ? "a main program without an end word" : "a subprogram without a return",
               main ? "end it with M30" : "end it with M17 or RET");
      }
      if (main) CheckHead(program);
    }
    return ok_;
  }

 private:
  [[nodiscard]] bool IsIntegrex() const {
    return profile_.machine_class.Is(dialects::MachineClass::kIntegrexOld) ||
           profile_.machine_class.Is(dialects::MachineClass::kIntegrexNew);
  }
  void Refuse(const Block& block, const std::string& what, std::string_view help) {
    ok_ = false;
    auto& finding = sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block), what, profile_.name);
    if (!help.empty()) finding.help = help;
  }

  void CheckText(const Block& block, std::string_view text, bool main) {
    const bool series_t = profile_.series.Is(dialects::Series::kT);
    const std::span<const Forbidden> series = series_t ? std::span<const Forbidden>(kSeriesT) : kSeriesM;
    for (const std::string_view word : Split(text)) {
      for (const std::span<const Forbidden> rows : {series, std::span<const Forbidden>(kAlways)}) {
        for (const Forbidden& row : rows) {
          if (word == row.word)
            Refuse(block, std::string(word) + " (" + std::string(row.why) + ")",
                   "the word comes from the profile or from ncport.toml");
        }
      }
    }
    // A macro is called by whoever needs it, with whichever tool: changes stand in main programs (row 10).
    const bool tool =
        std::any_of(out_.tools.begin(), out_.tools.end(), [&](const ToolUse& use) { return use.target_words == text; });
    if (tool && !main)
      Refuse(block, "a tool change inside a macro", "move it to the main program and split the cycle there");
  }

  /// Power-on state is set by parameters: every group is written at the head (row 11).
  void CheckHead(ProgramId program) {
    static constexpr std::string_view kGroups[][4] = {
        {"G20", "G21", "", ""}, {"G17", "G18", "G19", ""},    {"G40", "", "", ""}, {"G80", "", "", ""},
        {"G67", "", "", ""},    {"G98", "G99", "G94", "G95"}, {"G97", "", "", ""},
    };
    std::set<std::string_view> written;
    const Block* first = nullptr;
    for (const BlockId id : module_.programs[program].blocks) {
      const Block& block = module_.blocks[id];
      if (block.words.Empty()) continue;
      if (first == nullptr) first = &block;
      if ((block.flags & Block::kAdded) == 0) break;
      for (const WordId word : block.words) {
        if (module_.words[word].op != WordOp::kInert || module_.words[word].spelling == 0) continue;
        for (const std::string_view each : Split(module_.View(module_.spellings[module_.words[word].spelling].text)))
          written.insert(each);
      }
    }
    if (first == nullptr) return;
    for (const auto& group : kGroups) {
      const bool any = std::any_of(std::begin(group), std::end(group),
                                   [&](std::string_view word) { return !word.empty() && written.contains(word); });
      if (any) continue;
      std::string names(group[0]);
      for (std::size_t i = 1; i < std::size(group) && !group[i].empty(); ++i) names += " or " + std::string(group[i]);
      Refuse(*first, "a main program whose head leaves out " + names, "add it to `header` in the profile");
    }
  }

  const dialects::Profile& profile_;
  const ir::Machine& machine_;
  const Translation& out_;
  const Module& module_;
  diag::Sink& sink_;
  bool ok_ = true;
};

}  // namespace

bool CheckMazakLathe(const RaiseInput& input, const Translation& out, diag::Sink& sink) {
  return Check(input, out, sink).Run();
}

}  // namespace ncport::backends::fanuc
