#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "dialects/registry.h"

namespace ncport::dialects {
namespace {

std::string Guess(std::string_view name, std::string_view text) {
  const LanguageGuess guess = GuessLanguage(name, text);
  std::string result;
  for (std::size_t i = 0; i < guess.languages.size(); ++i) {
    result += (i == 0 ? "" : "; ") + std::string(NameOf(guess.languages[i])) + ": " + guess.reasons[i];
  }
  return result;
}

TEST_CASE("the ending or one sure word is enough") {
  CHECK(Guess("a.mpf", "G1 X1 F100\nM30\n") == "sinumerik: ending .mpf");
  CHECK(Guess("dir.eia/a", "G1 X1\n").empty());
  CHECK(Guess("a.nc", "N10 G1 X1\nR1=5\n") == "sinumerik: line 2: an R parameter");
  CHECK(Guess("a", "IF R1>5 GOTOF END_1\n") == "sinumerik: line 1: GOTOF");
  CHECK(Guess("a", "%\nO0001\n#1=5\n") == "fanuc: line 2: an O number");
  CHECK(Guess("a.nc", "G0X#1\n") == "fanuc: line 1: a # variable");
  CHECK(Guess("a", "%125 (PLATE)\nG0 XL5\n") == "num: line 1: % with a program number");
  CHECK(Guess("a", "G79 L1 = 5 N20\n") == "num: line 1: G79 with a condition or a target");
  CHECK(Guess("a", "o100 sub\n#1=5\no100 endsub\n") == "linuxcnc: line 1: O word before a keyword");
  CHECK(Guess("a", "#<depth>=5\n#1=3\n") == "linuxcnc: line 1: #<name>");
  CHECK(Guess("a.ngc", "#1=5\n") == "linuxcnc: ending .ngc");
}

TEST_CASE("literal blocks speak for no language") {
  CHECK(Guess("part.nc", "G0 X1 Y2\nG1 Z-1 F100\nM30\n").empty());
  diag::Sink sink;
  CHECK_FALSE(NeedLanguage(GuessLanguage("part.nc", "G0 X1\n"), "part.nc", {}, sink).Ok());
  CHECK(sink.All()[0].message ==
        "language of part.nc is not clear: neither its ending nor a word in it speaks for one");
}

TEST_CASE("two languages are a contradiction that names both") {
  diag::Sink sink;
  CHECK_FALSE(NeedLanguage(GuessLanguage("a.mpf", "#1=5\n"), "a.mpf", {}, sink).Ok());
  CHECK(sink.All()[0].message ==
        "language of a.mpf is not clear: sinumerik (ending .mpf), fanuc (line 1: a # variable)");
}

TEST_CASE("words in comments and texts are no signs") {
  CHECK(Guess("a.mpf", "; see #1 and O1234\nMSG(\"#1 GOTO 5\")\n") == "sinumerik: ending .mpf, line 2: MSG(");
  CHECK(Guess("a.nc", "(R1=5 GOTOF END)\n#1=5\n") == "fanuc: line 2: a # variable");
}

TEST_CASE("a lathe word chooses the lathe profile") {
  const auto usual = [](std::string_view name, std::string_view text) {
    return UsualProfile(GuessLanguage(name, text));
  };
  CHECK(usual("a.mpf", "G1 X1\n") == "sinumerik-840d-mill");
  CHECK(usual("a.mpf", "DIAMON\nG1 X1\n") == "sinumerik-840d-lathe");
  CHECK(usual("a.mpf", "G96 S300 LIMS=3200\n") == "sinumerik-840d-lathe");
  CHECK(usual("a.nc", "O1\nT5 M6\nG0 X1.\n") == "fanuc-mill");
  CHECK(usual("a.nc", "O1\nT0101\nG0 X1.\n") == "fanuc-lathe-a");
  CHECK(usual("a.nc", "O1\nT1001 M6\n") == "fanuc-mill");
  CHECK(usual("a.nc", "O1\nG50 S2000\n") == "fanuc-lathe-a");
  CHECK(usual("a.nc", "O1\nG50.1 X0 S2000\n") == "fanuc-mill");
  CHECK(usual("a.xpi", "%1\nG64 N10 N20\n") == "num-lathe");
}

TEST_CASE("the vectors are in the language of their folder") {
  namespace fs = std::filesystem;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(NCPORT_SOURCE_DIR "/tests/vectors")) {
    const fs::path& path = entry.path();
    const std::string folder = path.parent_path().filename().string();
    if (path.extension() == ".expected" || !FindLanguage(folder).has_value()) continue;
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    const LanguageGuess guess = GuessLanguage(path.string(), text.str());
    CAPTURE(path.string());
    CAPTURE(Guess(path.string(), text.str()));
    REQUIRE(guess.Certain());
    CHECK(NameOf(guess.languages[0]) == folder);
    ++count;
  }
  CHECK(count > 100);
}

}  // namespace
}  // namespace ncport::dialects
