// Programs as a whole: definitions, start, end, the set of cells.
#include <fmt/format.h>

#include "dialects/machine.h"
#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::Type;

namespace {

// Blocks of cells by class: enough for computed indices.
struct CellRow {
  Range range;
  std::uint32_t offset;
};
constexpr CellRow kCells[] = {{Range::kLength, 1},    {Range::kPositive, 6}, {Range::kWhole, 11}, {Range::kAngle, 16},
                              {Range::kFraction, 21}, {Range::kTruth, 26},   {Range::kFeed, 31}};
constexpr std::uint32_t kCellsEach = 4;
constexpr std::uint32_t kFirstCounterCell = 60;
constexpr std::uint32_t kFirstLocalCell = 27;  // no argument reaches those behind it (fanuc-7.3)

}  // namespace

Maker::Maker(std::uint64_t seed, const Options& options)
    : options_(options),
      random_(seed),
      machine_(dialects::MachineFor(*options.profile)),
      module_(sample_.module),
      expr_(sample_.module) {}

Sample Generate(std::uint64_t seed, const Options& options) { return Maker(seed, options).Make(); }

Sample Maker::Make() {
  MakeSpaces();
  ReadLibrary();
  MakeCells();
  drift_limit_ = 150;
  ChooseInitial();
  budget_ = options_.executed_blocks;
  const std::uint32_t subs = Draw(Feature::kSubprograms) ? 1 + random_.Below(options_.subprograms) : 0;
  for (std::uint32_t i = 0; i < subs; ++i) MakeSubprogram(i);
  MakeMain();
  return std::move(sample_);
}

void Maker::ChooseInitial() {
  ir::ModalState& modes = initial_.modes;
  const bool lathe = TransverseAxis() != 0xFF;
  modes.plane = lathe || !HasAxis(1) ? ir::Plane::kZX : ir::Plane::kXY;
  modes.distance = ir::Distance::kAbsolute;
  modes.units = IsSinumerik() ? ir::Units::kMmGeometry : ir::Units::kMm;
  modes.feed_mode = ir::FeedMode::kPerMinute;
  modes.speed_mode = ir::SpeedMode::kRpm;
  if (lathe) modes.diameter = IsSinumerik() && random_.Percent(30) ? ir::Diameter::kRadius : ir::Diameter::kDiameter;
  initial_.feed = true;
  // Lathes of system A have no word for the distance mode; on mills G91 is switched off again where it is switched on.
  if (!IsSinumerik()) initial_.fixed = kDistanceGroup | kDiameterGroup;
  if (!Has(Feature::kUnits)) initial_.fixed |= kUnitsGroup;
  if (!Has(Feature::kSurfaceSpeed) && !Has(Feature::kFeedMode)) initial_.fixed |= kFeedGroup;
  initial_.turned = Turned::kNo;
  initial_.frame_clear = true;
}

void Maker::MakeSpaces() {
  for (const dialects::VariableSpace& space : options_.profile->variables) {
    const ir::SpaceId id =
        ir::AddSpace(module_, space.name, space.range.first, space.range.last, space.type, space.start);
    module_.spaces[id].lifetime = space.lifetime;
    module_.spaces[id].visibility = space.visibility;
    if (!cell_space_.Valid() && space.visibility == ir::Visibility::kAll) cell_space_ = id;
    if (!local_space_.Valid() && space.visibility == ir::Visibility::kLevel) local_space_ = id;
  }
  pi_ = ir::AddSystem(module_, "$PI", ir::SystemKind::kPi);
  programmed_position_ = ir::AddSystem(module_, "$P_EP", ir::SystemKind::kProgrammedPosition);
}

