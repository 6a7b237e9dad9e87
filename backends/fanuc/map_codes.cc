#include "backends/fanuc/map_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "backends/common/aux_codes.h"
#include "backends/fanuc/text_word.h"
#include "backends/fanuc/tool_words.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::BlockId;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;

}  // namespace

bool MapWorkOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Block block = module.blocks[id];
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        if (word.op != WordOp::kWorkOffset) continue;
        OffsetUse use{word.extra, 0, word.extra, 0};
        // Number 0 is none, which the source writes as G500; G0 is a rapid.
        const std::string name = word.extra == 0 ? std::string("G500") : fmt::format("G{}", word.extra);
        const dialects::WordMapping* mapping = input.config == nullptr ? nullptr : input.config->FindOffset(name);
        if (mapping == nullptr && input.config != nullptr && word.extra == 0) mapping = input.config->FindOffset("G0");
        if (mapping != nullptr) {
          use.target = NumberBehind(mapping->target, 'G');
          use.target_extension = NumberBehind(mapping->target, 'P');
          module.words[word_id] = TextWord(module, mapping->target);
        } else if (word.extra < 54 || word.extra > 59) {
          auto& finding = sink.Report(diag::Code::kUnmappedOffset, module.RangeOf(block, word),
                                      word.extra == 0 ? std::string("none (G500)") : name);
          finding.help = fmt::format("add to ncport.toml:  [offsets]  \"{}\" = \"G54.1 P1\"", name);
          ok = false;
          continue;
        }
        const auto known = std::find_if(out.offsets.begin(), out.offsets.end(),
                                        [&](const OffsetUse& other) { return other.source == use.source; });
        if (known == out.offsets.end()) out.offsets.push_back(use);
      }
    }
  }
  return ok;
}

bool MapAuxiliaries(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const auto write = [](Module& module, Word& word, const std::string& target) -> std::optional<std::uint32_t> {
    const ir::Phase phase = word.phase;  // before or after the motion, as in the source
    word = TextWord(module, target);
    word.phase = phase;
    return NumberBehind(target, 'M');
  };
  return backends::MapAuxiliaries(*input.profile, input.config, write, out, sink);
}

}  // namespace ncport::backends::fanuc
