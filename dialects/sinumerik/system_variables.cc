// System variables of card section 9. What only the machine knows is kEnvironment.
#include <algorithm>
#include <string>

#include "base/letter_case.h"
#include "dialects/sinumerik/words.h"

namespace ncport::dialects::sinumerik {

namespace {

using K = ir::SystemKind;
using ir::Type;

// Sorted by name.
constexpr SystemRow kRows[] = {
    {"AA_DTEW", K::kEnvironment, Type::kReal, false, 1},
    {"AA_ETRANS", K::kEnvironment, Type::kReal, true, 1},
    {"AA_IB", K::kEnvironment, Type::kReal, false, 1},
    {"AA_IEN", K::kEnvironment, Type::kReal, false, 1},
    {"AA_IM", K::kEnvironment, Type::kReal, false, 1},
    {"AA_IW", K::kEnvironment, Type::kReal, false, 1},
    {"AA_LOAD", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MM", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MM1", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MM2", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MM3", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MM4", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MW", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MW1", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MW2", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MW3", K::kEnvironment, Type::kReal, false, 1},
    {"AA_MW4", K::kEnvironment, Type::kReal, false, 1},
    {"AA_OFF", K::kEnvironment, Type::kReal, true, 1},
    {"AA_OVR", K::kEnvironment, Type::kReal, true, 1},
    {"AA_S", K::kEnvironment, Type::kReal, false, 1},
    {"AA_STAT", K::kEnvironment, Type::kInt, false, 1},
    {"AA_TYP", K::kEnvironment, Type::kInt, false, 1},
    {"AA_VACTM", K::kEnvironment, Type::kReal, false, 1},
    {"AC_ACTUAL_PARTS", K::kEnvironment, Type::kReal, true, 0},
    {"AC_ALARM_STAT", K::kEnvironment, Type::kInt, false, 0},
    {"AC_ASUP", K::kEnvironment, Type::kInt, false, 0},
    {"AC_CUTTING_TIME", K::kEnvironment, Type::kReal, true, 0},
    {"AC_CYCLE_TIME", K::kEnvironment, Type::kReal, true, 0},
    {"AC_DELT", K::kEnvironment, Type::kReal, false, 0},
    {"AC_DTEB", K::kEnvironment, Type::kReal, false, 0},
    {"AC_MARKER", K::kUserMemory, Type::kInt, true, 1},
    {"AC_MEA", K::kEnvironment, Type::kInt, false, 1},
    {"AC_MSNUM", K::kEnvironment, Type::kInt, false, 0},
    {"AC_OPERATING_TIME", K::kEnvironment, Type::kReal, true, 0},
    {"AC_OVR", K::kEnvironment, Type::kReal, true, 0},
    {"AC_PARAM", K::kUserMemory, Type::kReal, true, 1},
    {"AC_PATHN", K::kEnvironment, Type::kReal, false, 0},
    {"AC_PROG", K::kEnvironment, Type::kInt, false, 0},
    {"AC_REQUIRED_PARTS", K::kEnvironment, Type::kReal, true, 0},
    {"AC_SDIR", K::kEnvironment, Type::kInt, false, 1},
    {"AC_SERUPRO", K::kEnvironment, Type::kInt, false, 0},
    {"AC_SPECIAL_PARTS", K::kEnvironment, Type::kReal, true, 0},
    {"AC_STAT", K::kEnvironment, Type::kInt, false, 0},
    {"AC_TIME", K::kEnvironment, Type::kReal, false, 0},
    {"AC_TIMER", K::kEnvironment, Type::kReal, true, 1},
    {"AC_TOTAL_PARTS", K::kEnvironment, Type::kReal, true, 0},
    {"AC_VACTB", K::kEnvironment, Type::kReal, false, 0},
    {"AC_VACTW", K::kEnvironment, Type::kReal, false, 0},
    {"AN_NCK_VERSION", K::kEnvironment, Type::kReal, false, 0},
    {"A_DAY", K::kEnvironment, Type::kInt, false, 0},
    {"A_DBB", K::kEnvironment, Type::kInt, true, 1},
    {"A_DBD", K::kEnvironment, Type::kInt, true, 1},
    {"A_DBR", K::kEnvironment, Type::kReal, true, 1},
    {"A_DBW", K::kEnvironment, Type::kInt, true, 1},
    {"A_HOUR", K::kEnvironment, Type::kInt, false, 0},
    {"A_IN", K::kEnvironment, Type::kBool, false, 1},
    {"A_INA", K::kEnvironment, Type::kReal, false, 1},
    {"A_MINUTE", K::kEnvironment, Type::kInt, false, 0},
    {"A_MONTH", K::kEnvironment, Type::kInt, false, 0},
    {"A_OUT", K::kEnvironment, Type::kBool, true, 1},
    {"A_OUTA", K::kEnvironment, Type::kReal, true, 1},
    {"A_PROBE", K::kEnvironment, Type::kInt, false, 1},
    {"A_SECOND", K::kEnvironment, Type::kInt, false, 0},
    {"A_YEAR", K::kEnvironment, Type::kInt, false, 0},
    {"PI", K::kPi, Type::kReal, false, 0},
    {"P_ACTFRAME", K::kEnvironment, Type::kFrame, false, 0},
    {"P_AD", K::kEnvironment, Type::kReal, true, 1},
    {"P_AXN1", K::kPlaneAxis, Type::kAxis, false, 0},
    {"P_AXN2", K::kPlaneAxis, Type::kAxis, false, 0},
    {"P_AXN3", K::kPlaneAxis, Type::kAxis, false, 0},
    {"P_BFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_CHBFR", K::kEnvironment, Type::kFrame, true, 1},
    {"P_CHBFRAME", K::kEnvironment, Type::kFrame, true, 1},
    {"P_CYCFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_DRYRUN", K::kEnvironment, Type::kBool, false, 0},
    {"P_EP", K::kProgrammedPosition, Type::kReal, false, 1},
    {"P_EPM", K::kEnvironment, Type::kReal, false, 1},
    {"P_EXTFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_F", K::kActiveFeed, Type::kReal, false, 0},
    {"P_FA", K::kEnvironment, Type::kReal, false, 1},
    {"P_GG", K::kModalGroup, Type::kInt, false, 1},
    {"P_IFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_ISTEST", K::kEnvironment, Type::kBool, false, 0},
    {"P_LINENO", K::kEnvironment, Type::kInt, false, 1},
    {"P_MC", K::kModalCallActive, Type::kInt, false, 0},
    {"P_MSNUM", K::kEnvironment, Type::kInt, false, 0},
    {"P_NCBFRAME", K::kEnvironment, Type::kFrame, true, 1},
    {"P_OFFN", K::kEnvironment, Type::kReal, false, 0},
    {"P_PARTFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_PATH", K::kEnvironment, Type::kString, false, 1},
    {"P_PFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_PROG", K::kEnvironment, Type::kString, false, 1},
    {"P_PROGPATH", K::kEnvironment, Type::kString, false, 0},
    {"P_PROG_EVENT", K::kEnvironment, Type::kInt, false, 0},
    {"P_REPINF", K::kEnvironment, Type::kInt, false, 0},
    {"P_S", K::kActiveSpeed, Type::kReal, false, 1},
    {"P_SDIR", K::kEnvironment, Type::kInt, false, 1},
    {"P_SEARCH", K::kEnvironment, Type::kBool, false, 0},
    {"P_SETFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_SIM", K::kEnvironment, Type::kBool, false, 0},
    {"P_SMODE", K::kEnvironment, Type::kInt, false, 1},
    {"P_STACK", K::kProgramLevel, Type::kInt, false, 0},
    {"P_SUBPAR", K::kWasProgrammed, Type::kBool, false, 1},
    {"P_TOOL", K::kActiveEdge, Type::kInt, false, 0},
    {"P_TOOLEXIST", K::kEnvironment, Type::kBool, false, 1},
    {"P_TOOLFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_TOOLL", K::kEnvironment, Type::kReal, false, 1},
    {"P_TOOLND", K::kEnvironment, Type::kInt, false, 1},
    {"P_TOOLNO", K::kActiveTool, Type::kInt, false, 0},
    {"P_TOOLNT", K::kEnvironment, Type::kInt, false, 0},
    {"P_TOOLP", K::kProgrammedTool, Type::kInt, false, 0},
    {"P_TOOLR", K::kEnvironment, Type::kReal, false, 0},
    {"P_TRAFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"P_UBFR", K::kEnvironment, Type::kFrame, true, 0},
    {"P_UIFR", K::kEnvironment, Type::kFrame, true, 1},
    {"P_UIFRNUM", K::kEnvironment, Type::kInt, false, 0},
    {"P_USEKT", K::kEnvironment, Type::kInt, true, 0},
    {"P_WPFRAME", K::kEnvironment, Type::kFrame, true, 0},
    {"VA_IM", K::kEnvironment, Type::kReal, false, 1},
};

// Tool data: TC_DP1 .. TC_DP25, TC_TP1 ..; two indices (tool, edge) or one.
constexpr SystemRow kToolEdgeInt{"TC_DP", K::kEnvironment, Type::kInt, true, 2};
constexpr SystemRow kToolEdge{"TC_DP", K::kEnvironment, Type::kReal, true, 2};
constexpr SystemRow kToolText{"TC_TP2", K::kEnvironment, Type::kString, true, 1};
constexpr SystemRow kTool{"TC_TP", K::kEnvironment, Type::kInt, true, 1};
// Machine and setting data: any type, any number of indices.
constexpr SystemRow kData{"M", K::kEnvironment, Type::kAny, false, 0xFF};

// Other variables of the control: their names begin with the letters of section 9, what they hold is not modelled.
constexpr SystemRow kOther{"A", K::kEnvironment, Type::kAny, true, 0xFF};

bool StartsWith(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

/// Machine and setting data, by the letters in front.
bool StartsAsData(std::string_view name) {
  for (const std::string_view start : {"MN_", "MC_", "MA_", "MAS_", "SN_", "SC_", "SA_"}) {
    if (StartsWith(name, start)) return true;
  }
  return false;
}

}  // namespace

std::span<const SystemRow> SystemVariables() { return kRows; }

const SystemRow* FindSystemVariable(std::string_view name) {
  const auto* it = std::lower_bound(std::begin(kRows), std::end(kRows), name,
                                    [](const SystemRow& row, std::string_view key) { return row.name < key; });
  if (it != std::end(kRows) && it->name == name) return it;
  if (name == "TC_DP1" || name == "TC_DP2" || name == "TC_DPCE" || name == "TC_DPH") return &kToolEdgeInt;
  if (StartsWith(name, "TC_DP")) return &kToolEdge;
  if (name == "TC_TP2") return &kToolText;
  if (StartsWith(name, "TC_TP")) return &kTool;
  if (StartsAsData(name)) return &kData;
  for (const std::string_view start :
       {"A_", "AA_", "AC_", "AN_", "P_", "VA_", "VC_", "VN_", "TC_", "C_", "ON_", "OC_", "OA_"}) {
    if (StartsWith(name, start)) return &kOther;
  }
  return nullptr;
}

bool IsMachineData(std::string_view name) {
  return StartsAsData(UpperOf(name.substr(std::min(name.find_first_not_of('$'), name.size()))));
}

bool IsUnlistedSystemVariable(std::string_view name) { return FindSystemVariable(name) == &kOther; }

}  // namespace ncport::dialects::sinumerik
