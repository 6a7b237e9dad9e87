#include "base/result.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace ncport {

namespace {

Result<int> Half(int value) {
  if (value % 2 != 0) return Failure{};
  return value / 2;
}

Status NeedEven(int value) {
  NCPORT_TRY(Half(value));
  return {};
}

Result<std::string> Quarter(int value) {
  NCPORT_TRY(NeedEven(value));
  NCPORT_TRY_ASSIGN(const int half, Half(value));
  NCPORT_TRY_ASSIGN(int quarter, Half(half));
  ++quarter;
  return std::to_string(quarter - 1);
}

Result<std::unique_ptr<int>> MoveOnly() {
  NCPORT_TRY_ASSIGN(auto made, Result<std::unique_ptr<int>>(std::make_unique<int>(5)));
  return made;
}

// Exit code and standard error of `run` in a process of its own.
template <class Run>
std::pair<int, std::string> InChild(Run run) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  std::fflush(stdout);  // or the child prints it again
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    run();
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  char chunk[256];
  for (ssize_t got = 0; (got = read(ends[0], chunk, sizeof chunk)) > 0;)
    text.append(chunk, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

}  // namespace

TEST_CASE("statuses join to failure if one failed") {
  CHECK(Status{}.Ok());
  CHECK_FALSE(Status{Failure{}}.Ok());
  CHECK((Status{} & Status{}).Ok());
  CHECK_FALSE((Status{} & Failure{}).Ok());
  CHECK_FALSE((Status{Failure{}} & Status{}).Ok());
  Status status;
  status &= Failure{};
  status &= Status{};
  CHECK_FALSE(status.Ok());
}

TEST_CASE("failure leaves the function, values go on") {
  CHECK(NeedEven(4).Ok());
  CHECK_FALSE(NeedEven(3).Ok());
  CHECK(*Quarter(8) == "2");
  CHECK(Quarter(8)->size() == 1);
  CHECK_FALSE(Quarter(6).Ok());
  CHECK_FALSE(Quarter(6).ToStatus().Ok());
  CHECK(**MoveOnly() == 5);
}

TEST_CASE("a bug says what to report and exits with 70") {
  const auto [code, text] = InChild([] { NCPORT_BUG("block {} has no words", 7); });
  CHECK(code == 70);
  CHECK(text.starts_with("ncport: internal error: block 7 has no words\n  at "));
  CHECK(text.find("tests/unit/base/result_test.cc:") != std::string::npos);
  CHECK(text.find("Please report") != std::string::npos);
}

TEST_CASE("a check passes or is a bug; a failed value is a bug") {
  int turns = 0;
  const auto count = [&] { return ++turns; };
  NCPORT_CHECK(true, "never shown {}", count());
  CHECK(turns == 0);
  CHECK(InChild([] {
          NCPORT_CHECK(1 + 1 == 3, "sum is {}", 1 + 1);
        }).second.starts_with("ncport: internal error: sum is 2"));
  CHECK(InChild([] { (void)Half(3).Value(); }).first == 70);
}

}  // namespace ncport
