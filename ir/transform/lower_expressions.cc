// One walk over the words of a block: what lowers a value, a condition or a function puts statements into the same list
// in front of it, in the order in which the source works them out.
#include "ir/transform/lower_expressions.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ir/analysis/number_kinds.h"
#include "ir/builder.h"
#include "ir/comparison.h"
#include "ir/make_word.h"
#include "ir/transform/conditions.h"
#include "ir/transform/is_integral.h"
#include "ir/transform/new_local.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

namespace {

bool HasFunction(const Module& module, ExprId id, Function function) {
  const Expr& expr = module.exprs[id];
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return false;
    case Operands::kUnary:
      return HasFunction(module, ExprId{expr.a}, function);
    case Operands::kBinary:
      return HasFunction(module, ExprId{expr.a}, function) || HasFunction(module, ExprId{expr.b}, function);
    case Operands::kList:
      if (expr.op == ExprOp::kFunction && static_cast<Function>(expr.a) == function) return true;
      for (std::uint32_t i = 0; i < expr.count; ++i) {
        if (HasFunction(module, module.Item(expr.b + i), function)) return true;
      }
      return false;
  }
  return false;
}

class Lowering {
 public:
  Lowering(Module& module, ProgramId program, const LowerExpressionsConfig& config, diag::Sink& sink)
      : module_(module),
        program_(program),
        config_(config),
        sink_(sink),
        make_(module),
        editor_(module, program, "lower_expressions") {
    // From the module as it came: what is lowered below would hide how numbers came about.
    if (config.compare_tolerance > 0) kinds_.emplace(module, analysis::CallGraph(module), config.for_counter_rounds);
    if (kinds_) kinds_->Prepare(program);
  }

  bool Run();

 private:
  /// As a number.
  ExprId Value(ExprId id);
  /// As a condition: AND, OR, NOT and comparisons stay, their sides become numbers.
  ExprId Condition(ExprId id);
  ExprId Comparison(const Expr& expr);
  /// The part of `value` within which numbers count as equal.
  ExprId Band(ExprId value);
  /// True when the two can be equal but for their last bits.
  [[nodiscard]] bool MayNearlyEqual(ExprId left, ExprId right);
  ExprId ValueOfFunction(const Expr& expr);
  ExprId Truth(ExprId condition);
  ExprId Simple(ExprId value, std::string_view name);
  ExprId WordValue(ExprId value);
  /// An index or an element of a place that is written: its inside is a value.
  ExprId Place(ExprId id);
  ExprId List(const Expr& expr);

  void Assign(ExprId place, ExprId value);
  void If(ExprId condition);
  void EndIf() { Statement(WordOp::kEndIf, {}, Id<void>::kNone); }
  void Statement(WordOp op, ExprId value, std::uint32_t extra);
  ExprId NewValue(std::string_view name) { return make_.Variable(NewLocal(module_, program_, name, Type::kReal)); }

  void LowerBlock(BlockId id);
  void LowerWhile(BlockId id);

  Module& module_;
  ProgramId program_;
  const LowerExpressionsConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  ProgramEditor editor_;
  BlockId block_;                  // block being lowered
  std::vector<Block> statements_;  // that go in front of it
  std::uint32_t labels_ = 0;
  std::optional<analysis::NumberKinds> kinds_;
  bool ok_ = true;
};

void Lowering::Statement(WordOp op, ExprId value, std::uint32_t extra) {
  Block made = editor_.MakeBlock(block_);
  // A test is left out with its block too: what it divides by may be zero then.
  made.skip_level = IsStructureMark(op) && op != WordOp::kIf ? Block::kNoSkip : module_.blocks[block_].skip_level;
  editor_.SetWords(made, {MakeWord(op, 0, value, extra)});
  statements_.push_back(made);
}

void Lowering::Assign(ExprId place, ExprId value) { Statement(WordOp::kAssign, value, place.value); }
void Lowering::If(ExprId condition) { Statement(WordOp::kIf, condition, Id<void>::kNone); }

ExprId Lowering::Simple(ExprId value, std::string_view name) {
  if (IsSimplePlace(module_, value)) return value;
  const ExprId held = NewValue(name);
  Assign(held, value);
  return held;
}

