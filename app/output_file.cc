#include "app/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace ncport::app {
namespace {

// Names of temporary files, for the signal handler: fixed memory, changed only while signals are blocked.
constexpr std::size_t kSlots = 64;
char g_names[kSlots][PATH_MAX];

void RemoveAll() {
  for (char(&name)[PATH_MAX] : g_names) {
    if (name[0] == '\0') continue;
    (void)unlink(name);
    name[0] = '\0';
  }
}

extern "C" void OnSignal(int number) {
  RemoveAll();
  (void)signal(number, SIG_DFL);
  (void)raise(number);
}

/// Blocks the signals that the handler serves while the table changes.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t set;
    sigemptyset(&set);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, number);
    sigprocmask(SIG_BLOCK, &set, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

/// Slot from 1, or 0 if the table is full or the name too long.
std::size_t TakeSlot(const std::string& name) {
  if (name.size() >= PATH_MAX) return 0;
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    if (g_names[slot][0] != '\0') continue;
    std::memcpy(g_names[slot], name.c_str(), name.size() + 1);
    return slot + 1;
  }
  return 0;
}

void FreeSlot(std::size_t slot) {
  if (slot != 0) g_names[slot - 1][0] = '\0';
}

std::string TemporaryFolder() {
  const char* folder = std::getenv("TMPDIR");
  return folder != nullptr && *folder != '\0' ? folder : "/tmp";
}

}  // namespace

void InstallCleanup() {
  struct sigaction action {};
  action.sa_handler = OnSignal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    // A parent that ignores a signal (nohup) wants it ignored.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
  (void)signal(SIGPIPE, SIG_IGN);  // a closed pipe is a failed write
  (void)std::at_quick_exit(RemoveAll);
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {}

OutputFile::~OutputFile() {
  const SignalsBlocked blocked;
  if (fd_ >= 0) close(fd_);
  if (!temporary_.empty()) (void)unlink(temporary_.c_str());
  FreeSlot(slot_);
}

Status OutputFile::Fail(const char* what, int error_number) {
  error_ = fmt::format("cannot {} {}: {}", what, path_ == "-" ? "standard output" : path_, std::strerror(error_number));
  return Failure{};
}

Status OutputFile::Open() {
  struct stat info {};
  const bool standard = path_ == "-";
  const bool exists = standard ? fstat(STDOUT_FILENO, &info) == 0 : stat(path_.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) return Fail("write", EISDIR);
  in_place_ = standard || (exists && !S_ISREG(info.st_mode));
  if (in_place_ && exists && S_ISCHR(info.st_mode)) {
    struct stat null {};
    direct_ = stat("/dev/null", &null) == 0 && null.st_rdev == info.st_rdev;
  }
  if (direct_) {
    fd_ = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) return Fail("write", errno);
    text_ = std::make_unique<OutputSink>(fd_);
    return {};
  }

  const std::string pattern = in_place_ ? TemporaryFolder() + "/ncport-XXXXXX" : path_ + ".XXXXXX";
  std::string name = pattern;
  {
    const SignalsBlocked blocked;
    fd_ = mkostemp(name.data(), O_CLOEXEC);
    if (fd_ < 0) return Fail("write", errno);
    if (in_place_) {
      // Nobody needs its name: it goes away with the descriptor, whatever happens.
      (void)unlink(name.c_str());
    } else {
      temporary_ = name;
      slot_ = TakeSlot(name);
    }
  }
  if (!in_place_) {
    // The rights of the file that is replaced, or those of a new one.
    const mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(fd_, exists ? info.st_mode & 07777 : 0666 & ~mask);
  }
  text_ = std::make_unique<OutputSink>(fd_);
  return {};
}

Status OutputFile::Prepare() {
  if (prepared_) return {};
  if (text_->Error() != 0) return Fail("write", text_->Error());
  if (!in_place_ && close(std::exchange(fd_, -1)) != 0) return Fail("write", errno);
  prepared_ = true;
  return {};
}

Status OutputFile::CopyToTarget() {
  const int target = path_ == "-" ? STDOUT_FILENO : open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (target < 0) return Fail("write", errno);
  OutputSink out(target);
  TextBuffer buffer;
  Status ok;
  if (lseek(fd_, 0, SEEK_SET) != 0) return Fail("write", errno);
  while (true) {
    constexpr std::size_t kPiece = std::size_t{1} << 16U;
    char* room = buffer.Reserve(kPiece);
    const ssize_t count = read(fd_, room, kPiece);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      ok = Fail("read back the text for", errno);
      break;
    }
    if (count == 0) break;
    buffer.SetEnd(room + count);
    if (!out.Flush(buffer).Ok()) {
      ok = Fail("write", out.Error());
      break;
    }
  }
  if (target != STDOUT_FILENO && close(target) != 0 && ok.Ok()) ok = Fail("write", errno);
  return ok;
}

Status OutputFile::Commit() {
  NCPORT_TRY(Prepare());
  if (direct_) return {};
  if (in_place_) return CopyToTarget();
  const SignalsBlocked blocked;
  if (rename(temporary_.c_str(), path_.c_str()) != 0) return Fail("write", errno);
  temporary_.clear();
  FreeSlot(std::exchange(slot_, 0));
  return {};
}

Status CommitAll(std::vector<std::unique_ptr<OutputFile>>& files, std::string& error) {
  for (const bool rename_now : {false, true}) {
    for (const auto& file : files) {
      const Status done = rename_now ? file->Commit() : file->Prepare();
      if (done.Ok()) continue;
      error = file->Error();
      return Failure{};
    }
  }
  return {};
}

}  // namespace ncport::app
