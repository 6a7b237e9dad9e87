#include "check/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "base/near_name.h"
#include "ir/analysis/labels.h"

namespace ncport::check {
namespace {

using ir::BlockId;
using ir::Search;
using ir::TargetKind;

class LabelCheck {
 public:
  LabelCheck(const ir::Module& module, ir::ProgramId program, bool ignore_case, diag::Sink& sink)
      : module_(module),
        program_(program),
        labels_(module, program, ignore_case),
        ignore_case_(ignore_case),
        sink_(sink) {}

  void Run() {
    for (const BlockId block : module_.programs[program_].blocks) {
      for (const ir::WordId id : module_.blocks[block].words) {
        const ir::Word& word = module_.words[id];
        if (word.op == ir::WordOp::kJump) {
          CheckJump(word.Extra<ir::JumpId>(), block, id);
        } else if (word.op == ir::WordOp::kSwitch) {
          const ir::Switch& choice = module_.switches[word.Extra<ir::SwitchId>()];
          for (std::uint32_t arm = 0; arm < choice.arm_count; ++arm)
            CheckJump(module_.switch_arms[choice.first_arm + arm].jump, block, id);
        } else if (word.op == ir::WordOp::kRepeatPart) {
          const ir::Part& part = module_.parts[word.Extra<ir::PartId>()];
          CheckTarget(part.first, Search::kBackwardThenForward, block, id);
          if (part.has_last) CheckTarget(part.last, Search::kBackwardThenForward, block, id);
        }
      }
    }
  }

 private:
  void CheckJump(ir::JumpId id, BlockId block, ir::WordId word) {
    const ir::Jump& jump = module_.jumps[id];
    if (!jump.quiet) CheckTarget(jump.target, jump.search, block, word);
  }

  void CheckTarget(const ir::Target& target, Search search, BlockId block, ir::WordId word) {
    if (target.kind == TargetKind::kExpression || target.kind == TargetKind::kProgramStart) return;
    if (labels_.Find(target, block, search).Valid()) return;
    const std::string name = NameOf(target);
    if (MayBeRefused(name)) return;
    diag::Diagnostic& finding =
        sink_.Report(diag::Code::kUnknownLabel, module_.RangeOf(module_.blocks[block], module_.words[word]), name);
    const BlockId elsewhere = labels_.Find(target, block, Search::kForwardThenFromStart);
    if (elsewhere.Valid()) {
      finding.notes.push_back({module_.RangeOf(module_.blocks[elsewhere]), "it stands here"});
      finding.help = search == Search::kForward ? "this jump looks towards the end of the program only"
                                                : "this jump looks towards the start of the program only";
    } else if (target.kind == TargetKind::kLabel) {
      std::vector<std::string_view> names;
      for (const BlockId known : labels_.Targets()) {
        if (module_.blocks[known].label.Valid()) names.push_back(module_.View(module_.blocks[known].label));
      }
      if (const std::string_view near = NearName(name, names); !near.empty())
        finding.help = fmt::format("did you mean {}?", near);
    }
  }

  [[nodiscard]] std::string NameOf(const ir::Target& target) const {
    if (target.kind == TargetKind::kLabel) return std::string(module_.View(target.label));
    return fmt::format("{}{}", target.kind == TargetKind::kMainNumber ? ":" : "N", target.number);
  }

  /// A block that was not understood has its finding; the jump to it needs none.
  [[nodiscard]] bool MayBeRefused(std::string_view name) const {
    const auto same = [this](char a, char b) {
      if (!ignore_case_) return a == b;
      return std::toupper(static_cast<unsigned char>(a)) == std::toupper(static_cast<unsigned char>(b));
    };
    for (const BlockId id : module_.programs[program_].blocks) {
      const ir::Block& block = module_.blocks[id];
      if ((block.flags & ir::Block::kRefused) == 0) continue;
      for (const ir::WordId word : block.words) {
        if (module_.words[word].op != ir::WordOp::kVerbatim) continue;
        const std::string_view text = module_.View(module_.words[word].Extra<StringId>());
        if (std::search(text.begin(), text.end(), name.begin(), name.end(), same) != text.end()) return true;
      }
    }
    return false;
  }

  const ir::Module& module_;
  ir::ProgramId program_;
  ir::analysis::LabelTable labels_;
  bool ignore_case_;
  diag::Sink& sink_;
};

}  // namespace

void CheckLabels(const ir::Module& module, ir::ProgramId program, bool ignore_case, diag::Sink& sink) {
  LabelCheck{module, program, ignore_case, sink}.Run();
}

}  // namespace ncport::check
