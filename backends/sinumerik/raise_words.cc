#include "backends/sinumerik/raise_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/common/aux_codes.h"
#include "ir/builder.h"
#include "ir/literal_value.h"
#include "ir/transform/program_editor.h"

namespace ncport::backends::sinumerik {

namespace {

using ir::Block;
using ir::BlockId;
using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::Word;
using ir::WordId;
using ir::WordOp;
using ir::transform::ProgramEditor;

// sinumerik-8.11: alarms 65000 to 65999 stop the program; 0 to 999 of the source fit.
constexpr std::uint32_t kFirstAlarm = 65000, kLastAlarm = 65999;

/// Number behind a letter: "G505" -> 505.
std::optional<std::uint32_t> NumberBehind(std::string_view word, char letter) {
  std::uint32_t number = 0;
  if (word.size() < 2 || word[0] != letter) return std::nullopt;
  const char* end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data() + 1, end, number);
  if (error != std::errc{} || last != end) return std::nullopt;
  return number;
}

void AppendText(const Module& module, ExprId id, std::string& out) {
  if (!id.Valid()) return;
  const ir::Expr& expr = module.exprs[id];
  switch (expr.op) {
    case ExprOp::kText:
      out += module.View(StringId{std::size_t{expr.a}});
      return;
    case ExprOp::kConcat:
      AppendText(module, ExprId{std::size_t{expr.a}}, out);
      AppendText(module, ExprId{std::size_t{expr.b}}, out);
      return;
    case ExprOp::kCell:
      out += fmt::format("#{}", expr.b);
      return;
    case ExprOp::kFunction:
      AppendText(module, module.Item(expr.b), out);
      return;
    default:
      out += "..";
  }
}

/// A comment at the end of the block behind those that it has.
void AddComment(Module& module, Block& block, std::string_view text) {
  IdRange<ir::CommentId> comments{static_cast<std::uint32_t>(module.comments.Size()), block.comments.count + 1};
  for (const ir::CommentId old : block.comments) {
    const ir::Comment copy = module.comments[old];
    module.comments.Add(copy);
  }
  ir::Comment comment;
  comment.text = module.strings.Intern(text);
  comment.place = ir::CommentPlace::kEndOfBlock;
  comment.gap = 1;
  module.comments.Add(comment);
  block.comments = comments;
}

bool SameWords(const Module& module, const Block& block, const std::vector<Word>& words) {
  if (block.words.count != words.size()) return false;
  for (std::uint32_t i = 0; i < block.words.count; ++i) {
    const Word& old = module.words[block.words[i]];
    const Word& now = words[i];
    if (old.op != now.op || old.value != now.value || old.extra != now.extra || old.index != now.index) return false;
  }
  return true;
}

}  // namespace

bool ArrangeTexts(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  ir::ExprBuilder make(module);
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    ProgramEditor editor(module, program, "arrange_texts");
    for (const BlockId id : module.programs[program].blocks) {
      Block block = module.blocks[id];
      for (const ir::CommentId comment : block.comments) {
        // `;` runs to the end of the line.
        if (module.comments[comment].place == ir::CommentPlace::kBeforeWord)
          module.comments[comment].place = ir::CommentPlace::kEndOfBlock;
      }
      std::vector<Word> kept;
      std::string text;
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        switch (word.op) {
          case WordOp::kFileMark:
          case WordOp::kHeader:
            continue;
          case WordOp::kInert: {  // a word of the source without effect on the path: a mode of its control
            if (word.phase == ir::Phase::kMotion) continue;  // the code of a dwell, which has a word of its own
            const std::string_view code =
                word.spelling == 0 ? std::string_view() : module.View(module.spellings[word.spelling].text);
            if (!code.starts_with('G') && !code.starts_with('M')) continue;  // data of one
            text += (text.empty() ? "" : " ") + std::string(code);
            sink.Report(diag::Code::kListedLoss, module.RangeOf(block, word), code, input.profile->name);
            out.losses.push_back({module.RangeOf(block, word), std::string(code)});
            continue;
          }
          case WordOp::kPrint: {
            text += text.empty() ? "DPRNT " : " DPRNT ";
            AppendText(module, word.value, text);
            out.messages_lost = true;
            sink.Report(diag::Code::kListedLoss, module.RangeOf(block, word), text, input.profile->name);
            out.losses.push_back({module.RangeOf(block, word), text});
            continue;
          }
          case WordOp::kMessage:
            word.extra = Id<void>::kNone;  // the number of the message
            break;
          case WordOp::kAlarm: {
            const auto number = ir::WholeNumber(module, word.value);
            if (!number || *number > kLastAlarm - kFirstAlarm) {
              ok = false;
              sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word),
                          number ? "an alarm number above 999" : "a computed alarm number", input.profile->name);
              break;
            }
            AlarmUse use{*number, kFirstAlarm + *number, {}};
            use.target_words = fmt::format("SETAL({})", use.target);
            const auto known = std::find_if(out.alarms.begin(), out.alarms.end(),
                                            [&](const AlarmUse& other) { return other.source == use.source; });
            if (known == out.alarms.end()) out.alarms.push_back(use);
            word.value = make.Literal(use.target, ir::Type::kInt);
            break;
          }
          default:
            break;
        }
        kept.push_back(word);
      }
      if (!text.empty()) {
        AddComment(module, block, text);
        module.blocks[id].comments = block.comments;
      }
      if (SameWords(module, block, kept)) continue;
      if (kept.empty() && block.comments.Empty()) {
        editor.Remove(id);
        continue;
      }
      editor.SetWords(id, kept);
    }
    editor.Apply();
  }
  return ok;
}

