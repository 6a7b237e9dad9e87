#include "base/text_buffer.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <thread>
#include <utility>

namespace ncport {

TEST_CASE("text is appended, cut and cleared") {
  TextBuffer buffer;
  CHECK(buffer.Empty());
  buffer.Append("");
  buffer.Append("N10");
  buffer.Append(' ');
  buffer.Append(std::string(1000, 'x'));
  CHECK(buffer.size() == 1004);
  CHECK(buffer.View().substr(0, 5) == "N10 x");
  buffer.Truncate(3);
  CHECK(buffer.View() == "N10");
  buffer.Truncate(50);
  CHECK(buffer.size() == 3);
  char* const room = buffer.Reserve(2);
  room[0] = 'G';
  buffer.SetEnd(room + 1);
  CHECK(buffer.View() == "N10G");
  TextBuffer moved = std::move(buffer);
  CHECK(moved.View() == "N10G");
  CHECK(buffer.Empty());  // NOLINT(bugprone-use-after-move): a moved buffer is empty and usable
  buffer.Append("again");
  CHECK(buffer.View() == "again");
  moved.Clear();
  CHECK(moved.Empty());
}

TEST_CASE("a buffer is flushed to a string") {
  std::string target;
  OutputSink sink{target};
  TextBuffer buffer;
  buffer.Append("G0\n");
  CHECK(sink.Flush(buffer).Ok());
  CHECK(buffer.Empty());
  CHECK(sink.Write("M30\n").Ok());
  CHECK(target == "G0\nM30\n");
  CHECK(sink.Written() == 7);
}

TEST_CASE("a pipe that is full is waited for, also when it does not block") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  REQUIRE(fcntl(ends[1], F_SETFL, O_NONBLOCK) == 0);
  std::size_t got = 0;
  std::thread reader([&] {
    char chunk[4096];
    for (ssize_t count = 0; (count = read(ends[0], chunk, sizeof chunk)) > 0;) got += static_cast<std::size_t>(count);
  });
  OutputSink sink{ends[1]};
  CHECK(sink.Write(std::string(1000000, 'x')).Ok());
  close(ends[1]);
  reader.join();
  close(ends[0]);
  CHECK(got == 1000000);
}

TEST_CASE("a failed write sticks") {
  const int fd = open("/dev/full", O_WRONLY);
  REQUIRE(fd >= 0);
  OutputSink sink{fd};
  CHECK_FALSE(sink.Write("x").Ok());
  CHECK(sink.Error() == ENOSPC);
  close(fd);
  CHECK_FALSE(sink.Write("y").Ok());
  CHECK(sink.Error() == ENOSPC);
  CHECK(sink.Written() == 0);
}

}  // namespace ncport
