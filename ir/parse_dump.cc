#include "ir/parse_dump.h"

#include <limits>
#include <string>

#include "ir/dump.h"
#include "ir/dump_parser.h"
#include "ir/dump_syntax.h"
#include "ir/verify.h"

namespace ncport::ir {

namespace {

constexpr std::uint32_t kMaxNumber = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr std::size_t kMaxSpellings = std::numeric_limits<std::uint16_t>::max();

}  // namespace

template <class Callback>
void DumpParser::ForEachLine(Callback callback) {
  line_ = 0;
  std::string_view rest = text_;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    scan_.Start(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    ++line_;
    if (scan_.AtEnd()) continue;
    callback();
    if (!scan_.Failed() && !scan_.AtEnd()) scan_.Fail("the end of the line");
    if (scan_.Failed()) ReportScanner();
  }
}

void DumpParser::Report(diag::Code code, std::string_view expected, std::string_view found) {
  failed_ = true;
  sink_.Report(code, {file_, line_, scan_.Begin(), scan_.Begin() + 1}, expected, found);
}

void DumpParser::ReportScanner() { Report(diag::Code::kExpectedText, scan_.Expected(), scan_.Found()); }

Result<Module> DumpParser::Run() {
  // Names may be used before their lines: a first pass makes the records, the second fills them.
  Declare();
  if (failed_) return Failure{};
  program_ = {};
  bool first = true;
  ForEachLine([&] {
    if (!first) return Line();
    first = false;
    scan_.Need(kDumpTitle);
  });
  if (first) {
    line_ = 1;
    Report(diag::Code::kExpectedText, kDumpTitle, "nothing");
  }
  CloseProgram();
  if (!failed_) CheckLinks();
  if (failed_) return Failure{};
  if (const std::optional<std::string> violation = FindViolation(module_)) {
    line_ = 0;
    sink_.Report(diag::Code::kUnexpectedText, {file_, 1, 0, 1}, "content of a dump: " + *violation);
    return Failure{};
  }
  return std::move(module_);
}

void DumpParser::Declare() {
  const auto add = [](auto& map, StringId name, auto id) { map[name.value].push_back(id); };
  ForEachLine([&] {
    const char c = scan_.Peek();
    const std::string_view keyword = scan_.Keyword();
    const bool is_variable = keyword == "var" || keyword == "param";
    const bool is_record = is_variable || keyword == "file" || keyword == "axis" || keyword == "spelling" ||
                           keyword == "space" || keyword == "system" || keyword == "program";
    if (!is_record || c == '@') {
      scan_.Advance(scan_.Rest().size());  // the second pass reads it
      return;
    }
    const StringId name = NeedName();
    if (keyword == "file") {
      add(files_, name, FileId{module_.file_names.size()});
      module_.file_names.push_back(name);
    } else if (keyword == "axis") {
      if (module_.axis_names.size() >= kMaxAxes - kFirstNamedAxis) scan_.Fail("no more axes");
      module_.axis_names.push_back(name);
    } else if (keyword == "spelling") {
      if (module_.spellings.size() > kMaxSpellings) scan_.Fail("no more spellings");
      add(spellings_, name, Id<Spelling>{module_.spellings.size()});
      module_.spellings.push_back({name, {}});
    } else if (keyword == "space") {
      Space space;
      space.name = name;
      add(spaces_, name, module_.spaces.Add(space));
    } else if (keyword == "system") {
      System system;
      system.name = name;
      add(systems_, name, module_.systems.Add(system));
    } else if (keyword == "program") {
      Program program;
      program.name = name;
      program_ = module_.programs.Add(program);
      add(programs_, name, program_);
    } else {
      Variable variable;
      variable.name = name;
      variable.owner = program_;
      const VariableId id = module_.variables.Add(variable);
      add(variables_, name, id);
      by_owner_.try_emplace(static_cast<std::uint64_t>(program_.value) << 32U | name.value, id);
    }
    if (!scan_.Failed()) scan_.Advance(scan_.Rest().size());
  });
}

void DumpParser::Line() {
  const char c = scan_.Peek();
  if (c == '@') return BlockLine();
  if (c == ';') return CommentLine();
  const std::string_view keyword = scan_.PeekKeyword();
  if (keyword == "file" || keyword == "axis") {
    scan_.Keyword();
    NeedName();
  } else if (keyword == "spelling") {
    scan_.Keyword();
    NeedName();
    if (!scan_.TakeKeyword("rule")) scan_.Fail("rule");
    module_.spellings[spellings_read_++].rule = Name();
  } else if (keyword == "space") {
    SpaceLine();
  } else if (keyword == "system") {
    SystemLine();
  } else if (keyword == "program") {
    ProgramLine();
  } else if (keyword == "var" || keyword == "param") {
    VariableLine(keyword == "param");
  } else {
    scan_.Fail("a record");
  }
}

void DumpParser::SpaceLine() {
  scan_.Keyword();
  NeedName();
  Space& space = module_.spaces[SpaceId{spaces_read_++}];
  space.first = scan_.Number(kMaxNumber);
  scan_.Need("..");
  space.last = scan_.Number(kMaxNumber);
  space.type = Value<Type>("a type");
  space.lifetime = Value<Lifetime>("a lifetime");
  space.visibility = Value<Visibility>("a visibility");
  space.start = Value<StartValue>("a start value");
}

void DumpParser::SystemLine() {
  scan_.Keyword();
  NeedName();
  System& system = module_.systems[SystemId{systems_read_++}];
  system.kind = Value<SystemKind>("a kind of system variable");
  system.type = Value<Type>("a type");
  system.writable = scan_.TakeKeyword("writable");
  if (scan_.TakeKeyword("number")) system.number = scan_.Number(kMaxNumber);
}

void DumpParser::ProgramLine() {
  CloseProgram();
  scan_.Keyword();
  NeedName();
  program_ = ProgramId{programs_read_++};
  Program& program = module_.programs[program_];
  program.blocks.begin = static_cast<std::uint32_t>(module_.blocks.Size());
  program.kind = Value<ProgramKind>("main or sub");
  if (scan_.Peek() == '@') {
    program.file = FileRef();
    program.header_line = scan_.Number(kMaxNumber);
  }
  program.saves_modal_state = scan_.TakeKeyword("saves-modal-state");
  program.has_header = scan_.TakeKeyword("header");
  program.library = scan_.TakeKeyword("library");
}

void DumpParser::CloseProgram() {
  if (!program_.Valid()) return;
  IdRange<BlockId>& blocks = module_.programs[program_].blocks;
  blocks.count = static_cast<std::uint32_t>(module_.blocks.Size()) - blocks.begin;
}

void DumpParser::VariableLine(bool is_parameter) {
  scan_.Keyword();
  const VariableId id{variables_read_++};
  NeedName();
  if (is_parameter) {
    if (!program_.Valid()) return scan_.Fail("a program before its parameters");
    IdRange<VariableId>& parameters = module_.programs[program_].parameters;
    if (parameters.Empty()) parameters.begin = id.value;
    if (parameters.begin + parameters.count++ != id.value) return scan_.Fail("all parameters before other variables");
  }
  // Expressions in between may not add variables, so that the reference holds.
  Variable& variable = module_.variables[id];
  variable.type = Value<Type>("a type");
  variable.scope = Value<Scope>("a scope");
  variable.by_reference = scan_.TakeKeyword("ref");
  Shape(variable.dimension_count, variable.dimensions, variable.string_length);
  if (scan_.TakeKeyword("definition")) variable.definition = static_cast<std::uint8_t>(scan_.Number(255));
  variable.initial = Optional("initial");
  if (scan_.TakeKeyword("initial-list")) variable.initial_list = AssignListText();
  variable.lower_limit = Optional("lower");
  variable.upper_limit = Optional("upper");
  if (scan_.TakeKeyword("at")) {
    variable.file = FileRef();
    variable.line = scan_.Number(kMaxNumber);
    variable.begin = scan_.Number(kMaxNumber);
    scan_.Need("+");
    variable.length = scan_.Number(kMaxNumber);
  }
}

OriginId DumpParser::OriginChain() {
  std::vector<Origin> chain;
  do {
    Origin origin;
    origin.file = FileRef();
    origin.line = scan_.Number(kMaxNumber);
    if (scan_.TakeKeyword("turn")) origin.turn = scan_.Number(kMaxNumber);
    if (scan_.TakeKeyword("pass")) origin.pass = NeedName();
    chain.push_back(origin);
    if (chain.size() > kMaxOriginDepth) scan_.Fail("a shorter chain of origins");
  } while (!scan_.Failed() && scan_.TakeKeyword("via"));
  OriginId id;
  for (std::size_t at = chain.size(); at-- > 0;) {
    chain[at].via = id;
    id = module_.origins.Add(chain[at]);
  }
  return id;
}

void DumpParser::BlockLine() {
  if (!program_.Valid()) return scan_.Fail("a program before its blocks");
  Block block;
  // `@-` is no origin; `@-:5` is one without file.
  const std::string_view rest = scan_.Rest();
  const bool no_origin = rest.substr(0, 2) == "@-" && rest.substr(0, 3) != "@-:";
  no_origin ? scan_.Need("@-") : static_cast<void>(block.origin = OriginChain());
  if (scan_.TakeKeyword("indent")) block.indent = static_cast<std::uint16_t>(scan_.Number(0xFFFF));
  if (scan_.TakeKeyword("skip")) block.skip_level = static_cast<std::uint8_t>(scan_.Number(254));
  if (scan_.Peek() == 'N') {
    scan_.Advance(1);
    const std::string_view digits = scan_.PeekKeyword();
    block.number = scan_.Number(kMaxNumber);
    if (digits.size() > 255) scan_.Fail("a shorter block number");
    block.number_digits = static_cast<std::uint8_t>(digits.size());
  }
  if (scan_.TakeKeyword("digits")) block.number_digits = static_cast<std::uint8_t>(scan_.Number(255));
  if (scan_.TakeKeyword("label")) block.label = NeedName();
  if (scan_.TakeKeyword("link")) {
    const bool ahead = scan_.Take("+");
    if (!ahead) scan_.Need("-");
    const std::uint32_t distance = scan_.Number(kMaxNumber);
    const auto here = static_cast<std::uint32_t>(module_.blocks.Size());
    // Distances out of the program are found when its end is known.
    block.link.value = ahead ? here + distance : here - distance;
    if (ahead ? block.link.value < here : distance > here) scan_.Fail("a link inside the program");
  }
  for (std::size_t bit = 0; bit < std::size(kBlockFlagNames); ++bit) {
    if (scan_.TakeKeyword(kBlockFlagNames[bit])) block.flags |= static_cast<std::uint8_t>(1U << bit);
  }
  block.words.begin = static_cast<std::uint32_t>(module_.words.Size());
  if (scan_.Take(":")) {
    do {
      WordText();
    } while (!scan_.Failed() && scan_.Take(";"));
  }
  block.words.count = static_cast<std::uint32_t>(module_.words.Size()) - block.words.begin;
  block.comments.begin = static_cast<std::uint32_t>(module_.comments.Size());
  module_.blocks.Add(block);
  block_lines_.push_back(line_);
}

void DumpParser::CommentLine() {
  scan_.Need(";");
  if (!program_.Valid() || module_.programs[program_].blocks.begin == module_.blocks.Size()) {
    return scan_.Fail("a block before its comments");
  }
  Comment comment;
  comment.place = Value<CommentPlace>("a place of a comment");
  if (scan_.TakeKeyword("word")) comment.word = static_cast<std::uint16_t>(scan_.Number(0xFFFF));
  if (scan_.TakeKeyword("gap")) comment.gap = static_cast<std::uint16_t>(scan_.Number(0xFFFF));
  if (!scan_.Take("-")) comment.text = module_.strings.Intern(scan_.Text());
  module_.comments.Add(comment);
  ++module_.blocks.All().back().comments.count;
}

void DumpParser::CheckLinks() {
  for (const Program& program : module_.programs.All()) {
    for (const BlockId id : program.blocks) {
      const BlockId link = module_.blocks[id].link;
      if (!link.Valid()) continue;
      if (link.value >= program.blocks.begin && link.value - program.blocks.begin < program.blocks.count) continue;
      line_ = block_lines_[id.value];
      scan_.Start({});
      Report(diag::Code::kExpectedText, "a link inside the program", "one that leads out of it");
    }
  }
}

Result<Module> ParseDump(std::string_view text, diag::Sink& sink, FileId file) {
  return DumpParser{text, sink, file}.Run();
}

}  // namespace ncport::ir
