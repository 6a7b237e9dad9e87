// The one object that makes a random program; its functions stand in make_*.cc by area.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/diag/sink.h"
#include "ir/builder.h"
#include "ir/structure.h"
#include "tests/random/generator.h"
#include "tests/random/interval.h"
#include "tests/random/knowledge.h"
#include "tests/random/random_source.h"

namespace ncport::tests::random {

/// What the values of a variable are good for. A variable holds values of its class at all times.
enum class Range : std::uint8_t {
  kTruth,     // 0, 1
  kCount,     // whole, 0..12: loop counters
  kWhole,     // whole, -100..100
  kLength,    // -40..40
  kPositive,  // 0.5..20: radii, divisors
  kAngle,     // -360..360
  kFraction,  // -1..1
  kFeed,      // 50..3000
  kText,
  kAxis,
};
inline constexpr std::size_t kRanges = static_cast<std::size_t>(Range::kAxis) + 1;
Interval BoundsOf(Range range);

/// Something that is read and written: a variable, an array of one class, or cells of a space.
struct Place {
  ir::VariableId variable;  // valid: named
  ir::SystemId system;      // valid: element `first` of a system variable
  ir::SpaceId space;        // else: cells `first` .. `first + count - 1`
  std::uint32_t first = 0;
  std::uint32_t count = 1;
  ir::Type type = ir::Type::kReal;
  Range range = Range::kLength;
  bool writable = true;
  bool is_array = false;
  bool busy = false;  // counts a loop around here
};

struct Formal {
  Place place;
  char letter = 0;  // of a macro's argument
  bool by_reference = false;
  bool may_miss = false;  // its value without an argument is in its range
};

/// A program that can be called.
struct Subprogram {
  ir::ProgramId id;
  std::string name;
  std::vector<Formal> formals;
  Knowledge entry;  // what a caller must see to
  Knowledge exit;
  std::uint32_t touched = 0;  // groups that a call may change
  bool saves = false;
  bool has_level = true;                        // its locals are its own; without: it may run on the caller's level
  bool repeatable = false;                      // its exit meets its entry: passes
  std::array<double, ir::kLetterAxes> drift{};  // mm, at most, of one call
  std::uint64_t cost = 0;                       // blocks, of one call
  std::uint16_t moved = 0;                      // bit per axis that a call may move
};

class Maker {
 public:
  Maker(std::uint64_t seed, const Options& options);
  Sample Make();

 private:
  struct Made {
    ir::ExprId id;
    ir::Type type = ir::Type::kReal;
    Interval range;
  };
  /// A label that jumps lead to and that is not placed yet.
  struct Pending {
    std::string label;  // empty: by number
    std::uint32_t number = 0;
    Knowledge known;  // at the jumps
  };
  struct Frame {
    std::vector<Pending> pending;
    bool barrier = false;  // no jump leads out of it
  };
  /// End of a contour element that an arc or chamfer starts from.
  struct Flat {
    std::uint8_t first = 0, second = 1, normal = 2;  // axes of the plane
    ir::Plane plane = ir::Plane::kXY;
  };

  /// An arc by its radius vectors, in units of `length`.
  struct Arc {
    std::array<int, 2> start{}, end{};
    bool clockwise = false;
    bool fives = false;  // vectors of five units, else of one
    bool full = false;
    double sweep = 0;  // degrees
    Made length;
  };

  // --- chances
  [[nodiscard]] bool Draw(Feature feature) { return random_.Percent(options_.weights.Of(feature)); }
  /// A number of a shape may be computed. What is always so draws nothing.
  [[nodiscard]] bool MayCompute() {
    return options_.weights.Of(Feature::kComputedShape) >= 100 || Draw(Feature::kComputedShape);
  }
  [[nodiscard]] bool Has(Feature feature) const { return options_.weights.Of(feature) != 0; }
  [[nodiscard]] bool IsSinumerik() const { return options_.flavour == Flavour::kSinumerik; }

  // --- make_program.cc
  void ChooseInitial();
  void MakeSpaces();
  void MakeCells();
  void MakeSubprogram(std::uint32_t index);
  void MakeMain();
  void MakeLocals(std::uint32_t count);
  void MakeLocalCells(std::uint32_t count);
  void MakeCounterCells(std::uint32_t count);
  void WriteDefinitions();
  void WriteCellStarts();
  void WriteLocalCells();
  void WriteModes(const Knowledge& wanted, bool with_frame);
  void WriteStart();
  void WriteEnd(bool main);
  Knowledge RandomEntry();
  Place AddLocal(Range range, ir::Type type, bool array);
  void MakeFormals(Subprogram& sub);
  void MakeLetters(Subprogram& sub);
  void WriteHeader(const Subprogram& sub);
  void WriteMissing(const Subprogram& sub);
  // make_fanuc.cc
  void FinishWords(ir::ProgramId program);
  void MakeSteps();
  [[nodiscard]] bool TooDeep(const Made& made) const;
  void WriteExterns();

