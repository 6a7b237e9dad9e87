// The parts of Dump, for those who dump one program or block at a time. Not for passes: see ir/dump.h.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/text_buffer.h"
#include "ir/dump.h"
#include "ir/enum_names.h"

namespace ncport::ir {

/// Which of several records of one name is meant: 1 for the first.
template <class IdType>
class Ordinals {
 public:
  void Add(IdType id, StringId name) {
    if (ordinals_.size() <= id.value) ordinals_.resize(std::size_t{id.value} + 1, 0);
    ordinals_[id.value] = ++counts_[name.value];
  }
  [[nodiscard]] std::uint32_t Of(IdType id) const { return ordinals_[id.value]; }

 private:
  std::vector<std::uint32_t> ordinals_;
  std::unordered_map<std::uint32_t, std::uint32_t> counts_;
};

class DumpWriter {
 public:
  DumpWriter(const Module& module, TextBuffer& out, const DumpOptions& options);

  void Declarations();
  void Program(ProgramId id);
  /// A block line and its comments. `program`: whose names stand without owner.
  void Block(BlockId id, ProgramId program);
  void Expr(ExprId id, unsigned depth = 0);
  /// Bare or in quotes; `-` for none.
  void Name(StringId id);
  void ProgramRef(ProgramId id);
  void Place(FileId file, std::uint32_t line);

 private:
  // dump.cc
  void Variable(VariableId id, std::string_view keyword);
  void OriginChain(OriginId id);
  void Comment(CommentId id);
  // dump_words.cc
  void Word(const ir::Word& word);
  void Index(const ir::Word& word);
  void Extra(const ir::Word& word);
  void Attributes(const ir::Word& word);
  void Target(const ir::Target& target);
  void Jump(JumpId id);
  void Switch(SwitchId id);
  void Call(CallId id);
  void Part(PartId id);
  void Extern(ExternId id);
  void AssignList(AssignListId id);
  // dump_exprs.cc
  void Literal(const ir::Expr& expr);
  void Suffixes(ExprId id);
  void List(const ir::Expr& expr, unsigned depth);
  void Quoted(std::string_view text);
  void BareOrQuoted(std::string_view text);
  void AxisRef(std::uint32_t axis);
  void VariableRef(VariableId id);

  void Put(char c) { out_.Append(c); }
  void Put(std::string_view text) { out_.Append(text); }
  void Number(std::uint64_t value);
  void Unknown(std::uint64_t value);  // `?value`
  template <class Enum>
  void Known(Enum value) {
    const std::string_view name = NameOf(value);
    name.empty() ? Unknown(static_cast<std::uint64_t>(value)) : Put(name);
  }
  void Ordinal(std::uint32_t ordinal);
  /// Reference to a record by its name.
  template <class Store, class IdType>
  void Ref(const Store& store, const Ordinals<IdType>& ordinals, IdType id) {
    if (!id.Valid()) return Put('-');
    if (!store.Contains(id)) return Unknown(id.value);
    Name(store[id].name);
    Ordinal(ordinals.Of(id));
  }
  /// ` keyword expression` if there is one.
  void Optional(std::string_view keyword, ExprId expr) {
    if (!expr.Valid()) return;
    Put(keyword);
    Expr(expr);
  }

  const Module& module_;
  TextBuffer& out_;
  const DumpOptions& options_;
  ProgramId program_;  // of the block under way
  Ordinals<ProgramId> programs_;
  Ordinals<VariableId> variables_;
  Ordinals<SpaceId> spaces_;
  Ordinals<SystemId> systems_;
  Ordinals<FileId> files_;
  Ordinals<Id<Spelling>> spellings_;
  std::unordered_map<std::uint64_t, VariableId> by_owner_;  // owner and name -> first variable; owner none = everywhere
  std::vector<std::vector<VariableId>> owned_;              // per program
  std::vector<VariableId> unowned_;
  unsigned budget_ = 0;  // nodes that the expression under way may still print
};

}  // namespace ncport::ir
