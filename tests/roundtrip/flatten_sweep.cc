// ncport_flatten_sweep BINARY SOURCE [SEED]: TURNING_CYCLE of samples/ over many parameter sets. For each set
//   - the trace has the motions of a model written here, apart from ncport: layers, depths, feeds;
//   - the flat program, read back as iso, has the trace of the source within the error of its words;
//   - a set with nothing to remove ends in ALARM 14051 before any motion, and flatten writes no file.
// And seed_004, as its vendor printed it: it traces, and flatten refuses its D1 without a tool.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/tools/process.h"
#include "tests/tools/trace_compare.h"

namespace ncport::tests {
namespace {

namespace fs = std::filesystem;

constexpr int kRandomSets = 220;

std::string Number(double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.10g", value);
  return buffer;
}

/// Arguments of TURNING_CYCLE, see samples/turning_cycle/README.md.
struct Parameters {
  double extd = 100, intd = 50, endpz = -100, rall = 2.5, fallx = 0.25, fallz = 0.25, rfr = 0.25, ffr = 0.1, retr = 1;

  [[nodiscard]] std::string Call() const {
    std::string text = "TURNING_CYCLE(";
    for (const double value : {extd, intd, endpz, rall, fallx, fallz, rfr, ffr, retr}) {
      text += (text.back() == '(' ? "" : ",") + Number(value);
    }
    return text + ")";
  }
  [[nodiscard]] double Allowance() const { return std::max((extd - intd) / 2 - fallx, 0.0); }
  [[nodiscard]] bool DividesEvenly() const { return Allowance() - rall * std::trunc(Allowance() / rall) == 0; }
  [[nodiscard]] int Layers() const {
    return static_cast<int>(std::trunc(Allowance() / rall)) + (DividesEvenly() ? 0 : 1);
  }

  /// The motions of the cycle, as trace text without messages.
  [[nodiscard]] std::string Model() const {
    std::string text;
    const auto move = [&](const char* kind, double x, double z, double feed) {
      text +=
          std::string(kind) + " X" + Number(x) + " Z" + Number(z) + (feed > 0 ? " F" + Number(feed) + "/r" : "") + "\n";
    };
    const int layers = Layers();
    const double step = Allowance() / layers;
    move("RAPID", (extd + 1) / 2, 1, 0);
    move("RAPID", extd / 2, 1, 0);
    for (int layer = 1; layer <= layers; ++layer) {
      const double x = extd / 2 - layer * step;
      move("LINE", x, 1, rfr);
      move("LINE", x, endpz + fallz, rfr);
      move("LINE", x + retr, endpz + fallz, rfr);
      move("RAPID", x + retr, 1, 0);
      move("RAPID", x, 1, 0);
    }
    move("RAPID", (extd + 50) / 2, 50, 0);
    text += "TOOL \"FINISHING_T35 A\"\nOFFSET EDGE 1\n";
    move("RAPID", intd / 2, 1, 0);
    move("LINE", intd / 2, endpz, ffr);
    move("LINE", (extd + 1) / 2, endpz, ffr);
    move("RAPID", (extd + 1) / 2, 1, 0);
    return text;
  }
};

/// Half of the sets divide evenly, in steps that binary numbers hold exactly; the others are arbitrary hundredths.
std::vector<Parameters> RandomSets(std::mt19937& random) {
  const auto pick = [&](double low, double high, double unit) {
    std::uniform_int_distribution<int> steps(static_cast<int>(std::ceil(low / unit)),
                                             static_cast<int>(std::floor(high / unit)));
    return steps(random) * unit;
  };
  std::vector<Parameters> sets;
  while (sets.size() < kRandomSets) {
    Parameters p;
    p.endpz = -pick(1, 200, 0.5);
    p.fallz = pick(0, 1, 0.125);
    p.rfr = pick(0.05, 0.5, 0.05);
    p.ffr = pick(0.05, 0.3, 0.05);
    p.retr = pick(0.5, 3, 0.5);
    const bool evenly = sets.size() % 2 == 0;
    const double unit = evenly ? 0.125 : 0.01;
    p.extd = pick(20, 300, evenly ? 0.25 : 0.01);
    p.intd = pick(5, p.extd - 1, evenly ? 0.25 : 0.01);
    p.fallx = pick(0, 1, unit);
    p.rall = pick(0.2, 9.7, unit);
    if (evenly) {
      // As many layers as fit below the drawn finished diameter, which then moves to where they end.
      const int layers = static_cast<int>(p.Allowance() / p.rall);
      p.intd = p.extd - 2 * (layers * p.rall + p.fallx);
      if (layers == 0 || p.intd < 5 || p.intd > p.extd - 1) continue;
    }
    if (p.DividesEvenly() != evenly || p.Allowance() <= 0) continue;
    sets.push_back(p);
  }
  Parameters one_layer, many_layers, thin_rest;
  one_layer.extd = 52;
  many_layers.extd = 300;
  many_layers.rall = 0.25;
  thin_rest.extd = 60.002;
  thin_rest.rall = 0.5;
  for (const Parameters& p : {Parameters{}, one_layer, many_layers, thin_rest}) sets.push_back(p);
  return sets;
}

class Sweep {
 public:
  Sweep(std::string binary, fs::path source) : binary_(std::move(binary)), source_(std::move(source)) {
    config_ = folder_.Write("ncport.toml", "[tools]\n\"T1 D1\" = \"T0101\"\n'T=\"FINISHING_T35 A\" D1' = \"T0303\"\n");
  }

