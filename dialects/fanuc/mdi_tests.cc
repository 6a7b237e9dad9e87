#include "dialects/fanuc/mdi_tests.h"

namespace ncport::dialects::fanuc {

namespace {

constexpr MdiTest kTests[] = {
    {"GC1", "series", "the G-code series of the control", "G91", "",
     "alarm 808 or 1412: series T; accepted: series M (write G90 after it)", ""},
    {"GC2", "feed", "G98 is feed per minute, G99 feed per revolution", "G98", "G99",
     "the feed display shows mm/min, then mm/rev", "G99", true, false},
    {"SP1", "spindle.cw", "which spindle M3 turns", "G97 S100 M3 R1", "M5",
     "the work turns: as written here; a tool turns: stop, M3 is no word of the work spindle", " M3", true, true},
    {"SP2", "spindle.cw", "which way M203 turns the work (milling spindle empty)", "G97 S100 M203", "M205",
     "which spindle, which way, seen from behind the spindle", "M203", false, true},
    {"SP3", "spindle.r-word", "a speed word needs R1", "G97 S100", "M3", "alarm: R1 is needed (F32 = 0)", " R1"},
    {"SP4", "spindle.limit", "G50 S limits the speed under G96", "G50 S300 R1", "G96 S60 M3 R1",
     "at X40.: 300 1/min: the limit works; 477: G50 S is not the word", "G50 S", true, false},
    {"SP5", "spindle.limit", "G92 S limits the speed under G96", "G92 S300 R1", "G96 S60 M203",
     "at X40.: 300 1/min: the limit works; 477: G92 S is not the word", "G92 S", false, true},
    {"DW1", "fanuc.dwell", "a dwell counts seconds while G99 (G95) is active, or is written under G98 (G94)",
     "G99 (M: G95), spindle at S120", "G4 X5.", "5 s: time; 2.5 s: revolutions", "G4 "},
    {"XU2", "words.diameter", "G10.9 X1 makes X a diameter", "G10.9 X1", "G91 G94 G1 X2. F500. (then G90)",
     "the machine display moves 1: diameter", "G10.9", false, true},
    {"NU1", "point", "a length without point counts increments (every length here has a point)", "G98 (M: G94)",
     "G1 W1 F500 (M: G91 G1 Z1 F500)", "+1.000: whole mm; +0.001 or +0.0001: increments", ""},
    {"NU2", "increment", "computed words are rounded to the increment", "#100=1.23456", "G1 W#100 F500. (M: G91 Z#100)",
     "display 1.235: 0.001; 1.2346: 0.0001", "#"},
    {"VA3", "nesting.brackets", "five levels of brackets", "#101=[[[[[1.+1.]+1.]+1.]+1.]+1.]",
     "#102=[[[[[[1.+1.]+1.]+1.]+1.]+1.]+1.]", "first 6, then alarm 858: five levels", "["},
    {"VA5", "fanuc.atan-range", "the range of ATAN and ASIN", "#101=ATAN[-1.]/[-1.]", "#102=ASIN[-0.5]",
     "225 or -135; 330 or -30", "ATAN["},
    {"VA6", "fanuc.missing-functions", "FIX cuts towards zero, ROUND rounds away from zero", "#101=FIX[-1.5]",
     "#102=ROUND[-1.5]", "-1 and -2: as assumed", "FIX["},
    {"VA4", "scratch", "#100 to #149 are free for this program", "#100=3.", "#149=3.",
     "after reset and after M30 read both: kept or vacant; ask who else uses them", "#1"},
    {"WC1", "fanuc.leave-mazatrol", "G52.5 leaves the MAZATROL coordinate system", "G54", "G52.5",
     "watch the position display: a jump at block 2: as written here; alarm at block 2: the word is absent", "G52.5"},
    {"WC2", "fanuc.wcs", "G54 holds the work zero, not the MAZATROL setup page", "#101=#5041", "#102=#5042",
     "both match the position page", "G54"},
    {"TL1", "tool", "a T word has four digits: station and offset", "T0101", "",
     "station 1 comes in, offset 1 is shown; alarm 839, 841, 937: six digits", "T0", true, false},
    {"TL2", "tool", "the offset comes in with the next move, not at the T word", "T0101 at the safe position", "",
     "the axes stand still; they jump: stop, keep clear (F161.2 = 1)", "T0", true, false},
    {"TL3", "tool", "what the digits behind the point of T mean", "T01.01 M6 with the spindle clear", "#101=#4120",
     "what T holds, and where B stands", " M6", false, true},
    {"OF1", "fanuc.ix-offset", "G43 P1 H#3020 brings in the offset of the active turning tool",
     "G43 P1 Z_ H#3020, clear", "#101=#5042", "the position page shows the tool's own offset", "G43 P1", false, true},
    {"BP1", "fanuc.b-position", "B of the turning position", "M108", "G0 G53 B_ (then M107)",
     "the tool stands as for turning", " B", false, true},
    {"AL1", "fanuc.alarms", "#3000 from 21 on stops with alarm 979 and shows the text", "#3000=21(TEST*ONE)", "",
     "alarm 979; is the text shown?", "#3000"},
    {"PR1", "names.program-form", "G65 P calls the file by its number", "file 4099.EIA: #101=123. / M99", "G65 P4099",
     "#101 is 123: as assumed; alarm 844: call it by name", "G65 P"},
    {"PR3", "nesting.macro", "G65 has locals of its own", "file 4107.EIA: #1=9. / M99", "#1=5. / G65 P4107",
     "#1 is 5: as assumed", "G65 P"},
    {"HO1", "home", "G53 goes to machine zero", "G0 G53 X0.", "#101=#5021", "#101 is 0", "G53"},
};

}  // namespace

std::span<const MdiTest> MdiTests() { return kTests; }

}  // namespace ncport::dialects::fanuc
