#include "ir/verify.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <string>

#include "ir/builder.h"
#include "ir/parse_dump.h"
#include "ir/structure.h"
#include "tests/unit/ir/dump_samples.h"

using namespace ncport;
using namespace ncport::ir;

namespace {

Module Sample() {
  diag::Sink sink;
  Result<Module> module = ParseDump(test::kEverything, sink);
  REQUIRE(module.Ok());
  return std::move(*module);
}

// The violation after a change of a valid module, "" if there is none.
std::string After(const std::function<void(Module&)>& change, const VerifyOptions& options = {}) {
  Module module = Sample();
  change(module);
  return FindViolation(module, options).value_or("");
}

bool Has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

template <class IdType>
IdType First() {
  return IdType{std::size_t{0}};
}

// First word of this kind.
Word& Find(Module& module, WordOp op) {
  for (Word& word : module.words.All()) {
    if (word.op == op) return word;
  }
  FAIL("no such word");
  return module.words.All().front();
}
Expr& Find(Module& module, ExprOp op) {
  for (Expr& expr : module.exprs.All()) {
    if (expr.op == op) return expr;
  }
  FAIL("no such expression");
  return module.exprs.All().front();
}

constexpr std::uint32_t kFar = 1000000;

}  // namespace

TEST_CASE("ir verify: a sound module has no violation") {
  CHECK(After([](Module&) {}) == "");
  CHECK(FindViolation(Module{}) == std::nullopt);
}

TEST_CASE("ir verify: violations name their place and word") {
  const std::string text = After([](Module& m) { Find(m, WordOp::kRadius).value = ExprId{}; });
  CHECK(text == "main.mpf:25: word 6 (radius): has no value");
}

TEST_CASE("ir verify: words") {
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).value = First<ExprId>(); }), "has a value"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kMotion).index = 99; }), "motion 99 is not in its list"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).index = 1; }), "index 1 has no meaning"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kAxis).index = 12; }), "axis 12 has no name"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kCenter).index = 3; }), "coordinate 3"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).extra = 3; }), "extra 3 has no meaning"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kJump).extra = kFar; }), "jump 1000000"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kJump).extra = Id<void>::kNone; }), "extra is missing"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kAssign).extra = Find(m, WordOp::kAxis).value.value; }),
            "cannot be written"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kSpindle).extra = 50; }), "spindle state 50"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kVerbatim).extra = kFar; }), "text is string"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kVerbatim).index = 2; }), "is no mark"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).flags = 0x80; }), "unknown flag"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).spelling = 4; }), "unknown spelling"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).phase = static_cast<Phase>(9); }), "phase 9"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kAxis).mode = static_cast<ValueMode>(99); }), "mode 99"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kStop).op = static_cast<WordOp>(250); }), "word 250"));
  CHECK(Has(After([](Module& m) { Find(m, WordOp::kAxis).value.value = kFar; }), "value is expression 1000000"));
}

TEST_CASE("ir verify: refused blocks may hold words that could not be completed") {
  const auto change = [](Module& m) {
    for (Block& block : m.blocks.All()) {
      for (const WordId id : block.words) {
        if (m.words[id].op == WordOp::kRadius) block.flags |= Block::kRefused;
      }
    }
    Find(m, WordOp::kRadius).value = {};
  };
  CHECK(After(change) == "");
}

TEST_CASE("ir verify: expressions") {
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kAdd).a = kFar; }), "does not stand before it"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kAdd).b = Id<void>::kNone; }), "an operand is missing"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kVariable).a = kFar; }), "variable 1000000"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kCell).a = 7; }), "space 7 of 3"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kCellAt).b = 7; }), "space 7 of 3"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kSystem).a = 7; }), "system variable 7 of 2"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kAxisName).a = 12; }), "axis 12 has no name"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kText).a = kFar; }), "text is string"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kFunction).a = 250; }), "unknown function"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kFunction).count = 0; }), "0 operands instead of 1 to 1"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kFunction).b = kFar; }), "list 1000000"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kConvert).type = Type::kNone; }), "conversion to no type"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kAdd).flags = 0x80; }), "unknown flag"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kAdd).type = static_cast<Type>(77); }), "type 77"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kLiteral).number = std::numeric_limits<double>::infinity(); }),
            "not finite"));
  CHECK(Has(After([](Module& m) { Find(m, ExprOp::kLiteral).count = 1; }), "do not agree"));
  CHECK(Has(After([](Module& m) { m.expr_places.Add(ExprId{kFar}, {0, 1}); }), "place of an expression that is not"));
  CHECK(Has(After([](Module& m) {
              m.expr_places.Add(ExprId{std::size_t{2}}, {0, 1});
              m.expr_places.Add(ExprId{std::size_t{1}}, {0, 1});
            }),
            "out of order"));
}

