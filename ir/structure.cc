#include "ir/structure.h"

#include <fmt/core.h>

#include <array>
#include <string>
#include <vector>

#include "base/result.h"

namespace ncport::ir {

namespace {

enum class Role : std::uint8_t { kOpen, kMiddle, kClose };

struct Mark {
  Role role;
  std::uint8_t kind;  // If, While, Loop, Repeat, For: 0 to 4
};

constexpr std::uint8_t kKinds = 5;
constexpr std::size_t kMostMatched = 16;   // wrong ends that are matched with openers: a slip, no other language
constexpr std::uint8_t kAnyNumber = 0xFF;  // DO number of a mark that could not be read
constexpr WordOp kOpeners[kKinds] = {WordOp::kIf, WordOp::kWhile, WordOp::kLoop, WordOp::kRepeat, WordOp::kFor};
constexpr WordOp kClosers[kKinds] = {WordOp::kEndIf, WordOp::kEndWhile, WordOp::kEndLoop, WordOp::kUntil,
                                     WordOp::kEndFor};

Mark MarkOf(WordOp op) {
  if (op == WordOp::kElse) return {Role::kMiddle, 0};
  for (std::uint8_t kind = 0; kind < kKinds; ++kind) {
    if (op == kOpeners[kind]) return {Role::kOpen, kind};
    if (op == kClosers[kind]) return {Role::kClose, kind};
  }
  NCPORT_BUG("{} is no structure mark", NameOf(op));
}

class Builder {
 public:
  using MarkName = std::string_view (*)(WordOp);
  Builder(Module& module, ProgramId program, std::uint32_t max_depth, diag::Sink& sink, MarkName mark_name)
      : module_(module), program_(program), max_depth_(max_depth), sink_(sink), mark_name_(mark_name) {}

  void Run() {
    for (const BlockId id : module_.programs[program_].blocks) {
      const WordId mark = FindMark(module_.blocks[id]);
      if (!mark.Valid()) continue;
      module_.blocks[id].link = {};
      const Mark kind = MarkOf(OpOf(module_.words[mark]));
      switch (kind.role) {
        case Role::kOpen:
          Open(id, mark, kind.kind);
          break;
        case Role::kMiddle:
          Middle(id, mark);
          break;
        case Role::kClose:
          Close(id, mark, kind.kind);
          break;
      }
    }
    while (!open_.empty()) DropTop({}, {});
    for (const StrayEnd& stray : strays_) ReportStray(stray);
    for (const DroppedOfKey& list : dropped_) {
      for (const Dropped& entry : list.entries) ReportUnclosed(entry);
    }
  }

 private:
  struct Opener {
    BlockId block;
    WordId word;
    BlockId middle;  // the Else
    std::uint32_t key = 0;
  };
  /// An opener that a mark of another structure ended before its own end came.
  struct Dropped {
    BlockId block;
    WordId word;
    BlockId ended_by;  // none: the end of the program
    WordId ended_by_word;
  };

  struct StrayEnd {
    BlockId block;
    WordId word;
    std::uint8_t kind;
  };

  [[nodiscard]] WordId FindMark(const Block& block) const {
    for (const WordId id : block.words) {
      if (IsStructureMark(OpOf(module_.words[id]))) return id;
    }
    return {};
  }

  /// A mark that the frontend could not read is a Verbatim that says which mark it would be.
  static WordOp OpOf(const Word& word) {
    return word.op == WordOp::kVerbatim ? static_cast<WordOp>(word.index) : word.op;
  }
  static std::uint8_t DoNumberOf(const Word& word) { return word.op == WordOp::kVerbatim ? kAnyNumber : word.index; }

  /// Marks fit together when kind and DO number agree. The number of a mark that could not be read fits every other.
  [[nodiscard]] std::uint32_t KeyOf(WordId word, std::uint8_t kind) const {
    return static_cast<std::uint32_t>(kind) << 8U | DoNumberOf(module_.words[word]);
  }
  /// The key of the innermost open structure that a mark of `key` belongs to; `key` itself if there is none.
  [[nodiscard]] std::uint32_t OpenKeyFor(std::uint32_t key) const {
    if (counts_[key] != 0) return key;
    const std::uint32_t kind = key >> 8U;
    if ((key & 0xFFU) != kAnyNumber) return counts_[key | kAnyNumber] != 0 ? key | kAnyNumber : key;
    if (kind_counts_[kind] == 0) return key;
    for (std::size_t at = open_.size(); at-- > 0;) {
      if (open_[at].key >> 8U == kind) return open_[at].key;
    }
    return key;
  }

