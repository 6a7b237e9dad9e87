# Writes library_data.cc (see ../library_data.h) from the cycle texts beside this file and adds it to ncport_dialects.
file(GLOB cycles CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.spf)
list(SORT cycles)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${cycles})
set(names "")
set(texts "")
list(LENGTH cycles count)
foreach(file ${cycles})
  get_filename_component(name ${file} NAME_WE)
  string(TOUPPER ${name} name)
  file(READ ${file} text)
  string(APPEND names "    \"${name}\",\n")
  string(APPEND texts "    R\"cycle(${text})cycle\",\n")
endforeach()
set(output ${CMAKE_CURRENT_BINARY_DIR}/sinumerik/library_data.cc)
file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Written by dialects/sinumerik/cycles/embed.cmake.
#include \"dialects/sinumerik/library_data.h\"

namespace ncport::dialects::sinumerik {

constexpr std::size_t kLibraryCount = @count@;
constexpr std::string_view kLibraryNames[] = {
@names@};
constexpr std::string_view kLibraryTexts[] = {
@texts@};

}  // namespace ncport::dialects::sinumerik
")
target_sources(ncport_dialects PRIVATE ${output})
