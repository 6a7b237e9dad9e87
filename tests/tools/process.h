// Runs the ncport program (or a judge) as a user does, and keeps what it said. Tests only.
#pragma once

#include <string>
#include <vector>

namespace ncport::tests {

struct ProcessResult {
  int exit_code = -1;      // of a normal end; 128 + number when a signal ended it
  bool timed_out = false;  // it was ended after the time limit
  bool started = false;    // false: the program was not found
  std::string output;      // standard output
  std::string errors;      // standard error
  double seconds = 0;      // wall time

  /// Ended by itself, without a signal.
  [[nodiscard]] bool Clean() const { return started && !timed_out && exit_code >= 0 && exit_code < 128; }
};

/// Runs `arguments[0]` (a path, or a name looked up in PATH) with `input` as standard input. `folder`: working folder,
/// empty = this one.
ProcessResult RunProcess(const std::vector<std::string>& arguments, const std::string& input = {},
                         double limit_seconds = 60, const std::string& folder = {});

/// An empty folder of its own below the system's temporary folder; removed with all it holds when the object goes.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::string& Path() const { return path_; }
  /// Path of `name` in it.
  [[nodiscard]] std::string File(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a file in it and returns its path.
  std::string Write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

/// Whole content of a file; a file that cannot be read ends the test program with a message.
std::string ReadFileOrDie(const std::string& path);
/// Last `lines` lines of a text, for messages.
std::string Tail(const std::string& text, int lines);

}  // namespace ncport::tests
