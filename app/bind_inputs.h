// What comparison varies: the parameters and letters of the called programs and the cells that an operator sets, each
// with its places on both sides (contracts section 7, [ranges]).
#pragma once

#include <string_view>
#include <vector>

#include "app/pipeline.h"
#include "backends/common/translation.h"
#include "exec/run.h"
#include "prove/verify.h"

namespace ncport::app {

/// By name, with or without a leading O of numbered programs, upper and lower case alike; none: invalid.
ir::ProgramId FindByName(const ir::Module& module, std::string_view name);

class Binder {
 public:
  /// `run`: the run as it was asked for; its arguments are values seen.
  Binder(const ProgramSet& source, const backends::Translation& translation, const ir::Module& target,
         const dialects::Profile& target_profile, const dialects::Config* config, const exec::RunOptions& run)
      : source_(source.module),
        profile_(source.profile),
        translation_(translation),
        target_(target),
        target_profile_(target_profile),
        config_(config),
        run_(run),
        is_call_(source.module.programs[run.entry].kind == ir::ProgramKind::kSub) {}

  /// Parameters and letters of the programs that the entry calls, or of the entry itself when it is a subprogram.
  std::vector<prove::BoundInput> Arguments();
  /// Cells that the source reads before anything writes them: the operator's inputs.
  void Cells(const ir::Machine& machine, std::vector<prove::BoundInput>& inputs);
  /// Ends of ranges that are other inputs. A name that is none of them is a finding.
  bool Relate(std::vector<prove::BoundInput>& inputs, diag::Sink& sink) const;
  /// Branches that ask whether a letter was given that every call gives, where the translation takes that for granted:
  /// one of their ways cannot be taken.
  [[nodiscard]] const std::vector<ir::BlockId>& DecidedBranches() const { return decided_; }

 private:
  void Parameters(ir::ProgramId callee, std::vector<prove::BoundInput>& inputs) const;
  void Letters(ir::ProgramId callee, std::vector<prove::BoundInput>& inputs);
  /// Places of the letter in the target; false: the value cannot be set there.
  bool LetterPlaces(ir::ProgramId callee, const prove::InputPlace& source, std::vector<prove::InputPlace>& places,
                    bool& may_miss) const;
  [[nodiscard]] std::vector<ir::ProgramId> ProgramsOfLevel(ir::ProgramId program) const;
  [[nodiscard]] std::vector<ir::BlockId> EmptinessTests(ir::ProgramId program, std::uint32_t cell) const;
  [[nodiscard]] std::vector<std::uint32_t> CellsReadAtEntry(ir::ProgramId program) const;
  [[nodiscard]] ir::SpaceId LevelSpace() const;
  /// Programs of the target that stand for this one or for a part of it.
  [[nodiscard]] std::vector<backends::ProgramName> PartsOf(ir::ProgramId program) const;
  void ApplyRange(prove::Input& input) const;

  const ir::Module& source_;
  const dialects::Profile& profile_;
  const backends::Translation& translation_;
  const ir::Module& target_;
  const dialects::Profile& target_profile_;
  const dialects::Config* config_;
  const exec::RunOptions& run_;
  const bool is_call_;
  std::vector<ir::CallId> calls_;  // of the entry
  std::vector<ir::BlockId> decided_;
};

}  // namespace ncport::app