  int Run(unsigned seed) {
    std::mt19937 random(seed);
    const std::vector<Parameters> sets = RandomSets(random);
    std::set<std::string> traces;
    int evenly = 0, one_layer = 0, many_layers = 0, number = 0;
    for (const Parameters& p : sets) {
      evenly += p.DividesEvenly() ? 1 : 0;
      one_layer += p.Layers() == 1 ? 1 : 0;
      many_layers += p.Layers() > 100 ? 1 : 0;
      // Every fourth set through a main program of its own, the others by --call.
      const std::string trace =
          number++ % 4 == 0 ? Check(p, MainProgram(p), {}) : Check(p, CycleFile(), {"--call", p.Call()});
      traces.insert(trace);
    }
    NothingToRemove(random);
    SeedAsPrinted();
    const auto need = [&](bool holds, const std::string& what) {
      if (!holds) Fail("the sweep itself", what);
    };
    need(traces.size() >= 200, "only " + std::to_string(traces.size()) + " distinct traces");
    need(evenly >= 80 && static_cast<int>(sets.size()) - evenly >= 100,
         "the halves that divide evenly or not are too small");
    need(one_layer > 0 && many_layers > 0, "one layer and more than 100 layers do not both occur");
    std::printf(
        "%zu parameter sets (seed %u), %zu distinct traces, %d divide evenly, %d with one layer, %d with more than 100 "
        "layers; %d failed\n",
        sets.size(), seed, traces.size(), evenly, one_layer, many_layers, failures_);
    return failures_ == 0 ? 0 : 1;
  }

 private:
  using Options = std::vector<std::string>;

  [[nodiscard]] std::string CycleFile() const { return (source_ / "samples/turning_cycle/turning_cycle.spf").string(); }

  [[nodiscard]] std::string MainProgram(const Parameters& p) const {
    return folder_.Write("main.mpf",
                         "EXTERN TURNING_CYCLE(REAL, REAL, REAL, REAL, REAL, REAL, REAL, REAL, REAL)\n"
                         "G18 G40 G54 G71 G90 G95 DIAMON\nT1 D1\nG97 S800 M3\nG0 X400 Z50\n" +
                             p.Call() + "\nG0 X400 Z50\nM30\n");
  }

