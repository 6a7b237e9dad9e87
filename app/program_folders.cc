#include "app/program_folders.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/letter_case.h"

namespace ncport::app {
namespace {

/// The name of a program without path and marks, lower case.
std::string PlainName(std::string_view program) {
  const std::size_t slash = program.rfind('/');
  if (slash != std::string_view::npos) program.remove_prefix(slash + 1);
  std::string name = LowerOf(program);
  if (name.starts_with("_n_")) name.erase(0, 3);
  if (name.ends_with("_spf") || name.ends_with("_mpf") || name.ends_with(".spf") || name.ends_with(".mpf"))
    name.resize(name.size() - 4);
  return name;
}

/// The program number that a file name of a numbered language gives: O9810, O9810.NC, O09810_NAME.nc, 9250-Name.nc,
/// 4001.EIA (real-programs, Text). Endings of languages with names are none of it.
std::optional<std::uint32_t> NumberOf(std::string_view lower_name) {
  if (lower_name.ends_with(".spf") || lower_name.ends_with(".mpf") || lower_name.ends_with(".toml"))
    return std::nullopt;
  if (lower_name.starts_with('o')) lower_name.remove_prefix(1);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(lower_name.data(), lower_name.data() + lower_name.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const std::string_view rest = lower_name.substr(static_cast<std::size_t>(end - lower_name.data()));
  const bool ends = rest.empty() || std::string_view("._-( ").find(rest.front()) != std::string_view::npos;
  return ends ? std::optional(number) : std::nullopt;
}

}  // namespace

void ProgramFolders::ReadFolders() {
  read_ = true;
  namespace fs = std::filesystem;
  for (const std::string& folder : folders_) {
    Files& files = files_.emplace_back();
    std::map<std::uint32_t, std::string>& numbers = numbers_.emplace_back();
    std::error_code failed;
    for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
      std::string name = it->path().filename().string();
      // Two names that differ in case only: the first in the order of characters, so that a run does not depend on the
      // disk.
      const std::string lower = LowerOf(name);
      if (const auto number = NumberOf(lower)) {
        // Two files of one number: the shorter name is the plainer one, then the order of characters decides.
        const auto [known, fresh] = numbers.emplace(*number, name);
        const bool plainer =
            name.size() != known->second.size() ? name.size() < known->second.size() : name < known->second;
        if (!fresh && plainer) known->second = name;
      }
      const auto [entry, added] = files.emplace(lower, name);
      if (!added && name < entry->second) entry->second = name;
    }
    if (failed && error_.empty()) error_ = fmt::format("cannot read folder {}: {}", folder, failed.message());
  }
}

std::optional<Input> ProgramFolders::Find(std::string_view program) {
  if (!read_) ReadFolders();
  const std::string name = PlainName(program);
  const std::string_view digits = name.starts_with('o') ? std::string_view(name).substr(1) : std::string_view(name);
  const bool numbered = !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
  const std::uint32_t number = numbered ? NumberOf(name).value_or(0) : 0;  // 0 is no program number
  const auto read = [&](std::size_t folder, const std::string& file) -> std::optional<Input> {
    std::string path = folders_[folder];
    if (!path.ends_with('/')) path += '/';
    path += file;
    std::string error;
    std::optional<std::string> bytes = ReadBytes(path, error);
    if (bytes) return Input{path, *std::move(bytes)};
    if (error_.empty()) error_ = error;
    return std::nullopt;
  };
  for (std::size_t i = 0; i < files_.size(); ++i) {
    for (const char* ending : {".spf", ".mpf"}) {
      const auto found = files_[i].find(name + ending);
      if (found == files_[i].end()) continue;
      if (auto input = read(i, found->second)) return input;
    }
    if (number == 0) continue;
    const auto found = numbers_[i].find(number);
    if (found == numbers_[i].end()) continue;
    if (auto input = read(i, found->second)) return input;
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
    if (size == bytes.size()) bytes.resize(size + room);
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
