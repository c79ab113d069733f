// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/multilevel_results.hpp"

#include "ensemble/fidelity/ladder.hpp"
#include "ensemble/fidelity/multilevel/first_members.hpp"
#include "ensemble/fidelity/multilevel/remembered_members.hpp"
#include "ensemble/hazard/map_units.hpp"
#include "ensemble/workflow/multilevel/decision.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace sturz::workflow {
namespace {

/// What pages speak of; results that a scene does not have fall out by themselves.
const std::vector<std::string> looked_at{"runout_m",      "reached_area_m2", "com_travel_m",
                                         "max_speed_m_s", "max_thickness_m", "max_energy_j_m2"};

class Look {
 public:
  Look(const MultilevelJob& job, const MultilevelMembers& found, CancelFlag cancel)
      : job_(job), cancel_(cancel), hazard_(job.scene.scenario.hazard) {
    for (const MemberStore& store : found.stores) {
      remembered_.push_back(std::make_unique<RememberedMembers>(store, remembered_bytes));
      all_.members.push_back(remembered_.back().get());
    }
    all_.counts = found.planned;
    all_.parts = job.parts;
    made_.folder = job.request.folder;
    made_.title = job.scene.scenario.title;
    made_.rounds = job.plan.rounds;
    made_.pilot = job.plan.pilot;
    made_.parts = job.parts;
    made_.used = job.plan.rounds.back().plan.levels;
  }

  MultilevelMade take() {
    for (const std::string& name : looked_at) add_headline(name);
    add_errors();
    if (made_.used.size() > 1) add_maps();
    add_assets();
    add_levels();
    add_members();
    add_misses();
    return std::move(made_);
  }

 private:
  void add_headline(const std::string& name) {
    MultilevelHeadline h;
    h.name = name;
    h.units = scalar_named(name).units;
    h.scalar = scalar_of(all_, made_.used, name);
    if (!std::isfinite(h.scalar.mean.mean)) return;
    const auto valid = static_cast<std::int64_t>(
        draws_of_levels(level_draws(valid_of(all_, made_.used)), made_.used.size()).front());
    h.left_out = valid - static_cast<std::int64_t>(h.scalar.draws.front());
    const Interval bounds = h.scalar.mean.bounds_90();
    h.sampling = (bounds.high - bounds.low) / 2;
    h.quantiles =
        multilevel_quantiles(level_draws(valid_of(all_, made_.used), scalar_named(name).field),
                             made_.used.size(), hazard_.quantiles);
    made_.headlines.push_back(std::move(h));
  }

  /// Levels of which no draw is valid everywhere cannot be compared.
  bool still_share(std::vector<std::size_t> parts, std::size_t part) const {
    parts.push_back(part);
    return !common_members(valid_of(all_, parts)).empty();
  }

  std::vector<std::size_t> same_formulation() const {
    std::vector<std::size_t> parts;
    for (std::size_t p = 0; p < all_.parts.size(); ++p)
      if (all_.parts[p].formulation == all_.parts.front().formulation && still_share(parts, p))
        parts.push_back(p);
    std::sort(parts.begin(), parts.end(), [&](std::size_t a, std::size_t b) {
      return all_.parts[a].spacing_m > all_.parts[b].spacing_m;
    });
    return parts;
  }

  /// Errors that no sampling removes, from the draws that the levels share.
  void add_errors() {
    std::vector<std::string> names;
    for (const MultilevelHeadline& h : made_.headlines) names.push_back(h.name);
    std::vector<FirstMembers> counted;
    for (std::size_t p = 0; p < all_.parts.size(); ++p)
      counted.emplace_back(*all_.members[p], all_.counts[p]);
    const std::vector<std::size_t> own = same_formulation();
    if (own.size() > 1) {
      std::vector<Rung> rungs;
      for (const std::size_t p : own) rungs.push_back({all_.parts[p].spacing_m, &counted[p]});
      const LadderAccuracy ladder =
          ladder_accuracy(all_.parts.front().formulation, rungs, nullptr, 0,
                          {names, {}, job_.scene.scenario.ensemble.seed}, cancel_);
      for (const ResultAccuracy& r : ladder.results)
        headline(r.name).resolution = r.mean_errors.at(all_.parts.front().spacing_m);
    }
    for (std::size_t p = 0; p < all_.parts.size(); ++p) {
      if (!is_finest_of_another(p)) continue;
      for (const Change& change : changes(counted.front(), counted[p], names)) {
        MultilevelHeadline& h = headline(change.name);
        if (!std::isfinite(change.mean) || std::abs(change.mean) <= h.model) continue;
        h.model = std::abs(change.mean);
        h.model_error = change.standard_error;
        h.model_of = all_.parts[p].name;
      }
    }
  }

