#include "ir/transform/frame_flow.h"

#include <doctest/doctest.h>

#include "ir/parse_dump.h"

namespace ncport::ir::transform {
namespace {

TEST_CASE("matrices: a rotation about Z, the way back, and what stays a circle") {
  const FrameMatrix turned = FrameMatrix{}.Rotated(2, 30).Scaled(0, 2).Scaled(1, 2);
  CHECK_FALSE(turned.IsDiagonal());
  REQUIRE(turned.Inverse());
  CHECK(turned.Inverse()->Times(turned).IsIdentity());
  REQUIRE(ImageOf(turned, 0, 1));
  CHECK(ImageOf(turned, 0, 1)->scale == doctest::Approx(2));
  CHECK_FALSE(ImageOf(turned, 0, 1)->mirrored);
  CHECK_FALSE(ImageOf(turned, 2, 0));
  CHECK(ImageOf(FrameMatrix{}.Scaled(0, -1), 0, 1)->mirrored);
  CHECK_FALSE(ImageOf(FrameMatrix{}.Scaled(2, -1), 0, 1)->mirrored);
  CHECK_FALSE(ImageOf(FrameMatrix{}.Scaled(0, 2), 0, 1));
  CHECK_FALSE(FrameMatrix{}.Scaled(1, 0).Inverse());
}

struct Flow {
  explicit Flow(std::string_view text, std::vector<bool> restores = {}, bool only_matrix = false) {
    Result<Module> parsed = ParseDump(std::string("ncport-ir 1\nfile m\n") + std::string(text), sink);
    REQUIRE(parsed.Ok());
    module = parsed.Value();
    graphs.emplace(module);
    calls.emplace(module);
    machine.start.plane = Plane::kXY;
    modes.emplace(module, machine, *graphs, *calls, analysis::ModalOptions{machine.start, {}});
    FrameFlowOptions options;
    options.restores = std::move(restores);
    options.only_matrix = only_matrix;
    frames.emplace(module, machine, *graphs, *calls, *modes, options);
  }
  FrameState Before(std::uint32_t program, std::uint32_t block) const {
    const ProgramId id{program};
    return frames->Before(module.programs[id].blocks[block]);
  }
  diag::Sink sink;
  Module module;
  Machine machine;
  std::optional<analysis::FlowGraphs> graphs;
  std::optional<analysis::CallGraph> calls;
  std::optional<analysis::ModalFlow> modes;
  std::optional<FrameFlow> frames;
};

constexpr std::string_view kMain =
    "program M main @m:0\n"
    "  @m:1 : call name SUB calls SUB\n"
    "  @m:2 : frame rotate; frame-angle = 90\n"
    "  @m:3 : axis X = 1\n"
    "  @m:4 : frame rotate\n"
    "  @m:5 : axis X = 1\n"
    "  @m:6 : call name SUB calls SUB\n"
    "  @m:7 : program-end #30\n";

TEST_CASE("a frame ends with its word alone, and a program that resets its own leaves none behind") {
  const Flow flow(
      std::string(kMain) +
      "program SUB sub @m:10\n  @m:11 : frame mirror; axis X = 0\n  @m:12 : frame mirror\n  @m:13 : return plain\n");
  CHECK(flow.Before(0, 1).untouched);
  CHECK(flow.Before(0, 2).kind == FrameState::Kind::kKnown);
  CHECK_FALSE(flow.Before(0, 2).matrix.IsIdentity());
  CHECK(flow.Before(0, 4).untouched);
  CHECK(flow.Before(0, 6).untouched);
  CHECK(flow.Before(1, 0).untouched);
}

TEST_CASE("a frame that a program leaves to its caller, or finds there, is not known; SAVE puts it back") {
  const std::string text =
      std::string(kMain) + "program SUB sub @m:10\n  @m:11 : frame add-mirror; axis X = 0\n  @m:12 : return plain\n";
  const Flow flow(text);
  CHECK(flow.Before(0, 1).kind == FrameState::Kind::kUnknown);
  CHECK(flow.Before(0, 2).kind == FrameState::Kind::kKnown);
  const Flow saved(text, {false, true});
  CHECK(saved.Before(0, 1).untouched);
  CHECK(saved.Before(1, 1).kind == FrameState::Kind::kKnown);
}

TEST_CASE("a program called under a frame does not know it") {
  const Flow flow(
      "program M main @m:0\n"
      "  @m:1 : frame translate; axis X = 1\n"
      "  @m:2 : call name SUB calls SUB\n"
      "  @m:3 : program-end #30\n"
      "program SUB sub @m:10\n  @m:11 : axis X = 0\n  @m:12 : return plain\n");
  CHECK(flow.Before(1, 0).kind == FrameState::Kind::kUnknown);
  CHECK(flow.Before(0, 2).kind == FrameState::Kind::kKnown);
}

TEST_CASE("a modal call leaves its frame behind each block with motion, until it ends") {
  const std::string_view sub =
      "program SUB sub @m:10\n  @m:11 : frame add-translate; axis Z = 1\n  @m:12 : return plain\n";
  const std::string_view caller =
      "program M main @m:0\n"
      "  @m:1 : modal-call name SUB calls SUB\n"
      "  @m:2 : axis X = 1\n"
      "  @m:3 : modal-call\n"
      "  @m:4 : axis Z = 1\n"
      "  @m:5 : program-end #30\n";
  const Flow flow(std::string(caller) + std::string(sub));
  CHECK(flow.Before(0, 1).untouched);
  CHECK(flow.Before(0, 2).kind == FrameState::Kind::kUnknown);
  CHECK(flow.Before(0, 3).kind == FrameState::Kind::kUnknown);
  CHECK(flow.Before(1, 0).kind == FrameState::Kind::kUnknown);
  const Flow saved(std::string(caller) + std::string(sub), {false, true});
  CHECK(saved.Before(0, 3).untouched);
}

TEST_CASE("a matrix alone goes along into called programs and back") {
  const std::string text =
      "program M main @m:0\n  @m:1 : frame scale; axis X = 2\n  @m:2 : call name SUB calls SUB\n  @m:3 : axis X = 1\n"
      "  @m:4 : program-end #30\n"
      "program SUB sub @m:10\n  @m:11 : axis X = 1\n  @m:12 : frame add-scale; axis Y = 3\n  @m:13 : return plain\n";
  CHECK(Flow(text).Before(1, 0).kind == FrameState::Kind::kUnknown);
  const Flow flow(text, {}, true);
  CHECK(flow.Before(1, 0).matrix == FrameMatrix{}.Scaled(0, 2));
  CHECK(flow.Before(0, 2).matrix == FrameMatrix{}.Scaled(0, 2).Scaled(1, 3));
}

TEST_CASE("behind a block that was not understood the frame is not known, up to a word that replaces it") {
  const Flow flow(
      "program M main @m:0\n  @m:1 : frame scale; axis X = 2\n  @m:2 refused : verbatim \"F[X]=1\"\n"
      "  @m:3 : axis X = 1\n  @m:4 : frame scale; axis Y = 2\n  @m:5 : program-end #30\n");
  CHECK(flow.Before(0, 1).kind == FrameState::Kind::kKnown);
  CHECK(flow.Before(0, 2).kind == FrameState::Kind::kUnknown);
  CHECK(flow.Before(0, 4).matrix == FrameMatrix{}.Scaled(1, 2));
}

}  // namespace
}  // namespace ncport::ir::transform
