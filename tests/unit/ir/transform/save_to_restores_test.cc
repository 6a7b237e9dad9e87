#include "ir/transform/save_to_restores.h"

#include "tests/unit/ir/transform/dump_pass.h"

namespace ncport::ir::transform {
namespace {

std::string Restore(const std::string& text, diag::Sink& sink, const ModalState& start) {
  return test::After("ncport-ir 1\nfile m\n" + text, sink, [&](Module& module, diag::Sink& findings) {
    Machine machine;
    machine.start = start;
    return SaveToRestores(module, machine, {}, findings);
  });
}

ModalState Start() {
  ModalState start;
  start.distance = Distance::kAbsolute;
  return start;
}

constexpr std::string_view kSub =
    "program SUB sub @m:10 saves-modal-state header\n"
    "  @m:11 : distance incremental\n"
    "  @m:12 label OUT : return plain\n";

TEST_CASE("the caller's modes are put back behind a call (sinumerik-7.3)") {
  diag::Sink sink;
  const std::string text =
      "program M main @m:0\n"
      "  @m:1 : call name SUB calls SUB\n"
      "  @m:2 : axis X = 5\n"
      "  @m:3 : program-end #30\n" +
      std::string(kSub);
  CHECK(Restore(text, sink, Start()) ==
        "program M main\n"
        "call name SUB calls SUB\n"
        "distance absolute {added}\n"
        "axis X = 5\n"
        "program-end #30\n"
        "program SUB sub\n"
        "distance incremental\n"
        "label OUT return plain\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("a program that is called modally puts them back itself, also where jumps lead to its return") {
  diag::Sink sink;
  const std::string text =
      "program M main @m:0\n"
      "  @m:1 : modal-call name SUB calls SUB\n"
      "  @m:2 : axis X = 5\n"
      "  @m:3 : modal-call\n"
      "  @m:4 : program-end #30\n" +
      std::string(kSub);
  CHECK(Restore(text, sink, Start()) ==
        "program M main\n"
        "modal-call name SUB calls SUB\n"
        "axis X = 5\n"
        "modal-call\n"
        "program-end #30\n"
        "program SUB sub\n"
        "distance incremental\n"
        "label OUT distance absolute {added}\n"
        "return plain\n");
  CHECK_FALSE(sink.HasErrors());
}

TEST_CASE("what the modes were must be one value") {
  diag::Sink sink;
  const std::string text =
      "program M main @m:0\n"
      "  @m:1 : call name SUB calls SUB\n"
      "  @m:2 : axis X = 5\n"
      "  @m:3 : program-end #30\n" +
      std::string(kSub);
  Restore(text, sink, {});
  CHECK(sink.HasErrors());
}

TEST_CASE("the work offset of the caller is put back, also where only other axes move behind it") {
  const std::string sub =
      "program SUB sub @m:10 saves-modal-state header\n"
      "  @m:11 : work-offset #505\n"
      "  @m:12 : return plain\n";
  const std::string behind =
      "  @m:2 : call name SUB calls SUB\n"
      "  @m:3 : axis C = 5\n"
      "  @m:4 : program-end #30\n";
  diag::Sink sink;
  CHECK(Restore("program M main @m:0\n  @m:1 : work-offset #54\n" + behind + sub, sink, Start()) ==
        "program M main\n"
        "work-offset #54\n"
        "call name SUB calls SUB\n"
        "work-offset #54 {added}\n"
        "axis C = 5\n"
        "program-end #30\n"
        "program SUB sub\n"
        "work-offset #505\n"
        "return plain\n");
  CHECK_FALSE(sink.HasErrors());
  // Which one was in force before the program started is not known.
  Restore("program M main @m:0\n" + behind + sub, sink, Start());
  CHECK(sink.HasErrors());
}

TEST_CASE("the path mode of the start is named where one is put back that no word chose") {
  diag::Sink sink;
  const std::string text =
      "program M main @m:0\n"
      "  @m:1 : call name SUB calls SUB\n"
      "  @m:2 : axis X = 5\n"
      "  @m:3 : program-end #30\n"
      "program SUB sub @m:10 saves-modal-state header\n"
      "  @m:11 : path continuous\n"
      "  @m:12 : return plain\n";
  ModalState start;
  start.path = PathMode::kExact;
  CHECK(Restore(text, sink, start) ==
        "program M main\n"
        "path exact {added}\n"
        "call name SUB calls SUB\n"
        "path exact {added}\n"
        "axis X = 5\n"
        "program-end #30\n"
        "program SUB sub\n"
        "path continuous\n"
        "return plain\n");
  CHECK_FALSE(sink.HasErrors());
  Restore(text, sink, {});
  CHECK(sink.HasErrors());
}

TEST_CASE("a program that leaves another speed mode than its caller's is refused") {
  const auto text = [](const std::string& last) {
    return "program M main @m:0\n"
           "  @m:1 : call name SUB calls SUB\n"
           "  @m:2 : axis X = 5\n"
           "  @m:3 : program-end #30\n"
           "program SUB sub @m:10 saves-modal-state header\n"
           "  @m:11 : speed-mode constant-surface; speed = 100\n" +
           last + "  @m:14 : return plain\n";
  };
  ModalState start;
  start.feed_mode = FeedMode::kPerRevolution;
  start.speed_mode = SpeedMode::kRpm;
  diag::Sink back;
  Restore(text("  @m:12 : speed-mode rpm; speed = 800\n"), back, start);
  CHECK_FALSE(back.HasErrors());
  diag::Sink left;
  Restore(text(""), left, start);
  CHECK(left.HasErrors());
}

TEST_CASE("a mode that every way sets again before it is used is not put back, whatever it was") {
  diag::Sink sink;
  const auto behind = [&](const std::string& blocks, const ModalState& start) {
    const std::string whole =
        Restore("program M main @m:0\n  @m:1 : call name SUB calls SUB\n" + blocks + std::string(kSub), sink, start);
    return whole.find("absolute {added}") != std::string::npos;
  };
  CHECK_FALSE(behind("  @m:2 : program-end #30\n", {}));
  CHECK_FALSE(behind("  @m:2 : spindle 0 cw\n  @m:3 : axis X = 5 ; distance absolute\n  @m:4 : program-end #30\n", {}));
  CHECK_FALSE(sink.HasErrors());
  // Under a condition, in a block that may be skipped, behind a move, in a program that another one goes on behind.
  CHECK(behind("  @m:2 : axis X = 5\n  @m:3 : distance absolute\n  @m:4 : program-end #30\n", Start()));
  CHECK(behind("  @m:2 skip 0 : distance absolute\n  @m:3 : axis X = 5\n  @m:4 : program-end #30\n", Start()));
  CHECK(behind("  @m:2 : call name SUB calls SUB\n  @m:3 : distance absolute\n  @m:4 : program-end #30\n", Start()));
  CHECK(behind("  @m:2 : return plain\n", Start()));
}

TEST_CASE("a program that saves nothing stays as it is") {
  diag::Sink sink;
  CHECK(Restore("program M main @m:0\n  @m:1 : distance incremental\n  @m:2 : program-end #30\n", sink, Start()) ==
        "program M main\ndistance incremental\nprogram-end #30\n");
}

}  // namespace
}  // namespace ncport::ir::transform
