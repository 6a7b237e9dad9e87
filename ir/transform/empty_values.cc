#include "ir/transform/empty_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ir/analysis/forward_flow.h"
#include "ir/builder.h"
#include "ir/transform/index_range.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::ir::transform {

namespace {

// What a cell may hold on arrival, as bits; no bit = no way leads here.
constexpr std::uint8_t kEmpty = 1, kNumber = 2, kUnsure = kEmpty | kNumber;
constexpr std::uint8_t kFromEntry = 4;    // nobody here has written it yet
using State = std::vector<std::uint8_t>;  // per cell

/// At most this many words of one block may be there or not by themselves: each doubles its text.
constexpr std::size_t kMostUnsureWords = 3;

class Pass {
 public:
  Pass(Module& module, const Machine& machine, const EmptyValuesConfig& config, diag::Sink& sink)
      : module_(module),
        config_(config),
        sink_(sink),
        make_(module),
        graphs_(module),
        calls_(module),
        flow_({module, machine, graphs_, calls_, nullptr}, *this) {}

  EmptyValuesResult Run();

  // The data flow.
  using State = transform::State;
  State Entry(ProgramId program);
  [[nodiscard]] State Unknown(ProgramId) const { return State(cells_.size(), kUnsure | kFromEntry); }
  static bool Join(BlockId, State& into, const State& from);
  void Transfer(ProgramId program, BlockId block, State& state) const;
  [[nodiscard]] std::optional<State> Into(const analysis::CallSite& site, analysis::CallMoment moment,
                                          const State& at) const;
  [[nodiscard]] State Back(const analysis::CallSite& site, const State& at, const State& exit) const;
  bool Along(ProgramId program, BlockId block, const analysis::Edge& edge, State& state) const;

 private:
  void FindCells();
  void FindWrites();
  /// A block that asks whether a cell is empty: on the ways out of it that is known.
  struct Test {
    std::optional<std::size_t> cell;
    bool empty = false;  // it asks whether the cell is empty, not whether it holds a number
    analysis::EdgeKind holds = analysis::EdgeKind::kNext, fails = analysis::EdgeKind::kNext;
  };
  [[nodiscard]] Test TestOf(BlockId block) const;
  void ThroughAssign(const Word& word, State& state) const;
  void ThroughWord(ProgramId program, BlockId block, WordId id, State& state) const;
  [[nodiscard]] std::uint8_t ClassOf(ExprId id, const State& state) const;
  [[nodiscard]] std::optional<std::size_t> IndexOf(ExprId id) const;
  /// Calls `visit` for every cell that `#[e]` may reach; false when those are not known.
  template <class Visit>
  bool Reached(const Expr& expr, Visit visit) const {
    const auto range = IndexRangeOf(module_, ExprId{std::size_t{expr.a}});
    if (!range) return false;
    for (std::uint32_t cell = range->first; cell <= range->last; ++cell) {
      bool known = false;
      for (const SpaceId space : module_.spaces.Ids()) {
        const auto found = index_.find({space.value, cell});
        if (found == index_.end()) continue;
        visit(found->second);
        known = true;
      }
      if (!known) return false;
    }
    return true;
  }
  [[nodiscard]] bool IsTracked(SpaceId space) const {
    const Space& record = module_.spaces[space];
    return record.type == Type::kNumber && record.start == StartValue::kVacant;
  }
  [[nodiscard]] bool IsLocal(std::size_t index) const { return local_[index] != 0; }

  // What needs a truth value beside it.
  void FindGiven();
  bool NoteSensitive(BlockId block, ExprId id, const State& state);
  bool NoteGiven(ExprId id);
  void VisitComparisons(BlockId block, ExprId root, const State& state);
  void VisitAll(BlockId block, const Word& word, const State& state);

