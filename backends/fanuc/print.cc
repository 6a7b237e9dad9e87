#include "backends/fanuc/print.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "backends/fanuc/print_expr.h"
#include "base/number_text.h"
#include "base/result.h"
#include "dialects/fanuc/words.h"
#include "dialects/word_template.h"
#include "ir/axis_names.h"

namespace ncport::backends::fanuc {

namespace {

using ir::Block;
using ir::Word;
using ir::WordOp;

/// Latin letters with marks, by their UTF-8 pairs, as the letters that a control has.
struct Transliteration {
  std::string_view from, to;
};
constexpr Transliteration kTransliterations[] = {
    {"\xC3\x84", "AE"}, {"\xC3\xA4", "AE"}, {"\xC3\x96", "OE"},  {"\xC3\xB6", "OE"},  {"\xC3\x9C", "UE"},
    {"\xC3\xBC", "UE"}, {"\xC3\x9F", "SS"}, {"\xC3\xA9", "E"},   {"\xC3\xA8", "E"},   {"\xC3\xAA", "E"},
    {"\xC3\xA1", "A"},  {"\xC3\xA0", "A"},  {"\xC3\xA7", "C"},   {"\xC3\xB1", "N"},   {"\xC3\xB3", "O"},
    {"\xC3\xAD", "I"},  {"\xC3\xBA", "U"},  {"\xC2\xB0", "DEG"}, {"\xC3\x98", "DIA"}, {"\xC3\xB8", "DIA"},
    {"\xC2\xB5", "U"},
};

class Printer {
 public:
  Printer(const ir::Module& module, const dialects::Profile& profile, TextBuffer& out)
      : module_(module), profile_(profile), out_(out), exprs_(module, profile, out) {
    const auto system = dialects::fanuc::SystemOf(profile);
    NCPORT_CHECK(system.has_value(), "a profile without a series reached the printer");
    system_ = *system;
  }

  void PrintBlock(const Block& block);

 private:
  void PrintWord(const Word& word, const Block& block);
  void PrintCall(const Word& word);
  void PrintJump(const Word& word);
  void PrintTool(const Word& word, const Block& block);
  void PrintAlarm(const Word& word);
  void PrintCode(const Word& word);
  void PrintAddress(const Word& word);
  void PrintComment(const ir::Comment& comment);
  void Template(std::string_view form, ir::ExprId number, ir::ExprId offset = {});
  void Blank() {
    if (started_) out_.Append(' ');
    started_ = true;
  }
  void Condition(ir::ExprId condition) {
    out_.Append('[');
    exprs_.Statement(condition);
    out_.Append(']');
  }

