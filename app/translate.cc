#include "app/ncport.h"
#include "app/pipeline.h"

namespace ncport {

// No target has a writer for whole programs yet: each one is refused by its name.
Status Translate(Context& context, const std::vector<Input>& inputs, const TranslateOptions& options,
                 OutputSink& output) {
  (void)output;
  std::string target_name = options.to;
  if (target_name.empty() && options.config != nullptr) target_name = options.config->to.value_or("");
  if (target_name.empty()) {
    context.findings.Report(diag::Code::kNoProfile, SourceRange{}, "the output").help = "name the target with --to";
    return Failure{};
  }
  NCPORT_TRY_ASSIGN(const dialects::Profile target,
                    dialects::LoadProfile(target_name, context.files, context.findings));
  NCPORT_TRY_ASSIGN(const dialects::Profile source,
                    app::ChooseProfile(context, inputs.front(), options, app::ProfileNeed::kNamed));
  context.findings.Report(diag::Code::kNotExpressible, SourceRange{}, "a program of " + source.name, target.name).help =
      "this version writes flat blocks only: ncport flatten --to iso-mill or iso-lathe";
  return Failure{};
}

}  // namespace ncport
