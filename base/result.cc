#include "base/result.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

namespace ncport::detail {

void BugText(const char* file, int line, fmt::string_view format, fmt::format_args args) {
  std::string message;
  try {
    message = fmt::vformat(format, args);
  } catch (const std::exception& error) {  // a wrong argument must not hide the first bug
    message.assign(format.data(), format.size()).append(" (").append(error.what()).append(")");
  }
  // Compiler caches turn absolute paths into ones from the build folder; what counts is the path in the project.
  std::string_view path = file;
  while (path.starts_with("../")) path.remove_prefix(3);
  std::fflush(stdout);
  std::fprintf(stderr,
               "ncport: internal error: %s\n"
               "  at %.*s:%d, ncport %s\n"
               "  This is a bug of ncport, not of your program; no output file was written.\n"
               "  Please report these lines, the command line, and the input files if you may pass them on.\n",
               message.c_str(), static_cast<int>(path.size()), path.data(), line, NCPORT_VERSION);
  std::fflush(stderr);
  std::quick_exit(70);
}

}  // namespace ncport::detail