  bool is_finest_of_another(std::size_t part) const {
    const LevelPart& p = all_.parts[part];
    return p.formulation != all_.parts.front().formulation &&
           std::none_of(all_.parts.begin(), all_.parts.end(), [&](const LevelPart& o) {
             return o.formulation == p.formulation && o.spacing_m < p.spacing_m;
           });
  }

  MultilevelHeadline& headline(const std::string& name) {
    return *std::find_if(made_.headlines.begin(), made_.headlines.end(),
                         [&](const MultilevelHeadline& h) { return h.name == name; });
  }

  void add_map(const std::string& name, PeakLayer layer, const std::vector<double>& thresholds) {
    NamedMap map{name, layer, thresholds, {}};
    const double per_si = map_unit(layer).per_si;
    for (const double t : thresholds)
      map.maps.push_back(map_of(all_, made_.used,
                                {layer, static_cast<float>(t * std::round(1 / per_si))}, cancel_));
    make_monotone(map.maps);
    if (!map.maps.empty()) made_.maps.push_back(std::move(map));
  }

  void add_maps() {
    NamedMap reach{"probability_of_reach", PeakLayer::arrival, {}, {}};
    reach.maps.push_back(map_of(all_, made_.used, {}, cancel_));
    made_.map_error = reach.maps.front().rms_error;
    made_.dear_draws = shared_draws(all_, made_.used);
    made_.maps.push_back(std::move(reach));
    add_map("thickness_exceedance", PeakLayer::thickness, hazard_.thickness_m);
    add_map("speed_exceedance", PeakLayer::speed, hazard_.speed_m_s);
    add_map("energy_exceedance", PeakLayer::energy, hazard_.energy_kj_m2);
    add_map("pressure_exceedance", PeakLayer::pressure, hazard_.pressure_kpa);
  }

  void add_assets() {
    made_.assets = job_.scene.inputs.assets;
    if (made_.assets == nullptr) return;
    std::vector<AssetHits> hits;
    for (const std::size_t p : made_.used)
      hits.push_back(
          find_hits(FirstMembers(*all_.members[p], all_.counts[p]), *made_.assets, cancel_));
    std::vector<AssetExceedance> wanted;
    const auto want = [&](PeakLayer layer, const std::vector<double>& thresholds) {
      for (const double t : thresholds) wanted.push_back({layer, t, {}});
    };
    want(PeakLayer::thickness, hazard_.thickness_m);
    want(PeakLayer::speed, hazard_.speed_m_s);
    want(PeakLayer::energy, hazard_.energy_kj_m2);
    want(PeakLayer::pressure, hazard_.pressure_kpa);
    made_.risk = assess_levels(*made_.assets, hits, level_draws(valid_of(all_, made_.used)),
                               std::move(wanted));
  }

  void add_levels() {
    for (std::size_t p = 0; p < all_.parts.size(); ++p) {
      LevelShare share;
      share.name = all_.parts[p].name;
      share.members = all_.counts[p];
      share.valid =
          static_cast<std::int64_t>(valid_of(all_, std::vector<std::size_t>{p}).front().size());
      share.member_cpu_s = member_cost_s(all_, p);
      share.seconds = share.member_cpu_s * static_cast<double>(share.members);
      made_.seconds += share.seconds;
      const auto at = std::find(made_.used.begin(), made_.used.end(), p);
      share.used = at != made_.used.end();
      if (share.used) add_variances(share, static_cast<std::size_t>(at - made_.used.begin()));
      made_.levels.push_back(std::move(share));
    }
    const double cost = made_.levels.front().member_cpu_s;
    for (MultilevelHeadline& h : made_.headlines) {
      const double e = h.scalar.mean.standard_error;
      if (e > 0) h.plain_seconds = cost * h.scalar.variance / (e * e);
    }
    if (made_.maps.empty()) return;
    const MultilevelMap& reach = made_.maps.front().maps.front();
    const auto n = static_cast<double>(reach.doubtful);
    if (reach.rms_error > 0)
      made_.map_plain_seconds =
          cost * reach.plain_variance / n / (reach.rms_error * reach.rms_error);
  }

  static double part_of(const std::vector<double>& variances, const std::vector<double>& n,
                        std::size_t level) {
    double sum = 0;
    for (std::size_t l = 0; l < variances.size(); ++l) sum += variances[l] / n[l];
    return sum > 0 ? variances[level] / n[level] / sum : 0;
  }

