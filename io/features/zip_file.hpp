// SPDX-License-Identifier: Apache-2.0
/// Texts packed into a zip archive, as QGIS has its projects.
#pragma once

#include <filesystem>
#include <string>

namespace sturz {

/// An archive of one text. The file appears whole or not at all, and carries no time of writing.
/// \throws IoError
void write_zip(const std::filesystem::path& file, const std::string& name, const std::string& text);

}  // namespace sturz
