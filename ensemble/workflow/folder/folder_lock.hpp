// SPDX-License-Identifier: Apache-2.0
/// Who may work in a results folder: one process alone, or several shards of one scene.
///
///   lock.json             one process alone; a shard holds it too, while it begins or looks around
///   lock_2_of_8.json      shard 2 of 8 computes
///
/// The locks of shards are only made under lock.json, so the two kinds never miss each other. Locks
/// of processes that are gone are taken over (lock_file.hpp says when they are). One of another
/// machine is listened to first: a beat of its heart, and it is refused; a minute of
/// silence, and it is gone. A shard whose lock was taken over goes on all the same, because members
/// come out the same whatever computes them; who is alone in a folder must not.
#pragma once

#include "ensemble/workflow/folder/lock/heartbeat.hpp"
#include "ensemble/workflow/folder/lock_file.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/folder/shard.hpp"

#include <memory>
#include <string>

namespace sturz::workflow {

class FolderLock {
 public:
  /// Alone in the folder. Within one process a second lock of a folder is the first one again.
  /// \throws SetupError naming who works there; IoError when the folder cannot be written
  static std::shared_ptr<FolderLock> alone(const OutputFolder&, const std::string& purpose);
  /// As a shard, alone until others_may_come(). Waits while another shard begins.
  static std::shared_ptr<FolderLock> shard(const OutputFolder&, const Shard&,
                                           const std::string& purpose);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// A shard has begun: others may begin too. Nothing for a lock of the other kind.
  void others_may_come();
  /// A shard is alone again for a moment, until others_may_come(): to change what all share. Waits
  /// while another one is. Nothing for a lock of the other kind. \throws SetupError when one of
  /// them takes minutes
  void others_wait(const OutputFolder&);
  /// Says in the lock how many members are computed at a time, for those that look at the folder.
  void say_workers(int workers);
  /// \throws SetupError when the folder is another process's now, which took this one for gone.
  /// Nothing for a shard.
  void require_ours() const;

 private:
  FolderLock();
  struct Held {
    std::filesystem::path file;
    LockHolder holder;  ///< no token: not held
  };
  void hold(Held&, const std::filesystem::path& file, const LockHolder&);
  void give_back(Held&);
  Held main_, shard_;
  Heartbeat heart_;
};

}  // namespace sturz::workflow