  // The text.
  void Rewrite(ProgramId program);
  void RewriteBlock(ProgramId program, BlockId id, ProgramEditor& editor);
  void NoteReads(ProgramId program, const Word& word, const State& state);
  ExprId Explicit(ExprId root, const State& state);
  ExprId Comparison(ExprId id, const State& state);
  void RewriteCall(CallId id, const State& state);
  void Variants(BlockId id, ProgramEditor& editor, const std::vector<Word>& words, const State& state);
  ExprId GivenCell(std::uint32_t cell) { return make_.Cell(given_space_, cell); }
  ExprId Given(ExprId id, const State& state);
  ExprId Truth(bool value) { return make_.Literal(value ? 1 : 0, Type::kBool); }
  [[nodiscard]] ExprId Bare(ExprId id) const;

  Module& module_;
  const EmptyValuesConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowGraphs graphs_;
  analysis::CallGraph calls_;
  EmptyValuesResult result_;

  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> index_;  // space, cell
  std::vector<std::pair<SpaceId, std::uint32_t>> cells_;
  std::vector<std::uint8_t> local_;
  std::vector<std::set<std::size_t>> writes_;  // per program, below it too; locals of other levels are not among them
  analysis::ForwardFlow<Pass> flow_;
  SpaceId local_space_, given_space_;
  std::set<std::uint32_t> given_;       // local cells
  std::set<std::uint32_t> asked_;       // cells that a program compares with an empty value
  std::set<std::uint32_t> complained_;  // blocks
  bool changed_ = false;
};

bool Pass::Join(BlockId, State& into, const State& from) {
  bool changed = false;
  for (std::size_t i = 0; i < into.size(); ++i) {
    const auto joined = static_cast<std::uint8_t>(into[i] | from[i]);
    changed = changed || joined != into[i];
    into[i] = joined;
  }
  return changed;
}

/// Brackets, the sign of a word (`X-#1`), and what passes make of a word's value (its unit, its rounding) hide no
/// emptiness; operations that the source wrote do: they have kVacantAsZero.
ExprId Pass::Bare(ExprId id) const {
  while (id.Valid()) {
    const Expr& expr = module_.exprs[id];
    const bool written = (expr.flags & Expr::kVacantAsZero) != 0;
    switch (expr.op) {
      case ExprOp::kGroup:
      case ExprOp::kConvert:
        break;
      case ExprOp::kNegate:
      case ExprOp::kPlus:
        if (written) return id;
        break;
      case ExprOp::kMultiply:
      case ExprOp::kDivide:
        if (written || module_.exprs[ExprId{std::size_t{expr.b}}].op != ExprOp::kLiteral) return id;
        break;
      case ExprOp::kFunction:
        if (written || static_cast<Function>(expr.a) != Function::kRound) return id;
        id = module_.Item(expr.b);
        continue;
      default:
        return id;
    }
    id = ExprId{std::size_t{expr.a}};
  }
  return id;
}

std::optional<std::size_t> Pass::IndexOf(ExprId id) const {
  const ExprId bare = Bare(id);
  if (!bare.Valid()) return std::nullopt;
  const Expr& expr = module_.exprs[bare];
  if (expr.op != ExprOp::kCell) return std::nullopt;
  const auto found = index_.find({expr.a, expr.b});
  return found == index_.end() ? std::nullopt : std::optional(found->second);
}

std::uint8_t Pass::ClassOf(ExprId id, const State& state) const {
  const ExprId bare = Bare(id);
  if (!bare.Valid()) return kEmpty;
  const Expr& expr = module_.exprs[bare];
  if (expr.op == ExprOp::kVacant) return kEmpty;
  if (expr.op == ExprOp::kCellAt) {
    if (!IsTracked(SpaceId{std::size_t{expr.b}})) return kNumber;
    std::uint8_t bits = 0;
    if (!Reached(expr, [&](std::size_t index) { bits = static_cast<std::uint8_t>(bits | (state[index] & kUnsure)); }))
      return kUnsure;
    return bits == 0 ? kUnsure : bits;
  }
  const auto index = IndexOf(bare);
  return index ? static_cast<std::uint8_t>(state[*index] & kUnsure) : kNumber;
}

void Pass::FindCells() {
  for (const ProgramId program : module_.programs.Ids()) {
    RewriteProgram(module_, program, [&](Module& module, ExprId id) {
      const Expr& expr = module.exprs[id];
      if (expr.op == ExprOp::kCell && IsTracked(SpaceId{std::size_t{expr.a}})) index_.try_emplace({expr.a, expr.b}, 0);
      const bool compares = expr.op == ExprOp::kEqual || expr.op == ExprOp::kNotEqual;
      if (compares && (expr.flags & Expr::kVacantDiffers) != 0) {
        const Expr& a = module.exprs[Bare(ExprId{std::size_t{expr.a}})];
        const Expr& b = module.exprs[Bare(ExprId{std::size_t{expr.b}})];
        if (a.op == ExprOp::kCell && b.op == ExprOp::kVacant) asked_.insert(a.b);
        if (b.op == ExprOp::kCell && a.op == ExprOp::kVacant) asked_.insert(b.b);
      }
      if (expr.op != ExprOp::kCellAt) return id;
      const auto range = IndexRangeOf(module, ExprId{std::size_t{expr.a}});
      for (const SpaceId space : module.spaces.Ids()) {
        if (!range || !IsTracked(space)) continue;
        const Space& record = module.spaces[space];
        for (std::uint32_t cell = std::max(range->first, record.first); cell <= std::min(range->last, record.last);
             ++cell)
          index_.try_emplace({space.value, cell}, 0);
      }
      return id;
    });
  }
  for (const SpaceId space : module_.spaces.Ids()) {
    if (IsTracked(space) && module_.spaces[space].visibility == Visibility::kLevel) local_space_ = space;
  }
  for (const Arg& arg : module_.args.All()) {
    if (arg.letter != 0 && local_space_.Valid()) index_.try_emplace({local_space_.value, arg.position}, 0);
  }
  for (auto& [cell, index] : index_) {
    index = cells_.size();
    cells_.emplace_back(SpaceId{std::size_t{cell.first}}, cell.second);
    local_.push_back(module_.spaces[cells_.back().first].visibility == Visibility::kLevel ? 1 : 0);
  }
}

void Pass::FindWrites() {
  writes_.resize(module_.programs.Size());
  for (const ProgramId program : calls_.BottomUp()) {
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId word_id : module_.blocks[block].words) {
        const Word& word = module_.words[word_id];
        if (word.op != WordOp::kAssign) continue;
        const ExprId place = word.Extra<ExprId>();
        if (const auto index = IndexOf(place)) writes_[program.value].insert(*index);
        if (module_.exprs[place].op != ExprOp::kCellAt) continue;
        if (Reached(module_.exprs[place], [&](std::size_t index) { writes_[program.value].insert(index); })) continue;
        for (std::size_t i = 0; i < cells_.size(); ++i) writes_[program.value].insert(i);
      }
    }
  }
  // Through calls, until nothing new comes: programs may call each other in a circle.
  for (bool again = true; again;) {
    again = false;
    for (const analysis::CallSite& site : calls_.AllSites()) {
      if (!site.callee.Valid()) continue;
      const bool shares = !module_.calls[site.call].new_level;
      for (const std::size_t index : writes_[site.callee.value]) {
        if (IsLocal(index) && !shares) continue;
        again = writes_[site.caller.value].insert(index).second || again;
      }
    }
  }
}

