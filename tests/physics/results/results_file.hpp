// SPDX-License-Identifier: Apache-2.0
/// The accuracy-versus-time table on disk: one line per case, in whatever order they ran.
#pragma once

#include <string>

namespace sturz::test {

/// Puts `line` into tests/physics/results.csv of the build tree, in place of the line that starts
/// with "key" in quotes. Test processes that run at the same time wait for each other.
void keep_line(const std::string& key, const std::string& line);

}  // namespace sturz::test
