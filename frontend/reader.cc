#include "frontend/reader.h"

#include "frontend/sinumerik/reader.h"

namespace ncport::frontend {

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink) {
  while (module.file_names.size() <= file.value) module.file_names.emplace_back();
  module.file_names[file.value] = module.strings.Intern(files.Name(file));
  switch (profile.language) {
    case dialects::Language::kSinumerik:
      return sinumerik::ReadFile(files, file, profile, options, module, sink);
    case dialects::Language::kFanuc:
    case dialects::Language::kNum:
    case dialects::Language::kLinuxCnc:
    case dialects::Language::kIso: break;
  }
  sink.Report(diag::Code::kUnreadLanguage, {file, 0, 0, 0}, dialects::NameOf(profile.language));
  return Failure{};
}

}  // namespace ncport::frontend
