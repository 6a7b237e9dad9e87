// Each form of real-programs.md in four spellings gives the same IR apart from places: as printed; without blanks but
// where two word characters would join; with blanks everywhere they may stand; in lower case outside strings and
// comments.
#include <doctest/doctest.h>

#include <cctype>
#include <regex>
#include <string>
#include <vector>

#include "base/diag/sink.h"
#include "base/source_files.h"
#include "base/text_buffer.h"
#include "dialects/registry.h"
#include "frontend/reader.h"
#include "ir/dump.h"
#include "tests/spellings/forms.h"

namespace ncport::tests {
namespace {

bool IsWordCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '$';
}

/// Calls `take(c, literal)` for each character; `literal` inside strings and comments.
template <class Take>
void ForEachCharacter(std::string_view text, Take take) {
  bool in_string = false, in_comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') in_string = in_comment = false;
    const bool literal = in_string || in_comment;
    if (!in_comment && c == '"') in_string = !in_string;
    if (!in_string && c == ';') in_comment = true;
    take(i, c, literal);
  }
}

std::string Tight(std::string_view spaced) {
  std::string text;
  ForEachCharacter(spaced, [&](std::size_t i, char c, bool literal) {
    const bool joins = c == ' ' && !text.empty() && IsWordCharacter(text.back()) && i + 1 < spaced.size() &&
                       IsWordCharacter(spaced[i + 1]);
    if (c != ' ' || literal || joins) text += c;
  });
  return text;
}

std::string Wide(std::string_view spaced) {
  std::string text;
  ForEachCharacter(spaced, [&](std::size_t, char c, bool literal) {
    text += c == ' ' && !literal ? std::string(" \t ") : std::string(1, c);
  });
  return text;
}

std::string LowerCase(std::string_view spaced) {
  std::string text;
  ForEachCharacter(spaced, [&](std::size_t, char c, bool literal) {
    text += literal ? c : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return text;
}

std::string Upper(std::string_view text) {
  std::string result;
  for (const char c : text) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

struct ReadResult {
  std::string dump;
  std::vector<std::string> findings;  // errors
};

ReadResult Read(const std::string& text) {
  SourceFiles files;
  const FileId file = files.Add("main.mpf", text + "\n");
  ir::Module module;
  diag::Sink sink;
  const Status status = frontend::ReadFile(files, file, dialects::BuiltIn("sinumerik-840d-mill"), {}, module, sink);
  ReadResult result;
  for (const diag::Diagnostic& finding : sink.All()) {
    if (finding.severity == diag::Severity::kError) result.findings.push_back(finding.message);
  }
  CHECK(status.Ok() == result.findings.empty());
  TextBuffer out;
  ir::Dump(module, out, {.places = false, .spellings = true});
  // Names keep the case in which they were written; the language does not see it.
  // The blanks before a comment are places.
  static const std::regex gaps(" gap [0-9]+");
  result.dump = Upper(std::regex_replace(std::string(out.View()), gaps, ""));
  return result;
}

TEST_CASE("the spellings of each form of real programs give one IR") {
  for (const Form& form : SinumerikForms()) {
    if (!form.refused_word.empty()) continue;
    const ReadResult spaced = Read(std::string(form.spaced));
    CHECK_MESSAGE(spaced.findings.empty(), form.spaced << ": " << (spaced.findings.empty() ? "" : spaced.findings[0]));
    const std::string others[] = {std::string(form.printed.empty() ? form.spaced : form.printed), Tight(form.spaced),
                                  Wide(form.spaced), LowerCase(form.spaced)};
    for (const std::string& other : others) {
      const ReadResult read = Read(other);
      CHECK_MESSAGE(read.findings.empty(), other << ": " << (read.findings.empty() ? "" : read.findings[0]));
      CHECK_MESSAGE(read.dump == spaced.dump, "row " << form.row << "\n"
                                                     << other << "\n"
                                                     << read.dump << "\nbut\n"
                                                     << form.spaced << "\n"
                                                     << spaced.dump);
    }
  }
}

TEST_CASE("forms that are not taken give one finding that names the word, in each spelling") {
  for (const Form& form : SinumerikForms()) {
    if (form.refused_word.empty()) continue;
    for (const std::string& text : {std::string(form.printed), Wide(form.spaced), LowerCase(form.spaced)}) {
      const ReadResult read = Read(text);
      CHECK_MESSAGE(read.findings.size() == 1, text << ": " << read.findings.size() << " findings");
      if (!read.findings.empty())
        CHECK_MESSAGE(Upper(read.findings[0]).find(form.refused_word) != std::string::npos,
                      text << ": " << read.findings[0]);
    }
  }
}

}  // namespace
}  // namespace ncport::tests
