// SPDX-License-Identifier: Apache-2.0
/// The packs of a folder, of which some hundred are open at a time: an ensemble of a thousand
/// shards has more of them than a process may open files.
#pragma once

#include "io/members/packs/pack_file.hpp"

#include <cstddef>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace sturz {

class OpenPacks {
 public:
  explicit OpenPacks(std::vector<std::filesystem::path> paths) : paths_(std::move(paths)) {}

  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// From any thread; stays open as long as it is held. \throws IoError
  std::shared_ptr<const PackFile> get(std::size_t pack) {
    const std::lock_guard guard(lock_);
    auto& file = open_[pack];
    if (file) return file;
    order_.push_back(pack);
    try {
      file = std::make_shared<const PackFile>(paths_.at(pack));
    } catch (...) {
      open_.erase(pack);
      order_.pop_back();
      throw;
    }
    auto mine = file;
    if (order_.size() > most_open) {  // the one that was opened first
      open_.erase(order_.front());
      order_.pop_front();
    }
    return mine;
  }

 private:
  static constexpr std::size_t most_open = 256;
  std::vector<std::filesystem::path> paths_;
  std::mutex lock_;  // guards what follows
  std::map<std::size_t, std::shared_ptr<const PackFile>> open_;
  std::list<std::size_t> order_;
};

}  // namespace sturz
