#include "app/program_folders.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace ncport::app {
namespace {

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// The name of a program without path and marks, lower case.
std::string PlainName(std::string_view program) {
  const std::size_t slash = program.rfind('/');
  if (slash != std::string_view::npos) program.remove_prefix(slash + 1);
  std::string name = Lower(program);
  if (name.starts_with("_n_")) name.erase(0, 3);
  if (name.ends_with("_spf") || name.ends_with("_mpf") || name.ends_with(".spf") || name.ends_with(".mpf"))
    name.resize(name.size() - 4);
  return name;
}

/// "o4001" -> "4001"; empty: not a number.
std::string NumberOf(std::string_view name) {
  if (name.starts_with('o')) name.remove_prefix(1);
  const bool digits = !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
  return digits ? std::string(name) : std::string();
}

}  // namespace

void ProgramFolders::ReadFolders() {
  read_ = true;
  namespace fs = std::filesystem;
  for (const std::string& folder : folders_) {
    Files& files = files_.emplace_back();
    std::error_code failed;
    for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
      std::string name = it->path().filename().string();
      // Two names that differ in case only: the first in the order of characters, so that a run does not depend on the
      // disk.
      const auto [entry, added] = files.emplace(Lower(name), name);
      if (!added && name < entry->second) entry->second = name;
    }
    if (failed && error_.empty()) error_ = fmt::format("cannot read folder {}: {}", folder, failed.message());
  }
}

std::optional<Input> ProgramFolders::Find(std::string_view program) {
  if (!read_) ReadFolders();
  const std::string name = PlainName(program);
  std::vector<std::string> wanted{name + ".spf", name + ".mpf"};
  // A number is the name of its file, with or without the O: O4001 is 4001.EIA on Mazak (mazak-lathe-1), O4001.NC
  // elsewhere.
  if (const std::string digits = NumberOf(name); !digits.empty()) {
    for (const char* ending : {".eia", ".nc", ""}) {
      wanted.push_back(digits + ending);
      wanted.push_back("o" + digits + ending);
    }
  }
  for (std::size_t i = 0; i < files_.size(); ++i) {
    for (const std::string& file : wanted) {
      const auto found = files_[i].find(file);
      if (found == files_[i].end()) continue;
      std::string path = folders_[i];
      if (!path.ends_with('/')) path += '/';
      path += found->second;
      std::string error;
      std::optional<std::string> bytes = ReadBytes(path, error);
      if (bytes) return Input{path, *std::move(bytes)};
      if (error_.empty()) error_ = error;
    }
  }
  return std::nullopt;
}

std::optional<std::string> ReadBytes(const std::string& path, std::string& error) {
  const bool standard = path == "-";
  const int fd = standard ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const auto fail = [&](int number) -> std::optional<std::string> {
    error = fmt::format("cannot read {}: {}", standard ? "standard input" : path, std::strerror(number));
    if (!standard && fd >= 0) close(fd);
    return std::nullopt;
  };
  if (fd < 0) return fail(errno);
  struct stat info {};
  if (fstat(fd, &info) != 0) return fail(errno);
  if (S_ISDIR(info.st_mode)) return fail(EISDIR);
  std::string bytes;
  // One byte more than the size: the last read finds the end without another round.
  std::size_t room = S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) + 1 : std::size_t{1} << 16U;
  std::size_t size = 0;
  while (true) {
    if (bytes.size() < size + room) bytes.resize(size + room);
    const ssize_t count = read(fd, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail(errno);
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
    if (size == bytes.size()) room = size;  // grow by doubling
  }
  bytes.resize(size);
  if (!standard) close(fd);
  return bytes;
}

}  // namespace ncport::app