State Pass::Entry(ProgramId program) {
  const bool main = module_.programs[program].kind == ProgramKind::kMain;
  State state = Unknown(program);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (IsLocal(i) && main) state[i] = kEmpty;
    const std::uint32_t cell = cells_[i].second;
    if (!IsLocal(i) && config_.holds_number && config_.holds_number(cell)) state[i] = kNumber | kFromEntry;
    if (IsLocal(i) && !main && !asked_.contains(cell) && config_.given && config_.given(program, cell)) {
      state[i] = kNumber | kFromEntry;
      result_.taken_for_given.emplace(program, cell);
    }
  }
  return state;
}

bool Pass::Along(ProgramId, BlockId block, const analysis::Edge& edge, State& state) const {
  const Test test = TestOf(block);
  if (!test.cell || (edge.kind != test.holds && edge.kind != test.fails)) return true;
  const bool empty = test.empty == (edge.kind == test.holds);
  std::uint8_t& bits = state[*test.cell];
  if ((bits & (empty ? kEmpty : kNumber)) == 0) return false;
  bits = static_cast<std::uint8_t>(bits & ~(empty ? kNumber : kEmpty));
  return true;
}

Pass::Test Pass::TestOf(BlockId id) const {
  const Block& block = module_.blocks[id];
  Test test;
  if (block.words.count != 1 || block.skip_level != Block::kNoSkip) return test;
  const Word& word = module_.words[block.words[0]];
  if (word.op == WordOp::kJump) {
    test.holds = analysis::EdgeKind::kJump;
    test.fails = analysis::EdgeKind::kNext;
  } else if (word.op == WordOp::kIf || word.op == WordOp::kWhile) {
    test.holds = analysis::EdgeKind::kNext;
    test.fails = analysis::EdgeKind::kFalse;
  } else {
    return test;
  }
  if (!word.value.Valid()) return test;
  const Expr& condition = module_.exprs[Bare(word.value)];
  if ((condition.op != ExprOp::kEqual && condition.op != ExprOp::kNotEqual) ||
      (condition.flags & Expr::kVacantDiffers) == 0)
    return test;
  const ExprId left = Bare(ExprId{std::size_t{condition.a}}), right = Bare(ExprId{std::size_t{condition.b}});
  if (module_.exprs[right].op == ExprOp::kVacant) test.cell = IndexOf(left);
  if (module_.exprs[left].op == ExprOp::kVacant) test.cell = IndexOf(right);
  test.empty = condition.op == ExprOp::kEqual;
  return test;
}