/// The value of a word: what only statements can say stands in front.
ExprId Lowering::WordValue(ExprId value) {
  const ExprId lowered = Value(value);
  if (config_.round_in_words || !HasFunction(module_, lowered, Function::kRound)) return lowered;
  const ExprId held = NewValue("ROUNDED");
  Assign(held, lowered);
  return held;
}

ExprId Lowering::Truth(ExprId condition) {
  const ExprId inner = Condition(condition);
  const ExprId value = NewValue("TRUTH");
  Assign(value, make_.Literal(0));
  If(inner);
  Assign(value, make_.Literal(1));
  EndIf();
  return value;
}

ExprId Lowering::Condition(ExprId id) {
  const Expr expr = module_.exprs[id];
  switch (expr.op) {
    case ExprOp::kGroup:
      return make_.Unary(ExprOp::kGroup, Condition(ExprId{expr.a}));
    case ExprOp::kNot:
      return make_.Unary(ExprOp::kNot, Condition(ExprId{expr.a}));
    case ExprOp::kConvert:
      if (expr.type == Type::kBool) return Condition(ExprId{expr.a});
      break;
    case ExprOp::kAnd:
    case ExprOp::kOr: {
      const ExprId left = Condition(ExprId{expr.a});
      return make_.Binary(expr.op, left, Condition(ExprId{expr.b}));
    }
    case ExprOp::kXor: {
      // Two truth values that differ; as numbers they are 0 or 1 each.
      const ExprId left = Truth(ExprId{expr.a});
      return make_.Binary(ExprOp::kNotEqual, left, Truth(ExprId{expr.b}));
    }
    default:
      if (IsComparison(expr.op)) return Comparison(expr);
      break;
  }
  return Value(id);
}

/// Without brackets, conversions and signs, which change no size.
ExprId Core(const Module& module, ExprId id) {
  while (true) {
    const Expr& expr = module.exprs[id];
    if (expr.op != ExprOp::kGroup && expr.op != ExprOp::kConvert && expr.op != ExprOp::kPlus &&
        expr.op != ExprOp::kNegate)
      return id;
    id = ExprId{expr.a};
  }
}

bool Lowering::MayNearlyEqual(ExprId left, ExprId right) {
  if (!kinds_) return false;
  for (const ExprId side : {left, right}) {
    const Expr& core = module_.exprs[Core(module_, side)];
    if (core.type == Type::kString) return false;
    // A part of nothing is nothing: beside 0 only 0 is equal.
    if (core.op == ExprOp::kLiteral && core.number == 0) return false;
  }
  return !analysis::IsExact(kinds_->At(program_, block_, left)) ||
         !analysis::IsExact(kinds_->At(program_, block_, right));
}

ExprId Lowering::Band(ExprId value) {
  const Expr& expr = module_.exprs[value];
  const bool positive = expr.op == ExprOp::kLiteral && expr.number > 0;
  // In steps that eight digits can write.
  ExprId band = positive ? value : make_.Function(Function::kAbs, {value});
  for (double rest = 1 / config_.compare_tolerance; rest > 1.5;) {
    const double step = std::fmin(rest, 1e6);
    band = make_.Binary(ExprOp::kDivide, band, make_.Literal(std::round(step)));
    rest /= step;
  }
  return band;
}

/// a == b within a tolerance: ABS(a - b) <= band; a < b and not equal: b - a > band; and their opposites. Which of the
/// two sides gives the band makes no difference where it decides: there they are nearly equal.
ExprId Lowering::Comparison(const Expr& expr) {
  ExprId left = Value(ExprId{expr.a});
  const bool plain = (expr.flags & Expr::kTolerance) == 0 || !MayNearlyEqual(ExprId{expr.a}, ExprId{expr.b});
  ExprId right = Value(ExprId{expr.b});
  const auto flags = static_cast<std::uint8_t>(expr.flags & ~Expr::kTolerance);
  if (plain) return make_.Binary(expr.op, left, right, flags);
  const bool by_left = module_.exprs[left].op == ExprOp::kLiteral || !IsSimplePlace(module_, right);
  ExprId& measure = by_left && IsSimplePlace(module_, left) ? left : right;
  measure = Simple(measure, "LIMIT");
  const ExprId band = Band(measure);
  const bool swapped = expr.op == ExprOp::kLess || expr.op == ExprOp::kGreaterEqual;
  const ExprId greater = swapped ? right : left, less = swapped ? left : right;
  const Expr subtracted = module_.exprs[less];
  const bool negative = subtracted.op == ExprOp::kNegate && module_.exprs[ExprId{subtracted.a}].op == ExprOp::kLiteral;
  ExprId difference = negative ? make_.Binary(ExprOp::kAdd, greater, ExprId{subtracted.a})
                               : make_.Binary(ExprOp::kSubtract, greater, less);
  if (expr.op == ExprOp::kEqual || expr.op == ExprOp::kNotEqual)
    difference = make_.Function(Function::kAbs, {difference});
  const bool apart = expr.op == ExprOp::kNotEqual || expr.op == ExprOp::kLess || expr.op == ExprOp::kGreater;
  return make_.Binary(apart ? ExprOp::kGreater : ExprOp::kLessEqual, difference, band);
}