  void Open(BlockId block, WordId word, std::uint8_t kind) {
    const std::uint32_t key = KeyOf(word, kind);
    open_.push_back({block, word, {}, key});
    ++counts_[key];
    ++kind_counts_[kind];
    if (max_depth_ != 0 && open_.size() == max_depth_ + 1) {
      auto& finding = sink_.Report(diag::Code::kNestingLimit, RangeOf(block, word), TextOf(word), max_depth_);
      const Opener& outermost = open_.front();
      finding.notes.push_back({RangeOf(outermost.block, outermost.word), "the outermost one opens here"});
      Refuse(block);
    }
  }

  void Middle(BlockId block, WordId word) {
    const std::uint32_t key = OpenKeyFor(KeyOf(word, 0));
    if (counts_[key] == 0) {
      Stray(block, word, 0);
      return;
    }
    DropTo(key, block, word);
    Opener& opener = open_.back();
    if (opener.middle.Valid()) {
      auto& finding = Stray(block, word, 0);
      const Block& first = module_.blocks[opener.middle];
      finding.notes.push_back({RangeOf(opener.middle, FindMark(first)), "the first one stands here"});
      return;
    }
    opener.middle = block;
    module_.blocks[opener.block].link = block;
  }

  void Close(BlockId block, WordId word, std::uint8_t kind) {
    const std::uint32_t key = OpenKeyFor(KeyOf(word, kind));
    if (counts_[key] == 0) {
      CloseWithoutOpener(block, word, kind, key);
      return;
    }
    DropTo(key, block, word);
    const Opener opener = open_.back();
    Pop();
    module_.blocks[block].link = opener.block;
    if (opener.middle.Valid()) {
      module_.blocks[opener.middle].link = block;
    } else {
      module_.blocks[opener.block].link = block;
    }
  }

  void CloseWithoutOpener(BlockId block, WordId word, std::uint8_t kind, std::uint32_t key) {
    auto* const dropped = FindDropped(key);
    if (dropped == nullptr) {
      strays_.push_back({block, word, kind});
      return;
    }
    // The opener is there, but a mark between ended it: one finding for the crossing, at the mark that crosses.
    const Dropped entry = dropped->back();
    dropped->pop_back();
    auto& finding = sink_.Report(diag::Code::kCrossedStructure, RangeOf(entry.ended_by, entry.ended_by_word),
                                 TextOf(entry.ended_by_word), TextOf(entry.word));
    finding.notes.push_back({RangeOf(entry.block, entry.word), fmt::format("{} opens here", TextOf(entry.word))});
    finding.notes.push_back({RangeOf(block, word), fmt::format("its {} stands here", TextOf(word))});
    Refuse(entry.ended_by);
    Refuse(entry.block);
    Refuse(block);
  }

  /// Takes structures off until the innermost one of `key` is on top. Each goes once: linear.
  void DropTo(std::uint32_t key, BlockId ended_by, WordId ended_by_word) {
    while (open_.back().key != key) DropTop(ended_by, ended_by_word);
  }

  void DropTop(BlockId ended_by, WordId ended_by_word) {
    const Opener opener = open_.back();
    Pop();
    Block& block = module_.blocks[opener.block];
    block.link = {};
    Refuse(opener.block);
    if (opener.middle.Valid()) Refuse(opener.middle);
    DroppedOf(opener.key).push_back({opener.block, opener.word, ended_by, ended_by_word});
  }

  void Pop() {
    const std::uint32_t key = open_.back().key;
    --counts_[key];
    --kind_counts_[key >> 8U];
    open_.pop_back();
  }

  diag::Diagnostic& Stray(BlockId block, WordId word, std::uint8_t kind) {
    Refuse(block);
    return sink_.Report(diag::Code::kStrayStructureEnd, RangeOf(block, word), TextOf(word),
                        TextOfOp(kOpeners[kind], module_.words[word]));
  }

  /// An end without its opener. Where an opener before it has no end either, the end word is the wrong one: one finding
  /// for both.
  void ReportStray(const StrayEnd& stray) {
    auto& finding = Stray(stray.block, stray.word, stray.kind);
    DroppedOfKey* list = nullptr;  // of the nearest such opener
    std::size_t at = 0;
    for (DroppedOfKey& candidate : dropped_) {
      if (strays_.size() > kMostMatched) break;
      for (std::size_t i = 0; i < candidate.entries.size(); ++i) {
        const Dropped& entry = candidate.entries[i];
        if (!(entry.block < stray.block) || module_.words[entry.word].op == WordOp::kVerbatim) continue;
        if (list != nullptr && entry.block < list->entries[at].block) continue;
        list = &candidate;
        at = i;
      }
    }
    if (list == nullptr) return;
    const Dropped entry = list->entries[at];
    list->entries.erase(list->entries.begin() + static_cast<std::ptrdiff_t>(at));
    const Word& opener = module_.words[entry.word];
    const std::string end = TextOfOp(kClosers[MarkOf(OpOf(opener)).kind], opener);
    finding.notes.push_back(
        {RangeOf(entry.block, entry.word), fmt::format("{} opens here and has no {}", TextOf(entry.word), end)});
    finding.help = fmt::format("did you mean {}?", end);
  }

