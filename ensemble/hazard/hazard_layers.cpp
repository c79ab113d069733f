// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/hazard_layers.hpp"

#include "ensemble/hazard/map_units.hpp"
#include "ensemble/hazard/swiss_intensity.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sturz {
namespace {

/// How values are made of members, in words.
struct Rules {
  std::string share = "members / valid members";
  std::string bounds = "95 % Wilson interval of the share of valid members";
  std::string order = "linear between order statistics (Hyndman and Fan 1996, definition 7)";

  std::string quantiles() const {
    return "over all valid members, 0 where a member did not come; " + order;
  }
};

/// Of members that do not count alike.
Rules weighted_rules(double effective) {
  const std::string weighted = weighting_text(effective);
  return {
      "weight of the members / weight of the valid members, " + weighted,
      "95 % Wilson interval of the weighted share, " + weighted,
      "weighted inverse distribution, mean over one effective member (Akinshin 2023), " + weighted};
}

/// A member quantity as the maps speak of it, in the units in which the scenario asks for it.
struct PeakMaps {
  PeakLayer source;
  const char* word;  ///< first word of the layers' names, <word>_threshold
  const std::vector<double> HazardSpec::*thresholds;
};
const PeakMaps peaks[] = {
    {PeakLayer::thickness, "thickness", &HazardSpec::thickness_m},
    {PeakLayer::speed, "speed", &HazardSpec::speed_m_s},
    {PeakLayer::energy, "energy", &HazardSpec::energy_kj_m2},
    {PeakLayer::pressure, "pressure", &HazardSpec::pressure_kpa},
};

/// Maps of one material of a flow, in its own words.
struct MaterialMaps {
  Phase phase;
  const char* word;   ///< of the layers' names
  const char* plain;  ///< "grains"
  PeakLayer arrival;
  Quantity reached;
  std::array<PeakMaps, 4> peaks;
};
const MaterialMaps materials[] = {
    {Phase::grains,
     "solid",
     "grains",
     PeakLayer::solid_arrival,
     Quantity::solid_reached,
     {{{PeakLayer::solid, "solid_thickness", &HazardSpec::thickness_m},
       {PeakLayer::solid_speed, "solid_speed", &HazardSpec::speed_m_s},
       {PeakLayer::solid_energy, "solid_energy", &HazardSpec::energy_kj_m2},
       {PeakLayer::solid_pressure, "solid_pressure", &HazardSpec::pressure_kpa}}}},
    {Phase::liquid,
     "liquid",
     "liquid",
     PeakLayer::liquid_arrival,
     Quantity::liquid_reached,
     {{{PeakLayer::liquid, "liquid_thickness", &HazardSpec::thickness_m},
       {PeakLayer::liquid_speed, "liquid_speed", &HazardSpec::speed_m_s},
       {PeakLayer::liquid_energy, "liquid_energy", &HazardSpec::energy_kj_m2},
       {PeakLayer::liquid_pressure, "liquid_pressure", &HazardSpec::pressure_kpa}}}},
};

/// Says which thickness thresholds the particles cannot resolve; empty if none.
std::string not_resolved(std::span<const double> thicknesses_m, double spacing_m) {
  std::string list;
  for (const double t : thicknesses_m)
    if (t < spacing_m / 2) list += fmt::format("{}{} m", list.empty() ? "" : ", ", t);
  if (list.empty()) return {};
  return fmt::format("not resolved (below half the particle spacing of {} m): {}", spacing_m, list);
}

std::string joined(const std::string& rule, const std::string& note) {
  return note.empty() ? rule : rule + "; " + note;
}

/// What a layer says of members of which mass left or still moved: what passed by can only become
/// more, what lies or comes first at the end may go either way.
const char* meaning_of_cut(const LayerMeaning& meaning) {
  const bool either_way =
      meaning.quantity == Quantity::deposit || is_arrival(meaning.quantity) ||
      meaning.quantity == Quantity::liquid_fraction ||
      (meaning.quantity == Quantity::intensity && meaning.intensity == IntensityClass::medium);
  if (meaning.quantity == Quantity::left) return "as far as it was seen";
  if (meaning.quantity == Quantity::deposit)
    return "with mass that still moved, without mass that left, so too large or too small";
  if (meaning.statistic == Statistic::upper_bound) return "not an upper bound";
  return either_way ? "may become more or less" : "a lower bound";
}

class Builder {
 public:
  Builder(const Grid& grid, const HazardSpec& spec, double spacing_m, std::int64_t n_members,
          std::int64_t n_censored, std::optional<double> effective)
      : spec_(spec),
        spacing_m_(spacing_m),
        n_members_(n_members),
        n_censored_(n_censored),
        none_(effective ? wilson_interval_of_share(0, *effective) : wilson_interval(0, n_members)) {
    out_.stack.grid = grid;
    if (effective) rules_ = weighted_rules(*effective);
  }

