// What the card gives of the parameters of standard cycles (8.12), also of those that ncport does not run: their order,
// which of them are texts, and which values some of them take.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace ncport::dialects::sinumerik {

struct CycleParameters {
  std::string_view cycle;  // upper case
  std::string_view names;  // "RTP,RFP,SDIS", in order
  std::string_view texts;  // those of them that take a text, "NPP"; all others take numbers
  bool complete = false;   // the list is all that the cycle takes; else newer versions append more
};
/// Null: the card does not give the parameters of the cycle. `name` in any case.
const CycleParameters* FindCycleParameters(std::string_view name);
/// Number of names in the list.
std::uint32_t CountOf(const CycleParameters& cycle);
/// Name of the parameter at `position` from 0; empty behind the last one.
std::string_view ParameterAt(const CycleParameters& cycle, std::uint32_t position);
bool IsTextParameter(const CycleParameters& cycle, std::string_view parameter);

/// Values that a parameter takes. Others end in an alarm of the cycle or are replaced by it.
struct CycleValues {
  std::string_view cycle;  // upper case
  std::string_view parameter;
  struct Range {
    double low = 0, high = 0;
  };
  Range ranges[3];
  std::uint8_t range_count = 0;
  std::string_view text;  // "1 to 8 or 11 to 18"
  std::string_view help;  // what the parameter is
};
/// All rows; a row whose parameter the list of its cycle does not hold is a mistake that a test finds.
std::span<const CycleValues> CycleValueRows();

}  // namespace ncport::dialects::sinumerik
