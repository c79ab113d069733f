// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/ladder.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/error_model.hpp"
#include "ensemble/fidelity/valid_members.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double deviation(std::span<const double> values) {
  if (values.size() < 2) return nan_d;
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n - 1));
}

double root_mean_square(std::span<const double> a, std::span<const double> b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

/// A displaced member and its twin differ by the noise of both: root two of it.
double noise_of(const ByNumber& twins, const ByNumber& displaced, double MemberScalars::*field) {
  std::vector<double> a, b;
  for (const auto& [number, twin] : twins) {
    const auto other = displaced.find(number);
    if (other == displaced.end() || !is_known(*twin, field) || !is_known(*other->second, field))
      continue;
    a.push_back(twin->scalars.*field);
    b.push_back(other->second->scalars.*field);
  }
  return a.empty() ? nan_d : root_mean_square(a, b) / std::sqrt(2);
}

/// Where errors are asked about: the spacings, and finer ones for what lies beyond.
std::vector<ErrorQuestion> questions_to_limit(std::vector<double> spacings) {
  const double finest = spacings.back();
  for (const double part : {0.5, 0.25, 0.125}) spacings.push_back(part * finest);
  std::vector<ErrorQuestion> questions;
  for (const double d : spacings) questions.push_back({d, 0});
  return questions;
}

std::vector<ErrorQuestion> questions_to_held_out(std::span<const double> spacings, double finer) {
  std::vector<ErrorQuestion> questions;
  for (const double d : spacings) questions.push_back({d, finer});
  return questions;
}

/// All that the numbers of a ladder are found from.
struct Material {
  std::vector<double> spacings;
  std::vector<ByNumber> rungs;
  std::vector<std::int64_t> members;  // valid at every spacing
  ByNumber twins;                     // displaced
  std::size_t twin_of = 0;
  ByNumber held_out;
  double held_out_m = nan_d;
  std::uint64_t seed = 1;
};

using Values = std::vector<std::vector<double>>;  // [n_spacings][n_members]

/// Members that know a result at every spacing.
std::vector<std::int64_t> knowing(const Material& from, double MemberScalars::*field) {
  std::vector<std::int64_t> numbers;
  for (const std::int64_t number : from.members)
    if (std::all_of(from.rungs.begin(), from.rungs.end(),
                    [&](const ByNumber& rung) { return is_known(*rung.at(number), field); }))
      numbers.push_back(number);
  return numbers;
}

Values values_of(std::span<const ByNumber> rungs, std::span<const std::int64_t> members,
                 double MemberScalars::*field) {
  Values values(rungs.size());
  for (std::size_t l = 0; l < rungs.size(); ++l)
    for (const std::int64_t number : members)
      values[l].push_back(rungs[l].at(number)->scalars.*field);
  return values;
}

std::optional<ResultAccuracy> result_accuracy(const std::string& name, const Material& from) {
  const ScalarInfo& scalar = scalar_named(name);
  const std::vector<std::int64_t> members = knowing(from, scalar.field);
  if (members.empty()) return std::nullopt;
  const Values values = values_of(from.rungs, members, scalar.field);
  ResultAccuracy r;
  r.name = name;
  r.units = scalar.units;
  r.n_members = static_cast<std::int64_t>(members.size());
  r.refinement = refine(from.spacings, values, from.seed);
  for (const auto& level : values) r.member_rms.push_back(root_mean_square(level, values.back()));
  r.spread = deviation(values.back());
  r.noise = noise_of(from.rungs[from.twin_of], from.twins, scalar.field);
  const std::vector<ErrorQuestion> asked = questions_to_limit(from.spacings);
  std::vector<double> where, of_member, of_mean;
  const double noise = std::isfinite(r.noise) ? r.noise : 0;
  const std::vector<ExpectedSize> sizes = expected_sizes(from.spacings, values, noise, asked);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    where.push_back(asked[i].spacing_m);
    of_member.push_back(sizes[i].member);
    of_mean.push_back(sizes[i].mean);
  }
  r.member_errors = ErrorCurve(where, std::move(of_member));
  r.mean_errors = ErrorCurve(std::move(where), std::move(of_mean));
  return r;
}

/// A result at every spacing beside the held-out one.
void check_result(const ResultAccuracy& r, const Material& from,
                  std::vector<CheckedError>& checked) {
  double MemberScalars::*const field = scalar_named(r.name).field;
  const std::vector<std::int64_t> members = knowing(from, field);
  std::vector<std::int64_t> both;
  for (const std::int64_t number : members)
    if (const auto found = from.held_out.find(number);
        found != from.held_out.end() && is_known(*found->second, field))
      both.push_back(number);
  if (both.empty()) return;
  const double noise = std::isfinite(r.noise) ? r.noise : 0;
  const std::vector<ExpectedSize> said =
      expected_sizes(from.spacings, values_of(from.rungs, members, field), noise,
                     questions_to_held_out(from.spacings, from.held_out_m));
  const Values values = values_of(from.rungs, both, field);
  const std::vector<double> finer = values_of({&from.held_out, 1}, both, field).front();
  for (std::size_t l = 0; l < said.size(); ++l) {
    CheckedError c;
    c.name = r.name;
    c.units = r.units;
    c.spacing_m = from.spacings[l];
    c.said = said[l].member / r.scale();
    c.found = root_mean_square(values[l], finer) / r.scale();
    c.said_mean = said[l].mean / r.scale();
    c.found_mean = std::abs(mean(values[l]) - mean(finer)) / r.scale();
    c.noise = std::sqrt(2) * noise / r.scale();
    checked.push_back(std::move(c));
  }
}

