#include "backends/common/aux_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "ir/block_words.h"
#include "ir/literal_value.h"

namespace ncport::backends {

namespace {

using dialects::MCodeRule;
using ir::Word;
using ir::WordOp;

const MCodeRule* FindRule(const std::vector<MCodeRule>& rules, std::string_view source) {
  const auto rule = std::ranges::find(rules, source, &MCodeRule::source);
  return rule == rules.end() ? nullptr : &*rule;
}

const MCodeRule* FindRule(const dialects::Profile& profile, const dialects::Config* config, std::string_view source) {
  const MCodeRule* rule = config != nullptr ? FindRule(config->mcodes, source) : nullptr;
  return rule != nullptr ? rule : FindRule(profile.mcodes, source);
}

}  // namespace

bool MapAuxiliaries(const dialects::Profile& profile, const dialects::Config* config, const WriteAux& write,
                    Translation& out, diag::Sink& sink) {
  ir::Module& module = out.module;
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const ir::BlockId id : module.programs[program].blocks) {
      const ir::Block block = module.blocks[id];
      std::vector<Word> kept;
      bool changed = false;
      for (const ir::WordId word_id : block.words) {
        Word word = module.words[word_id];
        if (word.op != WordOp::kAux) {
          kept.push_back(word);
          continue;
        }
        const auto number = ir::WholeNumber(module, word.value);
        const bool common = number && (*number == 7 || *number == 8 || *number == 9);
        const std::string name = number ? fmt::format("M{}", *number) : std::string("a computed M function");
        const MCodeRule* rule = number ? FindRule(profile, config, name) : nullptr;
        if (rule == nullptr && !common) {
          sink.Report(diag::Code::kUnmappedCode, module.RangeOf(block, word), name).help =
              fmt::format("add to ncport.toml:  [mcodes]  \"{0}\" = \"{0}\"  (pass), another word, or \"drop\"", name);
          ok = false;
          continue;
        }
        AuxUse use{*number, *number};
        if (rule != nullptr && rule->target == "drop") {
          use.target.reset();
          out.losses.push_back({module.RangeOf(block, word), name + " left out, as [mcodes] says", true});
        } else if (rule != nullptr) {
          if (const auto written = write(module, word, rule->target)) {
            use.target = written;
          } else {
            ok = false;
            sink.Report(diag::Code::kUnmappedCode, module.RangeOf(block, word), name).help =
                "the target of [mcodes] is one M function here";
          }
        }
        changed = changed || rule != nullptr;
        if (use.target) kept.push_back(word);
        out.aux.push_back(use);
      }
      if (changed) SetWords(module, module.blocks[id], kept);
    }
  }
  return ok;
}

}  // namespace ncport::backends
