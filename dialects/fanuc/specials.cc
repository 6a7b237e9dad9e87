// Codes that need words of their block, and canned cycles (fanuc-8.1, 8.4 to 8.9, 7; mazak-lathe-2.2, 2.3).
#include <algorithm>
#include <iterator>

#include "dialects/fanuc/words.h"

namespace ncport::dialects::fanuc {

namespace {

constexpr std::uint16_t Bit(System system) { return static_cast<std::uint16_t>(1U << static_cast<unsigned>(system)); }
constexpr std::uint16_t kMills = Bit(System::kMill);
constexpr std::uint16_t kA = Bit(System::kLatheA);
constexpr std::uint16_t kB = Bit(System::kLatheB);
constexpr std::uint16_t kC = Bit(System::kLatheC);
constexpr std::uint16_t kLathes = kA | kB | kC;
constexpr std::uint16_t kT = Bit(System::kMazakT);
constexpr std::uint16_t kM = Bit(System::kMazakM);
constexpr std::uint16_t kMazak = kT | kM;
constexpr std::uint16_t kAll = kMills | kLathes | kMazak;

using S = Special;

// The first row of a meaning in a system is the one that is printed.
constexpr SpecialRow kSpecials[] = {
    {"G4", S::kDwell, kAll, {0, 0, 0}, "dwell", "fanuc-8.1"},
    {"G10", S::kData, kAll, {0, 0, 0}, "data setting", "fanuc-8.9"},
    {"G11", S::kDataEnd, kAll, {0, 0, 0}, "end of data setting", "fanuc-8.9"},
    {"G52", S::kLocalShift, kAll, {0, 0, 0}, "local coordinate shift", "fanuc-8.4"},
    {"G92", S::kPreset, kMills | kB | kC | kM, {0, 0, 0}, "preset of coordinates, speed limit", "fanuc-8.4"},
    {"G50", S::kPreset, kA | kT, {0, 0, 0}, "preset of coordinates, speed limit", "fanuc-8.4"},
    {"G92.1", S::kPresetReset, kMills | kB | kC, {0, 0, 0}, "preset of work coordinates", "fanuc-8.1"},
    {"G50.3", S::kPresetReset, kA, {0, 0, 0}, "preset of work coordinates", "fanuc-8.1"},
    {"G54.1", S::kExtendedOffset, kAll, {14, 14, 12}, "extended work offset", "fanuc-8.4"},
    {"G154", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset (Haas)", kHaasRule},

    {"G16", S::kPolarOn, kMills | kM, {17, 0, 18}, "polar words", "fanuc-8.5"},
    {"G15", S::kPolarOff, kMills | kM, {17, 0, 18}, "polar words off", "fanuc-8.5"},
    {"G122", S::kPolarOn, kT, {0, 0, 18}, "polar words", "mazak-lathe-2.2"},
    {"G123", S::kPolarOff, kT, {0, 0, 18}, "polar words off", "mazak-lathe-2.2"},
    {"G68", S::kRotationOn, kMills | kM, {16, 0, 16}, "coordinate rotation", "fanuc-8.5"},
    {"G69", S::kRotationOff, kMills | kM, {16, 0, 16}, "coordinate rotation off", "fanuc-8.5"},
    {"G51", S::kScalingOn, kMills | kM, {11, 0, 11}, "scaling", "fanuc-8.6"},
    {"G50", S::kScalingOff, kMills | kM, {11, 0, 11}, "scaling off", "fanuc-8.6"},
    {"G51.1", S::kMirrorOn, kMills | kM, {22, 0, 19}, "mirror", "fanuc-8.6"},
    {"G50.1", S::kMirrorOff, kMills | kM, {22, 0, 19}, "mirror off", "fanuc-8.6"},

    {"G7.1", S::kCylinder, kAll, {0, 0, 0}, "cylindrical interpolation", "fanuc-8.1"},
    {"G107", S::kCylinder, kMills | kLathes, {0, 0, 0}, "cylindrical interpolation", "fanuc-8.1"},
    {"G12.1", S::kPolarMillingOn, kAll, {21, 21, 26}, "polar interpolation", "fanuc-8.1"},
    {"G13.1", S::kPolarMillingOff, kAll, {21, 21, 26}, "polar interpolation off", "fanuc-8.1"},
    {"G112", S::kPolarMillingOn, kMills | kLathes, {21, 21, 0}, "polar interpolation", "fanuc-8.1"},
    {"G113", S::kPolarMillingOff, kMills | kLathes, {21, 21, 0}, "polar interpolation off", "fanuc-8.1"},
    {"G10.9", S::kDiameterSwitch, kM, {0, 0, 0}, "diameter or radius of X", "mazak-lathe-3.2"},
    {"G122.1", S::kRadiusOn, kMazak, {0, 0, 0}, "X as radius", "mazak-lathe-3.2"},
    {"G123.1", S::kRadiusOff, kMazak, {0, 0, 0}, "X as diameter", "mazak-lathe-3.2"},
    {"G53.5", S::kMazatrolOn, kMazak, {0, 0, 0}, "MAZATROL coordinate system", "mazak-lathe-3.4"},
    {"G52.5", S::kMazatrolOff, kMazak, {0, 0, 0}, "MAZATROL coordinate system off", "mazak-lathe-3.4"},

    {"G65", S::kMacroCall, kAll, {0, 0, 0}, "macro call", "fanuc-7.3"},
    {"G66", S::kModalMacro, kAll, {12, 12, 14}, "modal macro call", "fanuc-7.4"},
    {"G66.1", S::kModalMacroEachBlock, kAll, {12, 12, 14}, "modal macro call at every block", "fanuc-7.4"},
    {"G67", S::kModalMacroEnd, kAll, {12, 12, 14}, "modal macro call off", "fanuc-7.4"},
    {"M98", S::kSubprogram, kAll, {0, 0, 0}, "subprogram call", "fanuc-7.2"},
    {"M198", S::kExternalSubprogram, kMills | kLathes, {0, 0, 0}, "call of an external program", "fanuc-7.2"},
    {"M97", S::kLocalSubprogram, kMills | kA, {0, 0, 0}, "call of a block number (Haas)", "fanuc-13"},
    {"M99", S::kReturn, kAll, {0, 0, 0}, "return", "fanuc-6.6"},
    {"G80", S::kCycleEnd, kAll, {9, 10, 9}, "end of cycle", "fanuc-8.7"},

    {"G5", S::kQuietAlone, kAll, {0, 0, 0}, "high-speed mode", "fanuc-8.1"},
    {"G5.1", S::kQuietAlone, kAll, {0, 0, 0}, "high-speed mode", "fanuc-8.1"},
    {"G8", S::kQuietAlone, kAll, {0, 0, 0}, "high-speed mode", "fanuc-8.1"},
    {"G22", S::kStrokeCheck, kAll, {4, 9, 4}, "stroke check", "fanuc-8.1"},
    {"G23", S::kQuiet, kAll, {4, 9, 4}, "stroke check off", "fanuc-8.1"},
    {"G25", S::kQuiet, kMills | kLathes, {19, 8, 0}, "spindle fluctuation check", "fanuc-8.1"},
    {"G26", S::kQuiet, kMills | kLathes, {19, 8, 0}, "spindle fluctuation check", "fanuc-8.1"},
    {"G103", S::kQuietAlone, kMills | kA, {0, 0, 0}, "look-ahead limit (Haas)", "fanuc-13"},
    {"M29", S::kRigidTaps, kMills | kLathes, {0, 0, 0}, "rigid tapping", "fanuc-8.7"},

    {"G2.2", S::kRefused, kMills, {1, 0, 0}, "involute", "fanuc-8.3"},
    {"G3.2", S::kRefused, kMills, {1, 0, 0}, "involute", "fanuc-8.3"},
    {"G2.3", S::kRefused, kMills, {1, 0, 0}, "exponential interpolation", "fanuc-8.3"},
    {"G6.2", S::kRefused, kMills, {1, 0, 0}, "NURBS interpolation", "fanuc-8.3"},
    {"G12", S::kRefused, kMills | kM, {0, 0, 0}, "circle milling", "mazak-lathe-2.2"},
    {"G13", S::kRefused, kMills | kM, {0, 0, 0}, "circle milling", "mazak-lathe-2.2"},
    {"G27", S::kRefused, kMills | kLathes, {0, 0, 0}, "reference return check", "fanuc-8.1"},
    {"G30.1", S::kRefused, kT, {0, 0, 0}, "floating reference point", "mazak-lathe-2.2"},
    {"G36", S::kRefused, kLathes | kM, {0, 0, 0}, "tool measuring, hole pattern", "fanuc-8.1"},
    {"G37", S::kRefused, kMills | kLathes, {0, 0, 0}, "tool measuring", "fanuc-8.1"},
    {"G43.1", S::kRefused, kM, {8, 0, 8}, "tool length along the tool axis", "mazak-lathe-2.2"},
    {"G43.4", S::kRefused, kMills | kM, {8, 0, 8}, "tool tip control", "fanuc-12.1"},
    {"G45", S::kRefused, kMills, {0, 0, 0}, "tool offset increase", "fanuc-8.1"},
    {"G46", S::kRefused, kMills, {0, 0, 0}, "tool offset decrease", "fanuc-8.1"},
    {"G47", S::kRefused, kMills, {0, 0, 0}, "tool offset double increase", "fanuc-8.1"},
    {"G48", S::kRefused, kMills, {0, 0, 0}, "tool offset double decrease", "fanuc-8.1"},
    {"G50.2", S::kRefused, kAll, {0, 20, 23}, "polygon turning", "fanuc-8.1"},
    {"G51.2", S::kRefused, kAll, {0, 20, 23}, "polygon turning", "fanuc-8.1"},
    {"G53.1", S::kRefused, kMills | kM, {0, 0, 0}, "tool axis direction", "fanuc-8.1"},
    {"G54.2", S::kRefused, kMills, {0, 0, 0}, "dynamic work offset", "fanuc-12.1"},
    {"G54.4", S::kRefused, kMills, {0, 0, 0}, "workpiece setting error", "fanuc-12.1"},
    {"G61.2", S::kRefused, kM, {0, 0, 13}, "spline", "mazak-lathe-2.2"},
    {"G68", S::kRefused, kLathes, {0, 4, 0}, "double turret mirror", "fanuc-8.1"},
    {"G69", S::kRefused, kLathes, {0, 4, 0}, "double turret mirror off", "fanuc-8.1"},
    {"G68.2", S::kRefused, kMills | kLathes | kM, {16, 0, 16}, "tilted plane", "fanuc-8.1"},
    {"G68.5", S::kRefused, kT, {0, 0, 16}, "rotation in space", "mazak-lathe-2.2"},
    {"G69.5", S::kRefused, kT, {0, 0, 16}, "rotation in space off", "mazak-lathe-2.2"},
    {"G109", S::kRefused, kMazak, {0, 0, 0}, "program for several systems", "mazak-lathe-2.2"},
    {"G110", S::kRefused, kMazak, {0, 0, 20}, "axis of the other system", "mazak-lathe-2.2"},
    {"G111", S::kRefused, kMazak, {0, 0, 20}, "axis of the other system off", "mazak-lathe-2.2"},
    {"G112", S::kRefused, kMazak, {0, 0, 0}, "M S T B for the other system", "mazak-lathe-2.3"},
    {"G113", S::kRefused, kMazak, {0, 0, 0}, "hobbing off", "mazak-lathe-2.3"},
    {"G114.3", S::kRefused, kMazak, {0, 0, 0}, "hobbing", "mazak-lathe-2.3"},
    {"G70", S::kRefusedByHaas, kMills, {0, 0, 0}, "bolt circle", "fanuc-13"},
    {"G71", S::kRefusedByHaas, kMills, {0, 0, 0}, "bolt arc", "fanuc-13"},
    {"G72", S::kRefusedByHaas, kMills, {0, 0, 0}, "bolt holes on a line", "fanuc-13"},
    {"G150", S::kRefusedByHaas, kMills, {0, 0, 0}, "pocket", "fanuc-13"},
    {"G187", S::kRefusedByHaas, kMills | kA, {0, 0, 0}, "smoothness", "fanuc-13"},
    {"G117", S::kRefused, kMills | kMazak, {0, 0, 0}, "M functions during motion", "mazak-lathe-2.3"},
    {"G118", S::kRefused, kMazak, {0, 0, 0}, "M functions during motion", "mazak-lathe-2.3"},
    // The first twenty extended offsets by a number of their own: both name #7001 and up (fanuc-9.9). G112 and G113,
    // polar interpolation on lathes, and G117 of mills stay refused.
    {"G110", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 1 (Haas)", kHaasRule},
    {"G111", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 2 (Haas)", kHaasRule},
    {"G114", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 5 (Haas)", kHaasRule},
    {"G115", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 6 (Haas)", kHaasRule},
    {"G116", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 7 (Haas)", kHaasRule},
    {"G117", S::kExtendedOffset, kA, {14, 14, 0}, "extended work offset 8 (Haas)", kHaasRule},
    {"G118", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 9 (Haas)", kHaasRule},
    {"G119", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 10 (Haas)", kHaasRule},
    {"G120", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 11 (Haas)", kHaasRule},
    {"G121", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 12 (Haas)", kHaasRule},
    {"G122", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 13 (Haas)", kHaasRule},
    {"G123", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 14 (Haas)", kHaasRule},
    {"G124", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 15 (Haas)", kHaasRule},
    {"G125", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 16 (Haas)", kHaasRule},
    {"G126", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 17 (Haas)", kHaasRule},
    {"G127", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 18 (Haas)", kHaasRule},
    {"G128", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 19 (Haas)", kHaasRule},
    {"G129", S::kExtendedOffset, kMills | kA, {14, 14, 0}, "extended work offset 20 (Haas)", kHaasRule},
};

using Y = ir::Cycle;
using K = CycleKind;

constexpr CycleRow kCycles[] = {
    // fanuc-8.7: on mills along the axis normal to the plane.
    {"G73", Y::kPeckChip, K::kDrill, kMills | kM, "RQFK", "peck drilling with chip breaking", "fanuc-8.7"},
    {"G74", Y::kTapLeft, K::kDrill, kMills | kM, "RPFKQ", "left-hand tapping", "fanuc-8.7"},
    {"G76", Y::kFineBore, K::kDrill, kMills | kM, "RQPFK", "fine boring", "fanuc-8.7"},
    {"G81", Y::kDrill, K::kDrill, kMills | kM, "RFK", "drilling", "fanuc-8.7"},
    {"G82", Y::kDrillDwell, K::kDrill, kMills | kM, "RPFK", "drilling with dwell", "fanuc-8.7"},
    {"G83", Y::kPeck, K::kDrill, kMills | kM, "RQFK", "peck drilling", "fanuc-8.7"},
    {"G84", Y::kTap, K::kDrill, kMills | kM, "RPFKQ", "tapping", "fanuc-8.7"},
    {"G84.2", Y::kRigidTap, K::kDrill, kMills | kM, "RPFK", "rigid tapping", "fanuc-8.7"},
    {"G84.3", Y::kRigidTapLeft, K::kDrill, kMills | kM, "RPFK", "rigid left-hand tapping", "fanuc-8.7"},
    {"G85", Y::kBoreFeed, K::kDrill, kMills | kM, "RFK", "boring, feed out", "fanuc-8.7"},
    {"G86", Y::kBoreStop, K::kDrill, kMills | kM, "RFK", "boring, spindle stop", "fanuc-8.7"},
    {"G87", Y::kBackBore, K::kDrill, kMills | kM, "RQPFK", "back boring", "fanuc-8.7"},
    {"G88", Y::kBoreManual, K::kDrill, kMills | kM, "RPFK", "boring, manual retract", "fanuc-8.7"},
    {"G89", Y::kBoreDwell, K::kDrill, kMills | kM, "RPFK", "boring with dwell", "fanuc-8.7"},
    // Lathes: face cycles along Z, cross cycles along X.
    {"G83", Y::kFacePeck, K::kDrill, kLathes | kT, "RQPFKM", "face drilling", "fanuc-8.7"},
    {"G84", Y::kFaceTap, K::kDrill, kLathes | kT, "RPFKM", "face tapping", "fanuc-8.7"},
    {"G84.2", Y::kFaceRigidTap, K::kDrill, kT, "RPFKM", "rigid face tapping", "mazak-lathe-2.2"},
    {"G85", Y::kFaceBore, K::kDrill, kLathes | kT, "RPFKM", "face boring", "fanuc-8.7"},
    {"G87", Y::kCrossPeck, K::kDrill, kLathes | kT, "RQPFKM", "cross drilling", "fanuc-8.7"},
    {"G88", Y::kCrossTap, K::kDrill, kLathes | kT, "RPFKM", "cross tapping", "fanuc-8.7"},
    {"G88.2", Y::kCrossRigidTap, K::kDrill, kT, "RPFKM", "rigid cross tapping", "mazak-lathe-2.2"},
    {"G89", Y::kCrossBore, K::kDrill, kLathes | kT, "RPFKM", "cross boring", "fanuc-8.7"},
    {"G283", Y::kFacePeck, K::kDrill, kM, "RQPFKM", "face drilling", "mazak-lathe-2.2"},
    {"G284", Y::kFaceTap, K::kDrill, kM, "RPFKM", "face tapping", "mazak-lathe-2.2"},
    {"G284.2", Y::kFaceRigidTap, K::kDrill, kM, "RPFKM", "rigid face tapping", "mazak-lathe-2.2"},
    {"G285", Y::kFaceBore, K::kDrill, kM, "RPFKM", "face boring", "mazak-lathe-2.2"},
    {"G287", Y::kCrossPeck, K::kDrill, kM, "RQPFKM", "cross drilling", "mazak-lathe-2.2"},
    {"G288", Y::kCrossTap, K::kDrill, kM, "RPFKM", "cross tapping", "mazak-lathe-2.2"},
    {"G288.2", Y::kCrossRigidTap, K::kDrill, kM, "RPFKM", "rigid cross tapping", "mazak-lathe-2.2"},
    {"G289", Y::kCrossBore, K::kDrill, kM, "RPFKM", "cross boring", "mazak-lathe-2.2"},
    // fanuc-8.8, names by system.
    {"G90", Y::kTurn, K::kTurningSingle, kA | kT, "RFI", "turning cycle", "fanuc-8.8"},
    {"G77", Y::kTurn, K::kTurningSingle, kB, "RFI", "turning cycle", "fanuc-8.8"},
    {"G20", Y::kTurn, K::kTurningSingle, kC, "RFI", "turning cycle", "fanuc-8.8"},
    {"G290", Y::kTurn, K::kTurningSingle, kM, "RF", "turning cycle", "mazak-lathe-2.2"},
    {"G92", Y::kTurnThread, K::kTurningSingle, kA | kT, "RFQI", "threading cycle", "fanuc-8.8"},
    {"G78", Y::kTurnThread, K::kTurningSingle, kB, "RFQI", "threading cycle", "fanuc-8.8"},
    {"G21", Y::kTurnThread, K::kTurningSingle, kC, "RFQI", "threading cycle", "fanuc-8.8"},
    {"G292", Y::kTurnThread, K::kTurningSingle, kM, "RF", "threading cycle", "mazak-lathe-2.2"},
    {"G94", Y::kTurnFace, K::kTurningSingle, kA | kT, "RFK", "facing cycle", "fanuc-8.8"},
    {"G79", Y::kTurnFace, K::kTurningSingle, kB, "RFK", "facing cycle", "fanuc-8.8"},
    {"G24", Y::kTurnFace, K::kTurningSingle, kC, "RFK", "facing cycle", "fanuc-8.8"},
    {"G294", Y::kTurnFace, K::kTurningSingle, kM, "RF", "facing cycle", "mazak-lathe-2.2"},
    {"G70", Y::kFinish, K::kRepetitive, kA | kB | kT, "PQFST", "finishing", "fanuc-8.8"},
    {"G72", Y::kFinish, K::kRepetitive, kC, "PQFST", "finishing", "fanuc-8.8"},
    {"G270", Y::kFinish, K::kRepetitive, kM, "APQ", "finishing", "mazak-lathe-2.5"},
    {"G71", Y::kRoughTurn, K::kRepetitive, kA | kB | kT, "PQUWRDIKFST", "rough turning", "fanuc-8.8"},
    {"G73", Y::kRoughTurn, K::kRepetitive, kC, "PQUWRDIKFST", "rough turning", "fanuc-8.8"},
    {"G271", Y::kRoughTurn, K::kRepetitive, kM, "APQUWRFST", "rough turning", "mazak-lathe-2.5"},
    {"G72", Y::kRoughFace, K::kRepetitive, kA | kB | kT, "PQUWRDIKFST", "rough facing", "fanuc-8.8"},
    {"G74", Y::kRoughFace, K::kRepetitive, kC, "PQUWRDIKFST", "rough facing", "fanuc-8.8"},
    {"G272", Y::kRoughFace, K::kRepetitive, kM, "APQUWRFST", "rough facing", "mazak-lathe-2.5"},
    {"G73", Y::kPattern, K::kRepetitive, kA | kB | kT, "PQUWRDIKFST", "pattern repeating", "fanuc-8.8"},
    {"G75", Y::kPattern, K::kRepetitive, kC, "PQUWRDIKFST", "pattern repeating", "fanuc-8.8"},
    {"G273", Y::kPattern, K::kRepetitive, kM, "PQUWRFST", "pattern repeating", "mazak-lathe-2.5"},
    {"G74", Y::kFaceGroove, K::kRepetitive, kA | kB | kT, "PQRDIKF", "face grooving and drilling", "fanuc-8.8"},
    {"G76", Y::kFaceGroove, K::kRepetitive, kC, "PQRDIKF", "face grooving and drilling", "fanuc-8.8"},
    {"G274", Y::kFaceGroove, K::kRepetitive, kM, "PQRF", "face grooving and drilling", "mazak-lathe-2.5"},
    {"G75", Y::kGroove, K::kRepetitive, kA | kB | kT, "PQRDIKF", "grooving", "fanuc-8.8"},
    {"G77", Y::kGroove, K::kRepetitive, kC, "PQRDIKF", "grooving", "fanuc-8.8"},
    {"G275", Y::kGroove, K::kRepetitive, kM, "PQRF", "grooving", "mazak-lathe-2.5"},
    {"G76", Y::kMultiThread, K::kRepetitive, kA | kB | kT, "PQRDIKAF", "thread in several passes", "fanuc-8.8"},
    {"G78", Y::kMultiThread, K::kRepetitive, kC, "PQRDIKAF", "thread in several passes", "fanuc-8.8"},
    {"G276", Y::kMultiThread, K::kRepetitive, kM, "PQRF", "thread in several passes", "mazak-lathe-2.5"},
};

}  // namespace

std::span<const SpecialRow> SpecialCodes() { return kSpecials; }

const SpecialRow* FindSpecial(System system, std::string_view text) {
  const auto row = std::ranges::find_if(kSpecials, [&](const SpecialRow& candidate) {
    return (candidate.systems & Bit(system)) != 0 && candidate.text == text;
  });
  return row == std::end(kSpecials) ? nullptr : row;
}

std::string_view TextOf(System system, Special special) {
  const auto row = std::ranges::find_if(kSpecials, [&](const SpecialRow& candidate) {
    return (candidate.systems & Bit(system)) != 0 && candidate.special == special;
  });
  return row == std::end(kSpecials) ? std::string_view{} : row->text;
}

std::span<const CycleRow> Cycles() { return kCycles; }

const CycleRow* FindCycle(System system, std::string_view text) {
  const auto row = std::ranges::find_if(kCycles, [&](const CycleRow& candidate) {
    return (candidate.systems & Bit(system)) != 0 && candidate.text == text;
  });
  return row == std::end(kCycles) ? nullptr : row;
}

}  // namespace ncport::dialects::fanuc
