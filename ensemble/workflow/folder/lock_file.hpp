// SPDX-License-Identifier: Apache-2.0
/// One lock as a file that exists: works on network drives, where flock() may not.
///
///   NAME.<unique>.part  --written whole-->  --link() to NAME: fails when NAME exists-->
///
/// A lock whose process is gone (liveness_of) is taken over: the process that links NAME.<its
/// token> first replaces it, so two that find it at the same moment do not both get it.
#pragma once

#include "ensemble/workflow/folder/process_identity.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace sturz::workflow {

/// What stands in a lock.
struct LockHolder {
  ProcessIdentity process;
  std::string since;    ///< UTC, ISO 8601
  std::string purpose;  ///< what the process does there: its command
  bool brief = false;   ///< it will be given back within seconds: others may wait for it
  std::string token;    ///< of this lock alone
};

/// Nothing when there is no lock of that name, or its process is gone.
/// \throws SetupError when it cannot be read
std::optional<LockHolder> live_holder(const std::filesystem::path& file);

/// Makes the lock. \return nothing when it is ours now, else who holds it
/// \throws IoError when the folder cannot be written
std::optional<LockHolder> take_lock(const std::filesystem::path& file, const LockHolder& mine);

/// Removes the lock if it is still the one with that token. Never throws.
void drop_lock(const std::filesystem::path& file, const std::string& token) noexcept;

/// "process 123 on node7 since 2026-01-31T12:00:00Z (ensemble s.yaml)"
std::string holder_text(const LockHolder&);

}  // namespace sturz::workflow
