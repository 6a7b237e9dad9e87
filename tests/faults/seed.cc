// ncport_seed_faults ROOT FAULTS OUT FILE...: copies of the named sources of ROOT below OUT, with faults in them that
// are switched at run time (seam.h), and OUT/faults.inc with their names. Two kinds:
//   - those of FAULTS, written by hand: its head says how;
//   - generated ones: each sign, factor, comparison, mode and sense that the rules below find in the text.
// A fault by hand whose place is not there, or is there twice, is an error: its line is stale.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct HandFault {
  std::string kind, name, file, normal, faulty;  // kind: expression, statement, hook
  int line = 0;
};

/// `Enum::kA` becomes `Enum::kB`.
struct Exchange {
  const char* type;
  const char* from;
  const char* to;
};
constexpr Exchange kExchanges[] = {
    {"ExprOp", "kAdd", "kSubtract"},
    {"ExprOp", "kSubtract", "kAdd"},
    {"ExprOp", "kMultiply", "kDivide"},
    {"ExprOp", "kDivide", "kMultiply"},
    {"ExprOp", "kLess", "kLessEqual"},
    {"ExprOp", "kLessEqual", "kLess"},
    {"ExprOp", "kGreater", "kGreaterEqual"},
    {"ExprOp", "kGreaterEqual", "kGreater"},
    {"ExprOp", "kEqual", "kNotEqual"},
    {"ExprOp", "kNotEqual", "kEqual"},
    {"ExprOp", "kAnd", "kOr"},
    {"ExprOp", "kOr", "kAnd"},
    {"ExprOp", "kNegate", "kPlus"},
    {"Function", "kTruncate", "kRound"},
    {"Function", "kRoundAway", "kTruncate"},
    {"Function", "kRound", "kTruncate"},
    {"Function", "kRoundUp", "kRound"},
    {"Function", "kMinimum", "kMaximum"},
    {"Function", "kMaximum", "kMinimum"},
    {"Motion", "kRapid", "kLinear"},
    {"Motion", "kLinear", "kRapid"},
    {"Motion", "kArcCw", "kArcCcw"},
    {"Motion", "kArcCcw", "kArcCw"},
    {"Distance", "kAbsolute", "kIncremental"},
    {"Distance", "kIncremental", "kAbsolute"},
    {"ValueMode", "kAbsolute", "kIncremental"},
    {"ValueMode", "kIncremental", "kAbsolute"},
    {"FeedMode", "kPerMinute", "kPerRevolution"},
    {"FeedMode", "kPerRevolution", "kPerMinute"},
    {"SpeedMode", "kRpm", "kConstantSurface"},
    {"SpeedMode", "kConstantSurface", "kRpm"},
    {"SpindleState", "kCw", "kCcw"},
    {"SpindleState", "kCcw", "kCw"},
    {"SpindleState", "kStop", "kCw"},
    {"CutterComp", "kOff", "kLeft"},
    {"CutterComp", "kLeft", "kRight"},
    {"CutterComp", "kRight", "kLeft"},
    {"Plane", "kXY", "kZX"},
    {"Plane", "kZX", "kXY"},
    {"Plane", "kYZ", "kZX"},
    {"Units", "kMm", "kInch"},
    {"Units", "kInch", "kMm"},
};

std::string ReadAll(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path.c_str());
    std::exit(1);
  }
  return text.str();
}

std::string Trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string OneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

std::vector<HandFault> ReadFaults(const fs::path& path) {
  std::vector<HandFault> faults;
  std::istringstream lines(ReadAll(path));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const std::string rest = line.size() > 2 ? line.substr(2) : "";
    if (line[0] == '-' && !faults.empty()) {
      faults.back().normal += (faults.back().normal.empty() ? "" : "\n") + rest;
    } else if (line[0] == '+' && !faults.empty()) {
      faults.back().faulty += (faults.back().faulty.empty() ? "" : "\n") + rest;
    } else {
      std::istringstream words(line);
      HandFault fault;
      fault.line = number;
      words >> fault.kind >> fault.file;
      std::getline(words, fault.name);
      fault.name = Trim(fault.name);
      faults.push_back(fault);
    }
  }
  return faults;
}

