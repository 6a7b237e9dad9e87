// Programs, their blocks and words, and the links of structure marks.
#include <algorithm>
#include <vector>

#include "ir/verifier.h"
#include "ir/word_shape.h"

namespace ncport::ir {

// --- programs, blocks, words

bool Verifier::Programs() {
  std::vector<IdRange<BlockId>> ranges;
  for (const ProgramId id : m_.programs.Ids()) {
    const Program& program = m_.programs[id];
    At("program", id.value);
    const bool ok = String(program.name, "name", false) && Enumerator(program.kind, "kind") && File(program.file) &&
                    Range(program.blocks.begin, program.blocks.count, m_.blocks.Size(), "blocks") &&
                    Range(program.parameters.begin, program.parameters.count, m_.variables.Size(), "parameters");
    if (!ok) return false;
    for (const VariableId parameter : program.parameters) {
      if (!Check(m_.variables[parameter].owner == id, "a parameter belongs to another program")) return false;
    }
    if (!program.blocks.Empty()) ranges.push_back(program.blocks);
    for (const BlockId block : program.blocks) {
      if (!BlockOk(block, program)) return false;
    }
    block_ = {};
    if (!Structure(program)) return false;
    block_ = {};
  }
  At({});
  std::ranges::sort(ranges, {}, [](const IdRange<BlockId>& range) { return range.begin; });
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (!Check(ranges[i - 1].begin + ranges[i - 1].count <= ranges[i].begin, "two programs share blocks")) return false;
  }
  return true;
}

bool Verifier::BlockOk(BlockId id, const Program& program) {
  const Block& block = m_.blocks[id];
  block_ = id;
  At("block");
  const bool ok = Record(m_.origins, block.origin, "origin", true) && String(block.label, "label") &&
                  Range(block.words.begin, block.words.count, m_.words.Size(), "words") &&
                  Range(block.comments.begin, block.comments.count, m_.comments.Size(), "comments") &&
                  Check((block.flags & 0xF0U) == 0, "unknown flag") &&
                  Check(block.skip_level < 16 || block.skip_level == Block::kNoSkip, "skip level over 15") &&
                  Check(!block.link.Valid() || (block.link.value >= program.blocks.begin &&
                                                block.link.value - program.blocks.begin < program.blocks.count),
                        "link out of the program");
  if (!ok) return false;
  for (const CommentId comment_id : block.comments) {
    const Comment& comment = m_.comments[comment_id];
    if (!Enumerator(comment.place, "place of a comment") || !String(comment.text, "comment", false)) return false;
    const bool before_word = comment.place == CommentPlace::kBeforeWord;
    if (!Check(!before_word || comment.word <= block.words.count, "a comment before a word that is not there")) {
      return false;
    }
  }
  const bool refused = (block.flags & Block::kRefused) != 0;
  for (std::uint32_t i = 0; i < block.words.count; ++i) {
    const Word& word = m_.words[block.words[i]];
    At("word", i + 1, NameOf(word.op));
    if (!WordOk(word, refused)) return false;
    if (!refused && IsStructureMark(word.op) && block.words.count != 1) return Fail("not alone in its block");
  }
  return true;
}

bool Verifier::WordOk(const Word& word, bool refused) {
  const bool ok = Enumerator(word.op, "word") && Enumerator(word.phase, "phase") && Enumerator(word.mode, "mode") &&
                  Check((word.flags & 0x80U) == 0, "unknown flag") &&
                  Check(word.spelling < m_.spellings.size(), "unknown spelling") && Operand(word.value, "value");
  if (!ok) return false;
  const ValueUse use = ValueUseOf(word.op);
  if (!Check(use != ValueUse::kNever || !word.value.Valid(), "has a value")) return false;
  if (!Check(use != ValueUse::kMust || word.value.Valid() || refused, "has no value")) return false;
  return Index(word) && Extra(word, refused);
}

bool Verifier::Index(const Word& word) {
  const std::uint8_t index = word.index;
  switch (ShapeOf(word.op).index) {
    case IndexKind::kNone:
      return index == 0 || Fail("index {} has no meaning", index);
    case IndexKind::kNumber:
      return true;
    case IndexKind::kMotion:
      return Enumerator(static_cast<Motion>(index), "motion");
    case IndexKind::kPlane:
      return Enumerator(static_cast<Plane>(index), "plane");
    case IndexKind::kDistance:
      return Enumerator(static_cast<Distance>(index), "distance");
    case IndexKind::kUnits:
      return Enumerator(static_cast<Units>(index), "units");
    case IndexKind::kFeedMode:
      return Enumerator(static_cast<FeedMode>(index), "feed mode");
    case IndexKind::kSpeedMode:
      return Enumerator(static_cast<SpeedMode>(index), "speed mode");
    case IndexKind::kCutterComp:
      return Enumerator(static_cast<CutterComp>(index), "compensation");
    case IndexKind::kDiameter:
      return Enumerator(static_cast<Diameter>(index), "diameter mode");
    case IndexKind::kPathMode:
      return Enumerator(static_cast<PathMode>(index), "path mode");
    case IndexKind::kReturnLevel:
      return Enumerator(static_cast<ReturnLevel>(index), "return level");
    case IndexKind::kAxis:
      return Axis(index);
    case IndexKind::kCoordinate:
      return index < 3 || Fail("coordinate {}", index);
    case IndexKind::kChamfer:
      return Enumerator(static_cast<ChamferKind>(index), "kind of chamfer");
    case IndexKind::kReference:
      return Enumerator(static_cast<ReferenceKind>(index), "kind of reference");
    case IndexKind::kPole:
      return Enumerator(static_cast<PoleBase>(index), "base of the pole");
    case IndexKind::kFrame:
      return Enumerator(static_cast<FrameOp>(index), "frame operation");
    case IndexKind::kAlarm:
      return Enumerator(static_cast<AlarmKind>(index), "kind of alarm");
    case IndexKind::kCycle:
      return Enumerator(static_cast<Cycle>(index), "cycle");
    case IndexKind::kCycleField:
      return Enumerator(static_cast<CycleField>(index), "word of a cycle");
    case IndexKind::kReturn:
      return Enumerator(static_cast<ReturnKind>(index), "kind of return");
    case IndexKind::kMark:
      return index == 0 || IsStructureMark(static_cast<WordOp>(index)) || Fail("index {} is no mark", index);
  }
  return true;
}

