// SPDX-License-Identifier: Apache-2.0
/// Script and style of the page, embedded when the library is built (see CMakeLists.txt).
#pragma once

#include <string_view>

namespace sturz {

/// Everything the page's script needs, as one classic script; empty in a build without it.
std::string_view bundled_script();
/// Hexadecimal SHA-256 of bundled_script().
std::string_view bundled_script_sha256();
std::string_view bundled_style();
std::string_view bundled_style_sha256();

}  // namespace sturz