  void add_variances(LevelShare& share, std::size_t level) const {
    std::vector<double> n;
    for (const std::size_t p : made_.used) n.push_back(static_cast<double>(all_.counts[p]));
    for (const MultilevelHeadline& h : made_.headlines)
      share.variance_shares.push_back(part_of(h.scalar.variances, n, level));
    if (!made_.maps.empty())
      share.variance_shares.push_back(part_of(made_.maps.front().maps.front().variances, n, level));
  }

  void add_members() {
    const EnsembleSpec& ensemble = job_.scene.scenario.ensemble;
    const std::vector<std::size_t> paired =
        draws_of_levels(level_draws(valid_of(all_, made_.used)), made_.used.size());
    for (std::size_t p = 0; p < all_.parts.size(); ++p) {
      LevelShare& level = made_.levels[p];
      std::vector<MemberSummary> counted;
      for (const MemberSummary& m : all_.members[p]->members())
        if (m.member < all_.counts[p]) counted.push_back(m);
      level.censoring = censoring_report(counted, ensemble.max_censored_fraction);
      made_.failed += level.members - level.valid;
      made_.censored += level.censoring.censored();
      if (!level.used) continue;
      const auto at = std::find(made_.used.begin(), made_.used.end(), p) - made_.used.begin();
      level.unpaired =
          level.valid - static_cast<std::int64_t>(paired[static_cast<std::size_t>(at)]);
      if (level.censoring.too_many())
        made_.cut_off.push_back(fmt::format(
            "{}: {} of {} valid members are cut off ({}), more than the accepted share "
            "(ensemble.max_censored_fraction = {}). Means and quantiles are of the others and lie "
            "too low where the furthest are among them; probabilities are lower bounds.",
            level.name, level.censoring.censored(), level.valid, counts_text(level.censoring),
            ensemble.max_censored_fraction));
    }
    made_.warnings = job_.scene.description.warnings;
    made_.max_failed_fraction = ensemble.max_failed_fraction;
  }

  /// What was asked for and is not there, by more than what a round would not be worth.
  void add_misses() {
    const TargetSpec target = job_.scene.scenario.ensemble.target.value_or(TargetSpec{});
    if (const double given = 3600 * target.core_hours;
        given > 0 && made_.seconds > near_enough * given)
      made_.missed.push_back(
          fmt::format("Not kept: all members took {} of one core, and {} were asked for "
                      "(ensemble.target.core_hours). {} members of each level are the least "
                      "(ensemble.pilot).",
                      duration_text(made_.seconds), duration_text(given), made_.pilot));
    for (const std::string& name : headline_results()) {
      if (!(target.relative_error > 0)) break;
      const auto found = std::find_if(made_.headlines.begin(), made_.headlines.end(),
                                      [&](const MultilevelHeadline& h) { return h.name == name; });
      if (found == made_.headlines.end()) {
        made_.missed.push_back(
            fmt::format("Not reached: {} is not known of enough members to tell its mean.", name));
        continue;
      }
      const double wanted = target.relative_error * std::abs(found->scalar.mean.mean);
      if (!(found->sampling <= near_enough * wanted))
        made_.missed.push_back(fmt::format(
            "Not reached: 90 % bounds of the mean of {} are +- {:.3g} {}, and +- {:.3g} {} was "
            "asked for.",
            name, found->sampling, found->units, wanted, found->units));
    }
    if (!(target.map_error > 0)) return;
    const double map_error =
        made_.maps.empty()
            ? std::sqrt(level_set(all_, made_.used, target, cancel_).results.back().reached)
            : made_.map_error;
    if (map_error > near_enough * target.map_error)
      made_.missed.push_back(
          fmt::format("Not reached: the standard error of P(reached) is {:.3g}, and {:.3g} was "
                      "asked for.",
                      map_error, target.map_error));
  }

  const MultilevelJob& job_;
  CancelFlag cancel_;
  const HazardSpec& hazard_;
  std::vector<std::unique_ptr<RememberedMembers>> remembered_;
  LevelMembers all_;
  MultilevelMade made_;
};

}  // namespace

bool MultilevelMade::too_many_failed() const {
  return std::any_of(levels.begin(), levels.end(), [&](const LevelShare& l) {
    const auto failed_here = static_cast<double>(l.members - l.valid);
    return l.used && failed_here > max_failed_fraction * static_cast<double>(l.members);
  });
}

MultilevelMade look_at_members(const MultilevelJob& job, const MultilevelMembers& found,
                               CancelFlag cancel) {
  return Look(job, found, cancel).take();
}

}  // namespace sturz::workflow
