# cmake -DOUT=<file.cc> -DFOLDER=<docs/diagnostics> -P embed_pages.cmake: the pages on diagnostics as one C++ constant.
file(GLOB pages ${FOLDER}/NC*.md)
list(SORT pages)
set(text "")
foreach(page ${pages})
  file(READ ${page} one)
  string(APPEND text "${one}\n")
endforeach()
if(text MATCHES "\\)pages\"")
  message(FATAL_ERROR "a page on a diagnostic holds the end mark of its own string")
endif()
file(WRITE ${OUT} "// Made from docs/diagnostics by embed_pages.cmake.\n#include \"app/diagnostic_pages.h\"\n\nnamespace ncport::app {\n
std::string_view DiagnosticPages() {\n  static constexpr std::string_view kPages = R\"pages(${text})pages\";\n  return kPages;\n}\n\n}  // namespace ncport::app\n")