ExprId Lowering::List(const Expr& expr) {
  std::vector<ExprId> items;
  for (std::uint32_t i = 0; i < expr.count; ++i) items.push_back(Value(module_.Item(expr.b + i)));
  Expr copy = expr;
  copy.b = static_cast<std::uint32_t>(module_.expr_items.size());
  module_.expr_items.insert(module_.expr_items.end(), items.begin(), items.end());
  return module_.AddExpr(copy);
}

ExprId Lowering::ValueOfFunction(const Expr& expr) {
  const auto argument = [&](std::uint32_t i) { return module_.Item(expr.b + i); };
  switch (static_cast<Function>(expr.a)) {
    case Function::kMinimum:
    case Function::kMaximum: {
      if (config_.has_min_max) break;
      const ExprId result = NewValue(static_cast<Function>(expr.a) == Function::kMinimum ? "SMALLER" : "LARGER");
      const ExprId first = Value(argument(0));
      const ExprId second = Simple(Value(argument(1)), "OTHER");
      Assign(result, first);
      If(make_.Binary(static_cast<Function>(expr.a) == Function::kMinimum ? ExprOp::kLess : ExprOp::kGreater, second,
                      result));
      Assign(result, second);
      EndIf();
      return result;
    }
    case Function::kBound: {
      if (config_.has_min_max) break;
      const ExprId low = Simple(Value(argument(0)), "LOW");
      const ExprId high = Simple(Value(argument(1)), "HIGH");
      const ExprId result = NewValue("BOUNDED");
      const ExprId value = Value(argument(2));
      // Limits that are swapped are an alarm, and so is the root of a negative number (sinumerik-4.3).
      const Expr least = module_.exprs[low], most = module_.exprs[high];
      const bool ordered = least.op == ExprOp::kLiteral && most.op == ExprOp::kLiteral && least.number <= most.number;
      if (!ordered) Assign(result, make_.Function(Function::kSqrt, {make_.Binary(ExprOp::kSubtract, high, low)}));
      Assign(result, value);
      If(make_.Binary(ExprOp::kLess, result, low));
      Assign(result, low);
      EndIf();
      If(make_.Binary(ExprOp::kGreater, result, high));
      Assign(result, high);
      EndIf();
      return result;
    }
    case Function::kRoundUp: {
      if (config_.has_round_up) break;
      const ExprId value = Simple(Value(argument(0)), "VALUE");
      const ExprId result = NewValue("ROUNDED_UP");
      Assign(result, make_.Function(Function::kTruncate, {value}));
      If(make_.Binary(ExprOp::kLess, result, value));
      Assign(result, make_.Binary(ExprOp::kAdd, result, make_.Literal(1)));
      EndIf();
      return result;
    }
    case Function::kSquare: {
      if (config_.has_square) break;
      const ExprId value = Simple(Value(argument(0)), "VALUE");
      return make_.Unary(ExprOp::kGroup, make_.Binary(ExprOp::kMultiply, value, value));
    }
    case Function::kAtan2:
    case Function::kAsin: {
      const bool atan = static_cast<Function>(expr.a) == Function::kAtan2;
      if (atan ? config_.signed_atan2 : config_.signed_asin) break;
      // The target's angle may run from 0 to 360: what lies above 180 is the negative angle.
      const ExprId result = NewValue("ANGLE");
      if (atan) {
        const ExprId across = Value(argument(0));
        Assign(result, make_.Function(Function::kAtan2Positive, {across, Value(argument(1))}));
      } else {
        Assign(result, make_.Function(Function::kAsin, {Value(argument(0))}));
      }
      If(make_.Binary(ExprOp::kGreater, result, make_.Literal(180)));
      Assign(result, make_.Binary(ExprOp::kSubtract, result, make_.Literal(360)));
      EndIf();
      return result;
    }
    default:
      break;
  }
  return List(expr);
}

