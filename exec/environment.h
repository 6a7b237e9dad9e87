// What only the machine knows: inputs, clock, probe, tool data, parameters. Without an answer a run stops with a
// finding that names the place of the read: exec never invents one.
#pragma once

#include <optional>
#include <string_view>

#include "exec/value.h"
#include "ir/module.h"

namespace ncport::exec {

class Environment {
 public:
  Environment() = default;
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  virtual ~Environment() = default;
  /// Value of a system variable, `indices` as computed; none = not known.
  virtual std::optional<Value> Read(const ir::System& system, std::string_view name, const Value* indices,
                                    std::size_t index_count) = 0;
  /// A write to one; false = not possible.
  virtual bool Write(const ir::System& system, std::string_view name, const Value* indices, std::size_t index_count,
                     const Value& value) = 0;
};

/// The environment that knows nothing.
class NoEnvironment final : public Environment {
 public:
  std::optional<Value> Read(const ir::System&, std::string_view, const Value*, std::size_t) override {
    return std::nullopt;
  }
  bool Write(const ir::System&, std::string_view, const Value*, std::size_t, const Value&) override { return false; }
};

}  // namespace ncport::exec