void Pass::Transfer(ProgramId, BlockId block, State& state) const {
  for (const WordId id : module_.blocks[block].words) ThroughAssign(module_.words[id], state);
}

void Pass::ThroughAssign(const Word& word, State& state) const {
  if (word.op != WordOp::kAssign) return;
  const ExprId place = word.Extra<ExprId>();
  if (const auto index = IndexOf(place)) state[*index] = ClassOf(word.value, state);
  if (module_.exprs[place].op != ExprOp::kCellAt) return;
  // One of them is written, the others stay.
  const std::uint8_t made = ClassOf(word.value, state);
  const bool known = Reached(module_.exprs[place],
                             [&](std::size_t index) { state[index] = static_cast<std::uint8_t>(state[index] | made); });
  for (std::uint8_t& bits : state) bits = known ? bits : static_cast<std::uint8_t>(bits | kUnsure);
}

/// A word once the flow is known: what holds for the words behind it.
void Pass::ThroughWord(ProgramId program, BlockId block, WordId id, State& state) const {
  const Word& word = module_.words[id];
  ThroughAssign(word, state);
  if (word.op != WordOp::kCall) return;
  const auto call = word.Extra<CallId>();
  const ProgramId callee = module_.calls[call].program;
  const State* exit = callee.Valid() ? flow_.Exit(callee) : nullptr;
  if (callee.Valid() && exit == nullptr) return;  // no way back
  state = Back({program, block, id, call, callee}, state, exit != nullptr ? *exit : Unknown(program));
}

std::optional<State> Pass::Into(const analysis::CallSite& site, analysis::CallMoment moment, const State& at) const {
  const Call& call = module_.calls[site.call];
  State entry = at;
  if (!call.new_level) return entry;
  for (std::size_t i = 0; i < entry.size(); ++i) {
    // A modal call takes its locals where it is written, and what its runs left of them.
    if (IsLocal(i)) entry[i] = moment == analysis::CallMoment::kModalRun ? std::uint8_t{0} : kEmpty;
  }
  if (moment == analysis::CallMoment::kModalRun) return entry;
  for (const ArgId id : call.args) {
    const Arg& arg = module_.args[id];
    const auto found = index_.find({local_space_.value, arg.position});
    if (arg.letter != 0 && found != index_.end()) entry[found->second] = ClassOf(arg.value, at);
  }
  return entry;
}

