// SPDX-License-Identifier: Apache-2.0
/// Names in messages: which was probably meant, which there are.
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

/// "a, b, c"
template <class Names>
std::string comma_separated(const Names& names) {
  std::string text;
  for (const auto& name : names) (text += text.empty() ? "" : ", ") += name;
  return text;
}

}  // namespace sturz
