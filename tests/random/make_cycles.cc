// The standard drilling cycles of SINUMERIK (sinumerik-8.12): called once, or modally behind moves and patterns of
// holes. Their texts are those that ncport brings along.
#include "base/source_files.h"
#include "dialects/sinumerik/library.h"
#include "frontend/reader.h"
#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprId;
using ir::Type;
using ir::WordOp;

namespace {
constexpr std::uint64_t kBlocksOfCycle = 40;  // that run, about
}  // namespace

// One or two cycles for drilling, sometimes a pattern: most programs use no more.
void Maker::ReadLibrary() {
  const std::uint32_t weight = options_.weights.Of(Feature::kHoleCycle);
  if (weight == 0 || TransverseAxis() != 0xFF || !random_.Percent(weight >= 10 ? 100 : 10 * weight)) return;
  static constexpr std::string_view kDrills[] = {"CYCLE81", "CYCLE82", "CYCLE83", "CYCLE83", "CYCLE84"};
  static constexpr std::string_view kPatterns[] = {"HOLES1", "HOLES2"};
  SourceFiles files;
  const auto read = [&](std::string_view name) {
    if (Library(name) != nullptr) return;
    const std::size_t first = module_.programs.Size();
    const FileId file = files.Add("<" + std::string(name) + ">", std::string(*dialects::sinumerik::LibraryCycle(name)));
    NCPORT_CHECK(frontend::ReadFile(files, file, *options_.profile, {.library = true}, module_, sink_).Ok(),
                 "a cycle is not read");
    module_.programs[ir::ProgramId{first}].kind = ir::ProgramKind::kSub;
    library_.push_back({std::string(name), ir::ProgramId{first}});
  };
  const std::uint32_t drills = 1 + random_.Below(2);
  for (std::uint32_t i = 0; i < drills; ++i) {
    const std::string_view name = random_.Pick(kDrills);
    if (name != "CYCLE84" || Has(Feature::kTap)) read(name);
  }
  if (library_.empty()) read("CYCLE81");
  if (Has(Feature::kModalCall) && random_.Percent(50)) read(random_.Pick(kPatterns));
  frontend::ResolveNames(files, module_, *options_.profile, sink_);
  NCPORT_CHECK(!sink_.HasErrors(), "a cycle is not understood");
}

const Maker::LibraryProgram* Maker::Library(std::string_view name) const {
  for (const LibraryProgram& program : library_) {
    if (program.name == name) return &program;
  }
  return nullptr;
}

// Values of the places of a call, from the first one on; a place without range stays empty.
std::vector<Maker::CycleValue> Maker::CycleValues(std::string_view name) {
  const double unit = IsInch() ? 0.04 : 1;
  const auto length = [&](double low, double high) {
    return CycleValue{{low * unit, high * unit, false}, Type::kReal, true};
  };
  const auto number = [&](double low, double high) { return CycleValue{{low, high, false}, Type::kReal, true}; };
  const auto whole = [&](double low, double high) { return CycleValue{{low, high, true}, Type::kInt, true}; };
  const CycleValue none;
  const auto maybe = [&](int percent, CycleValue value) { return random_.Percent(percent) ? value : none; };
  const auto dwell = [&] {
    if (Draw(Feature::kDwellRevolutions)) return number(-9, -1);
    return number(0.1, 3);
  };
  if (name == "HOLES1")
    return {length(-50, 50), length(-50, 50), number(-180, 180), length(0, 20), length(3, 20), whole(1, 4)};
  if (name == "HOLES2")
    return {length(-50, 50), length(-50, 50), length(5, 40), number(-180, 180), maybe(50, number(10, 80)), whole(1, 4)};
  std::vector<CycleValue> values{length(10, 40), length(-2, 4), maybe(90, length(0.5, 3)), {}, {}};
  const bool by_way = random_.Percent(40);
  if (!by_way || random_.Percent(20)) values[3] = length(-30, -5);
  if (by_way) values[4] = length(8, 25);
  if (name == "CYCLE82") values.push_back(maybe(80, dwell()));
  if (name == "CYCLE83") {
    const bool first_by_way = random_.Percent(50);
    values.push_back(first_by_way ? none : length(-5, -3));
    values.push_back(first_by_way ? length(3, 8) : none);
    const std::uint32_t rule = random_.Below(3);
    values.push_back(rule == 0 ? none : rule == 1 ? length(1, 3) : number(-0.9, -0.5));  // DAM
    values.push_back(maybe(40, dwell()));
    values.push_back(maybe(40, dwell()));
    values.push_back(Has(Feature::kCycleFeed) ? maybe(50, number(0.3, 1)) : none);
    values.push_back(maybe(70, whole(0, 1)));
    values.push_back(none);
    values.push_back(rule == 2 ? length(1, 3) : none);
    values.push_back(maybe(30, length(0.5, 3)));
    values.push_back(maybe(30, dwell()));
    values.push_back(maybe(30, length(0.5, 3)));
  }
  if (name == "CYCLE84") {
    values.push_back(maybe(40, number(0.1, 3)));
    values.push_back(maybe(70, whole(3, 5)));
    values.push_back(none);
    values.push_back(length(0.5, 2));
    values.push_back(number(0, 359));
    values.push_back(whole(100, 400));
    values.push_back(maybe(50, whole(100, 400)));
    values[10].type = Type::kReal;
    values[11].type = Type::kReal;
  }
  return values;
}

