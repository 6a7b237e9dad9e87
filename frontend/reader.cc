#include "frontend/reader.h"

#include <unordered_set>

#include "frontend/common/program_names.h"
#include "frontend/fanuc/reader.h"
#include "frontend/fanuc/resolve.h"
#include "frontend/iso/reader.h"
#include "frontend/sinumerik/reader.h"
#include "frontend/sinumerik/resolve.h"

namespace ncport::frontend {

Status ReadFile(const SourceFiles& files, FileId file, const dialects::Profile& profile, const ReadOptions& options,
                ir::Module& module, diag::Sink& sink) {
  while (module.file_names.size() <= file.value) module.file_names.emplace_back();
  module.file_names[file.value] = module.strings.Intern(files.Name(file));
  switch (profile.language) {
    case dialects::Language::kSinumerik:
      return sinumerik::ReadFile(files, file, profile, options, module, sink);
    case dialects::Language::kIso:
      return iso::ReadFile(files, file, profile, options, module, sink);
    case dialects::Language::kFanuc:
      return fanuc::ReadFile(files, file, profile, options, module, sink);
    case dialects::Language::kNum:
    case dialects::Language::kLinuxCnc:
      break;
  }
  sink.Report(diag::Code::kUnreadLanguage, {file, 0, 0, 0}, dialects::NameOf(profile.language));
  return Failure{};
}

namespace {

/// `known`: programs of the module as calls of the language name them.
template <class Index>
std::vector<StringId> CalleesNotIn(const Index& known, const ir::Module& module) {
  std::vector<StringId> unknown;
  std::unordered_set<std::uint32_t> seen;
  for (const ir::Call& call : module.calls.All()) {
    StringId name = call.name;
    // CALL "name": the text is the name.
    if (!name.Valid() && call.name_expr.Valid() && module.exprs[call.name_expr].op == ir::ExprOp::kText)
      name.value = module.exprs[call.name_expr].a;
    if (!name.Valid() || call.program.Valid() || !seen.insert(name.value).second) continue;
    if (!known.Find(module.View(name)).Valid()) unknown.push_back(name);
  }
  return unknown;
}

}  // namespace

std::vector<StringId> UnknownCallees(const ir::Module& module, dialects::Language language) {
  if (module.calls.Empty()) return {};
  if (language == dialects::Language::kSinumerik) return CalleesNotIn(sinumerik::ProgramIndex(module), module);
  return CalleesNotIn(ProgramNames(module), module);
}

void ResolveNames(SourceFiles& files, ir::Module& module, const dialects::Profile& profile, diag::Sink& sink) {
  switch (profile.language) {
    case dialects::Language::kSinumerik:
      sinumerik::ResolveNames(files, module, profile, sink);
      return;
    case dialects::Language::kFanuc:
      fanuc::ResolveNames(module, profile, sink);
      return;
    case dialects::Language::kNum:
    case dialects::Language::kLinuxCnc:
    case dialects::Language::kIso:
      return;
  }
}

}  // namespace ncport::frontend
