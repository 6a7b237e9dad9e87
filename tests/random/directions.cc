#include "tests/random/checks.h"
#include "tests/random/direction_checks.h"

namespace ncport::tests::random {

namespace {

constexpr Direction kDirections[] = {
    {.name = "ir",
     .title = "the program as IR: verified, dumped and read back, run twice",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckIr},
    {.name = "sinumerik",
     .title = "SINUMERIK text: printed, read back, run",
     .flavour = Flavour::kSinumerik,
     .mill = "sinumerik-840d-mill",
     .lathe = "sinumerik-840d-lathe",
     .check = CheckSinumerikText},
};

}  // namespace

std::span<const Direction> Directions() { return kDirections; }

const Direction* FindDirection(std::string_view name) {
  for (const Direction& direction : kDirections) {
    if (direction.name == name) return &direction;
  }
  return nullptr;
}

}  // namespace ncport::tests::random