  ProcessResult Ncport(const char* command, const std::string& file, const Options& options,
                       const Options& more = {}) const {
    Options all = {binary_, command, file};
    if (!file.ends_with(".nc")) {
      for (const std::string& word : Options{"-I", (source_ / "samples/turning_cycle").string(), "--from",
                                             "sinumerik-840d-lathe", "--config", config_}) {
        all.push_back(word);
      }
    }
    all.insert(all.end(), options.begin(), options.end());
    all.insert(all.end(), more.begin(), more.end());
    return RunProcess(all);
  }

  void Fail(const std::string& what, const std::string& text) {
    if (++failures_ <= 20) std::printf("FAILED %s\n%s\n", what.c_str(), text.c_str());
  }

  /// All that must hold for one set; returns the trace text.
  std::string Check(const Parameters& p, const std::string& file, const Options& options) {
    const std::string name = p.Call() + " in " + fs::path(file).filename().string();
    const ProcessResult traced = Ncport("trace", file, options);
    if (traced.exit_code != 0) {
      Fail(name, "trace ends with code " + std::to_string(traced.exit_code) + "\n" + Tail(traced.errors, 6));
      return {};
    }
    const ParsedTrace source = ParseTrace(traced.output);
    if (!source.error.empty()) {
      Fail(name, source.error);
      return {};
    }
    CheckModel(name, p, source.trace);
    const std::string flat = folder_.File("flat.nc");
    fs::remove(flat);
    const ProcessResult flattened = Ncport("flatten", file, options, {"--to", "iso-lathe", "-o", flat});
    if (flattened.exit_code != 0 || !fs::exists(flat)) {
      Fail(name, "flatten ends with code " + std::to_string(flattened.exit_code) + "\n" + Tail(flattened.errors, 6));
      return traced.output;
    }
    const ProcessResult back = Ncport("trace", flat, {"--from", "iso-lathe"});
    const ParsedTrace again = ParseTrace(back.output);
    if (back.exit_code != 0 || !again.error.empty()) {
      Fail(name, "the flat program does not run (code " + std::to_string(back.exit_code) + ") " + again.error + "\n" +
                     Tail(back.errors, 6));
      return traced.output;
    }
    FlatAllowance allowance;
    allowance.diameter_words = true;
    allowance.maps = {{"TOOL 1", "TOOL 1"}, {"TOOL \"FINISHING_T35 A\"", "TOOL 3"}};
    Trace from = source.trace, to = again.trace;
    // The edges of the source and the offsets of the target belong to their tools; the map of tools was compared with
    // them.
    for (Trace* trace : {&from, &to}) {
      std::erase_if(trace->events, [](const TraceEvent& event) { return event.kind == "OFFSET"; });
    }
    if (const auto difference = CompareWithFlat(from, to, allowance))
      Fail(name, "flat program differs from its source: " + *difference);
    return traced.output;
  }

  void CheckModel(const std::string& name, const Parameters& p, const Trace& trace) {
    Trace moves = trace, model = ParseTrace(p.Model()).trace;
    std::erase_if(moves.events, [](const TraceEvent& event) {
      return !event.IsMove() && event.kind != "TOOL" && event.kind != "OFFSET";
    });
    // A main program moves to X400 Z50 before and after.
    std::erase_if(moves.events, [](const TraceEvent& event) {
      return (event.IsMove() && event.axes[0] && *event.axes[0] == 200) || event.line == "TOOL 1";
    });
    if (!moves.events.empty() && moves.events.front().kind == "OFFSET") moves.events.erase(moves.events.begin());
    if (const auto difference = CompareVector(moves, model))
      Fail(name, "trace differs from the model of the cycle: " + *difference);
    int messages = 0;
    for (const TraceEvent& event : trace.events) messages += event.line.starts_with("MSG ROUGHING") ? 1 : 0;
    if (messages != p.Layers())
      Fail(name, std::to_string(messages) + " layers instead of " + std::to_string(p.Layers()));
  }

