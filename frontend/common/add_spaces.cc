#include "frontend/common/add_spaces.h"

namespace ncport::frontend {

void AddSpaces(const dialects::Profile& profile, ir::Module& module) {
  for (const dialects::VariableSpace& space : profile.variables) {
    bool there = false;
    for (const ir::Space& known : module.spaces.All()) {
      there |= module.View(known.name) == space.name && known.first == space.range.first;
    }
    if (there) continue;
    ir::Space record;
    record.name = module.strings.Intern(space.name);
    record.first = space.range.first;
    record.last = space.range.last;
    record.type = space.type;
    record.lifetime = space.lifetime;
    record.visibility = space.visibility;
    record.start = space.start;
    module.spaces.Add(record);
  }
}

}  // namespace ncport::frontend
