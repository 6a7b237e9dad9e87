#include "dialects/fanuc/words.h"

#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <set>
#include <string>

#include "dialects/machine.h"
#include "dialects/registry.h"

namespace ncport::dialects::fanuc {
namespace {

constexpr System kAllSystems[] = {System::kMill,   System::kLatheA, System::kLatheB,
                                  System::kLatheC, System::kMazakT, System::kMazakM};

template <class Mode>
std::string_view Text(System system, ir::WordOp op, Mode mode) {
  const CodeRow* row = Codes(system).FindMeaning(op, static_cast<std::uint8_t>(mode));
  return row == nullptr ? std::string_view{} : row->text;
}

TEST_CASE("one code means different things in the six systems") {
  const auto meaning = [](System system, std::string_view text) -> std::string {
    int count = 0;
    std::string found;
    if (Codes(system).FindText(text) != nullptr) {
      found = "code";
      ++count;
    }
    if (const SpecialRow* row = FindSpecial(system, text); row != nullptr) {
      found = row->title;
      ++count;
    }
    if (const CycleRow* row = FindCycle(system, text); row != nullptr) {
      found = row->title;
      ++count;
    }
    CHECK(count <= 1);
    return found;
  };
  CHECK(meaning(System::kMill, "G92") == "preset of coordinates, speed limit");
  CHECK(meaning(System::kLatheA, "G92") == "threading cycle");
  CHECK(meaning(System::kLatheB, "G92") == "preset of coordinates, speed limit");
  CHECK(meaning(System::kMazakT, "G92") == "threading cycle");
  CHECK(meaning(System::kMill, "G50") == "scaling off");
  CHECK(meaning(System::kLatheA, "G50") == "preset of coordinates, speed limit");
  CHECK(meaning(System::kMazakM, "G50") == "scaling off");
  CHECK(meaning(System::kMill, "G73") == "peck drilling with chip breaking");
  CHECK(meaning(System::kLatheA, "G73") == "pattern repeating");
  CHECK(meaning(System::kLatheC, "G73") == "rough turning");
  CHECK(meaning(System::kMazakM, "G273") == "pattern repeating");
  CHECK(meaning(System::kLatheC, "G21") == "threading cycle");
  CHECK(meaning(System::kLatheA, "G112") == "polar interpolation");
  CHECK(meaning(System::kMazakT, "G112") == "M S T B for the other system");
  CHECK(meaning(System::kLatheA, "G43").empty());
  CHECK(meaning(System::kLatheA, "G91").empty());
}

TEST_CASE("no text means two things in one system") {
  for (const System system : kAllSystems) {
    std::map<std::string_view, int> seen;
    for (const CodeRow& row : Codes(system).Rows()) ++seen[row.text];
    for (const SpecialRow& row : SpecialCodes()) {
      if (FindSpecial(system, row.text) == &row) ++seen[row.text];
    }
    for (const CycleRow& row : Cycles()) {
      if (FindCycle(system, row.text) == &row) ++seen[row.text];
    }
    for (const auto& entry : seen) CHECK_MESSAGE(entry.second == 1, std::string(entry.first));
  }
  // A row hidden behind another one of the same text and system would never be found.
  for (const SpecialRow& row : SpecialCodes()) {
    for (const System system : kAllSystems) {
      if ((row.systems >> static_cast<unsigned>(system) & 1U) != 0) CHECK(FindSpecial(system, row.text) == &row);
    }
  }
  for (const CycleRow& row : Cycles()) {
    for (const System system : kAllSystems) {
      if ((row.systems >> static_cast<unsigned>(system) & 1U) != 0) CHECK(FindCycle(system, row.text) == &row);
    }
  }
}

TEST_CASE("the words of feed, distance and units by system") {
  using Op = ir::WordOp;
  CHECK(Text(System::kMill, Op::kFeedMode, ir::FeedMode::kPerMinute) == "G94");
  CHECK(Text(System::kLatheA, Op::kFeedMode, ir::FeedMode::kPerMinute) == "G98");
  CHECK(Text(System::kLatheA, Op::kFeedMode, ir::FeedMode::kPerRevolution) == "G99");
  CHECK(Text(System::kLatheB, Op::kFeedMode, ir::FeedMode::kPerRevolution) == "G95");
  CHECK(Text(System::kMazakT, Op::kFeedMode, ir::FeedMode::kPerRevolution) == "G99");
  CHECK(Text(System::kMazakM, Op::kFeedMode, ir::FeedMode::kPerRevolution) == "G95");
  CHECK(Text(System::kLatheA, Op::kDistance, ir::Distance::kAbsolute).empty());
  CHECK(Text(System::kLatheB, Op::kDistance, ir::Distance::kIncremental) == "G91");
  CHECK(Text(System::kLatheC, Op::kUnits, ir::Units::kMm) == "G71");
  CHECK(Text(System::kLatheB, Op::kUnits, ir::Units::kMm) == "G21");
  CHECK(Text(System::kLatheA, Op::kMotion, ir::Motion::kThread) == "G32");
  CHECK(Text(System::kMill, Op::kMotion, ir::Motion::kThread) == "G33");
  CHECK(Text(System::kMazakT, Op::kMotion, ir::Motion::kThread) == "G32");
  CHECK(Codes(System::kMazakT).FindText("G33") != nullptr);
  CHECK(Codes(System::kMill).FindText("G53.5") == nullptr);
  // The profile says what M3 turns: the table must not.
  CHECK(Codes(System::kMazakM).FindText("M3") == nullptr);
  CHECK(Codes(System::kMill).FindText("M3") == nullptr);
  CHECK(TextOf(System::kLatheA, Special::kPreset) == "G50");
  CHECK(TextOf(System::kMazakM, Special::kPreset) == "G92");
  CHECK(TextOf(System::kMazakT, Special::kPolarOn) == "G122");
  CHECK(TextOf(System::kMill, Special::kPolarMillingOn) == "G12.1");
  CHECK(TextOf(System::kLatheA, Special::kScalingOn).empty());
}

TEST_CASE("the words that profiles write are those of their code table") {
  for (const ProfileInfo& info : ListProfiles()) {
    if (info.language != Language::kFanuc) continue;
    CAPTURE(info.name);
    const Profile profile = BuiltIn(info.name);
    const std::optional<System> system = SystemOf(profile);
    REQUIRE(system.has_value());
    using Op = ir::WordOp;
    CHECK(Text(*system, Op::kFeedMode, ir::FeedMode::kPerMinute) == *profile.words.feed_per_minute);
    CHECK(Text(*system, Op::kFeedMode, ir::FeedMode::kPerRevolution) == *profile.words.feed_per_revolution);
    CHECK(Text(*system, Op::kDistance, ir::Distance::kAbsolute) == *profile.words.absolute);
    CHECK(Text(*system, Op::kDistance, ir::Distance::kIncremental) == *profile.words.incremental);
    CHECK(Text(*system, Op::kUnits, ir::Units::kMm) == *profile.words.mm);
    CHECK(Text(*system, Op::kUnits, ir::Units::kInch) == *profile.words.inch);
    CHECK(Text(*system, Op::kMotion, ir::Motion::kThread) == *profile.words.thread);
    CHECK(profile.spindle.limit->starts_with(TextOf(*system, Special::kPreset)));
    // Increments: a letter of its own in systems A and T only.
    const AddressRow* u = FindAddress(*system, 'U');
    const bool increments = u != nullptr && u->mode == ir::ValueMode::kIncremental;
    CHECK(increments == !profile.words.incremental_axes->empty());
  }
}

TEST_CASE("modal reads follow the groups of the maker") {
  const auto read = [](std::string_view name, std::uint16_t group) {
    std::set<double> codes;
    for (const ir::GroupCode& row : MachineFor(BuiltIn(name)).groups) {
      if (row.group == group) codes.insert(row.code);
    }
    return codes;
  };
  CHECK(read("fanuc-mill", 2) == std::set<double>{17, 18, 19});
  CHECK(read("fanuc-lathe-a", 2) == std::set<double>{96, 97});
  CHECK(read("fanuc-lathe-a", 16) == std::set<double>{17, 18, 19});
  CHECK(read("fanuc-lathe-a", 5).contains(99));
  CHECK(read("fanuc-lathe-b", 11) == std::set<double>{98, 99});
  CHECK(read("fanuc-mill", 14).contains(54));
  CHECK(read("mazak-qtn", 12).contains(54));
  CHECK(read("mazak-qtn", 17) == std::set<double>{96, 97});
  CHECK(read("mazak-qtn", 14).empty());
}

TEST_CASE("arguments of macro calls: lists I and II") {
  CHECK(ArgumentCell('A') == 1);
  CHECK(ArgumentCell('D') == 7);
  CHECK(ArgumentCell('H') == 11);
  CHECK(ArgumentCell('I') == 4);
  CHECK(ArgumentCell('M') == 13);
  CHECK(ArgumentCell('Q') == 17);
  CHECK(ArgumentCell('Z') == 26);
  for (const char letter : std::string("GLNOP")) CHECK(ArgumentCell(letter) == 0);
  CHECK(ArgumentLetter(7) == 'D');
  CHECK(ArgumentLetter(10) == 0);
  CHECK(ArgumentLetter(0) == 0);
  CHECK(ArgumentCell(1, 0) == ArgumentCell('I'));
  CHECK(ArgumentCell(2, 1) == 8);
  CHECK(ArgumentCell(kArgumentSets, 2) == 33);
  for (const NumberRange& range : FreeLocals()) {
    for (std::uint32_t cell = range.first; cell <= range.last; ++cell) CHECK(ArgumentLetter(cell) == 0);
  }
}

TEST_CASE("abbreviations are those of the reserved words") {
  std::ifstream file(NCPORT_SOURCE_DIR "/docs/languages/fanuc-reserved.txt");
  std::string line;
  int count = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t tab = line.find('\t');
    const std::string word = line.substr(0, tab);
    const std::string shortest = tab == std::string::npos ? word : line.substr(tab + 1);
    CAPTURE(word);
    std::string known;
    for (const FunctionRow& row : Functions()) {
      if (row.text == word) known = row.shortest;
    }
    for (const OperatorRow& row : Operators()) {
      if (row.text == word) known = row.shortest;
    }
    for (const KeywordRow& row : Keywords()) {
      if (row.text == word) known = row.shortest;
    }
    CHECK(known == shortest);
    ++count;
  }
  CHECK(count > 40);
}

TEST_CASE("functions, operators and keywords by any spelling") {
  CHECK(FindFunction("SIN", true)->function == ir::Function::kSin);
  CHECK(FindFunction("SQ", true)->function == ir::Function::kSqrt);
  CHECK(FindFunction("SQRT", true)->function == ir::Function::kSqrt);
  CHECK(FindFunction("S", true) == nullptr);
  CHECK(FindFunction("SINE", true) == nullptr);
  CHECK(FindFunction("ATAN", true)->function == ir::Function::kAtan);
  CHECK(FindFunction("ATAN", false)->function == ir::Function::kAtan2Positive);
  CHECK(FindFunction("POW", false)->function == ir::Function::kPower);
  CHECK(FindFunction(ir::Function::kAtan2)->text == "ATAN");
  CHECK(FindFunction(ir::Function::kRoundUp) == nullptr);
  CHECK(FindOperator("AND")->op == ir::ExprOp::kBitAnd);
  CHECK(FindOperator("AND")->condition == ir::ExprOp::kAnd);
  CHECK(FindOperator("AND")->level < FindOperator("EQ")->level);
  CHECK(FindOperator("*")->level == FindOperator("AND")->level);
  CHECK(FindOperator("OR")->level == FindOperator("+")->level);
  CHECK(FindOperator(ir::ExprOp::kOr)->text == "OR");
  CHECK(FindOperator(ir::ExprOp::kDivideInteger) == nullptr);
  CHECK(FindOperator(ir::ExprOp::kLiteral) == nullptr);
  CHECK(FindKeyword("WH")->keyword == Keyword::kWhile);
  CHECK(FindKeyword("END")->keyword == Keyword::kEnd);
  CHECK(FindKeyword("ENDI") == nullptr);  // ENDIF must be written in full
  CHECK(FindKeyword("ENDIF")->keyword == Keyword::kEndIf);
}

TEST_CASE("numbers without point have the unit of their word") {
  CHECK(UnitOf(WordContext::kFeedPerRevolution, System::kMill).metric == 0.01);
  CHECK(UnitOf(WordContext::kFeedPerRevolution, System::kLatheA).metric == 0.0001);
  CHECK(UnitOf(WordContext::kFeedPerRevolution, System::kMazakT).metric == 0.01);
  CHECK_FALSE(UnitOf(WordContext::kDwellMilliseconds, System::kMill).point_allowed);
  CHECK_FALSE(UnitOf(WordContext::kCycleStep, System::kLatheA).point_allowed);
  CHECK(UnitOf(WordContext::kCycleStep, System::kMazakT).point_allowed);
  CHECK(FindAddress(System::kMill, 'M')->form == NumberForm::kInteger);
  CHECK(FindAddress(System::kMill, 'B')->form == NumberForm::kAngle);
  CHECK(FindAddress(System::kLatheA, 'W')->index == 2);
  CHECK(FindAddress(System::kLatheB, 'W') == nullptr);
  CHECK(FindAddress(System::kMill, 'O') == nullptr);
}

}  // namespace
}  // namespace ncport::dialects::fanuc