  const ir::Module& module_;
  const dialects::Profile& profile_;
  TextBuffer& out_;
  ExprPrinter exprs_;
  dialects::fanuc::System system_ = dialects::fanuc::System::kMill;
  bool started_ = false;  // something stands in the line
};

void Printer::PrintComment(const ir::Comment& comment) {
  std::string_view text = module_.View(comment.text);
  if (text.starts_with(' ')) text.remove_prefix(1);
  if (text.empty()) return;
  Blank();
  out_.Append('(');
  AppendCommentText(out_, text);
  out_.Append(')');
}

void Printer::PrintCode(const Word& word) {
  const std::uint32_t extra =
      word.op == WordOp::kProgramEnd || word.op == WordOp::kWorkOffset ? word.extra : Id<void>::kNone;
  const dialects::CodeRow* row = dialects::fanuc::Codes(system_).FindMeaning(word.op, word.index, extra);
  NCPORT_CHECK(row != nullptr, "no code for {} {}", ir::NameOf(word.op), word.index);
  Blank();
  out_.Append(row->text);
}

/// A word template of the profile with its holes filled by expressions.
void Printer::Template(std::string_view form, ir::ExprId number, ir::ExprId offset) {
  Blank();
  const auto text_of = [&](ir::ExprId value, NumberPlace place) {
    TextBuffer text;
    if (value.Valid()) ExprPrinter(module_, profile_, text).WordValue(value, place);
    return std::string(text.View());
  };
  const std::string whole =
      text_of(number, form.find("{seconds}") != std::string_view::npos ? NumberPlace::kWord : NumberPlace::kInteger);
  const std::string second = text_of(offset, NumberPlace::kInteger);
  const dialects::TemplateValue values[] = {
      {"number", whole}, {"tool", whole}, {"speed", whole}, {"seconds", whole}, {"offset", second}};
  dialects::AppendTemplate(out_, form, values);
}

void Printer::PrintAddress(const Word& word) {
  static constexpr std::string_view kCenters = "IJK";
  NumberPlace place = NumberPlace::kWord;
  char letter = 0;
  switch (word.op) {
    case WordOp::kAxis:
      if (word.mode == ir::ValueMode::kIncremental) {
        const auto& letters = *profile_.words.incremental_axes;
        // The letters stand for the increments of X, Y, Z, C.
        const std::string_view axes = "XYZC";
        const std::size_t at = axes.find(ir::kAxisLetters[word.index]);
        NCPORT_CHECK(at < letters.size(), "no letter for an increment of {}", ir::kAxisLetters[word.index]);
        letter = letters[at];
      } else {
        letter = ir::kAxisLetters[word.index];
      }
      break;
    case WordOp::kCenter:
      letter = kCenters[word.index];
      break;
    case WordOp::kRadius:
      letter = 'R';
      break;
    case WordOp::kFeed:
      letter = 'F';
      break;
    case WordOp::kStartAngle:
      letter = 'Q';
      place = NumberPlace::kInteger;
      break;
    case WordOp::kSpeed:
      letter = 'S';
      place = NumberPlace::kInteger;
      break;
    case WordOp::kRadiusOffset:
      letter = 'D';
      place = NumberPlace::kInteger;
      break;
    case WordOp::kLengthOffset:
      letter = 'H';
      place = NumberPlace::kInteger;
      break;
    case WordOp::kAux:
    case WordOp::kComputedM:
      letter = 'M';
      place = NumberPlace::kInteger;
      break;
    case WordOp::kComputedG:
      letter = 'G';
      place = NumberPlace::kInteger;
      break;
    default:
      NCPORT_BUG("word {} reached the printer", ir::NameOf(word.op));
  }
  Blank();
  out_.Append(letter);
  exprs_.WordValue(word.value, place);
}

void Printer::PrintTool(const Word& word, const Block& block) {
  // The offset of a lathe is part of the T word: both words of the block make one.
  ir::ExprId offset;
  for (const ir::WordId id : block.words) {
    if (module_.words[id].op == WordOp::kToolOffset) offset = module_.words[id].value;
  }
  const std::string& form = *profile_.words.tool;
  Template(form, word.value, offset.Valid() ? offset : word.value);
}

void Printer::PrintAlarm(const Word& word) {
  Blank();
  out_.Append("#3000=");
  exprs_.Statement(word.value);
  const auto text = word.Extra<ir::ExprId>();
  if (!text.Valid()) return;
  out_.Append('(');
  AppendCommentText(out_, module_.View(StringId{module_.exprs[text].a}), '*');
  out_.Append(')');
}

void Printer::PrintJump(const Word& word) {
  const ir::Jump& jump = module_.jumps[word.Extra<ir::JumpId>()];
  Blank();
  if (word.value.Valid()) {
    out_.Append("IF");
    Condition(word.value);
  }
  out_.Append("GOTO");
  if (jump.target.kind == ir::TargetKind::kNumber) return AppendInteger(out_, jump.target.number);
  NCPORT_CHECK(jump.target.kind == ir::TargetKind::kExpression, "a jump without a number reached the printer");
  exprs_.WordValue(jump.target.expr, NumberPlace::kInteger);
}

void Printer::PrintCall(const Word& word) {
  const ir::Call& call = module_.calls[word.Extra<ir::CallId>()];
  const std::string_view name =
      call.program.Valid() ? module_.View(module_.programs[call.program].name) : module_.View(call.name);
  const bool number = !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
  Blank();
  if (word.op == WordOp::kModalCall) {
    out_.Append("G66 ");
  } else {
    out_.Append(call.new_level ? "G65 " : "M98 ");
  }
  if (number) {
    out_.Append('P');
    const bool packed = !call.new_level && call.passes.Valid() &&
                        profile_.fanuc.calls.Is(dialects::FanucSettings::Calls::kPacked) &&
                        module_.exprs[call.passes].op == ir::ExprOp::kLiteral;
    if (packed) {
      // P with more than four digits: repeats in front of the four digits of the program (fanuc-7.2).
      AppendInteger(out_, static_cast<std::int64_t>(module_.exprs[call.passes].number));
      for (std::size_t i = name.size(); i < 4; ++i) out_.Append('0');
      out_.Append(name);
      return;
    }
    out_.Append(name);
  } else {
    out_.Append('<');
    out_.Append(name);
    out_.Append('>');
  }
  if (call.passes.Valid()) {
    out_.Append(" L");
    exprs_.WordValue(call.passes, NumberPlace::kInteger);
  }
  for (const ir::ArgId id : call.args) {
    const ir::Arg& arg = module_.args[id];
    if (!arg.value.Valid() || arg.letter == 0) continue;
    out_.Append(' ');
    out_.Append(arg.letter);
    exprs_.WordValue(arg.value, NumberPlace::kWord);
  }
}

void Printer::PrintWord(const Word& word, const Block& block) {
  switch (word.op) {
    case WordOp::kAssign:
      Blank();
      exprs_.WordValue(word.Extra<ir::ExprId>(), NumberPlace::kMacro);
      out_.Append('=');
      return exprs_.Statement(word.value);
    case WordOp::kWhen:
      Blank();
      out_.Append("IF");
      Condition(word.value);
      return out_.Append("THEN");
    case WordOp::kWhile:
      Blank();
      out_.Append("WHILE");
      Condition(word.value);
      out_.Append("DO");
      return AppendInteger(out_, word.index);
    case WordOp::kEndWhile:
      Blank();
      out_.Append("END");
      return AppendInteger(out_, word.index);
    case WordOp::kJump:
      return PrintJump(word);
    case WordOp::kCall:
      return PrintCall(word);
    case WordOp::kModalCall:
      if (word.Extra<ir::CallId>().Valid()) return PrintCall(word);
      Blank();
      return out_.Append("G67");
    case WordOp::kAlarm:
      return PrintAlarm(word);
    case WordOp::kReturn:
      Blank();
      out_.Append(*profile_.words.sub_end);
      if (!word.value.Valid()) return;
      out_.Append(" P");
      return exprs_.WordValue(word.value, NumberPlace::kInteger);
    case WordOp::kProgramEnd:
      Blank();
      return out_.Append(*profile_.words.end);
    case WordOp::kTool:
      return PrintTool(word, block);
    case WordOp::kToolOffset:
      return;  // part of the T word
    case WordOp::kSpeedLimit:
      Template(*profile_.spindle.limit, word.value);
      if (!profile_.spindle.r_word.Or("").empty()) {
        out_.Append(' ');
        out_.Append(*profile_.spindle.r_word);
      }
      return;
    case WordOp::kSpindle: {
      const auto state = static_cast<ir::SpindleState>(word.extra);
      Blank();
      out_.Append(state == ir::SpindleState::kCw    ? *profile_.spindle.cw
                  : state == ir::SpindleState::kCcw ? *profile_.spindle.ccw
                                                    : *profile_.spindle.stop);
      return;
    }
    case WordOp::kDwellSeconds:
      return Template(*profile_.words.dwell, word.value);
    case WordOp::kWorkOffset:
      if (word.value.Valid()) return Template(*profile_.words.work_offset_extended, word.value);
      return PrintCode(word);
    case WordOp::kFrame: {
      using dialects::fanuc::Special;
      const auto op = static_cast<ir::FrameOp>(word.index);
      Blank();
      return out_.Append(dialects::fanuc::TextOf(system_, op == ir::FrameOp::kRotateAbout ? Special::kRotationOn
                                                          : op == ir::FrameOp::kRotateEnd ? Special::kRotationOff
                                                                                          : Special::kLocalShift));
    }
    case WordOp::kFrameAngle:
      Blank();
      out_.Append("R");
      return exprs_.WordValue(word.value, NumberPlace::kWord);
    case WordOp::kFileMark:
    case WordOp::kInert:
      Blank();
      return out_.Append(module_.View(module_.spellings[word.spelling].text));
    case WordOp::kAxis:
    case WordOp::kCenter:
    case WordOp::kRadius:
    case WordOp::kFeed:
    case WordOp::kStartAngle:
    case WordOp::kSpeed:
    case WordOp::kRadiusOffset:
    case WordOp::kAux:
    case WordOp::kComputedM:
    case WordOp::kComputedG:
      return PrintAddress(word);
    case WordOp::kChamfer:
      Blank();
      out_.Append(word.index == static_cast<std::uint8_t>(ir::ChamferKind::kRound) ? ",R" : ",C");
      return exprs_.WordValue(word.value, NumberPlace::kWord);
    case WordOp::kLengthOffset:
      return word.value.Valid() ? PrintAddress(word) : PrintCode(word);
    default:
      return PrintCode(word);
  }
}

void Printer::PrintBlock(const Block& block) {
  started_ = false;
  if (block.skip_level != Block::kNoSkip) {
    out_.Append('/');
    if (block.skip_level > 1) AppendInteger(out_, block.skip_level);
  }
  if (block.number != Block::kNoNumber) {
    Blank();
    out_.Append('N');
    AppendNumber(out_, block.number, block.number_digits, 0, false);
  }
  for (const ir::WordId id : block.words) PrintWord(module_.words[id], block);
  for (const ir::CommentId id : block.comments) PrintComment(module_.comments[id]);
  out_.Append('\n');
}

}  // namespace

void AppendCommentText(TextBuffer& out, std::string_view text, char blank) {
  std::size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) >= 0x80) {
      bool found = false;
      for (const Transliteration& row : kTransliterations) {
        if (text.substr(at, row.from.size()) != row.from) continue;
        out.Append(row.to);
        at += row.from.size();
        found = true;
        break;
      }
      if (found) continue;
      out.Append('.');
      ++at;
      while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80) ++at;
      continue;
    }
    ++at;
    if (c >= 'a' && c <= 'z') {
      out.Append(static_cast<char>(c - 'a' + 'A'));
    } else if (c == ' ' || c == '\t') {
      out.Append(blank);
    } else if (c == '(' || c == ')' || c == '[' || c == ']' || c == '%' || c == ';') {
      out.Append(c == ';' ? ',' : '-');  // these end a comment, a statement or a tape
    } else if (c > ' ' && c < 0x7F) {
      out.Append(c);
    } else {
      out.Append('.');
    }
  }
}