TEST_CASE("ir verify: names are gone after resolution") {
  VerifyOptions resolved;
  resolved.names_resolved = true;
  CHECK(Has(After([](Module&) {}, resolved), "a name is left after resolution"));
}

TEST_CASE("ir verify: depth and size of expressions are bounded") {
  Module deep;
  ExprBuilder e(deep);
  ExprId expr = e.Number("1");
  for (int i = 0; i < 1000; ++i) expr = e.Unary(ExprOp::kNegate, expr);
  CHECK(Has(FindViolation(deep).value_or(""), "nested too deep"));
  Module wide;
  ExprBuilder w(wide);
  expr = w.Number("1");
  for (int i = 0; i < 40; ++i) expr = w.Binary(ExprOp::kAdd, expr, expr);
  CHECK(Has(FindViolation(wide).value_or(""), "too many nodes"));
}

TEST_CASE("ir verify: records") {
  CHECK(Has(After([](Module& m) { m.jumps[First<JumpId>()].search = static_cast<Search>(9); }), "search 9"));
  CHECK(Has(After([](Module& m) { m.switches[First<SwitchId>()].arm_count = 99; }), "arms"));
  CHECK(Has(After([](Module& m) { m.calls.All().back().program.value = 99; }), "program 99 of 4"));
  CHECK(Has(After([](Module& m) { m.calls.All().back().args = {kFar, 1}; }), "arguments"));
  CHECK(Has(After([](Module& m) { m.fors[First<ForId>()].variable = m.fors[First<ForId>()].end; }),
            "variable is literal, which cannot be written"));
  CHECK(Has(After([](Module& m) { m.parts[First<PartId>()].has_last = true; }), "a single block with an end"));
  CHECK(Has(After([](Module& m) { m.externs[First<ExternId>()].param_count = 99; }), "parameters"));
  CHECK(Has(After([](Module& m) { m.assign_lists.All().back().values.count = kFar; }), "values"));
  CHECK(Has(After([](Module& m) { m.expr_items.front().value = kFar; }), "entry is expression 1000000"));
}

TEST_CASE("ir verify: variables, origins, tables") {
  CHECK(Has(After([](Module& m) { m.variables[First<VariableId>()].name = {}; }), "name is missing"));
  CHECK(Has(After([](Module& m) { m.variables[First<VariableId>()].dimension_count = 4; }), "three dimensions"));
  CHECK(
      Has(After([](Module& m) { m.variables[First<VariableId>()].dimensions[1] = 4; }), "dimension that is not there"));
  CHECK(Has(After([](Module& m) { m.variables[First<VariableId>()].scope = Scope::kLocal; }), "a local of no program"));
  CHECK(Has(After([](Module& m) { m.variables[First<VariableId>()].file.value = 9; }), "file 9 has no name"));
  CHECK(Has(After([](Module& m) { m.file_names[0] = {}; }), "file 0 has no name"));
  CHECK(Has(After([](Module& m) { m.origins[First<OriginId>()].via = First<OriginId>(); }), "leads to one that"));
  CHECK(Has(After([](Module& m) { m.spaces[First<SpaceId>()].last = 0, m.spaces[First<SpaceId>()].first = 1; }),
            "ends before it starts"));
  CHECK(Has(After([](Module& m) { m.spellings.clear(); }), "spellings need entry 0"));
  CHECK(Has(After([](Module& m) { m.axis_names.resize(8); }), "too many axis names"));
}

