// SPDX-License-Identifier: Apache-2.0
/// Which members a folder holds, told without reading them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sturz {

/// Numbers of the members in files of their own, by their names, ascending. A folder that does not
/// exist holds none.
std::vector<std::int64_t> member_files_in(const std::filesystem::path& folder);

/// Of those in packs too, each once, ascending: of a pack heads and tails of the records are read.
/// What they hold may be damaged all the same; MemberStore looks at every byte.
/// \throws IoError when a pack cannot be read
std::vector<std::int64_t> member_numbers_in(const std::filesystem::path& folder);

}  // namespace sturz
