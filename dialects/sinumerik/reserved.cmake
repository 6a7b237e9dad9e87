# Writes ReservedWords() of words.h from docs/languages/sinumerik-reserved.txt and adds it to ncport_dialects.
set(list ${CMAKE_SOURCE_DIR}/docs/languages/sinumerik-reserved.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
file(STRINGS ${list} words REGEX "^[A-Z_]")
list(SORT words)
list(JOIN words "\",\n    \"" words)
set(output ${CMAKE_CURRENT_BINARY_DIR}/sinumerik/reserved_words.cc)
file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Written by dialects/sinumerik/reserved.cmake.
#include \"dialects/sinumerik/words.h\"

namespace ncport::dialects::sinumerik {

constexpr std::string_view kReservedWords[] = {
    \"@words@\",
};

std::span<const std::string_view> ReservedWords() { return kReservedWords; }

}  // namespace ncport::dialects::sinumerik
")
target_sources(ncport_dialects PRIVATE ${output})
