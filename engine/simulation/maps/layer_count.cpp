// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/layer_count.hpp"

#include <bit>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

constexpr double bins_per_decade = 24;
constexpr double first_exponent = -2.5;

double layers_at(double bin) { return 4 * std::pow(10, first_exponent + bin / bins_per_decade); }

/// Sixteen parts of every octave: none holds two edges, because an octave has seven bins.
std::uint64_t part_of(double layers) { return std::bit_cast<std::uint64_t>(layers) >> 48; }

/// Finds bins without a logarithm: of the part of an octave, the bin at its lower end is known.
struct BinTable {
  std::array<double, LayerHistogram::n_bins> edge{};  // lower end of each bin
  std::uint64_t first = 0;
  std::vector<std::uint8_t> bin_at;  // of each part's lower end

  BinTable() {
    for (int bin = 0; bin < LayerHistogram::n_bins; ++bin)
      edge[static_cast<std::size_t>(bin)] = layers_at(bin);
    first = part_of(edge[1]);
    std::uint8_t bin = 0;
    for (std::uint64_t part = first; part <= part_of(edge.back()); ++part) {
      const double low = std::bit_cast<double>(part << 48);
      while (bin + 1 < LayerHistogram::n_bins && low >= edge[bin + 1U]) ++bin;
      bin_at.push_back(bin);
    }
  }
};

const BinTable table;

}  // namespace

int LayerHistogram::bin_of(double layers) {
  if (!(layers >= table.edge[1])) return 0;
  if (layers >= table.edge.back()) return n_bins - 1;
  const int bin = table.bin_at[part_of(layers) - table.first];
  return layers >= table.edge[static_cast<std::size_t>(bin) + 1] ? bin + 1 : bin;
}

void LayerHistogram::clear() { mass_.fill(0); }

LayerCount LayerHistogram::count(double total_mass) const {
  LayerCount out;
  if (!(total_mass > 0)) return out;
  double below = 0;
  bool half = false, tenth = false;
  for (int bin = 0; bin < n_bins; ++bin) {
    const double mass = mass_[static_cast<std::size_t>(bin)];
    if (mass == 0) continue;
    if (table.edge[static_cast<std::size_t>(bin)] < 4 * (1 - 1e-12))
      out.thin_fraction += mass / total_mass;
    below += mass;
    const double middle = layers_at(bin + 0.5);
    if (!tenth && below >= 0.1 * total_mass) tenth = true, out.p10 = middle;
    if (!half && below >= 0.5 * total_mass) half = true, out.median = middle;
  }
  return out;
}

}  // namespace sturz
