#include "ir/transform/numbers_to_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/index_range.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/transform/lower_vacant_values.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"
#include "ir/transform/rewrite_exprs.h"

namespace ncport::ir::transform {

namespace {

/// A local: its cell, kGivenArgument higher for the truth value beside it.
using Key = std::uint32_t;

class Naming {
 public:
  Naming(Module& module, const NumbersToNamesConfig& config, diag::Sink& sink)
      : module_(module), config_(config), sink_(sink), make_(module) {}

  NumbersToNamesResult Run();

 private:
  void FindSpaces();
  void FindUses();
  /// Cells of one space that an index reaches: they move together.
  struct Block {
    std::uint32_t space = 0, first = 0, last = 0;
  };
  [[nodiscard]] std::optional<Block> CellsOf(const Expr& expr) const;
  void JoinBlocks();
  void PlaceCommon();
  void NameProgram(ProgramId program);
  VariableId NewVariable(ProgramId program, Key key, Scope scope, bool by_reference);
  void LowerCalls(ProgramId program);
  void ShareArguments(ProgramId program, BlockId block, Call& call, ProgramEditor& editor);
  void Replace(ProgramId program);
  void Define(ProgramId program);
  [[nodiscard]] std::string NameOf(Key key) const;
  [[nodiscard]] std::optional<Key> KeyOf(const Expr& expr) const;
  void Refuse(BlockId block, std::string_view what) {
    result_.ok = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[block]), what,
                 "a language with named variables");
  }

  Module& module_;
  const NumbersToNamesConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  NumbersToNamesResult result_;
  SpaceId locals_, given_, target_;
  std::set<std::uint32_t> common_spaces_;
  std::vector<Block> blocks_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> common_;  // space, cell -> cell of the target
  std::vector<std::set<Key>> used_;                                          // per program, what it shares included
  std::vector<std::set<Key>> passed_;                                        // by the letters of any call
  std::vector<std::uint8_t> shared_, valued_;  // called with shared locals, with arguments
  std::vector<std::vector<Key>> parameters_;   // in order
  std::vector<std::map<Key, VariableId>> names_;
};

void Naming::FindSpaces() {
  for (const SpaceId id : module_.spaces.Ids()) {
    const Space& space = module_.spaces[id];
    if (module_.View(space.name) == kGivenSpace) {
      given_ = id;
    } else if (space.visibility == Visibility::kLevel) {
      locals_ = id;
    } else {
      common_spaces_.insert(id.value);
    }
  }
}

std::optional<Key> Naming::KeyOf(const Expr& expr) const {
  if (expr.op != ExprOp::kCell) return std::nullopt;
  if (expr.a == locals_.value) return expr.b;
  if (given_.Valid() && expr.a == given_.value) return kGivenArgument + expr.b;
  return std::nullopt;
}

std::string Naming::NameOf(Key key) const {
  const bool truth = key >= kGivenArgument;
  const std::uint32_t cell = truth ? key - kGivenArgument : key;
  const char letter = config_.letter_of ? config_.letter_of(cell) : '\0';
  const std::string name = letter != 0 ? std::string(1, letter) : fmt::format("{}", cell);
  return config_.prefix + name + (truth ? "_GIVEN" : "");
}

