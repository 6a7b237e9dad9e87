// The inside of absolute_dimensions.h: what its parts share. Axis words are in absolute_dimensions.cc, the flow of
// positions in absolute_flow.cc, arcs in absolute_plane.cc and absolute_pieces.cc, polar words in absolute_polar.cc,
// frames in absolute_frames.cc, positions across calls in absolute_calls.cc, increments that stay in absolute_kept.cc.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/analysis/flow_analyses.h"
#include "ir/analysis/interval.h"
#include "ir/analysis/number_kinds.h"
#include "ir/builder.h"
#include "ir/motions.h"
#include "ir/transform/absolute_dimensions.h"
#include "ir/transform/frame_flow.h"
#include "ir/transform/linear_form.h"
#include "ir/transform/plane_geometry.h"
#include "ir/transform/program_editor.h"

namespace ncport::ir::transform {

/// What outlives a block: the positions of the axes (0 to kMaxAxes - 1), and of polar words the pole, along the first
/// and the second axis of the plane, the angle and the radius; and the shift of the programmable frame.
using Slot = std::uint8_t;
inline constexpr Slot kPoleFirst = kMaxAxes;
inline constexpr Slot kPoleSecond = kMaxAxes + 1;
inline constexpr Slot kPolarAngle = kMaxAxes + 2;
inline constexpr Slot kPolarRadius = kMaxAxes + 3;
inline constexpr Slot kShift = kMaxAxes + 4;  // X, Y and Z of the programmable frame
inline constexpr Slot kSlots = kMaxAxes + 7;
using SlotMask = std::uint32_t;  // bit per slot
constexpr SlotMask MaskOf(Slot slot) { return SlotMask{1} << slot; }
inline constexpr SlotMask kAllSlots = MaskOf(kSlots) - 1;
inline constexpr SlotMask kPolarSlots =
    MaskOf(kPoleFirst) | MaskOf(kPoleSecond) | MaskOf(kPolarAngle) | MaskOf(kPolarRadius);

inline constexpr SlotMask kAxisSlots = MaskOf(kMaxAxes) - 1;
inline constexpr SlotMask kLinearSlots = 7;  // X Y Z
inline constexpr SlotMask kShiftSlots = SlotMask{7} << kShift;

/// The value of a slot on arrival at a block.
struct SlotValue {
  enum class Kind : std::uint8_t { kNoWay, kUnknown, kKnown };
  Kind kind = Kind::kNoWay;
  LinearForm form;  // axes in the target's terms: diameter or radius, mm; pole and shift as radius, mm
  [[nodiscard]] bool Known() const { return kind == Kind::kKnown; }
};
using Slots = std::array<SlotValue, kSlots>;

/// What a block does to one slot.
enum class Step : std::uint8_t {
  kNone,
  kAbsolute,
  kIncremental,
  kComputed,  // from the words and other slots: Pass::Computed
  kReturned,  // a call that puts the position into its cell
  kLost
};

/// Words of a block that mean a point or an arc of the plane.
struct PlaneWords {
  enum class Kind : std::uint8_t {
    kNone,
    kOpeningToEnd,   // opening angle and end point
    kOpeningCenter,  // opening angle and centre
    kThrough,        // intermediate point
    kPolar,          // end point as radius and angle
    kPole,           // no move: the pole
  };
  enum class Change : std::uint8_t { kNo, kYes, kMaybe };
  Kind kind = Kind::kNone;
  Change plane_changes = Change::kNo;  // then the pole goes back to the zero point and the angle is forgotten
  Plane plane = Plane::kUnknown;
  std::uint8_t first = 0, second = 1;  // axes of the plane

  [[nodiscard]] bool Moves() const { return kind != Kind::kNone && kind != Kind::kPole; }
  [[nodiscard]] bool HasAxis(std::uint8_t axis) const { return axis == first || axis == second; }
};

inline void DropWords(std::vector<Word>& words, WordOp op) {
  std::erase_if(words, [op](const Word& word) { return word.op == op; });
}

/// What the programs below a call move and write.
struct Effects {
  SlotMask slots = 0;
  bool writes_shared = false;  // cells or variables that its caller sees
  bool reframes = false;       // frames, work offsets, preset positions
};

class DimensionPass {
 public:
  DimensionPass(Module& module, const Machine& source, const AbsoluteDimensionsConfig& config, diag::Sink& sink)
      : module_(module),
        source_(source),
        config_(config),
        sink_(sink),
        make_(module),
        analyses_(module, source, {source.start, config.sub_entry}),
        flow_(analyses_.Modal()),
        frames_(module, source, analyses_.Graphs(), analyses_.Calls(), flow_, config.frames) {}

