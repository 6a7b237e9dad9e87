// What the words of one block do to each other, and limits of their values (card 6.3, 8.3, 8.6, 8.7, 8.9, 9).
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/near_name.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/resolver.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using ir::ExprId;
using ir::ExprOp;
using ir::WordOp;

namespace words = dialects::sinumerik;

std::optional<double> Resolver::LiteralNumber(ExprId id) const {
  double sign = 1;
  while (id.Valid()) {
    const ir::Expr& expr = module_.exprs[id];
    switch (expr.op) {
      case ExprOp::kLiteral:
        return sign * expr.number;
      case ExprOp::kNegate:
        sign = -sign;
        break;
      case ExprOp::kPlus:
      case ExprOp::kGroup:
      case ExprOp::kConvert:
        break;
      default:
        return std::nullopt;
    }
    id = ExprId{std::size_t{expr.a}};
  }
  return std::nullopt;
}

bool Resolver::BlockRules(const ir::Block& block) {
  bool ok = OwnBlock(block) && PolarBesideAxis(block) && Lead(block);
  Marks(block);
  Spindles(block);
  const ir::Word* center = nullptr;
  const ir::Word* radius = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kCenter) center = &word;
    if (word.op == WordOp::kRadius) radius = &word;
    if (word.op == WordOp::kOpeningAngle) ok = ok && Limit(word, 0, 360, "0 to 360");
    if (word.op == WordOp::kChamfer) ok = ok && Limit(word, 0, 1e300, "0 and above");
    if (word.op == WordOp::kPolarRadius) ok = ok && Limit(word, 0, 1e300, "0 and above");
    if (word.op == WordOp::kAlarm) AlarmNumber(word);
    ok = ok && Turn(word);
  }
  if (ok && center != nullptr && radius != nullptr) {
    const SourceRange at = module_.RangeOf(block, *radius);
    sink_.ReportAs(diag::Severity::kWarning, Code::kWordConflict, at, Slice(module_.RangeOf(block, *center)), Slice(at))
        .help = "the radius follows from the centre: leave out one of them";
  }
  return ok;
}

std::string_view Resolver::Slice(const SourceRange& at) const {
  return files_.Line(at.file, at.line).substr(at.begin, at.end - at.begin);
}

bool Resolver::Limit(const ir::Word& word, double low, double high, std::string_view range) {
  const std::optional<double> value = LiteralNumber(word.value);
  if (!value || (*value >= low && *value <= high)) return true;
  sink_.Report(Code::kOutOfRange, module_.RangeOf(module_.blocks[block_], word.value), *value, range);
  return false;
}

// Card 8.5 and 10, row 54: a target that names its way there lies within one turn. One row ends it at 359.999, the
// other at 360: what lies between them passes.
bool Resolver::Turn(const ir::Word& word) {
  if (word.mode != ir::ValueMode::kShortest && word.mode != ir::ValueMode::kPositive &&
      word.mode != ir::ValueMode::kNegative)
    return true;
  // Card 10, row 55: X, Y and Z have no turns.
  if (word.op == WordOp::kAxis && word.index <= 2) {
    const SourceRange at = module_.RangeOf(module_.blocks[block_], word);
    sink_.Report(Code::kTypeMismatch, at, "a linear axis", "a rotary axis").help =
        "DC, ACP and ACN are for rotary axes; X, Y and Z take AC or IC";
    return false;
  }
  return Limit(word, 0, 360, "0 to 359.999");
}

// Card 8.11 and 10, row 60: the numbers of cycles and of users. Others may be known to the control, so it is a warning.
void Resolver::AlarmNumber(const ir::Word& word) {
  constexpr double kFirst = 60000;
  constexpr double kLast = 69999;
  const std::optional<double> value = LiteralNumber(word.value);
  if (!value || *value < 0 || (*value >= kFirst && *value <= kLast)) return;  // no number is below 0
  sink_
      .ReportAs(diag::Severity::kWarning, Code::kOutOfRange, module_.RangeOf(module_.blocks[block_], word.value),
                *value, "60000 to 69999")
      .help = "alarms of users have the numbers 65000 to 69999, those of cycles 61000 to 64999";
}