void Naming::FindUses() {
  const std::size_t count = module_.programs.Size();
  used_.resize(count);
  passed_.resize(count);
  shared_.resize(count);
  valued_.resize(count);
  parameters_.resize(count);
  names_.resize(count);
  std::map<std::uint32_t, std::set<std::uint32_t>> common;
  for (const ProgramId program : module_.programs.Ids()) {
    RewriteProgram(module_, program, [&](Module& module, ExprId id) {
      const Expr& expr = module.exprs[id];
      if (const auto key = KeyOf(expr)) used_[program.value].insert(*key);
      if (expr.op == ExprOp::kCell && common_spaces_.contains(expr.a)) common[expr.a].insert(expr.b);
      return id;
    });
    for (const BlockId block : module_.programs[program].blocks) {
      for (const WordId word_id : module_.blocks[block].words) {
        const Word& word = module_.words[word_id];
        bool open = false;
        const auto look = [&](ExprId root) {
          RewriteExpr(module_, root, [&](Module& module, ExprId id) {
            const Expr& expr = module.exprs[id];
            if (expr.op != ExprOp::kCellAt || expr.b == target_.value) return id;
            const std::optional<Block> block_of_cells = CellsOf(expr);
            open = open || !block_of_cells;
            if (block_of_cells) blocks_.push_back(*block_of_cells);
            return id;
          });
        };
        look(word.value);
        if (word.op == WordOp::kAssign) look(word.Extra<ExprId>());
        if ((word.op == WordOp::kCall || word.op == WordOp::kModalCall) && word.Extra<CallId>().Valid()) {
          for (const ArgId arg : module_.calls[word.Extra<CallId>()].args) look(module_.args[arg].value);
        }
        if (open) Refuse(block, "a variable whose computed number is not bounded");
      }
    }
  }
  for (const auto& [space, cells] : common) {
    for (const std::uint32_t cell : cells) common_[{space, cell}] = 0;
  }
  JoinBlocks();
  const analysis::CallGraph calls(module_);
  for (const analysis::CallSite& site : calls.AllSites()) {
    if (!site.callee.Valid()) continue;
    const Call& call = module_.calls[site.call];
    (call.new_level ? valued_ : shared_)[site.callee.value] = 1;
    if (!call.new_level) continue;
    for (const ArgId arg : call.args) passed_[site.callee.value].insert(module_.args[arg].position);
  }
  for (bool again = true; again;) {
    again = false;
    for (const analysis::CallSite& site : calls.AllSites()) {
      if (!site.callee.Valid() || module_.calls[site.call].new_level) continue;
      for (const Key key : used_[site.callee.value]) again = used_[site.caller.value].insert(key).second || again;
    }
  }
}

std::optional<Naming::Block> Naming::CellsOf(const Expr& expr) const {
  const auto range = analysis::IndexRangeOf(module_, ExprId{std::size_t{expr.a}});
  if (!range) return std::nullopt;
  for (const std::uint32_t space : common_spaces_) {
    const Space& record = module_.spaces[SpaceId{std::size_t{space}}];
    if (range->first >= record.first && range->last <= record.last) return Block{space, range->first, range->last};
  }
  return std::nullopt;  // locals, or more than one space
}

/// Blocks that share cells become one; every cell of a block has a place.
void Naming::JoinBlocks() {
  std::sort(blocks_.begin(), blocks_.end(),
            [](const Block& a, const Block& b) { return a.space != b.space ? a.space < b.space : a.first < b.first; });
  std::vector<Block> joined;
  for (const Block& block : blocks_) {
    if (!joined.empty() && joined.back().space == block.space && block.first <= joined.back().last) {
      joined.back().last = std::max(joined.back().last, block.last);
    } else {
      joined.push_back(block);
    }
  }
  blocks_ = std::move(joined);
  for (const Block& block : blocks_) {
    for (std::uint32_t cell = block.first; cell <= block.last; ++cell) common_[{block.space, cell}] = 0;
  }
}

