#include "dialects/fanuc/system_variables.h"

#include <algorithm>
#include <iterator>

namespace ncport::dialects::fanuc {

namespace {

using K = ir::SystemKind;
using ir::Type;
using Variant = FanucSettings::Variant;

constexpr std::uint8_t Bit(Variant variant) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(variant)); }
constexpr std::uint8_t kFanuc = Bit(Variant::kFanuc);
constexpr std::uint8_t kMazak = Bit(Variant::kMazak);
constexpr std::uint8_t kHaas = Bit(Variant::kHaas);
constexpr std::uint8_t kMakers = kFanuc | kMazak | kHaas;
constexpr std::uint8_t kMills = 1;
constexpr std::uint8_t kLathes = 2;
constexpr std::uint8_t kBoth = kMills | kLathes;

/// Known only to the machine, read only.
constexpr SystemRange Read(std::uint32_t first, std::uint32_t last, std::string_view name, std::uint8_t makers,
                           std::string_view rule, std::uint8_t machines = kBoth) {
  return {first, last, first, name, K::kEnvironment, Type::kReal, true, false, Control::kNone, makers, machines, rule};
}
/// Known only to the machine, and writable.
constexpr SystemRange Data(std::uint32_t first, std::uint32_t last, std::string_view name, std::uint8_t makers,
                           std::string_view rule, std::uint8_t machines = kBoth) {
  return {first, last, first, name, K::kEnvironment, Type::kReal, true, true, Control::kNone, makers, machines, rule};
}
/// Known from the program; index = number - base.
constexpr SystemRange Known(std::uint32_t first, std::uint32_t last, std::uint32_t base, std::string_view name, K kind,
                            std::uint8_t makers, std::string_view rule, std::uint8_t machines = kBoth) {
  return {first, last, base, name, kind, Type::kReal, true, false, Control::kNone, makers, machines, rule};
}

constexpr SystemRange kRanges[] = {
    Read(1000, 1035, "inputs", kFanuc | kMazak, "fanuc-9.1"),
    Data(1100, 1135, "outputs", kFanuc | kMazak, "fanuc-9.1"),
    Read(1064, 1098, "axis loads, analog inputs", kHaas, "fanuc-9.9"),
    Read(1264, 1268, "axis loads", kHaas, "fanuc-9.9"),
    Data(1601, 2000, "flutes and vibration of tools", kHaas, "fanuc-9.9"),
    Data(2001, 2800, "tool offsets", kMakers, "fanuc-9.2", kMills),
    Data(2001, 2964, "tool offsets and work shift", kMakers, "fanuc-9.2", kLathes),

    {3000, 3000, 3000, "alarm", K::kEnvironment, Type::kReal, false, true, Control::kAlarm, kMakers, kBoth,
     "fanuc-9.3"},
    Data(3001, 3002, "clocks", kMakers, "fanuc-9.3"),
    // Bits that switch single block, feed hold and overrides off: no effect on a trace, what is written is read back.
    {3003, 3004, 3003, "single block and override control", K::kUserMemory, Type::kReal, true, true, Control::kNone,
     kMakers, kBoth, "fanuc-9.3"},
    Data(3005, 3005, "settings", kFanuc | kMazak, "fanuc-9.3"),
    {3006, 3006, 3006, "message with stop", K::kEnvironment, Type::kReal, false, true, Control::kMessageStop, kMakers,
     kBoth, "fanuc-9.3"},
    Read(3007, 3008, "mirror and restart state", kFanuc | kMazak, "fanuc-9.3"),
    Read(3011, 3012, "date and time", kMakers, "fanuc-9.3"),
    Read(3020, 3020, "index of the tool data", kMazak, "fanuc-9.8"),
    Read(3020, 3033, "timers and states", kHaas, "fanuc-9.9"),
    Read(3196, 3196, "cell-safe timer", kHaas, "fanuc-9.9"),
    Data(3201, 3600, "tool diameters and coolant positions", kHaas, "fanuc-9.9"),
    Data(3901, 3902, "parts counters", kMakers, "fanuc-9.3"),

    Read(4000, 4000, "main program number", kFanuc | kMazak, "fanuc-9.3"),
    Known(4001, 4030, 4000, "modal code of a group", K::kModalGroup, kMakers, "fanuc-9.4"),
    Known(4201, 4230, 4200, "modal code of a group", K::kModalGroup, kFanuc | kMazak, "fanuc-9.4"),
    Read(4101, 4106, "modal words", kMakers, "fanuc-9.4"),
    Read(4107, 4107, "active D", kMakers, "fanuc-9.4"),
    Read(4108, 4108, "active E", kMakers, "fanuc-9.4"),
    Known(4109, 4109, 4109, "active feed", K::kActiveFeed, kMakers, "fanuc-9.4"),
    Read(4110, 4118, "modal words", kMakers, "fanuc-9.4"),
    Known(4119, 4119, 4119, "active speed", K::kActiveSpeed, kMakers, "fanuc-9.4"),
    Known(4120, 4120, 4120, "modal T", K::kProgrammedTool, kMakers, "fanuc-9.4"),
    Read(4121, 4130, "modal words", kMakers, "fanuc-9.4"),
    Read(4301, 4330, "words of the running block", kFanuc | kMazak, "fanuc-9.8"),

    // 5041 and up hold the tool offset, which only the machine knows.
    Known(5001, 5020, 5000, "position at block end", K::kProgrammedPosition, kMakers, "fanuc-9.5"),
    Known(5021, 5040, 5020, "machine position", K::kMachinePosition, kMakers, "fanuc-9.5"),
    Read(5041, 5060, "work position", kMakers, "fanuc-9.5"),
    Read(5061, 5080, "skip position", kMakers, "fanuc-9.5"),
    Read(5081, 5100, "tool offset in force", kMakers, "fanuc-9.5"),
    Read(5101, 5200, "servo deviation, handle, distance to go", kFanuc | kMazak, "fanuc-9.5"),
    Data(5201, 5340, "work offsets", kMakers, "fanuc-9.6"),
    Data(5401, 6000, "tool life tables", kHaas, "fanuc-9.9"),
    Read(5500, 5500, "active dynamic offset", kFanuc | kMazak, "fanuc-9.6"),
    Data(5521, 5700, "dynamic offsets", kFanuc | kMazak, "fanuc-9.6"),
    Data(7001, 7960, "extended work offsets", kFanuc | kMazak, "fanuc-9.6"),
    Data(7001, 7400, "extended work offsets", kHaas, "fanuc-9.9"),
    Data(7501, 7900, "pallet tables", kHaas, "fanuc-9.9"),
    Data(8500, 8569, "tool management", kHaas, "fanuc-9.9"),
    Read(9101, 9104, "shift of the MAZATROL system", kMazak, "mazak-lathe-6.6", kLathes),
    Data(10001, 13999, "tool offsets", kFanuc | kMazak, "fanuc-9.2", kMills),
    Data(10001, 19999, "tool offsets", kFanuc | kMazak, "fanuc-9.2", kLathes),
    Read(11000, 11063, "inputs", kHaas, "fanuc-9.9"),
    Data(14001, 19988, "extended work offsets", kFanuc | kMazak, "fanuc-9.6", kMills),
    Data(14001, 14400, "extended work offsets", kHaas, "fanuc-9.9"),
    Data(26001, 26080, "workpiece setting errors", kFanuc, "fanuc-9.6"),
    Read(51998, 51998, "pallet", kMazak, "fanuc-9.8"),
    Read(60001, 60999, "MAZATROL tool length", kMazak, "fanuc-9.8"),
    Known(100001, 100050, 100000, "position at block end", K::kProgrammedPosition, kFanuc, "fanuc-9.7"),
    Known(100051, 100100, 100050, "machine position", K::kMachinePosition, kFanuc, "fanuc-9.7"),
    Read(100101, 100250, "work and skip position, tool offset", kFanuc, "fanuc-9.7"),
    Data(100301, 100650, "work offsets", kFanuc, "fanuc-9.7"),
    Data(101001, 115950, "extended work offsets", kFanuc, "fanuc-9.7"),
};