ExprId Lowering::Value(ExprId id) {
  const Expr expr = module_.exprs[id];
  if (!config_.truth_values && IsTruth(module_, id)) return Truth(id);
  switch (expr.op) {
    case ExprOp::kFunction:
      return ValueOfFunction(expr);
    case ExprOp::kConvert: {
      const Expr& inner = module_.exprs[ExprId{expr.a}];
      if (expr.type == Type::kBool) {
        // Any number but 0 is true, and a truth value that is used as a number is 1.
        if (inner.type == Type::kBool) return Value(ExprId{expr.a});
        return Truth(make_.Binary(ExprOp::kNotEqual, ExprId{expr.a}, make_.Literal(0)));
      }
      const ExprId value = Value(ExprId{expr.a});
      const bool whole = expr.type == Type::kInt || expr.type == Type::kChar;
      if (!whole || IsIntegral(module_, ExprId{expr.a})) return value;
      return make_.Function((expr.flags & Expr::kRoundCut) != 0 ? Function::kTruncate : Function::kRound, {value});
    }
    case ExprOp::kDivideInteger:
    case ExprOp::kModulo: {
      if (expr.op == ExprOp::kDivideInteger ? config_.has_integer_quotient : config_.has_modulo) break;
      ExprId left = Value(ExprId{expr.a});
      ExprId right = Value(ExprId{expr.b});
      if ((expr.flags & Expr::kOperandsToInt) != 0) {
        left = make_.Function(Function::kRound, {left});
        right = make_.Function(Function::kRound, {right});
      }
      if (expr.op == ExprOp::kModulo) {
        left = Simple(left, "DIVIDEND");
        right = Simple(right, "DIVISOR");
      }
      const ExprId quotient = make_.Function(Function::kTruncate, {make_.Binary(ExprOp::kDivide, left, right)});
      if (expr.op == ExprOp::kDivideInteger) return quotient;
      return make_.Unary(ExprOp::kGroup,
                         make_.Binary(ExprOp::kSubtract, left, make_.Binary(ExprOp::kMultiply, right, quotient)));
    }
    case ExprOp::kBitNot:
      return make_.Unary(ExprOp::kGroup, make_.Binary(ExprOp::kSubtract, make_.Literal(-1), Value(ExprId{expr.a})));
    default:
      break;
  }
  Expr copy = expr;
  switch (OperandsOf(expr.op)) {
    case Operands::kLeaf:
      return id;
    case Operands::kUnary:
      copy.a = Value(ExprId{expr.a}).value;
      return copy.a == expr.a ? id : module_.AddExpr(copy, module_.expr_places.Of(id));
    case Operands::kBinary:
      copy.a = Value(ExprId{expr.a}).value;
      copy.b = Value(ExprId{expr.b}).value;
      return copy.a == expr.a && copy.b == expr.b ? id : module_.AddExpr(copy, module_.expr_places.Of(id));
    case Operands::kList:
      return List(expr);
  }
  return id;
}

ExprId Lowering::Place(ExprId id) {
  const Expr expr = module_.exprs[id];
  return expr.op == ExprOp::kCellAt || expr.op == ExprOp::kElement ? Value(id) : id;
}

/// WHILE c .. ENDWHILE with statements for c: LOOP, statements, jump out when c is false, .. ENDLOOP.
void Lowering::LowerWhile(BlockId id) {
  const Block block = module_.blocks[id];
  const Word word = module_.words[block.words[0]];
  std::vector<Block> outer = std::exchange(statements_, {});
  const ExprId condition = Condition(word.value);
  std::vector<Block> inner = std::exchange(statements_, std::move(outer));
  if (inner.empty()) {
    module_.words[block.words[0]].value = condition;
    return;
  }
  const std::string label = fmt::format("NCPORT_OUT_{}", ++labels_);
  module_.words[block.words[0]] = MakeWord(WordOp::kLoop);
  Jump jump;
  jump.target.label = module_.strings.Intern(label);
  jump.search = Search::kForward;
  Word out = MakeWord(WordOp::kJump, 0, make_.Unary(ExprOp::kNot, make_.Unary(ExprOp::kGroup, condition)),
                      module_.jumps.Add(jump).value);
  Block leave = editor_.MakeBlock(id);
  editor_.SetWords(leave, {out});
  inner.push_back(leave);
  for (const Block& made : inner) editor_.InsertAfter(id, made);
  module_.words[module_.blocks[block.link].words[0]].op = WordOp::kEndLoop;
  Block behind = editor_.MakeBlock(block.link);
  behind.label = jump.target.label;
  editor_.InsertAfter(block.link, behind);
}

