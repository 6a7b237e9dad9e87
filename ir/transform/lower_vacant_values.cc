#include "ir/transform/lower_vacant_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/cfg.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::ir::transform {

namespace {

using State = analysis::Vacancy::State;
constexpr std::uint8_t kEmpty = analysis::Vacancy::kEmpty, kNumber = analysis::Vacancy::kNumber;
constexpr std::uint8_t kUnsure = analysis::Vacancy::kUnsure, kFromEntry = analysis::Vacancy::kFromEntry;

/// At most this many words of one block may be there or not by themselves: each doubles its text.
constexpr std::size_t kMostUnsureWords = 3;

class Pass {
 public:
  Pass(Module& module, const Machine& machine, const analysis::VacancyConfig& config, diag::Sink& sink)
      : module_(module),
        sink_(sink),
        make_(module),
        graphs_(module),
        calls_(module),
        vacancy_(module, machine, graphs_, calls_, config) {}

  VacantValuesResult Run();

 private:
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
  [[nodiscard]] std::uint8_t ClassOf(ExprId id, const State& state) const { return vacancy_.ClassOf(id, state); }
  [[nodiscard]] std::optional<std::size_t> IndexOf(ExprId id) const { return vacancy_.IndexOf(id); }

  Module& module_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowGraphs graphs_;
  analysis::CallGraph calls_;
  analysis::Vacancy vacancy_;
  VacantValuesResult result_;
  SpaceId given_space_;
  std::set<std::uint32_t> given_;       // local cells
  std::set<std::uint32_t> complained_;  // blocks
  bool changed_ = false;
};

// --- truth values beside cells

bool Pass::NoteGiven(ExprId id) {
  const auto index = IndexOf(id);
  if (!index || !vacancy_.IsLocal(*index)) return false;
  changed_ = given_.insert(vacancy_.CellOf(*index)).second || changed_;
  return true;
}

/// An expression whose emptiness matters at this place. False after a finding.
bool Pass::NoteSensitive(BlockId block, ExprId id, const State& state) {
  if (ClassOf(id, state) != kUnsure || NoteGiven(id)) return true;
  result_.ok = false;
  if (!complained_.insert(block.value).second) return false;
  const Expr& expr = module_.exprs[vacancy_.Bare(id)];
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
    if (index && vacancy_.IsLocal(*index)) flows(vacancy_.CellOf(*index), word.value);
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
        const State* before = vacancy_.Before(block);
        if (before == nullptr) continue;
        State state = *before;
        for (const WordId word_id : module_.blocks[block].words) {
          const Word word = module_.words[word_id];
          VisitAll(block, word, state);
          vacancy_.ThroughWord(program, block, word_id, state);
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
  return GivenCell(vacancy_.CellOf(*IndexOf(id)));
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
  const auto put = [&](const std::vector<Word>& made_words) { editor.PutInFront(id, made_words); };
  if (unsure == words.end()) {
    put(words);
    return;
  }
  const std::size_t index = *IndexOf(unsure->value);
  const auto mark = [](WordOp op, ExprId value = {}) { return MakeWord(op, 0, value); };
  put({mark(WordOp::kIf, GivenCell(vacancy_.CellOf(index)))});
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
    if (!vacancy_.IsLocal(index) && (state[index] & kFromEntry) != 0)
      result_.common_at_entry.insert(vacancy_.CellOf(index));
  };
  const auto visit_common = [&](ExprId root) {
    VisitReads(module_, root, [&](ExprId read) {
      const Expr& expr = module_.exprs[read];
      if (expr.op == ExprOp::kCellAt && vacancy_.IsTracked(SpaceId{std::size_t{expr.b}}))
        vacancy_.Reached(expr, common);
      if (const auto index = IndexOf(read)) common(*index);
    });
  };
  VisitReads(module_, word.value, [&](ExprId read) {
    const auto index = IndexOf(read);
    if (index && vacancy_.IsLocal(*index) && (state[*index] & kFromEntry) != 0)
      result_.read_at_entry.emplace(program, vacancy_.CellOf(*index));
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
  const State* before = vacancy_.Before(id);
  const State start = before != nullptr ? *before : State(vacancy_.Size(), kNumber);  // no way here: does not matter
  State state = start;
  const Block block = module_.blocks[id];
  std::vector<Word> words;
  std::set<std::size_t> unsure;
  for (const WordId word_id : block.words) {
    Word word = module_.words[word_id];
    if (before != nullptr) NoteReads(program, word, state);
    const State here = state;
    vacancy_.ThroughWord(program, id, word_id, state);
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
                                 given_.contains(vacancy_.CellOf(*IndexOf(word.value)))
                             ? Given(word.value, here)
                             : ExprId{};
    word.value = Explicit(word.value, here);
    words.push_back(word);
    if (word.op != WordOp::kAssign) continue;
    const auto place = IndexOf(word.Extra<ExprId>());
    if (!place || !vacancy_.IsLocal(*place) || !given_.contains(vacancy_.CellOf(*place))) continue;
    const ExprId truth = GivenCell(vacancy_.CellOf(*place));
    words.push_back(MakeAssignment(truth, given.Valid() ? given : Truth(bits != kEmpty)));
  }
  if (unsure.empty()) {
    editor.SetWords(id, words);
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
  // A structure mark, with which the variants begin, carries no head.
  if (block.label.Valid() || block.number != Block::kNoNumber || !block.comments.Empty())
    editor.PutInFront(id, {}, {.comments = true});
  Variants(id, editor, words, start);
  editor.Remove(id);
}

void Pass::Rewrite(ProgramId program) {
  ProgramEditor editor(module_, program, "lower_vacant_values");
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  const analysis::Cfg& cfg = graphs_.Of(program);
  if (module_.programs[program].kind == ProgramKind::kMain) {
    std::optional<State> end;
    for (const BlockId block : blocks) {
      const State* before = vacancy_.Before(block);
      if (before == nullptr) continue;
      for (const analysis::Edge& edge : cfg.Successors(block)) {
        if (edge.kind != analysis::EdgeKind::kEnd) continue;
        State state = *before;
        vacancy_.Transfer(program, block, state);
        if (!end) end = State(vacancy_.Size(), 0);
        analysis::Vacancy::Join({}, *end, state);
      }
    }
    for (std::size_t i = 0; end && i < vacancy_.Size(); ++i) {
      if (!vacancy_.IsLocal(i) && ((*end)[i] & kFromEntry) == 0) result_.written_at_end.insert(vacancy_.CellOf(i));
    }
  }
  for (const BlockId block : blocks) RewriteBlock(program, block, editor);
  editor.Apply();
  // Everything else reads 0 where it reads an empty value.
  RewriteProgram(module_, program, [&](Module& module, ExprId id) {
    return module.exprs[id].op == ExprOp::kVacant ? make_.Literal(0) : id;
  });
}

VacantValuesResult Pass::Run() {
  result_.taken_for_given = vacancy_.TakenForGiven();
  FindGiven();
  if (!result_.ok) return std::move(result_);
  if (!given_.empty()) {
    const Space locals = module_.spaces[vacancy_.LocalSpace()];
    given_space_ = AddSpace(module_, kGivenSpace, locals.first, locals.last, Type::kBool, StartValue::kZero);
    module_.spaces[given_space_].lifetime = locals.lifetime;
    module_.spaces[given_space_].visibility = locals.visibility;
  }
  for (const ProgramId program : module_.programs.Ids()) Rewrite(program);
  return std::move(result_);
}

}  // namespace

VacantValuesResult LowerVacantValues(Module& module, const Machine& source, const analysis::VacancyConfig& config,
                                     diag::Sink& sink) {
  return Pass(module, source, config, sink).Run();
}

}  // namespace ncport::ir::transform
