// What the words of SINUMERIK mean, as data: codes, addresses, functions, system variables, reserved words.
// Card: docs/languages/sinumerik.md; `rule` names the section.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dialects/code_table.h"
#include "ir/nodes.h"

namespace ncport::dialects::sinumerik {

/// G and M words and codes by name: words without a value.
const CodeTable& Codes();

/// Row for M functions that have no row of their own (they go to the PLC): Word::value is the number.
const CodeRow& AuxiliaryCode();

/// Which values an address takes besides a plain one.
enum AddressModes : std::uint8_t {
  kPlainOnly = 0,
  kLinearModes = 1,    // AC IC
  kRotaryModes = 2,    // DC ACP ACN
  kDiameterModes = 4,  // DAC DIC RAC RIC
  kQuickMode = 8,      // QU
};

/// What an extension (S2=, LIMS[2]=) of an address names.
enum class Extension : std::uint8_t { kNone, kSpindle, kNumber, kAxis };

/// An address with a value; axes are not in this table.
struct AddressRow {
  std::string_view text;  // "F", "CR"
  ir::WordOp op = ir::WordOp::kInert;
  std::uint8_t index = 0;
  std::uint8_t modes = kPlainOnly;
  Extension extension = Extension::kNone;
  ir::Phase phase = ir::Phase::kMotion;
  std::string_view rule;
  bool alias = false;  // read, never printed for this meaning
};
std::span<const AddressRow> Addresses();
/// Row to print for this meaning; null = none. Inert rows are found by text only.
const AddressRow* FindAddress(ir::WordOp op, std::uint8_t index);

struct FunctionRow {
  std::string_view text;
  ir::Function function;
  ir::Type result;  // kAny: type of the arguments
  std::string_view rule;
};
std::span<const FunctionRow> Functions();
/// Row to print for this function, or null.
const FunctionRow* FindFunction(ir::Function function);

struct ModeRow {
  std::string_view text;  // "AC"
  ir::ValueMode mode;
  std::uint8_t needs;  // AddressModes bit that the address must have
};
std::span<const ModeRow> ValueModes();

struct TypeRow {
  std::string_view text;
  ir::Type type;
};
std::span<const TypeRow> Types();

/// A system variable that is known by name. `name` without `$`.
struct SystemRow {
  std::string_view name;
  ir::SystemKind kind;
  ir::Type type;
  bool writable = false;
  std::uint8_t indices = 0;  // number of indices it takes
};
std::span<const SystemRow> SystemVariables();
/// What is known of `$NAME` (upper case, without `$`); also machine and setting data by the pattern of their names
/// (MN_ MC_ MA_ MAS_ SN_ SC_ SA_), and other variables by the letters in front (AA_ AC_ P_ ...), which only the machine
/// knows. Null = no system variable.
const SystemRow* FindSystemVariable(std::string_view name);
/// True if only the first letters tell that `name` is a system variable, so that it may be misspelled; not so for
/// machine and setting data, whose names are the builder's.
bool IsUnlistedSystemVariable(std::string_view name);

/// True for machine and setting data by the letters in front: `$MN_`, `$MC_` .. Any case, with or without `$`.
bool IsMachineData(std::string_view name);

/// Words of PROC blocks behind the parameters; only SAVE changes what a run does.
std::span<const std::string_view> ProgramAttributes();
/// Attributes of DEF without a value (SYNRW, INIPO ...) and with one (PHU 5).
std::span<const std::string_view> DefinitionFlags();
std::span<const std::string_view> DefinitionValues();
/// Procedures that have no effect on what a run does; they are kept with their arguments.
std::span<const std::string_view> InertProcedures();

/// All words that cannot be identifiers, sorted; `docs/languages/sinumerik-reserved.txt`.
std::span<const std::string_view> ReservedWords();
/// `word` in upper case.
bool IsReserved(std::string_view word);

}  // namespace ncport::dialects::sinumerik
