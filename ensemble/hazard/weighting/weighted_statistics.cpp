// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/weighting/weighted_statistics.hpp"

#include "ensemble/hazard/swiss_intensity.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {

WeightedStatistics::WeightedStatistics(const HazardLayers& layers, std::span<const double> weights,
                                       const Window& extent, KnownGround ground, LayerSink& to)
    : layers_(layers),
      weights_(weights.begin(), weights.end()),
      effective_(effective_size(weights)),
      block_(layers, extent, std::move(ground), to) {}

void WeightedStatistics::add(const CellRows& rows) {
  block_.add(rows, [&](std::size_t i, std::size_t cell) {
    for (const ReachLayers& r : layers_.reaches) reached(r, rows, i, cell);
    if (layers_.liquid_fraction)
      over_comers(PeakLayer::liquid_fraction, *layers_.liquid_fraction, rows, i, cell);
    for (const QuantityLayers& q : layers_.quantities) quantity(q, rows, i, cell);
    intensity(rows, i, cell);
    if (layers_.mass_left)
      block_.put(*layers_.mass_left, 0, cell,
                 weight_of(rows, PeakLayer::left, i, [](float v) { return v > 0; }));
  });
}

void WeightedStatistics::reached(const ReachLayers& to, const CellRows& rows, std::size_t i,
                                 std::size_t cell) {
  const auto came = [](float t) { return !std::isnan(t); };
  put_probability(to.reached, 0, cell, weight_of(rows, to.source, i, came));
  if (to.quantile) over_comers(to.source, *to.quantile, rows, i, cell);
}

void WeightedStatistics::over_comers(PeakLayer source, std::size_t layer, const CellRows& rows,
                                     std::size_t i, std::size_t cell) {
  sort_where(rows, source, i, [](float v) { return !std::isnan(v); });
  double sum = 0, squares = 0;
  for (const WeighedValue& v : sorted_) {
    sum += v.weight;
    squares += v.weight * v.weight;
  }
  // The members that came have an effective number of their own.
  if (sum > 0) put_quantiles(layer, cell, 0, sum * sum / squares, 1);
}

void WeightedStatistics::quantity(const QuantityLayers& to, const CellRows& rows, std::size_t i,
                                  std::size_t cell) {
  const std::span<const float> values = rows.of(to.source, i);
  if (to.exceedance)
    for (std::size_t plane = 0; plane < to.exceedance->thresholds.size(); ++plane) {
      const float threshold = to.exceedance->thresholds[plane];
      put_probability(*to.exceedance, plane, cell,
                      weight_of(rows, to.source, i, [&](float v) { return v > threshold; }));
    }
  if (to.mean) {
    const std::span<const std::uint32_t> members = rows.members_of(i);
    double sum = 0;
    for (std::size_t m = 0; m < members.size(); ++m) sum += weights_[members[m]] * values[m];
    block_.put(*to.mean, 0, cell, sum * to.units_per_si);
  }
  if (!to.quantile) return;
  sort_where(rows, to.source, i, [](float v) { return v > 0; });
  double above = 0;
  for (const WeighedValue& v : sorted_) above += v.weight;
  put_quantiles(*to.quantile, cell, std::max(0.0, 1 - above), effective_, to.units_per_si);
}

void WeightedStatistics::intensity(const CellRows& rows, std::size_t i, std::size_t cell) {
  const std::span<const float> h = rows.of(PeakLayer::thickness, i),
                               v = rows.of(PeakLayer::speed, i),
                               arrived = rows.of(PeakLayer::arrival, i);
  const std::span<const std::uint32_t> members = rows.members_of(i);
  double high = 0, medium = 0;
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (std::isnan(arrived[m])) continue;  // the smoothing's tail beyond the last column
    (is_high_debris_flow_intensity(h[m], v[m]) ? high : medium) += weights_[members[m]];
  }
  block_.put(layers_.high_intensity, 0, cell, std::min(high, 1.0));
  block_.put(layers_.medium_intensity, 0, cell, std::min(medium, 1.0));
}

void WeightedStatistics::put_probability(const ProbabilityLayers& to, std::size_t plane,
                                         std::size_t cell, double share) {
  const ProbabilityBounds bounds = wilson_interval_of_share(share, effective_);
  block_.put(to.probability, plane, cell, share);
  block_.put(to.lower, plane, cell, bounds.lower);
  block_.put(to.upper, plane, cell, bounds.upper);
}

void WeightedStatistics::put_quantiles(std::size_t layer, std::size_t cell, double zero_weight,
                                       double effective, double units_per_si) {
  const std::vector<double>& fractions = layers_.stack.layers[layer].axis.values;
  for (std::size_t q = 0; q < fractions.size(); ++q)
    block_.put(layer, q, cell,
               weighted_map_quantile(sorted_, zero_weight, effective, fractions[q]) * units_per_si);
}

template <class Chosen>
double WeightedStatistics::weight_of(const CellRows& rows, PeakLayer layer, std::size_t i,
                                     Chosen chosen) const {
  const std::span<const float> values = rows.of(layer, i);
  const std::span<const std::uint32_t> members = rows.members_of(i);
  double sum = 0;
  for (std::size_t m = 0; m < members.size(); ++m)
    if (chosen(values[m])) sum += weights_[members[m]];
  return std::min(sum, 1.0);  // all weights together, rounded
}

template <class Chosen>
void WeightedStatistics::sort_where(const CellRows& rows, PeakLayer layer, std::size_t i,
                                    Chosen chosen) {
  const std::span<const float> values = rows.of(layer, i);
  const std::span<const std::uint32_t> members = rows.members_of(i);
  sorted_.clear();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (chosen(values[m]) && weights_[members[m]] > 0)
      sorted_.push_back({values[m], weights_[members[m]]});
  std::stable_sort(sorted_.begin(), sorted_.end(),
                   [](const WeighedValue& a, const WeighedValue& b) { return a.value < b.value; });
}

}  // namespace sturz
