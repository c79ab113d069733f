// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/cell_statistics.hpp"

#include "ensemble/hazard/swiss_intensity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// In 32 bits, so that eight are compared at a time.
template <class Chosen>
std::int64_t count_where(std::span<const float> values, Chosen chosen) {
  std::uint32_t n = 0;
  for (const float v : values) n += static_cast<std::uint32_t>(chosen(v));
  return n;
}

}  // namespace

CellStatistics::CellStatistics(const HazardLayers& layers, std::size_t n_members,
                               const Window& extent, KnownGround ground, LayerSink& to)
    : layers_(layers),
      n_(static_cast<std::int64_t>(n_members)),
      block_(layers, extent, std::move(ground), to) {
  for (std::int64_t hits = 0; hits <= n_; ++hits) bounds_.push_back(wilson_interval(hits, n_));
}

void CellStatistics::add(const CellRows& rows) {
  block_.add(rows, [&](std::size_t i, std::size_t cell) {
    for (const ReachLayers& r : layers_.reaches) reached(r, rows, i, cell);
    if (layers_.liquid_fraction)
      over_comers(PeakLayer::liquid_fraction, *layers_.liquid_fraction, rows, i, cell);
    for (const QuantityLayers& q : layers_.quantities) quantity(q, rows, i, cell);
    intensity(rows, i, cell);
    if (layers_.mass_left) {
      const std::span<const float> left = rows.of(PeakLayer::left, i);
      block_.put(*layers_.mass_left, 0, cell,
                 share(count_where(left, [](float v) { return v > 0; })));
    }
  });
}

void CellStatistics::reached(const ReachLayers& to, const CellRows& rows, std::size_t i,
                             std::size_t cell) {
  keep_where(rows.of(to.source, i), [](float t) { return !std::isnan(t); });
  put_probability(to.reached, 0, cell, static_cast<std::int64_t>(kept_.size()));
  if (!kept_.empty() && to.quantile) put_quantiles(*to.quantile, cell, 0, 1);
}

void CellStatistics::over_comers(PeakLayer source, std::size_t layer, const CellRows& rows,
                                 std::size_t i, std::size_t cell) {
  keep_where(rows.of(source, i), [](float v) { return !std::isnan(v); });
  if (!kept_.empty()) put_quantiles(layer, cell, 0, 1);
}

void CellStatistics::quantity(const QuantityLayers& to, const CellRows& rows, std::size_t i,
                              std::size_t cell) {
  const std::span<const float> members = rows.of(to.source, i);
  keep_where(members, [](float v) { return v > 0; });
  if (kept_.empty()) return;  // the layers hold the value of an untouched cell already
  if (to.exceedance)
    for (std::size_t plane = 0; plane < to.exceedance->thresholds.size(); ++plane) {
      const float threshold = to.exceedance->thresholds[plane];
      put_probability(*to.exceedance, plane, cell,
                      count_where(kept_, [threshold](float v) { return v > threshold; }));
    }
  if (to.mean)
    block_.put(*to.mean, 0, cell,
               rows.sums[static_cast<std::size_t>(to.source)][i] / static_cast<double>(n_) *
                   to.units_per_si);
  if (to.quantile)
    put_quantiles(*to.quantile, cell, static_cast<std::size_t>(n_) - kept_.size(), to.units_per_si);
}

void CellStatistics::intensity(const CellRows& rows, std::size_t i, std::size_t cell) {
  const std::span<const float> h = rows.of(PeakLayer::thickness, i),
                               v = rows.of(PeakLayer::speed, i),
                               arrived = rows.of(PeakLayer::arrival, i);
  std::uint32_t high = 0, medium = 0;
  for (std::size_t m = 0; m < h.size(); ++m) {
    const bool came = !std::isnan(arrived[m]);  // not: the smoothing's tail beyond the last column
    const bool is_high = is_high_debris_flow_intensity(h[m], v[m]);
    high += static_cast<std::uint32_t>(came & is_high);
    medium += static_cast<std::uint32_t>(came & !is_high);
  }
  block_.put(layers_.high_intensity, 0, cell, share(high));
  block_.put(layers_.medium_intensity, 0, cell, share(medium));
}

double CellStatistics::share(std::int64_t hits) const {
  return static_cast<double>(hits) / static_cast<double>(n_);
}

void CellStatistics::put_probability(const ProbabilityLayers& to, std::size_t plane,
                                     std::size_t cell, std::int64_t hits) {
  block_.put(to.probability, plane, cell, share(hits));
  block_.put(to.lower, plane, cell, bounds_[static_cast<std::size_t>(hits)].lower);
  block_.put(to.upper, plane, cell, bounds_[static_cast<std::size_t>(hits)].upper);
}

void CellStatistics::put_quantiles(std::size_t layer, std::size_t cell, std::size_t n_zeros,
                                   double units_per_si) {
  const std::vector<double>& fractions = layers_.stack.layers[layer].axis.values;
  places_.clear();
  ranks_.clear();
  for (const double fraction : fractions) {
    places_.emplace_back(kept_.size() + n_zeros, fraction);
    for (const std::size_t place : {places_.back().below, places_.back().above})
      if (place >= n_zeros) ranks_.push_back(place - n_zeros);
  }
  std::sort(ranks_.begin(), ranks_.end());
  found_.resize(ranks_.size());
  finder_.find(kept_, ranks_, found_);
  const auto x = [&](std::size_t place) {
    if (place < n_zeros) return 0.0;
    const auto at = std::lower_bound(ranks_.begin(), ranks_.end(), place - n_zeros);
    return double{found_[static_cast<std::size_t>(at - ranks_.begin())]};
  };
  for (std::size_t q = 0; q < fractions.size(); ++q)
    block_.put(layer, q, cell,
               places_[q].between(x(places_[q].below), x(places_[q].above)) * units_per_si);
}

/// Mostly all of them: then they stay where they are.
template <class Keep>
void CellStatistics::keep_where(std::span<const float> values, Keep keep) {
  const auto n_kept = static_cast<std::size_t>(count_where(values, keep));
  if (n_kept == values.size()) {
    kept_ = values;
    return;
  }
  chosen_.resize(values.size());
  std::size_t n = 0;
  for (const float v : values) {
    chosen_[n] = v;
    n += static_cast<std::size_t>(keep(v));
  }
  kept_ = std::span(chosen_).first(n);
}

}  // namespace sturz
