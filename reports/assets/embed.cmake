# Writes SCRIPT (may be empty) and STYLE as C++ string literals, each with its SHA-256, to OUT.
set(script_text "")
if(SCRIPT)
  file(READ ${SCRIPT} script_text)
endif()
file(READ ${STYLE} style_text)
foreach(text IN ITEMS script style)
  string(FIND "${${text}_text}" ")sturz_text\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "the ${text} contains the end of its own string literal")
  endif()
  string(SHA256 ${text}_hash "${${text}_text}")
endforeach()
file(WRITE ${OUT} "// Generated from reports/assets; do not edit.
#include \"reports/page/bundle.hpp\"

namespace sturz {

std::string_view bundled_script() { return R\"sturz_text(${script_text})sturz_text\"; }
std::string_view bundled_script_sha256() { return \"${script_hash}\"; }
std::string_view bundled_style() { return R\"sturz_text(${style_text})sturz_text\"; }
std::string_view bundled_style_sha256() { return \"${style_hash}\"; }

}  // namespace sturz
")
