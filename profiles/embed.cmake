# Writes built_in_profiles.cc (dialects/registry.h) from the profiles beside this file and adds it to ncport_dialects.
file(GLOB profiles CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.toml)
list(SORT profiles)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${profiles})
set(rows "")
foreach(file ${profiles})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND rows "    {\"${name}\", R\"profile(${text})profile\"},\n")
endforeach()
set(output ${CMAKE_CURRENT_BINARY_DIR}/built_in_profiles.cc)
file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Written by profiles/embed.cmake.
#include \"dialects/registry.h\"

namespace ncport::dialects {

constexpr BuiltInProfile kBuiltInProfiles[] = {
@rows@};

std::span<const BuiltInProfile> BuiltInProfiles() { return kBuiltInProfiles; }

}  // namespace ncport::dialects
")
target_sources(ncport_dialects PRIVATE ${output})
