// SPDX-License-Identifier: Apache-2.0
/// The name that was probably meant.
#pragma once

#include <string>
#include <vector>

namespace sturz {

/// Number of single-character insertions, deletions, replacements and swaps of neighbours that
/// turn `a` into `b`.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `word`, first one wins; empty when none is near enough to be a slip
/// (more than two edits and more than a third of the word).
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace sturz
