#include "ir/dump.h"

#include <fmt/format.h>

#include "ir/dump_syntax.h"
#include "ir/dump_writer.h"

namespace ncport::ir {

DumpWriter::DumpWriter(const Module& module, TextBuffer& out, const DumpOptions& options)
    : module_(module), out_(out), options_(options), owned_(module.programs.Size()) {
  for (const ProgramId id : module.programs.Ids()) programs_.Add(id, module.programs[id].name);
  for (const SpaceId id : module.spaces.Ids()) spaces_.Add(id, module.spaces[id].name);
  for (const SystemId id : module.systems.Ids()) systems_.Add(id, module.systems[id].name);
  for (std::size_t i = 0; i < module.file_names.size(); ++i) files_.Add(FileId{i}, module.file_names[i]);
  for (std::size_t i = 1; i < module.spellings.size(); ++i) {
    spellings_.Add(Id<Spelling>{i}, module.spellings[i].text);
  }
  // Variables count in the order of the dump: those of no program, then program by program.
  for (const VariableId id : module.variables.Ids()) {
    const ProgramId owner = module.variables[id].owner;
    (module.programs.Contains(owner) ? owned_[owner.value] : unowned_).push_back(id);
  }
  const auto add = [&](VariableId id, ProgramId owner) {
    const StringId name = module.variables[id].name;
    variables_.Add(id, name);
    by_owner_.try_emplace(static_cast<std::uint64_t>(owner.value) << 32U | name.value, id);
  };
  for (const VariableId id : unowned_) add(id, ProgramId{});
  for (const ProgramId owner : module.programs.Ids()) {
    for (const VariableId id : owned_[owner.value]) add(id, owner);
  }
}

void DumpWriter::Place(FileId file, std::uint32_t line) {
  Put('@');
  if (!file.Valid()) {
    Put('-');
  } else if (file.value >= module_.file_names.size()) {
    Unknown(file.value);
  } else {
    Name(module_.file_names[file.value]);
    Ordinal(files_.Of(file));
  }
  Put(':');
  Number(line);
}

void DumpWriter::Declarations() {
  Put(kDumpTitle);
  Put('\n');
  for (const StringId name : module_.file_names) Put("file "), Name(name), Put('\n');
  for (const StringId name : module_.axis_names) Put("axis "), Name(name), Put('\n');
  if (options_.spellings) {
    for (std::size_t i = 1; i < module_.spellings.size(); ++i) {
      Put("spelling ");
      Name(module_.spellings[i].text);
      Put(" rule ");
      Name(module_.spellings[i].rule);
      Put('\n');
    }
  }
  for (const Space& space : module_.spaces.All()) {
    Put("space ");
    Name(space.name);
    Put(' ');
    Number(space.first);
    Put("..");
    Number(space.last);
    Put(' ');
    Known(space.type);
    Put(' ');
    Known(space.lifetime);
    Put(' ');
    Known(space.visibility);
    Put(' ');
    Known(space.start);
    Put('\n');
  }
  for (const System& system : module_.systems.All()) {
    Put("system ");
    Name(system.name);
    Put(' ');
    Known(system.kind);
    Put(' ');
    Known(system.type);
    if (system.writable) Put(" writable");
    if (system.number != 0) Put(" number "), Number(system.number);
    Put('\n');
  }
  program_ = {};
  for (const VariableId id : unowned_) Variable(id, "var ");
}

void DumpWriter::Variable(VariableId id, std::string_view keyword) {
  const ir::Variable& variable = module_.variables[id];
  Put(keyword);
  Name(variable.name);
  Put(' ');
  Known(variable.type);
  Put(' ');
  Known(variable.scope);
  if (variable.by_reference) Put(" ref");
  if (variable.string_length != 0) Put(" length "), Number(variable.string_length);
  if (variable.dimension_count != 0) {
    Put(" dims");
    for (unsigned d = 0; d < variable.dimension_count && d < 3; ++d) Put(' '), Number(variable.dimensions[d]);
  }
  if (variable.definition != 0) Put(" definition "), Number(variable.definition);
  Optional(" initial ", variable.initial);
  if (variable.initial_list.Valid()) Put(" initial-list "), AssignList(variable.initial_list);
  Optional(" lower ", variable.lower_limit);
  Optional(" upper ", variable.upper_limit);
  if (options_.places && (variable.file.Valid() || variable.line != 0 || variable.begin != 0 || variable.length != 0)) {
    Put(" at ");
    Place(variable.file, variable.line);
    Put(' ');
    Number(variable.begin);
    Put('+');
    Number(variable.length);
  }
  Put('\n');
}

void DumpWriter::Program(ProgramId id) {
  const ir::Program& program = module_.programs[id];
  program_ = id;
  Put("program ");
  Name(program.name);
  Put(' ');
  Known(program.kind);
  if (program.file.Valid() || program.header_line != 0) Put(' '), Place(program.file, program.header_line);
  if (program.saves_modal_state) Put(" saves-modal-state");
  if (program.has_header) Put(" header");
  if (program.library) Put(" library");
  const IdRange<VariableId> parameters = program.parameters;
  Put('\n');
  for (const VariableId variable : owned_[id.value]) {
    const bool is_parameter =
        variable.value >= parameters.begin && variable.value - parameters.begin < parameters.count;
    Variable(variable, is_parameter ? "  param " : "  var ");
  }
  for (std::uint32_t i = 0; i < program.blocks.count; ++i) {
    if (std::uint64_t{program.blocks.begin} + i >= module_.blocks.Size()) {
      Put("  ");
      Unknown(std::uint64_t{program.blocks.begin} + i);
      Put('\n');
      return;
    }
    Block(program.blocks[i], id);
  }
}

void DumpWriter::OriginChain(OriginId id) {
  for (unsigned depth = 0;; ++depth) {
    if (!module_.origins.Contains(id) || depth > kMaxOriginDepth) return Unknown(id.value);
    const Origin& origin = module_.origins[id];
    Place(origin.file, origin.line);
    if (origin.turn != 0) Put(" turn "), Number(origin.turn);
    if (origin.pass.Valid()) Put(" pass "), Name(origin.pass);
    if (!origin.via.Valid()) return;
    Put(" via ");
    id = origin.via;
  }
}

void DumpWriter::Block(BlockId id, ProgramId program) {
  const ir::Block& block = module_.blocks[id];
  program_ = program;
  Put("  ");
  block.origin.Valid() ? OriginChain(block.origin) : Put("@-");
  if (block.indent != 0) Put(" indent "), Number(block.indent);
  if (block.skip_level != ir::Block::kNoSkip) Put(" skip "), Number(block.skip_level);
  if (block.number != ir::Block::kNoNumber) {
    const fmt::format_int text(block.number);
    Put(" N");
    for (std::size_t digits = text.size(); digits < block.number_digits; ++digits) Put('0');
    Put(std::string_view{text.data(), text.size()});
    if (block.number_digits < text.size()) Put(" digits "), Number(block.number_digits);
  } else if (block.number_digits != 0) {
    Put(" digits ");
    Number(block.number_digits);
  }
  if (block.label.Valid()) Put(" label "), Name(block.label);
  if (block.link.Valid()) {
    // How many blocks away: stays the same when blocks before change.
    Put(" link ");
    Put(block.link >= id ? '+' : '-');
    Number(block.link >= id ? block.link.value - id.value : id.value - block.link.value);
  }
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((block.flags >> bit & 1U) == 0) continue;
    Put(' ');
    bit < std::size(kBlockFlagNames) ? Put(kBlockFlagNames[bit]) : Unknown(bit);
  }
  for (std::uint32_t i = 0; i < block.words.count; ++i) {
    Put(i == 0 ? " : " : "; ");
    if (std::uint64_t{block.words.begin} + i >= module_.words.Size()) {
      Unknown(std::uint64_t{block.words.begin} + i);
      break;
    }
    Word(module_.words[block.words[i]]);
  }
  Put('\n');
  for (std::uint32_t i = 0; i < block.comments.count; ++i) {
    Put("    ; ");
    if (std::uint64_t{block.comments.begin} + i >= module_.comments.Size()) {
      Unknown(std::uint64_t{block.comments.begin} + i);
      Put('\n');
      break;
    }
    Comment(block.comments[i]);
  }
  if (options_.marked.Valid() && options_.marked == id) Put("  // ^ "), Put(options_.mark), Put('\n');
}

void DumpWriter::Comment(CommentId id) {
  const ir::Comment& comment = module_.comments[id];
  Known(comment.place);
  if (comment.word != 0) Put(" word "), Number(comment.word);
  if (comment.gap != 0) Put(" gap "), Number(comment.gap);
  Put(' ');
  if (!comment.text.Valid()) {
    Put('-');
  } else {
    comment.text.value < module_.strings.Size() ? Quoted(module_.strings.View(comment.text))
                                                : Unknown(comment.text.value);
  }
  Put('\n');
}

void Dump(const Module& module, TextBuffer& out, const DumpOptions& options) {
  DumpWriter writer(module, out, options);
  writer.Declarations();
  for (const ProgramId id : module.programs.Ids()) writer.Program(id);
}

}  // namespace ncport::ir
