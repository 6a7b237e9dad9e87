#include "exec/link.h"

#include <algorithm>
#include <limits>

#include "ir/analysis/tool_change.h"

namespace ncport::exec {
namespace {

using ir::BlockId;
using ir::ExprId;

constexpr std::uint16_t kDeepestExpression = 1000;
constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

// Frames are laid out when linking. One larger than this is not: the run that needs it stops with a finding.
constexpr std::uint64_t kMostElements = 1U << 22U;
constexpr std::uint32_t kOversized = kNowhere / 2;

std::uint32_t Elements(const ir::Variable& variable) {
  std::uint64_t count = 1;
  for (int i = 0; i < variable.dimension_count; ++i) count *= std::max(1U, variable.dimensions[i]);
  return static_cast<std::uint32_t>(std::min(count, kMostElements + 1));
}

bool UsesTargets(const ir::Call& call) { return call.form == ir::CallForm::kBlockRange || call.from_block; }

std::uint32_t SaturatingAdd(std::uint32_t a, std::uint32_t b) { return a > kNowhere / 2 - b ? kNowhere / 2 : a + b; }

/// Depth of each expression, or nothing if none is deeper than kDeepestExpression.
std::vector<std::uint16_t> DepthsOfDeep(const ir::Module& module) {
  // Numbers nest in nothing, and most modules have few other expressions.
  std::size_t operations = 0;
  for (const ir::Expr& expr : module.exprs.All()) operations += expr.op != ir::ExprOp::kLiteral ? 1U : 0U;
  if (operations < kDeepestExpression) return {};
  std::vector<std::uint16_t> depths(module.exprs.Size(), 1);
  bool deep = false;
  // Children stand before their parents.
  for (const ExprId id : module.exprs.Ids()) {
    const ir::Expr& expr = module.exprs[id];
    if (expr.op == ir::ExprOp::kLiteral) continue;
    std::uint16_t depth = 0;
    const auto take = [&](std::uint32_t child) {
      if (child < id.value) depth = std::max(depth, depths[child]);
    };
    switch (ir::OperandsOf(expr.op)) {
      case ir::Operands::kLeaf:
        break;
      case ir::Operands::kUnary:
        take(expr.a);
        break;
      case ir::Operands::kBinary:
        take(expr.a);
        take(expr.b);
        break;
      case ir::Operands::kList:
        for (std::uint32_t i = 0; i < expr.count; ++i) take(module.Item(expr.b + i).value);
        break;
    }
    depths[id.value] = static_cast<std::uint16_t>(std::min(depth + 1, 0xFFFF));
    deep = deep || depths[id.value] > kDeepestExpression;
  }
  if (!deep) depths.clear();
  return depths;
}

}  // namespace

Linked::Linked(const ir::Module& module, const ir::Machine& machine) : module_(&module), machine_(&machine) {
  LayOutVariables();
  ClassifyBlocks();
  IndexTargets();
  tool_word_changes_ = ir::analysis::WhenToolsChange(module, machine) != ir::analysis::ToolChange::kAtChangeWord;
}

void Linked::LayOutVariables() {
  const ir::Module& module = *module_;
  frames_.resize(module.programs.Size());
  oversized_.assign(module.programs.Size(), 0);
  std::uint8_t fixed_oversized = 0;
  for (const ir::VariableId id : module.variables.Ids()) {
    const ir::Variable& variable = module.variables[id];
    VariableSlot slot;
    slot.count = Elements(variable);
    const bool owned =
        variable.owner.Valid() && variable.scope != ir::Scope::kChannel && variable.scope != ir::Scope::kGlobal;
    slot.in_frame = owned;
    std::vector<Value>& cells = owned ? frames_[variable.owner.value] : fixed_values_;
    slot.offset = static_cast<std::uint32_t>(cells.size());
    if (cells.size() + slot.count > kMostElements) {
      (owned ? oversized_[variable.owner.value] : fixed_oversized) = 1;
      slot.offset = 0;
      variable_slots_.push_back(slot);
      continue;
    }
    // A reference takes one cell, which holds the address of what the caller passed.
    cells.insert(cells.end(), variable.by_reference ? 1 : slot.count,
                 variable.by_reference ? Value::Vacant() : ZeroOf(variable.type));
    variable_slots_.push_back(slot);
  }
  for_slots_.assign(module.fors.Size(), 0);
  bool modal_calls = false;
  const bool loops_or_calls = !module.fors.Empty() || !module.calls.Empty();  // else there is nothing to lay out
  for (const ir::ProgramId id : module.programs.Ids()) {
    if (!loops_or_calls) break;
    for (const BlockId block : module.programs[id].blocks) {
      for (const ir::WordId word_id : module.blocks[block].words) {
        const ir::Word& word = module.words[word_id];
        modal_calls = modal_calls || word.op == ir::WordOp::kModalCall;
        if (word.op != ir::WordOp::kFor) continue;
        for_slots_[word.extra] = static_cast<std::uint32_t>(frames_[id.value].size());
        frames_[id.value].push_back(Value::Vacant());
      }
    }
  }
  fixed_cells_ = fixed_oversized != 0 ? kOversized : static_cast<std::uint32_t>(fixed_values_.size());
  for (const ir::SpaceId id : module.spaces.Ids()) {
    const ir::Space& space = module.spaces[id];
    if (space.visibility == ir::Visibility::kLevel)
      level_cells_ = SaturatingAdd(level_cells_, space.last - space.first + 1);
  }
  if (modal_calls) {
    std::size_t largest = 0;
    for (const std::vector<Value>& frame : frames_) largest = std::max(largest, frame.size());
    modal_offset_ = fixed_cells_;
    modal_size_ = SaturatingAdd(level_cells_, static_cast<std::uint32_t>(largest));
    modal_places_ = machine_->modal_call_levels + 1;
    for (std::uint32_t i = 0; i < modal_places_; ++i) fixed_cells_ = SaturatingAdd(fixed_cells_, modal_size_);
  }
  named_cells_ = fixed_cells_;
  std::uint32_t level_offset = 0;
  for (const ir::SpaceId id : module.spaces.Ids()) {
    const ir::Space& space = module.spaces[id];
    SpaceSlot slot;
    slot.per_level = space.visibility == ir::Visibility::kLevel;
    std::uint32_t& size = slot.per_level ? level_offset : fixed_cells_;
    slot.offset = size;
    size = SaturatingAdd(size, SaturatingAdd(space.last - space.first, 1));
    space_slots_.push_back(slot);
  }
}

std::uint32_t Linked::FrameSize(ir::ProgramId program) const {
  return oversized_[program.value] != 0 ? kOversized : static_cast<std::uint32_t>(frames_[program.value].size());
}

void Linked::ClassifyBlocks() {
  const ir::Module& module = *module_;
  const std::vector<std::uint16_t> depths = DepthsOfDeep(module);

  uses_.assign(module.blocks.Size(), 0);
  for (const BlockId id : module.blocks.Ids()) {
    const ir::Block& block = module.blocks[id];
    std::uint16_t use = 0;
    for (const ir::WordId word_id : block.words) {
      const ir::Word& word = module.words[word_id];
      use |= static_cast<std::uint16_t>(1U << static_cast<unsigned>(word.phase));
      if (ir::IsStructureMark(word.op)) use |= kUseMark;
      if (word.op == ir::WordOp::kVerbatim) use |= kUseRefused;
    }
    if ((block.flags & ir::Block::kRefused) != 0) use |= kUseRefused;
    // Expressions are reached from words in many ways; a module with a deep one refuses every block that computes.
    if (!depths.empty() && use != 0) {
      for (const ir::WordId word : block.words) {
        const ir::ExprId value = module.words[word].value;
        if ((value.Valid() && depths[value.value] > kDeepestExpression)) use |= kUseTooDeep;
        if (!value.Valid() && module.words[word].extra != ir::ExprId::kNone) use |= kUseTooDeep;
      }
    }
    uses_[id.value] = use;
    largest_block_ = std::max(largest_block_, block.words.count);
  }

  if (module.programs.Size() > 1) {
    program_of_.assign(module.blocks.Size(), kNowhere);
    for (const ir::ProgramId program : module.programs.Ids()) {
      for (const BlockId block : module.programs[program].blocks) program_of_[block.value] = program.value;
    }
  }
}

ir::ProgramId Linked::ProgramOf(BlockId block) const {
  if (program_of_.empty()) return ir::ProgramId{std::size_t{0}};
  ir::ProgramId program;
  program.value = program_of_[block.value];
  return program;
}

void Linked::IndexTargets() {
  const ir::Module& module = *module_;
  // A plain program jumps nowhere and may have a million numbered blocks: tables are made where something looks into
  // them.
  labels_.resize(module.programs.Size());
  bool all = false;
  std::vector<bool> wanted(module.programs.Size(), false);
  for (const ir::ProgramId id : module.programs.Ids()) {
    for (const BlockId block : module.programs[id].blocks) {
      if ((uses_[block.value] & (kUseFlow | kUseLast)) == 0) continue;
      for (const ir::WordId word_id : module.blocks[block].words) {
        const ir::Word& word = module.words[word_id];
        switch (word.op) {
          case ir::WordOp::kJump:
          case ir::WordOp::kSwitch:
          case ir::WordOp::kRepeatPart:
            wanted[id.value] = true;
            break;
          case ir::WordOp::kReturn:
            if (static_cast<ir::ReturnKind>(word.index) == ir::ReturnKind::kToCaller) all = true;
            break;
          case ir::WordOp::kCall:
          case ir::WordOp::kModalCall:
            if (word.extra != ir::CallId::kNone && UsesTargets(module.calls[word.Extra<ir::CallId>()])) all = true;
            break;
          default:
            break;
        }
      }
    }
  }
  for (const ir::ProgramId id : module.programs.Ids()) {
    if (!all && !wanted[id.value]) continue;
    labels_[id.value] = std::make_unique<ir::analysis::LabelTable>(module, id);
  }
  static_targets_.assign(module.jumps.Size(), {});
  for (const ir::ProgramId id : module.programs.Ids()) {
    if (wanted[id.value]) ResolveJumps(id);
  }
}

void Linked::ResolveJumps(ir::ProgramId program) {
  const ir::Module& module = *module_;
  const auto resolve = [&](ir::JumpId id, BlockId from) {
    const ir::Jump& jump = module.jumps[id];
    if (jump.target.kind != ir::TargetKind::kExpression)
      static_targets_[id.value] = LabelsOf(program)->Find(jump.target, from, jump.search);
  };
  for (const BlockId block : module.programs[program].blocks) {
    if ((uses_[block.value] & kUseFlow) == 0) continue;
    for (const ir::WordId word_id : module.blocks[block].words) {
      const ir::Word& word = module.words[word_id];
      if (word.op == ir::WordOp::kJump) resolve(word.Extra<ir::JumpId>(), block);
      if (word.op != ir::WordOp::kSwitch) continue;
      const ir::Switch& arms = module.switches[word.Extra<ir::SwitchId>()];
      for (std::uint32_t i = 0; i < arms.arm_count; ++i) resolve(module.switch_arms[arms.first_arm + i].jump, block);
    }
  }
}

}  // namespace ncport::exec
