# cmake -DROOT=<source> -P CheckLayers.cmake: who may include whom, and where dialects may be named. Run as the test "layers".
# Folders that do not exist are no error. tests/, bench/ and tools/ may include anything.

cmake_minimum_required(VERSION 3.25)

# --- The table. One line a layer: project folders whose headers it may include.
set(allow_base "base")
set(allow_ir "base|ir")
set(allow_dialects "base|ir|dialects")
set(allow_frontend "base|ir|dialects|frontend")
set(allow_exec "base|ir|exec")
set(allow_check "base|ir|dialects|exec|check")
set(allow_prove "base|ir|dialects|exec|prove")
set(allow_backends "base|ir|dialects|backends")
set(allow_backends_iso "base|ir|dialects|backends|exec")  # flat blocks are written from the events of a run
set(allow_app "base|ir|dialects|frontend|exec|check|prove|backends|app")
set(layers base ir dialects frontend exec check prove backends app)

# Layers whose folders are common code (files at their top and common/) and one folder a dialect.
set(layers_by_dialect dialects frontend backends)

# Libraries with a place: "<regex of the include>=<regex of the files that may have it>".
set(placed_libraries
  "antlr4-runtime|[A-Za-z]+(Parser|Lexer)\\.h=^frontend/(.*\\.cc|common/.*\\.h)$"
  "CLI/=^app/main\\.cc$"
  "nlohmann/=(^|/)[a-z_]*(json|sarif)[a-z_]*\\.cc$"
  "toml\\+\\+/=^(dialects|app)/.*\\.cc$"
  "doctest/=^$")

# Names of controls and their makers, lower case. They stand in dialects, frontend, backends and app only.
set(dialect_names "sinumerik|siemens|fanuc|mazak|haas|linuxcnc|(^|[^a-z0-9_])k?num(_|::|/|\")")
set(layers_without_names base ir exec check prove)

set(failed 0)
function(complain text)
  message("${text}")
  set(failed 1 PARENT_SCOPE)
endfunction()

# The lines of a file as a list, number by number; characters that have a meaning in CMake lists become blanks.
function(read_lines file out)
  file(READ ${ROOT}/${file} text)
  string(REGEX REPLACE "[][;\\]" " " text "${text}")
  string(REPLACE "\n" ";" text "${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

function(check_include file layer include)
  string(REGEX MATCH "^[a-z_]+" top "${include}")
  if(top IN_LIST layers)
    # A folder of a layer may have a line of its own.
    set(allowed "${allow_${layer}}")
    if(file MATCHES "^[a-z_]+/([a-z_0-9]+)/")
      if(DEFINED allow_${layer}_${CMAKE_MATCH_1})
        set(allowed "${allow_${layer}_${CMAKE_MATCH_1}}")
      endif()
    endif()
    if(NOT top MATCHES "^(${allowed})$")
      complain("${file}: ${layer} may not include ${include}")
    endif()
    # frontend/<dialect>/... : the dialect of the including and of the included file must be one, or common code.
    if(top IN_LIST layers_by_dialect AND include MATCHES "^[a-z_]+/([a-z_0-9]+)/")
      set(there ${CMAKE_MATCH_1})
      set(here "")
      if(layer IN_LIST layers_by_dialect AND file MATCHES "^[a-z_]+/([a-z_0-9]+)/")
        set(here ${CMAKE_MATCH_1})
      endif()
      # The registry of a layer (a .cc at its top) lists all dialects; app may name them too. All others go through it.
      set(is_registry FALSE)
      if((layer STREQUAL top AND file MATCHES "^[a-z_]+/[a-z_]+\\.cc$") OR layer STREQUAL "app")
        set(is_registry TRUE)
      endif()
      if(NOT there STREQUAL "common" AND NOT there STREQUAL here AND NOT is_registry)
        complain("${file}: may not include ${include}, which belongs to the dialect ${there}")
      endif()
    endif()
  endif()
  foreach(rule ${placed_libraries})
    string(REGEX MATCH "^(.*)=(.*)$" rule "${rule}")
    set(library "${CMAKE_MATCH_1}")
    set(place "${CMAKE_MATCH_2}")
    if(include MATCHES "^(${library})" AND NOT file MATCHES "${place}")
      complain("${file}: ${include} has its place elsewhere (${place})")
    endif()
  endforeach()
  set(failed ${failed} PARENT_SCOPE)
endfunction()

function(check_names file lines)
  set(number 0)
  foreach(line IN LISTS lines)
    math(EXPR number "${number} + 1")
    string(TOLOWER "${line}" line)
    if(line MATCHES "${dialect_names}")
      string(REGEX REPLACE "//.*" "" line "${line}")
      if(line MATCHES "${dialect_names}")
        complain("${file}:${number}: names a dialect: ${line}")
      endif()
    endif()
  endforeach()
  set(failed ${failed} PARENT_SCOPE)
endfunction()

foreach(layer ${layers})
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${layer}/*.h ${ROOT}/${layer}/*.cc ${ROOT}/${layer}/*.def)
  foreach(file ${files})
    read_lines(${file} lines)
    set(includes ${lines})
    list(FILTER includes INCLUDE REGEX "^ *# *include *[<\"]")
    foreach(line ${includes})
      string(REGEX REPLACE "^ *# *include *[<\"]([^>\"]*)[>\"].*$" "\\1" include "${line}")
      check_include(${file} ${layer} "${include}")
    endforeach()
    if(layer IN_LIST layers_without_names OR file MATCHES "^[a-z_]+/common/")
      check_names(${file} "${lines}")
    endif()
  endforeach()
endforeach()

if(failed)
  message(FATAL_ERROR "layer rules are broken: the table at the top of cmake/CheckLayers.cmake")
endif()
