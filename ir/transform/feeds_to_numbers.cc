#include "ir/transform/feeds_to_numbers.h"

#include <optional>

#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/transform/word_exprs.h"
#include "ir/word_values.h"

namespace ncport::ir::transform {

namespace {

class Feeds {
 public:
  struct State {
    std::optional<double> feed;  // none: not one number on all ways
    VariableId copy;             // a variable that holds a feed
    double copied = 0;
    bool operator==(const State&) const = default;
  };

  explicit Feeds(const Module& module) : module_(module) {}

  [[nodiscard]] State Entry(ProgramId) const { return {}; }
  [[nodiscard]] State Unknown(ProgramId) const { return {}; }
  bool Join(BlockId, State& into, const State& from) const {
    const State before = into;
    if (into.feed != from.feed) into.feed.reset();
    if (into.copy != from.copy || into.copied != from.copied) {
      into.copy = {};
      into.copied = 0;
    }
    return !(into == before);
  }
  void Transfer(ProgramId, BlockId id, State& state) const {
    const State in = state;
    std::optional<double> named;
    bool names = false;
    for (const WordId word_id : module_.blocks[id].words) {
      const Word& word = module_.words[word_id];
      // A feed of another kind or unit is another number.
      if (word.op == WordOp::kFeedMode || word.op == WordOp::kComputedG || word.op == WordOp::kVerbatim)
        state.feed.reset();
      if (word.op == WordOp::kFeed) {
        names = true;
        named = ValueOf(word.value, in);
      }
      const auto loses = [&](ExprId place) {
        const Expr& written = module_.exprs[place];
        if ((written.op != ExprOp::kVariable && written.op != ExprOp::kElement) || written.a != state.copy.value)
          return;
        state.copy = {};
        state.copied = 0;
      };
      VisitPlaces(module_, word, loses);
      VisitReferences(module_, word, loses);
      if (word.op != WordOp::kAssign || !IsActiveFeed(word.value) || !in.feed) continue;
      const Expr& place = module_.exprs[word.Extra<ExprId>()];
      if (place.op != ExprOp::kVariable || module_.variables[VariableId{std::size_t{place.a}}].type != Type::kReal)
        continue;
      state.copy = VariableId{std::size_t{place.a}};
      state.copied = *in.feed;
    }
    if (names) state.feed = named;
  }

  [[nodiscard]] bool IsActiveFeed(ExprId id) const {
    const Expr& expr = module_.exprs[Bare(id)];
    return expr.op == ExprOp::kSystem && module_.systems[SystemId{std::size_t{expr.a}}].kind == SystemKind::kActiveFeed;
  }

 private:
  [[nodiscard]] ExprId Bare(ExprId id) const {
    while (module_.exprs[id].op == ExprOp::kGroup ||
           (module_.exprs[id].op == ExprOp::kConvert && module_.exprs[id].type == Type::kReal))
      id = ExprId{std::size_t{module_.exprs[id].a}};
    return id;
  }
  [[nodiscard]] std::optional<double> ValueOf(ExprId id, const State& state) const {
    const Expr& expr = module_.exprs[Bare(id)];
    if (expr.op == ExprOp::kLiteral) return expr.number;
    if (expr.op == ExprOp::kVariable && state.copy.Valid() && expr.a == state.copy.value) return state.copied;
    return std::nullopt;
  }

  const Module& module_;
};

}  // namespace

void FeedsToNumbers(Module& module, const Machine& source, const ModalState& sub_entry) {
  bool any = false, inch = source.start.units == Units::kInch;
  for (const System& system : module.systems.All()) any = any || system.kind == SystemKind::kActiveFeed;
  for (const Word& word : module.words.All())
    inch = inch || (word.op == WordOp::kUnits && static_cast<Units>(word.index) == Units::kInch);
  if (!any || inch) return;  // in inches the number depends on the unit that is in force where it is read
  Feeds client(module);
  const analysis::FlowAnalyses analyses(module, source, {source.start, sub_entry});
  analysis::ForwardFlow<Feeds> flow(analyses.Sources(), client);
  flow.Run();
  ExprBuilder make(module);
  for (const ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Feeds::State* at = flow.Before(id);
      if (at == nullptr || !at->feed || module.blocks[id].words.count != 1) continue;
      Word& word = module.words[module.blocks[id].words[0]];
      if (word.op == WordOp::kAssign && client.IsActiveFeed(word.value)) word.value = make.Literal(*at->feed);
    }
  }
}

}  // namespace ncport::ir::transform