  bool Run();
  [[nodiscard]] CarriedPositions Carried() const;
  [[nodiscard]] const KeptIncrements& Kept() const { return kept_; }

 private:
  void FindEffects();
  void Enter(ProgramId program);
  bool RunProgram(ProgramId program);

  // Positions across calls.
  void FindCallPositions();
  void FindPassable();
  void FindPassed();
  bool DropUnknownPassed();
  ExprId CellAt(Slot axis);
  /// The sum reads a cell that carries a position.
  [[nodiscard]] bool ReadsCells(const LinearForm& form) const;
  [[nodiscard]] const Word* PassableCall(BlockId block) const;
  /// Positions that the callee of the block takes; that are in their cells behind the block; that this program gives
  /// back at the block.
  [[nodiscard]] SlotMask PassedAt(BlockId block) const;
  [[nodiscard]] SlotMask ReturnedAt(BlockId block) const;
  [[nodiscard]] SlotMask LeftAt(BlockId block) const;
  [[nodiscard]] SlotMask LiveBehind(BlockId block) const;
  void PassPositions(BlockId block, Slots& slots, bool emit);
  void LeavePositions(BlockId block, Slots& slots, bool emit);
  void PutPositions(BlockId block, SlotMask which, Slots& slots, bool before, bool emit);

  // Increments that stay.
  void FindKept();
  [[nodiscard]] SlotMask KeptOf(ProgramId program, BlockId block, SlotMask settled) const;
  [[nodiscard]] bool StaysExact(ProgramId program, BlockId block, const Word& word, double factor,
                                analysis::NumberKinds& kinds) const;
  void SayDrift(BlockId block, const Word& word, bool diameter);
  [[nodiscard]] bool KeptAt(BlockId block, Slot slot) const {
    return !kept_axes_.empty() && (kept_axes_[block.value] >> slot & 1U) != 0;
  }
  /// The mode in the blocks of kept increments, and the absolute one behind them.
  void WriteDistanceModes();

  // Analysis of one program.
  [[nodiscard]] Step StepOf(BlockId block, Slot slot) const;
  [[nodiscard]] Step AxisStep(BlockId block, std::uint8_t axis) const;
  [[nodiscard]] bool UsesSlot(BlockId block, Slot slot) const;
  void FindLive();
  void FindCarryLive();
  void Flow();
  /// Slots behind a block that is reached with `slots`.
  void Through(BlockId block, Slots& slots, bool emit);
  /// The block moves and a modal call may be active: its program runs behind the block.
  [[nodiscard]] bool TriggersModal(ProgramId program, BlockId block) const;
  bool Join(BlockId block, Slots& at, const Slots& from);
  [[nodiscard]] Slots EntrySlots();
  void SaveEntry(Slots& slots, bool emit);
  /// Slots that need to be followed: without polar words and frames only the axes.
  [[nodiscard]] Slot SlotsUsed() const { return frames_.Any() ? kSlots : polar_ ? kShift : kMaxAxes; }

