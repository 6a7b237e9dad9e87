// Spindle, tool, offsets, M and H functions, messages, stops: words that make an event and move no axis.
#pragma once

#include <string_view>

#include "exec/block_work.h"
#include "exec/channel.h"
#include "exec/emitter.h"
#include "exec/evaluator.h"
#include "exec/session.h"

namespace ncport::exec {

class Auxiliary {
 public:
  Auxiliary(Session& session, Channel& channel, Emitter& emitter, Evaluator& evaluator)
      : session_(session), channel_(channel), emitter_(emitter), evaluator_(evaluator) {}

  /// Words of spindle, tool, offsets, M and H. `value`: of the word, vacant if it has none. `edge_follows`: the block
  /// also selects an edge.
  void Act(const ir::Word& word, const Value& value, bool edge_follows);
  /// The word that says whether lengths are added or taken off holds for the register of its block, wherever that
  /// stands, and for those behind it.
  void TakeLengthSign(const ir::Word& word);
  /// Message, Print, Alarm, as their words are met.
  void Message(const ir::Word& word, const Value& value);

 private:
  void Speed(const ir::Word& word, double value);
  void Tool(const Value& value, bool edge_follows);
  void TakeTool(bool edge_follows);
  void Offset(OffsetKind kind, double number);
  void Edge(double number);
  void Alarm(const ir::Word& word, const Value& value);
  std::uint32_t Whole(const Value& value);
  Channel::Spindle* SpindleOf(std::uint8_t index);

  Session& session_;
  Channel& channel_;
  Emitter& emitter_;
  Evaluator& evaluator_;
};

}  // namespace ncport::exec
