// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/folder_lock.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/lock_file.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "io/files/atomic_file.hpp"

#include <fmt/core.h>

#include <chrono>
#include <map>
#include <mutex>
#include <random>
#include <thread>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

std::string new_token() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

LockHolder me(const std::string& purpose, bool brief) {
  return {this_process(), utc_now(), purpose, brief, new_token()};
}

[[noreturn]] void refuse(const OutputFolder& folder, const fs::path& file,
                         const LockHolder& holder) {
  const std::string cure =
      liveness_of(holder.process) == Liveness::unknown
          ? fmt::format("It cannot be asked from here: if it is gone, delete {}", file.string())
          : std::string("Wait for it or stop it");
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

/// Refuses while a shard of another process computes; clears away what dead ones have left.
void require_no_shards(const OutputFolder& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.root, ignored)) {
    if (!is_shard_lock(entry.path())) continue;
    const auto holder = live_holder(entry.path());
    if (!holder)
      fs::remove(entry.path(), ignored);
    else if (holder->process != this_process())
      refuse(folder, entry.path(), *holder);
  }
}

/// Waits a minute for the folder's own lock.
/// \param behind_all also behind a process that stays alone; false: refuse then
void take_in_turn(const OutputFolder& folder, const LockHolder& holder, bool behind_all) {
  constexpr std::chrono::seconds patience{60};
  const auto end = std::chrono::steady_clock::now() + patience;
  while (const auto other = take_lock(folder.lock(), holder)) {
    if (!(other->brief || behind_all) || std::chrono::steady_clock::now() > end)
      refuse(folder, folder.lock(), *other);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
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

std::shared_ptr<FolderLock> FolderLock::alone(const OutputFolder& folder,
                                              const std::string& purpose) {
  const std::lock_guard guard(mine().mutex);
  make_folder(folder.root);
  auto& known = mine().alone[fs::weakly_canonical(folder.root).string()];
  if (auto held = known.lock()) return held;
  std::shared_ptr<FolderLock> lock(new FolderLock);
  const LockHolder holder = me(purpose, false);
  if (const auto other = take_lock(folder.lock(), holder)) refuse(folder, folder.lock(), *other);
  lock->main_ = {folder.lock(), holder.token};
  require_no_shards(folder);
  for (const fs::path& part :
       {folder.root, folder.members(), folder.tif_folder(), folder.tif_folder() / "bounds"})
    remove_part_files(part);  // no other process writes there now
  known = lock;
  return lock;
}

std::shared_ptr<FolderLock> FolderLock::shard(const OutputFolder& folder, const Shard& shard,
                                              const std::string& purpose) {
  make_folder(folder.root);
  std::shared_ptr<FolderLock> lock(new FolderLock);
  const LockHolder beginning = me(purpose, true), computing = me(purpose, false);
  take_in_turn(folder, beginning, false);
  lock->main_ = {folder.lock(), beginning.token};
  const fs::path file = shard_file(folder, shard);
  if (const auto other = take_lock(file, computing)) refuse(folder, file, *other);
  lock->shard_ = {file, computing.token};
  return lock;
}

void FolderLock::others_wait(const OutputFolder& folder) {
  if (shard_.token.empty() || !main_.token.empty()) return;
  const LockHolder holder = me("a shard", true);
  take_in_turn(folder, holder, true);  // a merge looks around, sees this shard and goes away
  main_ = {folder.lock(), holder.token};
}

void FolderLock::others_may_come() {
  if (shard_.token.empty()) return;
  drop_lock(main_.file, main_.token);
  main_ = {};
}

FolderLock::~FolderLock() {
  for (const Held* held : {&shard_, &main_})
    if (!held->token.empty()) drop_lock(held->file, held->token);
}

}  // namespace sturz::workflow
