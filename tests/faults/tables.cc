#include "tests/faults/tables.h"

#include <algorithm>
#include <tuple>

#include "dialects/fanuc/words.h"
#include "dialects/iso/words.h"
#include "dialects/sinumerik/words.h"

namespace ncport::tests::faults {

namespace {

namespace fanuc = dialects::fanuc;
namespace sinumerik = dialects::sinumerik;
using dialects::CodeRow;

// What a row means; two rows of one meaning are no fault when they are swapped.
auto Meaning(const CodeRow& row) { return std::tuple(row.op, row.index, row.extra, row.flags); }
auto Meaning(const sinumerik::AddressRow& row) { return std::tuple(row.op, row.index); }
auto Meaning(const sinumerik::FunctionRow& row) { return row.function; }
auto Meaning(const sinumerik::ModeRow& row) { return row.mode; }
auto Meaning(const sinumerik::TypeRow& row) { return row.type; }
auto Meaning(const fanuc::FunctionRow& row) { return row.function; }
auto Meaning(const fanuc::OperatorRow& row) { return std::tuple(row.op, row.condition); }
auto Meaning(const fanuc::KeywordRow& row) { return row.keyword; }
auto Meaning(const fanuc::SpecialRow& row) { return row.special; }
auto Meaning(const fanuc::CycleRow& row) { return row.cycle; }

template <class Row>
bool Printed(const Row& row) {
  if constexpr (requires { row.alias; }) return !row.alias && row.op != ir::WordOp::kInert;
  return true;
}

template <class Row>
void Add(const std::string& name, const std::string& language, std::span<const Row> rows, Side side,
         std::vector<SeededTable>& out) {
  for (std::uint32_t row = 0; row < rows.size(); ++row) {
    if (side == Side::kWrite && !Printed(rows[row])) continue;
    std::uint32_t other = row + 1;
    while (other < rows.size() && ((side == Side::kWrite && !Printed(rows[other])) ||
                                   Meaning(rows[row]) == Meaning(rows[other]) || rows[row].text == rows[other].text))
      ++other;
    if (other == rows.size()) continue;
    SeededTable made;
    made.text_a = rows[row].text;
    made.text_b = rows[other].text;
    made.name = name + ": " + made.text_a + " <-> " + made.text_b + (side == Side::kRead ? " (read)" : " (printed)");
    // Two pairs of rows of one table can have the same texts: codes that mean something else on mills and lathes.
    const auto same = std::ranges::count_if(out, [&](const SeededTable& each) { return each.plain == made.name; });
    made.plain = made.name;
    if (same != 0) made.name += " #" + std::to_string(same + 1);
    made.language = language;
    made.fault = {rows.data(), side, row, other};
    if constexpr (std::is_same_v<Row, CodeRow>) {
      if (side == Side::kRead) {
        // In place: these rows are a copy that can be changed (Keep).
        auto* first = const_cast<Row*>(rows.data());
        made.swap = [first, row, other] { SwapTexts(first[row], first[other]); };
      }
    }
    out.push_back(std::move(made));
  }
}

template <class Row>
void AddBoth(const std::string& name, const std::string& language, std::span<const Row> rows,
             std::vector<SeededTable>& out) {
  Add(name, language, rows, Side::kRead, out);
  Add(name, language, rows, Side::kWrite, out);
}

}  // namespace

std::vector<SeededTable> ListTableFaults() {
  std::vector<SeededTable> out;
  AddBoth("sinumerik codes", "sinumerik", sinumerik::Codes().Rows(), out);
  AddBoth("sinumerik addresses", "sinumerik", sinumerik::Addresses(), out);
  AddBoth("sinumerik functions", "sinumerik", sinumerik::Functions(), out);
  AddBoth("sinumerik value modes", "sinumerik", sinumerik::ValueModes(), out);
  AddBoth("sinumerik types", "sinumerik", sinumerik::Types(), out);
  constexpr std::pair<const char*, fanuc::System> kSystems[] = {
      {"mill", fanuc::System::kMill},      {"lathe A", fanuc::System::kLatheA}, {"lathe B", fanuc::System::kLatheB},
      {"lathe C", fanuc::System::kLatheC}, {"Mazak T", fanuc::System::kMazakT}, {"Mazak M", fanuc::System::kMazakM}};
  for (const auto& [name, system] : kSystems)
    AddBoth(std::string("fanuc codes, ") + name, "fanuc", fanuc::Codes(system).Rows(), out);
  Add("fanuc specials", "fanuc", fanuc::SpecialCodes(), Side::kRead, out);
  // Printers look up one special code, the local shift: a fault by hand.
  Add("fanuc cycles", "fanuc", fanuc::Cycles(), Side::kRead, out);
  AddBoth("fanuc functions", "fanuc", fanuc::Functions(), out);
  AddBoth("fanuc operators", "fanuc", fanuc::Operators(), out);
  Add("fanuc keywords", "fanuc", fanuc::Keywords(), Side::kRead, out);
  // Flat words are written by the flat writer itself, which is seeded.
  Add("iso codes", "iso", dialects::iso::Codes().Rows(), Side::kRead, out);
  return out;
}

}  // namespace ncport::tests::faults