ir::CallId Maker::CycleCall(const LibraryProgram& program) {
  std::vector<CycleValue> values = CycleValues(program.name);
  while (!values.back().given) values.pop_back();
  std::vector<ir::Arg> args;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ir::Arg arg;
    arg.position = static_cast<std::uint16_t>(i);
    if (values[i].given) {
      const Made made = Draw(Feature::kCycleValues) ? NumberIn(values[i].range, 1) : Literal(values[i].range);
      arg.value = As(made, values[i].type);
    }
    args.push_back(arg);
  }
  ir::Call call;
  call.name = module_.strings.Intern(program.name);
  call.program = program.id;
  call.args.begin = static_cast<std::uint32_t>(module_.args.Size());
  call.args.count = static_cast<std::uint32_t>(args.size());
  for (const ir::Arg& arg : args) module_.args.Add(arg);
  call.has_brackets = true;
  cost_ += times_ * kBlocksOfCycle;
  return module_.calls.Add(call);
}

// CYCLE81(..), or MCALL CYCLE81(..), places, MCALL.
void Maker::MakeHoleCycle() {
  if (library_.empty()) return MakeLinear();
  const bool needs_mode =
      known_.modes.feed_mode == ir::FeedMode::kUnknown || known_.modes.feed_mode == ir::FeedMode::kInverseTime;
  if ((needs_mode || !known_.feed) && !MayChange(kFeedGroup)) return MakeLinear();
  if (known_.modes.plane == ir::Plane::kUnknown && !MayChange(kPlaneGroup)) return MakeLinear();
  std::vector<const LibraryProgram*> drills, patterns;
  for (const LibraryProgram& program : library_)
    (program.name.starts_with("HOLES") ? patterns : drills).push_back(&program);
  const LibraryProgram& drill = *random_.PickFrom(drills);
  if (drill.name == "CYCLE84" && !known_.frame_clear && !ResetFrame()) return MakeLinear();
  Ready();
  ir::BlockBuilder start = NewBlock();
  if (known_.modes.plane == ir::Plane::kUnknown) SetPlane(start, initial_.modes.plane);
  NeedUnits(start);
  // The cycle puts back what its caller had, which is then one value.
  if (known_.modes.distance == ir::Distance::kUnknown && MayChange(kDistanceGroup) && random_.Percent(90))
    SetDistance(start, ir::Distance::kAbsolute);
  if (needs_mode) SetFeedMode(start, ir::FeedMode::kPerMinute);
  SetMotion(start, random_.Percent(70) ? ir::Motion::kRapid : ir::Motion::kLinear);
  for (const std::uint8_t axis : SomeAxes(false)) AxisWord(start, axis, true, 1);
  if (!known_.feed || random_.Percent(30)) AddFeed(start);
  Emit(start);
  const ir::Plane plane = known_.modes.plane;
  const std::uint8_t normal = plane == ir::Plane::kXY ? 2 : plane == ir::Plane::kZX ? 1 : 0;
  moved_ |= static_cast<std::uint16_t>(1U << normal);
  const bool modal = Has(Feature::kModalCall) && random_.Percent(60);
  ir::BlockBuilder call = NewBlock();
  Word(call, modal ? WordOp::kModalCall : WordOp::kCall, {}, 0, CycleCall(drill).value);
  Emit(call);
  if (!modal) return Displace(static_cast<std::uint16_t>(1U << normal));
  const std::uint32_t places = 1 + random_.Below(4);
  for (std::uint32_t i = 0; i < places; ++i) {
    if (!patterns.empty() && random_.Percent(50)) {
      for (std::uint8_t axis = 0; axis < 3; ++axis) {
        if (axis != normal) moved_ |= static_cast<std::uint16_t>(1U << axis);
      }
      ir::BlockBuilder pattern = NewBlock();
      Word(pattern, WordOp::kCall, {}, 0, CycleCall(*random_.PickFrom(patterns)).value);
      cost_ += 4 * times_ * kBlocksOfCycle;
      Emit(pattern);
      continue;
    }
    ir::BlockBuilder place = NewBlock();
    SetMotion(place, random_.Percent(70) ? ir::Motion::kRapid : ir::Motion::kLinear);
    const std::uint8_t first = normal == 0 ? 1 : 0, second = normal == 2 ? 1 : 2;
    AxisWord(place, first, true, 1);
    if (random_.Percent(50)) AxisWord(place, second, true, 1);
    cost_ += times_ * kBlocksOfCycle;
    Emit(place);
  }
  ir::BlockBuilder off = NewBlock();
  Word(off, WordOp::kModalCall, {});
  Emit(off);
  // Behind calls some controls' positions are not known.
  Displace(0xFFFF);
}

}  // namespace ncport::tests::random
