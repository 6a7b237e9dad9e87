// What the word tables put into index and extra is what ir/word_shape.h says these hold: the words of every row verify.
#include <doctest/doctest.h>

#include "dialects/fanuc/words.h"
#include "dialects/sinumerik/words.h"
#include "ir/builder.h"
#include "ir/verify.h"

namespace ncport::dialects {

namespace {

void CheckRows(std::span<const CodeRow> rows) {
  CHECK_FALSE(rows.empty());
  for (const CodeRow& row : rows) {
    ir::Module module;
    ir::ExprBuilder e(module);
    ir::ProgramBuilder program(module, "P");
    ir::BlockBuilder block = program.Block();
    const bool valued = ir::ValueUseOf(row.op) == ir::ValueUse::kMust;
    block.Add(row.op, valued ? e.Number("1") : ir::ExprId{}, row.index, row.extra);
    block.Last().phase = row.phase;
    block.Last().flags = row.flags;
    block.Finish();
    program.Finish();
    const auto violation = ir::FindViolation(module);
    CHECK_MESSAGE(!violation, row.text << " (" << row.rule << "): " << violation.value_or(""));
  }
}

}  // namespace

TEST_CASE("words of every table row have the shape that the IR gives them") {
  CheckRows(sinumerik::Codes().Rows());
  for (std::size_t system = 0; system < fanuc::kSystems; ++system) {
    CheckRows(fanuc::Codes(static_cast<fanuc::System>(system)).Rows());
  }
}

}  // namespace ncport::dialects
