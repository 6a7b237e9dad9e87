// The parser behind ParseDump, in parts: parse_dump.cc (lines), parse_dump_words.cc, parse_dump_exprs.cc.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diag/sink.h"
#include "base/result.h"
#include "ir/dump_scanner.h"
#include "ir/enum_names.h"
#include "ir/module.h"

namespace ncport::ir {

class DumpParser {
 public:
  DumpParser(std::string_view text, diag::Sink& sink, FileId file) : text_(text), sink_(sink), file_(file) {}

  Result<Module> Run();

 private:
  /// Records by name, in order: the ordinals of the dump count through them.
  template <class IdType>
  using NameMap = std::unordered_map<std::uint32_t, std::vector<IdType>>;

  // parse_dump.cc
  template <class Callback>
  void ForEachLine(Callback callback);
  void Declare();
  void Line();
  void BlockLine();
  void CommentLine();
  void SpaceLine();
  void SystemLine();
  void ProgramLine();
  void VariableLine(bool is_parameter);
  OriginId OriginChain();
  void CloseProgram();
  void CheckLinks();
  void Report(diag::Code code, std::string_view expected, std::string_view found);
  void ReportScanner();

  // parse_dump_words.cc
  void WordText();
  std::uint8_t Index(WordOp op);
  std::uint32_t Extra(WordOp op);
  void Attributes(Word& word);
  Target TargetText();
  JumpId JumpText();
  SwitchId SwitchText();
  CallId CallText();
  PartId PartText();
  ForId ForText();
  ExternId ExternText();
  AssignListId AssignListText();
  void Shape(std::uint8_t& dimension_count, std::uint32_t (&dimensions)[3], std::uint32_t& string_length);

  // parse_dump_exprs.cc
  ExprId ExprText(unsigned depth = 0);
  void LiteralText(Expr& expr);
  void LiteralFields(Expr& expr);
  ExprPlace Suffixes(Expr& expr);
  void ItemList(Expr& expr, unsigned depth);
  IdRange<ExprItemId> AddItems(const std::vector<ExprId>& items);
  std::uint8_t AxisRef();
  StringId Name();  // `-` is none
  StringId NeedName();
  VariableId VariableRef();
  ProgramId ProgramRef();
  FileId FileRef();
  template <class IdType>
  IdType Ref(const NameMap<IdType>& map);

  template <class Enum>
  Enum Value(std::string_view what) {
    const std::string_view name = scan_.PeekKeyword();
    const std::optional<Enum> value = FromName<Enum>(name);
    if (!value || scan_.Failed()) {
      scan_.Fail(std::string(what));
      return {};
    }
    scan_.Keyword();
    return *value;
  }
  /// `-` or an expression.
  ExprId MaybeExpr() { return scan_.Peek() == '-' && !IsNumberAhead() && scan_.Take("-") ? ExprId{} : ExprText(); }
  bool IsNumberAhead();
  ExprId Optional(std::string_view keyword) { return scan_.TakeKeyword(keyword) ? ExprText() : ExprId{}; }
  /// True where nothing more of a word's operands can follow.
  bool AtOperandEnd();

  std::string_view text_;
  diag::Sink& sink_;
  FileId file_;

  Module module_;
  DumpScanner scan_;
  std::uint32_t line_ = 0;
  bool failed_ = false;

  NameMap<ProgramId> programs_;
  NameMap<VariableId> variables_;
  NameMap<SpaceId> spaces_;
  NameMap<SystemId> systems_;
  NameMap<FileId> files_;
  NameMap<Id<Spelling>> spellings_;
  std::unordered_map<std::uint64_t, VariableId> by_owner_;  // program and name -> first variable
  std::unordered_map<std::uint32_t, std::uint16_t> literal_texts_;
  // Records that Declare made and Line fills, counted.
  std::size_t files_read_ = 0, axes_read_ = 0, spellings_read_ = 1, spaces_read_ = 0, systems_read_ = 0;
  std::size_t programs_read_ = 0, variables_read_ = 0;
  ProgramId program_;                       // under way
  std::vector<std::uint32_t> block_lines_;  // in the dump
};

}  // namespace ncport::ir