/// Maps of P(thicker) of one threshold.
struct Maps {
  std::vector<Raster<double>> of_rungs;
  std::vector<std::vector<double>>
      distances;  // [n_spacings][n_spacings] relative to the finest's area
  double mean_area_m2 = 0;
};

double relative_to(const Maps& maps, const Raster<double>& p, const Raster<double>& q) {
  return maps.mean_area_m2 > 0 ? map_distance(p, q).area_between_m2 / maps.mean_area_m2 : nan_d;
}

Window extent_of(std::span<const Rung> rungs, const std::vector<std::int64_t>& members) {
  Window extent;
  for (const Rung& rung : rungs)
    if (rung.members != nullptr)
      for (const MemberSummary& m : rung.members->members())
        if (std::binary_search(members.begin(), members.end(), m.member))
          extent = joined(extent, m.window);
  return extent;
}

Maps maps_of(std::span<const Rung> rungs, const std::vector<std::int64_t>& members,
             const Window& extent, double threshold_m, CancelFlag cancel) {
  Maps maps;
  for (const Rung& rung : rungs)
    maps.of_rungs.push_back(share_thicker(*rung.members, members, extent, threshold_m, cancel));
  const std::size_t n = rungs.size();
  maps.mean_area_m2 = map_distance(maps.of_rungs.back(), maps.of_rungs.back()).mean_area_m2;
  maps.distances.assign(n, std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      maps.distances[i][j] = maps.distances[j][i] =
          relative_to(maps, maps.of_rungs[i], maps.of_rungs[j]);
  return maps;
}

std::vector<std::int64_t> also_in(const std::vector<std::int64_t>& members, const ByNumber& other) {
  std::vector<std::int64_t> both;
  for (const std::int64_t number : members)
    if (other.contains(number)) both.push_back(number);
  return both;
}

/// Distance between the map of the displaced members and that of their twins.
double noise_of_map(std::span<const Rung> rungs, const MemberParts* displaced, const Material& from,
                    double threshold_m, CancelFlag cancel) {
  if (displaced == nullptr) return nan_d;
  const std::vector<std::int64_t> both = also_in(from.members, from.twins);
  const std::vector<Rung> pair{{0, displaced}, rungs[from.twin_of]};
  return maps_of(pair, both, extent_of(pair, both), threshold_m, cancel).distances[0][1];
}

MapAccuracy map_accuracy(std::span<const Rung> rungs, const MemberParts* displaced,
                         const Material& from, double threshold_m, CancelFlag cancel) {
  const Window extent = extent_of(rungs, from.members);
  const Maps maps = maps_of(rungs, from.members, extent, threshold_m, cancel);
  MapAccuracy map;
  map.threshold_m = threshold_m;
  for (const Raster<double>& p : maps.of_rungs)
    map.distances.push_back(map_distance(p, maps.of_rungs.back()));
  map.noise = noise_of_map(rungs, displaced, from, threshold_m, cancel);
  const std::vector<ErrorQuestion> asked = questions_to_limit(from.spacings);
  std::vector<double> where;
  for (const ErrorQuestion& q : asked) where.push_back(q.spacing_m);
  map.errors = ErrorCurve(std::move(where),
                          expected_distances(from.spacings, maps.distances,
                                             std::isfinite(map.noise) ? map.noise : 0, asked));
  return map;
}

void check_map(const MapAccuracy& map, std::span<const Rung> rungs, const Rung& held_out,
               const Material& from, CancelFlag cancel, std::vector<CheckedError>& checked) {
  const std::vector<std::int64_t> both = also_in(from.members, from.held_out);
  if (both.empty()) return;
  std::vector<Rung> all(rungs.begin(), rungs.end());
  all.push_back(held_out);
  const Window extent = extent_of(all, both);
  const Maps maps = maps_of(rungs, both, extent, map.threshold_m, cancel);
  const Raster<double> finer =
      share_thicker(*held_out.members, both, extent, map.threshold_m, cancel);
  const double noise = std::isfinite(map.noise) ? map.noise : 0;
  const std::vector<double> said = expected_distances(
      from.spacings, maps.distances, noise, questions_to_held_out(from.spacings, from.held_out_m));
  for (std::size_t l = 0; l < said.size(); ++l) {
    CheckedError c{std::string("map"), std::string("m")};
    c.threshold_m = map.threshold_m;
    c.spacing_m = from.spacings[l];
    c.said = said[l];
    c.found = relative_to(maps, maps.of_rungs[l], finer);
    c.noise = noise;
    checked.push_back(std::move(c));
  }
}

void add_seconds(LadderAccuracy& ladder, std::span<const ByNumber> rungs) {
  for (const ByNumber& rung : rungs) {
    double sum = 0;
    for (const std::int64_t number : ladder.members) sum += rung.at(number)->scalars.cpu_s;
    // A member of no time at all would have no logarithm.
    ladder.member_cpu_s.push_back(std::max(1e-6, sum / static_cast<double>(ladder.members.size())));
  }
  ladder.seconds = fit_power_law(ladder.spacings_m, ladder.member_cpu_s,
                                 ladder.formulation == "depth_averaged" ? -3 : -4);
}

}  // namespace