void PrintProgram(const ir::Module& module, ir::ProgramId program, const dialects::Profile& profile, TextBuffer& out,
                  std::vector<PrintedLine>* lines) {
  Printer printer(module, profile, out);
  std::uint32_t line = 1;
  for (std::size_t i = 0; i < out.size(); ++i) line += out.View()[i] == '\n' ? 1U : 0U;
  std::uint32_t marked = 0;  // blocks that the last mark announced and that are still to come
  const IdRange<ir::BlockId> blocks = module.programs[program].blocks;
  for (const ir::BlockId id : blocks) {
    const Block& block = module.blocks[id];
    const bool added = (block.flags & Block::kAdded) != 0;
    if (added && marked == 0) {
      for (std::uint32_t next = id.value; next < blocks.begin + blocks.count; ++next) {
        if ((module.blocks[ir::BlockId{next}].flags & Block::kAdded) == 0) break;
        ++marked;
      }
      out.Append('(');
      out.Append(kAddedMark);
      AppendInteger(out, marked);
      out.Append(")\n");
      if (lines != nullptr) lines->push_back({line, {}, true});
      ++line;
    }
    if (added) --marked;
    printer.PrintBlock(block);
    if (lines != nullptr) lines->push_back({line, id, (block.flags & Block::kAdded) != 0});
    ++line;
  }
}

}  // namespace ncport::backends::fanuc
