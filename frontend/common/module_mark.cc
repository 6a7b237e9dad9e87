#include "frontend/common/module_mark.h"

namespace ncport::frontend {

ModuleMark::ModuleMark(const ir::Module& module)
    : words_(module.words.Size()),
      exprs_(module.exprs.Size()),
      expr_items_(module.expr_items.size()),
      variables_(module.variables.Size()),
      jumps_(module.jumps.Size()),
      switches_(module.switches.Size()),
      switch_arms_(module.switch_arms.size()),
      calls_(module.calls.Size()),
      args_(module.args.Size()),
      parts_(module.parts.Size()),
      fors_(module.fors.Size()),
      externs_(module.externs.Size()),
      extern_params_(module.extern_params.size()),
      assign_lists_(module.assign_lists.Size()) {}

void ModuleMark::Rollback(ir::Module& module) const {
  module.words.Resize(words_);
  module.exprs.Resize(exprs_);
  module.expr_places.Truncate(exprs_);
  module.expr_items.resize(expr_items_);
  module.variables.Resize(variables_);
  module.jumps.Resize(jumps_);
  module.switches.Resize(switches_);
  module.switch_arms.resize(switch_arms_);
  module.calls.Resize(calls_);
  module.args.Resize(args_);
  module.parts.Resize(parts_);
  module.fors.Resize(fors_);
  module.externs.Resize(externs_);
  module.extern_params.resize(extern_params_);
  module.assign_lists.Resize(assign_lists_);
}

}  // namespace ncport::frontend
