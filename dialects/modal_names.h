// The modal groups of ir::ModalState by the names that profiles (`start`) and `ncport.toml` (`[entry]`) use.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/diag/sink.h"
#include "dialects/toml_document.h"
#include "ir/modes.h"

namespace ncport::dialects {

struct ModalGroup {
  std::string_view key;                     // "distance"
  std::span<const std::string_view> names;  // by enumerator; names[0] is "unknown"; empty span: a number (work offset)
  std::string_view meaning;
  void (*set)(ir::ModalState& state, std::uint8_t enumerator);  // null for the work offset
};

std::span<const ModalGroup> ModalGroups();

/// Sets one group from a value of a file. Reports and returns false when the value does not fit. `path` is the whole
/// key.
bool SetModalGroup(const ModalGroup& group, std::string_view path, const TomlNode& value, ir::ModalState& state,
                   diag::Sink& sink);

/// "unknown | xy | zx | yz": the values of a group.
std::string ValuesOf(const ModalGroup& group);

}  // namespace ncport::dialects
