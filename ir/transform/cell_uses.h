// What a module does with its variables and numbered cells, as far as their places in the cells of a target depend on
// it (part of names_to_numbers.h). Sets hold the values of ids.
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "ir/module.h"

namespace ncport::ir::transform {

struct CellUses {
  using Numbers = std::set<std::uint32_t>;

  /// `modal_keeps_locals`: as in NamesToNumbersConfig.
  CellUses(Module& module, bool modal_keeps_locals);

  /// A cell of a space, as one number.
  static constexpr std::uint64_t Key(std::uint32_t space, std::uint32_t cell) {
    return std::uint64_t{space} << 32U | cell;
  }

  /// A block of the program assigns the variable, or a call in one takes it by reference.
  [[nodiscard]] bool MayWrite(ProgramId program, VariableId variable) const {
    const auto variables = written.find(program.value);
    return variables != written.end() && variables->second.contains(variable.value);
  }

  std::map<std::uint32_t, Numbers> cells;                     // SpaceId -> cells that expressions name
  Numbers indexed_spaces;                                     // reached by an index
  std::map<std::uint32_t, std::set<std::uint64_t>> cells_of;  // ProgramId -> Key of cells that it names
  std::map<std::uint32_t, Numbers> spaces_of;                 // ProgramId -> spaces that it reaches by an index
  Numbers variables;                                          // that any expression names
  Numbers seen_elsewhere;                                     // variables of a program that another one names
  std::map<std::uint32_t, Numbers> written;                   // ProgramId -> variables, see MayWrite
  Numbers modal;                                              // programs called modally whose locals keep their values
  Numbers feeds;                                              // parameters that stand alone as a feed

 private:
  void FindNames(Module& module, ProgramId program);
  void FindWords(const Module& module, const Word& word, ProgramId program, bool modal_keeps_locals);
  void FindReferences(const Module& module, const Word& word, ProgramId program);
};

}  // namespace ncport::ir::transform
