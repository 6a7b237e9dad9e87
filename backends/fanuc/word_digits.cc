#include "backends/fanuc/word_digits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "backends/fanuc/print_expr.h"
#include "base/text_buffer.h"
#include "ir/analysis/flow_analyses.h"

namespace ncport::backends::fanuc {

namespace {

using ir::BlockId;
using ir::Expr;
using ir::ExprId;
using ir::ExprOp;
using ir::Module;
using ir::NumberFormat;
using ir::Word;
using ir::WordId;
using ir::WordOp;

constexpr int kDigits = 8;                // of an address; IS-C and 30i take 9 (fanuc-2.1)
constexpr int kRevolutionDecimals = 4;    // 0.0001 mm/rev (fanuc-2.2)
constexpr int kLeadDecimals = 6;          // the error of a lead adds up over the turns
constexpr double kFeedTolerance = 0.001;  // of the value

/// The number of a word that is one, with or without a sign.
ExprId LiteralOf(const Module& module, ExprId id, bool sign = true) {
  while (id.Valid()) {
    const Expr& expr = module.exprs[id];
    if (expr.op == ExprOp::kLiteral) return id;
    if (expr.op != ExprOp::kGroup && expr.op != ExprOp::kPlus && expr.op != ExprOp::kConvert &&
        (expr.op != ExprOp::kNegate || !sign))
      break;
    id = ExprId{expr.a};
  }
  return {};
}

bool IsComputed(const NumberFormat& format) {
  return (format.flags & (NumberFormat::kComputed | NumberFormat::kAsText)) != 0 ||
         (format.int_digits == 0 && format.decimals == 0);
}

/// The word's number from now on printed with these decimals at most, without zeros behind them.
void Write(Module& module, Word& word, double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  std::string text = fmt::format("{:.{}f}", std::round(value * scale) / scale, decimals);
  const std::size_t point = text.find('.');
  std::size_t last = point == std::string::npos ? text.size() : text.size() - 1;
  while (point != std::string::npos && last > point && text[last] == '0') --last;
  Expr literal = module.exprs[LiteralOf(module, word.value)];
  literal.number = std::round(value * scale) / scale;
  literal.format = {};
  literal.format.int_digits = static_cast<std::uint8_t>(point == std::string::npos ? text.size() : point);
  literal.format.decimals = static_cast<std::uint8_t>(point == std::string::npos ? 0 : last - point);
  literal.format.flags = NumberFormat::kPoint;
  word.value = module.AddExpr(literal, {word.begin, word.length});
}

}  // namespace

bool RoundFeeds(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  const ir::analysis::FlowAnalyses analyses = input.Analyse(module);
  const ir::analysis::ModalFlow& flow = analyses.Modal();
  const int lengths = static_cast<int>(input.profile->decimals.Or(3));
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      for (const WordId word_id : block.words) {
        if (module.words[word_id].op != WordOp::kFeed) continue;
        Word word = module.words[word_id];
        const ExprId literal = LiteralOf(module, word.value, false);
        if (!literal.Valid()) continue;
        const double value = module.exprs[literal].number;
        if (!IsComputed(module.exprs[literal].format) || !(value > 0)) continue;
        const ir::ModalState state = flow.At(program, id);
        int decimals = state.motion == ir::Motion::kThread || state.motion == ir::Motion::kThreadIncreasing ||
                               state.motion == ir::Motion::kThreadDecreasing
                           ? kLeadDecimals
                       : state.feed_mode == ir::FeedMode::kPerRevolution ? kRevolutionDecimals
                                                                         : lengths;
        const int before_point = value < 1 ? 1 : static_cast<int>(std::floor(std::log10(value))) + 1;
        decimals = std::clamp(std::max(decimals, lengths), 0, std::max(kDigits - before_point, 0));
        const double scale = std::pow(10.0, decimals);
        if (std::fabs(std::round(value * scale) / scale - value) > kFeedTolerance * value) {
          ok = false;
          sink.Report(diag::Code::kWordTooCoarse, module.RangeOf(block, word), fmt::format("F{:g}", value),
                      fmt::format("{}", decimals));
          continue;
        }
        Write(module, word, value, decimals);
        module.words[word_id] = word;
      }
    }
  }
  return ok;
}

bool CheckDigits(const RaiseInput& input, Translation& out, diag::Sink& sink) {
  Module& module = out.module;
  bool ok = true;
  for (const ir::ProgramId program : module.programs.Ids()) {
    for (const BlockId id : module.programs[program].blocks) {
      const ir::Block& block = module.blocks[id];
      for (const WordId word_id : block.words) {
        Word word = module.words[word_id];
        const bool number = word.op == WordOp::kAxis || word.op == WordOp::kCenter || word.op == WordOp::kRadius ||
                            word.op == WordOp::kFeed || word.op == WordOp::kStartAngle || word.op == WordOp::kChamfer ||
                            word.op == WordOp::kSpeed || word.op == WordOp::kDwellSeconds;
        if (!number || !LiteralOf(module, word.value).Valid()) continue;
        const bool whole = word.op == WordOp::kSpeed;
        TextBuffer buffer;
        ExprPrinter(module, *input.profile, buffer)
            .WordValue(word.value, whole ? NumberPlace::kInteger : NumberPlace::kWord);
        std::string text(buffer.View());
        const auto digits = [&] {
          return std::count_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
        };
        if (digits() <= kDigits) continue;
        std::size_t at = text.starts_with('-') ? 1 : 0;
        while (at + 1 < text.size() && text[at] == '0' && text[at + 1] != '.') text.erase(at, 1);
        if (text.find('.') != std::string::npos) {
          while (text.ends_with('0')) text.pop_back();
        }
        if (digits() > kDigits || whole || LiteralOf(module, word.value) != word.value) {
          ok = false;
          sink.Report(diag::Code::kNotExpressible, module.RangeOf(block, word),
                      fmt::format("a number of {} digits ({})", digits(), text), input.profile->name)
              .help = fmt::format("an address takes {} digits", kDigits);
          continue;
        }
        const std::size_t point = text.find('.');
        Write(module, word, module.exprs[word.value].number,
              point == std::string::npos ? 0 : static_cast<int>(text.size() - point - 1));
        module.words[word_id] = word;
      }
    }
  }
  return ok;
}

}  // namespace ncport::backends::fanuc
