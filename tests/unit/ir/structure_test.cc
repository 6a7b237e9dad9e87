#include "ir/structure.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "ir/builder.h"

using namespace ncport;
using namespace ncport::ir;

namespace {

struct Marks {
  Module module;
  ProgramId program;
  diag::Sink sink;

  // One mark a word of `text`; "." is a plain block; "while2" a WHILE with DO number 2.
  explicit Marks(std::string_view text, std::uint32_t max_depth = 0) {
    ExprBuilder e(module);
    ProgramBuilder builder(module, "P", ProgramKind::kMain, AddFile(module, "p.mpf"));
    program = builder.Id();
    while (!text.empty()) {
      const auto blank = text.find(' ');
      std::string_view word = text.substr(0, blank);
      text = blank == std::string_view::npos ? std::string_view{} : text.substr(blank + 1);
      BlockBuilder block = builder.Block();
      std::uint8_t index = 0;
      if (word.back() >= '1' && word.back() <= '9') {
        index = static_cast<std::uint8_t>(word.back() - '0');
        word.remove_suffix(1);
      }
      const bool unread = word.front() == '?';  // a mark that the frontend refused
      if (unread) word.remove_prefix(1);
      if (word != ".") {
        for (unsigned op = static_cast<unsigned>(WordOp::kIf); op <= static_cast<unsigned>(WordOp::kEndFor); ++op) {
          const auto word_op = static_cast<WordOp>(op);
          if (NameOf(word_op) != word) continue;
          if (unread) {
            block.Flags(Block::kRefused);
            block.Add(WordOp::kVerbatim, {}, static_cast<std::uint8_t>(op), module.strings.Intern("?").value);
            continue;
          }
          const bool valued = ValueUseOf(word_op) == ValueUse::kMust;
          block.Add(word_op, valued ? e.Number("1") : ExprId{}, index);
        }
      }
      block.Finish();
    }
    builder.Finish();
    BuildStructure(module, program, max_depth, sink);
    sink.SortByPlace();
  }