  // --- make_values.cc
  Made Literal(const Interval& target);
  Made NumberIn(const Interval& target, int depth);
  Made AnyNumberIn(const Interval& target, int depth);
  Made Number(int depth);
  Made AnyNumber(int depth);
  Made Fit(Made made, const Interval& target);
  Made ReadPlace(const Place& place, int depth);
  Made Function(int depth);
  Made IntegerIn(const Interval& target, int depth);
  Made BitOperation(int depth);
  ir::ExprId Truth(int depth);
  ir::ExprId Comparison(int depth);
  ir::ExprId PlaceExpr(const Place& place, int depth);
  Made Call(ir::Function function, std::initializer_list<Made> arguments, ir::Type type, Interval range);
  Made Operation(ir::ExprOp op, Made left, Made right, ir::Type type, Interval range);
  Made MaybeGroup(Made made);
  Made Group(Made made);
  ir::ExprId As(const Made& made, ir::Type type);
  /// A value for a place or argument of this class and type.
  ir::ExprId ValueFor(Range range, ir::Type type, int depth);
  const Place* PickPlace(const Interval& target, bool whole_type);
  const Place* PickWritable();
  [[nodiscard]] const Place* FindPlace(Range range, ir::Type type);
  // make_texts.cc
  ir::ExprId TextValue(int depth);
  ir::ExprId TextLiteral();
  Made TextNumber(int depth);
  Made SystemNumber();
  ir::ExprId TextTruth(int depth);

  // --- make_blocks.cc
  ir::BlockBuilder NewBlock();
  ir::BlockBuilder NewMark();
  /// `may_skip`: the block may be given a skip level; what it changes is then known no longer.
  void Emit(ir::BlockBuilder& block, bool may_skip = false);
  void Code(ir::BlockBuilder& block, ir::WordOp op, std::uint8_t index = 0, std::uint32_t extra = Id<void>::kNone);
  void Word(ir::BlockBuilder& block, ir::WordOp op, ir::ExprId value, std::uint8_t index = 0,
            std::uint32_t extra = Id<void>::kNone);
  void FlushLabel();
  void PlaceLabel(const Pending& pending);
  std::string NewLabel();
  std::string CommentText();
  [[nodiscard]] bool MayChange(std::uint32_t group) const { return (frozen_ & group) == 0; }
  void Touch(std::uint32_t groups) { touched_ |= groups; }

  // --- make_statements.cc
  void Statements(std::uint32_t count);
  void Statement();
  [[nodiscard]] bool Possible(Feature feature) const;
  void Make(Feature feature);
  void MakeAssign();
  void MakeAssignList();

  // --- make_flow.cc
  void MakeIf();
  void MakeWhile();
  void MakeFor();
  void MakeLoop();
  void MakeRepeat();
  void MakeCase();
  void MakeForwardJump();
  void MakeBackwardJump();
  void MakeTangle();
  void MakeRepeatPart();
  void MakeBlockRange();
  /// Body of a loop that runs at most `turns` times.
  template <class Body>
  void Loop(std::uint32_t turns, const Body& body);
  std::uint32_t Turns();
  void EmitMark(ir::WordOp op, ir::ExprId value = {}, std::uint8_t number = 0);
  void EmitJump(const Pending& target, ir::ExprId condition, bool forward, bool backward = false);
  Pending NewTarget(bool forward_only);
  const Place* TakeCounter();
  void SetCounter(const Place& counter, double value);
  void StepCounter(const Place& counter);
  ir::ExprId CounterPlace(const Place& counter);
  void Busy(const Place& counter, bool busy);
  void SetTarget(ir::Target& where, const Pending& target);
  ir::ExprId CounterBelow(const Place& counter, std::uint32_t turns);
  [[nodiscard]] bool Deep() const { return depth_ >= 4 || Exhausted(); }
  [[nodiscard]] bool Exhausted() const { return cost_ > budget_; }

