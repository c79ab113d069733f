# Writes version.hpp with the commit that is being built; touches it only when something changed.
# Call: cmake -DSOURCE=dir -DVERSION=x.y.z -DCOMPILER=text -DBUILD_TYPE=text -DOUTPUT=file -P version.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
if(failed OR commit STREQUAL "")
  set(commit "unknown")
endif()
set(text "// SPDX-License-Identifier: Apache-2.0
/// Written by version.cmake at build time.
#pragma once

namespace sturz::workflow {

inline constexpr const char* version = \"${VERSION}\";
inline constexpr const char* git_commit = \"${commit}\";
inline constexpr const char* compiler = \"${COMPILER}\";
inline constexpr const char* build_type = \"${BUILD_TYPE}\";

}  // namespace sturz::workflow
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