  // Links as block indices, -1 for none.
  std::vector<int> Links() const {
    std::vector<int> links;
    for (const Block& block : module.blocks.All()) links.push_back(static_cast<int>(block.link.value));
    return links;
  }
  bool Refused(std::size_t index) const { return (module.blocks[BlockId{index}].flags & Block::kRefused) != 0; }
  std::vector<std::string> Messages() const {
    std::vector<std::string> messages;
    for (const auto& finding : sink.All()) {
      messages.push_back(std::to_string(finding.at.line) + ": " + finding.message);
      for (const auto& note : finding.notes) {
        messages.push_back("  " + std::to_string(note.at.line) + ": " + note.text);
      }
    }
    return messages;
  }
};

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("ir structure: links of well nested marks") {
  const Marks marks("if . else while . end-while end-if loop for end-for end-loop repeat . until .");
  CHECK(marks.sink.Empty());
  CHECK(marks.Links() == std::vector<int>{2, -1, 6, 5, -1, 3, 0, 10, 9, 8, 7, 13, -1, 11, -1});
}

TEST_CASE("ir structure: an IF without ELSE leads to its end") {
  const Marks marks("if . end-if");
  CHECK(marks.sink.Empty());
  CHECK(marks.Links() == std::vector<int>{2, -1, 0});
}

TEST_CASE("ir structure: an unclosed mark is one finding, and what follows is kept") {
  const Marks marks("while . if . end-if .");
  CHECK(marks.Messages() == Texts{"1: while has no end-while"});
  CHECK(marks.Refused(0));
  CHECK_FALSE(marks.Refused(2));
  CHECK(marks.Links() == std::vector<int>{-1, -1, 4, -1, 2, -1});
}

TEST_CASE("ir structure: an end or a middle without opener is stray") {
  const Marks marks("end-if . else until");
  CHECK(marks.Messages() == Texts{"1: end-if without if", "3: else without if", "4: until without repeat"});
  CHECK(marks.Refused(0));
  CHECK(marks.Refused(2));
  CHECK(marks.Refused(3));
  CHECK_FALSE(marks.Refused(1));
}

TEST_CASE("ir structure: a second ELSE points at the first") {
  const Marks marks("if else else end-if");
  CHECK(marks.Messages() == Texts{"3: else without if", "  2: the first one stands here"});
  CHECK(marks.Links() == std::vector<int>{1, 3, -1, 0});
}

TEST_CASE("ir structure: crossed structures are one finding with both partners") {
  const Marks marks("if while end-if end-while .");
  CHECK(marks.Messages() ==
        Texts{"3: end-if stands inside while and ends it", "  2: while opens here", "  4: its end-while stands here"});
  CHECK(marks.Refused(1));
  CHECK(marks.Refused(2));
  CHECK(marks.Refused(3));
  CHECK_FALSE(marks.Refused(4));
}

TEST_CASE("ir structure: a forgotten end inside another structure is found at its opener") {
  const Marks marks("loop if . end-loop");
  CHECK(marks.Messages() == Texts{"2: if has no end-if", "  4: end-loop ends the structure around it"});
  CHECK(marks.Links() == std::vector<int>{3, -1, -1, 0});
  CHECK_FALSE(marks.Refused(0));
  CHECK_FALSE(marks.Refused(3));
}

TEST_CASE("ir structure: DO numbers tell loops apart") {
  const Marks nested("while1 while2 end-while2 end-while1");
  CHECK(nested.sink.Empty());
  CHECK(nested.Links() == std::vector<int>{3, 2, 1, 0});
  const Marks crossed("while1 while2 end-while1 end-while2");
  CHECK(crossed.Messages() == Texts{"3: end-while 1 stands inside while 2 and ends it", "  2: while 2 opens here",
                                    "  4: its end-while 2 stands here"});
  const Marks wrong("while1 . end-while2");
  CHECK(wrong.Messages() == Texts{"3: end-while 2 without while 2", "  1: while 1 opens here and has no end-while 1"});
}

TEST_CASE("ir structure: a mark that could not be read keeps its place and makes no second finding") {
  const Marks open("?if . else . end-if");
  CHECK(open.sink.Empty());
  CHECK(open.Links() == std::vector<int>{2, -1, 4, -1, 0});
  const Marks numbered("?while . end-while2 while1 ?end-while if ?end-if");
  CHECK(numbered.sink.Empty());
  CHECK(numbered.Links() == std::vector<int>{2, -1, 0, 4, 3, 6, 5});
  const Marks stray("if ?end-while end-if");
  CHECK(stray.Messages() == Texts{"2: end-while without while"});
}

TEST_CASE("ir structure: findings speak the words of the program") {
  Module module;
  ProgramBuilder builder(module, "P", ProgramKind::kMain, AddFile(module, "p.mpf"));
  ExprBuilder e(module);
  const std::uint16_t endif = AddSpelling(module, "ENDIF", "r");
  const std::uint16_t iff = AddSpelling(module, "IF", "r");
  const auto add = [&](WordOp op, std::uint16_t spelling, ExprId value) {
    BlockBuilder block = builder.Block();
    block.Add(op, value);
    block.Last().spelling = spelling;
    block.Finish();
  };
  add(WordOp::kIf, iff, e.Number("1"));
  add(WordOp::kIf, iff, e.Number("1"));
  add(WordOp::kEndIf, endif, {});
  builder.Finish();
  diag::Sink sink;
  BuildStructure(module, builder.Id(), 0, sink);
  REQUIRE(sink.All().size() == 1);
  CHECK(sink.All()[0].message == "IF has no ENDIF");
}

TEST_CASE("ir structure: nesting beyond the limit is one finding a place") {
  const Marks ok("if if end-if end-if", 2);
  CHECK(ok.sink.Empty());
  const Marks deep("if if if if end-if end-if end-if end-if", 2);
  CHECK(deep.Messages() == Texts{"3: if nested more than 2 deep", "  1: the outermost one opens here"});
  CHECK(deep.Refused(2));
  CHECK(deep.Links() == std::vector<int>{7, 6, 5, 4, 3, 2, 1, 0});
}

TEST_CASE("ir structure: building again gives the same links") {
  Marks marks("if else end-if");
  const auto before = marks.Links();
  BuildStructure(marks.module, marks.program, 0, marks.sink);
  CHECK(marks.Links() == before);
}

TEST_CASE("ir structure: time grows with the blocks, also for hostile nests") {
  // Quadratic work on 200,000 marks would take minutes.
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "if ";
  for (int i = 0; i < 100000; ++i) text += "end-while ";
  text += ".";
  const Marks marks(text);
  CHECK(marks.sink.ErrorCount() == 200000);
}
