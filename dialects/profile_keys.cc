// Over 300 lines because it is one table: splitting it would tear keys of one page apart.
#include "dialects/profile_keys.h"

#include <fmt/format.h>

#include "dialects/modal_names.h"

namespace ncport::dialects {
namespace {

template <class T>
void SetEnum(Setting<T>& setting, std::uint8_t value) {
  setting.Set(static_cast<T>(value));
}

#define NCPORT_GET(member)          \
  +[](Profile & profile) -> auto& { \
    return profile.member;          \
  }
#define NCPORT_CHOICE(names, member)                                                     \
  ChoiceKey {                                                                            \
    names, [](Profile& profile, std::uint8_t value) { SetEnum(profile.member, value); }, \
        [](Profile& profile) { profile.member.Ask(); },                                  \
        [](Profile& profile, std::string_view key) { profile.member.SetKey(key); }       \
  }

constexpr std::string_view kLanguageNames[] = {"sinumerik", "fanuc", "num", "linuxcnc", "iso"};
constexpr std::string_view kMachines[] = {"mill", "lathe"};
constexpr std::string_view kSeries[] = {"none", "A", "B", "C", "M", "T"};
constexpr std::string_view kClasses[] = {"none", "qt", "ix-old", "ix-new"};
constexpr std::string_view kDiameters[] = {"no", "yes", "modal"};
constexpr std::string_view kUnits[] = {"mm", "inch"};
constexpr std::string_view kPoints[] = {"increment", "calculator"};
constexpr std::string_view kWordErrors[] = {"none", "round", "truncate"};
constexpr std::string_view kNumericModels[] = {"binary64", "decimal8", "num8"};
constexpr std::string_view kRapids[] = {"unknown", "straight", "dogleg"};
constexpr std::string_view kNameStarts[] = {"letter", "two-letters"};
constexpr std::string_view kProgramForms[] = {"name", "o-number", "percent-number", "file-name", "none"};
constexpr std::string_view kLabelForms[] = {"names", "numbers", "names-and-numbers", "none"};
constexpr std::string_view kVariants[] = {"fanuc", "mazak", "haas"};
constexpr std::string_view kDwells[] = {"time", "revolutions"};
constexpr std::string_view kCornerWords[] = {"comma", "plain"};
constexpr std::string_view kAtanRanges[] = {"positive", "signed"};
constexpr std::string_view kLogics[] = {"bits", "conditions"};
constexpr std::string_view kCalls[] = {"packed", "repeat-word"};
constexpr std::string_view kLengthWords[] = {"none", "G43H", "G43P1"};
constexpr std::string_view kRetractOrders[] = {"x-then-z", "z-then-x"};
constexpr std::string_view kWorkZeros[] = {"G54", "G53.5"};
constexpr std::string_view kFeedSpindles[] = {"turning", "milling"};
constexpr std::string_view kFamilies[] = {"840d", "802d", "802s"};
constexpr std::string_view kRotationOrders[] = {"rpy", "euler"};
constexpr std::string_view kCornerFeeds[] = {"next", "own"};
constexpr std::string_view kToolChanges[] = {"t", "m6"};
constexpr std::string_view kArcs[] = {"center", "radius"};

constexpr double kNoLimit = 1e9;

#define NCPORT_SPINDLE(path, member, who)                                                                            \
  {path ".cw", "word that turns " who " clockwise, as M3 does; empty: it has none", TextKey{NCPORT_GET(member.cw)}}, \
      {path ".ccw", "word that turns " who " counter-clockwise", TextKey{NCPORT_GET(member.ccw)}},                   \
      {path ".stop", "word that stops " who, TextKey{NCPORT_GET(member.stop)}},                                      \
      {path ".css", "words for constant surface speed of " who ", m/min or ft/min",                                  \
       TextKey{NCPORT_GET(member.css), true, "speed"}},                                                              \
      {path ".rpm", "words for the speed of " who ", 1/min", TextKey{NCPORT_GET(member.rpm), true, "speed"}},        \
      {path ".limit", "words for the largest speed of " who " under constant surface speed, 1/min",                  \
       TextKey{NCPORT_GET(member.limit), true, "speed"}},                                                            \
  {                                                                                                                  \
    path ".r-word", "added to the three; empty: none", TextKey { NCPORT_GET(member.r_word) }                         \
  }

constexpr KeyRow kRows[] = {
    {"inherits", "profile whose keys hold where this one has none", SpecialKey::kInherits},
    {"language", "grammar and semantics",
     ChoiceKey{kLanguageNames,
               [](Profile& profile, std::uint8_t value) { profile.language = static_cast<Language>(value); }, nullptr,
               nullptr}},
    {"machine", "which table of words holds",
     ChoiceKey{kMachines,
               [](Profile& profile, std::uint8_t value) { profile.machine = static_cast<MachineKind>(value); }, nullptr,
               nullptr}},
    {"series", "G-code system: A, B, C of Fanuc lathes; M, T of Mazak", NCPORT_CHOICE(kSeries, series)},
    {"class", "machine family where the same words differ (Mazak: which spindle M3 is)",
     NCPORT_CHOICE(kClasses, machine_class)},
    {"axes", "axes in the machine's order, which is also the order of position variables", SpecialKey::kAxes},
    {"diameter", "words of the transverse axis are diameters; modal: the program says",
     NCPORT_CHOICE(kDiameters, diameter)},
    {"units", "unit of lengths in output and at program start", NCPORT_CHOICE(kUnits, units)},
    {"increment", "least input increment, mm and degrees", NumberKey{NCPORT_GET(increment), 1e-6, 1}},
    {"point", "a length without decimal point counts increments, or is mm (inch) and degrees",
     NCPORT_CHOICE(kPoints, point)},
    {"decimals", "decimals of computed lengths in output", IntegerKey{NCPORT_GET(decimals), 0, 9}},
    {"word-error", "what happens to a computed value on its way to an axis; none: it moves unrounded",
     NCPORT_CHOICE(kWordErrors, word_error)},
    {"numeric-model", "each result as it is, rounded to 8 significant digits, or by the rule NUM-10 of NUM",
     NCPORT_CHOICE(kNumericModels, numeric_model)},
    {"start", "modal state at program start; a group left out is unknown", SpecialKey::kStart},
    {"rapid", "path of a rapid move of several axes", NCPORT_CHOICE(kRapids, rapid)},
    {"skip", "level of a / without a number", IntegerKey{NCPORT_GET(skip), 0, 9}},
    {"variables",
     "list of spaces: name, range, type (int | real | number), lifetime (call | program | kept), visibility (level | "
     "program | "
     "all), start (zero | vacant | kept | unknown), reserved (list of ranges that translated programs keep out of). "
     "Spaces "
     "replace inherited ones that they touch",
     SpecialKey::kVariables},

    {"names.max-length", "longest name of a variable; 0: no named variables",
     IntegerKey{NCPORT_GET(names.max_length), 0, 1000}},
    {"names.first", "how a name begins; two-letters: two letters or underscores",
     NCPORT_CHOICE(kNameStarts, names.first)},
    {"names.labels", "longest jump label; 0: no label names", IntegerKey{NCPORT_GET(names.labels), 0, 1000}},
    {"names.label-form", "what a jump may name", NCPORT_CHOICE(kLabelForms, names.label_form)},
    {"names.programs", "longest program name, or most digits of a program number",
     IntegerKey{NCPORT_GET(names.programs), 0, 1000}},
    {"names.program-form", "how programs are called", NCPORT_CHOICE(kProgramForms, names.program_form)},
    {"names.program-numbers", "numbers of user programs", RangeKey{NCPORT_GET(names.program_numbers), 99999999}},
    {"names.block-numbers", "numbers behind N", RangeKey{NCPORT_GET(names.block_numbers), 999999999}},
    {"names.macro-numbers", "numbers for programs that a translation makes",
     RangeKey{NCPORT_GET(names.macro_numbers), 99999999}},
    {"names.ignore-case", "upper and lower case are the same", FlagKey{NCPORT_GET(names.ignore_case)}},

    {"nesting.call", "called programs inside each other, besides the main program",
     IntegerKey{NCPORT_GET(nesting.call), 0, 1000}},
    {"nesting.macro", "of these, levels with local variables of their own",
     IntegerKey{NCPORT_GET(nesting.macro), 0, 1000}},
    {"nesting.loop", "loops inside each other; 0: no structured loops", IntegerKey{NCPORT_GET(nesting.loop), 0, 1000}},
    {"nesting.brackets", "brackets inside each other in expressions; 0: none",
     IntegerKey{NCPORT_GET(nesting.brackets), 0, 1000}},
    {"nesting.if", "branches inside each other; 0: no branches over several blocks",
     IntegerKey{NCPORT_GET(nesting.branch), 0, 1000}},
    {"block.max-length", "characters of a block", IntegerKey{NCPORT_GET(block.max_length), 1, 100000}},
    {"block.max-m", "M functions in a block", IntegerKey{NCPORT_GET(block.max_m), 0, 100}},
    {"block.max-passes", "largest repeat count of a call", IntegerKey{NCPORT_GET(block.max_passes), 1, 999999999}},

    NCPORT_SPINDLE("spindle", spindle, "the work of a lathe or the tool of a mill"),
    NCPORT_SPINDLE("spindle.second", second_spindle, "the second work spindle"),
    NCPORT_SPINDLE("spindle.live", live_spindle, "the driven tools of a lathe"),

    {"feed.per-minute", "word for feed per minute; empty: none", TextKey{NCPORT_GET(words.feed_per_minute)}},
    {"feed.per-revolution", "word for feed per revolution", TextKey{NCPORT_GET(words.feed_per_revolution)}},
    {"feed.inverse-time", "word for inverse time feed", TextKey{NCPORT_GET(words.feed_inverse_time)}},
    {"distance.absolute", "word for absolute dimensions; empty: none is needed", TextKey{NCPORT_GET(words.absolute)}},
    {"distance.incremental", "word for incremental dimensions; empty: there is none",
     TextKey{NCPORT_GET(words.incremental)}},
    {"distance.axes", "letters of the increments of X Y Z C, in this order; empty: none",
     TextKey{NCPORT_GET(words.incremental_axes)}},
    {"offset.work", "word that selects a work offset", TextKey{NCPORT_GET(words.work_offset), true, "number"}},
    {"offset.work-extended", "word that selects an extended work offset; empty: none",
     TextKey{NCPORT_GET(words.work_offset_extended), true, "number"}},
    {"offset.none", "word that switches the work offset off; empty: none", TextKey{NCPORT_GET(words.work_offset_none)}},
    {"offset.length", "words that switch a tool length on; empty: none",
     TextKey{NCPORT_GET(words.length_offset), true, "number"}},
    {"offset.length-off", "word that switches the tool length off", TextKey{NCPORT_GET(words.length_offset_off)}},
    {"offset.radius", "word for the cutter radius register; empty: none",
     TextKey{NCPORT_GET(words.radius_offset), true, "number"}},
    {"offset.edge", "word for the tool edge with length and radius; empty: none",
     TextKey{NCPORT_GET(words.edge), true, "number"}},
    {"tool", "words of a tool call", TextKey{NCPORT_GET(words.tool), true, "tool offset"}},
    {"words.mm", "word for millimetres; empty: none", TextKey{NCPORT_GET(words.mm)}},
    {"words.inch", "word for inches; empty: none", TextKey{NCPORT_GET(words.inch)}},
    {"words.diameter", "word that makes X a diameter; empty: none", TextKey{NCPORT_GET(words.diameter_on)}},
    {"words.radius", "word that makes X a radius; empty: none", TextKey{NCPORT_GET(words.diameter_off)}},
    {"words.dwell", "words for a dwell in seconds", TextKey{NCPORT_GET(words.dwell), true, "seconds"}},
    {"words.dwell-revolutions", "words for a dwell in spindle revolutions; empty: none",
     TextKey{NCPORT_GET(words.dwell_revolutions), true, "revolutions"}},
    {"words.thread", "word for a thread with constant lead; empty: none", TextKey{NCPORT_GET(words.thread)}},
    {"words.end", "word that ends a main program", TextKey{NCPORT_GET(words.end)}},
    {"words.sub-end", "word that ends a called program; empty: the end of its text does",
     TextKey{NCPORT_GET(words.sub_end)}},
    {"home", "blocks that leave the work before a tool change, in order", TextsKey{NCPORT_GET(words.home)}},
    {"safe-position", "blocks of a position where tools may be changed", TextsKey{NCPORT_GET(words.safe_position)}},
    {"header", "blocks at the start of a main program", TextsKey{NCPORT_GET(words.header)}},
    {"footer", "blocks at the end of a main program, before its end word", TextsKey{NCPORT_GET(words.footer)}},
    {"mcodes",
     "M and H functions and builder G codes that may pass: \"M41\" = \"M41\" passes, \"drop\" leaves it out and lists "
     "it",
     SpecialKey::kMCodes},
    {"scratch", "cells for temporaries of translated programs: [\"#100-#149\"]", SpecialKey::kScratch},

    {"fanuc.variant", "maker of the control", NCPORT_CHOICE(kVariants, fanuc.variant)},
    {"fanuc.control", "model of the control, for the sheet", TextKey{NCPORT_GET(fanuc.control)}},
    {"fanuc.dwell", "G04 under feed per revolution counts time or revolutions (3405#1, Mazak F92.2)",
     NCPORT_CHOICE(kDwells, fanuc.dwell)},
    {"fanuc.corner-words", "corner words with comma (,C ,R ,A) or without (3405#4)",
     NCPORT_CHOICE(kCornerWords, fanuc.corner_words)},
    {"fanuc.supplementary-angle", "drawing angles are written as their supplement (3405#5)",
     FlagKey{NCPORT_GET(fanuc.supplementary_angle)}},
    {"fanuc.circle-tolerance", "largest difference of start and end radius of an arc, mm (3410)",
     NumberKey{NCPORT_GET(fanuc.circle_tolerance), 0, 100}},
    {"fanuc.feed-along-helix", "F of a helix is the speed along it, not along its circle (1403#5)",
     FlagKey{NCPORT_GET(fanuc.feed_along_helix)}},
    {"fanuc.series15-format", "M98 and cycles in Series 15 format (0001#1)",
     FlagKey{NCPORT_GET(fanuc.series15_format)}},
    {"fanuc.g73-back-off", "back-off of G73, mm (5114)", NumberKey{NCPORT_GET(fanuc.g73_back_off), 0, 1000}},
    {"fanuc.g83-clearance", "clearance of G83, mm (5115)", NumberKey{NCPORT_GET(fanuc.g83_clearance), 0, 1000}},
    {"fanuc.thread-run-out", "run-out of G92 and G76, in leads (5130)",
     NumberKey{NCPORT_GET(fanuc.thread_run_out), 0, 99}},
    {"fanuc.rotation-r-by-distance", "R of G68 follows G90 and G91 (5400#0)",
     FlagKey{NCPORT_GET(fanuc.rotation_r_by_distance)}},
    {"fanuc.rotation-default-angle", "angle of G68 without R, degrees (5410)",
     NumberKey{NCPORT_GET(fanuc.rotation_default_angle), -360, 360}},
    {"fanuc.offset-memory-15", "numbering of tool offsets of memory C as on Series 15 (6000#3)",
     FlagKey{NCPORT_GET(fanuc.offset_memory_15)}},
    {"fanuc.print-leading-blanks", "DPRNT prints blanks for leading zeros (6001#1 = 0)",
     FlagKey{NCPORT_GET(fanuc.print_leading_blanks)}},
    {"fanuc.tool-calls-macro", "a T word calls O9000 (6001#5)", FlagKey{NCPORT_GET(fanuc.tool_calls_macro)}},
    {"fanuc.reset-clears-common", "reset makes #100 to #199 vacant (6001#6 = 0, Mazak F87.7)",
     FlagKey{NCPORT_GET(fanuc.reset_clears_common)}},
    {"fanuc.reset-clears-local", "reset makes #1 to #33 vacant (6001#7 = 0, Mazak F87.6)",
     FlagKey{NCPORT_GET(fanuc.reset_clears_local)}},
    {"fanuc.atan-range", "ATAN[]/[] gives 0 to 360 and ASIN 270 to 90, or -180 to 180 and -90 to 90 (6004#0)",
     NCPORT_CHOICE(kAtanRanges, fanuc.atan_range)},
    {"fanuc.call-from-block", "Q of M98 P Q is the first block (6005#0)", FlagKey{NCPORT_GET(fanuc.call_from_block)}},
    {"fanuc.logic", "AND OR XOR act on bits only, or may join conditions (6006#0)",
     NCPORT_CHOICE(kLogics, fanuc.logic)},
    {"fanuc.arguments-to-real", "arguments of G65 are converted to real values (6007#4)",
     FlagKey{NCPORT_GET(fanuc.arguments_to_real)}},
    {"fanuc.alarm-number-as-written", "#3000 = n shows n, not 3000 + n (6008#1)",
     FlagKey{NCPORT_GET(fanuc.alarm_number_as_written)}},
    {"fanuc.arguments-always-first-list", "repeated I J K of G65 overwrite (6008#7)",
     FlagKey{NCPORT_GET(fanuc.arguments_always_first_list)}},
    {"fanuc.calls", "repeats of M98 in the digits of P or as L, in output", NCPORT_CHOICE(kCalls, fanuc.calls)},
    {"fanuc.structured-if", "IF THEN ELSE ENDIF over several blocks is fitted",
     FlagKey{NCPORT_GET(fanuc.structured_if)}},
    {"fanuc.truth-values", "an expression without comparison is a condition, and a condition is a value",
     FlagKey{NCPORT_GET(fanuc.truth_values)}},
    {"fanuc.expression-without-brackets", "a word may hold X#1+10",
     FlagKey{NCPORT_GET(fanuc.expression_without_brackets)}},
    {"fanuc.local-call", "M97 calls a block number of the same program", FlagKey{NCPORT_GET(fanuc.local_call)}},
    {"fanuc.do-numbers", "largest number behind DO", IntegerKey{NCPORT_GET(fanuc.do_numbers), 1, 127}},
    {"fanuc.digits", "most digits of a number in a word", IntegerKey{NCPORT_GET(fanuc.digits), 1, 15}},
    {"fanuc.missing-functions", "functions of the macro language, and G66, that the control lacks",
     TextsKey{NCPORT_GET(fanuc.missing_functions)}},
    {"fanuc.alarms", "values of #3000 for alarms that a translation makes", RangeKey{NCPORT_GET(fanuc.alarms), 4095}},
    {"fanuc.ix-offset", "word for the tool length of a multi-tasking machine in turning",
     NCPORT_CHOICE(kLengthWords, fanuc.length_word)},
    {"fanuc.retract-order", "which axis leaves the work first", NCPORT_CHOICE(kRetractOrders, fanuc.retract_order)},
    {"fanuc.wcs", "work zero on the offset page or in the MAZATROL setup data",
     NCPORT_CHOICE(kWorkZeros, fanuc.work_zero)},
    {"fanuc.feed-spindle", "spindle that feed per revolution refers to",
     NCPORT_CHOICE(kFeedSpindles, fanuc.feed_spindle)},
    {"fanuc.leave-mazatrol", "block that leaves the MAZATROL coordinate system; empty: none is needed",
     TextKey{NCPORT_GET(fanuc.leave_mazatrol)}},
    {"fanuc.b-position",
     "B of the turning position in machine coordinates, as written (\"90.\"); empty: no program turns B, the tool does",
     TextKey{NCPORT_GET(fanuc.b_position)}},
    {"fanuc.b-blocks", "blocks that turn B to {b}, the turning position, after a tool change",
     TextsKey{NCPORT_GET(fanuc.b_blocks)}},
    {"fanuc.safe-z",
     "Z of a safe position in machine coordinates, as written (\"0.\"): {safe-z} of home, header and footer",
     TextKey{NCPORT_GET(fanuc.safe_z)}},
    {"fanuc.c-axis", "the work spindle has a C axis: M202 before turning", FlagKey{NCPORT_GET(fanuc.c_axis)}},
    {"fanuc.o-word", "a program begins with an O word", FlagKey{NCPORT_GET(fanuc.o_word)}},

    {"sinumerik.family", "generation of the control", NCPORT_CHOICE(kFamilies, sinumerik.family)},
    {"sinumerik.main-variables-visible", "variables of the main program are visible in subprograms (MD11120)",
     FlagKey{NCPORT_GET(sinumerik.main_variables_visible)}},
    {"sinumerik.mod-div-round-operands", "MOD and DIV round their operands to INT first",
     FlagKey{NCPORT_GET(sinumerik.mod_div_round_operands)}},
    {"sinumerik.compare-tolerance", "relative difference up to which REAL values are equal",
     NumberKey{NCPORT_GET(sinumerik.compare_tolerance), 0, 1}},
    {"sinumerik.compare-exact-order", "> and < are exact (MD10280 bit 0)",
     FlagKey{NCPORT_GET(sinumerik.compare_exact_order)}},
    {"sinumerik.circle-tolerance", "largest difference of start and end radius of an arc, mm (MD21000)",
     NumberKey{NCPORT_GET(sinumerik.circle_tolerance), 0, 100}},
    {"sinumerik.circle-tolerance-factor", "the same as a part of the radius (MD21010)",
     NumberKey{NCPORT_GET(sinumerik.circle_tolerance_factor), 0, 1}},
    {"sinumerik.rotation-order", "several angles in one ROT (MD10600)",
     NCPORT_CHOICE(kRotationOrders, sinumerik.rotation_order)},
    {"sinumerik.corner-feed", "feed of a chamfer or rounding: of the next block or of its own (MD20201)",
     NCPORT_CHOICE(kCornerFeeds, sinumerik.corner_feed)},
    {"sinumerik.incremental-traverses-frame", "an increment after a frame change also moves the shift (SD42440)",
     FlagKey{NCPORT_GET(sinumerik.incremental_traverses_frame)}},
    {"sinumerik.tool-change", "word that changes the tool (MD22550)",
     NCPORT_CHOICE(kToolChanges, sinumerik.tool_change)},
    {"sinumerik.change-selects-edge", "a tool change selects D1 (MD20270)",
     FlagKey{NCPORT_GET(sinumerik.change_selects_edge)}},
    {"sinumerik.frames-as-diameter", "X of TRANS is a diameter while DIAMON is active (MD20360 bit 3)",
     FlagKey{NCPORT_GET(sinumerik.frames_as_diameter)}},
    {"sinumerik.start-feed", "feed at program start (SD42110); 0: none",
     NumberKey{NCPORT_GET(sinumerik.start_feed), 0, kNoLimit}},
    {"sinumerik.definitions", "DEF and PROC with parameters are fitted", FlagKey{NCPORT_GET(sinumerik.definitions)}},
    {"sinumerik.computed-index", "R[expression] is fitted", FlagKey{NCPORT_GET(sinumerik.computed_index)}},
    {"sinumerik.logic-words", "AND OR XOR NOT are fitted", FlagKey{NCPORT_GET(sinumerik.logic_words)}},
    {"sinumerik.jumps-both-ways", "GOTO, GOTOC, GOTOS and computed targets are fitted",
     FlagKey{NCPORT_GET(sinumerik.jumps_both_ways)}},
    {"sinumerik.assignments-beside-motion", "X=R1 may stand beside other words",
     FlagKey{NCPORT_GET(sinumerik.assignments_beside_motion)}},
    {"sinumerik.modal-call-without-axis", "blocks with F, S or G0 and G1 alone run a modal call",
     FlagKey{NCPORT_GET(sinumerik.modal_call_without_axis)}},
    {"sinumerik.for-end-each-pass", "the end of FOR is evaluated in each pass",
     FlagKey{NCPORT_GET(sinumerik.for_end_each_pass)}},
    {"sinumerik.drill-cycles-keep-codes", "CYCLE81 and CYCLE82 put the caller's G words back",
     FlagKey{NCPORT_GET(sinumerik.drill_cycles_keep_codes)}},

    {"num.internal-linear", "internal unit of linear axes, mm", NumberKey{NCPORT_GET(num.internal_linear), 1e-6, 1}},
    {"num.internal-rotary", "internal unit of rotary axes, degrees",
     NumberKey{NCPORT_GET(num.internal_rotary), 1e-6, 1}},
    {"num.leading-zero-counts", "the 0 of 0.333 is one of the eight digits (NUM-10)",
     FlagKey{NCPORT_GET(num.leading_zero_counts)}},
    {"num.guard-digits", "significant digits to which a result is rounded before it is cut (NUM-10)",
     IntegerKey{NCPORT_GET(num.guard_digits), 9, 17}},
    {"num.circle-tolerance", "largest difference of start and end radius of an arc, mm (NUM-62)",
     NumberKey{NCPORT_GET(num.circle_tolerance), 0, 100}},
    {"num.structured", "IF, WHILE, FOR, REPEAT and VAR are fitted", FlagKey{NCPORT_GET(num.structured)}},
    {"num.end-in-called-ends-all", "M02 in a subprogram ends the main program too (NUM-50)",
     FlagKey{NCPORT_GET(num.end_in_called_ends_all)}},
    {"num.incremental-center-from-start", "I J K count from the start of the arc in G91 (NUM-61)",
     FlagKey{NCPORT_GET(num.incremental_center_from_start)}},

    {"iso.arcs", "arcs with I J K or with R", NCPORT_CHOICE(kArcs, iso.arcs)},
    {"iso.block-number-step", "step of N words; 0: none", IntegerKey{NCPORT_GET(iso.block_number_step), 0, 1000}},
};

struct ValuesVisitor {
  std::string operator()(const TextKey& key) const {
    if (!key.pattern) return "text";
    std::string holes;
    std::string_view rest = key.holes;
    while (!rest.empty()) {
      const std::size_t blank = rest.find(' ');
      holes += fmt::format(" {{{}}}", rest.substr(0, blank));
      rest = blank == std::string_view::npos ? std::string_view{} : rest.substr(blank + 1);
    }
    return "text with" + holes;
  }
  std::string operator()(const TextsKey&) const { return "list of texts"; }
  std::string operator()(const NumberKey& key) const {
    return key.most >= kNoLimit ? fmt::format("{} and more", key.least) : fmt::format("{} .. {}", key.least, key.most);
  }
  std::string operator()(const IntegerKey& key) const { return fmt::format("{} .. {}", key.least, key.most); }
  std::string operator()(const FlagKey&) const { return "yes | no"; }
  std::string operator()(const RangeKey& key) const { return fmt::format("[first, last], 0 .. {}", key.most); }
  std::string operator()(const ChoiceKey& key) const { return fmt::format("{}", fmt::join(key.names, " | ")); }
  std::string operator()(SpecialKey key) const {
    switch (key) {
      case SpecialKey::kInherits:
        return "profile name or path";
      case SpecialKey::kAxes:
        return "list of axis letters";
      case SpecialKey::kStart:
        return "table, or unknown";
      case SpecialKey::kVariables:
        return "list of tables";
      case SpecialKey::kMCodes:
        return "table";
      case SpecialKey::kScratch:
        return "list of ranges";
    }
    return {};
  }
};

}  // namespace

std::span<const KeyRow> ProfileKeys() { return kRows; }

const KeyRow* FindKey(std::string_view path) {
  for (const KeyRow& row : kRows) {
    if (row.path == path) return &row;
  }
  return nullptr;
}

std::optional<Language> LanguageOf(const KeyRow& row) {
  const std::string_view top = row.path.substr(0, row.path.find('.'));
  for (std::size_t i = 0; i < std::size(kLanguageNames); ++i) {
    if (top == kLanguageNames[i]) return static_cast<Language>(i);
  }
  return std::nullopt;
}

bool IsMCode(std::string_view word) {
  if (word.size() < 2 || (word[0] != 'M' && word[0] != 'H' && word[0] != 'G')) return false;
  const std::string_view number = word.substr(1);
  return number.find_first_not_of("0123456789.") == std::string_view::npos && number[0] != '.' &&
         number.find('.') == number.rfind('.');
}

std::string ValuesOf(const KeyRow& row) { return std::visit(ValuesVisitor{}, row.binding); }

}  // namespace ncport::dialects
