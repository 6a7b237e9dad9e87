#include "dialects/finding_alarms.h"

namespace ncport::dialects {
namespace {

using diag::Code;

struct Row {
  Language language;
  Code code;
  std::string_view alarm;
  std::string_view rule;  // card row whose number a source prints
};

constexpr Row kRows[] = {
    {Language::kSinumerik, Code::kUnknownCode, "SINUMERIK alarm 12470", "sinumerik-10#8"},
    {Language::kSinumerik, Code::kUnknownName, "SINUMERIK alarm 12550", "sinumerik-10#6"},
    {Language::kSinumerik, Code::kUnknownLabel, "SINUMERIK alarm 14080", "sinumerik-6.1"},
    {Language::kSinumerik, Code::kArcRadius, "SINUMERIK alarm 14040", "sinumerik-10#43"},
    {Language::kSinumerik, Code::kOutOfDomain, "SINUMERIK alarm 14051", "sinumerik-10#16"},
    {Language::kFanuc, Code::kReadOnly, "Fanuc alarm PS0116", "fanuc-11#26"},
    {Language::kFanuc, Code::kOutOfDomain, "Fanuc alarm PS0119", "fanuc-11#29"},
    {Language::kFanuc, Code::kMissingValue, "Fanuc alarm PS0005", "fanuc-11#3"},
    {Language::kFanuc, Code::kUnknownAddress, "Fanuc alarm PS0009", "fanuc-11#6"},
    {Language::kFanuc, Code::kUnknownCode, "Fanuc alarm PS0010", "fanuc-11#7"},
    {Language::kFanuc, Code::kMissingFeed, "Fanuc alarm PS0011", "fanuc-11#8"},
    {Language::kFanuc, Code::kArcRadius, "Fanuc alarm PS0020", "fanuc-11#10"},
    {Language::kFanuc, Code::kArcIncomplete, "Fanuc alarm PS0022", "fanuc-11#12"},
    {Language::kFanuc, Code::kCompensationInArc, "Fanuc alarm PS0034", "fanuc-11#65"},
    {Language::kFanuc, Code::kUnknownProgram, "Fanuc alarm PS0076", "fanuc-11#17"},
    {Language::kFanuc, Code::kUnclosedStructure, "Fanuc alarm PS0124", "fanuc-11#32"},
    {Language::kFanuc, Code::kStrayStructureEnd, "Fanuc alarm PS1124", "fanuc-11#33"},
};

}  // namespace

std::string_view AlarmFor(const Profile& profile, diag::Code code) {
  // Mazak and Haas have other numbers.
  if (profile.language == Language::kFanuc && !profile.fanuc.variant.Is(FanucSettings::Variant::kFanuc)) return {};
  for (const Row& row : kRows) {
    if (row.language == profile.language && row.code == code) return row.alarm;
  }
  return {};
}

}  // namespace ncport::dialects
