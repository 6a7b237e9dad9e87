// Calls: the program, and what its parameters make of the arguments (card 3.7, 7.1).
#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "base/letter_case.h"
#include "base/near_name.h"
#include "dialects/sinumerik/cycle_parameters.h"
#include "dialects/sinumerik/library.h"
#include "dialects/sinumerik/words.h"
#include "frontend/common/chars.h"
#include "frontend/sinumerik/reader.h"
#include "frontend/sinumerik/resolve.h"
#include "frontend/sinumerik/resolver.h"
#include "frontend/sinumerik/word_slips.h"

namespace ncport::frontend::sinumerik {

using diag::Code;
using dialects::sinumerik::FindCycleParameters;
using dialects::sinumerik::IsTextParameter;
using dialects::sinumerik::ParameterAt;
using ir::ExprId;
using ir::ExprOp;
using ir::Type;

namespace {

std::string_view TypeText(Type type) {
  for (const auto& row : dialects::sinumerik::Types()) {
    if (row.type == type) return row.text;
  }
  return "another type";
}

/// The path of `;$PATH=/_N_WKS_DIR/_N_SHAFT_WPD`, in upper case; empty: the comment is none.
std::string PathMark(std::string_view comment) {
  std::string text;
  for (const char c : comment) {
    if (c != ' ' && c != '\t' && (c != ';' || !text.empty())) text += Upper(c);
  }
  constexpr std::string_view kMark = "$PATH=";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : std::string();
}

/// True if the last folder of the path whose kind a name tells is one of part programs, subprograms or work pieces:
/// `/_N_WKS_DIR/_N_SHAFT_WPD`, `WKS.DIR/SHAFT.WPD` (card 7.2).
bool IsPlainFolder(std::string_view path) {
  while (!path.empty()) {
    const std::size_t cut = path.find_last_of("/\\");
    std::string_view folder = cut == std::string_view::npos ? path : path.substr(cut + 1);
    path = cut == std::string_view::npos ? std::string_view{} : path.substr(0, cut);
    if (folder.starts_with("_N_")) folder.remove_prefix(3);
    const auto is_kind = [&](std::string_view kind) {
      return folder.size() == kind.size() + 4 && folder.starts_with(kind) && folder.ends_with("DIR") &&
             (folder[kind.size()] == '_' || folder[kind.size()] == '.');
    };
    if (folder.ends_with("_WPD") || folder.ends_with(".WPD")) return true;
    if (is_kind("SPF") || is_kind("MPF") || is_kind("WKS")) return true;
    if (is_kind("CUS") || is_kind("CMA") || is_kind("CST")) return false;
  }
  return false;
}

}  // namespace

bool Resolver::Call(ir::Word& word) {
  const ir::CallId id = word.Extra<ir::CallId>();
  ir::Call call = module_.calls[id];
  if (call.passes.Valid() && !Converted(call.passes, Type::kInt)) return false;
  // Card 10, row 33.
  if (call.passes.Valid() && module_.exprs[call.passes].op == ExprOp::kLiteral &&
      (module_.exprs[call.passes].number < 1 || module_.exprs[call.passes].number > 9999))
    return Fail(Code::kOutOfRange, call.passes, module_.exprs[call.passes].number, "1 to 9999 passes");
  if (word.op == ir::WordOp::kWorkpiece) {
    for (const ir::ArgId arg : call.args) {
      if (module_.args[arg].value.Valid() && !Scalar(module_.args[arg].value)) return false;
    }
    return true;
  }
  if (call.name_expr.Valid()) {
    ir::Expr& name = module_.exprs[call.name_expr];
    // CALL NAME BLOCK ..: a variable with the name of the program, or the program itself.
    if (name.op == ExprOp::kName && name.count == 0) {
      const StringId text{std::size_t{name.a}};
      if (!FindVariable(module_.View(text)).Valid() && programs_->Find(module_.View(text)).Valid()) {
        name.op = ExprOp::kText;
        name.type = Type::kString;
        call.name = text;
        call.name_expr = {};
      }
    }
    if (call.name_expr.Valid()) {
      if (!ScalarOrText(call.name_expr)) return false;
      const ir::Expr& resolved = module_.exprs[call.name_expr];
      if (resolved.type != Type::kString && resolved.type != Type::kAny) {
        return Mismatch(call.name_expr, "a number", "the name of a program");
      }
      if (resolved.op == ExprOp::kText) {
        call.program = programs_->Find(module_.View(StringId{std::size_t{resolved.a}}));
      }
    }
  }
  if (call.name.Valid()) {
    call.program = programs_->Find(module_.View(call.name));
    if (!call.program.Valid() && !DeclaredArguments(call, word)) return false;
    // A macro whose DEFINE was not understood has its finding.
    if (!call.program.Valid() && refused_names_.contains(UpperOf(module_.View(call.name)))) return true;
    // So has a PROC line that was not: the file may have another name.
    if (!call.program.Valid() && IsInRefusedHeader(module_.View(call.name))) return true;
    if (!call.program.Valid() && missing_programs_.insert(std::string(module_.View(call.name))).second) {
      // The block stays: a run that gets there ends in the alarm of the control.
      UnknownProgram(module_.View(call.name), module_.RangeOf(module_.blocks[block_], word), !call.args.Empty());
    }
  }
  const bool in_own_program = !call.program.Valid() && !call.name_expr.Valid();
  if (!Target(call.from, in_own_program) || !Target(call.to, in_own_program)) return false;
  module_.calls[id] = call;
  return Arguments(call, word);
}

bool Resolver::IsInRefusedHeader(std::string_view name) const {
  for (const ir::ProgramId program : module_.programs.Ids()) {
    if (module_.programs[program].library || !HeaderRefused(program)) continue;
    for (const ir::BlockId id : module_.programs[program].blocks) {
      const ir::Block& block = module_.blocks[id];
      if ((block.flags & ir::Block::kRefused) == 0 || block.words.Empty()) continue;
      const ir::Word& word = module_.words[block.words[0]];
      if (word.op != ir::WordOp::kVerbatim) continue;
      std::string_view text = module_.View(word.Extra<StringId>());
      if (text.size() <= 4 || !IsWord(text.substr(0, 4), "PROC")) break;
      text.remove_prefix(std::min(text.find_first_not_of(" \t", 4), text.size()));
      if (IsWord(text.substr(0, text.find_first_of(" \t(;")), UpperOf(name))) return true;
      break;
    }
  }
  return false;
}

bool Resolver::HeaderRefused(ir::ProgramId program) const {
  for (const ir::BlockId id : module_.programs[program].blocks) {
    const ir::Block& block = module_.blocks[id];
    if (block.words.Empty()) continue;
    const ir::Word& word = module_.words[block.words[0]];
    if (word.op == ir::WordOp::kFileMark) continue;
    return word.op == ir::WordOp::kVerbatim && module_.View(word.Extra<StringId>()).size() > 4 &&
           IsWord(module_.View(word.Extra<StringId>()).substr(0, 4), "PROC");
  }
  return false;
}

void Resolver::TellParameter(diag::Diagnostic& finding) const {
  if (!parameter_.Valid()) return;
  const ir::Variable& parameter = module_.variables[parameter_];
  finding.notes.push_back({{parameter.file, parameter.line, parameter.begin, parameter.begin + parameter.length},
                           "for parameter " + std::string(module_.View(parameter.name))});
}

bool Resolver::Arguments(const ir::Call& call, const ir::Word& word) {
  if (!call.program.Valid() || HeaderRefused(call.program)) {
    const auto* cycle =
        call.program.Valid() || !call.name.Valid() ? nullptr : FindCycleParameters(module_.View(call.name));
    for (const ir::ArgId id : call.args) {
      const ir::Arg arg = module_.args[id];
      if (!arg.value.Valid()) continue;
      text_likely_ = cycle != nullptr && IsTextParameter(*cycle, ParameterAt(*cycle, arg.position));
      // A whole array may be an argument.
      const bool ok = Expr(arg.value);
      text_likely_ = false;
      if (!ok) return false;
    }
    return cycle == nullptr || (CycleTypes(call, word, *cycle) && CycleRanges(call, *cycle));
  }
  const ir::Program& program = module_.programs[call.program];
  const SourceRange at = module_.RangeOf(module_.blocks[block_], word);
  if (call.args.count > program.parameters.count) {
    sink_.Report(Code::kArgumentCount, at, module_.View(program.name), program.parameters.count, call.args.count);
    return false;
  }
  for (const ir::ArgId id : call.args) {
    ir::Arg arg = module_.args[id];
    if (!arg.value.Valid()) continue;
    parameter_ = program.library ? ir::VariableId{} : program.parameters[arg.position];
    const bool ok = Argument(arg, program.parameters[arg.position]);
    parameter_ = {};
    if (!ok) return false;
    module_.args[id] = arg;
  }
  for (std::uint32_t i = 0; i < program.parameters.count; ++i) {
    const ir::Variable& parameter = module_.variables[program.parameters[i]];
    const bool given = i < call.args.count && module_.args[call.args[i]].value.Valid();
    if (parameter.by_reference && !given) {
      sink_.Report(Code::kMissingArgument, at, module_.View(program.name), module_.View(parameter.name));
      return false;
    }
  }
  if (!program.library) WantExtern(call, word);
  if (!program.library) return true;
  const auto* cycle = FindCycleParameters(module_.View(program.name));
  return CycleLimits(call) && (cycle == nullptr || CycleRanges(call, *cycle));
}

// Card 8.12: cycles that ncport does not run, but whose parameters are known.
bool Resolver::CycleTypes(const ir::Call& call, const ir::Word& word, const CycleParameters& cycle) {
  for (const ir::ArgId id : call.args) {
    const ir::Arg& arg = module_.args[id];
    const std::string_view parameter = ParameterAt(cycle, arg.position);
    if (!arg.value.Valid() || parameter.empty()) continue;
    const Type type = module_.exprs[arg.value].type;
    const bool text = type == Type::kString || type == Type::kChar;
    if (text && IsTextParameter(cycle, parameter)) ContourLabels(arg.value);
    if (type == Type::kAny || type == Type::kNone || text == IsTextParameter(cycle, parameter)) continue;
    const std::string help = std::string(parameter) + " of " + std::string(cycle.cycle);
    return Mismatch(arg.value, text ? "a text" : "a number", text ? "a number" : "a text", help);
  }
  const std::uint32_t most = CountOf(cycle);
  if (!cycle.complete || call.args.count <= most) return true;
  sink_
      .ReportAs(diag::Severity::kWarning, Code::kArgumentCount, module_.RangeOf(module_.blocks[block_], word),
                cycle.cycle, most, call.args.count)
      .help = "the last one is " + std::string(ParameterAt(cycle, most - 1)) + ": is a value or a comma too many?";
  return true;
}

// Card 8.12, CYCLE95: the contour stands between two labels of the program that calls.
void Resolver::ContourLabels(ExprId text) {
  const ir::Expr& expr = module_.exprs[text];
  if (expr.op != ExprOp::kText) return;
  const std::string_view names = module_.View(StringId{std::size_t{expr.a}});
  const std::size_t colon = names.find(':');
  if (colon == std::string_view::npos || colon < 2 || names.size() < colon + 3) return;
  for (const char c : names) {
    if (!IsLetter(c) && !IsDigit(c) && c != '_' && c != ':') return;
  }
  if (names.find(':', colon + 1) != std::string_view::npos) return;
  const SourceRange at = module_.RangeOf(module_.blocks[block_], text);
  // The other label of the text is not the one that is meant.
  std::vector<std::string_view> known;
  const std::string both = UpperOf(names);
  for (const std::string& label : labels_) {
    if (label != both.substr(0, colon) && label != both.substr(colon + 1)) known.push_back(label);
  }
  for (const std::size_t begin : {std::size_t{0}, colon + 1}) {
    const std::string_view name = begin == 0 ? names.substr(0, colon) : names.substr(begin);
    const std::string key = UpperOf(name);
    if (labels_.contains(key) || refused_names_.contains(key)) continue;
    diag::Diagnostic& finding = sink_.Report(Code::kUnknownLabel, at, name);
    const std::string_view near = NearName(key, known);
    finding.help = near.empty() ? "the contour stands between two labels of this program"
                                : "did you mean " + std::string(near) + "?";
  }
}

bool Resolver::CycleRanges(const ir::Call& call, const CycleParameters& cycle) {
  for (const auto& row : dialects::sinumerik::CycleValueRows()) {
    if (row.cycle != cycle.cycle) continue;
    for (const ir::ArgId id : call.args) {
      const ir::Arg& arg = module_.args[id];
      if (!arg.value.Valid() || ParameterAt(cycle, arg.position) != row.parameter) continue;
      const std::optional<double> value = LiteralNumber(arg.value);
      const std::span ranges(row.ranges, row.range_count);
      if (!value ||
          std::ranges::any_of(ranges, [&](const auto& range) { return *value >= range.low && *value <= range.high; }))
        continue;
      diag::Diagnostic& finding = sink_.ReportAs(diag::Severity::kWarning, Code::kOutOfRange,
                                                 module_.RangeOf(module_.blocks[block_], arg.value), *value, row.text);
      finding.notes.push_back({{}, "this is " + std::string(row.parameter) + " of " + std::string(row.cycle)});
      finding.help = row.help;
    }
  }
  return true;
}

bool Resolver::InPlainFolder(ir::ProgramId program) const {
  constexpr std::uint32_t kHeadBlocks = 3;  // the path stands directly below the header (card 1.1)
  std::uint32_t looked = 0;
  for (const ir::BlockId id : module_.programs[program].blocks) {
    if (++looked > kHeadBlocks) break;
    for (const ir::CommentId comment : module_.blocks[id].comments) {
      if (const std::string path = PathMark(module_.View(module_.comments[comment].text)); !path.empty())
        return IsPlainFolder(path);
    }
  }
  // Without the mark the folder of the file tells, as archives and computers keep them.
  const std::string name = UpperOf(files_.Name(module_.programs[program].file));
  const std::size_t end = name.find_last_of("/\\");
  return end != std::string::npos && IsPlainFolder(std::string_view(name).substr(0, end));
}

void Resolver::WantExtern(const ir::Call& call, const ir::Word& word) {
  if (call.args.Empty() || call.program == program_ || !call.name.Valid() || !InPlainFolder(call.program)) return;
  if (!externs_.insert(UpperOf(module_.View(call.name))).second) return;
  const ir::Program& program = module_.programs[call.program];
  diag::Diagnostic& finding =
      sink_.Report(Code::kMissingExtern, module_.RangeOf(module_.blocks[block_], word), module_.View(call.name));
  if (program.header_line != 0)
    finding.notes.push_back({{program.file, program.header_line, 0, 0}, "the program begins here"});
  finding.help = "programs of this folder are known to the control by EXTERN only";
}

void Resolver::UnknownProgram(std::string_view name, const SourceRange& at, bool with_arguments) {
  if (dialects::sinumerik::IsReserved(UpperOf(name))) {
    SourceRange word = at;
    word.end = word.begin + static_cast<std::uint32_t>(name.size());
    sink_.Report(Code::kNotSupported, word, name).help =
        FindCycleParameters(name) != nullptr
            ? "a cycle of the control that ncport does not run; only its arguments are looked at"
            : "a cycle of the control that ncport does not know; what it does is not looked at";
    return;
  }
  using Family = dialects::SinumerikSettings::Family;
  if (profile_.sinumerik.family.Is(Family::k802S) && UpperOf(name).starts_with("LCYC")) {
    sink_.Report(Code::kNotSupported, at, name).help =
        "a cycle of the control that ncport does not run; R100 to R149 hold its parameters";
    return;
  }
  diag::Diagnostic& finding = sink_.Report(Code::kUnknownProgram, at, name);
  if (const ForeignWord* foreign = FindForeignWord(name)) {
    finding.help = foreign->help;
    return;
  }
  std::vector<std::string_view> known;
  for (const ir::Program& program : module_.programs.All()) {
    if (!program.library) known.push_back(module_.View(program.name));
  }
  for (const std::string_view cycle : dialects::sinumerik::LibraryCycleNames()) known.push_back(cycle);
  const auto is_known = [&](std::string_view callee) {
    return std::ranges::any_of(known, [&](std::string_view one) { return IsWord(callee, UpperOf(one)); });
  };
  const auto jump_to_known = [&](const std::string& jump) {
    // Where the jump word ends, the labels tell: GOTOF INISH or GOTO FINISH.
    for (std::size_t word = 4; word < 6 && word < name.size(); ++word) {
      if (labels_.contains(UpperOf(name.substr(word))))
        return std::string(name.substr(0, word)) + " " + std::string(name.substr(word));
    }
    return jump;
  };
  const std::string_view near = name.size() < 3 ? std::string_view{} : NearName(name, known);
  if (!near.empty()) {
    finding.help = "did you mean " + std::string(near) + "?";
  } else if (jump_names_.contains(UpperOf(name))) {
    finding.help = "jumps name it: a label ends with a colon: " + std::string(name) + ":";
  } else if (const std::string whole = AsAddressWithValue(name); !whole.empty()) {
    finding.help = "an address of several letters has its value behind =: " + whole;
  } else if (const std::string blank = AsWordAndAxis(name); !blank.empty()) {
    finding.help = "a blank is missing: " + blank;
  } else if (const std::string jump = AsJumpAndLabel(name); !jump.empty()) {
    finding.help = "a blank is missing: " + jump_to_known(jump);
  } else if (const std::string split = AsRunTogether(name); !split.empty()) {
    finding.help = "a blank is missing: " + split;
  } else if (name.size() > 5 && IsWord(name.substr(0, 5), "MCALL") && is_known(name.substr(5))) {
    finding.help = "a blank is missing: MCALL " + std::string(name.substr(5));
  } else if (const std::string_view word =
                 with_arguments || name.size() < 3 ? std::string_view{} : NearStatementWord(name);
             !word.empty()) {
    finding.help = "did you mean " + std::string(word) + "?";
  } else {
    finding.help = "give its file too, or name its folder with -I";
  }
}

// The EXTERN of a program that is not here says what it takes.
bool Resolver::DeclaredArguments(const ir::Call& call, const ir::Word& word) {
  const std::string_view name = module_.View(call.name);
  const auto& declared = module_.externs.All();
  const auto found = std::find_if(declared.begin(), declared.end(), [&](const ir::Extern& record) {
    return IsWord(name, UpperOf(module_.View(record.name)));
  });
  if (found == declared.end()) return true;
  const ir::Extern record = *found;
  if (call.args.count > record.param_count) {
    sink_
        .Report(Code::kArgumentCount, module_.RangeOf(module_.blocks[block_], word), name, record.param_count,
                call.args.count)
        .help = "its EXTERN says so";
    return false;
  }
  for (const ir::ArgId id : call.args) {
    const ir::ExternParam& parameter = module_.extern_params[record.first_param + module_.args[id].position];
    if (!module_.args[id].value.Valid()) continue;
    ExprId value = module_.args[id].value;
    if (parameter.by_reference || parameter.dimension_count != 0) {
      if (!Reference(value, parameter.type, parameter.dimension_count)) return false;
      continue;
    }
    if (!Converted(value, parameter.type)) return false;
    module_.args[id].value = value;
  }
  return true;
}

bool Resolver::Argument(ir::Arg& arg, ir::VariableId parameter_id) {
  const ir::Variable& parameter = module_.variables[parameter_id];
  if (!parameter.by_reference && parameter.dimension_count == 0) return Converted(arg.value, parameter.type);
  return Reference(arg.value, parameter.type, parameter.dimension_count);
}

// By reference: a variable of the same type; arrays of the same number of dimensions.
bool Resolver::Reference(ExprId id, Type type, std::uint8_t dimension_count) {
  if (!Expr(id)) return false;
  const ir::Expr& value = module_.exprs[id];
  const std::string wanted = "a variable of type " + std::string(TypeText(type));
  switch (value.op) {
    case ExprOp::kVariable:
    case ExprOp::kElement:
    case ExprOp::kCell:
    case ExprOp::kCellAt:
      break;
    default:
      return Mismatch(id, "a value", wanted);
  }
  if (value.type != type && value.type != Type::kAny) return Mismatch(id, TypeText(value.type), wanted);
  const std::uint8_t dimensions =
      value.op == ExprOp::kVariable ? module_.variables[ir::VariableId{std::size_t{value.a}}].dimension_count : 0;
  if (dimensions != dimension_count) {
    return Mismatch(id, dimensions == 0 ? "one value" : "an array",
                    dimension_count == 0 ? "one value" : "an array with as many dimensions");
  }
  return true;
}

// Parameters of standard cycles whose effect is not known.
bool Resolver::CycleLimits(const ir::Call& call) {
  const ir::Program& program = module_.programs[call.program];
  for (const auto& limit : dialects::sinumerik::LibraryLimits()) {
    if (!IsWord(module_.View(program.name), limit.cycle) || limit.position >= call.args.count) continue;
    const ExprId value = module_.args[call.args[limit.position]].value;
    if (!value.Valid()) continue;
    const ir::Expr& expr = module_.exprs[value];
    if (expr.op == ExprOp::kLiteral && expr.number == 0) continue;
    return Fail(Code::kCycleArgument, value, limit.parameter, limit.cycle, limit.reason);
  }
  return true;
}

}  // namespace ncport::frontend::sinumerik