void Maker::MakeCells() {
  const std::uint32_t base = module_.spaces[cell_space_].first;
  for (const CellRow& row : kCells) {
    if (!random_.Percent(60)) continue;
    Place place;
    place.space = cell_space_;
    place.type = module_.spaces[cell_space_].type;
    place.range = row.range;
    place.first = base + row.offset;
    place.count = 1 + random_.Below(kCellsEach);
    shared_.push_back(place);
  }
  if (!IsSinumerik() || !Has(Feature::kSystemVariables) || !random_.Percent(20)) return;
  Place memory;
  const bool real = random_.Percent(50);
  memory.system = ir::AddSystem(module_, real ? "$AC_PARAM" : "$AC_MARKER", ir::SystemKind::kUserMemory,
                                real ? Type::kReal : Type::kInt);
  module_.systems[memory.system].writable = true;
  memory.type = real ? Type::kReal : Type::kInt;
  memory.range = real ? Range::kLength : Range::kWhole;
  memory.first = 1 + random_.Below(3);
  shared_.push_back(memory);
}

Place Maker::AddLocal(Range range, Type type, bool array) {
  static constexpr std::string_view kNames[] = {"FLAG", "CNT",  "NUM",   "LEN", "POSV",
                                                "ANGV", "FRAC", "FEEDV", "TXT", "AXV"};
  const std::string name = fmt::format("{}_{}", kNames[static_cast<std::size_t>(range)], next_name_++);
  std::vector<std::uint32_t> sizes;
  if (array) {
    sizes.push_back(2 + random_.Below(3));
    if (random_.Percent(35)) sizes.push_back(2 + random_.Below(2));
  }
  Place place;
  place.variable = program_->Local(name, type, sizes);
  place.type = type;
  place.range = range;
  place.is_array = array;
  if (type == Type::kString) module_.variables[place.variable].string_length = 120;
  locals_.push_back(place);
  return place;
}

// Cells of the level: free ones of any class. They are empty at first, so that they are written before anything else.
void Maker::MakeLocalCells(std::uint32_t count) {
  static constexpr Range kKinds[] = {Range::kLength, Range::kLength, Range::kPositive, Range::kWhole,
                                     Range::kAngle,  Range::kTruth,  Range::kFraction, Range::kFeed};
  for (std::uint32_t i = 0; i < count; ++i) {
    Place place;
    place.space = local_space_;
    place.type = module_.spaces[local_space_].type;
    place.first = kFirstLocalCell + i;
    place.range = random_.Pick(kKinds);
    places_.push_back(place);
    local_cells_.push_back(place);
  }
}

// Counters: written by the frame of their loops alone.
void Maker::MakeCounterCells(std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    Place counter;
    counter.space = cell_space_;
    counter.first = module_.spaces[cell_space_].first + kFirstCounterCell + next_counter_cell_++;
    counter.type = module_.spaces[cell_space_].type;
    counter.range = Range::kCount;
    counter.writable = false;
    // Read before a loop wrote it, it could hold anything.
    counter_cells_.push_back(counter);
    places_.push_back(counter);
  }
}

void Maker::MakeLocals(std::uint32_t count) {
  struct Kind {
    Range range;
    Type type;
  };
  static constexpr Kind kKinds[] = {
      {Range::kLength, Type::kReal}, {Range::kLength, Type::kReal},   {Range::kPositive, Type::kReal},
      {Range::kWhole, Type::kInt},   {Range::kWhole, Type::kInt},     {Range::kAngle, Type::kReal},
      {Range::kTruth, Type::kBool},  {Range::kFraction, Type::kReal}, {Range::kFeed, Type::kReal},
      {Range::kText, Type::kString}, {Range::kAxis, Type::kAxis},     {Range::kFeed, Type::kInt},
      {Range::kTruth, Type::kInt},   {Range::kWhole, Type::kReal}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Kind kind = random_.Pick(kKinds);
    if (kind.range == Range::kText && !Has(Feature::kTextFunctions)) continue;
    if (kind.range == Range::kAxis && !Has(Feature::kComputedAxis)) continue;
    const bool zero = BoundsOf(kind.range).low <= 0 && kind.range != Range::kAxis && kind.range != Range::kText;
    places_.push_back(AddLocal(kind.range, kind.type, zero && Has(Feature::kAssignList) && random_.Percent(20)));
  }
  // Counters: written by the frame of their loops alone.
  for (std::uint32_t i = 0; i < 4; ++i) {
    Place counter;
    if (IsSinumerik() && random_.Percent(75)) {
      counter = AddLocal(Range::kCount, random_.Percent(70) ? Type::kInt : Type::kReal, false);
    } else {
      counter.space = cell_space_;
      counter.first = module_.spaces[cell_space_].first + kFirstCounterCell + next_counter_cell_++;
      counter.type = module_.spaces[cell_space_].type;
      counter.range = Range::kCount;
      // Read before a loop wrote it, it could hold anything.
      counter_cells_.push_back(counter);
    }
    counter.writable = false;
    places_.push_back(counter);
  }
}

