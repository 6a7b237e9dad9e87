#include "ir/dump.h"

#include <doctest/doctest.h>

#include <limits>
#include <set>
#include <string>
#include <string_view>

#include "ir/builder.h"
#include "ir/parse_dump.h"
#include "tests/unit/ir/dump_samples.h"

using namespace ncport;
using namespace ncport::ir;

namespace {

std::string TextOf(const Module& module, const DumpOptions& options = {}) {
  TextBuffer out;
  Dump(module, out, options);
  return std::string(out.View());
}

Module Parse(std::string_view text) {
  diag::Sink sink;
  Result<Module> module = ParseDump(text, sink);
  for (const auto& finding : sink.All()) {
    FAIL_CHECK(finding.at.line << ":" << finding.at.begin << ": " << finding.message);
  }
  REQUIRE(module.Ok());
  return std::move(*module);
}

// Line by line: a difference in a long dump must be readable.
void CheckSame(std::string_view a, std::string_view b) {
  CHECK(a.size() == b.size());
  int line = 1;
  while (!a.empty() || !b.empty()) {
    const auto end_a = std::min(a.find('\n'), a.size());
    const auto end_b = std::min(b.find('\n'), b.size());
    CHECK_MESSAGE(a.substr(0, end_a) == b.substr(0, end_b), "line " << line);
    a.remove_prefix(std::min(end_a + 1, a.size()));
    b.remove_prefix(std::min(end_b + 1, b.size()));
    ++line;
  }
}

// Programs of the sample from which one record of a program is asked.
std::set<std::string> WordsOf(std::string_view text) {
  std::set<std::string> words;
  std::string word;
  for (const char c : text) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-') {
      word += c;
    } else {
      words.insert(word);
      word.clear();
    }
  }
  return words;
}

}  // namespace

TEST_CASE("ir dump: a dump of everything is read back without loss") {
  const Module module = Parse(test::kEverything);
  // One spelling of a reference has a blank that the writer leaves out.
  std::string expected(test::kEverything);
  const auto blank = expected.find("# [100]");
  REQUIRE(blank != std::string::npos);
  expected.erase(blank + 1, 1);
  CheckSame(TextOf(module), expected);
}

TEST_CASE("ir dump: the sample holds every word, operation and function") {
  const auto words = WordsOf(test::kEverything);
  for (unsigned i = 0; i <= static_cast<unsigned>(WordOp::kVerbatim); ++i) {
    CHECK_MESSAGE(words.contains(std::string(NameOf(static_cast<WordOp>(i)))), NameOf(static_cast<WordOp>(i)));
  }
  for (unsigned i = 0; i <= static_cast<unsigned>(ExprOp::kFunction); ++i) {
    const auto op = static_cast<ExprOp>(i);
    if (op == ExprOp::kText) continue;  // written as the text itself
    CHECK_MESSAGE(words.contains(std::string(NameOf(op))), NameOf(op));
  }
  for (unsigned i = 0; i <= static_cast<unsigned>(Function::kIsAxis); ++i) {
    CHECK_MESSAGE(words.contains(std::string(NameOf(static_cast<Function>(i)))), NameOf(static_cast<Function>(i)));
  }
}

