#include "tests/faults/judge.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace ncport::tests::faults {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kLimit{60};

struct Child {
  pid_t pid = 0;
  int from = -1;
  std::size_t index = 0;
  Clock::time_point since;
  std::string text;
};

Child Start(std::size_t index, const std::function<std::string(std::size_t)>& judge) {
  int ends[2];
  std::fflush(stdout);
  if (pipe(ends) != 0) std::abort();
  const pid_t pid = fork();
  if (pid < 0) std::abort();
  if (pid == 0) {
    close(ends[0]);
    // What a broken program says on its way out is of no use.
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
    const std::string answer = judge(index) + "\n";
    std::size_t done = 0;
    while (done < answer.size()) {
      const ssize_t wrote = write(ends[1], answer.data() + done, answer.size() - done);
      if (wrote <= 0) break;
      done += static_cast<std::size_t>(wrote);
    }
    _exit(0);
  }
  close(ends[1]);
  return {pid, ends[0], index, Clock::now(), {}};
}

}  // namespace

std::vector<std::string> JudgeAll(std::size_t count, const std::function<std::string(std::size_t)>& judge) {
  std::vector<std::string> answers(count);
  std::vector<Child> running;
  const std::size_t most = std::max(1U, std::thread::hardware_concurrency());
  std::size_t next = 0;
  while (next < count || !running.empty()) {
    while (next < count && running.size() < most) running.push_back(Start(next++, judge));
    std::vector<pollfd> waits;
    for (const Child& child : running) waits.push_back({child.from, POLLIN, 0});
    poll(waits.data(), waits.size(), 200);
    for (std::size_t i = running.size(); i-- > 0;) {
      Child& child = running[i];
      char buffer[4096];
      bool ended = false, late = false;
      if ((waits[i].revents & (POLLIN | POLLHUP)) != 0) {
        const ssize_t got = read(child.from, buffer, sizeof buffer);
        if (got > 0) child.text.append(buffer, static_cast<std::size_t>(got));
        ended = got <= 0;
      } else if (Clock::now() - child.since > kLimit) {
        late = true;
        kill(child.pid, SIGKILL);
      }
      if (!ended && !late) continue;
      int status = 0;
      waitpid(child.pid, &status, 0);
      close(child.from);
      std::string& answer = answers[child.index];
      if (late) {
        answer = "found: does not end";
      } else if (!child.text.empty()) {
        answer = child.text.substr(0, child.text.find('\n'));
      } else {
        answer = WIFEXITED(status) && WEXITSTATUS(status) == 70 ? "found: stopped by its own check" : "found: crash";
      }
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return answers;
}

}  // namespace ncport::tests::faults
