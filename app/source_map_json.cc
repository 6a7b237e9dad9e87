#include "app/source_map_json.h"

#include <nlohmann/json.hpp>

namespace ncport::app {

void AppendSourceMap(const Context& context, const ir::Module& module, const backends::OutputFile& file,
                     OutputSink& sink) {
  for (std::size_t i = 0; i < file.line_blocks.size(); ++i) {
    const ir::BlockId block = file.line_blocks[i];
    if (!block.Valid() || (module.blocks[block].flags & ir::Block::kAdded) != 0) continue;
    const SourceRange at = module.RangeOf(module.blocks[block]);
    if (!at.file.Valid() || at.line == 0) continue;
    nlohmann::ordered_json line{{"version", 1},
                                {"out", i + 1},
                                {"output", file.name},
                                {"file", context.files.Name(at.file)},
                                {"line", at.line},
                                {"calls", nlohmann::ordered_json::array()},
                                {"turns", nlohmann::ordered_json::array()}};
    (void)sink.Write(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
}

}  // namespace ncport::app