bool MapOffsets(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const Block& block = module.blocks[id];
      for (const WordId word_id : block.words) {
        Word& word = module.words[word_id];
        if (word.op != WordOp::kWorkOffset) continue;
        OffsetUse use{word.extra, 0, word.extra, 0};
        std::string name = fmt::format("G{}", word.extra);
        if (word.value.Valid()) {
          const auto extension = ir::WholeNumber(module, word.value);
          if (!extension) {
            ok = false;
            sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word), "a computed work offset",
                        input.profile->name);
            continue;
          }
          use.source_extension = *extension;
          name = fmt::format("G54.1 P{}", *extension);
        }
        const dialects::WordMapping* mapping = input.config == nullptr ? nullptr : input.config->FindOffset(name);
        if (mapping != nullptr) {
          const auto target = NumberBehind(mapping->target, 'G');
          if (!target || (*target != 500 && (*target < 54 || *target > 57) && (*target < 505 || *target > 599))) {
            ok = false;
            sink.Report(diag::Code::kUnmappedOffset, mapping->at, mapping->target).help =
                "SINUMERIK has G54 to G57 and G505 to G599";
            continue;
          }
          use.target = *target == 500 ? 0 : *target;
        } else if (word.extra < 54 || word.extra > 57 || word.value.Valid()) {
          // G58 and G59 are something else there: programmable shifts (sinumerik-8.7).
          ok = false;
          sink.Report(diag::Code::kUnmappedOffset, module.RangeOf(block, word), name).help =
              fmt::format("add to ncport.toml:  [offsets]  \"{}\" = \"G505\"", name);
          continue;
        }
        word.extra = use.target;
        word.value = {};
        const auto known = std::find_if(out.offsets.begin(), out.offsets.end(), [&](const OffsetUse& other) {
          return other.source == use.source && other.source_extension == use.source_extension;
        });
        if (known == out.offsets.end()) out.offsets.push_back(use);
      }
    }
  }
  return ok;
}

bool MapAuxiliaries(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  const auto write = [](Module& module, Word& word, const std::string& target) {
    const auto number = NumberBehind(target, 'M');
    if (number) word.value = ir::ExprBuilder(module).Literal(*number, ir::Type::kInt);
    return number;
  };
  return backends::MapAuxiliaries(*input.profile, input.config, write, out, sink);
}

void DropSpellings(Translation& out) {
  Module& module = out.module;
  for (Word& word : module.words.All()) {
    if (word.op == WordOp::kHeader || word.op == WordOp::kDefine || word.op == WordOp::kInert) continue;
    word.spelling = 0;
    word.digits = 0;
    word.flags = static_cast<std::uint8_t>(word.flags & ~Word::kEqualSign);
  }
  // N010 and N10 are one number to some versions only (sinumerik-6.1).
  for (Block& block : module.blocks.All()) block.number_digits = 0;
}

}  // namespace ncport::backends::sinumerik