State Pass::Back(const analysis::CallSite& site, const State& at, const State& exit) const {
  const Call& call = module_.calls[site.call];
  if (!site.callee.Valid()) return call.name_expr.Valid() ? exit : at;  // one that is not found has its finding
  State behind = at;
  for (const std::size_t index : writes_[site.callee.value]) {
    if (IsLocal(index) && call.new_level) continue;
    behind[index] = exit[index];
  }
  return behind;
}

// --- truth values beside cells

bool Pass::NoteGiven(ExprId id) {
  const auto index = IndexOf(id);
  if (!index || !IsLocal(*index)) return false;
  changed_ = given_.insert(cells_[*index].second).second || changed_;
  return true;
}

/// An expression whose emptiness matters at this place. False after a finding.
bool Pass::NoteSensitive(BlockId block, ExprId id, const State& state) {
  if (ClassOf(id, state) != kUnsure || NoteGiven(id)) return true;
  result_.ok = false;
  if (!complained_.insert(block.value).second) return false;
  const Expr& expr = module_.exprs[Bare(id)];
  const std::string name =
      expr.op == ExprOp::kCell
          ? fmt::format("{}{}", module_.View(module_.spaces[SpaceId{std::size_t{expr.a}}].name), expr.b)
          : std::string("a variable with a computed number");
  auto& finding = sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[block]),
                               fmt::format("{}, which may be empty here,", name), "a language without empty variables");
  if (expr.op == ExprOp::kCell)
    finding.help = fmt::format("say what it holds before the run in ncport.toml:  [ranges]  \"{}\" = [0, 100]", name);
  return false;
}

void Pass::VisitComparisons(BlockId block, ExprId root, const State& state) {
  RewriteExpr(module_, root, [&](Module& module, ExprId id) {
    const Expr expr = module.exprs[id];
    if ((expr.op != ExprOp::kEqual && expr.op != ExprOp::kNotEqual) || (expr.flags & Expr::kVacantDiffers) == 0)
      return id;
    const ExprId left{std::size_t{expr.a}}, right{std::size_t{expr.b}};
    NoteSensitive(block, left, state);
    NoteSensitive(block, right, state);
    return id;
  });
}

void Pass::VisitAll(BlockId block, const Word& word, const State& state) {
  VisitComparisons(block, word.value, state);
  if ((word.flags & Word::kVanishesVacant) != 0 && word.value.Valid()) NoteSensitive(block, word.value, state);
  const auto flows = [&](std::uint32_t cell, ExprId value) {
    // A truth value that is copied must exist.
    if (given_.contains(cell) && ClassOf(value, state) == kUnsure) NoteSensitive(block, value, state);
  };
  if (word.op == WordOp::kAssign) {
    const auto index = IndexOf(word.Extra<ExprId>());
    if (index && IsLocal(*index)) flows(cells_[*index].second, word.value);
  }
  if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<CallId>().Valid()) {
    for (const ArgId id : module_.calls[word.Extra<CallId>()].args) {
      const Arg arg = module_.args[id];
      VisitComparisons(block, arg.value, state);
      if (arg.letter != 0) flows(arg.position, arg.value);
    }
  }
}

void Pass::FindGiven() {
  do {
    changed_ = false;
    for (const ProgramId program : module_.programs.Ids()) {
      for (const BlockId block : module_.programs[program].blocks) {
        const State* before = flow_.Before(block);
        if (before == nullptr) continue;
        State state = *before;
        for (const WordId word_id : module_.blocks[block].words) {
          const Word word = module_.words[word_id];
          VisitAll(block, word, state);
          ThroughWord(program, block, word_id, state);
        }
      }
    }
  } while (changed_);
}

// --- the text

/// Whether `id` holds a number, as a condition.
ExprId Pass::Given(ExprId id, const State& state) {
  const std::uint8_t bits = ClassOf(id, state);
  if (bits != kUnsure) return Truth(bits == kNumber);
  return GivenCell(cells_[*IndexOf(id)].second);
}

