// SPDX-License-Identifier: Apache-2.0
/// The name that always leads to a job's results of today, and what becomes of those before.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Makes BASE a link to its folder BASE-<hash>. A link of before is replaced in one stroke.
/// \return why there is none, a sentence without its full stop; empty: there is. Nothing depends on
///   it: some network drives have no links
std::string point_to(const std::filesystem::path& base, const std::filesystem::path& folder);

/// Removes results of BASE beyond the newest `keep`, never `current` and never one in which a
/// process works. \return those removed \param keep 1 or more
std::vector<std::filesystem::path> remove_old_results(const std::filesystem::path& base,
                                                      const std::filesystem::path& current,
                                                      int keep);

}  // namespace sturz::workflow