  // Values.
  struct Scale {
    double factor = 1;  // source number -> target number
    bool incremental = false;
    bool known = true;
  };
  Scale ScaleOf(const Word& word, std::uint8_t axis, const ModalState& state, BlockId block, bool report);
  static double UnitFactor(const ModalState& state);
  [[nodiscard]] bool Occurs(WordOp op, std::uint8_t value) const;
  void FindModesThatOccur();
  void RefuseOpenUnits(BlockId block);
  void RefuseOpenMode(BlockId id, const Word& word, std::string_view group);
  ExprId Scaled(ExprId value, double factor);
  [[nodiscard]] LinearForm ScaledForm(ExprId value, double factor) const {
    return Sum(module_, {}, FormOf(module_, value), factor);
  }
  ExprId Held(Slot slot);
  void Save(BlockId block, Slot slot, Slots& slots, bool before, bool emit);
  void PutInto(ExprId place, BlockId block, SlotValue& value, bool before, bool emit);
  void RewriteWords(BlockId block, const Slots& in);
  std::optional<LinearForm> CenterForm(BlockId block, const Word& word, const Slots& in) const;
  void RewriteCenter(BlockId block, Word& word, const Slots& in);
  void RewriteMachineWords(BlockId block);
  void DropModeWords();
  void Unknown(BlockId block, const Word& word, std::uint8_t axis);
  [[nodiscard]] bool ReadsPlace(const LinearForm& form, ExprId place, bool whole = false) const;
  [[nodiscard]] bool ReadsShared(const LinearForm& form) const;
  [[nodiscard]] const Word* WordFor(BlockId block, std::uint8_t axis) const;
  [[nodiscard]] const Word* WordOf(BlockId block, WordOp op) const;
  [[nodiscard]] bool Conditional(const Block& block) const;
  [[nodiscard]] std::uint32_t IndexOf(BlockId block) const { return block.value - blocks_.begin; }

  // Arcs and polar words.
  void FindPlaneWords();
  [[nodiscard]] PlaneWords PlaneWordsOf(BlockId block) const;
  [[nodiscard]] const PlaneWords& PlaneAt(BlockId block) const { return plane_words_[IndexOf(block)]; }
  [[nodiscard]] Step PolarStep(BlockId block, Slot slot) const;
  [[nodiscard]] bool UsesForPlane(BlockId block, Slot slot) const;
  [[nodiscard]] bool PolarAngleAdds(BlockId block) const;
  [[nodiscard]] bool PoleIsCenter(BlockId block) const;
  /// New value of a slot with Step::kComputed; none: something that it follows from is not known.
  std::optional<LinearForm> Computed(BlockId block, Slot slot, const Slots& in);
  /// End point of a block with polar words or with centre and opening angle; as radii, like all points here.
  std::optional<PlanePoint> EndOfPlane(BlockId block, const Slots& in);
  std::optional<PlanePoint> StartOfPlane(BlockId block, const Slots& in) const;
  std::optional<PlanePoint> CenterOfPlane(BlockId block, const Slots& in) const;
  std::optional<PlanePoint> PolarEnd(BlockId block, const Slots& in);
  std::optional<PlanePoint> PoleOf(BlockId block, const Slots& in) const;
  std::optional<PlanePoint> NewPole(BlockId block, const Slots& in);
  [[nodiscard]] LinearForm AsRadius(std::uint8_t axis, const LinearForm& target) const;
  [[nodiscard]] LinearForm AsTarget(std::uint8_t axis, const LinearForm& radius) const;
  /// Where the words of the block lead along an axis, or where it stands.
  std::optional<LinearForm> EndOfAxis(BlockId block, std::uint8_t axis, const Slots& in);
  /// The words of the block with centres and axis words for what only the source has; false: refused.
  bool LowerPlaneWords(BlockId block, const Slots& in, std::vector<Word>& words);
  bool LowerOpening(BlockId block, const Slots& in, std::vector<Word>& words);
  bool LowerThrough(BlockId block, const Slots& in, std::vector<Word>& words);
  bool LowerPolar(BlockId block, const Slots& in, std::vector<Word>& words);
  void RemovePole(BlockId block, const Slots& in);
  void AddAxes(const PlaneWords& plane, const PlanePoint& point, std::vector<Word>& words);
  void AddCenters(const PlaneWords& plane, const PlanePoint& center, std::vector<Word>& words);
  /// Full turns in front of the arc as circles of their own, each with its share of the way along the other axes.
  bool LowerTurns(BlockId block, const Slots& in, std::vector<Word>& words, std::vector<std::vector<Word>>& before);
  [[nodiscard]] bool CornerMoves(BlockId block) const;
  /// The corner behind the block as a move of its own.
  bool LowerCorner(BlockId block, const Slots& in, std::vector<Word>& words, std::vector<std::vector<Word>>& after);
  /// Way of the next straight move in the plane as a number; none: it is no such move.
  std::optional<PlanePoint> NextWay(BlockId block, const PlanePoint& corner);
  void Insert(BlockId block, const std::vector<Word>& words, bool before);
  bool Refuse(BlockId block, const Word& word, std::string_view what, std::string_view help = "");
  /// Every value that the words of the block can have lies from `low` to `high`.
  [[nodiscard]] bool Within(BlockId block, const Word& word, double low, double high) const;
  void FindRanges();