  HazardLayers build(const HazardExtras& extras) {
    Layer count = plain_layer("number_of_members", {Quantity::members, Statistic::count},
                              "valid members of the ensemble", "1",
                              "settled, out of time or left the terrain");
    add(std::move(count), static_cast<float>(n_members_));
    out_.reaches.push_back(
        {PeakLayer::arrival,
         add_probability("probability_of_reach", Quantity::reached,
                         "share of members that reach the cell",
                         "reached: smoothed thickness above the runout limit at any time", {}, {}),
         std::nullopt});
    if (extras.left)
      out_.mass_left =
          add(plain_layer("probability_of_mass_left", {Quantity::left, Statistic::probability},
                          "share of members whose mass crossed the edge of the known ground here",
                          "1", rules_.share + "; what lies beyond is not known"),
              0);
    for (const PeakMaps& q : peaks) out_.quantities.push_back(add_peak(q));
    out_.reaches.front().quantile =
        add_over_comers("arrival", Quantity::arrival, "time until the flow arrives", "s");
    out_.quantities.push_back(add_deposit());
    if (extras.eroded)
      out_.quantities.push_back(
          add_peak({PeakLayer::eroded, "eroded_depth", &HazardSpec::eroded_depth_m}));
    if (extras.phases) add_materials(extras);
    add_intensities();
    return std::move(out_);
  }

 private:
  /// Adds a layer, with its value of an untouched cell, and tells its place.
  std::size_t add(Layer layer, float fill) {
    const bool defined = n_members_ > 0 || layer.is_count();
    if (!layer.is_count()) layer.n_censored = static_cast<int>(n_censored_);
    if (n_censored_ > 0 && !layer.is_count())
      layer.comment = joined(layer.comment,
                             fmt::format("{}: the end of {} of {} members was not seen",
                                         meaning_of_cut(layer.meaning), n_censored_, n_members_));
    out_.untouched.push_back(defined ? fill : nan_f);
    out_.stack.layers.push_back(std::move(layer));
    return out_.stack.layers.size() - 1;
  }

  ProbabilityLayers add_probability(const std::string& name, Quantity quantity,
                                    const std::string& meaning, const std::string& comment,
                                    LayerAxis axis, std::vector<float> thresholds) {
    const auto layer = [&](Layer one, double fill) {
      one.axis = axis;
      return add(std::move(one), static_cast<float>(fill));
    };
    const auto bound = [&](const char* suffix, Statistic statistic) {
      return bound_layer(name + suffix, {quantity, statistic}, meaning, 0.95,
                         joined(rules_.bounds, comment));
    };
    ProbabilityLayers places;
    places.probability = layer(plain_layer(name, {quantity, Statistic::probability}, meaning, "1",
                                           joined(rules_.share, comment)),
                               0);
    places.lower = layer(bound("_lower", Statistic::lower_bound), none_.lower);
    places.upper = layer(bound("_upper", Statistic::upper_bound), none_.upper);
    places.thresholds = std::move(thresholds);
    return places;
  }

  std::optional<std::size_t> add_quantiles(const std::string& name, Quantity quantity,
                                           const std::string& meaning, const std::string& units,
                                           const std::string& methods, const std::string& comment,
                                           float fill) {
    if (spec_.quantiles.empty()) return std::nullopt;
    Layer layer = plain_layer(name + "_quantile", {quantity, Statistic::quantile},
                              "quantile of " + meaning, units, comment);
    layer.cell_methods = methods;
    layer.axis = LayerAxis{"quantile", "", "1", spec_.quantiles};
    return add(std::move(layer), fill);
  }

  std::size_t add_mean(const std::string& name, Quantity quantity, const std::string& meaning,
                       const std::string& units, const std::string& methods) {
    Layer layer = plain_layer(name + "_mean", {quantity, Statistic::mean}, "mean of " + meaning,
                              units, "over all valid members, 0 where a member did not come");
    layer.cell_methods = methods + "realization: mean";
    return add(std::move(layer), 0);
  }

