// Calls, returns, and data of G10 (fanuc-7, 8.9; mazak-lathe-1.1, 6.1).
#include <cmath>

#include "base/result.h"
#include "frontend/fanuc/lower.h"

namespace ncport::frontend::fanuc {

namespace words = dialects::fanuc;
using diag::Code;
using ir::ExprId;
using ir::Word;
using ir::WordOp;

/// Program by number, by expression, or by name.
bool Lowering::Callee(const Pending* program, const Pending* name, const Pending& at, ir::Call& call) {
  if (name != nullptr) {
    call.name = At(name->first).Text();
    return true;
  }
  if (program == nullptr) return Fail(Code::kMissingValue, at, "name the program: P and its number");
  if (!IsLiteral(*program)) {
    call.form = ir::CallForm::kText;
    call.name_expr = program->value;
    return true;
  }
  if (!Whole(*program)) return false;
  if (!(NumberOf(*program) >= 1 && NumberOf(*program) <= 99999999)) {
    return Fail(Code::kOutOfRange, *program, nullptr, "program numbers 1 to 99999999");
  }
  call.name = module_.strings.Intern("O" + std::to_string(static_cast<std::uint32_t>(NumberOf(*program))));
  return true;
}

// Which cell each letter fills: list I, and list II for I J K that stand again or out of order (fanuc-7.3).
bool Lowering::MacroArguments(const Context& context, IdRange<ir::ArgId>& args) {
  args.begin = static_cast<std::uint32_t>(module_.args.Size());
  std::uint32_t set = 0;
  std::uint32_t last = 3;
  const bool first_list_only = profile_.fanuc.arguments_always_first_list.Or(false);
  bool behind = false;
  for (const Pending& pending : pending_) {
    if (&pending == context.call) {
      behind = true;
      continue;
    }
    if (pending.letter == kSkipLetter) return Fail(Code::kNotSupported, pending);
    if (!behind)
      return Fail(Code::kNotAlone, *context.call,
                  "the arguments stand behind the call, nothing else stands in its block");
    const char letter = pending.letter;
    if (letter == 'P' || letter == 'L' || letter == kNameLetter) continue;
    std::uint32_t cell = 0;
    if (letter >= 'I' && letter <= 'K' && !first_list_only) {
      const auto position = static_cast<std::uint32_t>(letter - 'I');
      if (set == 0 || position <= last) ++set;
      if (set > words::kArgumentSets) return Fail(Code::kDoubleWord, pending, "at most ten sets of I J K");
      last = position;
      cell = words::ArgumentCell(set, position);
    } else {
      cell = words::ArgumentCell(letter);
    }
    if (cell == 0) return Fail(Code::kUnexpectedText, pending, "G L N O P are no arguments");
    ir::Arg arg;
    arg.letter = letter;
    arg.position = static_cast<std::uint16_t>(cell);
    if (IsLiteral(pending)) {
      arg.value = Literal(At(pending.first));
      // D E H M S T and F count whole (fanuc-7.3); F has no feed mode here: its number is taken as it stands.
      constexpr std::string_view kLengths = "ABCIJKQRUVWXYZ";
      arg.increments = increments_ && !HasPoint(pending) && NumberOf(pending) != 0 &&
                       kLengths.find(letter) != std::string_view::npos;
    } else {
      arg.value = pending.value;
    }
    module_.args.Add(arg);
  }
  args.count = static_cast<std::uint32_t>(module_.args.Size()) - args.begin;
  return true;
}

bool Lowering::MacroCall(const Context& context) {
  if (context.call_kind == Special::kModalMacroEachBlock) {
    return Fail(Code::kNotSupported, *context.call, "a call at every block; write the calls out, or use G66");
  }
  ir::Call call;
  const Pending* program = FindLetter('P');
  const Pending* name = FindLetter(kNameLetter);
  if (!Callee(program, name, *context.call, call)) return false;
  if (const Pending* passes = FindLetter('L')) {
    std::uint8_t flags = 0;
    if (!Whole(*passes)) return false;
    call.passes = ValueOf(*passes, flags);
  }
  if (!MacroArguments(context, call.args)) return false;
  const ir::CallId id = module_.calls.Add(call);
  const bool modal = context.call_kind == Special::kModalMacro;
  Word& word = AddWord(modal ? WordOp::kModalCall : WordOp::kCall, context.call->first, pending_.back().last);
  word.extra = id.value;
  word.spelling = SpellingOf(modal ? "G66" : "G65", modal ? "fanuc-7.4" : "fanuc-7.3");
  return true;
}

// M98: the caller's locals are shared (fanuc-7.1). Words beside it run first.
bool Lowering::Subprogram(const Context& context) {
  const Pending& at = *context.subprogram_word;
  ir::Call call;
  call.new_level = false;
  const Pending* program = FindLetter('P');
  const Pending* name = FindLetter(kNameLetter);
  const Pending* start = nullptr;
  const bool mazak = profile_.fanuc.variant.Is(dialects::FanucSettings::Variant::kMazak);
  if (context.local_call) {
    // Haas M97 P100: from N100 of this program up to M99.
    start = program;
    program = nullptr;
  } else if (const Pending* sequence = FindLetter('H'); sequence != nullptr && mazak) {
    start = sequence;
  } else if (const Pending* block = FindLetter('Q')) {
    if (!mazak && !profile_.fanuc.call_from_block.Or(false))
      return Fail(Code::kNotSupported, *block, "6005#0 SQC is 0 in the profile");
    start = block;
  }
  if (start != nullptr) {
    if (!Whole(*start)) return false;
    call.from_block = true;
    if (IsLiteral(*start)) {
      if (!(NumberOf(*start) >= 1 && NumberOf(*start) <= 99999999))
        return Fail(Code::kOutOfRange, *start, nullptr, "block numbers 1 to 99999999");
      call.from.kind = ir::TargetKind::kNumber;
      call.from.number = static_cast<std::uint32_t>(NumberOf(*start));
    } else {
      call.from.kind = ir::TargetKind::kExpression;
      call.from.expr = start->value;
    }
  } else if (context.local_call) {
    return Fail(Code::kMissingValue, at, "P names the block");
  }
  const bool own = start != nullptr && program == nullptr && name == nullptr;
  if (!own && !Callee(program, name, at, call)) return false;
  if (const Pending* passes = FindLetter('L')) {
    std::uint8_t flags = 0;
    if (!Whole(*passes)) return false;
    call.passes = ValueOf(*passes, flags);
  }
  const ir::CallId id = module_.calls.Add(call);
  Word& word = AddWord(WordOp::kCall, at);
  word.extra = id.value;
  word.spelling = SpellingOf(context.local_call ? "M97" : "M98", "fanuc-7.2");
  return true;
}

bool Lowering::Return(const Context&, const Pending& pending) {
  if (const Pending* passes = FindLetter('L')) {
    return Fail(Code::kNotSupported, *passes, "a return that changes the number of passes");
  }
  ExprId value;
  if (const Pending* block = FindLetter('P')) {
    std::uint8_t flags = 0;
    if (!Whole(*block)) return false;
    value = ValueOf(*block, flags);
  }
  Word& word = AddWord(WordOp::kReturn, pending);
  word.value = value;
  word.index = static_cast<std::uint8_t>(value.Valid() ? ir::ReturnKind::kToCaller : ir::ReturnKind::kPlain);
  word.spelling = SpellingOf("M99", "fanuc-6.6");
  return true;
}

// G10 writes offsets, G22 the limits of the stroke check; none of them shows in a trace, but where the axes stand in
// the work system may change (fanuc-8.1, 8.9).
bool Lowering::DataSetting(const Context& context) {
  const words::SpecialRow& row = *context.data->meaning.special;
  ir::Call call;
  call.name = module_.strings.Intern(row.text);
  call.args.begin = static_cast<std::uint32_t>(module_.args.Size());
  const char* alone = row.special == Special::kData ? "G10 stands with its own words only"
                                                    : "axis words beside G22 are limits: it stands with them alone";
  for (const Pending& pending : pending_) {
    if (&pending == context.data) continue;
    if (pending.letter == 'G' && IsLiteral(pending)) {
      if (pending.meaning.code == nullptr || pending.meaning.code->op != WordOp::kDistance)
        return Fail(Code::kNotAlone, pending, alone);
      AddCode(pending, {});
      continue;
    }
    if (pending.letter == 'M' || pending.letter == 'T' || pending.letter == 'S' || pending.letter == kNameLetter ||
        pending.letter == kSkipLetter) {
      return Fail(Code::kNotAlone, pending, alone);
    }
    if (row.special == Special::kData && pending.letter == 'L' &&
        (!IsLiteral(pending) || NumberOf(pending) == 3 || NumberOf(pending) >= 50)) {
      return Fail(Code::kNotSupported, pending, "tool life data and parameters");
    }
    ir::Arg arg;
    arg.letter = pending.letter;
    arg.position = static_cast<std::uint16_t>(call.args.count);
    std::uint8_t flags = 0;
    arg.value = ValueOf(pending, flags);
    arg.increments = IsLiteral(pending) && !HasPoint(pending) && increments_ && NumberOf(pending) != 0 &&
                     pending.letter != 'L' && pending.letter != 'P';
    module_.args.Add(arg);
    ++call.args.count;
  }
  const ir::CallId id = module_.calls.Add(call);
  Word& word = AddWord(WordOp::kDataSetting, context.data->first, pending_.back().last);
  word.extra = id.value;
  word.spelling = SpellingOf(row.text, row.rule);
  return true;
}

}  // namespace ncport::frontend::fanuc
