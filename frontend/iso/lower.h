// Replays a recipe on the tokens of a flat block.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "dialects/profile.h"
#include "frontend/common/line_error.h"
#include "frontend/common/shape_cache.h"
#include "frontend/common/token.h"
#include "ir/module.h"

namespace ncport::frontend::iso {

class Lowering {
 public:
  Lowering(ir::Module& module, const dialects::Profile& profile);

  /// Adds the words of the block. False: Error() says why, and the records added must be taken back.
  bool Replay(const Recipe& recipe, std::span<const Token> tokens, std::string_view line, ir::Block& block);
  [[nodiscard]] const LineError& Error() const { return error_; }

 private:
  bool Do(const Action& action);
  bool AddCode(const Action& action);
  bool AddTool(const Action& action);
  bool AddExtendedOffset(const Action& action);
  bool AddDwell(const Action& action);
  ir::Word& Add(ir::WordOp op, const Action& action, ir::ExprId value = {}, std::uint8_t index = 0);
  ir::ExprId Literal(const Token& token);
  ir::ExprId Whole(double number, const Token& token);
  bool Once(char letter, const Token& token);
  bool Fail(diag::Code code, const Token& token, const char* help = nullptr);

  ir::Module& module_;
  bool lathe_;
  bool tool_holds_offset_;  // T0303
  char dwell_letter_;
  std::span<const Token> tokens_;
  std::string_view line_;
  std::uint32_t letters_ = 0;  // addresses of the block seen, bit per letter
  std::uint64_t groups_ = 0;
  LineError error_;
  std::vector<std::uint16_t> code_spellings_;
};

}  // namespace ncport::frontend::iso
