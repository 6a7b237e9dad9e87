// Reads one file of flat blocks into the module. Card: docs/languages/iso.md.
#pragma once

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "dialects/profile.h"
#include "frontend/reader.h"
#include "ir/module.h"

namespace ncport::frontend::iso {

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink);

}  // namespace ncport::frontend::iso
