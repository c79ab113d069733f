// SPDX-License-Identifier: Apache-2.0
/// Files that must not outlive the process: part files while they are written, locks while they are
/// held. What has to end the process at once, past all destructors, removes them first.
#pragma once

#include <filesystem>

namespace sturz {

void remember_unfinished(const std::filesystem::path& file);
void forget_unfinished(const std::filesystem::path& file);
/// Removes all that are remembered, as far as that goes without waiting for other threads; never
/// throws. Not for a signal handler.
void remove_unfinished() noexcept;

}  // namespace sturz