void Lowering::LowerBlock(BlockId id) {
  block_ = id;
  statements_.clear();
  const Block block = module_.blocks[id];
  for (const WordId word_id : block.words) {
    const Word word = module_.words[word_id];
    ExprId value = word.value;
    std::uint32_t extra = word.extra;
    switch (word.op) {
      case WordOp::kMessage:
      case WordOp::kPrint:
      case WordOp::kAlarm:
      case WordOp::kHeader:
      case WordOp::kExtern:
      case WordOp::kVerbatim:
      case WordOp::kWorkpiece:
        continue;  // texts; they have passes of their own
      case WordOp::kIf:
      case WordOp::kUntil:
      case WordOp::kJump:
      case WordOp::kWhen:
        if (value.Valid()) value = Condition(value);
        break;
      case WordOp::kWhile:
        LowerWhile(id);
        continue;
      case WordOp::kFor: {
        const For loop = module_.fors[word.Extra<ForId>()];
        const bool near = MayNearlyEqual(loop.variable, loop.end);
        const bool rounds = config_.for_counter_rounds && !IsIntegral(module_, value);
        value = Value(value);
        if (rounds) value = make_.Function(Function::kRound, {value});
        ExprId end = Value(loop.end);
        if (near) {
          // The last pass runs where the counter is past the end by less than the band.
          end = Simple(end, "END");
          end = make_.Binary(ExprOp::kAdd, end, Band(end));
        }
        module_.fors[word.Extra<ForId>()].end = end;
        break;
      }
      case WordOp::kSwitch: {
        value = Value(value);
        const Switch cases = module_.switches[word.Extra<SwitchId>()];
        for (std::uint32_t i = 0; i < cases.arm_count; ++i) {
          SwitchArm& arm = module_.switch_arms[cases.first_arm + i];
          const ExprId arm_value = arm.value.Valid() ? Value(arm.value) : ExprId{};
          module_.switch_arms[cases.first_arm + i].value = arm_value;
        }
        break;
      }
      case WordOp::kAssign:
        extra = Place(word.Extra<ExprId>()).value;
        value = Value(value);
        break;
      case WordOp::kCall:
      case WordOp::kModalCall: {
        if (!word.Extra<CallId>().Valid()) break;
        const Call call = module_.calls[word.Extra<CallId>()];
        for (const ArgId arg : call.args) {
          const ExprId given = module_.args[arg].value;
          if (given.Valid()) {
            const ExprId lowered = WordValue(given);
            module_.args[arg].value = lowered;
          }
        }
        if (call.passes.Valid()) {
          const ExprId passes = Value(call.passes);
          module_.calls[word.Extra<CallId>()].passes = passes;
        }
        break;
      }
      case WordOp::kDefine: {
        const ExprId initial = module_.variables[word.Extra<VariableId>()].initial;
        if (initial.Valid()) {
          const ExprId lowered = Value(initial);
          module_.variables[word.Extra<VariableId>()].initial = lowered;
        }
        break;
      }
      default:
        if (value.Valid() && module_.exprs[value].type != Type::kString) value = WordValue(value);
        break;
    }
    module_.words[word_id].value = value;
    module_.words[word_id].extra = extra;
  }
  if (statements_.empty()) return;
  // The statements take over the place that jumps go to.
  editor_.TakeHead(statements_.front(), id, {.skip = false});
  for (const Block& made : statements_) editor_.InsertBefore(id, made);
}

bool Lowering::Run() {
  const std::size_t errors = sink_.ErrorCount();  // of other passes
  for (const BlockId id : module_.programs[program_].blocks) LowerBlock(id);
  editor_.Apply();
  return ok_ && sink_.ErrorCount() == errors;
}

}  // namespace

bool LowerExpressions(Module& module, ProgramId program, const LowerExpressionsConfig& config, diag::Sink& sink) {
  return Lowering(module, program, config, sink).Run();
}

}  // namespace ncport::ir::transform
