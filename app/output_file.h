// Results that are written whole or not at all (contracts section 2): text goes to a temporary file beside the target,
// which is renamed at the end. Targets that are no regular files (/dev/null, a pipe, standard output) get the text when
// it is complete. Temporary files go away on failure, on SIGINT and SIGTERM, and when ncport stops over a bug of its
// own.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/text_buffer.h"

namespace ncport::app {

/// Removes the temporary files when a signal or a bug ends the program. Call once, before the first OutputFile.
void InstallCleanup();

class OutputFile {
 public:
  /// `path` "-" is standard output. Nothing is created yet.
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Drops what was not committed.
  ~OutputFile();

  /// Makes the temporary file. Fails with a message in Error().
  Status Open();
  /// Where the text goes between Open and Commit.
  [[nodiscard]] OutputSink& Text() { return *text_; }
  /// All that was written is safe on its way: errors of the writes before count here. Fails with a message in Error().
  Status Prepare();
  /// Prepare, then the text takes its place. Fails with a message in Error().
  Status Commit();
  [[nodiscard]] const std::string& Error() const { return error_; }

 private:
  Status Fail(const char* what, int error_number);
  Status CopyToTarget();

  std::string path_;
  std::string error_;
  std::size_t slot_ = 0;   // of the temporary file in the cleanup table, from 1; 0 = none
  std::string temporary_;  // empty: the temporary file has no name any more
  int fd_ = -1;
  bool in_place_ = false;  // the target is not a regular file
  bool direct_ = false;    // a target that keeps nothing (/dev/null): no temporary file
  bool prepared_ = false;
  std::unique_ptr<OutputSink> text_;
};

/// Several results as one: all temporary files are complete before the first one is renamed. Fails with a message in
/// `error`.
Status CommitAll(std::vector<std::unique_ptr<OutputFile>>& files, std::string& error);

}  // namespace ncport::app
