#include "tests/tools/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace ncport::tests {
namespace {

struct Pipe {
  int read_end = -1;
  int write_end = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
    read_end = ends[0];
    write_end = ends[1];
  }
  static void Close(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
  ~Pipe() {
    Close(read_end);
    Close(write_end);
  }
};

/// Reads what is there; false at the end of the stream.
bool Drain(int descriptor, std::string& into) {
  char buffer[65536];
  const ssize_t got = read(descriptor, buffer, sizeof buffer);
  if (got > 0) into.append(buffer, static_cast<std::size_t>(got));
  return got > 0 || (got < 0 && errno == EINTR);
}

}  // namespace

ProcessResult RunProcess(const std::vector<std::string>& arguments, const std::string& input, double limit_seconds,
                         const std::string& folder) {
  using Clock = std::chrono::steady_clock;
  ProcessResult result;
  Pipe in, out, err, failed;
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child < 0) std::abort();
  if (child == 0) {
    dup2(in.read_end, 0);
    dup2(out.write_end, 1);
    dup2(err.write_end, 2);
    if (folder.empty() || chdir(folder.c_str()) == 0) execvp(argv[0], argv.data());
    const ssize_t ignored = write(failed.write_end, "x", 1);
    _exit(ignored == 1 ? 127 : 126);
  }
  Pipe::Close(in.read_end);
  Pipe::Close(out.write_end);
  Pipe::Close(err.write_end);
  Pipe::Close(failed.write_end);
  std::signal(SIGPIPE, SIG_IGN);
  std::size_t written = 0;
  if (input.empty()) Pipe::Close(in.write_end);
  while (out.read_end >= 0 || err.read_end >= 0) {
    const double left = limit_seconds - std::chrono::duration<double>(Clock::now() - begin).count();
    if (left <= 0) {
      result.timed_out = true;
      kill(child, SIGKILL);
      break;
    }
    pollfd fds[3] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}, {in.write_end, POLLOUT, 0}};
    poll(fds, 3, static_cast<int>(std::min(left, 1.0) * 1000) + 1);
    if (fds[0].revents != 0 && !Drain(out.read_end, result.output)) Pipe::Close(out.read_end);
    if (fds[1].revents != 0 && !Drain(err.read_end, result.errors)) Pipe::Close(err.read_end);
    if (fds[2].revents != 0) {
      const ssize_t put =
          write(in.write_end, input.data() + written, std::min<std::size_t>(input.size() - written, 4096));
      if (put > 0) written += static_cast<std::size_t>(put);
      if (put < 0 || written == input.size()) Pipe::Close(in.write_end);
    }
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::string mark;
  result.started = !(Drain(failed.read_end, mark) && !mark.empty());
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "ncport-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    std::fprintf(stderr, "cannot make a folder like %s\n", pattern.c_str());
    std::exit(2);
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::Write(const std::string& name, const std::string& text) const {
  const std::string path = File(name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string ReadFileOrDie(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path.c_str());
    std::exit(2);
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string Tail(const std::string& text, int lines) {
  std::size_t at = text.size();
  if (at > 0 && text[at - 1] == '\n') --at;
  for (; lines > 0 && at != std::string::npos && at > 0; --lines) at = text.rfind('\n', at - 1);
  return at == std::string::npos || at == 0 ? text : text.substr(at + 1);
}

}  // namespace ncport::tests
