// Inserts, replaces and removes blocks of one program. Passes collect their edits here and apply them once, so that ids
// of blocks stay valid while a pass looks around, and growth is linear however many edits there are.
#pragma once

#include <string_view>
#include <vector>

#include "ir/module.h"

namespace ncport::ir::transform {

/// What a block made in front of another takes over besides the marks that jumps look for.
struct HeadRule {
  bool comments = false;  // they move too, as from a block that is going to be removed; else they stay with its words
  bool skip = true;       // false: it runs even where the other block is skipped (a value that both ways need)
};

class ProgramEditor {
 public:
  /// `pass`: stands in the origin of every block that the pass makes.
  ProgramEditor(Module& module, ProgramId program, std::string_view pass);

  /// A new block without words whose origin leads to `near` (its place in the source). Fill it, then insert it.
  Block MakeBlock(BlockId near);
  /// Puts `words` behind each other in the word store and gives the block their range.
  void SetWords(Block& block, const std::vector<Word>& words);
  void SetWords(BlockId place, const std::vector<Word>& words) { SetWords(module_.blocks[place], words); }

  /// Gives `made`, which is going to stand in front of `place`, the head of that block: label and block number (`:10`
  /// stays `:10`) move, so that a jump to the block runs `made` too; the skip level is the same on both, so that a run
  /// skips both or neither. A second block in front of the same place finds no label or number left to take.
  void TakeHead(Block& made, BlockId place, HeadRule rule = {});
  /// Puts a block of these words in front of `place`, with its head and, as it says the same, Block::kAdded, kRefused.
  void PutInFront(BlockId place, const std::vector<Word>& words, HeadRule rule = {});
  /// Puts a block of these words behind `place`: the head stays, skip level and flags are the same.
  void PutBehind(BlockId place, const std::vector<Word>& words);

  /// Blocks inserted at one place keep the order of the calls.
  void InsertBefore(BlockId place, const Block& block) { edits_.push_back({place, Where::kBefore, block}); }
  void InsertAfter(BlockId place, const Block& block) { edits_.push_back({place, Where::kAfter, block}); }
  /// Takes the block out. Its comments go to the next block that stays, a label or number that
  /// it carries too, when that block has none; otherwise the block stays as an empty one.
  void Remove(BlockId place);
  [[nodiscard]] bool Changed() const { return !edits_.empty(); }

  /// Builds the program anew at the end of the block store and joins its structure marks again.
  void Apply();

 private:
  enum class Where : std::uint8_t { kBefore, kAt, kAfter };
  struct Edit {
    BlockId place;
    Where where;
    Block block;  // kAt: unused, the block is removed
  };

  Module& module_;
  ProgramId program_;
  StringId pass_;
  std::vector<Edit> edits_;
};

}  // namespace ncport::ir::transform
