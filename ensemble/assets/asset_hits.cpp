// SPDX-License-Identifier: Apache-2.0
#include "ensemble/assets/asset_hits.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace sturz {
namespace {

constexpr int band_rows = 128;
constexpr std::array peaks{PeakLayer::thickness, PeakLayer::speed, PeakLayer::energy,
                           PeakLayer::pressure};

struct AssetCell {
  int row = 0, col = 0;
  std::size_t asset = 0;
};

/// Cells of assets in some rows of the grid, and the window around them.
struct Band {
  Window window;
  std::vector<AssetCell> cells;
};

std::vector<Band> bands_of(const Assets& assets, const Grid& grid) {
  std::vector<Band> bands(static_cast<std::size_t>(grid.n_rows / band_rows + 1));
  for (std::size_t a = 0; a < assets.list.size(); ++a)
    for (const std::size_t cell : assets.list[a].cells) {
      expect(cell < grid.n_cells(), "cells of assets lie on the grid of the members");
      const auto width = static_cast<std::size_t>(grid.n_cols);
      const auto row = static_cast<int>(cell / width), col = static_cast<int>(cell % width);
      Band& band = bands[static_cast<std::size_t>(row / band_rows)];
      band.window = joined(band.window, {row, col, 1, 1});
      band.cells.push_back({row, col, a});
    }
  std::erase_if(bands, [](const Band& band) { return band.cells.empty(); });
  return bands;
}

/// What is known of one member at all assets while its bands are read.
class MemberAtAssets {
 public:
  MemberAtAssets(const MemberParts& source, std::size_t index, std::size_t place,
                 std::size_t n_assets)
      : source_(source), index_(index), hits_(n_assets), is_hit_(n_assets, false) {
    for (AssetHit& hit : hits_) hit.member = place;
  }

  void look(const Band& band) {
    const Window part = overlap(source_.members()[index_].window, band.window);
    if (part.n_cells() == 0) return;
    std::vector<float> values(part.n_cells());
    const auto at = [&](const AssetCell& c) {
      return values[static_cast<std::size_t>(c.row - part.row0) * part.n_cols +
                    static_cast<std::size_t>(c.col - part.col0)];
    };
    source_.read_part(index_, PeakLayer::arrival, part, values);
    std::vector<AssetCell> reached;
    for (const AssetCell& c : band.cells) {
      if (!part.contains(c.row, c.col) || std::isnan(at(c))) continue;
      AssetHit& hit = hits_[c.asset];
      hit.arrival_s = is_hit_[c.asset] ? std::min(hit.arrival_s, at(c)) : at(c);
      is_hit_[c.asset] = true;
      reached.push_back(c);
    }
    if (reached.empty()) return;
    for (const PeakLayer layer : peaks) {
      source_.read_part(index_, layer, part, values);
      for (const AssetCell& c : reached) {
        float& peak = peak_of(hits_[c.asset], layer);
        peak = std::max(peak, at(c));
      }
    }
  }

  void give(AssetHits& out) const {
    for (std::size_t a = 0; a < hits_.size(); ++a)
      if (is_hit_[a]) out.of[a].push_back(hits_[a]);
  }

 private:
  static float& peak_of(AssetHit& hit, PeakLayer layer) {
    switch (layer) {
      case PeakLayer::speed:
        return hit.speed_m_s;
      case PeakLayer::energy:
        return hit.energy_j_m2;
      case PeakLayer::pressure:
        return hit.pressure_pa;
      default:
        return hit.thickness_m;
    }
  }

  const MemberParts& source_;
  std::size_t index_;
  std::vector<AssetHit> hits_;
  std::vector<bool> is_hit_;
};

}  // namespace

AssetHits find_hits(const MemberParts& source, const Assets& assets, CancelFlag cancel) {
  AssetHits out;
  out.of.resize(assets.list.size());
  const auto& members = source.members();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_valid(members[i].outcome)) order.push_back(i);
  if (order.empty()) return out;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return members[a].member < members[b].member; });
  const std::vector<Band> bands = bands_of(assets, source.grid());
  for (std::size_t place = 0; place < order.size(); ++place) {
    cancel.check();
    const MemberSummary& m = members[order[place]];
    out.members.push_back(m.member);
    out.censoring.push_back(m.censoring);
    MemberAtAssets member(source, order[place], place, assets.list.size());
    for (const Band& band : bands) member.look(band);
    member.give(out);
  }
  return out;
}

}  // namespace sturz
