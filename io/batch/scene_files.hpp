// SPDX-License-Identifier: Apache-2.0
/// The files behind a scene, for telling without reading them whether one may have changed.
#pragma once

#include "io/files/file_stamp.hpp"
#include "scenarios/scenario.hpp"

#include <optional>
#include <vector>

namespace sturz {

/// Stamps of every file that a scene's keys name, of what GDAL reads besides (parts of a virtual
/// raster, .prj, .aux.xml) and of all files beside them with the same name before the first dot, so
/// that a companion which appears is seen too. Sorted by path, each once. Nothing where a name is
/// not a file or folder of this machine (archives, servers): it cannot be told then.
std::optional<std::vector<FileStamp>> stamps_of(const Scenario&);

/// True when the same files have the same stamps today, and none was fresh when it was looked at.
/// \param before as stamps_of() gave them at `looked_ns`
bool are_unchanged(const Scenario&, const std::vector<FileStamp>& before, std::int64_t looked_ns);

}  // namespace sturz
