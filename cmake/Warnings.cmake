# Warnings for our own code: target ncport_warnings. Generated code does not link it.
add_library(ncport_warnings INTERFACE)
target_compile_options(ncport_warnings INTERFACE -Wall -Wextra)
# Options are structs with defaults and named initialisers: leaving a field out is the point.
target_compile_options(ncport_warnings INTERFACE -Wno-missing-field-initializers)
# gcc 12 warns of overlapping copies inside std::string that cannot happen (its bug 105651), with optimisation only.
target_compile_options(ncport_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(NCPORT_WERROR)
  target_compile_options(ncport_warnings INTERFACE -Werror)
endif()
# Messages of NCPORT_BUG name files from the project root, whatever machine built them.
target_compile_options(ncport_warnings INTERFACE -fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)
