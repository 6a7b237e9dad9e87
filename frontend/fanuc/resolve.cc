#include "frontend/fanuc/resolve.h"

#include <charconv>
#include <string>
#include <unordered_set>

#include "dialects/finding_alarms.h"
#include "frontend/common/program_names.h"
#include "frontend/fanuc/reader.h"

namespace ncport::frontend::fanuc {

namespace {

using ir::WordOp;

class Resolver {
 public:
  Resolver(ir::Module& module, const dialects::Profile& profile, diag::Sink& sink)
      : module_(module), profile_(profile), names_(module), sink_(sink) {}

  void Run() {
    for (const ir::ProgramId program : module_.programs.Ids()) {
      for (const ir::BlockId block : module_.programs[program].blocks) {
        for (const ir::WordId id : module_.blocks[block].words) {
          const ir::Word& word = module_.words[id];
          if (word.op != WordOp::kCall && word.op != WordOp::kModalCall) continue;
          const auto call = word.Extra<ir::CallId>();
          if (call.Valid()) Call(program, block, word, module_.calls[call]);
        }
      }
    }
  }

 private:
  void Call(ir::ProgramId program, ir::BlockId block, const ir::Word& word, ir::Call& call) {
    if (call.program.Valid() || call.name_expr.Valid()) return;
    if (!call.name.Valid()) {
      if (call.from_block) call.program = program;
      return;
    }
    const std::string_view name = module_.View(call.name);
    call.program = names_.Find(name);
    if (!call.program.Valid()) Split(name, call);
    if (!call.program.Valid() && missing_.insert(call.name.value).second) {
      // The block stays: a run that gets there ends in the alarm of the control.
      diag::Diagnostic& finding =
          sink_.Report(diag::Code::kUnknownProgram, module_.RangeOf(module_.blocks[block], word), name);
      finding.help = "give its file too, or name its folder with -I";
      finding.control = dialects::AlarmFor(profile_, finding.code);
    }
  }

  void Split(std::string_view name, ir::Call& call) {
    std::uint32_t number = 0;
    const char* end = name.data() + name.size();
    const bool packed = name.size() > 5 && name[0] == 'O' && std::from_chars(name.data() + 1, end, number).ptr == end;
    if (!packed || call.new_level || call.passes.Valid() || number % 10000 == 0) return;
    const std::string plain = ProgramName(number % 10000);
    const ir::ProgramId found = names_.Find(plain);
    if (!found.Valid()) return;
    call.program = found;
    call.name = module_.strings.Intern(plain);
    ir::Expr passes;
    passes.type = ir::Type::kReal;
    passes.flags = ir::Expr::kImplicit;
    passes.format.flags = ir::NumberFormat::kComputed;
    passes.number = number / 10000;
    call.passes = module_.AddExpr(passes);
  }

  ir::Module& module_;
  const dialects::Profile& profile_;
  ProgramNames names_;
  diag::Sink& sink_;
  std::unordered_set<std::uint32_t> missing_;
};

}  // namespace

void ResolveNames(ir::Module& module, const dialects::Profile& profile, diag::Sink& sink) {
  Resolver(module, profile, sink).Run();
}

}  // namespace ncport::frontend::fanuc
