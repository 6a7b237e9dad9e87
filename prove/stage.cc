#include "prove/stage.h"

#include <algorithm>
#include <cmath>

#include "ir/builder.h"

namespace ncport::prove {

namespace {

/// The groups that the callers of a subprogram promise.
void Promise(const ir::ModalState& entry, ir::ModalState& start) {
  const auto take = [](auto promised, auto& group) {
    if (promised != decltype(promised){}) group = promised;
  };
  take(entry.motion, start.motion);
  take(entry.plane, start.plane);
  take(entry.distance, start.distance);
  take(entry.feed_mode, start.feed_mode);
  take(entry.speed_mode, start.speed_mode);
  take(entry.units, start.units);
  take(entry.path, start.path);
  take(entry.return_level, start.return_level);
}

}  // namespace

Stage::Stage(const Side& side, const std::vector<BoundInput>& inputs, bool source)
    : module_(*side.module), machine_(*side.machine), entry_(side.entry_state) {
  LeaveToOperator(machine_.start);
  if (side.is_call) Promise(entry_, machine_.start);
  clean_start_ = machine_.start;
  clean_position_known_ = machine_.position_known;
  options_.entry = side.entry;
  options_.is_call = side.is_call;
  options_.report_variables = true;
  options_.start_position_known = side.start_axes != 0;
  options_.start_axes = side.start_axes;
  std::copy(std::begin(side.start_position), std::end(side.start_position), options_.start_position);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (const InputPlace& place : source ? inputs[i].source : inputs[i].target) Bind(place, i);
  }
  clean_start_values_ = options_.start_values.size();
  linked_ = std::make_unique<exec::Linked>(module_, machine_);
}

void Stage::Bind(const InputPlace& place, std::size_t input) {
  if (!place.callee.Valid()) {
    exec::StartValue start;
    start.space = place.space;
    start.cell = place.cell;
    cells_.emplace_back(options_.start_values.size(), input);
    options_.start_values.push_back(start);
    return;
  }
  if (place.callee == options_.entry) {
    exec::EntryArgument argument;
    argument.position = place.position;
    argument.letter = place.letter;
    arguments_.push_back({{}, options_.arguments.size(), input, place.letter != 0, place.truth});
    options_.arguments.push_back(argument);
    return;
  }
  // Expressions stand before the nodes that use them; arguments have none, so their literals may stand at the end.
  // Only the calls of the entry: those below it compute their arguments from what they were given.
  ir::ExprBuilder make(module_);
  std::vector<ir::CallId> calls;
  for (const ir::BlockId block : module_.programs[options_.entry].blocks) {
    for (const ir::WordId word : module_.blocks[block].words) {
      const ir::WordOp op = module_.words[word].op;
      const auto call = module_.words[word].Extra<ir::CallId>();
      if ((op == ir::WordOp::kCall || op == ir::WordOp::kModalCall) && call.Valid()) calls.push_back(call);
    }
  }
  for (const ir::CallId id : calls) {
    ir::Call call = module_.calls[id];
    if (call.program != place.callee) continue;
    const ir::ExprId literal = make.Literal(0);
    arguments_.push_back({literal, 0, input, place.letter != 0, place.truth});
    bool found = false;
    for (const ir::ArgId arg : call.args) {
      ir::Arg& given = module_.args[arg];
      if ((given.letter != 0) != (place.letter != 0) || given.position != place.position) continue;
      given.value = literal;
      given.increments = false;
      found = true;
    }
    if (found) continue;
    // The call leaves this argument out: it gets one.
    IdRange<ir::ArgId> args{static_cast<std::uint32_t>(module_.args.Size()), call.args.count + 1};
    for (const ir::ArgId arg : call.args) {
      const ir::Arg kept = module_.args[arg];
      module_.args.Add(kept);
    }
    ir::Arg added;
    added.position = place.position;
    added.letter = place.letter;
    added.value = literal;
    module_.args.Add(added);
    call.args = args;
    module_.calls[id] = call;
  }
}

void Stage::Set(const ParameterSet& set) {
  for (const Argument& argument : arguments_) {
    const double value = set[argument.input];
    const bool missing = value == kMissing;
    const double number = argument.truth ? (missing ? 0 : 1) : (missing ? 0 : value);
    const bool empty = missing && argument.letter;
    if (!argument.literal.Valid()) {
      options_.arguments[argument.index].value = empty ? exec::Value::Vacant() : exec::Value::Real(number);
      continue;
    }
    ir::Expr& expr = module_.exprs[argument.literal];
    expr.op = empty ? ir::ExprOp::kVacant : ir::ExprOp::kLiteral;
    expr.number = number;
  }
  for (const auto& [cell, input] : cells_) options_.start_values[cell].value = exec::Value::Real(set[input]);
}

exec::Outcome Stage::Run(std::uint16_t skip_levels, std::uint64_t max_blocks, RecordedTrace& trace, diag::Sink& sink,
                         exec::Coverage* coverage) {
  trace.Clear();
  options_.skip_levels = skip_levels;
  options_.max_blocks = max_blocks;
  exec::NoEnvironment environment;
  return exec::Run(*linked_, options_, environment, trace, sink, coverage).outcome;
}

void Stage::Poison(Random& random, const VerifyOptions& options) {
  ir::ModalState& start = machine_.start;
  start.motion = static_cast<ir::Motion>(2 + random.Below(2));
  start.plane = static_cast<ir::Plane>(1 + random.Below(3));
  if (options.poison_distance) start.distance = static_cast<ir::Distance>(1 + random.Below(2));
  start.feed_mode = static_cast<ir::FeedMode>(1 + random.Below(2));
  start.speed_mode = static_cast<ir::SpeedMode>(1 + random.Below(2));
  start.units = static_cast<ir::Units>(1 + random.Below(2));
  start.comp = ir::CutterComp::kOff;
  if (options_.is_call) Promise(entry_, start);
  start.work_offset = {};  // whichever the program before left
  machine_.position_known = false;
  for (const ir::SpaceId space : options.garbage) {
    const ir::Space& cells = module_.spaces[space];
    for (std::uint32_t cell = std::max(cells.first, 1U); cell <= cells.last && cell < cells.first + 1000; ++cell) {
      // A cell that is an input of the program has its value.
      const auto end = options_.start_values.begin() + static_cast<std::ptrdiff_t>(clean_start_values_);
      if (std::any_of(options_.start_values.begin(), end,
                      [&](const exec::StartValue& known) { return known.space == space && known.cell == cell; }))
        continue;
      exec::StartValue value;
      value.space = space;
      value.cell = cell;
      value.value = exec::Value::Real(std::round(random.Between(-999, 999) * 1000) / 1000);
      options_.start_values.push_back(value);
    }
  }
}

void Stage::Unpoison() {
  machine_.start = clean_start_;
  machine_.position_known = clean_position_known_;
  options_.start_values.resize(clean_start_values_);
}

}  // namespace ncport::prove
