# Writes built_in_profiles.cc (dialects/registry.h) from the profiles beside this file and adds it to ncport_dialects.
file(GLOB profiles CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${profiles})
set(names "")
foreach(file ${profiles})
  get_filename_component(name ${file} NAME_WE)
  list(APPEND names ${name})
endforeach()
list(SORT names)
set(rows "")
foreach(name ${names})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${name}.toml text)
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
