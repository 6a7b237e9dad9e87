// The library from outside: text in, text and findings out.
#include "app/ncport.h"

#include <doctest/doctest.h>

#include <string>

namespace ncport {
namespace {

struct Call {
  Context context;
  std::string text;
  OutputSink output{text};

  [[nodiscard]] std::string Codes() const {
    std::string codes;
    for (const diag::Diagnostic& finding : context.findings.All()) {
      if (!codes.empty()) codes += ' ';
      codes += diag::InfoOf(finding.code).number;
    }
    return codes;
  }
};

TraceOptions Tracing() {
  TraceOptions options;
  options.from = "sinumerik-840d-mill";
  return options;
}

TEST_CASE("Trace prints what the program does") {
  Call call;
  REQUIRE(Trace(call.context, {{"a.mpf", "G0 X1 Y2\nG1 X=R1 F100\nM30\n"}}, Tracing(), call.output).Ok());
  CHECK(call.text == "RAPID X1 Y2\nLINE X0 Y2 F100\nEND\n");
  CHECK(call.context.findings.Empty());
}

TEST_CASE("Fix repairs the texts and takes the findings out") {
  Call call;
  CheckOptions options;
  options.from = "sinumerik-840d-mill";
  (void)Check(call.context, {{"a.mpf", "IF R1 < = 5 GOTOF NEXT ; < =\r\nG999\r\nNEXT: M30"}}, options);
  CHECK(call.Codes() == "NC1020 NC1015");
  const std::vector<FixedFile> fixed = Fix(call.context);
  REQUIRE(fixed.size() == 1);
  CHECK(fixed[0].name == "a.mpf");
  CHECK(fixed[0].fixes == 1);
  CHECK(fixed[0].after == "IF R1 <= 5 GOTOF NEXT ; < =\r\nG999\r\nNEXT: M30");
  CHECK(call.Codes() == "NC1015");
}

TEST_CASE("called programs come from the provider, each asked for once") {
  Call call;
  std::string asked;
  TraceOptions options = Tracing();
  options.find = [&](std::string_view program) -> std::optional<Input> {
    asked += std::string(program) + " ";
    if (program == "RING") return Input{"ring.spf", "G0 X5\nDEEPER\nRET\n"};
    if (program == "DEEPER") return Input{"deeper.spf", "G0 X6\nRING2\nRET\n"};
    return std::nullopt;
  };
  CHECK(!Trace(call.context, {{"a.mpf", "RING\nRING\nM30\n"}}, options, call.output).Ok());
  CHECK(asked == "RING DEEPER RING2 ");
  CHECK(call.Codes() == "NC4002");
}

TEST_CASE("--call, --set and --start reach the run") {
  Call call;
  TraceOptions options = Tracing();
  options.call = "RING(2.5,,1)";
  options.set = {"R1=7"};
  options.start = "X0Y0Z10";
  const std::vector<Input> inputs = {
      {"a.mpf", "M30\n"}, {"ring.spf", "PROC RING(REAL RAD, REAL MISS, INT NN)\nG91 G0 X=RAD Y=R1 Z=NN+MISS\nRET\n"}};
  REQUIRE(Trace(call.context, inputs, options, call.output).Ok());
  CHECK(call.text.find("RAPID X2.5 Y7 Z11\n") == 0);
}

TEST_CASE("an alarm ends the run and fails") {
  Call call;
  CHECK(!Trace(call.context, {{"a.mpf", "G0 X1\nSETAL(65000,\"NO\")\nM30\n"}}, Tracing(), call.output).Ok());
  CHECK(call.text.find("ALARM 65000") != std::string::npos);
}

TEST_CASE("without a profile the language is guessed for a trace, with a note, and refused for a flat program") {
  Call call;
  REQUIRE(Trace(call.context, {{"a.mpf", "G0 X1\nM30\n"}}, TraceOptions{}, call.output).Ok());
  CHECK(call.Codes() == "NC2110");
  Call flat;
  FlattenOptions options;
  options.to = "iso-mill";
  CHECK(!Flatten(flat.context, {{"a.mpf", "G0 X1\nM30\n"}}, options, flat.output).Ok());
  CHECK(flat.Codes() == "NC2111");
  Call unclear;
  CHECK(!Trace(unclear.context, {{"a.txt", "G0 X1\n"}}, TraceOptions{}, unclear.output).Ok());
  CHECK(unclear.Codes() == "NC2107");
}

TEST_CASE("Flatten writes blocks, a source map, and columns") {
  FlattenOptions options;
  options.from = "sinumerik-840d-mill";
  options.to = "iso-mill";
  const std::vector<Input> inputs = {{"dir/a.mpf", "G0 X0\nLOOP1: R1=R1+1\nG1 X=R1 F100\nIF R1<2 GOTOB LOOP1\nM30\n"}};
  Call call;
  std::string map;
  OutputSink map_output(map);
  options.source_map = &map_output;
  REQUIRE(Flatten(call.context, inputs, options, call.output).Ok());
  CHECK(call.text == "(A.MPF FROM SINUMERIK-840D-MILL TO ISO-MILL, NCPORT " + std::string(Version()) +
                         ")\nG17 G21 G90 G94 G40\nG0 X0.\nG1 X1. F100.\nX2.\nM30\n");
  CHECK(map ==
        "{\"version\":1,\"out\":3,\"file\":\"dir/a.mpf\",\"line\":1,\"calls\":[],\"turns\":[1]}\n"
        "{\"version\":1,\"out\":4,\"file\":\"dir/a.mpf\",\"line\":3,\"calls\":[],\"turns\":[1]}\n"
        "{\"version\":1,\"out\":5,\"file\":\"dir/a.mpf\",\"line\":3,\"calls\":[],\"turns\":[2]}\n");

  Call columns;
  options.source_map = nullptr;
  options.side_by_side = true;
  REQUIRE(Flatten(columns.context, inputs, options, columns.output).Ok());
  const std::string blank(64, ' ');
  const std::string left = "a.mpf:3     G1 X=R1 F100";
  const std::string padded = left + std::string(64 - left.size(), ' ');
  CHECK(columns.text.find("\n" + padded + " | G1 X1. F100.\n" + padded + " | X2.\n" + blank + " | M30\n") !=
        std::string::npos);
}

TEST_CASE("what flat blocks cannot say fails with its place") {
  FlattenOptions options;
  options.from = "sinumerik-840d-mill";
  options.to = "iso-mill";
  Call call;
  CHECK(!Flatten(call.context, {{"a.mpf", "G0 X0\nG74 X1=0\nM30\n"}}, options, call.output).Ok());
  REQUIRE(call.Codes() == "NC6001");
  CHECK(call.context.findings.All()[0].at.line == 2);
  Call target;
  options.to = "fanuc-mill";
  CHECK(!Flatten(target.context, {{"a.mpf", "M30\n"}}, options, target.output).Ok());
  CHECK(target.Codes() == "NC6001");
}

TEST_CASE("a comment silences a code on its block, and only while it is needed") {
  CheckOptions options;
  options.from = "sinumerik-840d-mill";
  const auto codes = [&](const std::string& text) {
    Call call;
    (void)Check(call.context, {{"a.mpf", text + "M30\n"}}, options);
    return call.Codes();
  };
  CHECK(codes("G1 X=NONAME\n") == "NC2001");
  CHECK(codes("G1 X=NONAME ; ncport: ignore NC2001\n") == "");
  CHECK(codes("; ncport: ignore NC2001\nG1 X=NONAME\n") == "");
  CHECK(codes("G1 X=NONAME ; ncport: ignore NC3001, NC2001\n") == "NC2112");
  CHECK(codes("; ncport: ignore NC2001\nG0 X1\nG1 X=NONAME\n") == "NC2001 NC2112");
  options.ignore = {"NC2"};
  CHECK(codes("G1 X=NONAME\n") == "");
  options.ignore = {};
  options.select = {"NC3"};
  CHECK(codes("G1 X=NONAME\n") == "");
}

TEST_CASE("bytes that are no program are said to be none") {
  Call call;
  CHECK(!Trace(call.context,
               {{"a.mpf", std::string("\x7F"
                                      "ELF\0\0\0\0\x01\x02\x03\x80\x81\0\0\0\0\0\0\0\0\0",
                                      22)}},
               Tracing(), call.output)
             .Ok());
  CHECK(call.Codes() == "NC1001");
}

}  // namespace
}  // namespace ncport