  // --- make_drilling.cc
  /// A drilling cycle in force.
  struct Holes {
    std::uint8_t first = 0, second = 1, normal = 2;  // axes of the plane
    ir::Cycle cycle = ir::Cycle::kDrill;
    ir::ReturnLevel level = ir::ReturnLevel::kUnknown;
    bool step = false;  // Q is stored
    bool polar = false;
    bool radius_kept = false;  // polar: a later block may leave out a word
    bool moved_zero = false;   // in another work offset than before
  };
  void MakeDrilling();
  void MakeLocalShift();
  void CycleWord(ir::BlockBuilder& block, ir::CycleField field, ir::ExprId value, bool named);
  void HoleData(ir::BlockBuilder& block, Holes& holes, bool named, bool all);
  void HolePlace(ir::BlockBuilder& block, Holes& holes, bool both);
  void PolarPlace(ir::BlockBuilder& block, Holes& holes, bool both);
  void Hole(Holes& holes, bool named, bool all);
  void HoleRow(Holes& holes);
  void HoleLoop(Holes& holes);
  void Between(Holes& holes);
  void NewCycle(Holes& holes);
  void EndDrilling(const Holes& holes);

  // --- make_cycles.cc
  struct LibraryProgram {
    std::string name;
    ir::ProgramId id;
  };
  /// One place of a call.
  struct CycleValue {
    Interval range{0, 0, false};
    ir::Type type = ir::Type::kReal;
    bool given = false;
  };
  void ReadLibrary();
  void MakeHoleCycle();
  [[nodiscard]] const LibraryProgram* Library(std::string_view name) const;
  std::vector<CycleValue> CycleValues(std::string_view name);
  ir::CallId CycleCall(const LibraryProgram& program);

  // --- make_calls.cc
  void MakeCall();
  void MakeModalCall();
  [[nodiscard]] bool Callable(const Subprogram& sub, std::uint64_t times) const;
  void MeetEntry(const Subprogram& sub);
  void AddArguments(const Subprogram& sub, ir::Call& call);
  void AfterCall(const Subprogram& sub, std::uint64_t times);
  void Adopt(const Knowledge& from, std::uint32_t groups);
  [[nodiscard]] static std::uint32_t Unknowns(const Knowledge& known);

  // --- make_moves.cc
  void MakeRapid();
  void MakeLinear();
  void MakeDwell();
  void MakeMachineCoords();
  void MakeReference();
  void Approach(const std::vector<std::uint8_t>& axes);
  [[nodiscard]] std::vector<std::uint8_t> AllAxes() const;
  void MakeChamfer();
  void MakeThread();
  void MakeTap();
  void MakePolar();
  /// Blocks that must stand before a move: the speed mode when it and the feed mode are open.
  void Ready();
  void SetMotion(ir::BlockBuilder& block, ir::Motion motion);
  /// A position of the axis that no word of this program says.
  void Displace(std::uint16_t axes) { known_.placed &= static_cast<std::uint16_t>(~axes); }
  [[nodiscard]] bool IsPlaced(std::uint8_t axis) const { return (known_.placed >> axis & 1U) != 0; }
  /// Steps may be written although the position is not known.
  bool MayStep(std::uint8_t axis) { return IsPlaced(axis) || Draw(Feature::kBlindStep); }
  /// Words that bring the loop's axes back to known positions.
  void CloseTurn();
  void NeedFeed(ir::BlockBuilder& block);
  void NeedUnits(ir::BlockBuilder& block);
  void NeedDiameter(ir::BlockBuilder& block);
  void AddFeed(ir::BlockBuilder& block);
  /// One axis word; absolute or by a step of at most about `step` mm.
  void AxisWord(ir::BlockBuilder& block, std::uint8_t axis, bool absolute, int depth);
  void AxisLiteral(ir::BlockBuilder& block, std::uint8_t axis, ir::ValueMode mode, double value);
  void AxisValue(ir::BlockBuilder& block, std::uint8_t axis, ir::ValueMode mode, ir::ExprId value);
  std::vector<std::uint8_t> SomeAxes(bool with_rotary);
  [[nodiscard]] std::uint8_t TransverseAxis() const { return machine_.transverse_axis; }
  [[nodiscard]] bool HasAxis(std::uint8_t axis) const { return (machine_.axes >> axis & 1U) != 0; }
  [[nodiscard]] bool MayDrift(std::uint8_t axis, double mm) const;
  void AddDrift(std::uint8_t axis, double mm);
  [[nodiscard]] double UnitFactor() const;
  [[nodiscard]] bool IsInch() const;
  [[nodiscard]] double AbsoluteLimit() const { return IsInch() ? 8 : 200; }