// DEF blocks; neighbours of one type may share one.
void Maker::WriteDefinitions() {
  std::size_t i = 0;
  while (i < locals_.size()) {
    ir::BlockBuilder block = NewBlock();
    std::uint8_t position = 0;
    const Type type = locals_[i].type;
    do {
      const Place& place = locals_[i];
      const bool must = place.range == Range::kAxis || BoundsOf(place.range).low > 0;
      if (!place.is_array && (must || random_.Percent(40))) {
        const ir::ExprId initial = place.range == Range::kText   ? TextLiteral()
                                   : place.range == Range::kAxis ? expr_.AxisName(random_.Percent(50) ? 0 : 2)
                                   : place.range == Range::kTruth
                                       ? expr_.Literal(random_.Below(2), type == Type::kBool ? Type::kBool : Type::kInt)
                                       : As(Literal(BoundsOf(place.range)), type);
        module_.variables[place.variable].initial = initial;
      } else if (place.is_array && random_.Percent(40)) {
        ir::AssignList list;
        list.values.begin = static_cast<std::uint32_t>(module_.expr_items.size());
        const std::uint32_t count = 1 + random_.Below(module_.variables[place.variable].dimensions[0]);
        std::vector<ir::ExprId> values;
        for (std::uint32_t k = 0; k < count; ++k) {
          values.push_back(k + 1 != count && random_.Percent(15) ? ir::ExprId{}
                                                                 : As(Literal(BoundsOf(place.range)), type));
        }
        list.values.begin = static_cast<std::uint32_t>(module_.expr_items.size());
        list.values.count = count;
        module_.expr_items.insert(module_.expr_items.end(), values.begin(), values.end());
        module_.variables[place.variable].initial_list = module_.assign_lists.Add(list);
      }
      module_.variables[place.variable].definition = position++;
      Word(block, ir::WordOp::kDefine, {}, 0, place.variable.value);
      ++i;
    } while (i < locals_.size() && locals_[i].type == type && type != Type::kString && random_.Percent(60));
    Emit(block);
  }
}

void Maker::WriteLocalCells() {
  for (const Place& place : local_cells_) {
    ir::BlockBuilder block = NewBlock();
    block.Assign(expr_.Cell(place.space, place.first), As(Literal(BoundsOf(place.range)), place.type));
    Emit(block);
  }
}

// Every cell that may be read gets a value of its class first.
void Maker::WriteCellStarts() {
  const auto start = [&](ir::ExprId place, Type type, Range range) {
    ir::BlockBuilder block = NewBlock();
    block.Assign(place, As(Literal(BoundsOf(range)), type));
    Emit(block);
  };
  for (const Place& place : shared_) {
    for (std::uint32_t i = 0; i < place.count; ++i) {
      if (place.system.Valid()) {
        start(expr_.System(place.system, {expr_.Number(fmt::format("{}", place.first), Type::kInt)}), place.type,
              place.range);
      } else {
        start(expr_.Cell(place.space, place.first + i), place.type, place.range);
      }
    }
  }
  WriteLocalCells();
  for (const Place& place : counter_cells_) start(expr_.Cell(place.space, place.first), place.type, place.range);
}