  void ReportUnclosed(const Dropped& entry) {
    // A mark that the frontend refused has its finding already.
    if (module_.words[entry.word].op == WordOp::kVerbatim) return;
    const Word& word = module_.words[entry.word];
    const Mark kind = MarkOf(OpOf(word));
    auto& finding = sink_.Report(diag::Code::kUnclosedStructure, RangeOf(entry.block, entry.word), TextOf(entry.word),
                                 TextOfOp(kClosers[kind.kind], word));
    if (entry.ended_by.Valid()) {
      finding.notes.push_back({RangeOf(entry.ended_by, entry.ended_by_word),
                               fmt::format("{} ends the structure around it", TextOf(entry.ended_by_word))});
    }
  }

  [[nodiscard]] std::string TextOf(WordId id) const {
    const Word& word = module_.words[id];
    return Decorate(word, word.spelling < module_.spellings.size() ? module_.View(module_.spellings[word.spelling].text)
                                                                   : std::string_view{});
  }

  [[nodiscard]] std::string Decorate(const Word& word, std::string_view spelling) const {
    return WithNumber(spelling.empty() ? MarkNameOf(OpOf(word)) : spelling, word);
  }
  [[nodiscard]] std::string_view MarkNameOf(WordOp op) const {
    return mark_name_ != nullptr ? mark_name_(op) : NameOf(op);
  }
  static std::string WithNumber(std::string_view text, const Word& word) {
    const std::uint8_t number = DoNumberOf(word);
    return number == 0 || number == kAnyNumber ? std::string(text) : fmt::format("{} {}", text, number);
  }

  /// How the language of this program calls `op`: as some word of the program is spelled. Only for findings.
  [[nodiscard]] std::string TextOfOp(WordOp op, const Word& partner) {
    auto& known = op_texts_[static_cast<std::size_t>(op)];
    if (known.empty()) {
      known = MarkNameOf(op);
      for (const BlockId block : module_.programs[program_].blocks) {
        const WordId mark = FindMark(module_.blocks[block]);
        if (!mark.Valid() || module_.words[mark].op != op) continue;
        const std::uint16_t spelling = module_.words[mark].spelling;
        if (spelling == 0 || spelling >= module_.spellings.size()) continue;
        known = module_.View(module_.spellings[spelling].text);
        break;
      }
    }
    return WithNumber(known, partner);
  }

  [[nodiscard]] SourceRange RangeOf(BlockId block, WordId word) const {
    return module_.RangeOf(module_.blocks[block], module_.words[word]);
  }

  void Refuse(BlockId block) { module_.blocks[block].flags |= Block::kRefused; }

  // Wrong structures are rare and their kinds few: a short list, searched.
  struct DroppedOfKey {
    std::uint32_t key;
    std::vector<Dropped> entries;
  };
  std::vector<Dropped>* FindDropped(std::uint32_t key) {
    for (DroppedOfKey& list : dropped_) {
      if (list.key == key && !list.entries.empty()) return &list.entries;
    }
    return nullptr;
  }
  std::vector<Dropped>& DroppedOf(std::uint32_t key) {
    for (DroppedOfKey& list : dropped_) {
      if (list.key == key) return list.entries;
    }
    dropped_.push_back({key, {}});
    return dropped_.back().entries;
  }

  Module& module_;
  ProgramId program_;
  std::uint32_t max_depth_;
  diag::Sink& sink_;
  MarkName mark_name_;
  std::vector<Opener> open_;
  std::array<std::uint32_t, kKinds * 256> counts_{};  // open structures per key
  std::array<std::uint32_t, kKinds> kind_counts_{};   // and per kind
  std::vector<DroppedOfKey> dropped_;
  std::vector<StrayEnd> strays_;
  std::array<std::string, 256> op_texts_;
};

}  // namespace

void BuildStructure(Module& module, ProgramId program, std::uint32_t max_depth, diag::Sink& sink,
                    std::string_view (*mark_name)(WordOp)) {
  Builder{module, program, max_depth, sink, mark_name}.Run();
}

}  // namespace ncport::ir