  // --- make_arcs.cc
  bool ChooseFlat(Flat& flat);
  void MakeArcCenter();
  void MakeArcRadius();
  void MakeArcAngle();
  void MakeArcVia();
  void MakeArcTangent();
  bool StartArc(Flat& flat);
  Made Scaled(double factor, const Made& length);
  Made ArcLength(bool fives, bool computed = true);
  Arc DrawArc(bool full_too);
  void ArcEnd(ir::BlockBuilder& block, const Flat& flat, const Arc& arc);
  void CenterWord(ir::BlockBuilder& block, std::uint8_t axis, const Made& offset);
  void AddHelix(ir::BlockBuilder& block, const Flat& flat, bool turns);
  [[nodiscard]] bool InDiameters(bool absolute) const;
  void EndWord(ir::BlockBuilder& block, std::uint8_t axis, const Made& offset, double most);

  // --- make_modes.cc
  void MakePlane();
  void MakeDistance();
  void MakeUnits();
  void MakeFeedMode();
  void MakeSurfaceSpeed();
  void MakeDiameter();
  void MakePathMode();
  void MakeWorkOffset();
  void MakeCutterComp();
  void MakeFrame();
  void SetPlane(ir::BlockBuilder& block, ir::Plane plane);
  void SetDistance(ir::BlockBuilder& block, ir::Distance distance);
  void SetUnits(ir::BlockBuilder& block, ir::Units units);
  void SetDiameter(ir::BlockBuilder& block, ir::Diameter diameter);
  void SetFeedMode(ir::BlockBuilder& block, ir::FeedMode mode);
  void SetRpm(ir::BlockBuilder& block);
  bool ResetFrame();

  // --- make_machine.cc
  void MakeSpindle();
  void MakeSpindlePosition();
  void MakeTool();
  void MakeAux();
  void MakeAuxH();
  void MakeStop();
  void MakeMessage();
  void MakeAlarm();
  void MakePreprocessStop();
  void MakeInert();
  void MakeCommentLine();
  void AddBeside(ir::BlockBuilder& block);
  void AddAux(ir::BlockBuilder& block, std::uint32_t code);

  Options options_;
  RandomSource random_;
  ir::Machine machine_;
  Sample sample_;
  ir::Module& module_;
  ir::ExprBuilder expr_;

  std::vector<Subprogram> subs_;
  std::vector<LibraryProgram> library_;
  std::vector<Place> shared_;         // cells of all programs
  std::vector<Place> counter_cells_;  // cells that count loops, each of one program
  Knowledge initial_;                 // what main programs start with
  diag::Sink sink_;
  ir::SpaceId cell_space_, local_space_;
  std::vector<Place> local_cells_;  // of the program being made
  ir::SystemId pi_, programmed_position_;

  // The program being made.
  ir::ProgramBuilder* program_ = nullptr;
  bool in_main_ = false;
  std::vector<Place> places_;
  std::vector<Place> locals_;  // to define, in order
  std::vector<Frame> frames_;
  Knowledge known_;
  std::uint32_t frozen_ = 0;
  std::uint32_t touched_ = 0;
  std::uint32_t depth_ = 0;
  std::uint64_t times_ = 1;  // how often a block here runs, at most, in one call
  std::uint64_t cost_ = 0;
  std::uint64_t budget_ = 0;
  std::array<double, ir::kLetterAxes> drift_{};
  double drift_limit_ = 0;
  std::uint32_t next_number_ = 10;
  std::uint32_t next_label_ = 1;
  std::uint32_t next_name_ = 1;
  std::string waiting_label_;  // for the next plain block
  std::uint32_t waiting_number_ = 0;
  std::uint32_t next_counter_cell_ = 0;
  bool labelled_ = false;  // the block being made carries a label or a number that jumps name
  Knowledge before_block_;
  std::uint32_t while_depth_ = 0;
  std::uint16_t turn_axes_ = 0;  // placed at the head of the loop around here: so they must be at its end
  std::uint16_t moved_ = 0;      // axes that the program being made may move
  bool in_part_ = false;         // inside a part that is repeated by its labels
  bool position_known_ = true;
  bool origin_set_ = false;  // the start of the present arc is `origin_`
  Made origin_[2];
  std::uint8_t origin_axes_[2] = {0, 1};
};

}  // namespace ncport::tests::random
