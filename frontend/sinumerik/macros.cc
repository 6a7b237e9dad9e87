#include "frontend/sinumerik/macros.h"

#include <utility>

#include "frontend/common/chars.h"

namespace ncport::frontend::sinumerik {

bool Macros::Add(std::string_view name, std::string_view text) {
  std::string upper(name);
  for (char& c : upper) c = Upper(c);
  if (Find(upper) != nullptr) return false;
  all_.push_back({std::move(upper), std::string(text)});
  return true;
}

const Macros::Macro* Macros::Find(std::string_view upper) const {
  for (const Macro& macro : all_) {
    if (macro.name == upper) return &macro;
  }
  return nullptr;
}

}  // namespace ncport::frontend::sinumerik