  // Frames.
  [[nodiscard]] const Word* FrameWord(BlockId block) const;
  [[nodiscard]] Step ShiftStep(BlockId block, Slot slot) const;
  [[nodiscard]] bool UsesForFrame(BlockId block, Slot slot) const;
  [[nodiscard]] SlotMask LiveThroughFrame(BlockId block, SlotMask behind) const;
  /// A move that leaves an axis behind at an unknown place takes those with it that a rotation ties to it.
  [[nodiscard]] bool LosesUnderFrame(BlockId block, std::uint8_t axis) const;
  /// X Y Z words of the block, named or computed, that move.
  [[nodiscard]] SlotMask MovedLinear(BlockId block) const;
  [[nodiscard]] std::optional<LinearForm> ShiftBefore(BlockId block, std::uint8_t axis, const Slots& in) const;
  std::optional<LinearForm> NewShift(BlockId block, std::uint8_t axis, const Slots& in);
  std::optional<LinearForm> SeenFromNewFrame(BlockId block, std::uint8_t axis, const Slots& in);
  void FindSenses();
  void RemoveFrame(BlockId block);
  bool ApplyFrame(BlockId block, const Slots& in, std::vector<Word>& words);
  bool FramedAxes(BlockId block, const Slots& in, const FrameMatrix& matrix, std::vector<Word>& words);
  /// An arc by its radius whose ends the frame moves off their decimals gets a centre: a radius would turn small errors
  /// of the ends into large ones of the centre.
  bool RadiusToCenter(BlockId block, const Slots& in, std::vector<Word>& words);
  void FramedCenters(const FrameMatrix& matrix, std::uint8_t first, std::uint8_t second, std::vector<Word>& words);

  Module& module_;
  const Machine& source_;
  const AbsoluteDimensionsConfig& config_;
  diag::Sink& sink_;
  ExprBuilder make_;
  analysis::FlowAnalyses analyses_;
  const analysis::ModalFlow& flow_;
  FrameFlow frames_;
  std::vector<Effects> effects_;                        // per program
  Effects modal_;                                       // of the programs that modal calls run
  std::map<std::uint32_t, analysis::Interval> ranges_;  // values of words that need it; by word
  bool polar_ = false;                                  // some program has polar words
  bool poles_ = false;                                  // some program sets a pole or changes the plane

  std::vector<SlotMask> kept_axes_;  // per block of the module as it came; empty: none is kept
  KeptIncrements kept_;

  std::vector<std::array<VariableId, kSlots>> held_;  // per program
  std::array<SpaceId, kMaxAxes> at_{};                // cells that carry positions over calls
  std::vector<std::uint8_t> passable_;                // per program, as the masks below
  std::vector<SlotMask> passes_, returns_;            // positions that it takes, that it gives back
  std::vector<SlotMask> never_passed_, never_returned_;
  std::map<std::pair<std::uint32_t, Slot>, BlockId> unknown_callers_;  // program and axis: a call that does not know it

  // Of the program at hand.
  ProgramId program_;
  IdRange<BlockId> blocks_;
  bool names_senses_ = false;            // arcs turn the other way somewhere: each one names its sense
  std::vector<PlaneWords> plane_words_;  // per block
  std::map<std::uint32_t, double> cut_;  // by block: how much of its length the corner in front of it takes, mm
  std::vector<SlotMask> live_;           // per block: slots whose value on arrival is used
  SlotMask entry_carried_ = 0;           // slots whose start value arrives in its local somewhere
  std::vector<SlotMask> carry_live_;     // slots whose held value is used behind the block
  std::vector<SlotMask> carried_;        // slots that arrive in their local
  std::vector<Slots> in_;
  std::optional<ProgramEditor> editor_;
  std::vector<std::pair<BlockId, std::vector<Word>>> rewritten_;        // changed when all blocks were looked at
  SlotMask saving_ = 0;                                                 // slots whose locals are being written
  SlotMask unknown_left_ = 0;                                           // positions that some end does not know
  bool inches_ = false, inverse_time_ = false, surface_speed_ = false;  // occur somewhere
  bool ok_ = true;
};

}  // namespace ncport::ir::transform
