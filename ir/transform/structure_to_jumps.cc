// One pass over the blocks in their order: marks, jumps, cases and repeated parts become jumps between the same places,
// and a place gets its number when the first block behind it is known.
#include "ir/transform/structure_to_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ir/analysis/labels.h"
#include "ir/block_words.h"
#include "ir/builder.h"
#include "ir/make_word.h"
#include "ir/structure.h"
#include "ir/transform/conditions.h"
#include "ir/transform/new_local.h"
#include "ir/transform/part_ends.h"

namespace ncport::ir::transform {

namespace {

/// A place that jumps go to: the first output block at or behind it carries the number.
using Place = std::uint32_t;

struct Out {
  Block block;
  std::vector<Word> words;
  std::vector<Place> places;
};

class Lowering {
 public:
  Lowering(Module& module, ProgramId program, const StructureToJumpsConfig& config, diag::Sink& sink)
      : module_(module),
        program_(program),
        config_(config),
        sink_(sink),
        make_(module),
        source_(module.programs[program].blocks),
        labels_(module, program, config.ignore_case),
        next_place_(source_.count + 1) {}

  bool Run();

 private:
  void FindParts();
  void FindKeptLoops();
  void LowerBlock(std::uint32_t index);
  void LowerMark(std::uint32_t index, const Word& word);
  void LowerJump(std::uint32_t index, const Word& word);
  void LowerSwitch(std::uint32_t index, const Word& word);
  void LowerRepeatPart(std::uint32_t index, const Word& word);
  void EndParts(std::uint32_t index);
  void Finish();
  void NumberBlocks();

  Out& Emit(std::vector<Word> words);
  void EmitJump(Place target, ExprId condition = {});
  /// Jumps to `target` when `condition` has the truth value `sense`, else goes on.
  void EmitCondition(ExprId condition, bool sense, Place target);
  void EmitAssign(ExprId place, ExprId value);
  void Here(Place place) { waiting_.push_back(place); }
  Place NewPlace() { return next_place_++; }
  [[nodiscard]] Place Before(BlockId block) const { return block.value - source_.begin; }
  [[nodiscard]] Place After(BlockId block) const { return Before(block) + 1; }
  [[nodiscard]] BlockId BlockAt(std::uint32_t index) const { return BlockId{source_.begin + index}; }
  void Refuse(std::uint32_t index, const Word& word, std::string_view what);

  Module& module_;
  ProgramId program_;
  const StructureToJumpsConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  IdRange<BlockId> source_;
  analysis::LabelTable labels_;
  Place next_place_;

  std::vector<Out> out_;
  std::vector<Place> waiting_;                            // places that wait for the next block
  std::vector<std::pair<JumpId, Place>> jumps_;           // target numbers are set at the end
  std::unordered_map<std::uint32_t, std::uint8_t> kept_;  // loop openers that stay -> DO number
  std::unordered_map<std::uint32_t, Place> for_heads_;    // FOR loops that became jumps -> where the end is tested
  /// A part that lies away from its REPEAT block: blocks `first` to `last` run while its counter is above 0.
  struct DistantPart {
    std::uint32_t first, last, repeat;
    ExprId count;
  };
  std::vector<DistantPart> distant_;
  std::vector<VariableId> repeat_counters_;
  const Block* current_ = nullptr;  // source block that is being lowered
  bool first_of_block_ = false;
  bool ok_ = true;
};

bool IsLoopOpener(WordOp op) { return op == WordOp::kWhile || op == WordOp::kFor; }

/// The structure mark of a block, or none.
const Word* MarkOf(const Module& module, const Block& block) {
  for (const WordId id : block.words) {
    if (IsStructureMark(module.words[id].op)) return &module.words[id];
  }
  return nullptr;
}

void Lowering::Refuse(std::uint32_t index, const Word& word, std::string_view what) {
  ok_ = false;
  sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[BlockAt(index)], word), what,
               "a language with jumps to block numbers");
}