// Card 8.10: the spindle words of one spindle exclude each other.
void Resolver::Spindles(const ir::Block& block) {
  const ir::Word* first = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op != WordOp::kSpindle) continue;
    if (first == nullptr || first->index != word.index) {
      first = first == nullptr ? &word : first;
      continue;
    }
    const SourceRange at = module_.RangeOf(block, word);
    diag::Diagnostic& finding = sink_.ReportAs(diag::Severity::kWarning, Code::kWordConflict, at,
                                               Slice(module_.RangeOf(block, *first)), Slice(at));
    finding.notes.push_back({module_.RangeOf(block, *first), "the first one"});
    finding.help = "both act on the same spindle: give each a block of its own, or leave out one";
    return;
  }
}

// Card 8.7: TRANS and its kin take the axis words of their block, so a motion word has nothing to move.
bool Resolver::OwnBlock(const ir::Block& block) {
  const ir::Word* frame = nullptr;
  const ir::Word* motion = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kFrame) frame = &word;
    if (word.op == WordOp::kMotion) motion = &word;
  }
  if (!EndAlone(block)) return false;
  if (frame == nullptr || motion == nullptr) return true;
  const std::string_view text = frame->spelling < module_.spellings.size()
                                    ? module_.View(module_.spellings[frame->spelling].text)
                                    : std::string_view("the frame word");
  sink_.Report(Code::kNotAlone, module_.RangeOf(block, *frame), text).help =
      "the axis words of this block belong to the frame: the motion has a block of its own";
  return false;
}

// Card 1.2: RET has a block of its own; M17 may stand beside a motion.
bool Resolver::EndAlone(const ir::Block& block) {
  if (block.words.count < 2) return true;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op != WordOp::kReturn || word.index == static_cast<std::uint8_t>(ir::ReturnKind::kAuxiliary)) continue;
    sink_.Report(Code::kNotAlone, module_.RangeOf(block, word), "RET").help = "M17 may stand beside other words";
    return false;
  }
  return true;
}

// Card 8.4: the lead of a thread stands behind the letter of its axis.
bool Resolver::Lead(const ir::Block& block) {
  const ir::Word* thread = nullptr;
  const ir::Word* letter = nullptr;
  const ir::Word* axis = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kAxisComputed || word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius)
      return true;
    if (word.op == WordOp::kCenter) letter = &word;
    if (word.op == WordOp::kAxis) {
      if (word.index > 2) return true;
      axis = &word;
    }
    if (word.op != WordOp::kMotion) continue;
    switch (static_cast<ir::Motion>(word.index)) {
      case ir::Motion::kThread:
      case ir::Motion::kThreadIncreasing:
      case ir::Motion::kThreadDecreasing:
      case ir::Motion::kTapIn:
      case ir::Motion::kTapOut:
        thread = &word;
        break;
      default:
        break;
    }
  }
  if (thread == nullptr || axis == nullptr) return true;
  std::uint32_t moved = 0;
  std::uint32_t leads = 0;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kAxis) moved |= 1U << word.index;
    if (word.op == WordOp::kCenter) leads |= 1U << word.index;
  }
  if ((moved & leads) != 0) return true;
  const SourceRange at = module_.RangeOf(block, letter != nullptr ? *letter : *thread);
  if (letter != nullptr) {
    const char axis_name = "XYZ"[axis->index];
    const char right = "IJK"[axis->index];
    sink_.Report(Code::kMissingValue, at, "lead of " + std::string(Slice(module_.RangeOf(block, *thread)))).help =
        std::string("this block moves ") + axis_name + ", whose lead stands behind " + right + ", not " +
        std::string(Slice(at).substr(0, 1));
    return false;
  }
  sink_.Report(Code::kMissingValue, at, "lead of " + std::string(Slice(at))).help =
      "the lead stands behind K for Z, I for X, J for Y";
  return false;
}

