// The macros of a program (card 3.8).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ncport::frontend::sinumerik {

/// Texts that stand for a name: DEFINE name AS text (card 3.8).
class Macros {
 public:
  struct Macro {
    std::string name;  // upper case
    std::string text;
  };
  /// False if the name is taken.
  bool Add(std::string_view name, std::string_view text);
  /// `upper`: upper case.
  [[nodiscard]] const Macro* Find(std::string_view upper) const;
  [[nodiscard]] bool Empty() const { return all_.empty(); }
  void Clear() { all_.clear(); }

 private:
  std::vector<Macro> all_;  // a program defines few
};

}  // namespace ncport::frontend::sinumerik
