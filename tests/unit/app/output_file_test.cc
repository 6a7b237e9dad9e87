#include "app/output_file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace ncport::app {
namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() {
    char name[] = "/tmp/ncport-output-XXXXXX";
    path = mkdtemp(name);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path); }
  [[nodiscard]] std::string File(const char* name) const { return path + "/" + name; }
  [[nodiscard]] std::size_t Count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {}));
  }
  std::string path;
};

std::string Content(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_CASE("a committed file has the whole text; before that the old one stays") {
  const Folder folder;
  const std::string path = folder.File("a.nc");
  std::ofstream(path) << "old";
  chmod(path.c_str(), 0640);
  {
    OutputFile file(path);
    REQUIRE(file.Open().Ok());
    REQUIRE(file.Text().Write("new text").Ok());
    CHECK(Content(path) == "old");
    CHECK(folder.Count() == 2);
    REQUIRE(file.Commit().Ok());
  }
  CHECK(Content(path) == "new text");
  CHECK(folder.Count() == 1);
  struct stat info {};
  stat(path.c_str(), &info);
  CHECK((info.st_mode & 0777) == 0640);
}

TEST_CASE("a file that is not committed leaves nothing behind") {
  const Folder folder;
  {
    OutputFile file(folder.File("a.nc"));
    REQUIRE(file.Open().Ok());
    REQUIRE(file.Text().Write("half").Ok());
  }
  CHECK(folder.Count() == 0);
}

TEST_CASE("two files take their places together or not at all") {
  const Folder folder;
  std::vector<std::unique_ptr<OutputFile>> files;
  files.push_back(std::make_unique<OutputFile>(folder.File("a.nc")));
  files.push_back(std::make_unique<OutputFile>(folder.File("b.map")));
  for (const auto& file : files) REQUIRE(file->Open().Ok());
  std::string error;
  REQUIRE(CommitAll(files, error).Ok());
  CHECK(fs::exists(folder.File("a.nc")));
  CHECK(fs::exists(folder.File("b.map")));
}

TEST_CASE("a folder that is not there, a folder as target, a pipe without reader") {
  const Folder folder;
  OutputFile lost(folder.File("no/a.nc"));
  CHECK(!lost.Open().Ok());
  CHECK(lost.Error().find("No such file") != std::string::npos);
  OutputFile whole(folder.path);
  CHECK(!whole.Open().Ok());
  OutputFile null("/dev/null");
  REQUIRE(null.Open().Ok());
  CHECK(null.Text().Write("gone").Ok());
  CHECK(null.Commit().Ok());
}

TEST_CASE("a target that is no regular file gets the text when it is complete") {
  const Folder folder;
  const std::string path = folder.File("pipe");
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK);
  OutputFile file(path);
  REQUIRE(file.Open().Ok());
  REQUIRE(file.Text().Write("text").Ok());
  char buffer[16];
  CHECK(read(reader, buffer, sizeof buffer) <= 0);
  REQUIRE(file.Commit().Ok());
  CHECK(read(reader, buffer, sizeof buffer) == 4);
  close(reader);
  CHECK(folder.Count() == 1);
}

TEST_CASE("a full disk is a failure that leaves no file") {
  // /dev/full takes nothing.
  OutputFile full("/dev/full");
  REQUIRE(full.Open().Ok());
  REQUIRE(full.Text().Write("text").Ok());
  CHECK(!full.Commit().Ok());
  CHECK(full.Error().find("No space left") != std::string::npos);
}

TEST_CASE("a signal takes the temporary files away") {
  const Folder folder;
  const pid_t child = fork();
  if (child == 0) {
    InstallCleanup();
    OutputFile file(folder.File("a.nc"));
    (void)file.Open();
    (void)file.Text().Write("half");
    raise(SIGTERM);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGTERM);
  CHECK(folder.Count() == 0);
}

}  // namespace
}  // namespace ncport::app
