#include "app/program_folders.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace ncport::app {
namespace {

TEST_CASE("called programs are found whatever the case of their file names") {
  char name[] = "/tmp/ncport-folders-XXXXXX";
  const std::string folder = mkdtemp(name);
  std::filesystem::create_directory(folder + "/second");
  const auto write = [&](const char* file, const char* text) { std::ofstream(folder + "/" + file) << text; };
  write("Ring.SPF", "ring");
  write("L10.mpf", "main l10");
  write("second/L10.spf", "sub l10");
  write("both.mpf", "main");
  write("both.spf", "sub");
  ProgramFolders folders({folder, folder + "/second"});
  CHECK(folders.Find("RING")->bytes == "ring");
  CHECK(folders.Find("ring")->name == folder + "/Ring.SPF");
  CHECK(folders.Find("_N_RING_SPF")->bytes == "ring");
  CHECK(folders.Find("/_N_SPF_DIR/_N_Ring_SPF")->bytes == "ring");
  CHECK(folders.Find("both")->bytes == "sub");      // .SPF first, in the same folder
  CHECK(folders.Find("L10")->bytes == "main l10");  // the first folder wins
  CHECK(!folders.Find("L010"));
  CHECK(!folders.Find("NONE"));
  CHECK(folders.Error().empty());
  std::filesystem::remove_all(folder);
  ProgramFolders gone({folder});
  CHECK(!gone.Find("RING"));
  CHECK(gone.Error().find("cannot read folder") == 0);
}

TEST_CASE("programs by number are found under the file names of real folders (real-programs, Text)") {
  char name[] = "/tmp/ncport-folders-XXXXXX";
  const std::string folder = mkdtemp(name);
  const auto write = [&](const char* file, const char* text) { std::ofstream(folder + "/" + file) << text; };
  write("O9810", "plain");
  write("O9811.NC", "ending");
  write("O09812_NAME.nc", "long");
  write("9250-Name.nc", "dash");
  write("4001.EIA", "mazak");
  write("O9813.NC", "b");
  write("O9813_OLD.NC", "a");
  write("O98.14.toml", "no program");
  write("9815x.nc", "another name");
  ProgramFolders folders({folder});
  CHECK(folders.Find("9810")->bytes == "plain");
  CHECK(folders.Find("O9810")->bytes == "plain");
  CHECK(folders.Find("o09811")->bytes == "ending");
  CHECK(folders.Find("9812")->bytes == "long");
  CHECK(folders.Find("9250")->bytes == "dash");
  CHECK(folders.Find("4001")->bytes == "mazak");
  CHECK(folders.Find("9813")->bytes == "b");  // the plainer name
  CHECK(!folders.Find("98"));
  CHECK(!folders.Find("9815"));
  CHECK(!folders.Find("NAME"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("a file that cannot be read has a reason") {
  std::string error;
  CHECK(!ReadBytes("/no/such/file", error));
  CHECK(error == "cannot read /no/such/file: No such file or directory");
  CHECK(!ReadBytes("/tmp", error));
  CHECK(error == "cannot read /tmp: Is a directory");
  CHECK(ReadBytes("/dev/null", error)->empty());
}

}  // namespace
}  // namespace ncport::app
