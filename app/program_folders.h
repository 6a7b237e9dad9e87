// Called programs in the folders of -I. File names compare without regard to case, as they come from controls that have
// none.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ncport.h"

namespace ncport::app {

class ProgramFolders {
 public:
  explicit ProgramFolders(std::vector<std::string> folders) : folders_(std::move(folders)) {}

  /// The file of this program: in each folder in turn NAME.SPF, then NAME.MPF (sinumerik card, 7.3), then for a number
  /// (O9810, 9810) a file that carries it: O9810, O9810.NC, O09810_NAME.nc, 9250-Name.nc, 4001.EIA. Marks around the
  /// name (`_N_RING_SPF`) and a path before it are left out.
  std::optional<Input> Find(std::string_view program);
  /// A folder that could not be read, or a file that could not be; empty: none.
  [[nodiscard]] const std::string& Error() const { return error_; }

 private:
  using Files = std::map<std::string, std::string, std::less<>>;  // lower-case name -> name as it stands
  void ReadFolders();

  std::vector<std::string> folders_;
  std::vector<Files> files_;                                   // beside folders_
  std::vector<std::map<std::uint32_t, std::string>> numbers_;  // beside folders_: program number -> name as it stands
  bool read_ = false;
  std::string error_;
};

/// All bytes of a file, or of standard input for "-". Nothing and a message in `error` if it cannot be read.
std::optional<std::string> ReadBytes(const std::string& path, std::string& error);

}  // namespace ncport::app