// The modal words that bring the known state to `wanted`, as far as `wanted` says something.
void Maker::WriteModes(const Knowledge& wanted, bool with_frame) {
  if (with_frame && (wanted.frame_clear && !known_.frame_clear)) ResetFrame();
  const auto differs = [](auto have, auto want) { return want != decltype(want)::kUnknown && have != want; };
  const ir::ModalState& want = wanted.modes;
  if (differs(known_.modes.plane, want.plane) || differs(known_.modes.distance, want.distance) ||
      differs(known_.modes.units, want.units) || differs(known_.modes.diameter, want.diameter)) {
    ir::BlockBuilder block = NewBlock();
    if (differs(known_.modes.plane, want.plane)) SetPlane(block, want.plane);
    if (differs(known_.modes.distance, want.distance)) SetDistance(block, want.distance);
    if (differs(known_.modes.units, want.units)) SetUnits(block, want.units);
    if (differs(known_.modes.diameter, want.diameter)) SetDiameter(block, want.diameter);
    Emit(block);
  }
  if (differs(known_.modes.speed_mode, want.speed_mode)) {
    ir::BlockBuilder block = NewBlock();
    SetRpm(block);
    Emit(block);
  }
  if (differs(known_.modes.feed_mode, want.feed_mode) || (wanted.feed && !known_.feed)) {
    ir::BlockBuilder block = NewBlock();
    if (differs(known_.modes.feed_mode, want.feed_mode)) SetFeedMode(block, want.feed_mode);
    if (wanted.feed) AddFeed(block);
    Emit(block);
  }
}

Knowledge Maker::RandomEntry() {
  Knowledge entry = initial_;
  std::uint32_t forgotten = kMotionGroup | kPathGroup | kOffsetGroup;
  for (std::uint32_t group = 1; group < kAllGroups; group <<= 1U) {
    if (random_.Percent(50)) forgotten |= group;
  }
  entry.Forget(forgotten);
  return entry;
}

// What main programs write first: all groups that later blocks rely on.
void Maker::WriteStart() {
  WriteCellStarts();
  const std::uint32_t fixed = initial_.fixed;
  known_ = initial_;
  known_.Forget(kAllGroups);
  known_.fixed = fixed;
  ir::BlockBuilder modes = NewBlock();
  SetPlane(modes, initial_.modes.plane);
  if (IsSinumerik() || TransverseAxis() == 0xFF) SetDistance(modes, initial_.modes.distance);
  SetUnits(modes, initial_.modes.units);
  SetFeedMode(modes, initial_.modes.feed_mode);
  if (IsSinumerik() && initial_.modes.diameter != ir::Diameter::kUnknown) SetDiameter(modes, initial_.modes.diameter);
  Code(modes, ir::WordOp::kCutterComp, static_cast<std::uint8_t>(ir::CutterComp::kOff));
  if (Has(Feature::kWorkOffset)) Code(modes, ir::WordOp::kWorkOffset, 0, 54);
  Emit(modes);
  ResetFrame();
  if (Has(Feature::kTool)) MakeTool();
  ir::BlockBuilder spindle = NewBlock();
  Word(spindle, ir::WordOp::kSpeed, Literal({200, 3000, true}).id);
  Code(spindle, ir::WordOp::kSpindle, 0, static_cast<std::uint32_t>(ir::SpindleState::kCw));
  AddFeed(spindle);
  Emit(spindle);
  known_.modes.speed_mode = ir::SpeedMode::kRpm;
  // From here on each axis stands somewhere.
  Approach(AllAxes());
}

