// SPDX-License-Identifier: Apache-2.0
/// Who may work in a results folder: one process alone, or several shards of one scene.
///
///   lock.json             one process alone; a shard holds it too, while it begins or looks around
///   lock_2_of_8.json      shard 2 of 8 computes
///
/// The locks of shards are only made under lock.json, so the two kinds never miss each other. Locks
/// of processes that are gone are taken over; those of other machines cannot be judged from here.
#pragma once

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
  /// while another one is. Nothing for a lock of the other kind. \throws SetupError when it takes
  /// a minute
  void others_wait(const OutputFolder&);

 private:
  FolderLock() = default;
  struct Held {
    std::filesystem::path file;
    std::string token;
  };
  Held main_, shard_;
};

}  // namespace sturz::workflow
