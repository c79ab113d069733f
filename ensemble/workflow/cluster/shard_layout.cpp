// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/shard_layout.hpp"

#include <fmt/core.h>

namespace sturz::workflow {

std::vector<ShardState> shard_states(std::span<const MemberSummary> members, std::int64_t planned,
                                     int n) {
  std::vector<ShardState> shards(static_cast<std::size_t>(n));
  for (int k = 1; k <= n; ++k) {
    ShardState& shard = shards[static_cast<std::size_t>(k - 1)];
    shard.k = k;
    shard.members = (planned - k + n) / n;  // shard k has members k-1, k-1+n, ...
  }
  for (const MemberSummary& m : members) {
    if (m.member >= planned) continue;
    ShardState& shard = shards[static_cast<std::size_t>(m.member % n)];
    ++(is_valid(m.outcome) ? shard.valid : shard.failed);
  }
  return shards;
}

std::vector<int> missing_shards(std::span<const ShardState> shards) {
  std::vector<int> missing;
  for (const ShardState& shard : shards)
    if (shard.missing() > 0) missing.push_back(shard.k);
  return missing;
}

std::string ranges_text(std::span<const int> ascending) {
  std::string text;
  for (std::size_t i = 0; i < ascending.size();) {
    std::size_t last = i;
    while (last + 1 < ascending.size() && ascending[last + 1] == ascending[last] + 1) ++last;
    text += text.empty() ? "" : ",";
    text += last == i       ? std::to_string(ascending[i])
            : last == i + 1 ? fmt::format("{},{}", ascending[i], ascending[last])
                            : fmt::format("{}-{}", ascending[i], ascending[last]);
    i = last + 1;
  }
  return text;
}

std::string how_to_resume(const Manifest& manifest, const std::filesystem::path& folder,
                          std::span<const int> missing) {
  const std::string command =
      fmt::format("sturz {} -o {}", manifest.command, shell_word(folder.string()));
  if (manifest.shards <= 1)
    return fmt::format("Resume with the command that computed them: {}", command);
  const bool one = missing.size() == 1;
  std::string text = fmt::format(
      "Shard{} {} of {} {} not finished. Resume with the command that computed them: {} --shard "
      "{}/{}",
      one ? "" : "s", ranges_text(missing), manifest.shards, one ? "is" : "are", command,
      missing.front(), manifest.shards);
  if (missing.size() > 1)
    text += fmt::format(", and --shard K/{} with K = {}", manifest.shards,
                        ranges_text(missing.subspan(1)));
  return text;
}

std::string shell_word(const std::string& word) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace sturz::workflow
