// SPDX-License-Identifier: Apache-2.0
/// As CellStatistics, of members that do not count alike: shares of weight in place of shares of
/// members. Sums go over the members in their order, so the bits follow from members and weights.
#pragma once

#include "ensemble/hazard/layer_block.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "ensemble/hazard/weighting/weighted_quantile.hpp"

#include <span>
#include <vector>

namespace sturz {

class WeightedStatistics {
 public:
  /// \param weights of the valid members by ascending number, >= 0, adding up to 1
  /// \param extent the map's place in the members' grid
  WeightedStatistics(const HazardLayers& layers, std::span<const double> weights,
                     const Window& extent, KnownGround ground, LayerSink& to);

  /// See CellStatistics::add.
  void add(const CellRows& rows);

 private:
  void reached(const ReachLayers& to, const CellRows& rows, std::size_t i, std::size_t cell);
  /// Quantiles over the members that have a value.
  void over_comers(PeakLayer source, std::size_t layer, const CellRows& rows, std::size_t i,
                   std::size_t cell);
  void quantity(const QuantityLayers& to, const CellRows& rows, std::size_t i, std::size_t cell);
  void intensity(const CellRows& rows, std::size_t i, std::size_t cell);
  void put_probability(const ProbabilityLayers& to, std::size_t plane, std::size_t cell,
                       double share);
  void put_quantiles(std::size_t layer, std::size_t cell, double zero_weight, double effective,
                     double units_per_si);
  /// Weight of the members of cell i whose value in that layer is chosen.
  template <class Chosen>
  double weight_of(const CellRows& rows, PeakLayer layer, std::size_t i, Chosen chosen) const;
  /// Those members' values and weights, ascending, into sorted_.
  template <class Chosen>
  void sort_where(const CellRows& rows, PeakLayer layer, std::size_t i, Chosen chosen);

  const HazardLayers& layers_;
  std::vector<double> weights_;
  double effective_;
  LayerBlock block_;
  std::vector<WeighedValue> sorted_;  // scratch
};

}  // namespace sturz
