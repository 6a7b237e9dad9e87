#include "check/rules.h"

namespace ncport::check {

void CheckPrograms(const Subject& subject, diag::Sink& sink) {
  for (const ir::ProgramId program : subject.module.programs.Ids()) {
    if (subject.module.programs[program].library) continue;
    CheckLabels(subject, program, sink);
    CheckConstantTargets(subject, program, sink);
    CheckConstantTexts(subject, program, sink);
    CheckNameLengths(subject, program, sink);
    CheckDoubleLabels(subject, program, sink);
    CheckUnusedLabels(subject, program, sink);
    CheckJumpsIntoStructures(subject, program, sink);
    CheckProgramEnd(subject, program, sink);
    CheckArcWords(subject, program, sink);
    CheckLoopCounters(subject, program, sink);
    CheckExactComparisons(subject, program, sink);
    CheckEndlessJumps(subject, program, sink);
    CheckNesting(subject, program, sink);
    CheckLostDigits(subject, program, sink);
    CheckUnsetValues(subject, program, sink);
    CheckModalCalls(subject, program, sink);
  }
  CheckUnusedNames(subject, sink);
  CheckDoublePrograms(subject, sink);
  CheckSharedNames(subject, sink);
  CheckExterns(subject, sink);
  CheckRecursion(subject, sink);
  CheckEmptyValues(subject, sink);
  CheckSpindle(subject, sink);
  CheckCallDepth(subject, sink);
  CheckSpindleSpeed(subject, sink);
  CheckCompensation(subject, sink);
  CheckFrameArcs(subject, sink);
  CheckScaleArcs(subject, sink);
  CheckMachineWords(subject, sink);
}

}  // namespace ncport::check