/// A loop stays when its condition is one comparison, no jump leads into it, and the loops around it leave room.
void Lowering::FindKeptLoops() {
  struct Open {
    std::uint32_t begin, end;
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> jumps;  // from, to
  for (std::uint32_t i = 0; i < source_.count; ++i) {
    const Block& block = module_.blocks[BlockAt(i)];
    const auto note = [&](const Jump& jump) {
      const BlockId to = labels_.Find(jump.target, BlockAt(i), jump.search);
      if (to.Valid()) jumps.emplace_back(i, Before(to));
    };
    for (const WordId id : block.words) {
      const Word& word = module_.words[id];
      if (word.op == WordOp::kJump) note(module_.jumps[word.Extra<JumpId>()]);
      if (word.op == WordOp::kSwitch) {
        const Switch& cases = module_.switches[word.Extra<SwitchId>()];
        for (std::uint32_t arm = 0; arm < cases.arm_count; ++arm)
          note(module_.jumps[module_.switch_arms[cases.first_arm + arm].jump]);
      }
      if (word.op == WordOp::kRepeatPart) {
        if (const auto range = labels_.FindPart(module_.parts[word.Extra<PartId>()], BlockAt(i))) {
          jumps.emplace_back(i, Before(range->first));
          jumps.emplace_back(Before(range->last), Before(range->first));
          jumps.emplace_back(Before(range->last), i + 1);
        }
      }
    }
  }
  std::vector<Open> open;
  for (std::uint32_t i = 0; i < source_.count; ++i) {
    while (!open.empty() && open.back().end < i) open.pop_back();
    const Block& block = module_.blocks[BlockAt(i)];
    const Word* mark = MarkOf(module_, block);
    if (mark == nullptr || !IsLoopOpener(mark->op) || !block.link.Valid()) continue;
    const std::uint32_t end = Before(block.link);
    const bool entered = std::any_of(jumps.begin(), jumps.end(), [&](const auto& jump) {
      return jump.second > i && jump.second <= end && (jump.first < i || jump.first > end);
    });
    const bool simple = mark->op == WordOp::kFor || IsPlainComparison(module_, mark->value);
    if (entered || !simple || open.size() >= config_.loop_depth) continue;
    open.push_back({i, end});
    kept_[i] = static_cast<std::uint8_t>(open.size());
  }
}

Out& Lowering::Emit(std::vector<Word> words) {
  Out& out = out_.emplace_back();
  const Block& from = *current_;
  out.block.origin = from.origin;
  out.block.indent = from.indent;
  out.block.skip_level = from.skip_level;
  out.block.flags = from.flags;
  if (first_of_block_) {
    out.block.number = from.number;
    out.block.number_digits = from.number_digits;
    out.block.label = from.label;
    out.block.comments = from.comments;
    first_of_block_ = false;
  }
  out.places = std::move(waiting_);
  waiting_.clear();
  out.words = std::move(words);
  return out;
}

void Lowering::EmitJump(Place target, ExprId condition) {
  Jump jump;
  jump.target.kind = TargetKind::kNumber;
  jump.search = Search::kForwardThenFromStart;
  const JumpId id = module_.jumps.Add(jump);
  jumps_.emplace_back(id, target);
  Emit({MakeWord(WordOp::kJump, 0, condition, id.value)});
}

void Lowering::EmitCondition(ExprId condition, bool sense, Place target) {
  const std::vector<ConditionalJump> chain = JumpsFor(module_, condition, sense);
  std::vector<Place> steps;
  for (std::size_t i = 0; i <= chain.size(); ++i) steps.push_back(NewPlace());
  for (std::size_t i = 0; i < chain.size(); ++i) {
    Here(steps[i]);
    EmitJump(chain[i].to == ConditionalJump::kTarget ? target : steps[static_cast<std::size_t>(chain[i].to)],
             chain[i].condition);
  }
  Here(steps.back());
}

void Lowering::EmitAssign(ExprId place, ExprId value) { Emit({MakeAssignment(place, value)}); }

void Lowering::LowerJump(std::uint32_t index, const Word& word) {
  const Jump jump = module_.jumps[word.Extra<JumpId>()];
  if (jump.target.kind == TargetKind::kExpression && module_.exprs[jump.target.expr].op != ExprOp::kLiteral &&
      module_.exprs[jump.target.expr].op != ExprOp::kText) {
    return Refuse(index, word, "a jump whose target is computed");
  }
  if (jump.target.kind == TargetKind::kProgramStart) {
    return word.value.Valid() ? EmitCondition(word.value, true, 0) : EmitJump(0);
  }
  const BlockId to = labels_.Find(jump.target, BlockAt(index), jump.search);
  if (!to.Valid()) {
    if (jump.quiet) return;  // nothing happens when it is reached
    return Refuse(index, word, "a jump whose target does not exist");
  }
  if (word.value.Valid()) {
    EmitCondition(word.value, true, Before(to));
  } else {
    EmitJump(Before(to));
  }
}

void Lowering::LowerSwitch(std::uint32_t index, const Word& word) {
  ExprId value = word.value;
  if (!IsSimplePlace(module_, value)) {
    const VariableId held = NewLocal(module_, program_, "CASE_VALUE", Type::kInt);
    EmitAssign(make_.Variable(held), value);
    value = make_.Variable(held);
  }
  const Switch cases = module_.switches[word.Extra<SwitchId>()];
  for (std::uint32_t i = 0; i < cases.arm_count; ++i) {
    const SwitchArm arm = module_.switch_arms[cases.first_arm + i];
    Word jump = word;
    jump.op = WordOp::kJump;
    jump.extra = arm.jump.value;
    jump.value = arm.value.Valid() ? make_.Binary(ExprOp::kEqual, value, arm.value) : ExprId{};
    LowerJump(index, jump);
  }
}

/// Finds the parts that lie away from their REPEAT block. A part must be one that is left at its end only: a counter
/// that still stands above 0 would send a later pass through the part back to the REPEAT block (sinumerik-6.4).
void Lowering::FindParts() {
  for (std::uint32_t i = 0; i < source_.count; ++i) {
    for (const WordId id : module_.blocks[BlockAt(i)].words) {
      const Word& word = module_.words[id];
      if (word.op != WordOp::kRepeatPart) continue;
      const auto range = labels_.FindPart(module_.parts[word.Extra<PartId>()], BlockAt(i));
      if (!range) {
        Refuse(i, word, "a repeated part whose labels are not found");
        continue;
      }
      const std::uint32_t first = Before(range->first), last = Before(range->last);
      if (!LeavesAtEndOnly(module_, labels_, *range)) {
        Refuse(i, word, "a repeated part that is left before its end");
        continue;
      }
      if (module_.blocks[range->first].skip_level != Block::kNoSkip ||
          module_.blocks[range->last].skip_level != Block::kNoSkip) {
        Refuse(i, word, "a repeated part with a label in a block that may be skipped");
        continue;
      }
      if (last + 1 == i) continue;
      const VariableId counter = NewLocal(module_, program_, "REPEAT_COUNT", Type::kInt);
      repeat_counters_.push_back(counter);
      distant_.push_back({first, last, i, make_.Variable(counter)});
    }
  }
}

/// Behind the last block of a part: while its counter is above 0 control goes back, and after the last pass to the
/// block behind the REPEAT block.
void Lowering::EndParts(std::uint32_t index) {
  for (const DistantPart& part : distant_) {
    if (part.last != index) continue;
    Block plain;
    plain.origin = module_.blocks[BlockAt(index)].origin;
    plain.indent = module_.blocks[BlockAt(index)].indent;
    current_ = &plain;
    first_of_block_ = false;
    const Place on = NewPlace();
    EmitCondition(make_.Binary(ExprOp::kLessEqual, part.count, make_.Literal(0, Type::kInt)), true, on);
    EmitAssign(part.count, make_.Binary(ExprOp::kSubtract, part.count, make_.Literal(1, Type::kInt)));
    EmitCondition(make_.Binary(ExprOp::kGreater, part.count, make_.Literal(0, Type::kInt)), true, part.first);
    EmitJump(part.repeat + 1);
    Here(on);
    current_ = nullptr;
  }
}

/// A part that ends right before this block: a counter that stands at 0 outside decides. Another one: its counter is
/// set, and EndParts leads back.
void Lowering::LowerRepeatPart(std::uint32_t index, const Word& word) {
  const ExprId turns = word.value.Valid() ? word.value : make_.Literal(1, Type::kInt);
  for (const DistantPart& part : distant_) {
    if (part.repeat != index) continue;
    EmitAssign(part.count, turns);
    return EmitCondition(make_.Binary(ExprOp::kGreater, part.count, make_.Literal(0, Type::kInt)), true, part.first);
  }
  const auto range = labels_.FindPart(module_.parts[word.Extra<PartId>()], BlockAt(index));
  if (!range) return;  // has its finding
  const VariableId counter = NewLocal(module_, program_, "REPEAT_COUNT", Type::kInt);
  repeat_counters_.push_back(counter);
  const ExprId count = make_.Variable(counter);
  const Place running = NewPlace();
  EmitCondition(make_.Binary(ExprOp::kNotEqual, count, make_.Literal(0, Type::kInt)), true, running);
  EmitAssign(count, make_.Binary(ExprOp::kAdd, turns, make_.Literal(1, Type::kInt)));
  Here(running);
  EmitAssign(count, make_.Binary(ExprOp::kSubtract, count, make_.Literal(1, Type::kInt)));
  EmitCondition(make_.Binary(ExprOp::kGreater, count, make_.Literal(0, Type::kInt)), true, Before(range->first));
}

void Lowering::LowerMark(std::uint32_t index, const Word& word) {
  const Block& block = module_.blocks[BlockAt(index)];
  const BlockId link = block.link;
  const auto kept = kept_.find(index);
  const auto opener_kept = link.Valid() ? kept_.find(Before(link)) : kept_.end();
  Word mark = word;
  switch (word.op) {
    case WordOp::kIf:
      return EmitCondition(word.value, false, After(link));
    case WordOp::kElse:
      return EmitJump(After(link));
    case WordOp::kEndIf:
      return;
    case WordOp::kWhile:
      if (kept != kept_.end()) {
        mark.index = kept->second;
        Emit({mark});
        return;
      }
      return EmitCondition(word.value, false, After(link));
    case WordOp::kFor: {
      const For loop = module_.fors[word.Extra<ForId>()];
      ExprId end = loop.end;
      EmitAssign(loop.variable, word.value);
      if (module_.exprs[end].op != ExprOp::kLiteral) {
        // The end value counts as it stood before the first pass (sinumerik-6.3).
        const VariableId held = NewLocal(module_, program_, "FOR_END", module_.exprs[end].type);
        EmitAssign(make_.Variable(held), end);
        end = make_.Variable(held);
      }
      const ExprId again = make_.Binary(ExprOp::kLessEqual, loop.variable, end);
      if (kept == kept_.end()) {
        const Place head = NewPlace();
        Here(head);
        for_heads_[index] = head;
        return EmitCondition(again, false, After(link));
      }
      mark.op = WordOp::kWhile;
      mark.index = kept->second;
      mark.value = again;
      mark.extra = Id<void>::kNone;
      Emit({mark});
      return;
    }
    case WordOp::kEndWhile:
    case WordOp::kEndFor: {
      const Word* opener = MarkOf(module_, module_.blocks[link]);
      if (word.op == WordOp::kEndFor) {
        const For loop = module_.fors[opener->Extra<ForId>()];
        const ExprId step = loop.step.Valid() ? loop.step : make_.Literal(1, Type::kInt);
        EmitAssign(loop.variable, make_.Binary(ExprOp::kAdd, loop.variable, step));
      }
      if (opener_kept == kept_.end()) {
        const auto head = for_heads_.find(Before(link));
        return EmitJump(head == for_heads_.end() ? Before(link) : head->second);
      }
      mark.op = WordOp::kEndWhile;
      mark.index = opener_kept->second;
      Emit({mark});
      return;
    }
    case WordOp::kLoop:
    case WordOp::kRepeat:
      return;
    case WordOp::kEndLoop:
      return EmitJump(After(link));
    case WordOp::kUntil:
      return EmitCondition(word.value, false, After(link));
    default:
      return;
  }
}

void Lowering::LowerBlock(std::uint32_t index) {
  const Block block = module_.blocks[BlockAt(index)];
  current_ = &block;
  first_of_block_ = true;
  Here(index);
  std::vector<Word> words;
  const auto flush = [&] {
    if (!words.empty()) Emit(std::exchange(words, {}));
  };
  for (const WordId id : block.words) {
    const Word word = module_.words[id];
    switch (word.op) {
      case WordOp::kJump:
        flush();
        LowerJump(index, word);
        break;
      case WordOp::kSwitch:
        flush();
        LowerSwitch(index, word);
        break;
      case WordOp::kRepeatPart:
        flush();
        LowerRepeatPart(index, word);
        break;
      default:
        if (IsStructureMark(word.op)) {
          flush();
          LowerMark(index, word);
        } else {
          words.push_back(word);
        }
    }
  }
  flush();
  // A block that became nothing stays for its comments, its number or as a blank line.
  const bool mark = !block.words.Empty();
  const bool blank = !mark && (block.flags & Block::kAdded) == 0;  // an added one is the mark of a part's end
  if (first_of_block_ && (blank || !block.comments.Empty() || block.number != Block::kNoNumber)) Emit({});
  current_ = nullptr;
  EndParts(index);
}

void Lowering::NumberBlocks() {
  // Numbers of the source stay where they stand once; where a jump goes to a block without one, a free one is given.
  std::unordered_map<std::uint32_t, std::uint32_t> uses;
  for (const Out& out : out_) {
    if (out.block.number != Block::kNoNumber) ++uses[out.block.number];
  }
  std::unordered_set<Place> wanted;
  for (const auto& [jump, place] : jumps_) wanted.insert(place);
  // A jump does not go to a block that may be skipped: whether a control finds its number then is its own affair.
  std::vector<Out> split;
  for (Out& out : out_) {
    const bool target =
        std::any_of(out.places.begin(), out.places.end(), [&](Place place) { return wanted.contains(place); });
    if (target && out.block.skip_level != Block::kNoSkip) {
      Out& mark = split.emplace_back();
      mark.block.origin = out.block.origin;
      mark.block.indent = out.block.indent;
      mark.block.number = std::exchange(out.block.number, Block::kNoNumber);
      mark.block.number_digits = out.block.number_digits;
      mark.places = std::move(out.places);
    }
    split.push_back(std::move(out));
  }
  out_ = std::move(split);
  std::unordered_map<Place, std::uint32_t> numbers;
  std::uint32_t next = config_.first_number;
  for (Out& out : out_) {
    const bool target =
        std::any_of(out.places.begin(), out.places.end(), [&](Place place) { return wanted.contains(place); });
    const bool doubled =
        out.block.number != Block::kNoNumber && (uses[out.block.number] > 1 || out.block.number > config_.last_number);
    if (doubled) out.block.number = Block::kNoNumber;
    if (!target) continue;
    if (out.block.number == Block::kNoNumber) {
      while (uses.contains(next)) next += config_.step;
      out.block.number = next;
      out.block.number_digits = 0;
      next += config_.step;
    }
    for (const Place place : out.places) numbers[place] = out.block.number;
  }
  if (next > config_.last_number + config_.step) {
    ok_ = false;
    sink_.Report(diag::Code::kNotExpressible, module_.RangeOf(module_.blocks[BlockAt(0)]),
                 "a program with so many jump targets", fmt::format("block numbers up to {}", config_.last_number));
  }
  for (const auto& [jump, place] : jumps_) module_.jumps[jump].target.number = numbers.at(place);
}

void Lowering::Finish() {
  // Counters of repeated parts stand at 0 from the start on.
  if (!repeat_counters_.empty()) {
    std::size_t first = 0;
    const auto is_definition = [](const Out& out) {
      // A block that jumps lead to is no part of the head: what stands behind it runs again.
      return !out.block.label.Valid() && out.block.number == Block::kNoNumber &&
             std::all_of(out.words.begin(), out.words.end(), [](const Word& word) {
               return word.op == WordOp::kHeader || word.op == WordOp::kExtern || word.op == WordOp::kDefine ||
                      word.op == WordOp::kFileMark;
             });
    };
    while (first < out_.size() && is_definition(out_[first])) ++first;
    std::vector<Out> inserted;
    for (const VariableId counter : repeat_counters_) {
      const ExprId count = make_.Variable(counter);
      Out& out = inserted.emplace_back();
      if (first < out_.size()) out.block.origin = out_[first].block.origin;
      out.words = {MakeAssignment(count, make_.Literal(0, Type::kInt))};
    }
    out_.insert(out_.begin() + static_cast<std::ptrdiff_t>(first), inserted.begin(), inserted.end());
  }
  if (!waiting_.empty()) {
    // A jump behind the last block: the program ends there, in an empty block.
    Block end;
    end.origin = source_.Empty() ? OriginId{} : module_.blocks[BlockAt(source_.count - 1)].origin;
    Out& out = out_.emplace_back();
    out.block.origin = end.origin;
    out.places = std::move(waiting_);
    const bool used = std::any_of(jumps_.begin(), jumps_.end(), [&](const auto& jump) {
      return std::find(out.places.begin(), out.places.end(), jump.second) != out.places.end();
    });
    if (!used) out_.pop_back();
  }
  NumberBlocks();
  const IdRange<BlockId> range{static_cast<std::uint32_t>(module_.blocks.Size()),
                               static_cast<std::uint32_t>(out_.size())};
  for (Out& out : out_) {
    // The name of a label says what follows: it stays as a comment where the target has numbers only.
    if (out.block.label.Valid()) {
      Comment name;
      name.text = out.block.label;
      name.place = out.words.empty() ? CommentPlace::kOwnLine : CommentPlace::kEndOfBlock;
      IdRange<CommentId> comments{static_cast<std::uint32_t>(module_.comments.Size()), out.block.comments.count + 1};
      module_.comments.Add(name);
      for (const CommentId id : out.block.comments) {
        const Comment comment = module_.comments[id];
        module_.comments.Add(comment);
      }
      out.block.comments = comments;
      out.block.label = {};
    }
    SetWords(module_, out.block, out.words);
    module_.blocks.Add(out.block);
  }
  module_.programs[program_].blocks = range;
  BuildStructure(module_, program_, 0, sink_);
}

bool Lowering::Run() {
  FindParts();
  FindKeptLoops();
  for (std::uint32_t i = 0; i < source_.count; ++i) LowerBlock(i);
  Here(source_.count);  // behind an ENDIF that is the last block
  if (!ok_) return false;
  Here(source_.count);
  Finish();
  return ok_;
}

}  // namespace

bool StructureToJumps(Module& module, ProgramId program, const StructureToJumpsConfig& config, diag::Sink& sink) {
  return Lowering(module, program, config, sink).Run();
}

}  // namespace ncport::ir::transform
