// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/recent_members.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <system_error>
#include <tuple>
#include <utility>

namespace sturz::workflow {
namespace {

double written_at(const std::filesystem::path& file) {
  std::error_code failed;
  const auto time = std::filesystem::last_write_time(file, failed);
  return failed ? 0 : std::chrono::duration<double>(time.time_since_epoch()).count();
}

}  // namespace

std::vector<std::size_t> written_last(std::vector<WrittenMember> members, std::size_t n,
                                      double old_s) {
  double youngest = 0;
  for (const WrittenMember& m : members) youngest = std::max(youngest, m.written_s);
  std::sort(members.begin(), members.end(), [&](const WrittenMember& a, const WrittenMember& b) {
    const auto key = [&](const WrittenMember& m) {
      return std::tuple(m.written_s < youngest - old_s, m.behind, -m.written_s, m.index);
    };
    return key(a) < key(b);
  });
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < std::min(n, members.size()); ++i) indices.push_back(members[i].index);
  return indices;
}

std::vector<std::size_t> written_last(const MemberStore& store, std::size_t n) {
  std::map<std::filesystem::path, std::vector<std::pair<std::uint64_t, std::size_t>>> files;
  for (std::size_t i = 0; i < store.members().size(); ++i)
    files[store.file_of(i)].emplace_back(store.offset_of(i), i);
  std::vector<WrittenMember> members;
  for (auto& [file, records] : files) {
    const double written_s = written_at(file);
    std::sort(records.rbegin(), records.rend());
    for (std::size_t k = 0; k < std::min(n, records.size()); ++k)
      members.push_back({records[k].second, written_s, k});
  }
  return written_last(std::move(members), n);
}

}  // namespace sturz::workflow
