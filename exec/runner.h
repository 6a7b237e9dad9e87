// One run: the loop over blocks, the phases of a block, jumps, calls.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exec/auxiliary.h"
#include "exec/block_work.h"
#include "exec/channel.h"
#include "exec/emitter.h"
#include "exec/evaluator.h"
#include "exec/kinematics.h"
#include "exec/link.h"
#include "exec/memory.h"
#include "exec/session.h"
#include "exec/texts.h"

namespace ncport::exec {

class Runner {
 public:
  Runner(const Linked& linked, const RunOptions& options, Environment& environment, EventSink& events, diag::Sink& sink,
         Coverage* coverage);

  RunResult Run();

 private:
  enum class LevelKind : std::uint8_t { kMain, kCall, kModal, kPart, kRange };
  /// Something that runs and comes back: the main program, a call, a repeated part.
  struct Level {
    LevelKind kind = LevelKind::kMain;
    ir::ProgramId program;
    std::uint32_t begin = 0, end = 0;  // blocks it runs
    ir::BlockId from;                  // the block that started it
    bool finish_block = false;         // the last phase of that block is still to come
    std::uint32_t words_end = 0;       // of that block: words from here on were cut off
    std::uint32_t passes_left = 0;
    CallFacts facts;                              // of the level itself
    Memory::Address stack = 0;                    // memory is given back down to here
    Memory::Address arguments = Memory::kNoRoom;  // parameters as passed, for further passes
    std::uint32_t saved = kNotSaved;              // index in saves_
    std::uint32_t modal = kNoModal;               // kModal: which one runs
    std::size_t turns = 0;                        // first counter of the level in turn_counts_
    bool keeps_locals = false;                    // definitions do not make the locals anew
    std::uint32_t call = kNoCall;                 // ir::CallId
  };
  static constexpr std::uint32_t kNotSaved = 0xFFFFFFFFU;
  static constexpr std::uint32_t kNoModal = 0xFFFFFFFFU;
  static constexpr std::uint32_t kNoCall = 0xFFFFFFFFU;

  struct Save {
    ir::ModalState modal;
    Frame frame;
  };
  /// A modal call in force.
  struct Modal {
    ir::CallId call;
    ir::ProgramId program;
    std::uint32_t place = 0;  // of its frame
    std::uint32_t passes = 1;
    std::uint64_t given = 0;
    bool started = false;  // its locals exist
  };

  // run.cc
  bool Prepare();
  void Loop();
  void ExecuteBlock(std::uint32_t index, std::uint16_t use);
  void Gather(const ir::Block& block);
  void GatherComputed(const ir::Word& word, double code, const std::vector<ir::CodeMeaning>& codes);
  void Collect(const ir::Word& word, const Value& value);
  void CollectFrame(ir::FrameOp op);
  void Settings(const ir::Block& block);
  double TakeOffsetNumber();
  void Actions(const ir::Block& block, ir::Phase phase);
  [[nodiscard]] ir::Phase PhaseOf(const ir::Word& word) const;
  void FinishBlock(ir::BlockId id, std::uint32_t words_end);
  void AtLimit();
  void EndRun();
  void Report();
  void CollectGarbage();
  void CountTurn(std::uint32_t index);
  void Cover(std::uint8_t bits);

  // data.cc
  void Assign(const ir::Word& word, const Value& value);
  void AssignList(ir::AssignListId id);
  void Define(ir::VariableId id);
  void DataSetting(ir::CallId id);
  void FillFrom(const Place& first, const ir::AssignList& list);
  void ApplyStartValues();
  void ReportVariables();
  void ReportCell(std::string_view name, const Value& value);

  // flow.cc
  bool Flow(const ir::Block& block);
  bool Mark(const ir::Block& block, const ir::Word& word);
  bool Jump(ir::JumpId id);
  bool JumpTo(ir::BlockId target);
  bool Switch(const ir::Word& word);
  bool RepeatPart(const ir::Word& word);
  bool CountingLoop(const ir::Block& opening, bool first, ir::BlockId closing);
  void Last(const ir::Block& block, std::uint32_t words_end);
  void LastWord(const ir::Word& word);
  ir::BlockId FindTarget(const ir::Target& target, ir::ProgramId program, ir::BlockId from, ir::Search search,
                         std::string& name);
  void Branch(bool taken) { Cover(taken ? 2 : 4); }

  // calls.cc
  bool Call(ir::CallId id);
  bool CallRange(const ir::Call& call, std::uint32_t passes);
  bool StartModal(const ir::Word& word);
  bool TriggerModal();
  ir::ProgramId Callee(const ir::Call& call);
  bool Passes(const ir::Call& call, std::uint32_t& passes);
  bool EvalArguments(const ir::Call& call, ir::ProgramId program, std::uint64_t& given);
  void PutArguments(const ir::Call& call, ir::ProgramId program, Memory::Address level, Memory::Address frame);
  void InitFrame(ir::ProgramId program, Memory::Address frame);
  bool Deeper();
  void Enter(Level level);
  /// A level over all blocks of the program, called by the block that runs. Memory and arguments are the caller's task.
  [[nodiscard]] Level CalledLevel(LevelKind kind, ir::ProgramId program, std::uint32_t passes) const;
  /// Goes on in a level that was called; a program that saves modal state and frame finds them kept.
  void EnterCalled(Level level);
  void Leave();  // the innermost level ends: next pass or back
  void PopLevel();
  void Return();  // from the innermost call
  void ReturnTo(ir::ExprId target);
  void DropParts();                              // repeated parts on top of the stack
  void Activate();                               // facts_ and limit_ follow the innermost level
  [[nodiscard]] const Level& CallLevel() const;  // the innermost level with locals of its own

  Session session_;
  Texts texts_;
  Memory memory_;
  Channel channel_;
  CallFacts facts_;
  Evaluator evaluator_;
  Emitter emitter_;
  Kinematics kinematics_;
  Auxiliary auxiliary_;

  std::vector<Level> levels_;
  std::vector<Save> saves_;
  std::vector<Modal> modals_;
  std::uint32_t calls_ = 0;  // levels that count for the depth of calls
  std::uint32_t pc_ = 0;     // next block
  std::uint32_t limit_ = 0;  // first block behind the innermost level
  bool done_ = false;
  std::uint64_t executed_ = 0;

  // Of the block in work.
  BlockWork work_;
  std::vector<Value> values_;           // per word
  bool drills_ = false;                 // it makes a hole
  std::uint32_t words_end_ = 0;         // words from here on were cut off (When, SkipRest)
  std::vector<ir::Word> computed_;      // words made by codes that were computed
  std::vector<Value> arguments_;        // of a call
  std::vector<ir::VariableId> preset_;  // set from outside: their definitions do not overwrite them

  std::vector<ir::BlockId> call_blocks_;
  std::vector<std::uint32_t> turns_;
  std::vector<std::uint32_t> turn_counts_;
  CallFrameView frames_;
};

}  // namespace ncport::exec
