// Whether a run may end inside a stretch of blocks: loops that only an alarm or the operator ends are no endless ones.
#pragma once

#include "ir/module.h"

namespace ncport::check {

/// False if the values of these blocks are sums, products and comparisons of variables, and no word of theirs calls,
/// stops or alarms. Of moves it is not asked whether their geometry holds.
[[nodiscard]] bool MayEndInside(const ir::Module& module, ir::BlockId first, ir::BlockId last);

/// True if a block there stops for the operator, who decides how often it goes on.
[[nodiscard]] bool StopsInside(const ir::Module& module, ir::BlockId first, ir::BlockId last);

}  // namespace ncport::check