ExprId Pass::Comparison(ExprId id, const State& state) {
  Expr expr = module_.exprs[id];
  const ExprId left{std::size_t{expr.a}}, right{std::size_t{expr.b}};
  const std::uint8_t a = ClassOf(left, state), b = ClassOf(right, state);
  const bool equal = expr.op == ExprOp::kEqual;
  expr.flags = static_cast<std::uint8_t>(expr.flags & ~Expr::kVacantDiffers);
  if (a == 0 || b == 0) return module_.AddExpr(expr);  // no run gets here
  if (a == kNumber && b == kNumber) return module_.AddExpr(expr);
  if (a != kUnsure && b != kUnsure) return Truth((a == b) == equal);
  const auto negated = [&](ExprId truth) { return make_.Unary(ExprOp::kNot, truth); };
  // One side is empty for certain: the other must be.
  if (a == kEmpty || b == kEmpty) {
    const ExprId given = Given(a == kEmpty ? right : left, state);
    return equal ? negated(given) : given;
  }
  const ExprId values = make_.Unary(ExprOp::kGroup, module_.AddExpr(expr));
  if (a == kUnsure && b == kUnsure) {
    // Empty ones hold 0, so the values agree where both are empty.
    const ExprId same = make_.Unary(ExprOp::kGroup, make_.Binary(equal ? ExprOp::kEqual : ExprOp::kNotEqual,
                                                                 Given(left, state), Given(right, state)));
    return make_.Unary(ExprOp::kGroup, make_.Binary(equal ? ExprOp::kAnd : ExprOp::kOr, same, values));
  }
  const ExprId given = Given(a == kUnsure ? left : right, state);
  return make_.Unary(ExprOp::kGroup, equal ? make_.Binary(ExprOp::kAnd, given, values)
                                           : make_.Binary(ExprOp::kOr, negated(given), values));
}

ExprId Pass::Explicit(ExprId root, const State& state) {
  return RewriteExpr(module_, root, [&](Module& module, ExprId id) {
    const Expr expr = module.exprs[id];
    const bool compares = expr.op == ExprOp::kEqual || expr.op == ExprOp::kNotEqual;
    if (compares && (expr.flags & Expr::kVacantDiffers) != 0) return Comparison(id, state);
    return id;
  });
}

void Pass::RewriteCall(CallId id, const State& state) {
  Call call = module_.calls[id];
  call.passes = Explicit(call.passes, state);
  std::vector<Arg> args;
  for (const ArgId arg_id : call.args) {
    Arg arg = module_.args[arg_id];
    if (arg.letter == 0) {
      args.push_back(arg);
      continue;
    }
    const std::uint8_t bits = ClassOf(arg.value, state);
    if (bits == kEmpty) continue;  // an empty argument is a missing one
    const ExprId given = given_.contains(arg.position) ? Given(arg.value, state) : ExprId{};
    arg.value = Explicit(arg.value, state);
    args.push_back(arg);
    if (!given.Valid()) continue;
    Arg truth;
    truth.letter = arg.letter;
    truth.position = static_cast<std::uint16_t>(kGivenArgument + arg.position);
    truth.value = given;
    args.push_back(truth);
  }
  call.args = {static_cast<std::uint32_t>(module_.args.Size()), static_cast<std::uint32_t>(args.size())};
  for (const Arg& arg : args) module_.args.Add(arg);
  module_.calls[id] = call;
}

