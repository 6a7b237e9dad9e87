#include "dialects/profile.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "dialects/profile_keys.h"
#include "dialects/profile_loader.h"
#include "dialects/registry.h"

namespace ncport::dialects {
namespace {

namespace fs = std::filesystem;

/// A folder that is empty at first and gone afterwards.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "ncport_profile_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  fs::path path_;
};

/// First finding of reading `text` as a profile file: "line:column code message | help".
std::string Finding(const std::string& text) {
  const Folder folder;
  SourceFiles files;
  diag::Sink sink;
  const Result<Profile> profile = LoadProfile(folder.Write("a.toml", text), files, sink);
  CHECK(profile.Ok() == sink.Empty());
  if (sink.Empty()) return "";
  const diag::Diagnostic& first = sink.All().front();
  std::string result = std::to_string(first.at.line) + ":" + std::to_string(first.at.begin + 1) + " " +
                       std::string(diag::InfoOf(first.code).number) + " " + first.message;
  if (!first.help.empty()) result += " | " + first.help;
  return result;
}

Profile Read(const std::string& text) {
  const Folder folder;
  SourceFiles files;
  diag::Sink sink;
  Result<Profile> profile = LoadProfile(folder.Write("a.toml", text), files, sink);
  for (const diag::Diagnostic& finding : sink.All()) FAIL(finding.message);
  return std::move(profile).Value();
}

TEST_CASE("a profile answers or asks every key that its language has") {
  for (const BuiltInProfile& built_in : BuiltInProfiles()) {
    CAPTURE(built_in.name);
    SourceFiles files;
    diag::Sink sink;
    const Result<ProfileParts> parts = LoadProfileParts(built_in.name, files, sink);
    REQUIRE(parts.Ok());
    for (const std::string_view key : parts->unmentioned) {
      if (key != "inherits") FAIL_CHECK(std::string(key));
    }
    CHECK(parts->profile.rapid.Known());
    CHECK_FALSE(parts->profile.axes.empty());
  }
}

TEST_CASE("the profiles of the contract exist") {
  const std::set<std::string_view> names = [] {
    std::set<std::string_view> result;
    static const std::vector<ProfileInfo> list = ListProfiles();
    for (const ProfileInfo& info : list) {
      result.insert(info.name);
      CHECK_FALSE(info.title.empty());
    }
    return result;
  }();
  for (const char* name : {"sinumerik-840d-mill",
                           "sinumerik-840d-lathe",
                           "sinumerik-802d-mill",
                           "sinumerik-802d-lathe",
                           "sinumerik-802s-mill",
                           "sinumerik-802s-lathe",
                           "fanuc-mill",
                           "fanuc-lathe-a",
                           "fanuc-lathe-b",
                           "fanuc-lathe-c",
                           "mazak-mill",
                           "mazak-qtn",
                           "mazak-integrex-old",
                           "mazak-integrex-new",
                           "haas-mill",
                           "haas-lathe",
                           "num-mill",
                           "num-lathe",
                           "iso-mill",
                           "iso-lathe",
                           "linuxcnc-mill",
                           "linuxcnc-lathe"}) {
    CHECK_MESSAGE(names.contains(name), name);
  }
  CHECK_FALSE(names.contains("mazak-integrex"));
}

TEST_CASE("a plain INTEGREX is refused with the question which") {
  SourceFiles files;
  diag::Sink sink;
  CHECK_FALSE(LoadProfile("mazak-integrex", files, sink).Ok());
  REQUIRE(sink.All().size() == 1);
  CHECK(sink.All()[0].message == "profile mazak-integrex leaves class open");
  CHECK(sink.All()[0].help.find("mazak-integrex-new or mazak-integrex-old") != std::string::npos);
}

TEST_CASE("values of a child win, all others come from the parent") {
  const Profile profile =
      Read("inherits = \"fanuc-mill\"\nincrement = 0.0001\n[start]\nplane = \"zx\"\n[fanuc]\nlogic = \"bits\"\n");
  const Profile parent = BuiltIn("fanuc-mill");
  CHECK(*profile.increment == 0.0001);
  CHECK(profile.start.plane == ir::Plane::kZX);
  CHECK(profile.start.motion == parent.start.motion);
  CHECK(*profile.fanuc.logic == FanucSettings::Logic::kBits);
  CHECK(*parent.fanuc.logic == FanucSettings::Logic::kConditions);
  CHECK(*profile.words.tool == *parent.words.tool);
  CHECK(profile.variables.size() == parent.variables.size());
}

TEST_CASE("start = unknown forgets the inherited state") {
  const Profile profile = Read("inherits = \"fanuc-mill\"\nstart = \"unknown\"\n");
  CHECK(profile.start == ir::ModalState{});
}

TEST_CASE("a space of variables replaces inherited ones that it touches") {
  const std::string space =
      "name = \"#\"\ntype = \"number\"\nlifetime = \"kept\"\nvisibility = \"all\"\nstart = \"unknown\"\nreserved = "
      "[[510, 519]]\n";
  const Profile profile = Read("inherits = \"fanuc-mill\"\n[[variables]]\n" + space + "range = [500, 531]\n");
  REQUIRE(profile.variables.size() == 3);
  CHECK(profile.variables[2].range == NumberRange{500, 531});
  CHECK(profile.variables[2].start == ir::StartValue::kUnknown);
  REQUIRE(profile.variables[2].reserved.size() == 1);
  CHECK(profile.variables[2].reserved[0].Contains(519));
  CHECK_FALSE(profile.variables[2].reserved[0].Contains(520));
  const std::string twice = Finding("inherits = \"fanuc-mill\"\n[[variables]]\n" + space +
                                    "range = [500, 531]\n[[variables]]\n" + space + "range = [531, 540]\n");
  CHECK(twice.find("NC2102 variables.range is a list where a range without cells of #500 to #531 is needed") !=
        std::string::npos);
}

TEST_CASE("ask opens a key again and names the line to add") {
  const Profile profile = Read("inherits = \"fanuc-mill\"\npoint = \"ask\"\n");
  CHECK_FALSE(profile.point.Known());
  CHECK(profile.point.Or(PointRule::kCalculator) == PointRule::kCalculator);
  diag::Sink sink;
  CHECK_FALSE(Need(profile, profile.point, {}, sink));
  CHECK(Need(profile, profile.increment, {}, sink));
  REQUIRE(sink.All().size() == 1);
  CHECK(sink.All()[0].code == diag::Code::kOpenKey);
  CHECK(sink.All()[0].help.find("point = \"increment\" | \"calculator\"") != std::string::npos);
}

TEST_CASE("every key asks under its own path") {
  Profile profile = BuiltIn("fanuc-mill");
  std::map<std::string, int> seen;
  for (const KeyRow& row : ProfileKeys()) {
    if (const auto* text = std::get_if<TextKey>(&row.binding)) {
      CHECK(text->get(profile).Key() == row.path);
    } else if (const auto* number = std::get_if<NumberKey>(&row.binding)) {
      CHECK(number->get(profile).Key() == row.path);
    } else if (const auto* flag = std::get_if<FlagKey>(&row.binding)) {
      CHECK(flag->get(profile).Key() == row.path);
    } else if (const auto* integer = std::get_if<IntegerKey>(&row.binding)) {
      CHECK(integer->get(profile).Key() == row.path);
    }
    CHECK(++seen[std::string(row.path)] == 1);
    CHECK(FindKey(row.path) == &row);
    CHECK_FALSE(row.meaning.empty());
    CHECK_FALSE(ValuesOf(row).empty());
  }
  CHECK(profile.machine_class.Key() == "class");
}

TEST_CASE("wrong keys and values are named with place and remedy") {
  const std::string head = "inherits = \"fanuc-mill\"\n";
  CHECK(Finding(head + "diametre = \"yes\"\n") == "2:1 NC2101 unknown key diametre | did you mean diameter?");
  CHECK(Finding(head + "[spindle]\nlimmit = \"x\"\n") ==
        "3:1 NC2101 unknown key spindle.limmit | did you mean spindle.limit?");
  CHECK(Finding(head + "atan-range = \"signed\"\n") ==
        "2:1 NC2101 unknown key atan-range | did you mean fanuc.atan-range?");
  CHECK(Finding(head + "colour = 1\n") == "2:1 NC2101 unknown key colour | all keys: docs/profiles.md");
  CHECK(Finding(head + "diameter = \"yse\"\n") ==
        "2:12 NC2102 diameter is text \"yse\" where one of no | yes | modal is needed | did you mean \"yes\"?");
  CHECK(Finding(head + "increment = 5\n") == "2:13 NC2102 increment is number 5 where a number, 1e-06 .. 1, is needed");
  CHECK(Finding(head + "decimals = 2.5\n") ==
        "2:12 NC2102 decimals is number 2.5 where a whole number, 0 .. 9, is needed");
  CHECK(Finding(head + "tool = \"T{tol}\"\n") ==
        "2:8 NC2102 tool is text \"T{tol}\" where text with {tool} {offset} is needed | {tol} is not one of its holes: "
        "tool offset");
  CHECK(Finding(head + "[start]\nplan = \"xy\"\n") == "3:1 NC2101 unknown key start.plan | did you mean plane?");
  CHECK(Finding(head + "[start]\nplane = \"xz\"\n") ==
        "3:9 NC2102 start.plane is text \"xz\" where one of unknown | xy | zx | yz is needed");
  CHECK(Finding(head + "[fanuc]\no-word = 1\n") ==
        "3:10 NC2102 fanuc.o-word is number 1 where \"yes\" or \"no\" is needed");
  CHECK(Finding(head + "[num]\nstructured = \"yes\"\n") ==
        "3:1 NC2101 unknown key num.structured | table [num] holds for language \"num\", this profile is \"fanuc\"");
  CHECK(Finding(head + "axes = [\"X\", \"X\"]\n").starts_with("2:14 NC2102 axes is text \"X\" where each axis once"));
  CHECK(Finding(head + "scratch = [\"#34-#40\"]\n") ==
        "0:1 NC2102 scratch is #34-#40 where a part of one space of variables is needed");
  CHECK(Finding(head + "language = \"num\"\n") ==
        "2:12 NC2102 language is text \"num\" where \"fanuc\", as in the profile it inherits from, is needed");
  CHECK(Finding(head + "[mcodes]\nX41 = \"drop\"\n") ==
        "3:1 NC2101 unknown key mcodes.X41 | keys are words such as M41, H5 or G187");
  CHECK(Finding("x = = 1\n").starts_with("1:5 NC1090 this is not TOML: "));
  CHECK(Finding("axes = [\"X\"]\n").starts_with("0:1 NC2106 machine is missing"));
}

TEST_CASE("unknown profiles and circles of inheritance are refused") {
  CHECK(Finding("inherits = \"fanuc-mil\"\n") ==
        "1:12 NC2104 there is no profile fanuc-mil | did you mean fanuc-mill?");
  SourceFiles files;
  diag::Sink sink;
  const Folder folder;
  const std::string a = folder.Write("a.toml", "inherits = \"./b.toml\"\n");
  folder.Write("b.toml", "inherits = \"./c.toml\"\n");
  folder.Write("c.toml", "inherits = \"./b.toml\"\n");
  CHECK_FALSE(LoadProfile(a, files, sink).Ok());
  REQUIRE(sink.All().size() == 1);
  CHECK(sink.All()[0].code == diag::Code::kProfileCycle);
  diag::Sink missing;
  CHECK_FALSE(LoadProfile("./nowhere.toml", files, missing).Ok());
  CHECK(missing.All()[0].code == diag::Code::kUnreadableFile);
}

TEST_CASE("inherits names a file beside the one that names it") {
  const Folder folder;
  folder.Write("base.toml", "inherits = \"mazak-qtn\"\n[spindle]\nr-word = \"\"\n");
  const std::string path = folder.Write("mine.toml", "inherits = \"./base.toml\"\nincrement = 0.001\n");
  SourceFiles files;
  diag::Sink sink;
  const Result<Profile> profile = LoadProfile(path, files, sink);
  REQUIRE(profile.Ok());
  CHECK(profile->spindle.r_word->empty());
  CHECK(profile->name == path);
}

TEST_CASE("the page of the keys is current") {
  std::ifstream file(NCPORT_SOURCE_DIR "/docs/profiles.md");
  std::stringstream text;
  text << file.rdbuf();
  // Not current? build/bin/ncport_profile_page > docs/profiles.md
  CHECK(text.str() == ProfilePage());
}

}  // namespace
}  // namespace ncport::dialects
