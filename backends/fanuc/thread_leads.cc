#include "backends/fanuc/thread_leads.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <vector>

#include "ir/analysis/forward_flow.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/make_word.h"

namespace ncport::backends::fanuc {

namespace {

using ir::BlockId;
using ir::Module;
using ir::ProgramId;
using ir::Word;
using ir::WordId;
using ir::WordOp;

/// What a block means for the feed in force.
struct Use {
  bool thread = false;                        // its lead replaces the feed
  bool variable = false, decreasing = false;  // F is the change of the lead in the source, K here
  bool feed = false;                          // names a feed
  bool relies = false;                        // a feed move without a feed word
  ir::ExprId literal;                         // the feed that it names, where that is a number
  ir::FeedMode mode = ir::FeedMode::kUnknown;
};

/// The feed of the source on the ways to a block.
struct Feed {
  bool lost = false;   // on some way a thread took it
  ir::ExprId literal;  // the number that is in force in the source on every way; none: not one number
  ir::FeedMode mode = ir::FeedMode::kUnknown;  // under which it was written
};

class Leads {
 public:
  using State = Feed;
  [[nodiscard]] State Entry(ProgramId) const { return {}; }
  [[nodiscard]] State Unknown(ProgramId) const { return {.lost = true}; }
  bool Join(BlockId, State& into, const State& from) const {
    const Feed before = into;
    into.lost = into.lost || from.lost;
    if (!Same(into, from)) into.literal = {};
    return into.lost != before.lost || into.literal != before.literal;
  }
  void Transfer(ProgramId, BlockId block, State& feed) const {
    const Use& use = uses_.at(block);
    if (use.feed) {
      feed.literal = use.literal;
      feed.mode = use.mode;
    }
    feed.lost = use.thread || (feed.lost && !use.feed && !CanName(use, feed));
  }

  Leads(const RaiseInput& input, Module& module, diag::Sink& sink)
      : input_(input), module_(module), sink_(sink), analyses_(input.Analyse(module)), flow_(analyses_.Modal()) {}

  bool Run();

 private:
  [[nodiscard]] bool Same(const Feed& a, const Feed& b) const {
    return a.literal.Valid() && b.literal.Valid() && a.mode == b.mode &&
           module_.exprs[a.literal].number == module_.exprs[b.literal].number;
  }
  /// The block can name the feed that the source keeps.
  [[nodiscard]] static bool CanName(const Use& use, const Feed& feed) {
    return use.relies && feed.literal.Valid() && feed.mode != ir::FeedMode::kUnknown && use.mode == feed.mode;
  }
  void Name(BlockId block, ir::ExprId feed);
  [[nodiscard]] ir::ExprId Negated(ir::ExprId value);
  void NameDecreasing();
  [[nodiscard]] Use UseOf(ProgramId program, BlockId block) const;

  const RaiseInput& input_;
  Module& module_;
  diag::Sink& sink_;
  ir::analysis::FlowAnalyses analyses_;
  const ir::analysis::ModalFlow& flow_;
  std::map<BlockId, Use> uses_;
};

Use Leads::UseOf(ProgramId program, BlockId id) const {
  const ir::Block& block = module_.blocks[id];
  const ir::Motion motion = flow_.At(program, id).motion;
  Use use;
  use.mode = flow_.At(program, id).feed_mode;
  bool lead = false, moves = false, elsewhere = false;
  for (const WordId word_id : block.words) {
    const Word& word = module_.words[word_id];
    // Where the source has the lead in F as well, its words stay.
    lead = lead || (word.op == WordOp::kCenter && !input_.source_machine->thread_lead_from_feed);
    use.feed = use.feed || word.op == WordOp::kFeed;
    if (word.op == WordOp::kFeed && module_.exprs[word.value].op == ir::ExprOp::kLiteral) use.literal = word.value;
    moves = moves || word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius;
    elsewhere = elsewhere || word.op == WordOp::kFrame || word.op == WordOp::kReference ||
                word.op == WordOp::kPresetPosition || word.op == WordOp::kMachineCoords;
  }
  use.decreasing = motion == ir::Motion::kThreadDecreasing;
  use.variable = lead && (use.decreasing || motion == ir::Motion::kThreadIncreasing);
  use.thread = (motion == ir::Motion::kThread && lead) || use.variable;
  // In the source the F of such a block is no feed.
  if (use.variable) use.feed = false;
  const bool cuts = motion != ir::Motion::kRapid && motion != ir::Motion::kThread &&
                    motion != ir::Motion::kThreadIncreasing && !use.decreasing;
  use.relies = moves && cuts && !elsewhere && !use.feed;
  return use;
}

void Leads::Name(BlockId id, ir::ExprId feed) {
  ir::Block& block = module_.blocks[id];
  std::vector<Word> words;
  for (const WordId word : block.words) words.push_back(module_.words[word]);
  Word made = ir::MakeWord(WordOp::kFeed, 0, feed);
  made.flags = Word::kAdded;
  words.push_back(made);
  ir::SetWords(module_, block, words);
}

ir::ExprId Leads::Negated(ir::ExprId value) {
  ir::ExprBuilder make(module_);
  if (module_.exprs[value].op != ir::ExprOp::kLiteral)
    return make.Unary(ir::ExprOp::kNegate, make.Unary(ir::ExprOp::kGroup, value));
  ir::Expr literal = module_.exprs[value];
  literal.number = -literal.number;
  return module_.AddExpr(literal, {});
}

/// One word stands for both ways of change: its K has the sign.
void Leads::NameDecreasing() {
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId id : module_.programs[program].blocks) {
      for (const WordId word_id : module_.blocks[id].words) {
        Word& word = module_.words[word_id];
        if (word.op == WordOp::kMotion && word.index == static_cast<std::uint8_t>(ir::Motion::kThreadDecreasing))
          word.index = static_cast<std::uint8_t>(ir::Motion::kThreadIncreasing);
      }
    }
  }
}

