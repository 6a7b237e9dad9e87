// Motion: modal words, positions, frames, lines, arcs, threads, reference moves. One block at a time.
#pragma once

#include <cstdint>
#include <string>

#include "exec/arc_geometry.h"
#include "exec/block_work.h"
#include "exec/channel.h"
#include "exec/contour.h"
#include "exec/emitter.h"
#include "exec/session.h"

namespace ncport::exec {

class Evaluator;

class Kinematics {
 public:
  Kinematics(Session& session, Channel& channel, Emitter& emitter, const Evaluator& names);

  /// A modal word takes effect. `extension`: of a work offset.
  void Set(const ir::Word& word, double extension, BlockWork& work);
  /// After all settings of the block: feed, frame words, compensation as traces show it.
  void FinishSettings(BlockWork& work);
  /// The motion of the block. Returns true if an axis moved along a path.
  bool Move(const BlockWork& work);
  /// End of the run: nothing may wait for another element.
  void Finish();
  /// The run ends in an alarm.
  void Abandon() { contour_.Abandon(); }
  /// The block makes a hole: what else it says happens at its place, in front of it.
  [[nodiscard]] bool Drills(const BlockWork& work) const;
  /// Value of one least increment in the units in force, for numbers without decimal point.
  [[nodiscard]] double Increment(bool rotary) const;
  /// A computed value on its way to its address (Machine::word_error).
  [[nodiscard]] double Rounded(double value, double increment) const;
  /// The word of the axis in mm, inches or degrees as the block has it: increments counted, a computed value rounded.
  [[nodiscard]] double WordOf(const BlockWork& work, std::uint8_t axis, bool angle) const;
  /// Puts modal state and frame back (end of a program that saves them).
  void Restore(const ir::ModalState& modal, const Frame& frame);

 private:
  // modal.cc
  void SetFeedMode(ir::FeedMode mode);
  void SetSpeedMode(const ir::Word& word, const BlockWork& work);
  void TakeSurfaceSpeed(const BlockWork& work);
  void SetWorkOffset(const ir::WorkOffset& offset);
  void SetPath(ir::PathMode mode, bool one_block = false);
  void SetFeed(const BlockWork& work);
  void ShowComp();
  [[nodiscard]] double LengthFactor() const;  // of lengths as programmed, to mm
  [[nodiscard]] double FeedFactor() const;    // of feeds
  bool Unknown(bool unknown, std::string_view what) {
    if (unknown) [[unlikely]]
      RefuseUnknown(what);
    return unknown;
  }
  void RefuseUnknown(std::string_view what);

  // frames.cc
  void ApplyFrame(const BlockWork& work);
  void ApplyLayer(const BlockWork& work);
  void EndLayers(const BlockWork& work);
  bool MirrorMaySwitch(const BlockWork& work, bool on);
  bool LayerCenter(const BlockWork& work, std::uint8_t axis, double& center);
  void MakeFrame();
  void FrameChanged();
  void SetPole(const BlockWork& work);
  void Preset(const BlockWork& work);

  // motion.cc
  bool MoveByMode(const BlockWork& work);
  bool NoCircleWords(const BlockWork& work);
  bool ResolveTargets(const BlockWork& work);
  bool Target(const BlockWork& work, std::uint8_t axis);
  bool ResolvePolar(const BlockWork& work);
  bool ResolvePolarWords(const BlockWork& work);
  void Scale(BlockWork& work);
  bool ResolveAngle(const BlockWork& work);
  void Adopt();  // target_ becomes the position
  bool Known(std::uint8_t axis, std::string_view why);
  bool FeedReady(const BlockWork& work);
  Event& MotionEvent(EventKind kind);
  Contour::Wish WishOf(const BlockWork& work);
  void Line(const BlockWork& work, EventKind kind);
  void NoteDirection(const Event& event);
  [[nodiscard]] bool TransverseInDiameter(ir::ValueMode mode, bool incremental) const;
  [[nodiscard]] std::string_view NameOf(std::uint8_t axis) const;

  // arc.cc
  void ArcMove(const BlockWork& work, bool clockwise);
  void ArcVia(const BlockWork& work);
  void ArcTangent(const BlockWork& work);
  bool Center(const BlockWork& work, const PlaneAxes& axes, Point& center);
  double CenterCoordinate(std::uint8_t axis, double value, ir::ValueMode mode) const;
  bool ArcTrouble(const Arc& arc);
  void ScaledArc(const BlockWork& work, const PlaneAxes& axes, const Arc& programmed);
  void SendArc(const BlockWork& work, ir::Plane base_plane, Point base_center, bool clockwise, double radius,
               bool full);

  // cycles.cc
  void BeginCycle(const BlockWork& work);
  bool CycleMove(const BlockWork& work);
  bool Drill(const BlockWork& work);
  void DrillHole(std::uint8_t axis, bool lathe);
  void ArmRigidTaps();
  void RigidTap(std::uint8_t axis, bool left);
  bool StoreHole(const BlockWork& work, std::uint8_t axis, bool lathe);
  bool TurningCycle(const BlockWork& work);
  void Go(std::uint16_t axes, const double* targets, EventKind kind);
  void GoTo(std::uint8_t axis, double target, EventKind kind);
  void Pause(double seconds);
  void Turn(ir::SpindleState state);

  // special_moves.cc
  bool Thread(const BlockWork& work, ir::Motion motion);
  bool MachineMove(const BlockWork& work);
  void ReferenceMove(const BlockWork& work);
  [[nodiscard]] bool StaysUnknown(const BlockWork& work) const;
  void Dwell(const BlockWork& work);
  bool OpenAngle(const BlockWork& work);
  bool CloseAngle(const BlockWork& work);

  Session& session_;
  Channel& channel_;
  Emitter& emitter_;
  const Evaluator& names_;
  Contour contour_;

  // Of the block in work.
  double target_[ir::kMaxAxes] = {};  // workpiece coordinates of `moved_`
  double from_[ir::kMaxAxes] = {};    // trace position before the block
  std::uint16_t from_known_ = 0;
  std::uint16_t moved_ = 0;    // axes that the block names, workpiece coordinates
  std::uint16_t reached_ = 0;  // the same in trace coordinates

  // A straight line of which only the angle is known yet (two-block contours).
  struct Open {
    bool active = false;
    double angle = 0;
    bool feed_known = false;
    double feed = 0;
    ir::FeedMode feed_mode = ir::FeedMode::kUnknown;
    BlockWork work;
    ir::BlockId block;
  };
  Open open_;
};

}  // namespace ncport::exec