TEST_CASE("ir dump: what was read stands in the records") {
  const Module m = Parse(test::kEverything);
  REQUIRE(m.programs.Size() == 4);
  const Program& main = m.programs[ProgramId{std::size_t{0}}];
  CHECK(m.View(main.name) == "MAIN");
  CHECK(main.kind == ProgramKind::kMain);
  CHECK(main.header_line == 3);
  CHECK(main.has_header);
  CHECK_FALSE(main.saves_modal_state);
  CHECK(main.parameters.count == 2);
  const Program& sub = m.programs[ProgramId{std::size_t{1}}];
  CHECK(sub.saves_modal_state);
  CHECK(sub.library);
  CHECK(sub.blocks.count == 1);

  const Variable& mode = m.variables[main.parameters[1]];
  CHECK(mode.by_reference);
  CHECK(mode.type == Type::kInt);
  CHECK(m.exprs[mode.upper_limit].number == 10);
  CHECK(m.exprs[mode.upper_limit].format.int_digits == 3);

  const Block& block = m.blocks[main.blocks[1]];
  CHECK(block.indent == 2);
  CHECK(block.skip_level == 1);
  CHECK((block.flags & Block::kSkipDigit) != 0);
  CHECK(block.number == 10);
  CHECK(block.number_digits == 4);
  CHECK(m.View(block.label) == "AGAIN");
  CHECK(m.origins[block.origin].line == 5);
  REQUIRE(block.words.count == 5);
  const Word& motion = m.words[block.words[0]];
  CHECK(motion.op == WordOp::kMotion);
  CHECK(motion.index == static_cast<std::uint8_t>(Motion::kLinear));
  CHECK(motion.phase == Phase::kSetting);
  CHECK(motion.spelling == 1);
  CHECK(motion.digits == 2);
  CHECK(motion.begin == 5);
  CHECK(motion.length == 3);
  const Word& x = m.words[block.words[1]];
  CHECK(x.index == 0);
  CHECK(x.flags == Word::kEqualSign);
  CHECK(m.exprs[x.value].number == 10.5);
  CHECK(m.exprs[x.value].format == NumberFormat{2, 2, NumberFormat::kPoint});
  CHECK(m.expr_places.Of(x.value).begin == 9);
  CHECK(m.words[block.words[2]].mode == ValueMode::kAbsolute);
  CHECK(m.words[block.words[2]].index == 9);
  CHECK(m.words[block.words[3]].index == 10);
  CHECK(m.words[block.words[4]].index == 11);
  REQUIRE(block.comments.count == 3);
  const Comment& speed = m.comments[block.comments[1]];
  CHECK(speed.place == CommentPlace::kBeforeWord);
  CHECK(speed.word == 2);
  CHECK(speed.gap == 3);
  CHECK(m.View(m.comments[block.comments[0]].text) == "a \"quoted\" \\ text\n");

  CHECK_FALSE(m.blocks[main.blocks[2]].origin.Valid());
  const Origin& turn = m.origins[m.blocks[main.blocks[4]].origin];
  CHECK(turn.turn == 3);
  CHECK(m.View(turn.pass) == "unroll");
  REQUIRE(turn.via.Valid());
  CHECK(m.origins[turn.via].file == FileId{std::size_t{1}});
  CHECK(m.origins[m.origins[turn.via].via].line == 1);

  const Block& condition = m.blocks[main.blocks[5]];
  CHECK(condition.link == main.blocks[7]);
  const Expr& gt = m.exprs[m.words[condition.words[0]].value];
  CHECK(gt.flags == (Expr::kTolerance | Expr::kNumericModel));
  ExprId right;
  right.value = gt.b;
  CHECK(m.exprs[right].format.flags == NumberFormat::kAsText);
  CHECK(m.View(m.literal_texts[m.exprs[right].count]) == "1EX3");
}

TEST_CASE("ir dump: names find the nearest variable, and ordinals the others") {
  const Module m = Parse(
      "ncport-ir 1\n"
      "var A int global\n"
      "program P main\n"
      "  var A real local\n"
      "  var A bool local\n"
      "  @- : define A; define A~1; define A~3\n"
      "program Q sub\n"
      "  @- : define A\n");
  const auto type = [&](std::size_t word) { return m.variables[m.words[WordId{word}].Extra<VariableId>()].type; };
  CHECK(type(0) == Type::kReal);
  CHECK(type(1) == Type::kInt);
  CHECK(type(2) == Type::kBool);
  CHECK(type(3) == Type::kInt);
}

