// One set of programs in neutral form: the arenas that all ids point into.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/store.h"
#include "base/string_pool.h"
#include "ir/expr_places.h"
#include "ir/nodes.h"

namespace ncport::ir {

/// Owner of every record of a set of programs. Copyable; passes that restructure build new blocks at the end of
/// `blocks` and give the program its new range.
struct Module {
  StringPool strings;

  Store<ProgramId, Program> programs;
  Store<BlockId, Block> blocks;
  Store<WordId, Word> words;
  Store<ExprId, Expr> exprs;
  std::vector<ExprId> expr_items;  // entries of list expressions, ExprItemId
  Store<VariableId, Variable> variables;
  Store<SpaceId, Space> spaces;
  Store<SystemId, System> systems;
  Store<JumpId, Jump> jumps;
  Store<SwitchId, Switch> switches;
  std::vector<SwitchArm> switch_arms;
  Store<CallId, Call> calls;
  Store<ArgId, Arg> args;
  Store<PartId, Part> parts;
  Store<ForId, For> fors;
  Store<ExternId, Extern> externs;
  std::vector<ExternParam> extern_params;
  Store<AssignListId, AssignList> assign_lists;
  Store<OriginId, Origin> origins;
  Store<CommentId, Comment> comments;
  std::vector<Spelling> spellings{Spelling{}};  // Word::spelling; entry 0 = none
  std::vector<StringId> axis_names;             // of axes from kFirstNamedAxis on
  std::vector<StringId> file_names;             // FileId -> name, for dumps and traces

  ExprPlaces expr_places;
  /// Spelling of a literal with NumberFormat::kAsText, by Expr::count index; entry 0 unused.
  std::vector<StringId> literal_texts{StringId{}};

  ExprId AddExpr(const Expr& expr, ExprPlace place = {}) {
    const ExprId id = exprs.Add(expr);
    expr_places.Add(id, place);
    return id;
  }
  /// As AddExpr, with a default expression to be filled where it stands; its id is LastExpr().
  Expr& EmplaceExpr() { return exprs.Emplace(); }
  [[nodiscard]] ExprId LastExpr() const { return ExprId{exprs.Size() - 1}; }
  [[nodiscard]] ExprId Item(std::uint32_t index) const { return expr_items[index]; }
  [[nodiscard]] std::string_view View(StringId id) const { return id.Valid() ? strings.View(id) : std::string_view{}; }

  /// Source place of a word or an expression of a block. The value of a word without a place of its own stands where
  /// the word stands.
  [[nodiscard]] SourceRange RangeOf(const Block& block, const Word& word) const;
  [[nodiscard]] SourceRange RangeOf(const Block& block, ExprId expr) const;
  [[nodiscard]] SourceRange RangeOf(const Block& block) const;

  /// Names compare without regard to case when the language says so: returns the program of that name or none.
  [[nodiscard]] ProgramId FindProgram(std::string_view name, bool ignore_case) const;
};

}  // namespace ncport::ir
