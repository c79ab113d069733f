// SPDX-License-Identifier: Apache-2.0
/// What a map of results shows: which quantity, and which statistic of it.
#pragma once

#include "engine/core/words.hpp"
#include "engine/simulation/member_result.hpp"

namespace sturz {

enum class Quantity {
  reached,    ///< whether the flow came at all
  thickness,  ///< of the flow, vertical
  speed,
  energy,     ///< kinetic, per area
  pressure,   ///< dynamic
  arrival,    ///< time until the flow comes
  deposit,    ///< thickness left behind
  left,       ///< mass that crossed the edge of the known ground
  eroded,     ///< depth of bed that the flow took along
  solid,      ///< volume of grains over area
  liquid,     ///< volume of liquid over area
  intensity,  ///< a class of thickness and speed together
  members,    ///< of the ensemble
  sources,    ///< of a region: which of them come, how many, how likely one of them
  other,
  solid_reached,  ///< as those of the flow, of grains alone
  solid_speed,
  solid_energy,
  solid_pressure,
  solid_arrival,
  liquid_reached,  ///< and of liquid alone
  liquid_speed,
  liquid_energy,
  liquid_pressure,
  liquid_arrival,
  liquid_fraction  ///< share of liquid in the flow's volume
};

enum class Statistic {
  probability,  ///< share of members; of those beyond the axis value where there is an axis
  lower_bound,  ///< of that probability's interval
  upper_bound,
  quantile,  ///< at the levels of the axis
  mean,
  peak,  ///< of one member: largest over time; of an arrival the first, of deposit and erosion the
         ///< last, of a share that of the thickest instant
  count,
  difference,       ///< of two probabilities, -1 .. 1, or an end of its interval
  source_quantile,  ///< quantiles of the source of a region that has the largest, at the levels
                    ///< of the axis
  value             ///< none of these
};

/// Which class an intensity is about.
enum class IntensityClass { none, medium, high };

// The words stand in result files and in the page's data.
constexpr auto words_of(Quantity) {
  using enum Quantity;
  return std::array{Word{reached, "reached"},
                    Word{thickness, "thickness"},
                    Word{speed, "speed"},
                    Word{energy, "energy"},
                    Word{pressure, "pressure"},
                    Word{arrival, "arrival"},
                    Word{deposit, "deposit"},
                    Word{left, "left"},
                    Word{eroded, "eroded"},
                    Word{solid, "solid"},
                    Word{liquid, "liquid"},
                    Word{intensity, "intensity"},
                    Word{members, "members"},
                    Word{sources, "sources"},
                    Word{other, "other"},
                    Word{solid_reached, "solid_reached"},
                    Word{solid_speed, "solid_speed"},
                    Word{solid_energy, "solid_energy"},
                    Word{solid_pressure, "solid_pressure"},
                    Word{solid_arrival, "solid_arrival"},
                    Word{liquid_reached, "liquid_reached"},
                    Word{liquid_speed, "liquid_speed"},
                    Word{liquid_energy, "liquid_energy"},
                    Word{liquid_pressure, "liquid_pressure"},
                    Word{liquid_arrival, "liquid_arrival"},
                    Word{liquid_fraction, "liquid_fraction"}};
}
constexpr auto words_of(Statistic) {
  using enum Statistic;
  return std::array{Word{probability, "probability"},
                    Word{lower_bound, "lower_bound"},
                    Word{upper_bound, "upper_bound"},
                    Word{quantile, "quantile"},
                    Word{mean, "mean"},
                    Word{peak, "peak"},
                    Word{count, "count"},
                    Word{difference, "difference"},
                    Word{source_quantile, "source_quantile"},
                    Word{value, "value"}};
}
constexpr auto words_of(IntensityClass) {
  using enum IntensityClass;
  return std::array{Word{none, "none"}, Word{medium, "medium"}, Word{high, "high"}};
}

/// Which of two materials a quantity is about, where it is about one.
constexpr Phase phase_of(Quantity q) {
  using enum Quantity;
  if (q == solid || (q >= solid_reached && q <= solid_arrival)) return Phase::grains;
  if (q == liquid || (q >= liquid_reached && q <= liquid_arrival)) return Phase::liquid;
  return Phase::both;
}
/// Whether anything comes, and when: of the whole flow or of one material.
constexpr bool is_whether_reached(Quantity q) {
  return q == Quantity::reached || q == Quantity::solid_reached || q == Quantity::liquid_reached;
}
constexpr bool is_arrival(Quantity q) {
  return q == Quantity::arrival || q == Quantity::solid_arrival || q == Quantity::liquid_arrival;
}

struct LayerMeaning {
  Quantity quantity = Quantity::other;
  Statistic statistic = Statistic::value;
  IntensityClass intensity = IntensityClass::none;

  /// The numbers of the layer's axis are thresholds that members exceed (else levels of quantiles).
  bool has_thresholds() const {
    return statistic == Statistic::probability || statistic == Statistic::difference || is_bound();
  }
  bool is_bound() const {
    return statistic == Statistic::lower_bound || statistic == Statistic::upper_bound;
  }
  bool operator==(const LayerMeaning&) const = default;
};

/// The quantity that a map of one member holds.
constexpr Quantity quantity_of(PeakLayer layer) {
  switch (layer) {
    case PeakLayer::thickness:
      return Quantity::thickness;
    case PeakLayer::speed:
      return Quantity::speed;
    case PeakLayer::energy:
      return Quantity::energy;
    case PeakLayer::pressure:
      return Quantity::pressure;
    case PeakLayer::arrival:
      return Quantity::arrival;
    case PeakLayer::deposit:
      return Quantity::deposit;
    case PeakLayer::left:
      return Quantity::left;
    case PeakLayer::eroded:
      return Quantity::eroded;
    case PeakLayer::solid:
      return Quantity::solid;
    case PeakLayer::liquid:
      return Quantity::liquid;
    case PeakLayer::solid_speed:
      return Quantity::solid_speed;
    case PeakLayer::solid_energy:
      return Quantity::solid_energy;
    case PeakLayer::solid_pressure:
      return Quantity::solid_pressure;
    case PeakLayer::solid_arrival:
      return Quantity::solid_arrival;
    case PeakLayer::liquid_speed:
      return Quantity::liquid_speed;
    case PeakLayer::liquid_energy:
      return Quantity::liquid_energy;
    case PeakLayer::liquid_pressure:
      return Quantity::liquid_pressure;
    case PeakLayer::liquid_arrival:
      return Quantity::liquid_arrival;
    case PeakLayer::liquid_fraction:
      return Quantity::liquid_fraction;
  }
  return Quantity::other;
}

}  // namespace sturz
