// The rules, one file each. A rule reports what it is sure of and is silent where an input or a caller could make the
// program right. Refused blocks have their finding; rules read past them.
#pragma once

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "check/subject.h"

namespace ncport::check {

/// All rules over all programs, in the order of the list below.
void CheckPrograms(const Subject& subject, diag::Sink& sink);

// Of one program that the user wrote.

/// NC4001: a jump, a switch or a repeated part names a label that its search does not find.
void CheckLabels(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC4001, NC4002: the same for constants that a run looks for: GOTO -1, GOTOF "LB", M99 P, RET("LB"), M97 P, CALL
/// "SUB". A return is looked for in the programs that call this one: an error where none of them holds it.
void CheckConstantTargets(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC2004: a constant text that is converted to a number and is none.
void CheckConstantTexts(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC2006: labels and program names that are longer than the control reads.
void CheckNameLengths(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC2003: a jump names a label or block number that stands twice where it looks; the control takes one of them.
void CheckDoubleLabels(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC2007: a label that nothing names. Silent where a jump is computed.
void CheckUnusedLabels(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC4004: a jump from outside into IF, a loop or the like. What the control then does at the end of the structure is
/// not promised.
void CheckJumpsIntoStructures(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC4005: a way leads to the end of the text without an end word, where the control wants one.
void CheckProgramEnd(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC5005, NC1002, NC1013: arcs that nothing describes, centres outside of the plane, a radius on a straight line,
/// polar words beside an axis of the plane.
void CheckArcWords(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC3011, NC4011: FOR whose end changes in its body, or whose counter is read behind it.
void CheckLoopCounters(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC3010: EQ or NE with a fraction that binary numbers do not hold, where the control compares exactly.
void CheckExactComparisons(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC4014: a modal call that is not ended before the tool changes, or before a retract where its cycle would run.
/// NC4013: a cycle that needs a modal call, where none is in force on any way.
void CheckModalCalls(const Subject& subject, ir::ProgramId program, diag::Sink& sink);

/// NC4007: jumps back from which no way leads to an end, a stop or an alarm.
void CheckEndlessJumps(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC9003: brackets, loops and branches nested deeper than the control takes (profile: nesting).
void CheckNesting(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC9006: blocks with more characters than the control reads (profile: block.max-length). Needs the texts, so the
/// command calls it.
void CheckBlockLengths(const Subject& subject, ir::ProgramId program, const SourceFiles& files, diag::Sink& sink);
/// NC3006: literals with more digits than controls of eight digits keep (fanuc-3.4).
void CheckLostDigits(const Subject& subject, ir::ProgramId program, diag::Sink& sink);
/// NC3005: a variable without start value that is read where no way has set it: it is 0 there.
void CheckUnsetValues(const Subject& subject, ir::ProgramId program, diag::Sink& sink);

// Of the whole set.

/// NC2007: variables and parameters that no block uses.
void CheckUnusedNames(const Subject& subject, diag::Sink& sink);
/// NC2002: two programs of one name.
void CheckDoublePrograms(const Subject& subject, diag::Sink& sink);
/// NC2014: a variable and a label or program of one name.
void CheckSharedNames(const Subject& subject, diag::Sink& sink);
/// NC2004, NC2011: declarations of called programs that do not fit them. NC4012: calls with arguments of a program that
/// lies in a folder whose programs the control knows only by EXTERN.
void CheckExterns(const Subject& subject, diag::Sink& sink);
/// NC4006: every way through a program calls it again.
void CheckRecursion(const Subject& subject, diag::Sink& sink);
/// NC3004: a numbered variable that is empty on every way here, in arithmetic, a comparison or a word (fanuc-11#45).
void CheckEmptyValues(const Subject& subject, diag::Sink& sink);
/// NC9003: calls from a main program that are nested deeper than the control takes (profile: nesting.call).
void CheckCallDepth(const Subject& subject, diag::Sink& sink);
/// NC5003: a feed move on no way to which a spindle was started or got a speed, in a set that starts one; also with a
/// new tool behind a stop.
void CheckSpindle(const Subject& subject, diag::Sink& sink);
/// NC5003: a feed move behind a new speed with which nothing starts the spindle, or behind a start for which no way
/// sets a speed; the latter stands at the start.
void CheckSpindleSpeed(const Subject& subject, diag::Sink& sink);
/// NC5009: cutter compensation begins or ends in an arc; also where the first move of the plane behind a lone switch is
/// one, on every way. NC5010: it begins while no way names a tool, or D0 is in force. NC5011: it is on, on every way,
/// where the tool or the plane changes or the program ends.
void CheckCompensation(const Subject& subject, diag::Sink& sink);
/// NC5012: an arc in a plane whose axes the frame scales by different factors, on every way.
void CheckFrameArcs(const Subject& subject, diag::Sink& sink);
/// NC5012: the same for an arc by its centre under a scale about a point.
void CheckScaleArcs(const Subject& subject, diag::Sink& sink);
/// NC5013: an axis that the profile does not name. NC5014: a diameter word or mode where no transverse axis is. NC2005:
/// a numbered variable beyond those of the profile.
void CheckMachineWords(const Subject& subject, diag::Sink& sink);

}  // namespace ncport::check
