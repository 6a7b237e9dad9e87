#include "ir/analysis/value_range.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <unordered_map>

#include "ir/analysis/main_programs.h"
#include "ir/analysis/value_flow.h"

namespace ncport::ir::analysis {

namespace {

/// Everything that one start reaches.
class StartAnalysis final : public CallHandler {
 public:
  StartAnalysis(const Module& module, const Machine& machine, const FlowGraphs& graphs, const CallGraph& calls,
                const RangeOptions& options, ProgramId start, std::uint32_t contexts_per_program,
                std::unordered_map<std::uint32_t, std::unique_ptr<FlowPlan>>& plans)
      : module_(module),
        machine_(machine),
        graphs_(graphs),
        call_graph_(calls),
        options_(options),
        start_(start),
        contexts_per_program_(contexts_per_program),
        plans_(plans),
        slots_(module, calls, start, machine.program_variables_visible) {
    std::uint64_t blocks = 0;
    for (const ProgramId program : slots_.Programs()) blocks += module.programs[program].blocks.count;
    constexpr std::uint64_t kLeast = 20'000;
    budget_.most = kLeast + blocks * options.steps_per_block;
  }

  /// False: the budget was too small.
  bool Run() {
    Context& context = NewContext(start_);
    context.open = true;
    context.entry = EntryOfStart(context);
    Solve(context);
    return !budget_.Spent();
  }

  void Replay(RangeObserver& observer) {
    budget_.most = ~std::uint64_t{0};
    // Callees first is of no use to rules; the order of the text is.
    std::vector<Context*> order;
    for (const auto& context : contexts_) order.push_back(context.get());
    std::ranges::stable_sort(order, {}, [](const Context* context) { return context->program.value; });
    for (Context* context : order) FlowOf(context->program).Replay(*context, observer);
  }

  [[nodiscard]] std::uint64_t Steps() const { return budget_.steps; }
  [[nodiscard]] std::uint32_t Contexts() const { return static_cast<std::uint32_t>(contexts_.size()); }

  void Through(Context& caller, const Call& call, CallId id, bool modal, ValueTransfer& transfer, bool enter) override;

 private:
  Context& NewContext(ProgramId program) {
    contexts_.push_back(std::make_unique<Context>());
    contexts_.back()->program = program;
    return *contexts_.back();
  }

  void Solve(Context& context) {
    if (budget_.Spent()) return;
    context.active = true;
    // A flow of its own for each depth: the callee may be analysed while the caller is.
    ValueFlow(module_, machine_, slots_, graphs_.Of(context.program), PlanOf(context.program), *this, budget_)
        .Solve(context);
    context.active = false;
  }

  ValueFlow FlowOf(ProgramId program) {
    return ValueFlow(module_, machine_, slots_, graphs_.Of(program), PlanOf(program), *this, budget_);
  }

  const FlowPlan& PlanOf(ProgramId program) {
    std::unique_ptr<FlowPlan>& plan = plans_[program.value];
    if (plan == nullptr) plan = std::make_unique<FlowPlan>(module_, graphs_.Of(program));
    return *plan;
  }

  ValueState EntryOfStart(const Context& context);
  /// Nothing known of arguments and cells.
  ValueState EntryUnknown(const Context& context);
  Context& OpenContext(ProgramId program);
  Context* ContextOf(Context& caller, CallId id, ProgramId program, bool modal);
  void EvalArguments(const Call& call, ProgramId program, ValueTransfer& transfer, ValueState& entry, Context& context);
  void ThroughUnknown(const Call& call, ValueTransfer& transfer);
  void KeepParameters(Context& context, const std::vector<VariableId>& kept);
  [[nodiscard]] Interval StartOf(const Slot& slot) const;
  [[nodiscard]] Interval ZeroOf(Type type) const;

