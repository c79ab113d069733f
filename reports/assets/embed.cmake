# Writes SCRIPT, VIEW3D (both may be empty), STYLE (with MORE_STYLE behind it) and the languages in TEXTS (a folder) as C++ string
# literals to OUT, scripts and style each with its SHA-256. VIEW3D is the path of a script, beside
# which VIEW3D.z64 holds it deflated as base64.
set(script_text "")
set(view3d_text "")
set(view3d_packed "")
if(SCRIPT)
  file(READ ${SCRIPT} script_text)
endif()
if(VIEW3D)
  file(READ ${VIEW3D} view3d_text)
  file(READ ${VIEW3D}.z64 view3d_packed)
endif()
file(READ ${STYLE} style_text)
if(MORE_STYLE)
  file(READ ${MORE_STYLE} more_style)
  string(APPEND style_text "${more_style}")
endif()
foreach(text IN ITEMS script style view3d)
  string(FIND "${${text}_text}" ")sturz_text\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "the ${text} contains the end of its own string literal")
  endif()
  string(SHA256 ${text}_hash "${${text}_text}")
endforeach()

file(GLOB languages ${TEXTS}/*.json)
set(rows "")
foreach(language IN LISTS languages)
  get_filename_component(name ${language} NAME_WE)
  file(READ ${language} texts)
  string(APPEND rows "    {\"${name}\", R\"sturz_text(${texts})sturz_text\"},\n")
endforeach()

file(WRITE ${OUT} "// Generated from reports/assets and reports/texts; do not edit.
#include \"reports/page/bundle.hpp\"

namespace sturz {

std::string_view bundled_script() { return R\"sturz_text(${script_text})sturz_text\"; }
std::string_view bundled_script_sha256() { return \"${script_hash}\"; }
std::string_view bundled_style() { return R\"sturz_text(${style_text})sturz_text\"; }
std::string_view bundled_style_sha256() { return \"${style_hash}\"; }
std::string_view bundled_view3d() { return \"${view3d_packed}\"; }
std::string_view bundled_view3d_sha256() { return \"${view3d_hash}\"; }

std::span<const BundledTexts> bundled_texts() {
  static constexpr BundledTexts all[] = {
${rows}  };
  return all;
}

}  // namespace sturz
")