/// The block once for each way in which its unsure words are there or not.
void Pass::Variants(BlockId id, ProgramEditor& editor, const std::vector<Word>& words, const State& state) {
  const auto unsure = std::find_if(words.begin(), words.end(), [&](const Word& word) {
    return (word.flags & Word::kVanishesVacant) != 0 && ClassOf(word.value, state) == kUnsure;
  });
  const auto put = [&](const std::vector<Word>& made_words) {
    Block made = editor.MakeBlock(id);
    editor.SetWords(made, made_words);
    editor.InsertBefore(id, made);
  };
  if (unsure == words.end()) {
    put(words);
    return;
  }
  const std::size_t index = *IndexOf(unsure->value);
  const auto mark = [](WordOp op, ExprId value = {}) {
    Word word;
    word.op = op;
    word.phase = DefaultPhaseOf(op);
    word.value = value;
    return word;
  };
  put({mark(WordOp::kIf, GivenCell(cells_[index].second))});
  for (const bool there : {true, false}) {
    State known = state;
    known[index] = there ? kNumber : kEmpty;
    std::vector<Word> kept;
    for (Word word : words) {
      if ((word.flags & Word::kVanishesVacant) != 0 && word.value.Valid()) {
        const std::uint8_t bits = ClassOf(word.value, known);
        if (bits == kEmpty) continue;
        if (bits == kNumber) word.flags = static_cast<std::uint8_t>(word.flags & ~Word::kVanishesVacant);
      }
      kept.push_back(word);
    }
    if (kept.empty()) continue;  // nothing of the block is there
    if (!there) put({mark(WordOp::kElse)});
    Variants(id, editor, kept, known);
  }
  put({mark(WordOp::kEndIf)});
}

/// Cells that the word reads as they were before the program (locals) or before the run (common cells).
void Pass::NoteReads(ProgramId program, const Word& word, const State& state) {
  const auto common = [&](std::size_t index) {
    if (!IsLocal(index) && (state[index] & kFromEntry) != 0) result_.common_at_entry.insert(cells_[index].second);
  };
  const auto visit_common = [&](ExprId root) {
    VisitReads(module_, root, [&](ExprId read) {
      const Expr& expr = module_.exprs[read];
      if (expr.op == ExprOp::kCellAt && IsTracked(SpaceId{std::size_t{expr.b}})) Reached(expr, common);
      if (const auto index = IndexOf(read)) common(*index);
    });
  };
  VisitReads(module_, word.value, [&](ExprId read) {
    const auto index = IndexOf(read);
    if (index && IsLocal(*index) && (state[*index] & kFromEntry) != 0)
      result_.read_at_entry.emplace(program, cells_[*index].second);
  });
  visit_common(word.value);
  if (word.op == WordOp::kAssign) {
    // The index of a computed place is read, the place is not.
    const Expr& place = module_.exprs[word.Extra<ExprId>()];
    if (place.op == ExprOp::kCellAt) visit_common(ExprId{std::size_t{place.a}});
  }
  if (word.op == WordOp::kJump) visit_common(module_.jumps[word.Extra<JumpId>()].target.expr);
  if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<CallId>().Valid()) {
    const Call& call = module_.calls[word.Extra<CallId>()];
    visit_common(call.passes);
    for (const ArgId arg : call.args) visit_common(module_.args[arg].value);
  }
}