TEST_CASE("ir verify: programs and blocks") {
  const auto program = [](Module& m) -> Program& { return m.programs[First<ProgramId>()]; };
  const auto block = [&](Module& m, std::uint32_t index) -> Block& { return m.blocks[program(m).blocks[index]]; };
  CHECK(Has(After([&](Module& m) { program(m).blocks.count = kFar; }), "blocks 0 to 1000000"));
  CHECK(Has(After([&](Module& m) { program(m).blocks.count += 1; }), "two programs share blocks"));
  CHECK(Has(After([&](Module& m) { program(m).parameters.begin = 0; }), "belongs to another program"));
  CHECK(Has(After([&](Module& m) { block(m, 1).words.count = kFar; }), "words"));
  CHECK(Has(After([&](Module& m) { block(m, 1).comments.begin = kFar; }), "comments"));
  CHECK(
      Has(After([&](Module& m) { m.comments[block(m, 1).comments[1]].word = 6; }), "before a word that is not there"));
  CHECK(Has(After([&](Module& m) { block(m, 1).label.value = kFar; }), "label is string"));
  CHECK(Has(After([&](Module& m) { block(m, 1).origin.value = kFar; }), "origin 1000000"));
  CHECK(Has(After([&](Module& m) { block(m, 1).skip_level = 20; }), "skip level over 15"));
  CHECK(Has(After([&](Module& m) { block(m, 1).flags = 0x10; }), "unknown flag"));
  CHECK(Has(After([&](Module& m) { block(m, 1).link = program(m).blocks[2]; }), "a link without structure mark"));
  CHECK(Has(After([&](Module& m) { block(m, 1).link.value = kFar; }), "link out of the program"));
}

TEST_CASE("ir verify: structure links") {
  const auto build = [](std::initializer_list<WordOp> marks) {
    Module m;
    ExprBuilder e(m);
    ProgramBuilder p(m, "P");
    for (const WordOp op : marks) {
      p.Block().Add(op, ValueUseOf(op) == ValueUse::kMust ? e.Number("1") : ExprId{}).Finish();
    }
    p.Finish();
    diag::Sink sink;
    BuildStructure(m, p.Id(), 0, sink);
    return m;
  };
  VerifyOptions built;
  built.structure_built = true;
  const auto violation = [&](const Module& m) { return FindViolation(m, built).value_or(""); };
  const auto link = [](Module& m, std::size_t from, std::size_t to) { m.blocks[BlockId{from}].link = BlockId{to}; };
  const auto marks = {WordOp::kIf, WordOp::kElse, WordOp::kEndIf, WordOp::kWhile, WordOp::kEndWhile};
  Module m = build(marks);
  CHECK(violation(m) == "");
  m.blocks[BlockId{std::size_t{3}}].link = {};
  CHECK(Has(violation(m), "has no link"));
  m = build(marks);
  link(m, 0, 2);
  CHECK(Has(violation(m), "its IF does not link to it"));
  m = build(marks);
  link(m, 2, 1);
  CHECK(Has(violation(m), "does not link to its opener"));
  m = build(marks);
  link(m, 4, 0);
  CHECK(Has(violation(m), "does not link to its opener"));
  m = build(marks);
  link(m, 3, 0);
  CHECK(Has(violation(m), "link leads back"));
  m = build({WordOp::kLoop, WordOp::kRepeat, WordOp::kUntil, WordOp::kEndLoop});
  CHECK(violation(m) == "");
  link(m, 0, 2);
  CHECK(Has(violation(m), "its partner does not link to it"));
  // What BuildStructure refuses verifies, although marks have no partner.
  CHECK(violation(build({WordOp::kIf, WordOp::kWhile, WordOp::kEndIf, WordOp::kEndWhile, WordOp::kElse})) == "");
}

TEST_CASE("ir verify: a broken module stops the program with the dump around the place") {
  Module module = Sample();
  Find(module, WordOp::kRadius).value = {};
  std::fflush(nullptr);  // the child must not print what waits here
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    Verify(module, "after the test");
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t got = read(ends[0], buffer, sizeof(buffer)); got > 0; got = read(ends[0], buffer, sizeof(buffer))) {
    text.append(buffer, static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 70);
  CHECK(Has(text, "radius; opening-angle"));
  CHECK(Has(text, "\n  // ^ word 6 (radius): has no value\n"));
  CHECK(Has(text, "after the test"));
  CHECK(Verify(Sample(), "of a sound module"));
}
