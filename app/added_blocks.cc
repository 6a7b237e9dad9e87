#include "app/added_blocks.h"

#include <charconv>
#include <string_view>

#include "backends/fanuc/print.h"

namespace ncport::app {
namespace {

// Of the SINUMERIK writer: the comment of the block itself.
constexpr std::string_view kOwnMark = "added: ";

std::string_view WithoutBlanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

}  // namespace

void MarkAddedBlocks(ir::Module& module, dialects::Language language) {
  constexpr std::string_view kAnnounced = backends::fanuc::kAddedMark;
  for (const ir::ProgramId program : module.programs.Ids()) {
    std::uint32_t announced = 0;  // blocks that a mark before them counts
    for (const ir::BlockId id : module.programs[program].blocks) {
      ir::Block& block = module.blocks[id];
      bool added = announced > 0;
      if (added) --announced;
      for (const ir::CommentId comment : block.comments) {
        const std::string_view text = WithoutBlanks(module.View(module.comments[comment].text));
        if (language == dialects::Language::kFanuc && text.starts_with(kAnnounced)) {
          const std::string_view count = text.substr(kAnnounced.size());
          static_cast<void>(std::from_chars(count.data(), count.data() + count.size(), announced));
        } else if (language == dialects::Language::kSinumerik && text.starts_with(kOwnMark)) {
          added = true;
        }
      }
      if (added) block.flags = static_cast<std::uint8_t>(block.flags | ir::Block::kAdded);
    }
  }
}

}  // namespace ncport::app