  QuantityLayers add_peak(const PeakMaps& q) {
    const Quantity quantity = quantity_of(q.source);
    const std::string name = q.word, meaning = info(q.source).long_name;
    QuantityLayers layers;
    layers.source = q.source;
    const MapUnit unit = map_unit(q.source);
    layers.units_per_si = unit.per_si;
    const std::vector<double>& thresholds = spec_.*q.thresholds;
    if (!thresholds.empty()) {
      const bool is_thickness = q.source == PeakLayer::thickness || q.source == PeakLayer::solid ||
                                q.source == PeakLayer::liquid;
      const LayerAxis axis{name + "_threshold", "", unit.name, thresholds};
      std::vector<float> si;
      for (const double t : thresholds)
        si.push_back(static_cast<float>(t * std::round(1 / unit.per_si)));
      layers.exceedance = add_probability(
          name + "_exceedance", quantity,
          fmt::format("share of members whose {} exceeds the threshold", meaning),
          is_thickness ? not_resolved(thresholds, spacing_m_) : "", axis, std::move(si));
    }
    const bool is_total = q.source == PeakLayer::eroded;  // at the end, which is its largest
    const std::string over_time = is_total ? "" : "time: maximum";
    layers.mean = add_mean(name, quantity, meaning, unit.name, is_total ? "" : over_time + " ");
    layers.quantile =
        add_quantiles(name, quantity, meaning, unit.name, over_time, rules_.quantiles(), 0);
    return layers;
  }

  /// Of what only a member that comes has.
  std::optional<std::size_t> add_over_comers(const std::string& name, Quantity quantity,
                                             const std::string& meaning, const std::string& units) {
    return add_quantiles(
        name, quantity, meaning, units, "",
        "over the members that reach the cell only; undefined where none does; " + rules_.order,
        nan_f);
  }

  /// Each cut off by what left of it alone; both together by either.
  void add_materials(const HazardExtras& extras) {
    const std::int64_t of_both = n_censored_;
    for (const MaterialMaps& m : materials) {
      n_censored_ = m.phase == Phase::grains ? extras.n_censored_grains : extras.n_censored_liquid;
      const std::string word = m.word, plain = m.plain;
      ReachLayers reach;
      reach.source = m.arrival;
      reach.reached = add_probability(
          "probability_of_" + word + "_reach", m.reached,
          fmt::format("share of members of which {} reach{} the cell", plain,
                      m.phase == Phase::grains ? "" : "es"),
          fmt::format("reached: smoothed volume of {} over area above the runout limit at any time",
                      plain),
          {}, {});
      reach.quantile = add_over_comers(
          word + "_arrival", quantity_of(m.arrival),
          fmt::format("time until {} arrive{}", plain, m.phase == Phase::grains ? "" : "s"), "s");
      out_.reaches.push_back(std::move(reach));
      for (const PeakMaps& q : m.peaks) out_.quantities.push_back(add_peak(q));
    }
    n_censored_ = of_both;
    out_.liquid_fraction = add_over_comers("liquid_fraction", Quantity::liquid_fraction,
                                           info(PeakLayer::liquid_fraction).long_name, "1");
  }

  QuantityLayers add_deposit() {
    const PeakLayerInfo& of = info(PeakLayer::deposit);
    QuantityLayers layers;
    layers.source = PeakLayer::deposit;
    layers.mean = add_mean("deposit", Quantity::deposit, of.long_name, of.units, "");
    layers.quantile = add_quantiles("deposit", Quantity::deposit, of.long_name, of.units, "",
                                    rules_.quantiles(), 0);
    return layers;
  }

  void add_intensities() {
    const double limits[] = {swiss_thickness_m};
    const std::string note = not_resolved(limits, spacing_m_);
    const auto layer = [&](IntensityClass intensity, const std::string& rule) {
      const std::string_view word = to_string(intensity);
      return add(
          plain_layer(
              fmt::format("probability_of_{}_intensity", word),
              {Quantity::intensity, Statistic::probability, intensity},
              fmt::format("share of members with {} intensity, Swiss debris-flow classes", word),
              "1", joined(rule, note)),
          0);
    };
    out_.high_intensity =
        layer(IntensityClass::high,
              fmt::format("reached, peak thickness > {} m and peak speed > {} m/s of one member, "
                          "not necessarily at one instant",
                          swiss_thickness_m, swiss_speed_m_s));
    out_.medium_intensity = layer(IntensityClass::medium, "reached, but not of high intensity");
  }

  const HazardSpec& spec_;
  double spacing_m_;
  std::int64_t n_members_, n_censored_;
  ProbabilityBounds none_;  // of a cell that no member reached
  Rules rules_;
  HazardLayers out_;
};

}  // namespace

std::string weighting_text(double effective_members) {
  return fmt::format("weighted by posterior, effective members = {:.1f}", effective_members);
}

HazardLayers hazard_layers(const Grid& grid, const HazardSpec& spec, double spacing_m,
                           std::int64_t n_members, std::int64_t n_censored,
                           const HazardExtras& extras) {
  return Builder(grid, spec, spacing_m, n_members, n_censored, extras.effective_members)
      .build(extras);
}

}  // namespace sturz