// Card 8.6: only AP and RP describe the point in the plane.
bool Resolver::PolarBesideAxis(const ir::Block& block) {
  const ir::Word* polar = nullptr;
  std::uint32_t axes = 0;
  const ir::Word* axis = nullptr;
  for (const ir::WordId id : block.words) {
    const ir::Word& word = module_.words[id];
    if (word.op == WordOp::kPolarAngle || word.op == WordOp::kPolarRadius) polar = &word;
    if (word.op != WordOp::kAxis || word.index > 2) continue;
    ++axes;
    axis = &word;
  }
  // One of X, Y, Z may stand on the plane; two of them never do.
  if (polar == nullptr || axes < 2) return true;
  const SourceRange at = module_.RangeOf(block, *axis);
  const SourceRange other = module_.RangeOf(block, *polar);
  sink_.Report(Code::kWordConflict, at, Slice(other), Slice(at)).help =
      "AP and RP alone describe the point in the plane; only the third axis may stand beside them";
  return false;
}

// Card 6.3: no label and no skip mark in front of a word of a structure.
void Resolver::Marks(const ir::Block& block) {
  if (block.words.Empty()) return;
  const ir::Word& word = module_.words[block.words[0]];
  if (!ir::IsStructureMark(word.op)) return;
  const bool skip = block.skip_level != ir::Block::kNoSkip;
  if (!skip && !block.label.Valid()) return;
  const SourceRange at = module_.RangeOf(block, word);
  const std::string_view line = files_.Line(at.file, at.line);
  std::uint32_t end = at.begin;
  while (end < line.size() && (IsLetter(line[end]))) ++end;
  sink_.Report(Code::kNotAlone, at, line.substr(at.begin, end - at.begin)).help =
      skip ? "no skip mark can stand in front of it: jump around the structure"
           : "no label can stand in front of it: give the label a block of its own";
}

// Card 9: the list is not complete, so what looks wrong is a warning.
void Resolver::SystemVariable(ExprId id) {
  const ir::Expr& expr = module_.exprs[id];
  const ir::System& system = module_.systems[ir::SystemId{std::size_t{expr.a}}];
  std::string name(module_.View(system.name));
  for (char& c : name) c = Upper(c);
  const std::size_t dollar = name.find_first_not_of('$');
  if (dollar != std::string::npos) name.erase(0, dollar);
  const words::SystemRow* row = words::FindSystemVariable(name);
  if (row == nullptr) return;
  if (words::IsUnlistedSystemVariable(name)) {
    std::vector<std::string_view> known;
    for (const auto& listed : words::SystemVariables()) known.push_back(listed.name);
    const std::string_view near = NearName(name, known);
    // Short names are near to each other without a slip.
    if (near.empty() || near.size() < 4 || !doubted_systems_.insert(name).second) return;
    const SourceRange at = module_.RangeOf(module_.blocks[block_], id);
    diag::Diagnostic& finding = sink_.ReportAs(diag::Severity::kWarning, Code::kUnknownName, at, "$" + name);
    finding.help = "did you mean $" + std::string(near) + "?";
    finding.notes.push_back({{}, "not all system variables of the control are known to ncport"});
    return;
  }
  constexpr std::uint8_t kAnyIndices = 0xFF;
  if (row->indices == kAnyIndices || expr.count == row->indices) return;
  // `$P_UIFR[1,X,TR]`: axis and component of a frame stand behind its own indices.
  if (row->type == ir::Type::kFrame && expr.count == row->indices + 2U) return;
  sink_
      .ReportAs(diag::Severity::kWarning, Code::kArgumentCount, module_.RangeOf(module_.blocks[block_], id), "$" + name,
                row->indices, expr.count)
      .help = "they stand in []";
}

}  // namespace ncport::frontend::sinumerik
