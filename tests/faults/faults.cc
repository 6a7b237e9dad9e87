// ncport_faults SOURCE [--quick] [--only PART OF A NAME] [--all]: switches each seeded fault on, one at a time, and
// looks whether the tests' means find it.
//   - A fault of a writer (raise, printers, tables as printed): programs are read without it, written with it, and read
//     back and compared without it. It is found if the target is refused, cannot be read or does another thing.
//     A text that a golden case holds may not be another one, whatever it does.
//   - A fault of a reader (tables as read): programs are run with it; their traces are other than expected, or golden
//     cases of trace, dump and check say something else.
// A fault that is not found has survived. equivalent.txt lists those that change nothing that a machine could do, with
// the reason. open.txt says for each source file and each table how many others survive; these numbers may only fall:
// more survivors than it says have failed, and so has a number that is too high.
// --quick: the faults by hand and each eighth of the tables' rows. --all: prints the found ones too.
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/faults/judge.h"
#include "tests/faults/seam.h"
#include "tests/faults/subjects.h"
#include "tests/faults/tables.h"
#include "tests/tools/process.h"

namespace ncport::tests::faults {

State& Now() {
  static State state;
  return state;
}

namespace {

struct Seam {
  std::uint32_t number;
  const char* name;
};
constexpr Seam kSeams[] = {
#include "faults.inc"
};

struct Result {
  std::string name;
  std::string answer;  // "found: by what", "survived: how"
};

std::string OneLine(std::string text) {
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return text.substr(0, 160);
}

class Hunt {
 public:
  Hunt(std::string root, std::string only) : root_(std::move(root)), only_(std::move(only)) {
    jobs_ = ListJobs(root_, scratch_.Path());
  }

  int Run(bool quick, bool all);

 private:
  [[nodiscard]] bool Wanted(const std::string& name) const { return name.find(only_) != std::string::npos; }
  void Readers(bool quick);
  void Writers(bool quick);
  void SayGolden();
  std::string JudgeReader(const SeededTable& table) const;
  std::string JudgeWriter(const std::vector<std::size_t>& subjects, const std::function<void()>& on);

  std::string root_, only_;
  ScratchFolder scratch_;
  Jobs jobs_;
  std::vector<Subject> subjects_;
  std::vector<std::string> said_;  // by jobs_.said: what is said without a fault, as a hash
  std::vector<Result> results_;
};

std::string Lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

bool Reads(const Job& job, const std::string& language) {
  const auto has = [&](const char* part) { return job.from.find(part) != std::string::npos; };
  return has(language.c_str()) || (language == "fanuc" && (has("mazak") || has("haas")));
}

std::string HashOf(const std::string& text) { return std::to_string(std::hash<std::string>{}(text)); }

/// In processes of their own: nothing may be read in this one yet.
void Hunt::SayGolden() {
  if (said_.empty()) {
    said_ = JudgeAll(jobs_.said.size(), [&](std::size_t i) {
      const auto& [job, shown] = jobs_.said[i];
      return HashOf(Say(job, shown));
    });
  }
}

/// Programs that have one of the two texts come first; the others of the language follow, since a word can be written
/// in more ways than one.
std::string Hunt::JudgeReader(const SeededTable& table) const {
  Now().table = table.fault;
  if (table.swap) table.swap();
  const std::string a = Lower(table.text_a), b = Lower(table.text_b);
  for (const bool likely : {true, false}) {
    for (const Job& job : jobs_.read) {
      if (!Reads(job, table.language)) continue;
      const std::string text = Lower(ReadFileOrDie(job.program.string()));
      if ((text.find(a) != std::string::npos || text.find(b) != std::string::npos) != likely) continue;
      const std::string wrong = CheckTrace(job);
      if (!wrong.empty()) return "found: " + job.name + ": " + OneLine(wrong);
    }
  }
  for (std::size_t i = 0; i < jobs_.said.size(); ++i) {
    const auto& [job, shown] = jobs_.said[i];
    if (Reads(job, table.language) && HashOf(Say(job, shown)) != said_[i])
      return "found: " + job.name + " says another thing";
  }
  return "survived: no trace is another one";
}

void Hunt::Readers(bool quick) {
  // Nothing may have been read in this process: readers keep what the tables said first.
  std::vector<SeededTable> tables;
  std::size_t number = 0;
  for (SeededTable& table : ListTableFaults()) {
    if (quick && ++number % 8 != 0) continue;
    if (table.fault.side == Side::kRead && Wanted(table.name)) tables.push_back(std::move(table));
  }
  if (!tables.empty()) SayGolden();
  const auto answers = JudgeAll(tables.size(), [&](std::size_t i) { return JudgeReader(tables[i]); });
  for (std::size_t i = 0; i < tables.size(); ++i) results_.push_back({tables[i].name, answers[i]});
}

std::string Hunt::JudgeWriter(const std::vector<std::size_t>& subjects, const std::function<void()>& on) {
  std::string changed_in, golden;
  for (const std::size_t index : subjects) {
    on();
    bool changed = false;
    const std::string wrong = subjects_[index].Judge(changed);
    if (!wrong.empty()) return "found: " + subjects_[index].Name() + ": " + OneLine(wrong);
    if (changed && subjects_[index].Golden() && golden.empty()) golden = subjects_[index].Name();
    if (changed && changed_in.empty()) changed_in = subjects_[index].Name();
  }
  if (!golden.empty()) return "found: " + golden + ": by its text alone";
  if (!changed_in.empty()) return "survived: other text, same trace, first in " + changed_in;
  return subjects.empty() ? "survived: no program comes there" : "survived: no text is another one";
}

void Hunt::Writers(bool quick) {
  struct Fault {
    std::string name;
    std::uint32_t seam = kNone;
    TableFault table;
    std::vector<std::size_t> subjects;
  };
  std::vector<Fault> faults;
  std::size_t number = 0;
  for (const Seam& seam : kSeams) {
    const bool by_hand = std::strstr(seam.name, " -> ") == nullptr;
    if (quick && !by_hand) continue;
    if (Wanted(seam.name)) faults.push_back({seam.name, seam.number, {}, {}});
  }
  for (const SeededTable& table : ListTableFaults()) {
    if (quick && ++number % 8 != 0) continue;
    if (table.fault.side == Side::kWrite && Wanted(table.name)) faults.push_back({table.name, kNone, table.fault, {}});
  }
  if (faults.empty()) return;
  std::size_t useless = 0;
  for (const Job& job : jobs_.write) {
    Subject subject(job);
    const std::string useless_because = subject.Prepare();
    if (useless_because.empty()) {
      subjects_.push_back(std::move(subject));
    } else {
      ++useless;
      if (job.name.starts_with("programs/")) {
        results_.push_back(
            {job.name + (job.print ? " printed" : " to " + job.to), "survived: " + OneLine(useless_because)});
      }
    }
  }
  std::printf("%zu translations to judge by, %zu are refused or open\n", subjects_.size(), useless);
  for (Fault& fault : faults) {
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      const Subject& subject = subjects_[i];
      const bool there = fault.seam != kNone ? subject.asked.contains(fault.seam)
                                             : subject.taken.contains({fault.table.table, kNone}) ||
                                                   subject.taken.contains({fault.table.table, fault.table.row}) ||
                                                   subject.taken.contains({fault.table.table, fault.table.other});
      if (there) fault.subjects.push_back(i);
    }
  }
  const auto answers = JudgeAll(faults.size(), [&](std::size_t i) {
    const Fault& fault = faults[i];
    return JudgeWriter(fault.subjects, [&] {
      Now().active = fault.seam;
      Now().table = fault.table;
    });
  });
  for (std::size_t i = 0; i < faults.size(); ++i) results_.push_back({faults[i].name, answers[i]});
}

/// The source file or the table that a fault was put into.
std::string PlaceOf(const std::string& name) { return name.substr(0, name.find(": ")); }

/// A line NAME, and below it the reason, indented.
std::set<std::string> ReadEquivalent(const std::string& path) {
  std::set<std::string> names;
  std::istringstream lines(ReadFileOrDie(path));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != '#' && line[0] != ' ') names.insert(line);
  }
  return names;
}

