// What a translation mapped, added and lost: for the header of the output, the report and the comparison.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/source_range.h"
#include "ir/module.h"
#include "ir/transform/names_to_numbers.h"

namespace ncport::backends {

/// A tool call of the source and the words that stand for it.
struct ToolUse {
  std::string source_words;                        // "T1 D1", `T="ROUGH" D1`
  std::string target_words;                        // "T0101"
  std::string source_name;                         // named tools
  std::string target_name;                         // named tools of the target
  std::uint32_t source_tool = 0, source_edge = 0;  // a mill with registers: the length is the edge
  std::uint32_t source_radius = 0;                 // register of such a mill; 0 = none
  std::uint32_t target_tool = 0, target_offset = 0;
  std::uint32_t target_suffix = 0;  // decimals of the tool number (T1.02), as hundredths; 0 = none
  std::uint32_t target_radius = 0;  // mills: D register; 0 = none
  bool offset_only = false;         // somewhere only for an offset of the tool that is in: a D word of the source
};
struct OffsetUse {
  std::uint32_t source = 0, source_extension = 0, target = 0, target_extension = 0;
};
/// Number of a user alarm.
struct AlarmUse {
  std::uint32_t source = 0, target = 0;
  std::string target_words;  // "#3000=5", "SETAL(65005)"
};
struct AuxUse {
  std::uint32_t source = 0;
  std::optional<std::uint32_t> target;  // none: dropped
};
struct ProgramName {
  ir::ProgramId program;  // of the translated module
  std::string source;     // "TURNING_CYCLE"
  std::string target;     // "4001"
  bool main = false;
  ir::ProgramId whole{};  // program of the source that it is, or a part of; invalid: none
};
/// A block of the source by its place.
struct BlockPlace {
  FileId file;
  std::uint32_t line = 0;
};
/// A listed loss (contracts section 3).
struct Loss {
  SourceRange at;
  std::string what;
  bool left_out = false;  // no comment keeps it
};

/// The translated module and everything that is to be told of it.
struct Translation {
  ir::Module module;
  std::vector<ProgramName> programs;  // in the order of output
  std::vector<ir::transform::CellMapping> cells;
  std::vector<ToolUse> tools;
  std::vector<OffsetUse> offsets;
  std::vector<AuxUse> aux;
  std::vector<AlarmUse> alarms;
  std::vector<Loss> losses;
  std::vector<BlockPlace> split_rapids;  // rapids that are written in pieces
  std::vector<std::string> added;        // blocks without a source block, with the reason
  std::vector<std::string> required;     // what the machine must have: options, parameters, settings
  std::vector<std::string> assumptions;  // unverified rules and settings that the output rests on, with the card row
  bool keeps_files = false;              // the programs stay in the files of the source
  std::uint32_t stopped_blocks = 0;      // blocks of the source that became alarms (--unsupported=stop)
  bool messages_lost = false;
  bool path_lost = false;
  bool tool_change_added = false;  // the target has a change word where the source's tool word changes by itself
};

}  // namespace ncport::backends
