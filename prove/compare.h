// Compares what two programs do, event by event (contracts section 6, "Two programs"). The allowances there and no
// others.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ir/machine.h"
#include "prove/recorded_trace.h"

namespace ncport::prove {

/// Takes the work offset and the path mode out of what a machine starts with: on either side they are what the operator
/// left, and a start value of the profile would hide the word that selects it.
void LeaveToOperator(ir::ModalState& start);

/// How exact the words of one side are.
struct Precision {
  ir::WordError word_error = ir::WordError::kNone;
  double increment = 0;               // least input increment, mm or degrees
  std::uint8_t diameter_axis = 0xFF;  // the axis on which an error counts half while diameter programming is active
  // Of a control that moves the centre of an arc along its chord until both radii agree (sinumerik-8.3): by how much
  // they may differ, mm. 0: the centre stays as written.
  double center_moves = 0;
  double speed_error = 0;  // of an S word, 1/min or m/min: half of one where S takes whole numbers
};

/// One tool of both sides. A source name is the text of the tool call; numbers otherwise.
struct ToolPair {
  std::string source_name;  // empty: by number
  std::uint32_t source_tool = 0;
  std::uint32_t source_edge = 0;    // 0 = any; a source with registers: that of the length
  std::uint32_t source_radius = 0;  // a source with registers; 0 = none
  std::string target_name;
  std::uint32_t target_tool = 0;
  std::uint32_t target_suffix = 0;  // decimals of the tool number; 0 = none
  std::uint32_t target_offset = 0;  // register of the target; 0 = none
  std::uint32_t target_radius = 0;  // mills: register of the radius, target_offset is that of the length; 0 = none
};
struct NumberPair {
  std::uint32_t source = 0, target = 0;
  std::uint32_t source_extension = 0, target_extension = 0;
};
struct AuxPair {
  std::uint32_t source = 0;
  std::optional<std::uint32_t> target;  // none: dropped, as the report lists
};

/// What the translation mapped and listed. Empty maps compare the two sides as they are.
struct Maps {
  std::vector<ToolPair> tools;
  std::vector<NumberPair> work_offsets;
  std::vector<AuxPair> aux;
  bool messages_lost = false;               // MSG and PRINT are left out on both sides
  bool path_lost = false;                   // PATH likewise
  std::vector<std::uint32_t> split_rapids;  // source blocks whose rapid the target writes axis by axis
  bool cross_language = true;               // alarms agree by class, else by their first word
  bool tool_change_added = false;           // M6 of the target, where the source's T changes the tool by itself
  bool source_registers = false;            // the source names length and radius by registers, the target edges
  bool offset_words = false;                // tool words of the target that only name an offset of the tool that is in
  bool separate_registers = false;          // the target names length and radius by registers of their own (a mill)
  bool tools_mapped = false;                // tools and offsets go through `tools`; one without an entry differs
};

struct CompareOptions {
  Precision source, target;
  Maps maps;
  double tolerance = 0.0001;  // mm, degrees: on top of the words' errors (`diff --tolerance`)
};

/// The first place where the two sides differ.
struct Difference {
  std::string what;  // plain words, with both values
  ir::BlockId source_block, target_block;
};

struct Comparison {
  std::optional<Difference> difference;
  std::size_t events_compared = 0;
  std::size_t spindle_moved_across_rapid = 0;  // allowed, listed
  std::size_t centers_moved = 0;               // by one control only, over the error of their words: allowed, listed
  bool source_alarmed_before_motion = false;
};

/// Both traces whole. Events of added blocks (Event::added) of the target are left out where the contract allows them.
/// `target_start`, `source_start`: the work offset in which that side starts, which it need not select.
Comparison Compare(const RecordedTrace& source, const RecordedTrace& target, const CompareOptions& options,
                   const ir::WorkOffset& target_start = {}, const ir::WorkOffset& source_start = {});

}  // namespace ncport::prove