constexpr SystemName kNames[] = {
    {"_UI", 1000, true},      {"_UIL", 1032, true},     {"_UO", 1100, true},      {"_UOL", 1132, true},
    {"_ALM", 3000, false},    {"_CLOCK1", 3001, false}, {"_CLOCK2", 3002, false}, {"_CNTL1", 3003, false},
    {"_CNTL2", 3004, false},  {"_SETDT", 3005, false},  {"_MSGSTP", 3006, false}, {"_MRIMG", 3007, false},
    {"_PRSTR", 3008, false},  {"_DATE", 3011, false},   {"_TIME", 3012, false},   {"_PRTSA", 3901, false},
    {"_PRTSN", 3902, false},  {"_BUFG", 4000, true},    {"_BUFB", 4102, false},   {"_BUFD", 4107, false},
    {"_BUFE", 4108, false},   {"_BUFF", 4109, false},   {"_BUFH", 4111, false},   {"_BUFM", 4113, false},
    {"_BUFN", 4114, false},   {"_BUFO", 4115, false},   {"_BUFS", 4119, false},   {"_BUFT", 4120, false},
    {"_BUFWZP", 4130, false}, {"_ACTG", 4200, true},    {"_ABSIO", 5000, true},   {"_ABSMT", 5020, true},
    {"_ABSOT", 5040, true},   {"_ABSKP", 5060, true},   {"_TOFS", 5080, true},    {"_SVERR", 5100, true},
    {"_MIRTP", 5120, true},   {"_DIST", 5180, true},    {"_WZCMN", 5200, true},   {"_WZG54", 5220, true},
    {"_WZG55", 5240, true},   {"_WZG56", 5260, true},   {"_WZG57", 5280, true},   {"_WZG58", 5300, true},
    {"_WZG59", 5320, true},
};

}  // namespace

std::span<const SystemRange> SystemVariables() { return kRanges; }

const SystemRange* FindSystemVariable(const Profile& profile, std::uint32_t number) {
  const std::uint8_t maker = Bit(profile.fanuc.variant.Or(Variant::kFanuc));
  const std::uint8_t machine = profile.IsLathe() ? kLathes : kMills;
  const auto range = std::ranges::find_if(kRanges, [&](const SystemRange& row) {
    return number >= row.first && number <= row.last && (row.makers & maker) != 0 && (row.machines & machine) != 0;
  });
  return range == std::end(kRanges) ? nullptr : range;
}

std::span<const SystemName> SystemNames() { return kNames; }

const SystemName* FindSystemName(std::string_view name) {
  const auto row = std::ranges::find(kNames, name, &SystemName::name);
  return row == std::end(kNames) ? nullptr : row;
}

}  // namespace ncport::dialects::fanuc