  const Module& module_;
  const Machine& machine_;
  const FlowGraphs& graphs_;
  const CallGraph& call_graph_;
  const RangeOptions& options_;
  ProgramId start_;
  std::uint32_t contexts_per_program_;
  std::unordered_map<std::uint32_t, std::unique_ptr<FlowPlan>>& plans_;
  SlotMap slots_;
  ValueFlow::Budget budget_;
  std::vector<std::unique_ptr<Context>> contexts_;
  std::unordered_map<std::uint32_t, Context*> open_;                     // per program
  std::unordered_map<std::uint32_t, std::vector<Context*>> by_program_;  // without open ones
};

Interval StartAnalysis::ZeroOf(Type type) const {
  Interval zero = Interval::Point(0);
  switch (type) {
    case Type::kInt:
    case Type::kBool:
    case Type::kChar:
      zero.flags |= Interval::kInteger;
      return zero;
    case Type::kReal:
      return zero;
    default:
      return AllOf(type, machine_, 0);
  }
}

Interval StartAnalysis::StartOf(const Slot& slot) const {
  const Space& space = module_.spaces[SpaceId{std::size_t{slot.id}}];
  if (space.start == StartValue::kVacant || space.type == Type::kNumber) {
    Interval vacant = Interval::None();
    vacant.flags = Interval::kVacant;
    return vacant;
  }
  return ZeroOf(space.type);
}

ValueState StartAnalysis::EntryUnknown(const Context& context) {
  ValueTransfer transfer(module_, machine_, slots_);
  transfer.Enter(context, false, false);
  ValueState entry;
  entry.reached = true;
  for (const Slot& slot : slots_.Shared()) entry.cells.push_back(transfer.UnknownOf(slot, Interval::kInput));
  for (const Slot& slot : slots_.LocalsOf(context.program)) {
    const bool parameter = slot.kind == SlotKind::kVariable &&
                           module_.variables[VariableId{std::size_t{slot.id}}].scope == Scope::kParameter;
    entry.cells.push_back(transfer.UnknownOf(slot, parameter ? Interval::kInput : std::uint8_t{0}));
  }
  return entry;
}

ValueState StartAnalysis::EntryOfStart(const Context& context) {
  ValueState entry = EntryUnknown(context);
  const bool main = StartsAsMain(module_, context.program);
  const std::vector<Slot>& shared = slots_.Shared();
  for (std::uint32_t i = 0; i < shared.size(); ++i) {
    if (!shared[i].level) continue;
    if (main) {
      entry.cells[i] = StartOf(shared[i]);
    } else {
      entry.cells[i].flags |= Interval::kEntry;
    }
  }
  for (const VariableId parameter : module_.programs[context.program].parameters) {
    const std::uint32_t slot = slots_.Of(parameter);
    if (slot == SlotMap::kNone) continue;
    entry.cells[slot].flags |= Interval::kEntry;
    for (const DeclaredRange& declared : options_.declared) {
      if (declared.parameter != parameter || !(declared.low <= declared.high)) continue;
      // A call that leaves it out passes 0, whatever is promised of the others.
      const Interval promised{std::fmin(declared.low, 0), std::fmax(declared.high, 0), Interval::kEntry};
      entry.cells[slot] = Converted(promised, module_.variables[parameter].type, machine_);
    }
  }
  for (const DeclaredCell& declared : options_.declared_cells) {
    if (declared.program.Valid() && declared.program != context.program) continue;
    const std::uint32_t slot = slots_.Of(declared.space, declared.cell);
    if (slot == SlotMap::kNone || !(declared.low <= declared.high)) continue;
    entry.cells[slot] = {declared.low, declared.high, Interval::kEntry};
  }
  return entry;
}

/// The one way into a program that all calls share which are not told apart: recursive ones, and those beyond the
/// budget.
Context& StartAnalysis::OpenContext(ProgramId program) {
  Context*& context = open_[program.value];
  if (context == nullptr) {
    context = &NewContext(program);
    context->open = true;
    context->entry = EntryUnknown(*context);
    context->shared_references = true;
  }
  return *context;
}

Context* StartAnalysis::ContextOf(Context& caller, CallId id, ProgramId program, bool modal) {
  std::vector<Context*>& known = by_program_[program.value];
  for (Context* context : known) {
    if (context->caller == &caller && context->call == id && context->modal == modal) return context;
  }
  if (known.size() >= contexts_per_program_) return nullptr;
  Context& context = NewContext(program);
  context.caller = &caller;
  context.call = id;
  context.modal = modal;
  known.push_back(&context);
  return &context;
}

/// Arguments into the parameters of `entry`.
void StartAnalysis::EvalArguments(const Call& call, ProgramId program, ValueTransfer& transfer, ValueState& entry,
                                  Context& context) {
  const IdRange<VariableId> parameters = module_.programs[program].parameters;
  for (std::uint32_t i = 0; i < parameters.count; ++i) {
    const Variable& parameter = module_.variables[parameters[i]];
    const std::uint32_t slot = slots_.Of(parameters[i]);
    if (slot == SlotMap::kNone) continue;
    Interval value = ZeroOf(parameter.type);
    if (parameter.initial.Valid()) {
      const Interval initial = transfer.Eval(parameter.initial);
      value = initial.HasNumber() ? Converted(initial, parameter.type, machine_)
                                  : AllOf(parameter.type, machine_, Interval::kInput);
    }
    entry.cells[slot] = value;
  }
  std::set<std::uint32_t> references;
  for (const ArgId arg_id : call.args) {
    const Arg& arg = module_.args[arg_id];
    Interval value = Interval::None();
    value.flags = Interval::kVacant;
    if (arg.value.Valid()) value = transfer.Eval(arg.value);
    if (arg.increments) value = Interval::Unknown();
    if (arg.letter != 0) {
      const std::vector<Slot>& shared = slots_.Shared();
      for (std::uint32_t i = 0; i < shared.size(); ++i) {
        if (shared[i].kind == SlotKind::kCell && shared[i].level && shared[i].number == arg.position)
          entry.cells[i] = value;
      }
      continue;
    }
    if (!arg.value.Valid() || arg.position >= parameters.count) continue;
    const Variable& parameter = module_.variables[parameters[arg.position]];
    const std::uint32_t slot = slots_.Of(parameters[arg.position]);
    if (slot == SlotMap::kNone) continue;
    if (parameter.by_reference) {
      const Expr& place = module_.exprs[arg.value];
      const bool own = place.op == ExprOp::kVariable || place.op == ExprOp::kElement;
      const std::uint32_t of = own ? slots_.Of(VariableId{std::size_t{place.a}}) : SlotMap::kNone;
      // Two names for one variable, or one that the callee sees by its own name.
      if (of == SlotMap::kNone || of < slots_.Shared().size() || !references.insert(of).second)
        context.shared_references = true;
      entry.cells[slot] = value.HasNumber() ? value : AllOf(parameter.type, machine_, Interval::kInput);
      continue;
    }
    entry.cells[slot] = transfer.ConvertedTo(arg.value, parameter.type, value);
  }
}

void StartAnalysis::ThroughUnknown(const Call& call, ValueTransfer& transfer) {
  for (const ArgId arg_id : call.args) {
    const Arg& arg = module_.args[arg_id];
    if (arg.value.Valid()) (void)transfer.Eval(arg.value);
    if (arg.value.Valid() && arg.letter == 0) transfer.ForgetPlace(arg.value);
  }
  transfer.Forget(call.form == CallForm::kBlockRange, !call.new_level);
}

/// The first run begins with what the call gives. What it leaves in its parameters is what the next one begins with:
/// where that is more, it can be anything.
void StartAnalysis::KeepParameters(Context& context, const std::vector<VariableId>& kept) {
  if (!context.exit.reached) return;
  ValueState entry = context.entry;
  for (const VariableId parameter : kept) {
    const std::uint32_t slot = slots_.Of(parameter);
    entry.cells[slot] = Join(entry.cells[slot], context.exit.cells[slot]);
  }
  if (ValueState joined = context.entry; !JoinInto(joined, entry)) return;
  for (const VariableId parameter : kept)
    entry.cells[slots_.Of(parameter)] = AllOf(module_.variables[parameter].type, machine_, Interval::kInput);
  (void)JoinInto(context.entry, entry);
  Solve(context);
}

void StartAnalysis::Through(Context& caller, const Call& call, CallId id, bool modal, ValueTransfer& transfer,
                            bool enter) {
  if (call.name_expr.Valid()) (void)transfer.Eval(call.name_expr);
  Interval passes = Interval::Point(1);
  if (call.passes.Valid()) passes = transfer.Eval(call.passes);
  const ProgramId program = call.program;
  if (!program.Valid() || call.form == CallForm::kBlockRange || !slots_.Knows(program)) {
    if (!modal) ThroughUnknown(call, transfer);
    return;
  }
  const bool recursive = call_graph_.Recursive(program);
  const bool from_block = call.from_block;
  Context* context = recursive || from_block ? nullptr : ContextOf(caller, id, program, modal);
  if (context == nullptr) {
    Context& open = OpenContext(program);
    if (enter && open.runs == 0 && !open.active) Solve(open);
    if (modal) return;
    const bool returns = recursive || open.exit.reached;
    ThroughUnknown(call, transfer);
    if (!recursive && !returns) transfer.State().reached = false;
    return;
  }
  context->block = transfer.Site().block;
  const std::size_t shared = slots_.Shared().size();
  ValueState& state = transfer.State();
  ValueState entry;
  entry.reached = true;
  entry.cells.assign(state.cells.begin(), state.cells.begin() + static_cast<std::ptrdiff_t>(shared));
  for (std::uint32_t i = 0; i < shared; ++i) {
    if (slots_.Shared()[i].level && call.new_level) entry.cells[i] = StartOf(slots_.Shared()[i]);
  }
  for (const Slot& slot : slots_.LocalsOf(program)) entry.cells.push_back(transfer.UnknownOf(slot, 0));
  EvalArguments(call, program, transfer, entry, *context);
  const bool repeats = !(passes.IsPoint() && passes.low == 1);
  std::vector<VariableId> kept;  // a later run finds these as the one before left them
  if (repeats || modal) {
    // Cells are as the passes before, or the blocks between, left them.
    for (std::uint32_t i = 0; i < shared; ++i) {
      const Slot& slot = slots_.Shared()[i];
      const bool argument = slot.level && call.new_level && !modal && !machine_.passes_keep_locals;
      if (!argument) entry.cells[i] = transfer.UnknownOf(slot, Interval::kInput);
    }
    context->keeps_locals = modal ? machine_.modal_call_keeps_locals : machine_.passes_keep_locals;
    for (const VariableId parameter : module_.programs[program].parameters) {
      const std::uint32_t slot = slots_.Of(parameter);
      const bool changed =
          module_.variables[parameter].by_reference || (context->keeps_locals && slots_.IsWritten(parameter));
      if (slot == SlotMap::kNone || !changed) continue;
      if (module_.variables[parameter].by_reference) {
        entry.cells[slot] = AllOf(module_.variables[parameter].type, machine_, Interval::kInput);
      } else {
        kept.push_back(parameter);
      }
    }
    if (modal) context->shared_references = true;
  }
  const bool grew = enter && JoinInto(context->entry, entry);
  if (enter && (grew || context->runs == 0) && !context->active) {
    Solve(*context);
    KeepParameters(*context, kept);
  }
  if (modal) return;
  if (!context->exit.reached) {
    state.reached = false;
    return;
  }
  for (std::uint32_t i = 0; i < shared; ++i) {
    if (!slots_.Shared()[i].level || !call.new_level) state.cells[i] = context->exit.cells[i];
  }
  const IdRange<VariableId> parameters = module_.programs[program].parameters;
  for (const ArgId arg_id : call.args) {
    const Arg& arg = module_.args[arg_id];
    if (arg.letter != 0 || !arg.value.Valid() || arg.position >= parameters.count) continue;
    if (!module_.variables[parameters[arg.position]].by_reference) continue;
    const std::uint32_t slot = slots_.Of(parameters[arg.position]);
    if (context->shared_references || slot == SlotMap::kNone) {
      transfer.ForgetPlace(arg.value);
    } else {
      transfer.Put(arg.value, context->exit.cells[slot]);
    }
  }
}

/// Programs that a run may start in: main ones, and those that nothing calls.
std::vector<ProgramId> StartsOf(const Module& module, const CallGraph& calls) {
  std::set<std::uint32_t> called;
  for (const CallSite& site : calls.AllSites()) {
    if (site.callee.Valid() && site.callee != site.caller) called.insert(site.callee.value);
  }
  // A name that only the run knows may be any of them.
  bool open = false;
  for (const Call& call : module.calls.All()) open = open || (call.form == CallForm::kText && !call.program.Valid());
  std::vector<ProgramId> starts;
  for (const ProgramId program : module.programs.Ids()) {
    const Program& record = module.programs[program];
    if (record.library) continue;
    if (open || StartsAsMain(module, program) || !called.contains(program.value)) starts.push_back(program);
  }
  return starts;
}

}  // namespace

RangeStatistics FindValueRanges(const Module& module, const Machine& machine, const FlowGraphs& graphs,
                                const CallGraph& calls, const RangeOptions& options, RangeObserver& observer) {
  RangeStatistics statistics;
  std::unordered_map<std::uint32_t, std::unique_ptr<FlowPlan>> plans;
  for (const ProgramId start : StartsOf(module, calls)) {
    bool solved = false;
    for (const std::uint32_t contexts : {options.contexts_per_program, 0U}) {
      StartAnalysis analysis(module, machine, graphs, calls, options, start, contexts, plans);
      solved = analysis.Run();
      if (solved) {
        analysis.Replay(observer);
        observer.StartDone();
        statistics.contexts += analysis.Contexts();
      }
      statistics.steps += analysis.Steps();
      if (solved) break;
    }
    if (!solved) ++statistics.given_up;
  }
  return statistics;
}

}  // namespace ncport::ir::analysis