/// Common cells keep their distance where that is possible, so that the map stays as it is when the source changes.
void Naming::PlaceCommon() {
  target_ = AddSpace(module_, config_.space, config_.cells.first, config_.cells.last);
  std::set<std::uint32_t> taken;
  std::set<std::pair<std::uint32_t, std::uint32_t>> placed;
  const auto place = [&](std::pair<std::uint32_t, std::uint32_t> cell, std::uint32_t to) {
    common_[cell] = to;
    taken.insert(to);
    placed.insert(cell);
  };
  for (const auto& [cell, unused] : common_) {
    for (const NumbersToNamesConfig::Pin& pin : config_.pins) {
      if (pin.source == cell.second) place(cell, pin.target);
    }
  }
  for (const auto& [cell, unused] : common_) {
    if (placed.contains(cell) || cell.second < config_.first_in_step) continue;
    const std::uint32_t wish = config_.cells.first + cell.second - config_.first_in_step;
    if (wish <= config_.cells.last && !taken.contains(wish)) place(cell, wish);
  }
  std::uint32_t next = config_.cells.last;
  // Blocks that did not keep their distance: together, from the end down.
  for (const Block& block : blocks_) {
    const auto in_step = [&] {
      const std::uint32_t start = common_.at({block.space, block.first});
      for (std::uint32_t cell = block.first; cell <= block.last; ++cell) {
        const std::pair<std::uint32_t, std::uint32_t> key{block.space, cell};
        if (!placed.contains(key) || common_.at(key) != start + cell - block.first) return false;
      }
      return true;
    };
    if (in_step()) continue;
    const std::uint32_t count = block.last - block.first + 1;
    const auto is_free = [&](std::uint32_t start) {
      for (std::uint32_t i = 0; i < count; ++i) {
        if (taken.contains(start + i)) return false;
      }
      return true;
    };
    bool any = false, done = false;
    for (std::uint32_t cell = block.first; cell <= block.last; ++cell)
      any = any || placed.contains({block.space, cell});
    for (std::uint32_t start = config_.cells.last + 1; !any && !done && start-- > config_.cells.first;) {
      if (start + count > config_.cells.last + 1 || !is_free(start)) continue;
      for (std::uint32_t i = 0; i < count; ++i) place({block.space, block.first + i}, start + i);
      done = true;
    }
    if (done) continue;
    result_.ok = false;
    sink_.Report(
        diag::Code::kNotExpressible, SourceRange{},
        fmt::format("a range of {} variables with computed numbers from {} on", count, block.first),
        fmt::format("the cells {}{} to {}{}", config_.space, config_.cells.first, config_.space, config_.cells.last));
    return;
  }
  for (const auto& [cell, unused] : common_) {
    if (placed.contains(cell)) continue;
    while (next > config_.cells.first && taken.contains(next)) --next;
    if (taken.contains(next)) {
      result_.ok = false;
      sink_
          .Report(diag::Code::kNotExpressible, SourceRange{}, fmt::format("{} common variables", common_.size()),
                  fmt::format("{} cells {}{} to {}{}", config_.cells.last - config_.cells.first + 1, config_.space,
                              config_.cells.first, config_.space, config_.cells.last))
          .help = "give the profile a larger range of variables, as the machine has it";
      return;
    }
    place(cell, next);
  }
  for (const auto& [cell, to] : common_) {
    CellMapping mapping;
    mapping.source =
        fmt::format("{}{}", module_.View(module_.spaces[SpaceId{std::size_t{cell.first}}].name), cell.second);
    mapping.target = fmt::format("{}{}", config_.space, to);
    mapping.first = to;
    mapping.common = true;
    mapping.outlives = config_.written_at_end.contains(cell.second);
    mapping.source_space = SpaceId{std::size_t{cell.first}};
    mapping.source_cell = cell.second;
    result_.map.push_back(mapping);
  }
}

VariableId Naming::NewVariable(ProgramId program, Key key, Scope scope, bool by_reference) {
  const VariableId id = NewLocal(module_, program, NameOf(key), key >= kGivenArgument ? Type::kBool : Type::kReal);
  Variable& variable = module_.variables[id];
  variable.scope = scope;
  variable.by_reference = by_reference;
  names_[program.value][key] = id;
  CellMapping mapping;
  mapping.program = program;
  const std::uint32_t cell = key % kGivenArgument;
  mapping.source = fmt::format("#{}{}", cell, key >= kGivenArgument ? " holds a number" : "");
  mapping.target = module_.View(variable.name);
  mapping.variable = id;
  mapping.first = cell;
  if (scope == Scope::kParameter && config_.letter_of) mapping.letter = config_.letter_of(cell);
  result_.map.push_back(mapping);
  return id;
}

