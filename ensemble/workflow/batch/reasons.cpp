// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/reasons.hpp"

#include "ensemble/workflow/folder/input_check.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::workflow {

std::string other_program(const std::vector<Build>& builds) {
  const Build mine = this_build();
  for (const Build& build : builds) {
    if (build == mine) continue;
    if (build.version != mine.version)
      return fmt::format("program {} -> {}", build.version, mine.version);
    return fmt::format("program {} ({}) -> {} ({})", build.version, build.git_commit, mine.version,
                       mine.git_commit);
  }
  return {};
}

std::vector<std::string> changed_values(const std::vector<std::string>& differences) {
  std::vector<std::string> texts;
  for (std::string text : differences) {
    if (const std::size_t colon = text.find(": "); colon != std::string::npos) text.erase(colon, 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

std::vector<std::string> changed_files(const std::vector<std::string>& sentences) {
  // "input terrain.raster = dem.tif: other values than before in 1 of 4 blocks ..."
  constexpr std::string_view begin = "input ", between = " = ", end = ": ";
  std::vector<std::string> texts;
  for (const std::string& sentence : sentences) {
    const std::size_t equals = sentence.find(between), colon = sentence.find(end);
    if (!sentence.starts_with(begin) || equals == std::string::npos || colon < equals) {
      texts.push_back(sentence);
      continue;
    }
    const std::string key = sentence.substr(begin.size(), equals - begin.size());
    const std::size_t file = equals + between.size();
    texts.push_back(fmt::format("{} changed ({})", sentence.substr(file, colon - file), key));
  }
  return texts;
}

std::vector<std::string> changed_map_inputs(const std::vector<InputIdentity>& before,
                                            const std::vector<InputIdentity>& now) {
  const auto of_maps = [](const std::vector<InputIdentity>& all) {
    std::vector<InputIdentity> own = all;
    for (const InputIdentity& other : of_members(all)) std::erase(own, other);
    return own;
  };
  return changed_files(input_differences(of_maps(before), of_maps(now)));
}

std::string joined(const std::vector<std::string>& reasons) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, reasons.size()); ++i)
    text += (i == 0 ? "" : "; ") + reasons[i];
  if (reasons.size() > most) text += fmt::format(" and {} more", reasons.size() - most);
  return text;
}

}  // namespace sturz::workflow
