// SPDX-License-Identifier: Apache-2.0
/// From what members left in a cell to the values of all layers there, one block at a time.
#pragma once

#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/layer_block.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "ensemble/hazard/sample_quantile.hpp"
#include "ensemble/hazard/sorting/rank_finder.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <span>
#include <vector>

namespace sturz {

class CellStatistics {
 public:
  /// \param extent the map's place in the members' grid
  CellStatistics(const HazardLayers& layers, std::size_t n_members, const Window& extent,
                 KnownGround ground, LayerSink& to);

  /// Blocks must come with all their rows, one block after the other; a complete one goes to the
  /// sink.
  void add(const CellRows& rows);

 private:
  void reached(const ReachLayers& to, const CellRows& rows, std::size_t i, std::size_t cell);
  /// Quantiles over the members that have a value.
  void over_comers(PeakLayer source, std::size_t layer, const CellRows& rows, std::size_t i,
                   std::size_t cell);
  void quantity(const QuantityLayers& to, const CellRows& rows, std::size_t i, std::size_t cell);
  void intensity(const CellRows& rows, std::size_t i, std::size_t cell);

  double share(std::int64_t hits) const;
  void put_probability(const ProbabilityLayers& to, std::size_t plane, std::size_t cell,
                       std::int64_t hits);
  /// Of kept_ and so many zeros.
  void put_quantiles(std::size_t layer, std::size_t cell, std::size_t n_zeros, double units_per_si);
  /// Into kept_.
  template <class Keep>
  void keep_where(std::span<const float> values, Keep keep);

  const HazardLayers& layers_;
  std::int64_t n_;
  LayerBlock block_;
  std::vector<ProbabilityBounds> bounds_;  // of each possible number of hits
  // Scratch.
  std::span<const float> kept_;  // of the cell's values
  std::vector<float> chosen_, found_;
  std::vector<QuantilePlace> places_;
  std::vector<std::size_t> ranks_;
  RankFinder finder_;
};

}  // namespace sturz
