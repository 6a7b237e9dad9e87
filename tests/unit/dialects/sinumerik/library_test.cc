#include "dialects/sinumerik/library.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace ncport::dialects::sinumerik {
namespace {

/// Names of the parameters in the PROC line of a cycle text.
std::vector<std::string> Parameters(std::string_view text) {
  const std::size_t open = text.find('(', text.find("\nPROC "));
  const std::size_t close = text.find(')', open);
  std::vector<std::string> names;
  std::size_t begin = open + 1;
  while (begin < close) {
    std::size_t end = std::min(text.find(',', begin), close);
    const std::string_view one = text.substr(begin, end - begin);
    names.emplace_back(one.substr(one.rfind(' ') + 1));
    begin = end + 1;
  }
  return names;
}

TEST_CASE("the cycles whose motion the card gives are there by name, in any case, and no others") {
  const std::vector<std::string_view> expected = {"CYCLE81", "CYCLE82", "CYCLE83", "CYCLE84", "HOLES1", "HOLES2"};
  CHECK(std::ranges::equal(LibraryCycleNames(), expected));
  CHECK(LibraryCycle("cycle83").has_value());
  CHECK(LibraryCycle("Holes2") == LibraryCycle("HOLES2"));
  for (const std::string_view name : {"CYCLE85", "CYCLE86", "CYCLE89", "CYCLE801", "CYCLE8", "CYCLE811", ""}) {
    CHECK_FALSE(LibraryCycle(name).has_value());
  }
}

TEST_CASE("each cycle text starts with its own PROC line") {
  for (const std::string_view name : LibraryCycleNames()) {
    const std::string_view text = *LibraryCycle(name);
    const std::string head = "\nPROC " + std::string(name) + "(";
    CHECK_MESSAGE(text.find(head) != std::string_view::npos, name);
    CHECK_MESSAGE(text.find(") SAVE DISPLOF\n") != std::string_view::npos, name);
  }
}

TEST_CASE("parameters stand in the order of the card") {
  using Names = std::vector<std::string>;
  CHECK(Parameters(*LibraryCycle("CYCLE81")) ==
        Names{"RTP", "RFP", "SDIS", "DP", "DPR", "DTB", "_GMODE", "_DMODE", "_AMODE"});
  CHECK(Parameters(*LibraryCycle("CYCLE83")) == Names{"RTP",  "RFP",  "SDIS",  "DP",     "DPR",    "FDEP",  "FDPR",
                                                      "DAM",  "DTB",  "DTS",   "FRF",    "VARI",   "_AXN",  "_MDEP",
                                                      "_VRT", "_DTD", "_DIS1", "_GMODE", "_DMODE", "_AMODE"});
  CHECK(Parameters(*LibraryCycle("CYCLE84")) == Names{"RTP", "RFP", "SDIS", "DP", "DPR", "DTB", "SDAC", "MPIT", "PIT",
                                                      "POSS", "SST", "SST1", "_AXN", "_PTAB", "_TECHNO", "_VARI",
                                                      "_DAM", "_VRT"});
  CHECK(Parameters(*LibraryCycle("HOLES1")) == Names{"SPCA", "SPCO", "STA1", "FDIS", "DBH", "NUM"});
  CHECK(Parameters(*LibraryCycle("HOLES2")) == Names{"CPA", "CPO", "RAD", "STA1", "INDA", "NUM"});
}

TEST_CASE("each limit names the parameter at its position, and every mode word of newer versions has one") {
  for (const LibraryLimit& limit : LibraryLimits()) {
    const auto text = LibraryCycle(limit.cycle);
    REQUIRE(text.has_value());
    const std::vector<std::string> names = Parameters(*text);
    REQUIRE(limit.position < names.size());
    CHECK(names[limit.position] == limit.parameter);
    CHECK_FALSE(limit.reason.empty());
  }
  for (const std::string_view name : LibraryCycleNames()) {
    for (const std::string& parameter : Parameters(*LibraryCycle(name))) {
      if (parameter != "_GMODE" && parameter != "_DMODE" && parameter != "_AMODE") continue;
      CHECK(std::ranges::any_of(LibraryLimits(), [&](const LibraryLimit& limit) {
        return limit.cycle == name && limit.parameter == parameter;
      }));
    }
  }
}

TEST_CASE("only CYCLE81 and CYCLE82 leave the choice of SAVE to the profile") {
  for (const std::string_view name : LibraryCycleNames()) {
    CHECK(LibrarySaveFollowsProfile(name) == (name == "CYCLE81" || name == "CYCLE82"));
  }
}

}  // namespace
}  // namespace ncport::dialects::sinumerik
