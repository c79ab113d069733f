// SPDX-License-Identifier: Apache-2.0
/// Scenario texts small enough to be computed many times in a test.
#pragma once

#include <string>

namespace sturz::test {

/// A slide of 300 particles on a plane, six members of about a tenth of a second.
std::string tiny_scene();
/// `text` with the first `from` replaced; the test fails when it is not there.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace sturz::test