void Naming::NameProgram(ProgramId program) {
  std::vector<Key>& order = parameters_[program.value];
  const bool by_reference = shared_[program.value] != 0;
  if (by_reference) {
    order.assign(used_[program.value].begin(), used_[program.value].end());
  } else if (module_.programs[program].kind == ProgramKind::kSub) {
    std::set<Key> keys = passed_[program.value];
    if (valued_[program.value] == 0) {
      // Nobody here calls it: what it reads first comes from its callers.
      for (const auto& [owner, cell] : config_.read_at_entry) {
        if (owner == program) keys.insert(cell);
      }
      for (const Key key : used_[program.value]) {
        if (key >= kGivenArgument && keys.contains(key - kGivenArgument)) keys.insert(key);
      }
    }
    order.assign(keys.begin(), keys.end());
  }
  // A value and the truth beside it stand together.
  std::stable_sort(order.begin(), order.end(), [](Key a, Key b) {
    return a % kGivenArgument != b % kGivenArgument ? a % kGivenArgument < b % kGivenArgument : a < b;
  });
  const auto first = static_cast<std::uint32_t>(module_.variables.Size());
  for (const Key key : order) NewVariable(program, key, Scope::kParameter, by_reference);
  module_.programs[program].parameters = {first, static_cast<std::uint32_t>(order.size())};
  for (const Key key : used_[program.value]) {
    if (!names_[program.value].contains(key)) NewVariable(program, key, Scope::kLocal, false);
  }
}

/// A macro call of a program that others call with shared locals: its arguments get holders in the caller.
void Naming::ShareArguments(ProgramId program, BlockId block, Call& call, ProgramEditor& editor) {
  std::vector<Arg> args;
  std::vector<Word> words;
  std::uint16_t position = 0;
  for (const Key key : parameters_[call.program.value]) {
    const Type type = key >= kGivenArgument ? Type::kBool : Type::kReal;
    ExprId value = make_.Literal(0, type);
    for (const ArgId id : call.args) {
      if (module_.args[id].position == key) value = module_.args[id].value;
    }
    const VariableId holder = NewLocal(module_, program, NameOf(key) + "_ARG", type);
    words.push_back(MakeAssignment(make_.Variable(holder), value));
    Arg arg;
    arg.position = position++;
    arg.value = make_.Variable(holder);
    args.push_back(arg);
  }
  if (!words.empty()) editor.PutInFront(block, words);
  call.args = {static_cast<std::uint32_t>(module_.args.Size()), static_cast<std::uint32_t>(args.size())};
  for (const Arg& arg : args) module_.args.Add(arg);
}

void Naming::LowerCalls(ProgramId program) {
  ProgramEditor editor(module_, program, "numbers_to_names");
  for (const BlockId block : module_.programs[program].blocks) {
    for (const WordId word_id : module_.blocks[block].words) {
      const Word word = module_.words[word_id];
      if ((word.op != WordOp::kCall && word.op != WordOp::kModalCall) || !word.Extra<CallId>().Valid()) continue;
      Call call = module_.calls[word.Extra<CallId>()];
      if (!call.program.Valid()) continue;
      const std::vector<Key>& order = parameters_[call.program.value];
      if (call.new_level && shared_[call.program.value] != 0) {
        if (word.op == WordOp::kModalCall) {
          Refuse(block, "a modal call of a program that others call with their locals");
          continue;
        }
        ShareArguments(program, block, call, editor);
      } else {
        std::vector<Arg> args;
        for (std::size_t i = 0; i < order.size(); ++i) {
          Arg made;
          made.position = static_cast<std::uint16_t>(i);
          if (!call.new_level) {
            made.value = make_.Variable(names_[program.value].at(order[i]));
          } else {
            for (const ArgId id : call.args) {
              if (module_.args[id].position == order[i]) made.value = module_.args[id].value;
            }
            if (!made.value.Valid()) continue;
          }
          args.push_back(made);
        }
        call.args = {static_cast<std::uint32_t>(module_.args.Size()), static_cast<std::uint32_t>(args.size())};
        for (const Arg& arg : args) module_.args.Add(arg);
      }
      call.has_brackets = !order.empty();
      module_.calls[word.Extra<CallId>()] = call;
    }
  }
  editor.Apply();
}

