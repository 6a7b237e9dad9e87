#include "dialects/sinumerik/cycle_parameters.h"

#include <algorithm>

#include "base/letter_case.h"

namespace ncport::dialects::sinumerik {
namespace {

// Card 8.12. Complete are only lists of cycles that newer versions replace by others instead of appending to them.
constexpr CycleParameters kCycles[] = {
    {"CYCLE62", "_KNAME,_TYPE,_LAB1,_LAB2", "_KNAME,_LAB1,_LAB2"},
    {"CYCLE71", "_RTP,_RFP,_SDIS,_DP,_PA,_PO,_LENG,_WID,_STA,_MID,_MIDA,_FDP,_FALD,_FFP1,_VARI,_FDP1", ""},
    {"CYCLE72", "_KNAME,_RTP,_RFP,_SDIS,_DP,_MID,_FAL,_FALD,_FFP1,_FFD,_VARI,_RL,_AS1,_LP1,_FF3,_AS2,_LP2", "_KNAME"},
    {"CYCLE77", "_RTP,_RFP,_SDIS,_DP,_DPR,_PRAD,_PA,_PO,_MID,_FAL,_FALD,_FFP1,_FFD,_CDIR,_VARI,_AP1", ""},
    {"CYCLE81", "RTP,RFP,SDIS,DP,DPR", ""},
    {"CYCLE82", "RTP,RFP,SDIS,DP,DPR,DTB", ""},
    {"CYCLE83", "RTP,RFP,SDIS,DP,DPR,FDEP,FDPR,DAM,DTB,DTS,FRF,VARI,_AXN,_MDEP,_VRT,_DTD,_DIS1", ""},
    {"CYCLE84", "RTP,RFP,SDIS,DP,DPR,DTB,SDAC,MPIT,PIT,POSS,SST,SST1,_AXN,_PTAB,_TECHNO,_VARI,_DAM,_VRT", ""},
    {"CYCLE840", "RTP,RFP,SDIS,DP,DPR,DTB,SDR,SDAC,ENC,MPIT,PIT,_AXN,_PTAB,_TECHNO", ""},
    {"CYCLE85", "RTP,RFP,SDIS,DP,DPR,DTB,FFR,RFF", ""},
    {"CYCLE86", "RTP,RFP,SDIS,DP,DPR,DTB,SDIR,RPA,RPO,RPAP,POSS", ""},
    {"CYCLE87", "RTP,RFP,SDIS,DP,DPR,SDIR", ""},
    {"CYCLE88", "RTP,RFP,SDIS,DP,DPR,DTB,SDIR", ""},
    {"CYCLE89", "RTP,RFP,SDIS,DP,DPR,DTB", ""},
    {"CYCLE93", "SPD,SPL,WIDG,DIAG,STA1,ANG1,ANG2,RCO1,RCO2,RCI1,RCI2,FAL1,FAL2,IDEP,DTB,VARI,_VRT,_DN", "", true},
    {"CYCLE95", "NPP,MID,FALZ,FALX,FAL,FF1,FF2,FF3,VARI,DT,DAM,_VRT", "NPP", true},
    {"CYCLE97", "PIT,MPIT,SPL,FPL,DM1,DM2,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,VARI,NUMT,_VRT", "", true},
    {"POCKET2", "RTP,RFP,SDIS,DP,DPR,PRAD,CPA,CPO,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF", ""},
    {"POCKET3",
     "_RTP,_RFP,_SDIS,_DP,_LENG,_WID,_CRAD,_PA,_PO,_STA,_MID,_FAL,_FALD,_FFP1,_FFD,_CDIR,_VARI,_MIDA,_AP1,_AP2,_AD,"
     "_RAD1,_DP1",
     ""},
    {"POCKET4", "_RTP,_RFP,_SDIS,_DP,_PRAD,_PA,_PO,_MID,_FAL,_FALD,_FFP1,_FFD,_CDIR,_VARI,_MIDA,_AP1,_AD,_RAD1,_DP1",
     ""},
    {"SLOT2", "RTP,RFP,SDIS,DP,DPR,NUM,AFSL,WID,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF,_FFCP",
     ""},
};

constexpr std::string_view kSize = "MPIT is a thread size, M3 to M48, its sign the hand; the lead itself stands in PIT";
constexpr std::string_view kDirection = "the number of an M word: 3, 4 or 5";

constexpr CycleValues kValues[] = {
    {"CYCLE83", "VARI", {{0, 1}}, 1, "0 or 1", "0 breaks the chips, 1 lifts out of the hole"},
    {"CYCLE84", "SDAC", {{0, 0}, {3, 5}}, 2, "3 to 5", kDirection},
    {"CYCLE84", "MPIT", {{-48, -3}, {0, 0}, {3, 48}}, 3, "3 to 48", kSize},
    {"CYCLE84", "_PTAB", {{0, 3}}, 1, "0 to 3", "the unit of PIT: 1 mm, 2 threads per inch, 3 inch"},
    {"CYCLE840", "SDR", {{0, 0}, {3, 4}}, 2, "0, 3 or 4", "the direction of the way back; 0 reverses by itself"},
    {"CYCLE840", "SDAC", {{0, 0}, {3, 5}}, 2, "3 to 5", kDirection},
    {"CYCLE840", "MPIT", {{-48, -3}, {0, 0}, {3, 48}}, 3, "3 to 48", kSize},
    {"CYCLE86", "SDIR", {{3, 4}}, 1, "3 or 4", "the number of an M word: 3 or 4"},
    {"CYCLE87", "SDIR", {{3, 4}}, 1, "3 or 4", "the number of an M word: 3 or 4"},
    {"CYCLE88", "SDIR", {{3, 4}}, 1, "3 or 4", "the number of an M word: 3 or 4"},
    {"CYCLE93", "VARI", {{1, 8}, {11, 18}}, 2, "1 to 8 or 11 to 18", "the way of machining"},
    {"CYCLE95", "VARI", {{1, 12}, {201, 212}}, 2, "1 to 12", "1 to 4 rough, 5 to 8 finish, 9 to 12 do both"},
};

/// Calls `visit(name)` for the names of a list until it returns true.
template <class Visit>
void ForNames(std::string_view list, Visit visit) {
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    if (visit(list.substr(0, comma)) || comma == std::string_view::npos) return;
    list.remove_prefix(comma + 1);
  }
}

}  // namespace

const CycleParameters* FindCycleParameters(std::string_view name) {
  for (const CycleParameters& row : kCycles) {
    if (std::ranges::equal(row.cycle, name, [](char x, char y) { return x == Upper(y); })) return &row;
  }
  return nullptr;
}

std::uint32_t CountOf(const CycleParameters& cycle) {
  return static_cast<std::uint32_t>(std::ranges::count(cycle.names, ',')) + 1;
}

std::string_view ParameterAt(const CycleParameters& cycle, std::uint32_t position) {
  std::string_view found;
  ForNames(cycle.names, [&](std::string_view name) {
    if (position-- != 0) return false;
    found = name;
    return true;
  });
  return found;
}

bool IsTextParameter(const CycleParameters& cycle, std::string_view parameter) {
  bool text = false;
  ForNames(cycle.texts, [&](std::string_view name) {
    text = name == parameter;
    return text;
  });
  return text;
}

std::span<const CycleValues> CycleValueRows() { return kValues; }

}  // namespace ncport::dialects::sinumerik
