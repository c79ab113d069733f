// SPDX-License-Identifier: Apache-2.0
/// One lock as a file that exists: works on network drives, where flock() may not.
///
///   NAME.<unique>.part  --written whole-->  --link() to NAME: fails when NAME exists-->
///
/// A lock whose process is gone is taken over: the process that links NAME.<its token> first
/// replaces it, so two that find it at the same moment do not both get it. Gone is
///   - one of this machine that does not live (liveness_of);
///   - one of the same scheduled job as we are, begun earlier (replaces);
///   - one that cannot be asked from here and has not touched its lock for `beats_missed` times
///   what
///     it promised, by the clock of the file system alone: clocks of machines differ.
#pragma once

#include "ensemble/workflow/folder/process_identity.hpp"

#include <chrono>
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
  double beat_s = 0;    ///< it touches its lock that often; 0: never (older versions)
  int workers = 0;      ///< members at a time; 0: not known (yet)

  /// So long without a touch, and the process counts as gone [s].
  double silence_s() const { return beats_missed * beat_s; }
  static constexpr int beats_missed = 12;
};

/// Nothing when there is no lock of that name, alive or not. Writes nothing.
/// \throws SetupError when it cannot be read
std::optional<LockHolder> holder_in(const std::filesystem::path& file);

/// Nothing when there is no lock of that name, or its process is gone.
/// \throws SetupError when it cannot be read
std::optional<LockHolder> live_holder(const std::filesystem::path& file);

/// When the lock was touched last, by the clock of the file system; nothing: it is not there.
std::optional<std::chrono::nanoseconds> last_touch(const std::filesystem::path& file);

/// Makes the lock. \return nothing when it is ours now, else who holds it
/// \throws IoError when the folder cannot be written
std::optional<LockHolder> take_lock(const std::filesystem::path& file, const LockHolder& mine);

/// Removes the lock if it is still the one with that token. Never throws.
void drop_lock(const std::filesystem::path& file, const std::string& token) noexcept;

/// Replaces what stands in a lock, where that is still the one with that token.
void rewrite_lock(const std::filesystem::path& file, const LockHolder& mine);

/// "process 123 on node7 since 2026-01-31T12:00:00Z (ensemble s.yaml)"
std::string holder_text(const LockHolder&);

}  // namespace sturz::workflow