  /// Allowance 0 or less: no layer, so the step formula divides by zero.
  void NothingToRemove(std::mt19937& random) {
    std::vector<Parameters> sets(8);
    for (Parameters& p : sets) {
      p.fallx = std::uniform_int_distribution<int>(0, 8)(random) * 0.125;
      p.intd = 40 + std::uniform_int_distribution<int>(0, 40)(random) * 0.25;
      p.extd = p.intd + 2 * p.fallx - (&p == sets.data() ? 0 : std::uniform_int_distribution<int>(0, 4)(random) * 0.25);
    }
    for (const Parameters& p : sets) {
      const std::string name = p.Call() + " with nothing to remove";
      const ProcessResult traced = Ncport("trace", CycleFile(), {"--call", p.Call()});
      const ParsedTrace trace = ParseTrace(traced.output);
      bool moved = false, alarmed = false;
      for (const TraceEvent& event : trace.trace.events) {
        moved |= event.IsMove();
        alarmed |= event.line.starts_with("ALARM 14051");
      }
      if (traced.exit_code != 1 || !alarmed || moved)
        Fail(name, "expected ALARM 14051 before any motion, exit 1; code " + std::to_string(traced.exit_code) + "\n" +
                       Tail(traced.output, 4));
      const std::string flat = folder_.File("nothing.nc");
      const ProcessResult flattened =
          Ncport("flatten", CycleFile(), {"--call", p.Call()}, {"--to", "iso-lathe", "-o", flat});
      if (flattened.exit_code != 1 || fs::exists(flat))
        Fail(name, "flatten must end with 1 and write no file; code " + std::to_string(flattened.exit_code));
    }
  }

  void SeedAsPrinted() {
    const std::string file = (source_ / "tests/samples/seed_004.mpf").string();
    for (const char* profile : {"sinumerik-802s-mill", "sinumerik-840d-mill"}) {
      const std::string name = std::string("seed_004 as printed, ") + profile;
      const ProcessResult traced = RunProcess({binary_, "trace", file, "--from", profile});
      const ParsedTrace trace = ParseTrace(traced.output);
      if (!traced.Clean() || traced.exit_code > 1 || !trace.error.empty())
        Fail(name,
             "trace: code " + std::to_string(traced.exit_code) + " " + trace.error + "\n" + Tail(traced.errors, 6));
      int lines = 0, arcs = 0, comp = 0;
      for (const TraceEvent& event : trace.trace.events) {
        lines += event.kind == "LINE" ? 1 : 0;
        arcs += event.kind == "ARC" ? 1 : 0;
        comp += event.line == "COMP LEFT" ? 1 : 0;
      }
      // The first block moves with G1, the control's default (card 8.1). L1 twice: 2 circles, 91 rings, 3 lines
      // besides; L2: one line in, 361 points of the ellipse.
      if (arcs != 2 * (2 + 91) || lines != 1 + 2 * 94 + 362 || comp < 1) {
        Fail(name, std::to_string(arcs) + " arcs, " + std::to_string(lines) + " lines, " + std::to_string(comp) +
                       " COMP LEFT\n" + Tail(traced.errors, 6));
      }
      const std::string flat = folder_.File("seed.nc");
      const ProcessResult flattened =
          RunProcess({binary_, "flatten", file, "--from", profile, "--to", "iso-mill", "-o", flat});
      const bool names_it = flattened.errors.find("seed_004.mpf:14:") != std::string::npos &&
                            flattened.errors.find("D1") != std::string::npos;
      if (flattened.exit_code != 1 || fs::exists(flat) || !names_it) {
        Fail(name, "flatten must refuse D1 without a tool in line 14; code " + std::to_string(flattened.exit_code) +
                       "\n" + Tail(flattened.errors, 8));
      }
    }
  }

  std::string binary_;
  fs::path source_;
  ScratchFolder folder_;
  std::string config_;
  int failures_ = 0;
};

}  // namespace
}  // namespace ncport::tests

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: ncport_flatten_sweep BINARY SOURCE [SEED]\n");
    return 2;
  }
  const unsigned seed = argc == 4 ? static_cast<unsigned>(std::strtoul(argv[3], nullptr, 10)) : 20240611U;
  return ncport::tests::Sweep(argv[1], argv[2]).Run(seed);
}