/// Lines `COUNT PLACE`.
std::map<std::string, std::size_t> ReadOpen(const std::string& path) {
  std::map<std::string, std::size_t> open;
  std::istringstream lines(ReadFileOrDie(path));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t blank = line.find(' ');
    open[line.substr(blank + 1)] = std::stoul(line.substr(0, blank));
  }
  return open;
}

int Hunt::Run(bool quick, bool all) {
  const std::set<std::string> equivalent = ReadEquivalent(root_ + "/tests/faults/equivalent.txt");
  const std::map<std::string, std::size_t> open = ReadOpen(root_ + "/tests/faults/open.txt");
  Readers(quick);
  Writers(quick);
  std::size_t found = 0, same = 0, survived = 0, failed = 0;
  std::map<std::string, std::size_t> survivors;
  for (const Result& result : results_) {
    const bool is_found = result.answer.starts_with("found");
    if (is_found && equivalent.contains(result.name)) {
      ++failed;
      std::printf("FAIL %s\n     is listed in equivalent.txt and is %s\n", result.name.c_str(), result.answer.c_str());
      continue;
    }
    if (all) std::printf("%s\n     %s\n", result.name.c_str(), result.answer.c_str());
    if (is_found) {
      ++found;
    } else if (equivalent.contains(result.name)) {
      ++same;
    } else {
      ++survived;
      ++survivors[PlaceOf(result.name)];
    }
  }
  for (const auto& [place, count] : survivors) {
    const auto known = open.find(place);
    const std::size_t most = known == open.end() ? 0 : known->second;
    if (count <= most) continue;
    ++failed;
    std::printf("FAIL %s: %zu faults survive, open.txt says %zu; --only and --all show which\n", place.c_str(), count,
                most);
  }
  if (!quick && only_.empty()) {
    for (const auto& [place, most] : open) {
      const std::size_t count = survivors.contains(place) ? survivors.at(place) : 0;
      if (count >= most) continue;
      ++failed;
      std::printf("FAIL %s: %zu faults survive, open.txt says %zu: lower the number\n", place.c_str(), count, most);
    }
  }
  std::printf("%zu faults: %zu found, %zu equivalent with a reason, %zu survive\n", results_.size(), found, same,
              survived);
  std::printf("%zu passed, %zu failed\n", found + same, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ncport::tests::faults

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  bool quick = false, all = false;
  std::string only;
  for (int i = 2; i < argc; ++i) {
    quick = quick || std::strcmp(argv[i], "--quick") == 0;
    all = all || std::strcmp(argv[i], "--all") == 0;
    if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) only = argv[i + 1];
  }
  return ncport::tests::faults::Hunt(argv[1], only).Run(quick, all);
}
