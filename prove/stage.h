// One side of a comparison with inputs that can be set: prepared once, run many times.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "exec/link.h"
#include "prove/verify.h"

namespace ncport::prove {

/// A side whose inputs can be set: arguments of calls become literals of a private copy, whose numbers change from run
/// to run while everything that was linked stays.
class Stage {
 public:
  Stage(const Side& side, const std::vector<BoundInput>& inputs, bool source);

  void Set(const ParameterSet& set);
  exec::Outcome Run(std::uint16_t skip_levels, std::uint64_t max_blocks, RecordedTrace& trace, diag::Sink& sink,
                    exec::Coverage* coverage);
  /// Modal groups random, cells of `garbage` filled, position unknown.
  void Poison(Random& random, const VerifyOptions& options);
  void Unpoison();
  [[nodiscard]] const ir::Module& Module() const { return module_; }
  [[nodiscard]] const ir::WorkOffset& StartOffset() const { return machine_.start.work_offset; }

 private:
  void Bind(const InputPlace& place, std::size_t input);

  ir::Module module_;
  ir::Machine machine_;
  ir::ModalState clean_start_;
  bool clean_position_known_;
  ir::ModalState entry_;
  std::unique_ptr<exec::Linked> linked_;
  exec::RunOptions options_;
  std::size_t clean_start_values_ = 0;
  struct Argument {
    ir::ExprId literal;     // in a call
    std::size_t index = 0;  // of the entry, when there is no literal
    std::size_t input = 0;
    bool letter = false;  // may stay empty
    bool truth = false;
  };
  std::vector<Argument> arguments_;
  std::vector<std::pair<std::size_t, std::size_t>> cells_;  // start value, input
};

}  // namespace ncport::prove