void Pass::RewriteBlock(ProgramId program, BlockId id, ProgramEditor& editor) {
  const State* before = flow_.Before(id);
  const State start = before != nullptr ? *before : State(cells_.size(), kNumber);  // no way here: does not matter
  State state = start;
  const Block block = module_.blocks[id];
  std::vector<Word> words;
  std::set<std::size_t> unsure;
  for (const WordId word_id : block.words) {
    Word word = module_.words[word_id];
    if (before != nullptr) NoteReads(program, word, state);
    const State here = state;
    ThroughWord(program, id, word_id, state);
    if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<CallId>().Valid()) {
      RewriteCall(word.Extra<CallId>(), here);
      words.push_back(word);
      continue;
    }
    if (word.op == WordOp::kJump) {
      Jump jump = module_.jumps[word.Extra<JumpId>()];
      jump.target.expr = Explicit(jump.target.expr, here);
      module_.jumps[word.Extra<JumpId>()] = jump;
    }
    const std::uint8_t bits = word.value.Valid() ? ClassOf(word.value, here) : kNumber;
    if ((word.flags & Word::kVanishesVacant) != 0) {
      if (bits == kEmpty) continue;
      if (bits == kUnsure) {
        unsure.insert(*IndexOf(word.value));
      } else {
        word.flags = static_cast<std::uint8_t>(word.flags & ~Word::kVanishesVacant);
      }
    }
    const ExprId given = word.op == WordOp::kAssign && bits == kUnsure && IndexOf(word.value) &&
                                 given_.contains(cells_[*IndexOf(word.value)].second)
                             ? Given(word.value, here)
                             : ExprId{};
    word.value = Explicit(word.value, here);
    words.push_back(word);
    if (word.op != WordOp::kAssign) continue;
    const auto place = IndexOf(word.Extra<ExprId>());
    if (!place || !IsLocal(*place) || !given_.contains(cells_[*place].second)) continue;
    Word truth;
    truth.op = WordOp::kAssign;
    truth.phase = DefaultPhaseOf(WordOp::kAssign);
    truth.extra = GivenCell(cells_[*place].second).value;
    truth.value = given.Valid() ? given : Truth(bits != kEmpty);
    words.push_back(truth);
  }
  if (unsure.empty()) {
    Block changed = block;
    editor.SetWords(changed, words);
    module_.blocks[id].words = changed.words;
    if (words.empty() && !block.words.Empty()) editor.Remove(id);  // nothing of it was there
    return;
  }
  if (unsure.size() > kMostUnsureWords || block.skip_level != Block::kNoSkip) {
    result_.ok = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(block),
                 block.skip_level != Block::kNoSkip ? "a skipped block with words that may be empty"
                                                    : "a block with more than three words that may be empty",
                 "a language without empty variables");
    return;
  }
  if (block.label.Valid() || block.number != Block::kNoNumber || !block.comments.Empty()) {
    Block place = editor.MakeBlock(id);
    place.number = block.number;
    place.number_digits = block.number_digits;
    place.label = block.label;
    place.comments = block.comments;
    editor.InsertBefore(id, place);
  }
  Variants(id, editor, words, start);
  module_.blocks[id].comments = {};
  module_.blocks[id].label = {};
  module_.blocks[id].number = Block::kNoNumber;
  editor.Remove(id);
}

void Pass::Rewrite(ProgramId program) {
  ProgramEditor editor(module_, program, "empty_values");
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  const analysis::Cfg& cfg = graphs_.Of(program);
  if (module_.programs[program].kind == ProgramKind::kMain) {
    std::optional<State> end;
    for (const BlockId block : blocks) {
      const State* before = flow_.Before(block);
      if (before == nullptr) continue;
      for (const analysis::Edge& edge : cfg.Successors(block)) {
        if (edge.kind != analysis::EdgeKind::kEnd) continue;
        State state = *before;
        Transfer(program, block, state);
        if (!end) end = State(cells_.size(), 0);
        Join({}, *end, state);
      }
    }
    for (std::size_t i = 0; end && i < cells_.size(); ++i) {
      if (!IsLocal(i) && ((*end)[i] & kFromEntry) == 0) result_.written_at_end.insert(cells_[i].second);
    }
  }
  for (const BlockId block : blocks) RewriteBlock(program, block, editor);
  editor.Apply();
  // Everything else reads 0 where it reads an empty value.
  RewriteProgram(module_, program, [&](Module& module, ExprId id) {
    return module.exprs[id].op == ExprOp::kVacant ? make_.Literal(0) : id;
  });
}

EmptyValuesResult Pass::Run() {
  FindCells();
  FindWrites();
  flow_.Run();
  FindGiven();
  if (!result_.ok) return std::move(result_);
  if (!given_.empty()) {
    const Space locals = module_.spaces[local_space_];
    given_space_ = AddSpace(module_, kGivenSpace, locals.first, locals.last, Type::kBool, StartValue::kZero);
    module_.spaces[given_space_].lifetime = locals.lifetime;
    module_.spaces[given_space_].visibility = locals.visibility;
  }
  for (const ProgramId program : module_.programs.Ids()) Rewrite(program);
  return std::move(result_);
}

}  // namespace

EmptyValuesResult EmptyValues(Module& module, const Machine& source, const EmptyValuesConfig& config,
                              diag::Sink& sink) {
  return Pass(module, source, config, sink).Run();
}

}  // namespace ncport::ir::transform