void Maker::MakeMain() {
  ir::ProgramBuilder program(module_, IsSinumerik() ? "mainprog" : "1000", ir::ProgramKind::kMain,
                             ir::AddFile(module_, IsSinumerik() ? "mainprog.mpf" : "1000.nc"));
  program_ = &program;
  in_main_ = true;
  places_.clear();
  locals_.clear();
  local_cells_.clear();
  if (IsSinumerik()) {
    MakeLocals(3 + random_.Below(6));
  } else {
    MakeLocalCells(2 + random_.Below(5));
    MakeCounterCells(4);
  }
  WriteDefinitions();
  WriteExterns();
  touched_ = frozen_ = 0;
  cost_ = 0;
  times_ = 1;
  drift_.fill(0);
  moved_ = turn_axes_ = 0;
  position_known_ = false;
  WriteStart();
  Statements(options_.statements / 2 + random_.Below(options_.statements));
  WriteEnd(true);
  program.Finish();
  if (!IsSinumerik()) FinishWords(program.Id());
  ir::BuildStructure(module_, program.Id(), 0, sink_);
  sample_.main = program.Id();
}

void Maker::MakeSubprogram(std::uint32_t index) {
  Subprogram sub;
  sub.name = IsSinumerik() ? (random_.Percent(25) ? fmt::format("L{}", 100 + index) : fmt::format("SUBPROG{}", index))
                           : fmt::format("{}", 2000 + index);
  ir::ProgramBuilder program(module_, sub.name, ir::ProgramKind::kSub,
                             ir::AddFile(module_, sub.name + (IsSinumerik() ? ".spf" : ".nc")));
  program_ = &program;
  sub.id = program.Id();
  // M98 shares the cells of the caller: such a program keeps away from them.
  sub.has_level = IsSinumerik() || random_.Percent(70);
  in_main_ = false;
  places_.clear();
  locals_.clear();
  MakeFormals(sub);
  local_cells_.clear();
  if (IsSinumerik()) {
    MakeLocals(1 + random_.Below(4));
  } else {
    if (sub.has_level) MakeLocalCells(random_.Below(4));
    MakeCounterCells(2);
  }
  sub.saves = Draw(Feature::kSaveModes);
  WriteHeader(sub);
  WriteDefinitions();
  WriteExterns();
  sub.entry = RandomEntry();
  known_ = sub.entry;
  known_.placed = 0;
  WriteLocalCells();
  WriteMissing(sub);
  moved_ = turn_axes_ = 0;
  touched_ = frozen_ = 0;
  cost_ = 0;
  times_ = 1;
  drift_.fill(0);
  const double limit = drift_limit_;
  const std::uint64_t budget = budget_;
  drift_limit_ = limit / 8;
  budget_ = budget / 20;
  Statements(2 + random_.Below(options_.statements / 2));
  WriteEnd(false);
  program.Finish();
  if (!IsSinumerik()) FinishWords(sub.id);
  ir::BuildStructure(module_, sub.id, 0, sink_);
  drift_limit_ = limit;
  budget_ = budget;
  sub.exit = known_;
  sub.touched = touched_;
  sub.drift = drift_;
  sub.cost = cost_;
  sub.moved = moved_;
  subs_.push_back(std::move(sub));
}

void Maker::WriteEnd(bool main) {
  // Some machines end with G97, which freezes a surface speed: where X is not known there is none.
  if (main && !Has(Feature::kSurfaceSpeedAtEnd) && known_.modes.speed_mode != ir::SpeedMode::kRpm) {
    ir::BlockBuilder rpm = NewBlock();
    SetRpm(rpm);
    Emit(rpm);
  }
  ir::BlockBuilder block = NewBlock();
  const std::uint32_t way = random_.Below(3);
  if (main || (IsSinumerik() && way == 0 && random_.Percent(40))) {
    Code(block, ir::WordOp::kProgramEnd, 0, random_.Percent(80) ? 30 : 2);
  } else {
    Code(block, ir::WordOp::kReturn,
         static_cast<std::uint8_t>(IsSinumerik() && random_.Percent(50) ? ir::ReturnKind::kAuxiliary
                                                                        : ir::ReturnKind::kPlain));
  }
  Emit(block);
}

}  // namespace ncport::tests::random