bool Verifier::Extra(const Word& word, bool refused) {
  const WordShape shape = ShapeOf(word.op);
  const bool missing = word.extra == Id<void>::kNone;
  if (shape.extra == ExtraKind::kNone) return missing || Fail("extra {} has no meaning", word.extra);
  if (missing) return shape.extra_may_be_missing || refused || Fail("extra is missing");
  switch (shape.extra) {
    case ExtraKind::kNone:
    case ExtraKind::kNumber:
      return true;
    case ExtraKind::kSpindleState:
      return word.extra < 256 ? Enumerator(static_cast<SpindleState>(word.extra), "spindle state")
                              : Fail("spindle state {}", word.extra);
    case ExtraKind::kExpr:
      return word.op == WordOp::kAssign ? Place(word.Extra<ExprId>(), "what is written")
                                        : Operand(word.Extra<ExprId>(), "extra");
    case ExtraKind::kVariable:
      return Record(m_.variables, word.Extra<VariableId>(), "variable");
    case ExtraKind::kProgram:
      return Record(m_.programs, word.Extra<ProgramId>(), "program");
    case ExtraKind::kExtern:
      return Record(m_.externs, word.Extra<ExternId>(), "extern");
    case ExtraKind::kAssignList:
      return Record(m_.assign_lists, word.Extra<AssignListId>(), "assignment list");
    case ExtraKind::kJump:
      return Record(m_.jumps, word.Extra<JumpId>(), "jump");
    case ExtraKind::kSwitch:
      return Record(m_.switches, word.Extra<SwitchId>(), "switch");
    case ExtraKind::kCall:
      return Record(m_.calls, word.Extra<CallId>(), "call");
    case ExtraKind::kPart:
      return Record(m_.parts, word.Extra<PartId>(), "part");
    case ExtraKind::kFor:
      return Record(m_.fors, word.Extra<ForId>(), "for");
    case ExtraKind::kString:
      return String(word.Extra<StringId>(), "text", false);
  }
  return true;
}

// --- structure links

WordOp Verifier::MarkOf(const Block& block) const {
  for (const WordId id : block.words) {
    const Word& word = m_.words[id];
    const WordOp op = word.op == WordOp::kVerbatim ? static_cast<WordOp>(word.index) : word.op;
    if (IsStructureMark(op)) return op;
  }
  return WordOp::kVerbatim;
}

bool Verifier::IsOpener(WordOp op) {
  return op == WordOp::kIf || op == WordOp::kWhile || op == WordOp::kLoop || op == WordOp::kRepeat ||
         op == WordOp::kFor;
}

bool Verifier::Closes(WordOp opener, WordOp closer) {
  switch (opener) {
    case WordOp::kIf:
      return closer == WordOp::kEndIf;
    case WordOp::kWhile:
      return closer == WordOp::kEndWhile;
    case WordOp::kLoop:
      return closer == WordOp::kEndLoop;
    case WordOp::kRepeat:
      return closer == WordOp::kUntil;
    case WordOp::kFor:
      return closer == WordOp::kEndFor;
    default:
      return false;
  }
}

bool Verifier::Structure(const Program& program) {
  struct Open {
    BlockId block;
    WordOp op;
    BlockId middle;
  };
  std::vector<Open> open;
  for (const BlockId id : program.blocks) {
    const Block& block = m_.blocks[id];
    const WordOp op = MarkOf(block);
    block_ = id;
    At("block");
    if (op == WordOp::kVerbatim) {
      if (!Check(!block.link.Valid(), "a link without structure mark")) return false;
      continue;
    }
    At(NameOf(op));
    if (!block.link.Valid()) {
      const bool refused = (block.flags & Block::kRefused) != 0;
      if (!Check(refused || !options_.structure_built, "has no link")) return false;
      continue;
    }
    if (IsOpener(op)) {
      if (!Check(block.link > id, "link leads back")) return false;
      open.push_back({id, op, {}});
      continue;
    }
    if (!Check(!open.empty(), "links to no open structure")) return false;
    Open& top = open.back();
    if (op == WordOp::kElse) {
      const bool ok = Check(top.op == WordOp::kIf && !top.middle.Valid(), "stands in no IF") &&
                      Check(m_.blocks[top.block].link == id, "its IF does not link to it") &&
                      Check(block.link > id, "link leads back");
      if (!ok) return false;
      top.middle = id;
      continue;
    }
    const BlockId before = top.middle.Valid() ? top.middle : top.block;
    const bool ok = Check(Closes(top.op, op), "closes another structure") &&
                    Check(block.link == top.block, "does not link to its opener") &&
                    Check(m_.blocks[before].link == id, "its partner does not link to it");
    if (!ok) return false;
    open.pop_back();
  }
  if (open.empty()) return true;
  block_ = open.back().block;
  At(NameOf(open.back().op));
  return Fail("links to no end");
}

}  // namespace ncport::ir