bool Leads::Run() {
  bool any = false;
  for (const ProgramId program : module_.programs.Ids()) {
    for (const BlockId id : module_.programs[program].blocks) any = (uses_[id] = UseOf(program, id)).thread || any;
  }
  if (!any) return true;
  ir::analysis::ForwardFlow<Leads> flow(analyses_.Sources(), *this);
  flow.Run();
  bool ok = true;
  for (const auto& [id, use] : uses_) {
    const ir::Block block = module_.blocks[id];
    const Feed* feed = flow.Before(id);
    if (use.relies && feed != nullptr && feed->lost && CanName(use, *feed)) {
      Name(id, feed->literal);
    } else if (use.relies && feed != nullptr && feed->lost) {
      ok = false;
      sink_
          .Report(diag::Code::kNotExpressible, module_.RangeOf(block), "a feed that was written before a thread",
                  input_.profile->name)
          .help = "the lead of a thread is its F there: write F again behind the thread";
    }
    if (!use.thread) continue;
    bool changes = false;
    for (const WordId word_id : block.words) {
      Word& word = module_.words[word_id];
      if (use.variable && word.op == WordOp::kFeed) {
        changes = true;
        word.op = WordOp::kCenter;
        word.index = 2;
        word.mode = ir::ValueMode::kStep;
        word.phase = ir::DefaultPhaseOf(WordOp::kCenter);
        if (use.decreasing) word.value = Negated(word.value);
        continue;
      }
      if (word.op != WordOp::kCenter) continue;
      word.op = WordOp::kFeed;
      word.index = 0;
      word.mode = ir::ValueMode::kModal;
      word.phase = ir::DefaultPhaseOf(WordOp::kFeed);
    }
    if (use.variable && !changes) {
      ok = false;
      sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block),
                   "a change of the lead that was written in another block", input_.profile->name);
    }
  }
  NameDecreasing();
  return ok;
}

constexpr double kThousandths = 1000;  // of a degree in one

/// A product with 0.001, which is how a source that counts in thousandths says degrees: what it counts. None: no such.
ir::ExprId CountedValue(const Module& module, ir::ExprId id) {
  const ir::Expr& expr = module.exprs[id];
  if (expr.op != ir::ExprOp::kMultiply) return {};
  const auto factor = ir::LiteralValue(module, ir::ExprId{expr.b});
  return factor && *factor == 1 / kThousandths ? ir::ExprId{expr.a} : ir::ExprId{};
}

}  // namespace

bool StartAngles(Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  ir::ExprBuilder make(module);
  bool ok = true;
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      for (const WordId word_id : module.blocks[id].words) {
        Word word = module.words[word_id];
        if (word.op != WordOp::kStartAngle) continue;
        if (const auto degrees = ir::LiteralValue(module, word.value)) {
          const double count = std::round(*degrees * kThousandths);
          if (std::fabs(count - *degrees * kThousandths) > 1e-6) {
            ok = false;
            sink.Report(diag::Code::kWordTooCoarse, module.RangeOf(module.blocks[id], word),
                        fmt::format("{:g}", *degrees), "3");
            continue;
          }
          word.value = make.Literal(count, ir::Type::kInt);
        } else if (const ir::ExprId counted = CountedValue(module, word.value); counted.Valid()) {
          word.value = counted;
        } else {
          word.value = make.Binary(ir::ExprOp::kMultiply, word.value, make.Literal(kThousandths));
        }
        module.words[word_id] = word;
      }
    }
  }
  return ok;
}

bool ThreadLeads(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  return Leads(input, out.module, sink).Run();
}

}  // namespace ncport::backends::fanuc
