// SPDX-License-Identifier: Apache-2.0
#include "reports/page/region_payload.hpp"

#include "reports/figures/codec.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_hits = 6'000'000;
constexpr std::size_t most_sources = 65'534;
constexpr double share_steps = 65'534;

Json packed(const std::vector<std::uint16_t>& codes, int n_cols) {
  PackedCodes p = pack_codes(codes, n_cols);
  return {{"square", false}, {"offset", 0},    {"factor", 1},
          {"nodata", -1},    {"bits", p.bits}, {"data", std::move(p.data)}};
}

/// Cell of the scene and its source, each with the largest probability.
std::map<std::pair<std::size_t, std::uint32_t>, float> hits_of_scene(const SourceLists& lists,
                                                                     const MapScene& scene) {
  std::map<std::pair<std::size_t, std::uint32_t>, float> hits;
  const Window& w = scene.window;
  for (std::size_t i = 0; i < lists.cells.size(); ++i) {
    const auto row = static_cast<int>(lists.cells[i] / lists.grid.n_cols) - w.row0;
    const auto col = static_cast<int>(lists.cells[i] % lists.grid.n_cols) - w.col0;
    if (row < 0 || col < 0 || row >= w.n_rows || col >= w.n_cols) continue;
    const std::size_t cell = scene.cells.index(row / scene.coarsening, col / scene.coarsening);
    for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k) {
      float& p = hits[{cell, lists.hits[k].source}];
      p = std::max(p, lists.hits[k].probability);
    }
  }
  return hits;
}

}  // namespace

Json sources_json(const RegionShown& region, const MapScene& scene) {
  const SourceLists& lists = region.lists;
  if (lists.hits.size() > most_hits || lists.sources.size() > most_sources) return nullptr;
  std::vector<std::uint16_t> counts(scene.cells.n_cells(), 0), sources, shares;
  for (const auto& [at, probability] : hits_of_scene(lists, scene)) {
    ++counts[at.first];
    sources.push_back(static_cast<std::uint16_t>(at.second));
    shares.push_back(static_cast<std::uint16_t>(std::lround(share_steps * probability)));
  }
  return {{"names", lists.sources},
          {"counts", packed(counts, scene.cells.n_cols)},
          {"sources", packed(sources, 1)},
          {"shares", packed(shares, 1)},
          {"steps", share_steps}};
}

}  // namespace sturz
