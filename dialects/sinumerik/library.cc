#include "dialects/sinumerik/library.h"

#include <algorithm>

#include "base/letter_case.h"
#include "dialects/sinumerik/library_data.h"

namespace ncport::dialects::sinumerik {
namespace {

constexpr std::string_view kAmounts = "chooses how depths, dwells and amounts are meant";
constexpr std::string_view kGeometry = "chooses how the depth is meant";
constexpr std::string_view kDisplay = "chooses the plane and the view of the editor";
constexpr std::string_view kDwell = "is a dwell that only newer versions of this cycle know";
constexpr std::string_view kInfeeds = "taps in several infeeds, whose speeds and dwells are not known";
constexpr std::string_view kTechnology = "sets exact stop, feed forward and spindle operation";

constexpr LibraryLimit kLimits[] = {
    {"CYCLE81", "DTB", 5, kDwell},       {"CYCLE81", "_GMODE", 6, kGeometry},     {"CYCLE81", "_DMODE", 7, kDisplay},
    {"CYCLE81", "_AMODE", 8, kAmounts},  {"CYCLE82", "_GMODE", 6, kGeometry},     {"CYCLE82", "_DMODE", 7, kDisplay},
    {"CYCLE82", "_AMODE", 8, kAmounts},  {"CYCLE83", "_GMODE", 17, kGeometry},    {"CYCLE83", "_DMODE", 18, kDisplay},
    {"CYCLE83", "_AMODE", 19, kAmounts}, {"CYCLE84", "_TECHNO", 14, kTechnology}, {"CYCLE84", "_VARI", 15, kInfeeds},
};

}  // namespace

std::optional<std::string_view> LibraryCycle(std::string_view name) {
  for (std::size_t i = 0; i < kLibraryCount; ++i) {
    if (EqualIgnoringCase(kLibraryNames[i], name)) return kLibraryTexts[i];
  }
  return std::nullopt;
}

std::span<const std::string_view> LibraryCycleNames() { return {kLibraryNames, kLibraryCount}; }

std::span<const LibraryLimit> LibraryLimits() { return kLimits; }

bool LibrarySaveFollowsProfile(std::string_view name) {
  return EqualIgnoringCase(name, "CYCLE81") || EqualIgnoringCase(name, "CYCLE82");
}

}  // namespace ncport::dialects::sinumerik
