// The work of ResolveNames, split over resolve_*.cc.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "dialects/sinumerik/cycle_parameters.h"
#include "frontend/sinumerik/resolve.h"
#include "ir/module.h"

namespace ncport::frontend::sinumerik {

class Resolver {
 public:
  Resolver(SourceFiles& files, ir::Module& module, const dialects::Profile& profile, diag::Sink& sink)
      : files_(files), module_(module), profile_(profile), sink_(sink) {}

  void Run();

 private:
  // Programs and scopes (resolve.cc).
  void ReadLibrary();
  void IndexVariables();
  void Program(ir::ProgramId program);
  void Block(ir::BlockId block);
  bool Word(ir::Word& word);
  bool Define(ir::VariableId variable);
  void Surplus(const ir::Variable& variable);
  bool Parameters(ir::ProgramId program);
  bool List(ir::AssignListId list, ir::ExprId place, ir::VariableId whole);
  bool Jump(ir::JumpId jump);
  bool Target(ir::Target& target, bool own_program);
  bool Part(ir::PartId part);
  bool Switch(ir::SwitchId id);
  void CollectLabels(ir::ProgramId program);
  void CollectRefusedNames(ir::ProgramId program);
  void CountMissingNames();
  void Refuse(ir::Block& block);
  [[nodiscard]] ir::VariableId FindVariable(std::string_view name) const;
  [[nodiscard]] bool FindAxis(std::string_view name, std::uint8_t& axis) const;

  // What words of one block do to each other (resolve_blocks.cc). False after an error.
  bool BlockRules(const ir::Block& block);
  bool OwnBlock(const ir::Block& block);
  bool EndAlone(const ir::Block& block);
  bool Lead(const ir::Block& block);
  void Marks(const ir::Block& block);
  [[nodiscard]] std::string_view Slice(const SourceRange& at) const;
  bool PolarBesideAxis(const ir::Block& block);
  bool Turn(const ir::Word& word);
  void AlarmNumber(const ir::Word& word);
  void Spindles(const ir::Block& block);
  bool Limit(const ir::Word& word, double low, double high, std::string_view range);

  // Calls (resolve_calls.cc).
  bool Call(ir::Word& word);
  bool Arguments(const ir::Call& call, const ir::Word& word);
  /// `with_arguments`: the call has some, so that only a program or cycle can be meant.
  void UnknownProgram(std::string_view name, const SourceRange& at, bool with_arguments);
  bool DeclaredArguments(const ir::Call& call, const ir::Word& word);
  bool Argument(ir::Arg& arg, ir::VariableId parameter);
  bool Reference(ir::ExprId id, ir::Type type, std::uint8_t dimension_count);
  /// Card 7.2: Code::kMissingExtern, once for each program that is called.
  void WantExtern(const ir::Call& call, const ir::Word& word);
  /// True if the folder of the program (`;$PATH=` in front of it, else that of its file) is one of part programs,
  /// subprograms or work pieces.
  [[nodiscard]] bool InPlainFolder(ir::ProgramId program) const;
  /// True if the PROC of a program was not understood, so that what it takes is not known.
  [[nodiscard]] bool HeaderRefused(ir::ProgramId program) const;
  /// A PROC line that was not understood begins with this name.
  [[nodiscard]] bool IsInRefusedHeader(std::string_view name) const;
  /// Says for which parameter the value is, where there is one.
  void TellParameter(diag::Diagnostic& finding) const;
  using CycleParameters = dialects::sinumerik::CycleParameters;
  bool CycleLimits(const ir::Call& call);
  /// Number and types of the arguments of a cycle that ncport does not run.
  bool CycleTypes(const ir::Call& call, const ir::Word& word, const CycleParameters& cycle);
  /// Labels that a text like "CON_A:CON_E" names as start and end of a contour.
  void ContourLabels(ir::ExprId text);
  /// Literal values that the cycle does not take.
  bool CycleRanges(const ir::Call& call, const CycleParameters& cycle);
  /// The number that stands in the text, also with a sign or in brackets; nothing for what is computed.
  [[nodiscard]] std::optional<double> LiteralNumber(ir::ExprId id) const;

  // Expressions (resolve_types.cc): names replaced, types set. False after a finding.
  bool Expr(ir::ExprId id);
  bool Name(ir::ExprId id);
  bool Operation(ir::ExprId id);
  bool FunctionArgument(const ir::Expr& call, std::uint32_t place, ir::ExprId argument);
  bool Place(ir::ExprId id);   // something that can be written
  bool Scalar(ir::ExprId id);  // Expr, and no whole array
  bool Condition(ir::ExprId id);
  bool Number(ir::ExprId id);  // Expr, and a number
  /// Expr, then converted to the type where the value changes by it; a finding where no conversion exists.
  bool Converted(ir::ExprId& id, ir::Type type);
  bool Fits(ir::ExprId& id, ir::Type type);  // as Converted, of a resolved expression
  bool Mismatch(ir::ExprId id, std::string_view what, std::string_view needed, std::string_view help = {});

  template <class... Args>
  bool Fail(diag::Code code, ir::ExprId at, const Args&... args) {
    sink_.Report(code, module_.RangeOf(module_.blocks[block_], at), args...);
    return false;
  }
  /// Code::kUnknownName for `name`, once a program.
  bool UnknownName(ir::ExprId id, std::string_view name);
  /// As Scalar, where a text is likely: an unknown name may be a text without its quotes.
  bool ScalarOrText(ir::ExprId id);
  void SystemVariable(ir::ExprId id);

  [[nodiscard]] std::uint64_t Key(ir::ProgramId program, std::string_view name) const;

  SourceFiles& files_;
  ir::Module& module_;
  const dialects::Profile& profile_;
  diag::Sink& sink_;
  ir::ProgramId program_;
  ir::BlockId block_;
  std::uint32_t resolved_programs_ = 0;
  std::size_t indexed_variables_ = 0;
  std::unordered_map<std::string, ir::VariableId> variables_;  // "<owner>:<NAME>"; owner empty: visible everywhere
  std::unordered_set<std::string> labels_;                     // of program_, upper case
  std::unordered_set<std::string> jump_names_;                 // that jumps of program_ look for and no label bears
  std::unordered_set<std::string> refused_names_;              // words of definitions that were not understood
  struct Missing {
    diag::Diagnostic* finding;
    std::uint32_t more = 0;  // further blocks that use the name
  };
  std::unordered_map<std::string, Missing> missing_names_;  // of program_, upper case
  std::unordered_set<std::string> missing_programs_;
  std::unordered_set<std::string> externs_;          // of program_, upper case; also those that had a finding
  bool address_likely_ = false;                      // an address may stand where a name gets a value
  bool text_likely_ = false;                         // a text may stand where names are looked up
  std::unordered_set<std::string> doubted_systems_;  // system variables that had a finding
  ir::VariableId parameter_;                         // whose argument is resolved
  ir::VariableId defined_;                           // whose start value is resolved
  std::optional<ProgramIndex> programs_;             // all programs are read when names are looked up
};

}  // namespace ncport::frontend::sinumerik