TEST_CASE("ir dump: variables made in any order come out by program and read back to the same text") {
  Module m;
  ProgramBuilder p(m, "P");
  p.Block().Finish();
  p.Finish();
  ProgramBuilder q(m, "Q", ProgramKind::kSub);
  const VariableId a_of_q = q.Parameter("A");
  ExprBuilder e(m);
  q.Block().Assign(e.Variable(a_of_q), e.Number("1")).Finish();
  q.Finish();
  Variable late;
  late.name = m.strings.Intern("A");
  late.owner = p.Id();
  const VariableId a_of_p = m.variables.Add(late);
  late.owner = {};
  late.scope = Scope::kGlobal;
  const VariableId global = m.variables.Add(late);
  ProgramBuilder r(m, "R", ProgramKind::kSub);
  r.Block().Assign(e.Variable(a_of_p), e.Variable(global)).Finish();
  r.Finish();
  const std::string text = TextOf(m);
  CHECK(text.find("assign variable:real A~2 = variable:real A\n") != std::string::npos);
  CHECK(text.find("assign variable:real A = 1:real\n") != std::string::npos);
  CheckSame(TextOf(Parse(text)), text);
}

TEST_CASE("ir dump: options leave out places and spellings") {
  const Module m = Parse(
      "ncport-ir 1\n"
      "spelling G1 rule r\n"
      "program P main\n"
      "  @- : motion linear {as G1 digits 2 at 0+3}; axis X = 5@4+1 {equal at 3+2}\n");
  DumpOptions options;
  options.places = false;
  options.spellings = false;
  CHECK(TextOf(m, options) ==
        "ncport-ir 1\n"
        "program P main\n"
        "  @- : motion linear; axis X = 5 {equal}\n");
}

TEST_CASE("ir dump: literals keep the digits that were written, whatever they are") {
  Module m;
  ExprBuilder e(m);
  ProgramBuilder p(m, "P");
  const char* const written[] = {"0", "-0", "00", "1.", ".1", "+1", "-007.500", "123456789.125", "0.0000001"};
  for (const char* const text : written) p.Block().Axis(0, e.Number(text, Type::kNone)).Finish();
  const double values[] = {0.1, -0.0, 1e300, 5e-324, std::numeric_limits<double>::max(), 1.0 / 3};
  for (const double value : values) p.Block().Axis(0, e.Literal(value, Type::kNone)).Finish();
  p.Finish();
  const std::string text = TextOf(m);
  for (const char* const number : written) {
    CHECK_MESSAGE(text.find(std::string("axis X = ") + number + "\n") != std::string::npos, number);
  }
  const Module again = Parse(text);
  CheckSame(TextOf(again), text);
  for (const ExprId id : m.exprs.Ids()) {
    CHECK(again.exprs[id].number == m.exprs[id].number);
    CHECK(again.exprs[id].format == m.exprs[id].format);
  }
}

TEST_CASE("ir dump: a broken module is shown, not followed") {
  Module m;
  ExprBuilder e(m);
  ProgramBuilder p(m, "P");
  const ExprId sum = e.Binary(ExprOp::kAdd, e.Number("1"), e.Number("2"));
  m.exprs[sum].a = sum.value;  // a cycle
  p.Block().Axis(200, sum).Finish();
  p.Block().Add(WordOp::kCall, {}, 0, 99).Finish();
  p.Block().Add(WordOp::kMotion, {}, 77).Finish();
  p.Finish();
  m.programs[p.Id()].blocks.count = 50;
  const std::string text = TextOf(m);
  CHECK(text.find("axis ?200 = add:real(add:real(") != std::string::npos);
  CHECK(text.find("call ?99\n") != std::string::npos);
  CHECK(text.find("motion ?77\n") != std::string::npos);
  CHECK(text.find("  ?3\n") != std::string::npos);
}

TEST_CASE("ir dump: the mark follows its block") {
  Module m = Parse("ncport-ir 1\nprogram P main\n  @-\n  @-:1\n");
  DumpOptions options;
  options.marked = m.programs[ProgramId{std::size_t{0}}].blocks[0];
  options.mark = "here";
  const std::string text = TextOf(m, options);
  CHECK(text == "ncport-ir 1\nprogram P main\n  @-\n  // ^ here\n  @-:1\n");
  CHECK(TextOf(Parse(text)) == "ncport-ir 1\nprogram P main\n  @-\n  @-:1\n");
}
