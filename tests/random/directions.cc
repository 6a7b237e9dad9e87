#include "tests/random/checks.h"
#include "tests/random/direction_checks.h"

namespace ncport::tests::random {

namespace {

// What FANUC controls have no form for, or what nobody knows where it would be needed:
//   computed-radius, blind-step: words are rounded there, and an increment needs a position;
//   edge-before-change: D before M6 names the edge of the old tool;
//   dwell-revolutions, tap, spindle-position, aux-h, fixed-point: no word with the same meaning;
//   block-range, arc-tangent, feed-once: one word of the source that stands for others;
//   chamfer: the points of a corner carry the rounding of the size and of the side: more than one word's;
//   computed-axis, text-functions, assign-list, computed-target: variables hold numbers only;
//   system-variables, shown-alarm, inert: not among the listed losses (contracts section 3);
//   surface-speed-at-end: the end of some machines freezes it, and its diameter may not be known.
// clang-format off
#define NCPORT_NO_FANUC \
  "computed-radius=0,blind-step=0,edge-before-change=0," \
  "dwell-revolutions=0,tap=0,spindle-position=0,aux-h=0,fixed-point=0," \
  "block-range=0,arc-tangent=0,feed-once=0,chamfer=0," \
  "computed-axis=0,text-functions=0,assign-list=0,computed-target=0," \
  "system-variables=0,shown-alarm=0,inert=0,surface-speed-at-end=0,"
// Often without one value there: each has a share of the tenth that may be refused.
#define NCPORT_SELDOM_FANUC \
  "frame=1,tool=1,units=1,feed-mode=1,save-modes=3,fractional-speed=1,feed-across-thread=2,thread-variable=1," \
  "repeat-part=1,passes=1,modal-call=1,computed-tool=0,frame-turns=0,turns=1,arc-via=1,polar=1," \
  "arc-angle=1,reference=1,reference-parameter=5,computed-shape=0,open-speed-mode=1,skip-level=2," \
  "hole-cycle=1,cycle-values=3,cycle-feed=10,distance=2"
// clang-format on
// A tool fixes the plane, since its length lies along Z (first line); other planes come without tools (second line).
constexpr std::string_view kWithTools = NCPORT_NO_FANUC NCPORT_SELDOM_FANUC ",plane=0,frame=0,modal-call=0";
constexpr std::string_view kWithoutTools =
    NCPORT_NO_FANUC NCPORT_SELDOM_FANUC ",tool=0,cutter-comp=0,value-modes=10,reference=0";
#undef NCPORT_SELDOM_FANUC
// What has no way back: what a computed number or a unit stands for must be known there, and bits, indices and blocks
// that may be skipped ask for values that are never empty. Labels that jumps skip to and conditions that are always
// true leave code that no way reaches, where neither is known.
// clang-format off
#define NCPORT_NO_WAY_BACK \
  "tool=1,passes=0,units=0,bit-operations=0,computed-index=0,skip-level=0,surface-speed=0,feed-mode=0,plain-jump=0," \
  "plain-truth=0," \
  "repeat-part=0,feed-across-thread=0,turns=0,thread-variable=0,modal-call=0,computed-tool=0,fractional-speed=0," \
  "frame-turns=0,open-speed-mode=0,save-modes=0,return-to-label=0,call-by-text=0,arc-via=0,polar=0,chamfer=0," \
  "arc-angle=0,reference=0,reference-parameter=0"
// clang-format on
constexpr std::string_view kBackWithTools = NCPORT_NO_FANUC NCPORT_NO_WAY_BACK ",plane=0,frame=0";
constexpr std::string_view kBackWithoutTools = NCPORT_NO_FANUC NCPORT_NO_WAY_BACK ",tool=0,cutter-comp=0";
#undef NCPORT_NO_WAY_BACK
#undef NCPORT_NO_FANUC
// These are refused so often that they would hide what else happens: modal calls and repeated macro calls beside
// subprograms that share locals, and changes of the spindle mode, which choose the feed's unit there (sinumerik-8.1).
#define NCPORT_GENERATED \
  "surface-speed=0,modal-call=0,passes=0,drilling-polar=10,drilling-by-hand=1,drilling-count=5,shifted-axes=3"
constexpr std::string_view kGenerated = NCPORT_GENERATED;
// What a computed word is rounded to hangs on the unit: half of the programs have one only.
constexpr std::string_view kGeneratedInOneUnit = NCPORT_GENERATED ",units=0";
#undef NCPORT_GENERATED
// What literal blocks have no word for.
constexpr std::string_view kNotFlat =
    "tap=0,machine-coords=0,reference=0,spindle-position=0,aux-h=0,thread-variable=0,thread-start=0,"
    "dwell-revolutions=0,shown-alarm=100";

constexpr Direction kDirections[] = {
    {.name = "ir",
     .title = "the program as IR: verified, dumped and read back, run twice",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckIr},
    {.name = "sinumerik",
     .title = "SINUMERIK text: printed, read back, run",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckText},
    {.name = "sinumerik-to-fanuc",
     .title = "SINUMERIK to FANUC, compared by running both",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckTranslation,
     .target_mill = "fanuc-mill",
     .target_lathe = "fanuc-lathe-a",
     .without = {kWithTools, kWithoutTools}},
    {.name = "sinumerik-to-mazak",
     .title = "SINUMERIK to Mazak, compared by running both",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckTranslation,
     .target_mill = "mazak-mill",
     .target_lathe = "mazak-qtn",
     .without = {kWithTools, kWithoutTools}},
    {.name = "fanuc",
     .title = "FANUC text: printed, read back, run",
     .flavour = Flavour::kFanuc,
     .mill = "fanuc-mill",
     .lathe = "fanuc-lathe-a",
     .check = CheckText},
    {.name = "fanuc-to-sinumerik",
     .title = "FANUC to SINUMERIK, compared by running both",
     .flavour = Flavour::kFanuc,
     .mill = "fanuc-mill",
     .lathe = "fanuc-lathe-a",
     .check = CheckTranslation,
     .target_mill = "sinumerik-840d-mill",
     .target_lathe = "sinumerik-840d-lathe",
     .without = {kGenerated, kGeneratedInOneUnit}},
    {.name = "fanuc-and-back",
     .title = "the FANUC program that a SINUMERIK one became, to SINUMERIK, compared by running both",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckTranslationBack,
     .target_mill = "fanuc-mill",
     .target_lathe = "fanuc-lathe-a",
     .without = {kBackWithTools, kBackWithoutTools}},
    {.name = "flat",
     .title = "SINUMERIK flattened: the flat blocks read back and run",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckFlat,
     .target_mill = "iso-mill",
     .target_lathe = "iso-lathe",
     .without = {kNotFlat, kNotFlat}},
    {.name = "check",
     .title = "alarms of runs with changed values: all announced by check",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckAnnounced},
};

}  // namespace

std::span<const Direction> Directions() { return kDirections; }

const Direction* FindDirection(std::string_view name) {
  for (const Direction& direction : kDirections) {
    if (direction.name == name) return &direction;
  }
  return nullptr;
}

}  // namespace ncport::tests::random