void Naming::Replace(ProgramId program) {
  RewriteProgram(module_, program, [&](Module& module, ExprId id) {
    const Expr& expr = module.exprs[id];
    if (const auto key = KeyOf(expr)) return make_.Variable(names_[program.value].at(*key));
    if (expr.op == ExprOp::kCell && common_spaces_.contains(expr.a))
      return make_.Cell(target_, common_.at({expr.a, expr.b}));
    if (expr.op != ExprOp::kCellAt || expr.b == target_.value) return id;
    const Block cells = *CellsOf(expr);
    const double shift = static_cast<double>(common_.at({cells.space, cells.first})) - cells.first;
    const ExprId index{std::size_t{expr.a}};
    if (shift == 0) return make_.CellAt(target_, index);
    const ExprId step = make_.Literal(std::fabs(shift), Type::kInt);
    return make_.CellAt(target_, make_.Binary(shift < 0 ? ExprOp::kSubtract : ExprOp::kAdd, index, step));
  });
}

/// PROC, EXTERN, DEF.
void Naming::Define(ProgramId program) {
  const IdRange<BlockId> blocks = module_.programs[program].blocks;
  if (blocks.Empty()) return;
  ProgramEditor editor(module_, program, "definitions");
  const auto put = [&](const std::vector<Word>& words) {
    ir::Block made = editor.MakeBlock(blocks[0]);
    made.indent = 0;
    editor.SetWords(made, words);
    editor.InsertBefore(blocks[0], made);
  };
  const auto word_of = [](WordOp op, std::uint32_t extra) { return MakeWord(op, 0, {}, extra); };
  if (!parameters_[program.value].empty()) {
    module_.programs[program].has_header = true;
    put({word_of(WordOp::kHeader, program.value)});
  }
  std::set<std::uint32_t> known;
  for (const BlockId block : blocks) {
    for (const WordId word_id : module_.blocks[block].words) {
      const Word word = module_.words[word_id];
      if ((word.op != WordOp::kCall && word.op != WordOp::kModalCall) || !word.Extra<CallId>().Valid()) continue;
      const ProgramId callee = module_.calls[word.Extra<CallId>()].program;
      if (!callee.Valid() || callee == program || parameters_[callee.value].empty()) continue;
      if (!known.insert(callee.value).second) continue;
      Extern record;
      record.name = module_.programs[callee].name;
      record.first_param = static_cast<std::uint32_t>(module_.extern_params.size());
      for (const VariableId id : module_.programs[callee].parameters) {
        ExternParam parameter;
        parameter.type = module_.variables[id].type;
        parameter.by_reference = module_.variables[id].by_reference;
        module_.extern_params.push_back(parameter);
        ++record.param_count;
      }
      put({word_of(WordOp::kExtern, module_.externs.Add(record).value)});
    }
  }
  for (const Type type : {Type::kReal, Type::kBool}) {
    std::vector<Word> words;
    for (const VariableId id : module_.variables.Ids()) {
      const Variable& variable = module_.variables[id];
      if (variable.owner == program && variable.type == type && variable.scope == Scope::kLocal)
        words.push_back(word_of(WordOp::kDefine, id.value));
    }
    if (!words.empty()) put(words);
  }
  editor.Apply();
}

NumbersToNamesResult Naming::Run() {
  FindSpaces();
  FindUses();
  PlaceCommon();
  if (!result_.ok) return std::move(result_);
  for (const ProgramId program : module_.programs.Ids()) NameProgram(program);
  for (const ProgramId program : module_.programs.Ids()) LowerCalls(program);
  for (const ProgramId program : module_.programs.Ids()) Replace(program);
  for (const ProgramId program : module_.programs.Ids()) Define(program);
  return std::move(result_);
}

}  // namespace

NumbersToNamesResult NumbersToNames(Module& module, const NumbersToNamesConfig& config, diag::Sink& sink) {
  return Naming(module, config, sink).Run();
}

}  // namespace ncport::ir::transform
