// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/folder_lock.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/lock_file.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "io/files/atomic_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
namespace {

std::string new_token() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

constexpr std::chrono::seconds beat{5};

LockHolder me(const std::string& purpose, bool brief) {
  return {this_process(), utc_now(),   purpose,
          brief,          new_token(), std::chrono::duration<double>(beat).count()};
}

[[noreturn]] void refuse(const OutputFolder& folder, const fs::path& file,
                         const LockHolder& holder) {
  std::string cure = "Wait for it or stop it";
  if (liveness_of(holder.process) == Liveness::unknown)
    cure =
        holder.beat_s > 0
            ? fmt::format(
                  "Its lock beats: wait for it or stop it. Killed, it counts as gone "
                  "{:.0f} s after its last beat",
                  holder.silence_s())
            : fmt::format("It cannot be asked from here: if it is gone, delete {}", file.string());
  throw SetupError(
      fmt::format("{}: another sturz works there, {}. {}; or choose another folder with --out.",
                  folder.root.string(), holder_text(holder), cure));
}

fs::path shard_file(const OutputFolder& folder, const Shard& shard) {
  return folder.root / fmt::format("lock_{}_of_{}.json", shard.k, shard.n);
}

bool is_shard_lock(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("lock_") && name.ends_with(".json") &&
         name.find("_of_") != std::string::npos;
}

enum class Behind {
  brief,  ///< behind those that give their lock back within seconds
  all,    ///< also behind a process that stays alone
};

/// Looks at a lock that another process holds until it is known what to do: wait on, or give up.
class Waiting {
 public:
  Waiting(fs::path file, Behind behind) : file_(std::move(file)), behind_(behind) {}

  bool worthwhile(const LockHolder& other) {
    const auto now = Clock::now(), touched = Clock::time_point(last_touch(file_).value_or(0ns));
    if (other.token != token_) {
      token_ = other.token;
      since_ = now;
      first_touch_ = touched;
    }
    // One that cannot be asked, and promised to beat, is listened to for as long as it takes.
    const bool listening = other.beat_s > 0 && liveness_of(other.process) == Liveness::unknown;
    const std::chrono::duration<double> listens(listening ? other.silence_s() + 2 * other.beat_s
                                                          : 0.0);
    if (other.brief || behind_ == Behind::all)
      return now - since_ < std::max<std::chrono::duration<double>>(60s, listens);
    return touched == first_touch_ && now - since_ < listens;
  }
  /// Longer and longer: a thousand shards may wait for one lock.
  void pause() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min<std::chrono::milliseconds>(1s, pause_ * 5 / 4);
  }

 private:
  using Clock = std::chrono::steady_clock;
  fs::path file_;
  Behind behind_;
  std::string token_;
  Clock::time_point since_, first_touch_;
  std::chrono::milliseconds pause_{50};
};

/// Takes the lock, behind those that hold it where that is worthwhile. \throws SetupError else
void take(const OutputFolder& folder, const fs::path& file, const LockHolder& mine,
          Behind behind = Behind::brief) {
  Waiting waiting(file, behind);
  while (const auto other = take_lock(file, mine)) {
    if (!waiting.worthwhile(*other)) refuse(folder, file, *other);
    waiting.pause();
  }
}

/// Refuses while a shard of another process computes; clears away what dead ones have left.
void require_no_shards(const OutputFolder& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.root, ignored)) {
    if (!is_shard_lock(entry.path())) continue;
    Waiting waiting(entry.path(), Behind::brief);
    while (const auto holder = live_holder(entry.path())) {
      if (holder->process == this_process()) break;
      if (!waiting.worthwhile(*holder)) refuse(folder, entry.path(), *holder);
      waiting.pause();
    }
    if (const auto holder = holder_in(entry.path()); holder && holder->process != this_process())
      fs::remove(entry.path(), ignored);
  }
}

/// The locks of this process that are held now, by the folder's true path.
struct Mine {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<FolderLock>> alone;
};

Mine& mine() {
  static Mine one;
  return one;
}

}  // namespace

FolderLock::FolderLock() : heart_(beat) {}

void FolderLock::hold(Held& held, const fs::path& file, const LockHolder& holder) {
  held = {file, holder};
  heart_.keep(file, holder.token);
}

void FolderLock::give_back(Held& held) {
  if (held.holder.token.empty()) return;
  heart_.leave(held.file);
  drop_lock(held.file, held.holder.token);
  held = {};
}

std::shared_ptr<FolderLock> FolderLock::alone(const OutputFolder& folder,
                                              const std::string& purpose) {
  const std::lock_guard guard(mine().mutex);
  make_folder(folder.root);
  auto& known = mine().alone[fs::weakly_canonical(folder.root).string()];
  if (auto held = known.lock()) return held;
  std::shared_ptr<FolderLock> lock(new FolderLock);
  LockHolder holder = me(purpose, true);  // until it is known that no shard computes
  take(folder, folder.lock(), holder);
  lock->hold(lock->main_, folder.lock(), holder);
  require_no_shards(folder);
  lock->main_.holder.brief = false;
  rewrite_lock(folder.lock(), lock->main_.holder);
  for (const fs::path& part : {folder.root, folder.members(), folder.tif_folder(),
                               folder.tif_folder() / "bounds", folder.peaks_folder()})
    remove_part_files(part);  // no other process writes there now
  known = lock;
  return lock;
}

std::shared_ptr<FolderLock> FolderLock::shard(const OutputFolder& folder, const Shard& shard,
                                              const std::string& purpose) {
  make_folder(folder.root);
  std::shared_ptr<FolderLock> lock(new FolderLock);
  const LockHolder beginning = me(purpose, true), computing = me(purpose, false);
  const fs::path file = shard_file(folder, shard);
  // Listening to an earlier process of this shard must not keep all others from the folder.
  Waiting waiting(file, Behind::brief);
  while (true) {
    take(folder, folder.lock(), beginning);
    lock->hold(lock->main_, folder.lock(), beginning);
    const auto other = take_lock(file, computing);
    if (!other) break;
    if (!waiting.worthwhile(*other)) refuse(folder, file, *other);
    lock->give_back(lock->main_);
    waiting.pause();
  }
  lock->hold(lock->shard_, file, computing);
  return lock;
}

void FolderLock::others_wait(const OutputFolder& folder) {
  if (shard_.holder.token.empty() || !main_.holder.token.empty()) return;
  const LockHolder holder = me("a shard", true);
  take(folder, folder.lock(), holder, Behind::all);  // a merge sees this shard and goes away
  hold(main_, folder.lock(), holder);
}

void FolderLock::others_may_come() {
  if (!shard_.holder.token.empty()) give_back(main_);
}

void FolderLock::say_workers(int workers) {
  Held& held = shard_.holder.token.empty() ? main_ : shard_;
  held.holder.workers = workers;
  rewrite_lock(held.file, held.holder);
}

void FolderLock::require_ours() const {
  require(!shard_.holder.token.empty() || !heart_.lost(),
          fmt::format("{}: another process has taken the folder over, because this one was silent "
                      "for too long (was it, or the network, held up?). Wait for the other one.",
                      main_.file.parent_path().string()));
}

FolderLock::~FolderLock() {
  give_back(shard_);
  give_back(main_);
}

}  // namespace sturz::workflow
