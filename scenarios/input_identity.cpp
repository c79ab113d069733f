// SPDX-License-Identifier: Apache-2.0
#include "scenarios/input_identity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace sturz {
namespace {

const InputIdentity* find(const std::vector<InputIdentity>& all, const std::string& role) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const InputIdentity& one) { return one.role == role; });
  return found == all.end() ? nullptr : &*found;
}

std::string name_of(const InputIdentity& input) {
  return input.role.empty() ? "input " + input.file
                            : fmt::format("input {} = {}", input.role, input.file);
}

std::string difference(const InputIdentity& before, const InputIdentity& now) {
  if (before.shape != now.shape)
    return fmt::format("was {}; is {}", before.shape.empty() ? "something else" : before.shape,
                       now.shape);
  std::size_t unread = 0, other = 0;
  std::string first;
  for (const auto& [part, hash] : before.parts) {
    const auto is = now.parts.find(part);
    if (is != now.parts.end() && is->second == hash) continue;
    if (is == now.parts.end()) ++unread;
    if (other++ == 0) first = part;
  }
  if (other == 0) return {};
  if (first == "features") return "other polygons or values than before";
  return fmt::format(
      "{} in {} of {} blocks of 256 x 256 cells, the first block {} (row/column of blocks, from 0)",
      unread == other ? "cannot be compared" : "other values than before", other,
      before.parts.size(), first);
}

}  // namespace

std::vector<std::string> parts_to_read(const InputIdentity& now,
                                       const std::vector<InputIdentity>& before) {
  std::vector<std::string> names;
  if (const InputIdentity* was = find(before, now.role); was != nullptr)
    for (const auto& [part, hash] : was->parts)
      if (!now.parts.contains(part)) names.push_back(part);
  return names;
}

std::vector<std::string> input_differences(const std::vector<InputIdentity>& before,
                                           const std::vector<InputIdentity>& now) {
  std::vector<std::string> found;
  for (const InputIdentity& is : now) {
    const InputIdentity* was = find(before, is.role);
    const std::string text = was == nullptr ? "was not there before" : difference(*was, is);
    if (!text.empty()) found.push_back(name_of(is) + ": " + text);
  }
  for (const InputIdentity& was : before) {
    if (was.role.empty())
      found.push_back(name_of(was) +
                      ": is known by the bytes of its file only, so a change of what was read "
                      "cannot be told; another version of sturz began this folder");
    else if (find(now, was.role) == nullptr)
      found.push_back(name_of(was) + ": is not there any more");
  }
  return found;
}

std::vector<InputIdentity> with_known_parts(std::vector<InputIdentity> now,
                                            const std::vector<InputIdentity>& before) {
  for (InputIdentity& is : now)
    if (const InputIdentity* was = find(before, is.role); was != nullptr)
      is.parts.insert(was->parts.begin(), was->parts.end());
  return now;
}

std::string identity_text(const InputIdentity& input) {
  // FNV-1a over texts that are hashes themselves: short, and only for the eye.
  std::uint64_t sum = 14695981039346656037ULL;
  const auto add = [&](const std::string& text) {
    for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  };
  for (const auto& [part, hash] : input.parts) {
    add(part);
    add(hash);
  }
  return fmt::format("{}; content {:016x}", input.shape, sum);
}

}  // namespace sturz