class Seeder {
 public:
  explicit Seeder(std::vector<HandFault> faults) : faults_(std::move(faults)) {}

  std::string Seed(const std::string& file, const std::string& text) {
    file_ = file;
    next_ = base_ += kMost;
    std::string made = "#include \"tests/faults/seam.h\"\n#line 1 \"" + file + "\"\n";
    std::istringstream lines(ByHand(text));
    for (std::string line; std::getline(lines, line);) made += Generated(line) + "\n";
    return made;
  }
  void Finish(std::ostream& out) const {
    for (const auto& [number, name] : names_) out << "{" << number << ", R\"fault(" << name << ")fault\"},\n";
  }
  [[nodiscard]] bool Ok() const {
    bool ok = ok_;
    for (const HandFault& fault : faults_) {
      if (used_.contains(fault.line)) continue;
      std::fprintf(stderr, "faults.txt:%d: %s is not seeded (CMakeLists.txt)\n", fault.line, fault.file.c_str());
      ok = false;
    }
    return ok;
  }

 private:
  std::string Name(const std::string& what) {
    const std::string name = file_ + ": " + what;
    const int count = ++counts_[name];
    return count == 1 ? name : name + " #" + std::to_string(count);
  }
  std::string Number(const std::string& what) {
    names_[next_] = Name(what);
    return std::to_string(next_++);
  }
  std::string Seam(const std::string& normal, const std::string& faulty, const std::string& what) {
    return "NCPORT_SEAM(" + Number(what) + ", " + normal + ", " + faulty + ")";
  }

  /// Is the place in code: not in a comment, not in a text?
  static bool InCode(const std::string& line, std::size_t at) {
    bool text = false;
    for (std::size_t i = 0; i < at; ++i) {
      if (line[i] == '"' && (i == 0 || line[i - 1] != '\\')) text = !text;
      if (!text && line.compare(i, 2, "//") == 0) return false;
    }
    return !text;
  }

  std::string Replace(const std::string& line, const std::regex& what, int group,
                      const std::function<std::string(const std::smatch&)>& other) {
    std::string out;
    std::size_t done = 0;
    for (std::sregex_iterator it(line.begin(), line.end(), what), end; it != end; ++it) {
      const auto at = static_cast<std::size_t>(it->position(group));
      if (!InCode(line, at) || at < done) continue;
      // What stands in a seam already stays as it is.
      const std::size_t seam = line.rfind("NCPORT_SEAM(", at);
      if (seam != std::string::npos && Depth(line, seam, at) > 0) continue;
      const std::string faulty = other(*it);
      if (faulty.empty()) continue;
      const std::string normal = it->str(group);
      out += line.substr(done, at - done) + Seam(normal, faulty, Trim(original_) + " : " + normal + " -> " + faulty);
      done = at + normal.size();
    }
    return out + line.substr(done);
  }
  static int Depth(const std::string& line, std::size_t from, std::size_t to) {
    int depth = 0;
    for (std::size_t i = from; i < to; ++i) depth += line[i] == '(' ? 1 : line[i] == ')' ? -1 : 0;
    return depth;
  }

