# ncport_antlr_grammar(<target> LANGUAGE <name> LIBRARY_DIR <folder of imported grammars> GRAMMARS <file>...)
# A library with the generated parsers of one language. Debian's tool is 4.7.2 and its runtime 4.9; they work together.
# The tool is looked for on first use, so that a tree without grammars needs neither tool nor runtime.
function(ncport_find_antlr)
  if(TARGET ncport_antlr_runtime)
    return()
  endif()
  find_program(NCPORT_ANTLR_TOOL antlr4 REQUIRED)
  find_path(NCPORT_ANTLR_INCLUDE antlr4-runtime.h PATH_SUFFIXES antlr4-runtime REQUIRED)
  # The static library by choice: it starts faster, which counts when one small file is checked.
  find_library(NCPORT_ANTLR_LIBRARY NAMES libantlr4-runtime.a antlr4-runtime REQUIRED)
  find_package(Threads REQUIRED)
  add_library(ncport_antlr_runtime INTERFACE)
  set(include ${NCPORT_ANTLR_INCLUDE})
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # clang refuses a defaulted constructor of a class with const vectors, which gcc takes: the headers with that one
    # constructor spelled out. Layout and symbols stay those of the library.
    set(include ${CMAKE_BINARY_DIR}/antlr4-runtime)
    file(COPY ${NCPORT_ANTLR_INCLUDE}/ DESTINATION ${include})
    file(READ ${NCPORT_ANTLR_INCLUDE}/Vocabulary.h text)
    string(REPLACE "Vocabulary() = default;" "Vocabulary() : _literalNames(), _symbolicNames(), _displayNames() {}" text "${text}")
    file(WRITE ${include}/Vocabulary.h "${text}")
  endif()
  target_include_directories(ncport_antlr_runtime SYSTEM INTERFACE ${include})
  target_link_libraries(ncport_antlr_runtime INTERFACE ${NCPORT_ANTLR_LIBRARY} Threads::Threads)
endfunction()

function(ncport_antlr_grammar target)
  cmake_parse_arguments(ARG "" "LANGUAGE;LIBRARY_DIR" "GRAMMARS" ${ARGN})
  ncport_find_antlr()
  set(out ${CMAKE_BINARY_DIR}/grammar/${ARG_LANGUAGE})
  file(MAKE_DIRECTORY ${out})
  file(GLOB imported CONFIGURE_DEPENDS ${ARG_LIBRARY_DIR}/*.g4 ${ARG_LIBRARY_DIR}/*.tokens)
  set(library)
  if(IS_DIRECTORY ${ARG_LIBRARY_DIR})
    set(library -lib ${ARG_LIBRARY_DIR})
  endif()
  set(generated)
  foreach(grammar ${ARG_GRAMMARS})
    get_filename_component(name ${grammar} NAME_WE)
    add_custom_command(
      OUTPUT ${out}/${name}.cpp ${out}/${name}.h
      BYPRODUCTS ${out}/${name}.interp ${out}/${name}.tokens
      COMMAND ${NCPORT_ANTLR_TOOL} -Dlanguage=Cpp -Werror -no-visitor -no-listener
              -package ncport::grammar::${ARG_LANGUAGE} ${library} -Xexact-output-dir -o ${out} ${grammar}
      DEPENDS ${grammar} ${imported}
      COMMENT "ANTLR ${name}"
      VERBATIM)
    list(APPEND generated ${out}/${name}.cpp)
  endforeach()
  add_library(${target} STATIC ${generated})
  # The templates of the tool use u8 literals as char. Generated code gets no warnings of ours.
  target_compile_options(${target} PRIVATE -fno-char8_t -w)
  target_include_directories(${target} SYSTEM PUBLIC ${out})
  target_link_libraries(${target} PUBLIC ncport_antlr_runtime)
endfunction()
