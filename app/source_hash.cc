#include "app/source_hash.h"

#include <set>

namespace ncport::app {

std::uint64_t HashOf(const SourceFiles& sources, const ir::Module& module) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  std::set<std::uint32_t> files;
  for (const ir::Program& program : module.programs.All()) {
    if (program.file.Valid() && !program.library) files.insert(program.file.value);
  }
  for (const std::uint32_t file : files) {
    const std::uint32_t count = sources.LineCount(FileId{file});
    for (std::uint32_t line = 1; line <= count; ++line) {
      for (const char c : sources.Line(FileId{file}, line))
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
      hash = (hash ^ 0x0AU) * 0x100000001B3ULL;
    }
  }
  return hash;
}

}  // namespace ncport::app
