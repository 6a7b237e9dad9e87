// What is in force on both sides when something happens: spindles, tool and offsets, cutter compensation, work offset,
// path mode.
#include <algorithm>

#include "prove/comparer.h"

namespace ncport::prove {

using exec::Event;
using exec::EventKind;
using exec::OffsetKind;

void Comparer::CompareSpindles(const Event& a, const Event& b, const Spindles& source, const Spindles& target) {
  for (std::size_t i = 0; i < source.size() && !Failed(); ++i) CompareSpindle(a, b, source[i], target[i]);
}

void Comparer::CompareSpindle(const Event& a, const Event& b, const SpindleNow& sa, const SpindleNow& sb) {
  if (sa.sense != sb.sense) {
    // Before either side switched the spindle there is nothing to compare.
    const bool idle_a = sa.sense == ir::SpindleState::kUnknown || sa.sense == ir::SpindleState::kStop;
    const bool idle_b = sb.sense == ir::SpindleState::kUnknown || sb.sense == ir::SpindleState::kStop;
    if (!(idle_a && idle_b)) return Fail(&a, &b, "the spindle turns in another sense");
  }
  if (sa.speed < 0 && sb.speed < 0) return;
  if (sa.speed < 0 || sb.speed < 0) return Fail(&a, &b, "a spindle speed on one side only");
  if (sa.surface != sb.surface) return Fail(&a, &b, "constant surface speed on one side only");
  CompareSpeed(a, b, sa.speed, sb.speed, sa.surface ? "the surface speed" : "the spindle speed");
  if (Failed() || !sa.surface) return;
  if ((sa.limit < 0) != (sb.limit < 0)) return Fail(&a, &b, "a spindle speed limit on one side only");
  if (sa.limit >= 0) CompareSpeed(a, b, sa.limit, sb.limit, "the spindle speed limit");
}

/// What a person or a dwell meets: the spindle as it turns.
void Comparer::CompareSpindlesNow(const Event& a, const Event& b) {
  CompareSpindles(a, b, source_.SpindlesNow(), target_.SpindlesNow());
}

/// What a tool change meets, without the words that the translation added around it. Words of the source's block may
/// stand behind the change in the target.
void Comparer::CompareSpindlesAtChange(const Event& a, const Event& b) {
  const Spindles& target = target_.SpindlesWithoutAdded();
  if (source_.SpindlesBefore(a.block) == target) return;
  CompareSpindles(a, b, source_.SpindlesWithoutAdded(), target);
}

void Comparer::CompareTool(const Event& a, const Event& b) {
  if (!options_.maps.tools_mapped) {
    if (a.number != b.number || a.extension != b.extension || a.text != b.text) Fail(&a, &b, "another tool is called");
    return;
  }
  for (const ToolPair& pair : options_.maps.tools) {
    const bool source =
        pair.source_name.empty() ? a.text.empty() && pair.source_tool == a.number : pair.source_name == a.text;
    const bool target = pair.target_name.empty()
                            ? b.text.empty() && pair.target_tool == b.number && pair.target_suffix == b.extension
                            : pair.target_name == b.text;
    if (source && target) return;
  }
  Fail(&a, &b, "the tool of the target is not the one that the tool map gives");
}

void Comparer::CompareToolState(const Event& a, const Event& b) {
  if (!options_.maps.tools_mapped) return;
  const Selected& sa = source_.Now();
  const Selected& sb = target_.Now();
  if (sa.length_minus != sb.length_minus)
    return Fail(&a, &b, "a tool length is added on one side and taken off on the other");
  if (!sa.tool_known || !sb.tool_known) return;
  constexpr std::uint16_t kZ = 1U << 2U;
  const bool compensated = sa.comp == ir::CutterComp::kLeft || sa.comp == ir::CutterComp::kRight;
  if (options_.maps.source_registers) {
    if (sa.loaded == 0) return;
    // A length counts when Z moves, a radius under compensation; one edge stands for both.
    const bool lengthwise = (b.moved_axes & kZ) != 0;
    const std::uint32_t edge = sb.offset_kind == OffsetKind::kNone ? 0 : sb.offset;
    bool agree = (!lengthwise || (sa.length == 0 && edge == 0)) && !compensated;
    for (const ToolPair& pair : options_.maps.tools) {
      if (pair.source_tool != sa.loaded || pair.target_offset != edge || pair.source_edge == 0) continue;
      agree = agree ||
              ((!lengthwise || pair.source_edge == sa.length) && (!compensated || pair.source_radius == sa.radius));
    }
    if (!agree) Fail(&a, &b, "the edge in force is not the one that the tool map gives");
    return;
  }
  for (const ToolPair& pair : options_.maps.tools) {
    const bool tool = pair.source_name.empty() ? sa.tool_name.empty() && pair.source_tool == sa.tool
                                               : pair.source_name == sa.tool_name;
    if (!tool) continue;
    if (options_.maps.separate_registers) {
      // An edge is a length, which counts when Z moves, and a radius, which counts under compensation.
      const bool off = sa.offset_known && sa.offset_kind == OffsetKind::kNone;
      if (!off && (!sa.offset_known || sa.offset != pair.source_edge)) continue;
      const bool length = (b.moved_axes & kZ) == 0 || sb.length == (off ? 0 : pair.target_offset);
      const bool radius = !compensated || sb.radius == (off ? 0 : pair.target_radius);
      if (length && radius) return;
      continue;
    }
    const bool edge = pair.source_edge == 0 || (sa.offset_known && sa.offset == pair.source_edge);
    const bool none = sa.offset_known && sa.offset_kind == OffsetKind::kNone && sb.offset_kind == OffsetKind::kNone;
    if (none || (edge && (pair.target_offset == 0 || sb.offset == pair.target_offset))) return;
  }
  Fail(&a, &b, "the tool offset in force is not the one that the tool map gives");
}

/// The side that the cutter is kept on, as it is in force: a block that the translation added may have selected it.
void Comparer::CompareCompensation(const Event& a, const Event& b) {
  const auto side = [](ir::CutterComp comp) { return comp == ir::CutterComp::kUnknown ? ir::CutterComp::kOff : comp; };
  if (side(source_.Now().comp) != side(target_.Now().comp))
    Fail(&a, &b, "cutter compensation is in force on one side only, or the other way");
}

namespace {

/// 54, 54.1 P1, none: as a trace says it (contracts section 5).
std::string OffsetName(const Selected& selected) {
  if (selected.wcs == 0) return "none";
  return selected.wcs_extension == 0 ? fmt::format("{}", selected.wcs)
                                     : fmt::format("{}.1 P{}", selected.wcs, selected.wcs_extension);
}

}  // namespace

/// The work offset in force. A source that selects none works with the one that is in force, whichever it is.
void Comparer::CompareWorkOffset(const Event& a, const Event& b) {
  const Selected& sa = source_.Now();
  const Selected& sb = target_.Now();
  if (!sa.wcs_known) {
    if (target_.WithoutAdded().wcs_known) Fail(&a, &b, "a work offset is selected in the target only");
    return;
  }
  if (!sb.wcs_known) return Fail(&a, &b, "a work offset is selected in the source only");
  for (const NumberPair& pair : options_.maps.work_offsets) {
    if (pair.source == sa.wcs && pair.source_extension == sa.wcs_extension) {
      if (pair.target == sb.wcs && pair.target_extension == sb.wcs_extension) return;
      return Fail(&a, &b, "the work offset of the target is not the one that the map gives");
    }
  }
  if (sa.wcs != sb.wcs || sa.wcs_extension != sb.wcs_extension)
    Fail(&a, &b, fmt::format("work offset {} became {}", OffsetName(sa), OffsetName(sb)));
}

/// The path mode in force. A source that selects none works with the one that is in force, whichever it is.
void Comparer::ComparePath(const Event& a, const Event& b) {
  if (options_.maps.path_lost) return;
  const ir::PathMode path = source_.Now().path;
  const ir::PathMode start = target_.StartPath();
  if (path == ir::PathMode::kUnknown && start != ir::PathMode::kUnknown && target_.Now().path == start) return;
  const ir::PathMode other = path == ir::PathMode::kUnknown ? target_.WithoutAdded().path : target_.Now().path;
  if (path != other) Fail(&a, &b, "exact stop and path control differ");
}

}  // namespace ncport::prove
