#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "dialects/sinumerik/words.h"
#include "ir/modes.h"

namespace ncport::dialects::sinumerik {

TEST_CASE("codes are read both ways") {
  const CodeRow* row = Codes().FindText("G331");
  REQUIRE(row != nullptr);
  CHECK(row->op == ir::WordOp::kMotion);
  CHECK(row->index == static_cast<std::uint8_t>(ir::Motion::kTapIn));
  CHECK(Codes().FindMeaning(ir::WordOp::kMotion, static_cast<std::uint8_t>(ir::Motion::kTapIn)) == row);
  CHECK(Codes().FindMeaning(ir::WordOp::kWorkOffset, 0, 599)->text == "G599");
  CHECK(Codes().FindMeaning(ir::WordOp::kWorkOffset, 0, 0)->text == "G500");
  CHECK(Codes().FindMeaning(ir::WordOp::kPathMode, static_cast<std::uint8_t>(ir::PathMode::kContinuous))->text ==
        "G64");
  CHECK(Codes().FindText("G44") == nullptr);
}

TEST_CASE("reserved words hold every table word of two letters or more") {
  CHECK(IsReserved("ASPLINE"));
  CHECK_FALSE(IsReserved("MY_VAR"));
  const auto words = ReservedWords();
  CHECK(std::is_sorted(words.begin(), words.end()));
  const auto is_name = [](std::string_view text) {
    const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    return text.size() > 1 && letter(text[0]) && letter(text[1]);
  };
  for (const CodeRow& row : Codes().Rows()) {
    if (is_name(row.text)) CHECK_MESSAGE(IsReserved(row.text), row.text);
  }
  for (const AddressRow& row : Addresses()) {
    if (is_name(row.text)) CHECK_MESSAGE(IsReserved(row.text), row.text);
  }
  for (const FunctionRow& row : Functions()) CHECK_MESSAGE(IsReserved(row.text), row.text);
}

TEST_CASE("machine and setting data are known by the pattern of their names") {
  CHECK(FindSystemVariable("MN_LUD_EXTENDED_SCOPE") != nullptr);
  CHECK(FindSystemVariable("SC_DEFAULT_FEED") != nullptr);
  CHECK(FindSystemVariable("TC_DP1")->type == ir::Type::kInt);
  CHECK(FindSystemVariable("TC_DP6")->type == ir::Type::kReal);
  CHECK(FindSystemVariable("P_EP")->kind == ir::SystemKind::kProgrammedPosition);
  CHECK(FindSystemVariable("QX_NOTHING") == nullptr);
  for (const SystemRow& row : SystemVariables()) CHECK(FindSystemVariable(row.name) == &row);
}

}  // namespace ncport::dialects::sinumerik
