// A finding about one line, kept as data until the reader reports it with its place.
#pragma once

#include <cstdint>

#include "base/diag/codes.h"

namespace ncport::frontend {

struct LineError {
  diag::Code code{};
  std::uint32_t begin = 0;  // bytes in the line
  std::uint32_t length = 0;
  std::uint32_t limit = 0;                          // of NC9xxx codes
  std::uint32_t other_begin = 0, other_length = 0;  // second word: WordConflict
  const char* help = nullptr;                       // static text
  const char* detail = nullptr;  // static text that takes the place of the word, or a second argument
};

}  // namespace ncport::frontend
