// SPDX-License-Identifier: Apache-2.0
/// Script and style of the page, embedded when the library is built (see CMakeLists.txt).
#pragma once

#include <span>
#include <string_view>

namespace sturz {

/// Everything the page's script needs, as one classic script; empty in a build without it.
std::string_view bundled_script();
/// Hexadecimal SHA-256 of bundled_script().
std::string_view bundled_script_sha256();
std::string_view bundled_style();
std::string_view bundled_style_sha256();
/// Script of the 3-D view, deflated (zlib), as base64; empty in a build without scripts.
std::string_view bundled_view3d();
/// Hexadecimal SHA-256 of that script before it was deflated.
std::string_view bundled_view3d_sha256();

/// The words of one language.
struct BundledTexts {
  std::string_view name;  ///< "en"
  std::string_view json;
};
std::span<const BundledTexts> bundled_texts();

}  // namespace sturz
