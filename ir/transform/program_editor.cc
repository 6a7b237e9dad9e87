#include "ir/transform/program_editor.h"

#include <algorithm>
#include <utility>

#include "base/result.h"
#include "ir/block_words.h"
#include "ir/structure.h"

namespace ncport::ir::transform {

namespace {

void TakeSkipLevel(const Block& from, Block& to) {
  to.skip_level = from.skip_level;
  to.flags = static_cast<std::uint8_t>((to.flags & ~Block::kSkipDigit) | (from.flags & Block::kSkipDigit));
}

}  // namespace

ProgramEditor::ProgramEditor(Module& module, ProgramId program, std::string_view pass)
    : module_(module), program_(program), pass_(module.strings.Intern(pass)) {}

Block ProgramEditor::MakeBlock(BlockId near) {
  Origin origin;
  if (near.Valid()) {
    const OriginId via = module_.blocks[near].origin;
    if (via.Valid()) {
      origin = module_.origins[via];
      origin.via = via;
    }
  }
  origin.pass = pass_;
  Block block;
  block.origin = module_.origins.Add(origin);
  if (near.Valid()) block.indent = module_.blocks[near].indent;
  return block;
}

void ProgramEditor::SetWords(Block& block, const std::vector<Word>& words) { ir::SetWords(module_, block, words); }

void ProgramEditor::TakeHead(Block& made, BlockId place, HeadRule rule) {
  Block& from = module_.blocks[place];
  made.label = std::exchange(from.label, StringId{});
  made.number = std::exchange(from.number, Block::kNoNumber);
  made.number_digits = std::exchange(from.number_digits, std::uint8_t{0});
  made.flags = static_cast<std::uint8_t>((made.flags & ~Block::kMainBlock) | (from.flags & Block::kMainBlock));
  from.flags = static_cast<std::uint8_t>(from.flags & ~Block::kMainBlock);
  if (rule.comments) made.comments = std::exchange(from.comments, {});
  if (rule.skip) TakeSkipLevel(from, made);
}

void ProgramEditor::PutInFront(BlockId place, const std::vector<Word>& words, HeadRule rule) {
  Block made = MakeBlock(place);
  made.flags = static_cast<std::uint8_t>(module_.blocks[place].flags & (Block::kAdded | Block::kRefused));
  TakeHead(made, place, rule);
  SetWords(made, words);
  InsertBefore(place, made);
}

void ProgramEditor::PutBehind(BlockId place, const std::vector<Word>& words) {
  const Block& from = module_.blocks[place];
  Block made = MakeBlock(place);
  made.flags = static_cast<std::uint8_t>(from.flags & (Block::kAdded | Block::kRefused));
  TakeSkipLevel(from, made);
  SetWords(made, words);
  InsertAfter(place, made);
}

void ProgramEditor::Remove(BlockId place) { edits_.push_back({place, Where::kAt, {}}); }

namespace {

/// Gives `to` the comments of `from` in front of its own.
void MoveComments(Module& module, const Block& from, Block& to) {
  if (from.comments.Empty()) return;
  IdRange<CommentId> joined{static_cast<std::uint32_t>(module.comments.Size()),
                            from.comments.count + to.comments.count};
  for (const CommentId id : from.comments) {
    Comment comment = module.comments[id];
    comment.word = 0;
    if (comment.place == CommentPlace::kBeforeWord && to.words.Empty()) comment.place = CommentPlace::kEndOfBlock;
    module.comments.Add(comment);
  }
  for (const CommentId id : to.comments) {
    const Comment comment = module.comments[id];
    module.comments.Add(comment);
  }
  to.comments = joined;
}

bool MarksPlace(const Block& block) { return block.label.Valid() || block.number != Block::kNoNumber; }

}  // namespace

void ProgramEditor::Apply() {
  if (edits_.empty()) return;
  std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) {
    return a.place != b.place ? a.place.value < b.place.value : a.where < b.where;
  });
  const IdRange<BlockId> old = module_.programs[program_].blocks;
  std::vector<Block> blocks;
  blocks.reserve(old.count + edits_.size());
  std::vector<Block> homeless;  // removed blocks whose comments or marks wait for the next block
  const auto settle = [&](Block block) {
    for (auto waiting = homeless.rbegin(); waiting != homeless.rend(); ++waiting) {
      MoveComments(module_, *waiting, block);
      if (waiting->label.Valid() && !block.label.Valid()) block.label = waiting->label;
      if (waiting->number != Block::kNoNumber && block.number == Block::kNoNumber) {
        block.number = waiting->number;
        block.number_digits = waiting->number_digits;
        block.flags = static_cast<std::uint8_t>(block.flags | (waiting->flags & Block::kMainBlock));
      }
    }
    homeless.clear();
    blocks.push_back(block);
  };
  std::size_t next = 0;
  for (const BlockId id : old) {
    const std::size_t first = next;
    while (next < edits_.size() && edits_[next].place == id) ++next;
    bool removed = false;
    for (std::size_t i = first; i < next; ++i) {
      if (edits_[i].where == Where::kBefore) settle(edits_[i].block);
      removed = removed || edits_[i].where == Where::kAt;
    }
    Block block = module_.blocks[id];
    if (removed) {
      // What cannot move on stays as an empty block: a mark on top of a mark, or a comment line of its own.
      const bool crowded = MarksPlace(block) && std::any_of(homeless.begin(), homeless.end(), MarksPlace);
      block.words = {};
      if (crowded) {
        settle(block);
      } else if (MarksPlace(block) || !block.comments.Empty()) {
        homeless.push_back(block);
      }
    } else {
      if (!homeless.empty() && MarksPlace(block) && std::any_of(homeless.begin(), homeless.end(), MarksPlace)) {
        std::vector<Block> waiting;
        waiting.swap(homeless);
        for (Block& keep : waiting) blocks.push_back(keep);
      }
      settle(block);
    }
    for (std::size_t i = first; i < next; ++i) {
      if (edits_[i].where == Where::kAfter) settle(edits_[i].block);
    }
  }
  for (Block& keep : homeless) blocks.push_back(keep);
  NCPORT_CHECK(next == edits_.size(), "an edit names a block outside of its program");

  const IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()),
                               static_cast<std::uint32_t>(blocks.size())};
  for (Block& block : blocks) {
    block.link = {};
    module_.blocks.Add(block);
  }
  module_.programs[program_].blocks = range;
  diag::Sink sink;
  BuildStructure(module_, program_, 0, sink);
  NCPORT_CHECK(!sink.HasErrors(), "the pass {} left structure marks that do not nest", module_.View(pass_));
  edits_.clear();
}

}  // namespace ncport::ir::transform