  std::string Generated(std::string line) {
    original_ = line;
    if (file_.rfind("dialects/", 0) == 0) return line;
    // What asks whether a fault is on is no constant.
    static const std::regex kConstantFunction(R"(^constexpr (.*\) \{)$)");
    line = std::regex_replace(line, kConstantFunction, "inline $1");
    static const std::regex kNoPlace(
        R"(^\s*(//|#|case |template|using |default:)|constexpr|static_assert|: case |case .*:)");
    const bool by_hand =
        line.find("NCPORT_SEAM") != std::string::npos || line.find("tests::faults") != std::string::npos;
    if (by_hand || std::regex_search(line, kNoPlace)) return line;
    static const std::regex kMeaning(R"((?:^|[^:\w])((ir::)?(\w+)::(k\w+))\b(?!\())");
    line = Replace(line, kMeaning, 1, [](const std::smatch& match) -> std::string {
      for (const Exchange& row : kExchanges) {
        if (match.str(3) == row.type && match.str(4) == row.from) return match.str(2) + match.str(3) + "::" + row.to;
      }
      return {};
    });
    static const std::regex kNumber("Number\\((\"(\\d+)\")");
    line = Replace(line, kNumber, 1, [](const std::smatch& match) {
      return match.str(2) == "2" ? std::string("\"0.5\"") : "\"" + std::to_string(std::stoi(match.str(2)) + 1) + "\"";
    });
    static const std::regex kLiteral(R"(Literal\((-?\d+)\b(?!\.))");
    line = Replace(line, kLiteral, 1,
                   [](const std::smatch& match) { return std::to_string(std::stoi(match.str(1)) + 1); });
    static const std::regex kFactor(R"( [*/] (\d+(?:\.\d+)?)\b(?!U))");
    line = Replace(line, kFactor, 1, [](const std::smatch& match) { return match.str(1) == "2" ? "1" : "2"; });
    static const std::regex kStep(R"( [+-] (1)\b(?![.U\d]))");
    static const std::regex kText(R"(size|substr|find|data\(|begin|end\b|column|line)");
    if (!std::regex_search(line, kText)) {
      line = Replace(line, kStep, 1, [](const std::smatch&) { return std::string("-1"); });
    }
    static const std::regex kSign(R"((?:[?:(,=]|return) ?(-([a-z]\w*(?:\.\w+)?))(?![\w(.\[-]))");
    line = Replace(line, kSign, 1, [](const std::smatch& match) { return match.str(2); });
    return line;
  }

  /// The faults by hand come first: generated ones stay out of their lines.
  std::string ByHand(std::string text) {
    std::map<std::size_t, const HandFault*, std::greater<>> places;  // from the back, so that places stay
    for (const HandFault& fault : faults_) {
      if (fault.file != file_) continue;
      used_.insert(fault.line);
      const std::size_t at = text.find(fault.normal);
      if (at == std::string::npos || text.find(fault.normal, at + 1) != std::string::npos) {
        std::fprintf(stderr, "faults.txt:%d: %s has this text %s: %s\n", fault.line, file_.c_str(),
                     at == std::string::npos ? "nowhere" : "twice", fault.normal.c_str());
        ok_ = false;
        continue;
      }
      places[at] = &fault;
    }
    for (const auto& [at, fault] : places) {
      std::string made;
      if (fault->kind == "hook") {
        made = fault->faulty;
      } else if (fault->kind == "statement") {
        made = "if (::ncport::tests::faults::On(" + Number(fault->name) + ")) {" + fault->faulty + "} else {" +
               fault->normal + "}";
      } else {
        // On one line, so that no generated fault is put into what stands there only while this one is on.
        made = Seam("(" + OneLine(fault->normal) + ")", "(" + OneLine(fault->faulty) + ")", fault->name);
      }
      text.replace(at, fault->normal.size(), made);
    }
    return text;
  }

  std::vector<HandFault> faults_;
  static constexpr int kMost = 1000;  // numbers of one file: what changes in a file leaves the others as they are
  int base_ = -kMost, next_ = 0;
  std::map<int, std::string> names_;
  std::map<std::string, int> counts_;
  std::set<int> used_;
  std::string file_, original_;
  bool ok_ = true;
};

/// Leaves the file alone if it has this text: what did not change is not compiled again.
void WriteIfChanged(const fs::path& path, const std::string& text) {
  std::ifstream old(path);
  std::ostringstream had;
  had << old.rdbuf();
  if (old.is_open() && had.str() == text) return;
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const fs::path root = argv[1], out = argv[3];
  Seeder seeder(ReadFaults(argv[2]));
  std::vector<std::pair<fs::path, std::string>> made;
  for (int i = 4; i < argc; ++i) made.emplace_back(out / argv[i], seeder.Seed(argv[i], ReadAll(root / argv[i])));
  if (!seeder.Ok()) return 1;
  std::ostringstream names;
  seeder.Finish(names);
  made.emplace_back(out / "faults.inc", names.str());
  for (const auto& [path, text] : made) WriteIfChanged(path, text);
  return 0;
}
