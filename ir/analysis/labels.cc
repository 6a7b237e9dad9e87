#include "ir/analysis/labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/letter_case.h"

namespace ncport::ir::analysis {

namespace {

std::uint64_t NumberKey(std::uint32_t number, bool main_block) {
  return static_cast<std::uint64_t>(number) | (main_block ? std::uint64_t{1} << 32U : 0U);
}

}  // namespace

LabelTable::LabelTable(const Module& module, ProgramId program, bool ignore_case)
    : module_(module), blocks_(module.programs[program].blocks), ignore_case_(ignore_case) {
  for (const BlockId id : blocks_) {
    const Block& block = module.blocks[id];
    const bool labelled = block.label.Valid();
    const bool numbered = block.number != Block::kNoNumber;
    if (labelled) labels_[Key(module.View(block.label))].push_back(id);
    if (numbered) numbers_[NumberKey(block.number, (block.flags & Block::kMainBlock) != 0)].push_back(id);
    if (labelled || numbered) targets_.push_back(id);
  }
}

BlockId LabelTable::Find(const Target& target, BlockId from, Search search, std::uint16_t skip_levels) const {
  switch (target.kind) {
    case TargetKind::kLabel:
      return FindLabel(module_.View(target.label), from, search, skip_levels);
    case TargetKind::kNumber:
      return FindNumber(target.number, false, from, search, skip_levels);
    case TargetKind::kMainNumber:
      return FindNumber(target.number, true, from, search, skip_levels);
    case TargetKind::kProgramStart:
      return blocks_.Empty() ? BlockId{} : blocks_[0];
    case TargetKind::kExpression:
      break;
  }
  if (!module_.exprs.Contains(target.expr)) return {};
  const Expr& expr = module_.exprs[target.expr];
  if (expr.op == ExprOp::kText) {
    StringId text;
    text.value = expr.a;
    return FindText(module_.View(text), from, search, skip_levels);
  }
  if (expr.op != ExprOp::kLiteral) return {};
  const double number = std::round(expr.number);  // as a run does it
  if (!(number >= 0 && number < std::numeric_limits<std::uint32_t>::max())) return {};
  return FindNumber(static_cast<std::uint32_t>(number), false, from, search, skip_levels);
}

/// A text holds a label, or a block number as it is written: N30, 30, :30.
BlockId LabelTable::FindText(std::string_view text, BlockId from, Search search, std::uint16_t skip_levels) const {
  const BlockId found = FindLabel(text, from, search, skip_levels);
  if (found.Valid() || text.empty()) return found;
  const bool main_block = text.front() == ':';
  const std::string_view digits = text.substr(main_block || text.front() == 'N' || text.front() == 'n' ? 1 : 0);
  constexpr std::size_t kMostDigits = 9;
  if (digits.empty() || digits.size() > kMostDigits) return {};
  std::uint32_t number = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return {};
    number = number * 10 + static_cast<std::uint32_t>(digit - '0');
  }
  return FindNumber(number, main_block, from, search, skip_levels);
}

BlockId LabelTable::FindLabel(std::string_view label, BlockId from, Search search, std::uint16_t skip_levels) const {
  return Nearest(LabelPlaces(label), from, search, skip_levels);
}

BlockId LabelTable::FindNumber(std::uint32_t number, bool main_block, BlockId from, Search search,
                               std::uint16_t skip_levels) const {
  const auto found = numbers_.find(NumberKey(number, main_block));
  return Nearest(found == numbers_.end() ? nullptr : &found->second, from, search, skip_levels);
}

std::optional<LabelTable::Range> LabelTable::FindPart(const Part& part, BlockId from, std::uint16_t skip_levels) const {
  const BlockId first = Find(part.first, from, Search::kBackwardThenForward, skip_levels);
  if (!first.Valid()) return std::nullopt;
  BlockId last = first;
  if (part.has_last) {
    // The end may stand in the block of the start: the search begins one block before it.
    const BlockId before = first.value == 0 ? BlockId{} : BlockId{std::size_t{first.value} - 1};
    last = Find(part.last, before, Search::kForward, skip_levels);
    if (!last.Valid()) return std::nullopt;
  } else if (!part.single) {
    if (first >= from) return std::nullopt;
    last = BlockId{std::size_t{from.value} - 1};
    if (part.last.label.Valid()) {
      const BlockId before = first.value == 0 ? BlockId{} : BlockId{std::size_t{first.value} - 1};
      const BlockId end = Find(part.last, before, Search::kForward, skip_levels);
      if (end.Valid() && end < from) last = end;
    }
  }
  if (first <= from && from <= last) return std::nullopt;
  return Range{first, last};
}

std::string LabelTable::Key(std::string_view label) const { return ignore_case_ ? LowerOf(label) : std::string(label); }

const LabelTable::Places* LabelTable::LabelPlaces(std::string_view label) const {
  const auto found = labels_.find(Key(label));
  return found == labels_.end() ? nullptr : &found->second;
}

bool LabelTable::Visible(BlockId block, std::uint16_t skip_levels) const {
  const std::uint8_t level = module_.blocks[block].skip_level;
  return level >= 16 || (skip_levels >> level & 1U) == 0;
}

BlockId LabelTable::Nearest(const Places* places, BlockId from, Search search, std::uint16_t skip_levels) const {
  if (places == nullptr) return {};
  // Without a start block (the search of a part's end from the first block of all) everything lies ahead.
  const auto ahead = from.Valid() ? std::upper_bound(places->begin(), places->end(), from) : places->begin();
  const auto visible = [&](BlockId block) { return Visible(block, skip_levels); };
  const auto downward = [&](auto begin, auto end) {
    const auto hit = std::find_if(begin, end, visible);
    return hit == end ? BlockId{} : *hit;
  };
  const auto forward = [&] { return downward(ahead, places->end()); };
  // The jump block itself counts as behind: its own label is the nearest one.
  const auto backward = [&] {
    for (auto it = ahead; it != places->begin();) {
      if (visible(*--it)) return *it;
    }
    return BlockId{};
  };
  const auto either = [](BlockId first, auto second) { return first.Valid() ? first : second(); };
  switch (search) {
    case Search::kForward:
      return forward();
    case Search::kBackward:
      return backward();
    case Search::kForwardThenBackward:
      return either(forward(), backward);
    case Search::kForwardThenFromStart:
      return either(forward(), [&] { return downward(places->begin(), ahead); });
    case Search::kBackwardThenForward:
      return either(backward(), forward);
  }
  return {};
}

}  // namespace ncport::ir::analysis