double ResultAccuracy::scale() const { return std::abs(refinement.means.back()); }

double ResultAccuracy::member_error(double spacing_m) const {
  return member_errors.at(spacing_m) / scale();
}

double ResultAccuracy::mean_error(double spacing_m) const {
  return mean_errors.at(spacing_m) / scale();
}

LadderAccuracy ladder_accuracy(std::string formulation, std::span<const Rung> rungs,
                               const MemberParts* displaced, std::size_t displaced_rung,
                               const LadderQuestions& questions, CancelFlag cancel) {
  LadderAccuracy ladder;
  ladder.formulation = std::move(formulation);
  Material from;
  for (const Rung& rung : rungs) {
    from.spacings.push_back(rung.spacing_m);
    from.rungs.push_back(valid_members(*rung.members));
    ladder.n_asked =
        std::max(ladder.n_asked, static_cast<std::int64_t>(rung.members->members().size()));
  }
  from.members = common_members(from.rungs);
  std::string none = ladder.formulation;
  none.append(
      ": no member is valid at every spacing (there is nothing to compare). See members.csv "
      "in the folders of the spacings for the reasons.");
  require(!from.members.empty(), none);
  if (displaced != nullptr) from.twins = valid_members(*displaced);
  from.twin_of = displaced_rung;
  from.seed = questions.seed;
  const bool checks = questions.held_out.members != nullptr;
  if (checks) {
    from.held_out = valid_members(*questions.held_out.members);
    from.held_out_m = ladder.held_out_m = questions.held_out.spacing_m;
  }
  ladder.spacings_m = from.spacings;
  ladder.members = from.members;
  add_seconds(ladder, from.rungs);
  for (const std::string& name : questions.results) {
    auto result = result_accuracy(name, from);
    if (!result) {
      ladder.not_told.push_back(name);
      continue;
    }
    if (checks) check_result(*result, from, ladder.checked);
    ladder.results.push_back(std::move(*result));
  }
  for (const double threshold : questions.thickness_m) {
    ladder.maps.push_back(map_accuracy(rungs, displaced, from, threshold, cancel));
    if (checks)
      check_map(ladder.maps.back(), rungs, questions.held_out, from, cancel, ladder.checked);
  }
  return ladder;
}

std::vector<Change> changes(const MemberParts& rung, const MemberParts& other,
                            std::span<const std::string> results) {
  const ByNumber a = valid_members(rung), b = valid_members(other);
  std::vector<Change> all;
  for (const std::string& name : results) {
    const ScalarInfo& scalar = scalar_named(name);
    std::vector<double> differences;
    double sum = 0;
    for (const auto& [number, member] : a) {
      const auto twin = b.find(number);
      if (twin == b.end() || !is_known(*member, scalar.field) ||
          !is_known(*twin->second, scalar.field))
        continue;
      differences.push_back(twin->second->scalars.*scalar.field - member->scalars.*scalar.field);
      sum += member->scalars.*scalar.field;
    }
    const auto n = static_cast<double>(differences.size());
    if (differences.empty()) continue;
    Change c;
    c.name = name;
    c.units = scalar.units;
    c.mean = 0;
    for (const double d : differences) c.mean += d / n;
    c.standard_error = deviation(differences) / std::sqrt(n);
    c.rung_mean = sum / n;
    c.n_members = static_cast<std::int64_t>(differences.size());
    all.push_back(std::move(c));
  }
  return all;
}

double seconds_ratio(const MemberParts& rung, const MemberParts& other) {
  const ByNumber a = valid_members(rung), b = valid_members(other);
  double of_rung = 0, of_other = 0;
  for (const auto& [number, member] : a) {
    const auto twin = b.find(number);
    if (twin == b.end()) continue;
    of_rung += member->scalars.cpu_s;
    of_other += twin->second->scalars.cpu_s;
  }
  return of_rung > 0 ? of_other / of_rung : nan_d;
}

}  // namespace sturz
